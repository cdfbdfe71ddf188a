function [ veloc ] = cntc_getreferencevelocity( ire, icp )
% CNTC_GETREFERENCEVELOCITY  Get the rolling velocity.
%
%   veloc = cntc_getreferencevelocity( ire, icp )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   veloc     velocity [V]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getreferencevelocity');
   veloc = cntc_call('cntc_getreferencevelocity', ire, icp, []);
   cntc_report_errors('cntc_getreferencevelocity', ire, icp);

end % function cntc_getreferencevelocity
