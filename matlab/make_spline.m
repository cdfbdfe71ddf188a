function [ spl ] = make_spline( s, y, z, lambda, wgt, ikinks, iaccel, use_bspline, ds_bspl, use_deriv, use_repl, idebug )
% MAKE_SPLINE  Cubic smoothing spline through the points of a curve.
%
%   spl = make_spline( s, y, z, lambda, wgt, ikinks )
%
%   s        positions of the points along the curve, increasing; [] (default): sums of chords of y and z
%   y, z     values, vectors of the same length; z = [] for one function y(s)
%   lambda   weight of smoothness; 0 (default): interpolation of all points. The spline minimises the sum of wgt (y - y_i)^2 plus
%            lambda times the integral of the squared second derivative along s, for y and z
%   wgt      weights of the points (default 1)
%   ikinks   numbers of points at which the direction may jump (default none)
%   iaccel   numbers of points at which the curvature may jump (default none). They occur with use_deriv = 3 or with
%            knots other than the points; otherwise the smoothest curve has no such jumps
%   use_bspline   1: the curve is made of B-splines; 0 (default): only if iaccel, ds_bspl or use_deriv = 3 need it
%   ds_bspl  approximate distance of their knots; [] (default): a knot at each point
%   use_deriv     2 (default): the second derivative is smoothed; 3: the third
%   use_repl      outer knots: 1 (default): end knots repeated four times; 0: three more at the first and last distance. The curve
%                 is the same
%   idebug   accepted for compatibility and ignored
%
% Ends are natural, also at kinks. B-splines with a knot at each point give the same curve. If knots are closer than points and
% lambda is 0, the result is the smoothest curve through the points.
%
%   spl      struct with s, y, z of points on the spline (those given, or the knots), ikinks, iaccel, and for each piece, with
%            d = s - s(i): y = a0y(i) + a1y(i) d + a2y(i) d^2 + a3y(i) d^3, the same with a0z ... a3z; also as
%            ay0 ... az3, the names of other scripts. For B-splines also tj: knots; cy, cz: coefficients
%
% See also: eval_spline, smooth_profile, make_ppform, read_profile.

   if (nargin<3), z = []; end
   if (nargin<4 || isempty(lambda)), lambda = 0; end
   if (nargin<5), wgt = []; end
   if (nargin<6), ikinks = []; end
   if (nargin<7), iaccel = []; end
   if (nargin<8 || isempty(use_bspline)), use_bspline = 0; end
   if (nargin<9), ds_bspl = []; end
   if (nargin<10 || isempty(use_deriv)), use_deriv = 2; end
   if (nargin<11 || isempty(use_repl)), use_repl = 1; end
   if (~any(use_deriv==[2 3]))
      error('make_spline: use_deriv must be 2 or 3.');
   elseif (~isempty(ds_bspl) && ~(isscalar(ds_bspl) && isfinite(ds_bspl)))
      error('make_spline: ds_bspl must be a positive number.');
   end
   ds_bspl(ds_bspl<=0) = [];
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
      error('make_spline: s, y and z must have the same number of points, at least 2, and s must increase.');
   end
   if (~(isscalar(lambda) && lambda>=0 && isfinite(lambda)))
      error('make_spline: lambda must not be negative.');
   end
   if (isempty(wgt))
      wgt = ones(n, 1);
   end
   wgt = wgt(:);
   if (numel(wgt)~=n || any(~(wgt>0)))
      error('make_spline: wgt must have a positive value for each of the %d points.', n);
   end
   ikinks = unique(ikinks(ikinks>1 & ikinks<n));
   iaccel = setdiff(iaccel(iaccel>1 & iaccel<n), ikinks);
   if (use_bspline>0 || ~isempty(iaccel) || ~isempty(ds_bspl) || use_deriv==3)
      spl = fit_bspline(s, y, z, lambda, wgt, ikinks(:), iaccel(:), ds_bspl, use_deriv, use_repl>0);
   else
      spl = struct('s',s, 'y',y, 'z',z);
      for name = 'yz'
         if (isempty(spl.(name)))
            continue
         end
         [spl.(name), a] = pieces(s, spl.(name), lambda, wgt, [1; ikinks(:); n]);
         for k = 0 : 3
            spl.(sprintf('a%s%d', name, k)) = a(:,k+1);
         end
      end
   end
   spl.ikinks = ikinks(:)';
   spl.iaccel = iaccel(:)';
   for name = 'yz'
      for k = 0 : 3
         if (isfield(spl, sprintf('a%s%d', name, k)))
            spl.(sprintf('a%d%s', k, name)) = spl.(sprintf('a%s%d', name, k));
         end
      end
   end

end % function make_spline

%------------------------------------------------------------------------------------------------------

function [ f, a ] = pieces( s, y, lambda, wgt, ends )
% Values and coefficients of the smoothing spline: Reinsch's equations for the sections between kinks, joined by the values at
% the kinks (all sections in one system)

   n = numel(s);
   h = diff(s);
   % second derivatives are unknown at inner points of a section
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
