function [ xc, yc ] = corners( sol, ix, iy )
% CORNERS  Corners of a range of elements [mm], with the offsets of the grid; one more than elements.

   xc = sol.x(ix(1)) - sol.dx/2 + (0:numel(ix))*sol.dx;
   yc = sol.y(iy(1)) - sol.dy/2 + (0:numel(iy))*sol.dy;
   if (~isempty(sol.x_offset))
      xc = xc + sol.x_offset;
   end
   if (~isempty(sol.y_offset))
      yc = yc + sol.y_offset;
   end

end % function corners
