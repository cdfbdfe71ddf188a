function [ args ] = line_options( color, width )
% LINE_OPTIONS  Arguments of plotting functions for a colour and an optional line width.

   args = {'color', color};
   if (~isempty(width))
      args = [args, {'linewidth', width}];
   end

end % function line_options
