function cntc_setpotcontact( ire, icp, ipotcn, params )
% CNTC_SETPOTCONTACT  Set the grid.
%
%   cntc_setpotcontact( ire, icp, ipotcn, params )
%
%   ire, icp  result element (default 1) and contact patch or problem; -1 (default): wheel and rail as a whole
%   ipotcn    params
%   wheel and rail:
%   0         dx, ds [L], unused
%   -1        dx, ds [L], a_sep [A], d_sep, d_comb [L], optional d_turn [L], g_miss [L]
%   basic contact:
%   1         mx, my, xl, yl, dx, dy [L]             lower left corner, sizes of elements
%   2         mx, my, xl, yl, xh, yh [L]             lower left and upper right corner
%   3         mx, my, xc1, yc1, dx, dy [L]           centre of the first element, sizes
%   4         mx, my, xc1, yc1, xcm, ycm [L]         centres of the first and last element
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'cntc_setpotcontact');
   cntc_call('cntc_setpotcontact', ire, icp, ipotcn, numel(params), params);
   cntc_report_errors('cntc_setpotcontact', ire, icp);

end % function cntc_setpotcontact
