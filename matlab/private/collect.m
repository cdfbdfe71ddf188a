function [ s ] = collect( s, i, j, names, v, from )
% COLLECT  Store values of a struct of HEADING_VALUES in arrays of a struct, at row i and column j.
%
%   names   fields of s
%   from    names in v, one for each field; a cell array has alternatives, of which the first that exists is used

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
