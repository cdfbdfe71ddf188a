function [ values ] = cntc_getcontactlocation( ire, icp )
% CNTC_GETCONTACTLOCATION  Get the place of a contact patch of wheel and rail.
%
%   values = cntc_getcontactlocation( ire, icp )
%
%   ire, icp   result element and contact patch or problem (default 1, 1)
%   values   1-3 contact reference x, y, z [L] and 4 its angle [A] in track coordinates
%            5-9 x, y, z, s [L], angle [A] in rail coordinates; 10-14 the same in wheel coordinates
%            15, 16 centre of pressure x, y in track coordinates [L]
%            18, 19 deflections of the rail dy, dz [L]
%            21-25 wheel marker x, y, z [L], roll, yaw [A]; 26-28 rail marker y, z [L], roll [A]; track coordinates
%            30-33 contact reference x, y, z [L], angle [A] in wheelset coordinates
%            34-38 wheel marker x, y, z [L], roll, yaw [A] in wheelset coordinates

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getcontactlocation');
   values = cntc_call('cntc_getcontactlocation', ire, icp, 38, zeros(38,1));
   cntc_tell('cntc_getcontactlocation', ire, icp);

end % function cntc_getcontactlocation
