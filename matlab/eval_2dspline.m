function [ v, x, y, z ] = eval_2dspline( spl2d, u_in, v_in, y_in, idebug )
% EVAL_2DSPLINE  Points of a spline surface, at given u and v or at given u and y.
%
%   [v, x, y, z] = eval_2dspline( spl2d, u, v )
%   [v, x, y, z] = eval_2dspline( spl2d, u, [], y )
%
%   spl2d    struct of MAKE_2DSPLINE, or of READ_SLICES: then v runs from 0 to 1 between the ends of the slices
%   u, v, y  of equal size: one point for each pair; else all u with all v or y, in numel(u) x numel(v) arrays
%   idebug   accepted for compatibility and ignored
%
% Values are NaN outside the surface, and if no v has the given y. If several v have it, the smallest is used.
%
% See also: make_2dspline, eval_2dspline_deriv, plot_2dspline.

   if (nargin<3), v_in = []; end
   if (nargin<4), y_in = []; end
   if (isempty(v_in) == isempty(y_in))
      error('eval_2dspline: either v or y is needed.');
   end
   spl2d = surface_spline(spl2d, 'eval_2dspline');
   if (isempty(v_in))
      v = places_of(spl2d, u_in, y_in);
      y = y_in;
      [x, ~, z] = points(spl2d, u_in, v, true);
      return
   end
   v = v_in;
   [x, y, z] = points(spl2d, u_in, v_in, isequal(size(u_in), size(v_in)));

end % function eval_2dspline

%------------------------------------------------------------------------------------------------------

function [ x, y, z ] = points( spl2d, u, v, one_by_one )
% Coordinates; an array v with a row for each u is evaluated pair by pair, too

   if (one_by_one && ~isequal(size(u), size(v)))
      u = repmat(u(:), 1, size(v,2));
   end
   x = NaN;
   y = surface_values(spl2d, 'y', u, v, one_by_one, [0 0]);
   z = surface_values(spl2d, 'z', u, v, one_by_one, [0 0]);
   if (isfield(spl2d, 'cij_x'))
      x = surface_values(spl2d, 'x', u, v, one_by_one, [0 0]);
   elseif (one_by_one)
      x = u + 0*y;
   else
      x = bsxfun(@plus, u(:), 0*y);
   end

end % function points

%------------------------------------------------------------------------------------------------------

function [ v ] = places_of( spl2d, u, y )
% v at given y: on lines of the surface, by bisection between knots and the midpoints between knots

   paired = isequal(size(u), size(y));
   if (paired)
      v = NaN(size(u));
   else
      v = NaN(numel(u), numel(y));
   end
   at = spl2d.tvj(4:end-3);
   at = unique([at; (at(1:end-1)+at(2:end))/2]);
   bu = bspline_basis(spl2d.tui, u(:), 0);
   bv = bspline_basis(spl2d.tvj, at, 0);
   c  = bu * spl2d.cij_y;
   line = c * bv';
   line(bu*(1-spl2d.mask_j)*bv' > 1e-15) = NaN;
   for i = 1 : numel(u)
      if (paired)
         v(i) = root(spl2d.tvj, c(i,:), at, line(i,:), y(i));
      else
         for j = 1 : numel(y)
            v(i,j) = root(spl2d.tvj, c(i,:), at, line(i,:), y(j));
         end
      end
   end

end % function places_of

%------------------------------------------------------------------------------------------------------

function [ r ] = root( knots, coef, at, values, wanted )
% First position of a value on a line whose values are known at some positions

   r = NaN;
   k = find((values(1:end-1)-wanted).*(values(2:end)-wanted)<=0, 1);
   if (~isempty(k))
      r = fzero(@(s) bspline_basis(knots, s, 0)*coef' - wanted, at([k k+1]));
   end

end % function root
