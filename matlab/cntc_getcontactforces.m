function [ fn, tx, ty, mz ] = cntc_getcontactforces( ire, icp )
% CNTC_GETCONTACTFORCES  Get forces in the directions of the contact.
%
%   [fn, tx, ty, mz] = cntc_getcontactforces( ire, icp )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   fn        normal force [F]
%   tx, ty    tangential forces [F]
%   mz        moment about the normal [F L]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getcontactforces');
   [fn, tx, ty, mz] = cntc_call('cntc_getcontactforces', ire, icp, [], [], [], []);
   cntc_report_errors('cntc_getcontactforces', ire, icp);

end % function cntc_getcontactforces
