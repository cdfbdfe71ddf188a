function [ v ] = heading_values( lines, i )
% HEADING_VALUES  Numbers of line i+1 as a struct, named by the column headings in line i.
%
% Names are in lower case, with _ for characters other than letters and digits: FX/FSTAT/FN becomes fx_fstat_fn.

   % the headings of successive cases or patches are mostly the same
   persistent heading names
   if (isempty(names) || ~strcmp(lines{i}, heading))
      heading = lines{i};
      words = regexp(strtrim(regexprep(heading, '(CREEP|SHIFT) ([XY])', '$1_$2')), '\s+', 'split');
      names = regexprep(lower(regexprep(words, '[^A-Za-z0-9]+', '_')), '_$', '');
   end
   values = sscanf(lines{i+1}, '%f');
   v = struct();
   for k = 1 : min(numel(names), numel(values))
      v.(names{k}) = values(k);
   end

end % function heading_values
