function [ names ] = names_of( axnams )
% NAMES_OF  Names of three axes from three letters, rows of an array, or a cell array.

   if (~iscell(axnams))
      if (size(axnams,1)==1)
         axnams = axnams(:);
      end
      axnams = cellstr(axnams);
   end
   names = [strtrim(axnams(:)); {'';'';''}];
   names = names(1:3);

end % function names_of
