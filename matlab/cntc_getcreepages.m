function [ vx, vy, phi ] = cntc_getcreepages( ire, icp )
% CNTC_GETCREEPAGES  Get creepages, in shifts the shift.
%
%   [vx, vy, phi] = cntc_getcreepages( ire, icp )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   vx, vy    creepages [-], in shifts [L]
%   phi       spin [A/L], in shifts [A]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getcreepages');
   [vx, vy, phi] = cntc_call('cntc_getcreepages', ire, icp, [], [], []);
   cntc_report_errors('cntc_getcreepages', ire, icp);

end % function cntc_getcreepages
