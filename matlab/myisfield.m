function [ there ] = myisfield( s, name )
% MYISFIELD  Whether a struct has a field whose name may have dots: myisfield(s, 'kincns.t_digit').
%
% See also: mygetfield, mysetfield.

   there = true;
   parts = regexp(strtrim(name), '\.', 'split');
   for i = 1 : numel(parts)
      if (isempty(parts{i}))
         continue
      end
      there = isstruct(s) && isfield(s, parts{i});
      if (~there)
         return
      end
      s = s.(parts{i});
   end

end % function myisfield
