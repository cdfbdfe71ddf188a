function [ c, h ] = filled_contours( x, y, val, levels )
% FILLED_CONTOURS  CONTOURF, and one colour if there is no contour to draw: for a constant field, or if all values are below, or
% all above, the requested levels. Then c is empty.
%
%   x, y     positions of the values
%   val      values, one row for each y
%   levels   as in CONTOURF; optional

   low  = min(val(:));
   high = max(val(:));
   if (high>low && (nargin<4 || isscalar(levels) || any(levels>=low & levels<=high)))
      if (nargin<4)
         [c, h] = contourf(x, y, val);
      else
         [c, h] = contourf(x, y, val, levels);
      end
   else
      c = [];
      h = surf(x, y, zeros(size(val)), val, 'edgecolor','none', 'facecolor','interp');
   end

end % function filled_contours
