function check_same_struct( value, expected, digits, what )
% CHECK_SAME_STRUCT  Stop unless two structs have the same fields in the same order, of the same class and shape, and
% the same values to a number of digits; where NaN is expected every value is accepted.

   check(numel(value)==numel(expected), ['number of ' what]);
   if (numel(expected)>1)
      for i = 1 : numel(expected)
         check_same_struct(value(i), expected(i), digits, sprintf('%s(%d)', what, i));
      end
      return
   end
   names = fieldnames(expected);
   check(isequal(fieldnames(value), names), ['fields of ' what]);
   for i = 1 : numel(names)
      a = value.(names{i});
      b = expected.(names{i});
      where = [what '.' names{i}];
      check(strcmp(class(a),class(b)) && isequal(size(a),size(b)), ['kind and shape of ' where]);
      if (isstruct(b))
         check_same_struct(a, b, digits, where);
      else
         known = ~isnan(b);
         check_near(a(known), b(known), 0.6*10^(1-digits)*max([0; abs(b(known)(:))]), where);
      end
   end

end % function check_same_struct
