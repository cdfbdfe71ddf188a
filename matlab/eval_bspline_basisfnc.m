function [ varargout ] = eval_bspline_basisfnc( tj, si, k, idebug )
% EVAL_BSPLINE_BASISFNC  B-splines of all orders up to k at points, by the recurrence of Cox and de Boor.
%
%   [b1, b2, b3, b4] = eval_bspline_basisfnc( tj, si, k )
%
%   tj       knots, non-decreasing; a repeated knot makes splines less smooth
%   si       points; beyond the knots all splines are zero
%   k        order, 1 to 8; 4 (default): cubic splines
%   idebug   accepted for compatibility and ignored
%
%   b1 ... bk   for each order m an array numel(si) x (numel(tj)-m): one row per point, one column per spline. Values at a knot
%               are limits from the right, at the last knot from the left
%
% See also: make_spline, make_ppform, make_2dspline.

   if (nargin<3 || isempty(k))
      k = 4;
   end
   t = tj(:)';
   x = si(:);
   if (numel(t)<=k || any(diff(t)<0) || ~(t(end)>t(1)))
      error('eval_bspline_basisfnc: order %d needs more than %d non-decreasing knots.', k, k);
   elseif (nargout>k)
      error('eval_bspline_basisfnc: %d outputs are requested, the order is %d.', nargout, k);
   end
   n = numel(t);
   b = zeros(numel(x), n-1);
   last = find(t<t(n), 1, 'last');
   for j = find(diff(t)>0)
      b(:,j) = (x>=t(j) & (x<t(j+1) | (j==last & x<=t(j+1))));
   end
   beyond = @(knots) bsxfun(@minus, x, knots);
   varargout = cell(1, k);
   varargout{1} = b;
   for m = 2 : k
      rise = t(m:n-1) - t(1:n-m);
      fall = t(m+1:n) - t(2:n-m+1);
      % zero over an interval of zero length
      rise(rise==0) = Inf;
      fall(fall==0) = Inf;
      b = bsxfun(@rdivide, beyond(t(1:n-m)), rise) .* b(:,1:n-m) - bsxfun(@rdivide, beyond(t(m+1:n)), fall) .* b(:,2:n-m+1);
      varargout{m} = b;
   end

end % function eval_bspline_basisfnc
