function [ s ] = empty_arrays( names, nrow, ncol )
% EMPTY_ARRAYS  Struct of arrays filled with NaN, for values that a file does not have.

   s = struct();
   for k = 1 : numel(names)
      s.(names{k}) = NaN(nrow, ncol);
   end

end % function empty_arrays
