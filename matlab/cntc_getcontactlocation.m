function [ rvalues ] = cntc_getcontactlocation( ire, icp )
% CNTC_GETCONTACTLOCATION  Get the position of a contact patch of wheel and rail.
%
%   rvalues = cntc_getcontactlocation( ire, icp )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   rvalues
%   1-4       contact reference x, y, z [L] and its angle [A] in track coordinates
%   5-9       x, y, z, s [L], angle [A] in rail coordinates; 10-14 the same in wheel coordinates
%   15, 16    centre of pressure x, y in track coordinates [L]
%   18, 19    deflections of the rail dy, dz [L]; dy of a left rail is that of its mirror image
%   21-25     wheel marker x, y, z [L], roll, yaw [A]; 26-28 rail marker y, z [L], roll [A]; track coordinates
%   30-33     contact reference x, y, z [L], angle [A] in wheelset coordinates
%   34-38     wheel marker x, y, z [L], roll, yaw [A] in wheelset coordinates
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getcontactlocation');
   rvalues = cntc_call('cntc_getcontactlocation', ire, icp, 38, zeros(38,1));
   cntc_report_errors('cntc_getcontactlocation', ire, icp);

end % function cntc_getcontactlocation
