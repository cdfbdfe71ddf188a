function [ ierror ] = subs_calculate( ire, icp, idebug )
% SUBS_CALCULATE  Compute subsurface displacements and stresses, after cntc_calculate.
%
%   ierror = subs_calculate( ire, icp, idebug )
%
%   ire, icp  result element (default 1) and contact patch or problem; -1 (default): wheel and rail as a whole
%   ierror    0; negative: an error, CNTC.err_*; 305: another thread works on the problem
%   idebug    1: report error codes; 2: also remarks; 0: silent (default: that of cntc_initlibrary)
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'subs_calculate');
   if (nargin<3 || isempty(idebug))
      idebug = cntc_library('idebug');
   end
   ierror = cntc_call('subs_calculate', ire, icp, []);
   cntc_report_errors('subs_calculate', ire, icp, ierror, idebug);

end % function subs_calculate
