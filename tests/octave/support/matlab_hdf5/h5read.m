function [ value ] = h5read( fname, path )
% H5READ  Result of Matlab's function of this name: vectors are columns, texts are in cells.

   persistent from group content
   names = strsplit(path(2:end), '/');
   if (~isequal(from, fname) || ~isequal(group, names{1}))
      content = load(fname, names{1});
      from    = fname;
      group   = names{1};
   end
   value = content;
   for i = 1 : numel(names)
      value = value.(names{i});
   end
   if (ischar(value))
      value = {value};
   elseif (isvector(value))
      value = value(:);
   end

end % function h5read
