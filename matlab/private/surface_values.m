function [ f ] = surface_values( spl2d, name, u, v, one_by_one, order )
% SURFACE_VALUES  One coordinate of a spline surface, or a derivative.
%
%   name        'x', 'y' or 'z'
%   one_by_one  are u and v pairs? Otherwise all u are combined with all v
%   order       [0 0]: values; [1 0], [0 1]: derivatives with respect to u, to v

   c  = spl2d.(['cij_' name]);
   bu = bspline_basis(spl2d.tui, u, order(1));
   bv = bspline_basis(spl2d.tvj, v, order(2));
   f  = combined(bu, c, bv, one_by_one, v);
   gaps = 1 - spl2d.mask_j;
   if (any(gaps(:)))
      bu = bspline_basis(spl2d.tui, u, 0);
      bv = bspline_basis(spl2d.tvj, v, 0);
      f(combined(bu, gaps, bv, one_by_one, v) > 1e-15) = NaN;
   end

end % function surface_values

%------------------------------------------------------------------------------------------------------

function [ f ] = combined( bu, c, bv, one_by_one, v )

   if (one_by_one)
      f = reshape(sum((bu*c).*bv, 2), size(v));
   else
      f = bu * c * bv';
   end

end % function combined
