function [ rvalues ] = cntc_getwear( ire, icp )
% CNTC_GETWEAR  Get totals of wear and fatigue of a patch, after a calculation with the flag CNTC.own_wear = 1.
%
%   rvalues = cntc_getwear( ire, icp )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   rvalues   T-gamma [F], wear index [F/L2], largest density of frictional power [W/mm2], largest wear depth [L] and
%             worn area of the section [L2] per passage, tangential over normal force [-], largest pressure over yield
%             stress in shear [-], the same over its shakedown limit [-], surface fatigue index [-], largest von Mises
%             and Tresca stress at the subsurface points [F/L2]; 0 for quantities that do not apply
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getwear');
   rvalues = cntc_call('cntc_getwear', ire, icp, 11, zeros(11,1));
   cntc_report_errors('cntc_getwear', ire, icp);

end % function cntc_getwear
