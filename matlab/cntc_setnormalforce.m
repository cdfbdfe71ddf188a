function cntc_setnormalforce( ire, icp, fn )
% CNTC_SETNORMALFORCE  Prescribe the normal force (basic contact); sets N = 1.
%
%   cntc_setnormalforce( ire, icp, fn )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   fn        normal force [F]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_setnormalforce');
   cntc_call('cntc_setnormalforce', ire, icp, fn);
   cntc_report_errors('cntc_setnormalforce', ire, icp);

end % function cntc_setnormalforce
