function cntc_sethertzcontact( ire, icp, ipotcn, params )
% CNTC_SETHERTZCONTACT  Set a Hertzian geometry and its grid (basic contact).
%
%   cntc_sethertzcontact( ire, icp, ipotcn, params )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   ipotcn    params
%   -1        mx, my, a1, b1 [1/L], scale [-]        distance a1 x^2 + b1 y^2: half the sum of the bodies' curvatures
%   -2        mx, my, a1 [1/L], aob [-], scale       the same along x, and ratio of the axes
%   -3        mx, my, aa, bb [L], scale              half-axes
%   -4        mx, my, a1 [1/L], bb [L], scale        rectangle: the same along x, half-width
%   -5        mx, my, aa, bb [L], scale              rectangle: half-lengths
%   -6        mx, my, aa, bneg, bpos [L], scale      two halves of ellipses (set B = 4 yourself)
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_sethertzcontact');
   cntc_call('cntc_sethertzcontact', ire, icp, ipotcn, numel(params), params);
   cntc_report_errors('cntc_sethertzcontact', ire, icp);

end % function cntc_sethertzcontact
