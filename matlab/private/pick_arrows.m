function [ jx, jy, scale ] = pick_arrows( f, sol, opt, ix, iy )
% PICK_ARROWS  Columns and rows with an arrow, and the length in mm of an arrow for the value 1.
%
% Only every 2nd, 3rd, ... element has an arrow, such that numvecx and numvecy are not exceeded. Without vecscale the length of
% the longest arrow is 1.5 times the distance of arrows.

   stepx = max(1, ceil(numel(ix)/opt.numvecx));
   stepy = max(1, ceil(numel(iy)/opt.numvecy));
   jx = ix(ceil((stepx+1)/2):stepx:end);
   jy = iy(ceil((stepy+1)/2):stepy:end);
   scale = opt.vecscale;
   if (isempty(scale))
      longest = max(max(hypot(f.vx(iy,ix), f.vy(iy,ix))));
      scale = 1;
      if (longest>0)
         scale = 1.5*min(stepx*sol.dx, stepy*sol.dy) / longest;
      end
   end

end % function pick_arrows
