function [ varargout ] = guarded( fname, caller, work )
% GUARDED  Results of a function that reads a file; its errors become one sentence that names the file.
%
%   fname    name of the file
%   caller   name of the script that was called
%   work     function without arguments

   try
      [varargout{1:max(1,nargout)}] = work();
   catch reason
      text = reason.message;
      if (isempty(strfind(text, '"')))
         text = sprintf('%s: "%s" is damaged or has another format: %s', caller, fname, strtrim(regexprep(text, '\s+', ' ')));
      end
      error('%s', text);
   end

end % function guarded
