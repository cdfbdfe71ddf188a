function [ keep ] = drop_close_points( y, z, min_dist )
% DROP_CLOSE_POINTS  Numbers of the points that are no closer than min_dist to the last one kept.

   % usually there are none
   if (all(hypot(diff(y(:)), diff(z(:))) >= min_dist))
      keep = 1 : numel(y);
      return
   end
   keep = zeros(1, numel(y));
   keep(1) = 1;
   nkeep = 1;
   for i = 2 : numel(y)
      if (hypot(y(i)-y(keep(nkeep)), z(i)-z(keep(nkeep))) >= min_dist)
         nkeep = nkeep + 1;
         keep(nkeep) = i;
      end
   end
   keep = keep(1:nkeep);

end % function drop_close_points
