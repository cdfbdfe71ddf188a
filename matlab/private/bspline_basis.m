function [ b ] = bspline_basis( t, x, derivative )
% BSPLINE_BASIS  Cubic B-splines at points, by the recurrence of Cox and de Boor.
%
%   t           knots, rising
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
   b = zeros(numel(x), n-1);
   for j = 4 : n-4
      if (t(j+1)>t(j))
         last = (j==find(t<t(n-3), 1, 'last'));
         b(:,j) = (x>=t(j) & (x<t(j+1) | (last & x<=t(j+1))));
      end
   end
   for k = 2 : 4
      if (k==4 && derivative)
         b = 3 * differences(b, t, k, 1, -1);
      else
         c = zeros(numel(x), n-k);
         for j = 1 : n-k
            c(:,j) = part(x - t(j), t(j+k-1) - t(j)) .* b(:,j) + part(t(j+k) - x, t(j+k) - t(j+1)) .* b(:,j+1);
         end
         b = c;
      end
   end
   b(outside,:) = NaN;

end % function bspline_basis

%------------------------------------------------------------------------------------------------------

function [ c ] = differences( b, t, k, left, right )

   n = size(b,2) - 1;
   c = zeros(size(b,1), n);
   for j = 1 : n
      c(:,j) = left*part(1, t(j+k-1)-t(j)) * b(:,j) + right*part(1, t(j+k)-t(j+1)) * b(:,j+1);
   end

end % function differences

%------------------------------------------------------------------------------------------------------

function [ q ] = part( above, below )
% A quotient, zero over an interval without length

   q = 0 * above;
   if (below>0)
      q = above / below;
   end

end % function part
