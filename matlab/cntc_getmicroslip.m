function [ sx, sy ] = cntc_getmicroslip( ire, icp )
% CNTC_GETMICROSLIP  Get the slip of each element.
%
%   [sx, sy] = cntc_getmicroslip( ire, icp )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   sx, sy    relative slip velocities [-], in shifts distances [mm]
%   Values of elements are (my,mx) arrays; 0 if there is no grid yet.
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getmicroslip');
   [mx, my] = cntc_getnumelements(ire, icp);
   if (mx*my<=0)
      sx = 0;
      sy = 0;
      return
   end
   [sx, sy] = cntc_call('cntc_getmicroslip', ire, icp, mx*my, zeros(mx,my), zeros(mx,my));
   cntc_report_errors('cntc_getmicroslip', ire, icp);
   sx = sx';
   sy = sy';

end % function cntc_getmicroslip
