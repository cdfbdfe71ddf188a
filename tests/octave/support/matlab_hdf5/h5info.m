function [ info ] = h5info( fname, path )
% H5INFO  Result of Matlab's function of this name for a top-level group of a file.

   found = load(fname, path(2:end));
   info  = describe(path, found.(path(2:end)));

end % function h5info

%------------------------------------------------------------------------------------------------------

function [ info ] = describe( path, group )

   info = struct('Name',path, 'Groups',[], 'Datasets',[]);
   names = fieldnames(group);
   for i = 1 : numel(names)
      if (isstruct(group.(names{i})))
         info.Groups = [info.Groups; describe([path '/' names{i}], group.(names{i}))];
      else
         info.Datasets = [info.Datasets; struct('Name',names{i})];
      end
   end

end % function describe
