function [ pen ] = cntc_getpenetration( ire, icp )
% CNTC_GETPENETRATION  Get the approach of the bodies.
%
%   pen = cntc_getpenetration( ire, icp )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   pen       approach [L]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getpenetration');
   pen = cntc_call('cntc_getpenetration', ire, icp, []);
   cntc_report_errors('cntc_getpenetration', ire, icp);

end % function cntc_getpenetration
