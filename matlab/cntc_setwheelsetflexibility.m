function cntc_setwheelsetflexibility( ire, ewheel, params )
% CNTC_SETWHEELSETFLEXIBILITY  Set deviations of the wheel from the rigid wheelset.
%
%   cntc_setwheelsetflexibility( ire, ewheel, params )
%
%   ire       result element of a wheel-rail problem (default 1)
%   ewheel    4, 5: new deviations; others: none (default 0)
%   params    dx, dy, dz [L], droll, dyaw, dpitch [A], vx, vy, vz [V], vroll, vyaw, vpitch [A/T]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   ire = cntc_ids(ire);
   if (nargin<2 || isempty(ewheel))
      ewheel = 0;
   end
   if (nargin<3 || isempty(params))
      params = [];
   end
   cntc_call('cntc_setwheelsetflexibility', ire, ewheel, numel(params), params);
   cntc_report_errors('cntc_setwheelsetflexibility', ire, -1);

end % function cntc_setwheelsetflexibility
