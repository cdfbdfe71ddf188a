function [ carea, harea, sarea, parea ] = cntc_getcontactpatchareas( ire, icp )
% CNTC_GETCONTACTPATCHAREAS  Get the areas of contact, adhesion, slip and plasticity.
%
%   [carea, harea, sarea, parea] = cntc_getcontactpatchareas( ire, icp )
%
%   ire, icp   result element and contact patch or problem (default 1, 1)
%   carea, harea, sarea, parea   areas [L2]

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getcontactpatchareas');
   [carea, harea, sarea] = cntc_call('cntc_getcontactpatchareas', ire, icp, [], [], []);
   cntc_report_errors('cntc_getcontactpatchareas', ire, icp);
   parea = carea - harea - sarea;
   if parea <= 1e-9*carea   % areas are multiples of the element area: this is round-off
      parea = 0;
   end

end % function cntc_getcontactpatchareas
