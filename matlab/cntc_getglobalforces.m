function [ rvalues ] = cntc_getglobalforces( ire, icp )
% CNTC_GETGLOBALFORCES  Get forces and moments of wheel and rail; with icp = -1 the sum of all patches.
%
%   rvalues = cntc_getglobalforces( ire, icp )
%
%   ire, icp  result element (default 1) and contact patch or problem; -1 (default): wheel and rail as a whole
%   rvalues in threes, forces Fx, Fy, Fz [F] and moments Mx, My, Mz [F L]:
%   1-6       track directions, about the rail marker; 7-12 wheelset directions, about the wheel marker
%   13-18     rail directions, about the rail marker; 19-24 wheel directions, about the wheel marker
%   They act on the rail, in Simpack units on the wheel. With damping its forces are included, which totals of files and
%   prescribed forces do not contain.
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'cntc_getglobalforces');
   rvalues = cntc_call('cntc_getglobalforces', ire, icp, 24, zeros(24,1));
   cntc_report_errors('cntc_getglobalforces', ire, icp);

end % function cntc_getglobalforces
