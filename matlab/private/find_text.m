function [ index ] = find_text( lines, text )
% FIND_TEXT  Numbers of the lines that hold a text.

   index = find(~cellfun('isempty', strfind(lines, text)));

end % function find_text
