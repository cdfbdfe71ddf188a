function [ spl ] = make_spline( s, y, z, lambda, wgt, ikinks, iaccel, use_bspline, ds_bspl, use_deriv, use_repl, idebug )
% MAKE_SPLINE  Cubic smoothing spline through the points of a curve.
%
%   spl = make_spline( s, y, z, lambda, wgt, ikinks )
%
%   s        places of the points along the curve, rising; [] (default): sums of chords of y and z
%   y, z     values, vectors of the same length; z = [] for one function y(s)
%   lambda   weight of smoothness; 0 (default): through all points. The spline makes the sum of wgt (y - y_i)^2 and lambda times
%            the integral of the squared second derivative along s as small as possible, for y and z alike
%   wgt      weights of the points (default 1)
%   ikinks   numbers of points at which the direction may jump (default none)
%   idebug   for scripts that give it; nothing is printed
%
% Natural ends, also at kinks. Jumps of the curvature (iaccel), B-splines (use_bspline, ds_bspl, use_repl) and the third derivative
% (use_deriv = 3) are not built and are refused.
%
%   spl      struct with s, y, z of the points on the spline, ikinks, and for each piece, with d = s - s(i):
%            y = a0y(i) + a1y(i) d + a2y(i) d^2 + a3y(i) d^3, the same with a0z ... a3z; also as
%            ay0 ... az3, as other scripts have them
%
% See also: eval_spline, smooth_profile, read_profile.

   if (nargin<3), z = []; end
   if (nargin<4 || isempty(lambda)), lambda = 0; end
   if (nargin<5), wgt = []; end
   if (nargin<6), ikinks = []; end
   refused = {'iaccel', 7; 'use_bspline', 8; 'ds_bspl', 9};
   for i = 1 : size(refused,1)
      if (nargin>=refused{i,2} && ~isempty(eval(refused{i,1})) && any(eval(refused{i,1})>0))
         error('make_spline: %s is not built; splines are smoothed in their curvature, with kinks.', refused{i,1});
      end
   end
   if (nargin>=10 && ~isempty(use_deriv) && use_deriv~=2)
      error('make_spline: use_deriv = %d is not built; the second derivative is smoothed.', use_deriv);
   end
   y = y(:);
   z = z(:);
   n = numel(y);
   if (isempty(s))
      if (isempty(z))
         error('make_spline: without s both y and z are needed.');
      end
      s = chord_sums(y, z);
   end
   s = s(:);
   if (n<2 || numel(s)~=n || (~isempty(z) && numel(z)~=n) || any(~isfinite([s; y; z])) || any(diff(s)<=0))
      error('make_spline: s, y and z must have the same number of points, at least 2, and s must rise.');
   end
   if (~(isscalar(lambda) && lambda>=0 && isfinite(lambda)))
      error('make_spline: lambda must be a number that is not negative.');
   end
   if (isempty(wgt))
      wgt = ones(n, 1);
   end
   wgt = wgt(:);
   if (numel(wgt)~=n || any(~(wgt>0)))
      error('make_spline: wgt must have a positive number for each of the %d points.', n);
   end
   ikinks = unique(ikinks(ikinks>1 & ikinks<n));
   spl = struct('s',s, 'y',y, 'z',z, 'ikinks',ikinks(:)');
   for name = 'yz'
      if (isempty(spl.(name)))
         continue
      end
      [spl.(name), a] = pieces(s, spl.(name), lambda, wgt, [1; ikinks(:); n]);
      for k = 0 : 3
         spl.(sprintf('a%d%s', k, name)) = a(:,k+1);
         spl.(sprintf('a%s%d', name, k)) = a(:,k+1);
      end
   end

end % function make_spline

%------------------------------------------------------------------------------------------------------

function [ f, a ] = pieces( s, y, lambda, wgt, ends )
% Values and coefficients of the smoothing spline: Reinsch's equations for the stretches between kinks, joined by the values at
% the kinks (all stretches in one system)

   n = numel(s);
   h = diff(s);
   % second derivatives are unknown at points that are no ends of a stretch
   inner = setdiff((2:n-1)', ends);
   m = numel(inner);
   k = (1:m)';
   left  = h(inner-1);
   right = h(inner);
   Q = sparse([inner-1; inner; inner+1], [k; k; k], [1./left; -1./left-1./right; 1./right], n, m);
   neighbours = [false; diff(inner)==1];
   off = find(neighbours);
   R = sparse(k, k, (left+right)/3, m, m) + sparse([off; off-1], [off-1; off], [h(inner(off)-1); h(inner(off)-1)]/6, m, m);
   D = sparse(1:n, 1:n, 1./wgt);
   f = y;
   g = zeros(n, 1);
   if (m>0)
      g(inner) = (R + lambda*(Q'*D*Q)) \ (Q'*y);
      f = y - lambda*(D*(Q*g(inner)));
   end
   a = [f(1:n-1), diff(f)./h - h.*(2*g(1:n-1)+g(2:n))/6, g(1:n-1)/2, diff(g)./(6*h)];

end % function pieces
