function [ u, found ] = solve_cubic_eq( ppcoef, useg, yev, varargin )
% SOLVE_CUBIC_EQ  Position at which one piece of a spline has a given value.
%
%   [u, found] = solve_cubic_eq( ppcoef, useg, yev )
%
%   ppcoef   [a0 a1 a2 a3] of the piece a0 + a1 d + a2 d^2 + a3 d^3, with d = u - useg(1)
%   useg     its beginning and end
%   yev      the value; further arguments of other scripts (idebug, iout, jout, jseg) have no effect
%
%   u        the first such position in useg, NaN if there is none;  found   1: found; 0: none
%
% See also: eval_spline, make_ppform.

   h = useg(2) - useg(1);
   a = [ppcoef(1)-yev, ppcoef(2)*h, ppcoef(3)*h^2, ppcoef(4)*h^3];
   u = NaN;
   % a cubic is within the convex hull of its Bernstein coefficients
   b = [a(1), a(1)+a(2)/3, a(1)+2*a(2)/3+a(3)/3, sum(a)];
   slack = 1e-12 * max(abs(a));
   if (min(b)<=slack && max(b)>=-slack)
      d = roots(a(end:-1:1));
      if (all(a==0))
         d = 0;
      end
      d = real(d(abs(imag(d))<=1e-9*max(1,abs(d))));
      d = d(d>=-1e-9 & d<=1+1e-9);
      if (~isempty(d))
         u = useg(1) + h*min(max(min(d), 0), 1);
      end
   end
   found = double(~isnan(u));

end % function solve_cubic_eq
