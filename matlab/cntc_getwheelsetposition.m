function [ rvalues ] = cntc_getwheelsetposition( ire )
% CNTC_GETWHEELSETPOSITION  Get the position of the wheelset.
%
%   rvalues = cntc_getwheelsetposition( ire )
%
%   ire       result element of a wheel-rail problem (default 1)
%   rvalues   s, y, z [L], roll, yaw, pitch [A]; z is computed if the vertical force is prescribed
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   ire = cntc_ids(ire);
   rvalues = cntc_call('cntc_getwheelsetposition', ire, 6, zeros(6,1));
   cntc_report_errors('cntc_getwheelsetposition', ire, -1);

end % function cntc_getwheelsetposition
