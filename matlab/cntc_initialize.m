function [ ifcver, ierror ] = cntc_initialize( ire, imodul, outdir, idebug )
% CNTC_INITIALIZE  Create a result element.
%
%   [ifcver, ierror] = cntc_initialize( ire, imodul, outdir, idebug )
%
%   ire      number of the result element, 1 to 999 (default 1)
%   imodul   1: wheel and rail; 3: basic contact
%   outdir   folder for results, if the library is not initialised yet (default: the current one)
%   idebug   0: silent; 1: tell error codes
%   ifcver   version of the interface
%   ierror   0, or CNTC.err_allow
%
% See also: cntc_initlibrary, cntc_finalize.

   if (nargin<1 || isempty(ire))
      ire = 1;
   end
   if (nargin<3 || isempty(outdir))
      outdir = ' ';
   end
   if (nargin<4 || isempty(idebug))
      idebug = cntc_library('idebug');
   end
   [ifcver, ierror] = cntc_call('cntc_initialize', ire, imodul, [], 0, outdir, numel(outdir));
   cntc_tell('cntc_initialize', ire, -1, ierror, idebug);

end % function cntc_initialize
