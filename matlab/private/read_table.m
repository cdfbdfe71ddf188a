function [ table, comments ] = read_table( fname )
% READ_TABLE  Numbers of a text file with comment lines (%) and the same number of columns on each line.
%
%   comments   cell array of the comment lines, at least one

   lines = read_lines(fname, 'read_table');
   keep  = ~cellfun('isempty', regexp(lines, '^\s*[^%\s]', 'once'));
   comments = [lines(~keep), {''}];
   lines = lines(keep);
   if (isempty(lines))
      table = [];
      return
   end
   ncol = numel(sscanf(lines{1}, '%f'));
   [numbers, count] = sscanf(sprintf('%s\n', lines{:}), '%f');
   if (ncol==0 || count~=ncol*numel(lines))
      error('read_table: "%s" does not have %d numbers on each line.', fname, ncol);
   end
   table = reshape(numbers, ncol, numel(lines))';

end % function read_table
