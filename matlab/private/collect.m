function [ s ] = collect( s, i, j, names, v, from )
% COLLECT  Put numbers of a struct of HEADING_VALUES into arrays of a struct, at row i and column j.
%
%   names   fields of s
%   from    names in v, one for each field; a cell array holds alternatives, the first that exists is taken

   for k = 1 : numel(names)
      alternatives = from{k};
      if (ischar(alternatives))
         alternatives = {alternatives};
      end
      for a = 1 : numel(alternatives)
         if (isfield(v, alternatives{a}))
            s.(names{k})(i,j) = v.(alternatives{a});
            break
         end
      end
   end

end % function collect
