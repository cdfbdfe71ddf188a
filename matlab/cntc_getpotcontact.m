function [ mx, my, xc1, yc1, dx, dy ] = cntc_getpotcontact( ire, icp )
% CNTC_GETPOTCONTACT  Get the grid.
%
%   [mx, my, xc1, yc1, dx, dy] = cntc_getpotcontact( ire, icp )
%
%   ire, icp   result element and contact patch or problem (default 1, 1)
%   mx, my     numbers of elements
%   xc1, yc1   centre of the first element [L]
%   dx, dy     sizes of elements [L]

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getpotcontact');
   v = cntc_call('cntc_getpotcontact', ire, icp, 6, zeros(6,1));
   cntc_report_errors('cntc_getpotcontact', ire, icp);
   mx  = round(v(1));   my  = round(v(2));
   xc1 = v(3);          yc1 = v(4);
   dx  = v(5);          dy  = v(6);

end % function cntc_getpotcontact
