function [ fname ] = with_extension( fname, ext )
% WITH_EXTENSION  Add an extension to a file name that has none, unless a file of exactly this name exists.

   [~, ~, e] = fileparts(fname);
   if (~strcmp(e, ext) && exist(fname,'file')~=2)
      fname = [fname, ext];
   end

end % function with_extension
