function [ values, skipped ] = number_rows( lines, ncol, allowed )
% NUMBER_ROWS  Numbers in lines of text as rows of an array.
%
%   lines     cell array
%   ncol      number of values read from each line
%   allowed   largest number of values of an accepted line; lines with fewer than ncol are not accepted
%
%   values    n x ncol array
%   skipped   number of lines that were not accepted

   [v, count] = sscanf(sprintf('%s\n', lines{:}), '%f');
   first = 0;
   if (~isempty(lines))
      first = numel(sscanf(lines{1}, '%f'));
   end
   % all lines have the same number of values: the usual and fast case
   if (first>=ncol && first<=allowed && count==first*numel(lines) && all_alike(lines, first))
      values = reshape(v, first, numel(lines))';
      values = values(:,1:ncol);
      skipped = 0;
      return
   end
   values = zeros(numel(lines), ncol);
   n = 0;
   for i = 1 : numel(lines)
      v = sscanf(lines{i}, '%f');
      if (numel(v)>=ncol && numel(v)<=allowed)
         n = n + 1;
         values(n,:) = v(1:ncol)';
      end
   end
   values  = values(1:n,:);
   skipped = numel(lines) - n;

end % function number_rows

%------------------------------------------------------------------------------------------------------

function [ alike ] = all_alike( lines, n )
% Does each line have n words?

   pattern = ['^\s*\S+', repmat('\s+\S+', 1, n-1), '\s*$'];
   alike = ~any(cellfun('isempty', regexp(lines, pattern, 'once')));

end % function all_alike
