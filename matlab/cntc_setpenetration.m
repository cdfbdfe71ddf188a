function cntc_setpenetration( ire, icp, pen )
% CNTC_SETPENETRATION  Prescribe the approach of the bodies (basic contact); sets N = 0.
%
%   cntc_setpenetration( ire, icp, pen )
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
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_setpenetration');
   cntc_call('cntc_setpenetration', ire, icp, pen);
   cntc_report_errors('cntc_setpenetration', ire, icp);

end % function cntc_setpenetration
