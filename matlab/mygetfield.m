function [ value ] = mygetfield( s, name )
% MYGETFIELD  A field of a struct whose name may have dots: mygetfield(s, 'kincns.t_digit').
%
% For an array of structs it returns the values of all elements as a row.
%
% See also: mysetfield, myisfield.

   parts = regexp(name, '\.', 'split');
   if (numel(s)>1)
      value = arrayfun(@(one) mygetfield(one, name), s(:)');
   else
      value = getfield(s, parts{:});
   end

end % function mygetfield
