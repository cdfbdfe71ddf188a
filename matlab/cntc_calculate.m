function [ ierror ] = cntc_calculate( ire, icp, idebug )
% CNTC_CALCULATE  Solve a contact problem.
%
%   ierror = cntc_calculate( ire, icp, idebug )
%
%   ire, icp   result element (default 1) and contact problem: -1 (default) for wheel and rail, 1 to 9 in module 3
%   idebug   1: tell error codes; 2: also remarks; 0: silent (default: that of cntc_initlibrary)
%   ierror   0; negative: an error, CNTC.err_...; positive: elements in contact at the border of the grid (module 3)

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
   cntc_tell('cntc_calculate', ire, icp, ierror, idebug);

end % function cntc_calculate
