function [ CNTC, ifcver, ierror ] = cntc_initlibrary( wrkdir, outdir, expnam, idebug, skip_init )
% CNTC_INITLIBRARY  Load the library and begin a run.
%
%   [CNTC, ifcver, ierror] = cntc_initlibrary( wrkdir, outdir, expnam, idebug, skip_init )
%
%   wrkdir     folder of input files (default: the current one)
%   outdir     folder of results (default: the current one)
%   expnam     name of the .out file (default: contact_addon)
%   idebug     0: silent; 1: report error codes and messages (default); 2: also remarks
%   skip_init  1: only load the library (default 0)
%   CNTC       numbers of flags and fields, see cntc_getmagicnumbers
%   ifcver     version of the interface
%   ierror     0, or a negative code
%
%   If the library is already loaded, a new run begins. The library is the one named by the environment variable
%   CONTACT_LIBRARY, or is searched for in bin or build/release/bin beside this folder. Octave needs cntc_buildmex once.
%
% See also: cntc_buildmex, cntc_initialize, cntc_closelibrary.

   if (nargin<1 || isempty(wrkdir))
      wrkdir = ' ';
   end
   if (nargin<2 || isempty(outdir))
      outdir = ' ';
   end
   if (nargin<3 || isempty(expnam))
      expnam = ' ';
   end
   if (nargin<4 || isempty(idebug))
      idebug = 1;
   end
   if (nargin<5 || isempty(skip_init))
      skip_init = 0;
   end
   if (cntc_library('load'))
      cntc_call('cntc_finalizelast');
      cntc_library('unload');
      cntc_library('load');
   end
   cntc_library('idebug', idebug);
   CNTC   = cntc_getmagicnumbers();
   ifcver = [];
   ierror = 0;
   if (~skip_init)
      [ifcver, ierror] = cntc_call('cntc_initializefirst_new', [], 0, 0, wrkdir, outdir, expnam, ...
                                   numel(wrkdir), numel(outdir), numel(expnam));
      cntc_report_errors('cntc_initializefirst_new', 0, -1, ierror, idebug);
   end

end % function cntc_initlibrary
