function [ dx, dy ] = cntc_getgriddiscretization( ire, icp )
% CNTC_GETGRIDDISCRETIZATION  Get the sizes of elements.
%
%   [dx, dy] = cntc_getgriddiscretization( ire, icp )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   dx, dy    sizes [L]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getgriddiscretization');
   [dx, dy] = cntc_call('cntc_getgriddiscretization', ire, icp, [], []);
   cntc_report_errors('cntc_getgriddiscretization', ire, icp);

end % function cntc_getgriddiscretization
