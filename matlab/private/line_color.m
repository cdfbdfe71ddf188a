function [ col ] = line_color( col )
% LINE_COLOR  Colour for plot: a name or [red green blue] unchanged, a number by MATLAB_COLOR, [] is blue.

   if (isempty(col))
      col = 'b';
   elseif (isnumeric(col) && isscalar(col))
      col = matlab_color(col);
   end

end % function line_color
