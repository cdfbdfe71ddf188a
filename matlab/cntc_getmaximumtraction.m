function [ ptmax ] = cntc_getmaximumtraction( ire, icp )
% CNTC_GETMAXIMUMTRACTION  Get the largest tangential traction.
%
%   ptmax = cntc_getmaximumtraction( ire, icp )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   ptmax     traction [F/L2]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getmaximumtraction');
   ptmax = cntc_call('cntc_getmaximumtraction', ire, icp, []);
   cntc_report_errors('cntc_getmaximumtraction', ire, icp);

end % function cntc_getmaximumtraction
