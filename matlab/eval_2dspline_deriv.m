function [ dx, dy, dz ] = eval_2dspline_deriv( spl2d, u, v, idir, idebug )
% EVAL_2DSPLINE_DERIV  First derivatives of a spline surface.
%
%   [dx, dy, dz] = eval_2dspline_deriv( spl2d, u, v, idir )
%
%   spl2d, u, v   as for EVAL_2DSPLINE
%   idir     1 (default): derivatives with respect to u; 2: to v
%   idebug   accepted for compatibility and ignored
%
% See also: make_2dspline, eval_2dspline.

   if (nargin<4 || isempty(idir))
      idir = 1;
   end
   spl2d = surface_spline(spl2d, 'eval_2dspline_deriv');
   paired = isequal(size(u), size(v));
   order  = [idir==1, idir==2];
   dy = surface_values(spl2d, 'y', u, v, paired, order);
   dz = surface_values(spl2d, 'z', u, v, paired, order);
   if (isfield(spl2d, 'cij_x'))
      dx = surface_values(spl2d, 'x', u, v, paired, order);
   else
      dx = double(idir==1) + 0*dy;
   end

end % function eval_2dspline_deriv
