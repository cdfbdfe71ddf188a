function cntc_buildmex( folder )
% CNTC_BUILDMEX  Build the gateway between Octave and the library.
%
%   cntc_buildmex( folder )
%
%   folder   folder of the gateway, which must be on the search path; default: that of these scripts
%
% Needs mkoctfile and a C compiler (Debian: octave-dev). Matlab can use the gateway, too; without it the library is
% loaded by loadlibrary.
%
% See also: cntc_initlibrary.

   here = fullfile(fileparts(mfilename('fullpath')), 'private');
   if (nargin<1 || isempty(folder))
      folder = here;
   end
   source = fullfile(here, 'cntc_mex.c');
   target = fullfile(folder, ['cntc_mex.' mexext()]);
   if (exist('OCTAVE_VERSION','builtin'))
      [output, status] = mkoctfile('--mex', '-o', target, source, '-ldl');
      left = fullfile(pwd, 'cntc_mex.o');
      if (exist(left,'file')==2)
         delete(left);
      end
      if (status~=0)
         error('cntc_buildmex: %s', output);
      end
   else
      mex('-outdir', folder, source, '-ldl');
   end

end % function cntc_buildmex
