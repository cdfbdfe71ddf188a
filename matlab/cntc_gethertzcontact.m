function [ rvalues ] = cntc_gethertzcontact( ire, icp )
% CNTC_GETHERTZCONTACT  Get the parameters of a Hertzian geometry (basic contact).
%
%   rvalues = cntc_gethertzcontact( ire, icp )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   rvalues   distance a1 x^2 + b1 y^2 [1/L], semi-axes aa, bb, effective radius rho, cp [L], scale [-], sides of the
%             axis bneg, bpos [L], ratio aob [-]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_gethertzcontact');
   rvalues = cntc_call('cntc_gethertzcontact', ire, icp, 10, zeros(10,1));
   cntc_report_errors('cntc_gethertzcontact', ire, icp);

end % function cntc_gethertzcontact
