function cntc_settangentialforces( ire, icp, fx, fy )
% CNTC_SETTANGENTIALFORCES  Prescribe tangential forces.
%
%   cntc_settangentialforces( ire, icp, fx, fy )
%
%   ire, icp  result element and contact patch or problem (default 1, 1); -1: wheel and rail as a whole
%   fx, fy    basic contact: relative to fstat * fn [-]; wheel and rail (icp = -1): longitudinal force on the rail fx
%             [F], fy unused (default 0)
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch or whole', 'cntc_settangentialforces');
   if (nargin<4 || isempty(fy))
      fy = 0;
   end
   cntc_call('cntc_settangentialforces', ire, icp, fx, fy);
   cntc_report_errors('cntc_settangentialforces', ire, icp);

end % function cntc_settangentialforces
