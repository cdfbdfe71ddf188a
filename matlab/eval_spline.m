function [ s, y, z ] = eval_spline( spl, s_in, y_in, idebug )
% EVAL_SPLINE  Points on a spline of MAKE_SPLINE, at given positions or at given y.
%
%   [s, y, z] = eval_spline( spl, s_in )
%   [s, y, z] = eval_spline( spl, [], y_in )
%
%   spl      struct of make_spline
%   s_in     positions along the curve; beyond its ends the end points are used
%   y_in     values of y; the first position from the start of the spline with this value is returned, NaN if there is none
%   idebug   accepted for compatibility and ignored
%
%   s, y, z  arrays like the input; z is [] for a spline without z
%
% See also: make_spline, eval_spline_deriv.

   if (nargin<2), s_in = []; end
   if (nargin<3), y_in = []; end
   if (isempty(s_in) == isempty(y_in))
      error('eval_spline: either positions s_in or values y_in are needed.');
   end
   s = s_in;
   if (isempty(s))
      s = reshape(arrayfun(@(v) position_of(spl, v), y_in), size(y_in));
   end
   y = y_in;
   if (isempty(y))
      y = spline_values(spl, 'y', s, 0);
   end
   z = [];
   if (~isempty(spl.z))
      z = spline_values(spl, 'z', s, 0);
   end

end % function eval_spline

%------------------------------------------------------------------------------------------------------

function [ s ] = position_of( spl, v )
% The first root of y(s) = v

   for i = 1 : numel(spl.s)-1
      [s, found] = solve_cubic_eq([spl.a0y(i) spl.a1y(i) spl.a2y(i) spl.a3y(i)], spl.s([i i+1]), v);
      if (found)
         return
      end
   end

end % function position_of
