function [ b ] = bspline_basis( t, x, derivative )
% BSPLINE_BASIS  Cubic B-splines at points in the interval in which their basis is complete.
%
%   t           knots, increasing
%   x           column of points; those outside of t(4) ... t(end-3) give rows of NaN
%   derivative  0: values; 1: first derivatives
%
%   b           numel(x) x (numel(t)-4) array

   t = t(:)';
   x = x(:);
   n = numel(t);
   slack   = 1e-10 * (t(n-3) - t(4));
   outside = ~(x>=t(4)-slack & x<=t(n-3)+slack);
   x = min(max(x, t(4)), t(n-3));
   x(outside) = t(4);
   [~, ~, b3, b] = eval_bspline_basisfnc(t, x);
   if (derivative)
      b = b3 * bspline_derivative(t, 4);
   end
   b(outside,:) = NaN;

end % function bspline_basis
