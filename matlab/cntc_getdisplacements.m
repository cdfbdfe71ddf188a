function [ un, ux, uy ] = cntc_getdisplacements( ire, icp )
% CNTC_GETDISPLACEMENTS  Get the displacement differences of each element.
%
%   [un, ux, uy] = cntc_getdisplacements( ire, icp )
%
%   ire, icp    result element and contact patch or problem (default 1, 1)
%   un, ux, uy  normal and tangential differences [L]
%   Values of elements are (my,mx) arrays; 0 if there is no grid yet.
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getdisplacements');
   [mx, my] = cntc_getnumelements(ire, icp);
   if (mx*my<=0)
      un = 0;
      ux = 0;
      uy = 0;
      return
   end
   [un, ux, uy] = cntc_call('cntc_getdisplacements', ire, icp, mx*my, zeros(mx,my), zeros(mx,my), zeros(mx,my));
   cntc_report_errors('cntc_getdisplacements', ire, icp);
   un = un';
   ux = ux';
   uy = uy';

end % function cntc_getdisplacements
