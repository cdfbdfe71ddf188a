function [ black ] = is_black( name )
% IS_BLACK  Does this colormap of PLOT3D select black lines on white?

   black = ischar(name) && any(strcmp(name, {'none','black'}));

end % function is_black
