function cntc_setreferencevelocity( ire, icp, veloc )
% CNTC_SETREFERENCEVELOCITY  Set the rolling velocity (basic contact).
%
%   cntc_setreferencevelocity( ire, icp, veloc )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   veloc     velocity [V]; its absolute value is used, at least 1e-9 mm/s
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_setreferencevelocity');
   cntc_call('cntc_setreferencevelocity', ire, icp, veloc);
   cntc_report_errors('cntc_setreferencevelocity', ire, icp);

end % function cntc_setreferencevelocity
