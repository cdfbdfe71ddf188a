function [ index ] = find_text( lines, text )
% FIND_TEXT  Indices of the lines that contain a text.

   index = find(~cellfun('isempty', strfind(lines, text)));

end % function find_text
