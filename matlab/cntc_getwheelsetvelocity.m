function [ rvalues ] = cntc_getwheelsetvelocity( ire )
% CNTC_GETWHEELSETVELOCITY  Get the velocity of the wheelset.
%
%   rvalues = cntc_getwheelsetvelocity( ire )
%
%   ire       result element of a wheel-rail problem (default 1)
%   rvalues   vs, vy, vz [V], vroll, vyaw, vpitch [A/T]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   ire = cntc_ids(ire);
   rvalues = cntc_call('cntc_getwheelsetvelocity', ire, 6, zeros(6,1));
   cntc_report_errors('cntc_getwheelsetvelocity', ire, -1);

end % function cntc_getwheelsetvelocity
