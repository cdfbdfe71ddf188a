function [ rvalues ] = cntc_geterrors( ire, icp )
% CNTC_GETERRORS  Get the estimated errors of the totals of a patch, after a calculation with the flag CNTC.own_errors = 1.
%
%   rvalues = cntc_geterrors( ire, icp )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   rvalues   errors of the normal force, the tangential forces [F], the spin moment [F L], the approach [L], the
%             largest pressure [F/L2], the contact area [L2], the longitudinal and lateral creepage or shift [-] or
%             [L], the frictional power [W] or work [J], the elastic energy [J], the highest temperature of body 1
%             [degC]; not negative; -1 for prescribed quantities and those without an estimate
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_geterrors');
   rvalues = cntc_call('cntc_geterrors', ire, icp, 12, zeros(12,1));
   cntc_report_errors('cntc_geterrors', ire, icp);

end % function cntc_geterrors
