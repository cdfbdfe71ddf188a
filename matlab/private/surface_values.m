function [ f ] = surface_values( spl2d, name, u, v, one_by_one, order )
% SURFACE_VALUES  One coordinate of a surface of splines, or a derivative.
%
%   name        'x', 'y' or 'z'
%   one_by_one  are u and v pairs? Otherwise all u are combined with all v
%   order       [0 0]: values; [1 0], [0 1]: derivatives to u, to v

   c  = spl2d.(['cij_' name]);
   bu = bspline_basis(spl2d.tui, u, order(1));
   bv = bspline_basis(spl2d.tvj, v, order(2));
   if (one_by_one)
      f = reshape(sum((bu*c).*bv, 2), size(v));
   else
      f = bu * c * bv';
   end

end % function surface_values
