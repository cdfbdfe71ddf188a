function [ values ] = cntc_getwheelsetposition( ire )
% CNTC_GETWHEELSETPOSITION  Get the position of the wheelset.
%
%   values = cntc_getwheelsetposition( ire )
%
%   ire      result element of a wheel-rail problem (default 1)
%   values   s, y, z [L], roll, yaw, pitch [A]; z as solved when the vertical force is prescribed

   if (nargin<1)
      ire = [];
   end
   ire = cntc_ids(ire);
   values = cntc_call('cntc_getwheelsetposition', ire, 6, zeros(6,1));
   cntc_tell('cntc_getwheelsetposition', ire, -1);

end % function cntc_getwheelsetposition
