function cntc_resetcalculationtime( ire, icp )
% CNTC_RESETCALCULATIONTIME  Set the time of the calculations to zero.
%
%   cntc_resetcalculationtime( ire, icp )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_resetcalculationtime');
   cntc_call('cntc_resetcalculationtime', ire, icp);
   cntc_report_errors('cntc_resetcalculationtime', ire, icp);

end % function cntc_resetcalculationtime
