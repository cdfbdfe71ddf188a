function [ values ] = cntc_gethertzcontact( ire, icp )
% CNTC_GETHERTZCONTACT  Get the numbers of a Hertzian geometry (module 3).
%
%   values = cntc_gethertzcontact( ire, icp )
%
%   ire, icp   result element and contact patch or problem (default 1, 1)
%   values   a1, b1 [1/L], aa, bb [L], rho, cp [L], scale [-], bneg, bpos [L], aob [-]

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_gethertzcontact');
   values = cntc_call('cntc_gethertzcontact', ire, icp, 10, zeros(10,1));
   cntc_tell('cntc_gethertzcontact', ire, icp);

end % function cntc_gethertzcontact
