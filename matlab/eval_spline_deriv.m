function [ dy, ddy, dz, ddz, kappa, rcurv ] = eval_spline_deriv( spl, s, idebug )
% EVAL_SPLINE_DERIV  Derivatives and curvature of a spline of MAKE_SPLINE.
%
%   [dy, ddy, dz, ddz, kappa, rcurv] = eval_spline_deriv( spl, s )
%
%   spl      struct of make_spline, with y and z
%   s        positions along the curve (default: those of its points); beyond its ends the end points are used
%   idebug   accepted for compatibility and ignored
%
%   dy, ddy, dz, ddz   first and second derivatives with respect to s
%   kappa    curvature (y' z'' - z' y'') / (y'^2 + z'^2)^(3/2) [1/mm]
%   rcurv    its radius [mm], at most 1e6
%
% See also: make_spline, eval_spline.

   if (nargin<2 || isempty(s))
      s = spl.s;
   end
   if (isempty(spl.z))
      error('eval_spline_deriv: the spline has no z.');
   end
   dy  = spline_values(spl, 'y', s, 1);
   ddy = spline_values(spl, 'y', s, 2);
   dz  = spline_values(spl, 'z', s, 1);
   ddz = spline_values(spl, 'z', s, 2);
   kappa = (dy.*ddz - dz.*ddy) ./ (dy.^2 + dz.^2).^1.5;
   least = 1e-6;
   rcurv = 1 ./ kappa;
   flat  = (abs(kappa)<least);
   rcurv(flat) = sign(kappa(flat)) / least;

end % function eval_spline_deriv
