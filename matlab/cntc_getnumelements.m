function [ mx, my ] = cntc_getnumelements( ire, icp )
% CNTC_GETNUMELEMENTS  Get the size of the grid.
%
%   [mx, my] = cntc_getnumelements( ire, icp )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   mx, my    numbers of elements along x and y
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getnumelements');
   [mx, my] = cntc_call('cntc_getnumelements', ire, icp, [], []);
   cntc_report_errors('cntc_getnumelements', ire, icp);

end % function cntc_getnumelements
