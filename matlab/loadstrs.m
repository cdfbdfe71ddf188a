function [ varargout ] = loadstrs( expnam, icase, ipatch )
% LOADSTRS  Load displacements and stresses below the surface from a .subs file, or from the HDF5 file of the experiment.
%
%   [blk1, blk2, ...] = loadstrs( expnam, icase, ipatch )
%
%   expnam   experiment name without extension, optionally with a folder. Without .subs file the case is read from
%            expnam.h5 (contact --hdf5); with the extension .h5 this file is always read
%   icase    number of the case (default 1)
%   ipatch   number of the contact patch of a wheel-rail case (default 0: file without patch letter, else the first patch)
%
% One struct for each block of points of the input, [] for a missing block:
%
%   nx, ny, nz, npoints   numbers of points
%   x, y, z               their coordinates, column vectors [mm]
%   ux, uy, uz            displacements [mm], nx x ny x nz arrays, like all that follow
%   sighyd, sigvm         mean hydrostatic and von Mises stress [N/mm2], tension positive
%   sigxx, sigxy, sigxz, sigyy, sigyz, sigzz   full stress tensor [N/mm2], if the file has it; HDF5 files have it
%   sigtr, sigma1, sigma2, sigma3   with the full tensor: Tresca's maximum shear stress (sigma1 - sigma3)
%                         and the principal stresses, sigma1 >= sigma2 >= sigma3 [N/mm2]
%
% Use squeeze for arrays with one or two dimensions of length 1.
%
% See also: diffstrs, plotstrs, loadcase.

   if (nargin<2 || isempty(icase))
      icase = 1;
   end
   if (nargin<3 || isempty(ipatch))
      ipatch = 0;
   end

   fname = '';
   if (isempty(regexp(expnam, '\.h5$', 'once')))
      fname = subs_file(expnam, icase, ipatch);
   end
   if (~isempty(fname))
      blocks = guarded(fname, 'loadstrs', @() read_blocks(fname));
   else
      [blocks, fname] = guarded(expnam, 'loadstrs', @() hdf5_blocks(expnam, icase, max(1,ipatch)));
   end
   if (isempty(blocks))
      require_file('', 'loadstrs', expnam, icase);
   end
   if (nargout>numel(blocks))
      blocks(numel(blocks)+1:nargout) = {[]};
   end
   varargout = blocks(1:max(1,nargout));

end % function loadstrs

%------------------------------------------------------------------------------------------------------

function [ fname ] = subs_file( expnam, icase, ipatch )
% File names with the number of the case, then with the letter of a patch; very large numbers are omitted from names

   if (ipatch==0)
      fname = result_file(expnam, icase, 0, '.subs');
      if (isempty(fname))
         fname = result_file(expnam, icase, 1, '.subs');
      end
   else
      fname = result_file(expnam, icase, ipatch, '.subs');
   end
   plain = [expnam, '.subs'];
   if (isempty(fname) && exist(plain,'file')==2)
      fname = plain;
   end

end % function subs_file

%------------------------------------------------------------------------------------------------------

function [ blocks ] = read_blocks( fname )
% Blocks one after the other: a line with the three numbers of points, then one line per point

   table  = read_table(fname);
   names  = {'ux','uy','uz','sighyd','sigvm','sigxx','sigxy','sigxz','sigyy','sigyz','sigzz'};
   ncol   = size(table,2);
   if (ncol~=8 && ncol~=14)
      error('loadstrs: "%s" has %d columns; 8 or 14 were expected.', fname, ncol);
   end
   blocks = {};
   first  = 1;
   while (first<=size(table,1))
      nx = table(first,1);  ny = table(first,2);  nz = table(first,3);
      np = nx*ny*nz;
      if (any([nx ny nz]<0) || any([nx ny nz]~=fix([nx ny nz])))
         error('loadstrs: "%s" is damaged: block %d has invalid numbers of points.', fname, numel(blocks)+1);
      end
      if (first+np>size(table,1))
         error('loadstrs: "%s" ends inside block %d.', fname, numel(blocks)+1);
      end
      points = table(first+(1:np),:);
      b = struct('nx',nx, 'ny',ny, 'nz',nz, 'npoints',np);
      b.x = points(1:nx, 1);
      b.y = points(1:max(1,nx):nx*ny, 2);
      b.z = points(1:max(1,nx*ny):np, 3);
      for i = 4 : ncol
         b.(names{i-3}) = reshape(points(:,i), [nx ny nz]);
      end
      if (ncol==14)
         b = add_principal(b);
      end
      blocks{end+1} = b;
      first = first + np + 1;
   end

end % function read_blocks

%------------------------------------------------------------------------------------------------------

function [ blocks, fname ] = hdf5_blocks( expnam, icase, ipatch )
% Blocks of a patch in the HDF5 file of an experiment; {} if there is no file, case or block

   patch  = sprintf('patch_%d', ipatch);
   blocks = {};
   [c, fname] = hdf5_case(expnam, icase, {patch});
   if (~isfield(c, patch) || ~isfield(c.(patch), 'subsurface'))
      return
   end
   all   = c.(patch).subsurface;
   names = {'ux','uy','uz','sighyd','sigvm','sigxx','sigxy','sigxz','sigyy','sigyz','sigzz', ...
            'sigma1','sigma3','sigma2','sigtr'};
   for k = 1 : numel(fieldnames(all))
      from = all.(sprintf('block_%d', k));
      nx = numel(from.points.x);   ny = numel(from.points.y);   nz = numel(from.points.z);
      b = struct('nx',nx, 'ny',ny, 'nz',nz, 'npoints',nx*ny*nz);
      b.x = from.points.x(:);
      b.y = from.points.y(:);
      b.z = from.points.z(:);
      for i = 1 : numel(names)
         b.(names{i}) = reshape(from.(names{i}), [nx ny nz]);
      end
      blocks{k} = b;
   end

end % function hdf5_blocks
