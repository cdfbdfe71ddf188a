function [ d ] = bspline_derivative( t, k )
% BSPLINE_DERIVATIVE  Matrix d that converts coefficients c of a spline of order k to those of its derivative, d * c.
%
%   t   n knots;  d   sparse, (n-k+1) x (n-k)

   n = numel(t);
   m = n - k;
   step = t(k:n) - t(1:m+1);
   f = zeros(m+1, 1);
   f(step>0) = (k-1) ./ step(step>0);
   d = sparse([1:m, 2:m+1], [1:m, 1:m], [f(1:m); -f(2:m+1)], m+1, m);

end % function bspline_derivative
