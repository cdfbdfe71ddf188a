function [ g, fname ] = hdf5_case( expnam, icase, wanted )
% HDF5_CASE  Group of a case in the HDF5 file of an experiment, see HDF5_GROUP; [] if there is no file or no such case.
%
%   expnam   experiment name with folder, with or without the extension .h5. A suffix such as _re001 selects a result
%            element, as in the names of .mat files; the HDF5 file contains all result elements
%   icase    number of the case
%   wanted   cell array of the required groups
%
%   fname    name of the HDF5 file, '' if there is none

   g = [];
   [folder, name, ending] = fileparts(expnam);
   if (~strcmp(ending, '.h5'))
      name = [name, ending];
   end
   prefix = '';
   fname  = fullfile(folder, [name '.h5']);
   at     = regexp(name, '_re\d+$');
   if (exist(fname,'file')~=2 && ~isempty(at))
      prefix = [name(at+1:end) '_'];
      fname  = fullfile(folder, [name(1:at-1) '.h5']);
   end
   if (exist(fname,'file')~=2)
      fname = '';
      return
   end
   % signature of HDF5 files
   f = fopen(fname, 'r');
   signature = fread(f, [1 8], 'uint8');
   fclose(f);
   if (~isequal(signature, [137 72 68 70 13 10 26 10]))
      error('"%s" is not an HDF5 file.', fname);
   end
   place = sprintf('%scase_%04d', prefix, icase);
   g = hdf5_group(fname, place, wanted);
   hdf5_require_whole(fname, ['/' place], g);

end % function hdf5_case
