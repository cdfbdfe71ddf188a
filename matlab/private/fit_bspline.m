function [ spl ] = fit_bspline( s, y, z, lambda, wgt, ikinks, iaccel, ds, order, repeat )
% FIT_BSPLINE  Smoothing spline made of B-splines, with the result of MAKE_SPLINE.
%
%   s, y, z, lambda, wgt, ikinks, iaccel   as for MAKE_SPLINE, checked, columns
%   ds       distance of the knots, or []: at the points
%   order    of the derivative that is smoothed, 2 or 3
%   repeat   are the end knots repeated, instead of additional outer knots?

   fixed = unique([1; ikinks; iaccel; numel(s)]);
   at = s;
   if (~isempty(ds))
      at = s(1);
      for i = 1 : numel(fixed)-1
         h = s(fixed(i+1)) - s(fixed(i));
         m = max(1, round(h/ds));
         at = [at; s(fixed(i)) + h*(1:m)'/m];
      end
   end
   % the curvature may jump at double knots, the direction at triple ones
   inner = sort([at(2:end-1); s(iaccel); s(ikinks); s(ikinks)]);
   step  = [at(2)-at(1), at(end)-at(end-1)] * (1-repeat);
   t = [at(1)-(3:-1:0)'*step(1); inner; at(end)+(0:3)'*step(2)];

   b = values(t, s);
   root = sparse(1:numel(s), 1:numel(s), sqrt(wgt));
   g = smoothness(t, at, order);
   % minimum weight of smoothness, for coefficients that are not determined by points
   least = 1e-12 * full(sum(sum((root*b).^2)) / max(sum(sum(g.^2)), realmin));
   rows  = [root*b; sqrt(max(lambda, least))*g];
   spl = struct('s',at, 'tj',t, 'y',[], 'z',[], 'cy',rows \ [root*y; zeros(size(g,1),1)], 'cz',[]);
   spl.y = values(t, at) * spl.cy;
   if (~isempty(z))
      spl.cz = rows \ [root*z; zeros(size(g,1),1)];
      spl.z  = values(t, at) * spl.cz;
   end
   spl = make_ppform(spl);

end % function fit_bspline

%------------------------------------------------------------------------------------------------------

function [ b ] = values( t, s )
% Values of all splines at points

   [~, ~, ~, b] = eval_bspline_basisfnc(t, s);
   b = sparse(b);

end % function values

%------------------------------------------------------------------------------------------------------

function [ g ] = smoothness( t, at, order )
% Rows whose squares sum to the integral of the squared derivative. The second derivative is linear in each piece and integrated by
% the two-point Gauss rule; the third one is constant

   h = diff(at);
   middle = (at(1:end-1)+at(2:end))/2;
   d = bspline_derivative(t, 3) * bspline_derivative(t, 4);
   if (order==2)
      [~, b] = eval_bspline_basisfnc(t, [middle-h/sqrt(12); middle+h/sqrt(12)]);
      w = [h; h]/2;
   else
      b = eval_bspline_basisfnc(t, middle);
      d = bspline_derivative(t, 2) * d;
      w = h;
   end
   g = sparse(1:numel(w), 1:numel(w), sqrt(w)) * (sparse(b) * d);

end % function smoothness
