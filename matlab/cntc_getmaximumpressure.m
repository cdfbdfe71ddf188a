function [ pnmax ] = cntc_getmaximumpressure( ire, icp )
% CNTC_GETMAXIMUMPRESSURE  Get the largest pressure.
%
%   pnmax = cntc_getmaximumpressure( ire, icp )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   pnmax     pressure [F/L2]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getmaximumpressure');
   pnmax = cntc_call('cntc_getmaximumpressure', ire, icp, []);
   cntc_report_errors('cntc_getmaximumpressure', ire, icp);

end % function cntc_getmaximumpressure
