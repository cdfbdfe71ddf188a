function [ tcpu, twall ] = cntc_getcalculationtime( ire, icp )
% CNTC_GETCALCULATIONTIME  Get the time of the calculations.
%
%   [tcpu, twall] = cntc_getcalculationtime( ire, icp )
%
%   ire, icp     result element and contact patch or problem (default 1, 1)
%   tcpu, twall  processor and wall clock time since the last reset [s]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getcalculationtime');
   [tcpu, twall] = cntc_call('cntc_getcalculationtime', ire, icp, [], []);
   cntc_report_errors('cntc_getcalculationtime', ire, icp);

end % function cntc_getcalculationtime
