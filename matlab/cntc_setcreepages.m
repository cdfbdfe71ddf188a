function cntc_setcreepages( ire, icp, vx, vy, phi )
% CNTC_SETCREEPAGES  Set creepages, in shifts the shift (basic contact).
%
%   cntc_setcreepages( ire, icp, vx, vy, phi )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   vx, vy    longitudinal and lateral creepage [-], in shifts (T = 1) distances [L]
%   phi       spin [A/L], in shifts rotation [A]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_setcreepages');
   cntc_call('cntc_setcreepages', ire, icp, vx, vy, phi);
   cntc_report_errors('cntc_setcreepages', ire, icp);

end % function cntc_setcreepages
