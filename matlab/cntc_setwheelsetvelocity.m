function cntc_setwheelsetvelocity( ire, ewheel, params )
% CNTC_SETWHEELSETVELOCITY  Set the velocity of the wheelset.
%
%   cntc_setwheelsetvelocity( ire, ewheel, params )
%
%   ire       result element of a wheel-rail problem (default 1)
%   ewheel    2 to 5 (default 2)
%   params    vs, vy, vz [V], vroll, vyaw, vpitch [A/T]; on rollers the first value is the roller's rate [A/T]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   ire = cntc_ids(ire);
   if (nargin<2 || isempty(ewheel))
      ewheel = 2;
   end
   cntc_call('cntc_setwheelsetvelocity', ire, ewheel, numel(params), params);
   cntc_report_errors('cntc_setwheelsetvelocity', ire, -1);

end % function cntc_setwheelsetvelocity
