function cntc_buildmex( folder )
% CNTC_BUILDMEX  Build the gateway by which Octave reaches the library.
%
%   cntc_buildmex( folder )
%
%   folder   where the gateway is stored, to be put on the search path; default: beside these scripts, where
%            they find it
%
% Needs mkoctfile and a C compiler (Debian: octave-dev). Matlab can use the gateway too, and without it loads the
% library by loadlibrary.
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
