function [ spl ] = make_ppform( spl, d1, d2, d3 )
% MAKE_PPFORM  Piecewise polynomials of a curve of cubic B-splines.
%
%   spl = make_ppform( spl )
%   spl = make_ppform( spl, d1, d2, d3 )
%
%   spl      struct with s: the beginnings of the pieces and the end; tj: knots; cy, cz: coefficients (cz may be missing or [])
%   d1 ... d3   arrays that convert coefficients into those of the derivative, from order 2, 3 and 4; computed from tj if absent
%
%   spl      the same with ay0 ... ay3, az0 ... az3, see MAKE_SPLINE; those of the last point continue the curve beyond it
%
% See also: make_spline, eval_spline, eval_bspline_basisfnc.

   t = spl.tj(:)';
   if (nargin<2 || isempty(d1)), d1 = bspline_derivative(t, 2); end
   if (nargin<3 || isempty(d2)), d2 = bspline_derivative(t, 3); end
   if (nargin<4 || isempty(d3)), d3 = bspline_derivative(t, 4); end
   % the curve ends at its last complete knots
   s = min(max(spl.s(:), t(4)), t(end-3));
   [b1, b2, b3, b4] = eval_bspline_basisfnc(t, s);
   for name = 'yz'
      if (~isfield(spl, ['c' name]) || isempty(spl.(['c' name])))
         continue
      end
      c = spl.(['c' name])(:);
      spl.(['a' name '0']) = b4 * c;
      spl.(['a' name '1']) = b3 * (d3*c);
      spl.(['a' name '2']) = b2 * (d2*(d3*c)) / 2;
      spl.(['a' name '3']) = b1 * (d1*(d2*(d3*c))) / 6;
   end

end % function make_ppform
