function [ pn, px, py ] = cntc_gettractions( ire, icp )
% CNTC_GETTRACTIONS  Get the tractions of each element.
%
%   [pn, px, py] = cntc_gettractions( ire, icp )
%
%   ire, icp    result element and contact patch or problem (default 1, 1)
%   pn, px, py  normal and tangential tractions [F/L2]
%   Values of elements are (my,mx) arrays; 0 if there is no grid yet.
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_gettractions');
   [mx, my] = cntc_getnumelements(ire, icp);
   if (mx*my<=0)
      pn = 0;
      px = 0;
      py = 0;
      return
   end
   [pn, px, py] = cntc_call('cntc_gettractions', ire, icp, mx*my, zeros(mx,my), zeros(mx,my), zeros(mx,my));
   cntc_report_errors('cntc_gettractions', ire, icp);
   pn = pn';
   px = px';
   py = py';

end % function cntc_gettractions
