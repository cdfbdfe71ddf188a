function [ rgb ] = matlab_color( num )
% MATLAB_COLOR  Line colours in Matlab's order, one row of red, green, blue for each number.
%
%   rgb = matlab_color( num )
%
%   num   numbers from 1; the colours repeat cyclically
%
% See also: plot_arrow, plot_cm.

   % the order of Matlab since R2014b
   order = [   0, 114, 189
             217,  83,  25
             237, 177,  32
             126,  47, 142
             119, 172,  48
              77, 190, 238
             162,  20,  47 ] / 255;
   rgb = order(mod(num(:)-1, size(order,1))+1, :);

end % function matlab_color
