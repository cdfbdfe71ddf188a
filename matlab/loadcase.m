function [ varargout ] = loadcase( expnam, icase, ipatch )
% LOADCASE  Load the surface results of one case from its .mat file(s), or from the HDF5 file of the experiment.
%
%   s = loadcase( expnam )                 case 1
%   s = loadcase( expnam, icase )          all patches of a wheel-rail case, in an array of structs
%   s = loadcase( expnam, icase, ipatch )  one patch
%   [s1, s2, ...] = loadcase( expnam, icase, -1 )  one struct for each patch, [] for missing ones; -1 can be omitted
%
%   expnam   experiment name without extension, optionally with a folder. Cases without .mat files are read from
%            expnam.h5 (contact --hdf5); with the extension .h5 this file is always read
%   icase    number of the case (default 1)
%   ipatch   number of the contact patch in a wheel-rail case (default 0: all of them); for a patch that does not exist the
%            result is [], with a warning
%
% Fields of the struct; arrays have one row per grid row, so s.pn(iy,ix) belongs to (s.x(ix), s.y(iy)):
%
%   config            module 1: configuration, 0/1 wheel on rail, 4/5 on roller, left/right; module 3: 0
%   h_digit, d_digit  control digits HEAT and, in module 1, DISCNS
%   meta, mater, fric, kincns   structs of positions, materials, friction and kinematics; mater.ga, .si, .ak are the
%                     combined modulus, Poisson ratio and difference parameter, fric.fstat the static coefficient of friction
%   meta.spinxo, meta.spinyo   in steps (T = 1, 2) of wheel and rail: contact reference in the coordinates x, y of the elements [mm]
%   meta.status       how the case ended: 'solved' or 'not converged'; '' in files of other programs
%   meta.reason       which iteration did not reach its tolerance, and by how much; '' for solved cases
%   mx, my            numbers of elements along and across the rolling direction
%   xl, yl, dx, dy    lower left corner of the grid and size of the elements [mm]
%   x_offset, y_offset  empty; if set, plot3d moves the grid by these amounts [mm]
%   x, y              centres of the elements [mm]
%   eldiv             0 exterior, 1 adhesion, 2 slip, 3 plastic deformation
%   h                 undeformed distance, approach not subtracted [mm]
%   mu                coefficient of friction [-]
%   pn, px, py        tractions on body 1, in module 1 the rail [N/mm2]
%   un, ux, uy        displacement differences [mm]
%   srel, shft        magnitude of relative slip velocity [-] and of slip distance per step [mm]
%   taucrt, uplsx, uplsy  with a plastic layer: yield limit [N/mm2], plastic displacements [mm]
%   temp1, temp2      with temperatures: those of the surfaces of bodies 1 and 2 [degC]
%   trcbnd            traction bound [N/mm2]
%
% With A=1 a .mat file has the elements in contact only; tractions are zero elsewhere, and unknown values (h, mu,
% displacements, slip, temperatures) are NaN. HDF5 files have all elements.
%
% See also: diffcase, plot2d, plot3d, loadstrs.

   if (nargin<2 || isempty(icase))
      icase = 1;
   end
   if (nargin<3 || isempty(ipatch))
      ipatch = 0;
   end
   separate = (ipatch==-1 || (nargout>1 && ipatch<=0));

   patches = {};
   if (isempty(regexp(expnam, '\.h5$', 'once')))
      patches = mat_patches(expnam, icase, ipatch);
   end
   if (isempty(patches))
      patches = guarded(expnam, 'loadcase', @() hdf5_patches(expnam, icase));
      if (ipatch>0 && ~isempty(patches))
         patches = the_patch(patches, ipatch, expnam, icase);
      end
   end
   if (isempty(patches))
      require_file('', 'loadcase', expnam, icase);
   end

   if (separate)
      varargout = cell(1, max(1,nargout));
      n = min(numel(varargout), numel(patches));
      varargout(1:n) = patches(1:n);
   else
      varargout{1} = [patches{:}];
   end

end % function loadcase

%------------------------------------------------------------------------------------------------------

function [ patches ] = the_patch( patches, ipatch, expnam, icase )
% One of the patches of a case

   npatch = numel(patches);
   if (ipatch>npatch)
      warning('loadcase: case %d of "%s" has %d contact patch(es); number %d does not exist.', icase, expnam, npatch, ipatch);
      patches = {[]};
   else
      patches = patches(ipatch);
   end

end % function the_patch

%------------------------------------------------------------------------------------------------------

function [ patches ] = mat_patches( expnam, icase, ipatch )
% Structs of the .mat files of a case: of one patch, or all of them; {} if there are no files

   patches = {};
   fname = '';
   if (ipatch<=1)
      % files of module 3 have no letters
      fname = result_file(expnam, icase, 0, '.mat');
   end
   if (isempty(fname))
      fname = result_file(expnam, icase, max(1,ipatch), '.mat');
   end
   if (isempty(fname) && ipatch>1)
      % the first file has the number of patches
      patches = mat_patches(expnam, icase, 0);
      if (~isempty(patches))
         patches = the_patch(patches, ipatch, expnam, icase);
      end
      return
   end
   if (isempty(fname))
      return
   end
   patches = {guarded(fname, 'loadcase', @() read_mat_file(fname, icase))};
   if (ipatch>0)
      return
   end
   % files left over from an earlier run with more patches are not read
   for k = 2 : patches{1}.meta.npatch
      fname = result_file(expnam, icase, k, '.mat');
      if (isempty(fname))
         error('loadcase: patch %d of %d of case %d of "%s" has no .mat file.', k, patches{1}.meta.npatch, icase, expnam);
      end
      patches{k} = guarded(fname, 'loadcase', @() read_mat_file(fname, icase));
   end

end % function mat_patches
