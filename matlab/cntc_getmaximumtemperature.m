function [ t1max, t2max ] = cntc_getmaximumtemperature( ire, icp )
% CNTC_GETMAXIMUMTEMPERATURE  Get the largest surface temperatures in contact.
%
%   [t1max, t2max] = cntc_getmaximumtemperature( ire, icp )
%
%   ire, icp      result element and contact patch or problem (default 1, 1)
%   t1max, t2max  of bodies 1 and 2 [degC]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getmaximumtemperature');
   [t1max, t2max] = cntc_call('cntc_getmaximumtemperature', ire, icp, [], []);
   cntc_report_errors('cntc_getmaximumtemperature', ire, icp);

end % function cntc_getmaximumtemperature
