function [ f ] = open_for_writing( fname, caller )
% OPEN_FOR_WRITING  File identifier of a new text file.

   f = fopen(fname, 'w');
   if (f<0)
      error('%s: cannot write "%s".', caller, fname);
   end

end % function open_for_writing
