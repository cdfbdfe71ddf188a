function [ ierror ] = cntc_calculate( ire, icp, idebug )
% CNTC_CALCULATE  Solve a contact problem.
%
%   ierror = cntc_calculate( ire, icp, idebug )
%
%   ire, icp  result element (default 1) and contact patch or problem; -1 (default): wheel and rail as a whole
%   ierror    0; negative: an error, CNTC.err_*; positive: elements in contact at the border of the grid (basic
%             contact)
%   idebug    1: report error codes; 2: also remarks; 0: silent (default: that of cntc_initlibrary)
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'cntc_calculate');
   if (nargin<3 || isempty(idebug))
      idebug = cntc_library('idebug');
   end
   ierror = cntc_call('cntc_calculate', ire, icp, []);
   cntc_report_errors('cntc_calculate', ire, icp, ierror, idebug);

end % function cntc_calculate
