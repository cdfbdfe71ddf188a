function [ keep ] = drop_close_points( y, z, min_dist )
% DROP_CLOSE_POINTS  Indices of the points that are at least min_dist from the last one kept.

   % usually no points are too close
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
