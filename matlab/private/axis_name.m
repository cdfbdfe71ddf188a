function [ h ] = axis_name( at, name, fontsiz, col, angle )
% AXIS_NAME  Write the name of a coordinate axis; names in dollar signs are formulae.
%
%   at      position of its centre, 2 or 3 numbers
%   angle   of the text [deg]

   how = 'tex';
   if (any(name=='$'))
      how = 'latex';
   end
   at = num2cell(at);
   h  = text(at{:}, name, 'rotation',angle, 'fontsize',fontsiz, 'color',col, 'horizontalalignment','center', 'interpreter',how);

end % function axis_name
