function cntc_setwheelsetposition( ire, ewheel, params )
% CNTC_SETWHEELSETPOSITION  Set the position of the wheelset.
%
%   cntc_setwheelsetposition( ire, ewheel, params )
%
%   ire       result element of a wheel-rail problem (default 1)
%   ewheel    1 to 5 (default 1)
%   params    s, y, z [L], roll, yaw, pitch [A]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   ire = cntc_ids(ire);
   if (nargin<2 || isempty(ewheel))
      ewheel = 1;
   end
   cntc_call('cntc_setwheelsetposition', ire, ewheel, numel(params), params);
   cntc_report_errors('cntc_setwheelsetposition', ire, -1);

end % function cntc_setwheelsetposition
