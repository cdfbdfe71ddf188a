function [ z ] = revolve( z, x, radius )
% REVOLVE  Height z [mm] of a surface of revolution at a distance x from the plane through its axis.
%
%   radius   from the axis to z = 0: positive with the axis above (wheel), negative below (roller), Inf for rails
%
% The height is NaN where the surface does not reach.

   if (isinf(radius))
      z = z + 0*x;
      return
   end
   r  = abs(radius) + sign(radius)*z;
   r2 = r.^2 - x.^2;
   r2(r2<0) = NaN;
   z  = sign(radius) * (sqrt(r2) - abs(radius));

end % function revolve
