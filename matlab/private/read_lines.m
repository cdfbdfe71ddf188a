function [ lines ] = read_lines( fname, caller )
% READ_LINES  Lines of a text file in a cell array.

   f = fopen(fname, 'r');
   if (f<0)
      error('%s: cannot open "%s".', caller, fname);
   end
   txt = fread(f, Inf, 'char=>char')';
   fclose(f);
   lines = regexp(txt, '\r\n|\r|\n', 'split');

end % function read_lines
