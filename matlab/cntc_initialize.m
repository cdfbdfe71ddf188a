function [ ifcver, ierror ] = cntc_initialize( ire, imodul, outdir, idebug )
% CNTC_INITIALIZE  Create a result element.
%
%   [ifcver, ierror] = cntc_initialize( ire, imodul, outdir, idebug )
%
%   ire       number of the result element, 1 to 999 (default 1)
%   imodul    1: wheel and rail; 3: basic contact
%   outdir    folder of results, if the run has not been started yet; default: the current one
%   ifcver    version of the interface
%   ierror    0, or a negative code CNTC.err_*
%   idebug    1: report error codes; 2: also remarks; 0: silent (default: that of cntc_initlibrary)
%
% See also: cntc_initlibrary, cntc_finalize.
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1 || isempty(ire))
      ire = 1;
   end
   if (nargin<3 || isempty(outdir))
      outdir = ' ';
   end
   if (nargin<4 || isempty(idebug))
      idebug = cntc_library('idebug');
   end
   [ifcver, ierror] = cntc_call('cntc_initialize', ire, imodul, [], [], outdir, numel(outdir));
   cntc_report_errors('cntc_initialize', ire, -1, ierror, idebug);

end % function cntc_initialize
