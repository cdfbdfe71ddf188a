function [ g ] = hdf5_group( fname, group, wanted )
% HDF5_GROUP  A top-level group of an HDF5 file as nested structs; [] if there is none of that name.
%
%   fname    name of the file
%   group    name of the group, without /
%   wanted   optional: cell array of the required groups and datasets in it; Octave reads all

   g = [];
   if (exist('h5info','file')==0)
      % Octave without Matlab's functions
      try
         found = load(fname, group);
         g = found.(group);
      catch
         % there is no such group
      end
      return
   end
   try
      info = h5info(fname, ['/' group]);
   catch
      return
   end
   g = struct();
   for k = 1 : numel(info.Groups)
      name = last_name(info.Groups(k).Name);
      if (nargin<3 || any(strcmp(name, wanted)))
         g.(name) = read_group(fname, info.Groups(k));
      end
   end
   for k = 1 : numel(info.Datasets)
      name = info.Datasets(k).Name;
      if (nargin<3 || any(strcmp(name, wanted)))
         g.(name) = h5read(fname, [info.Name '/' name]);
      end
   end

end % function hdf5_group

%------------------------------------------------------------------------------------------------------

function [ g ] = read_group( fname, info )
% All datasets and groups of a group, for Matlab

   g = struct();
   for k = 1 : numel(info.Groups)
      g.(last_name(info.Groups(k).Name)) = read_group(fname, info.Groups(k));
   end
   for k = 1 : numel(info.Datasets)
      name = info.Datasets(k).Name;
      g.(name) = h5read(fname, [info.Name '/' name]);
   end

end % function read_group

%------------------------------------------------------------------------------------------------------

function [ name ] = last_name( path )
% Name of a group without its parent groups

   name = path(find(path=='/', 1, 'last')+1 : end);

end % function last_name
