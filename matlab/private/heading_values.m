function [ v ] = heading_values( lines, i )
% HEADING_VALUES  Numbers of line i+1 as a struct, named by the column headings in line i.
%
% Names are in lower case, with _ for characters other than letters and digits: FX/FSTAT/FN becomes fx_fstat_fn.

   heading = regexprep(lines{i}, '(CREEP|SHIFT) ([XY])', '$1_$2');
   names   = regexp(strtrim(heading), '\s+', 'split');
   values  = sscanf(lines{i+1}, '%f');
   v = struct();
   for k = 1 : min(numel(names), numel(values))
      name = lower(regexprep(names{k}, '[^A-Za-z0-9]+', '_'));
      v.(regexprep(name, '_$', '')) = values(k);
   end

end % function heading_values
