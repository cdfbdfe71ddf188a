function subs_addblock( ire, icp, iblk, isubs, xparam, yparam, zparam )
% SUBS_ADDBLOCK  Add a block of points below the surface.
%
%   subs_addblock( ire, icp, iblk, isubs, xparam, yparam, zparam )
%
%   ire, icp   result element (default 1) and contact patch or problem; -1 (default): wheel and rail as a whole
%   iblk     number of the block (default 1); this and later blocks are deleted, 0 deletes all
%   isubs    xparam; yparam; zparam
%   1        none; none; nz, zl, dz [L]                                     all element centres
%   2        ixl, ixinc, ixh; iyl, iyinc, iyh; nz, zl, dz                   ranges of elements
%   3        numbers of columns; numbers of rows; nz, zl, dz                lists of elements
%   5, 6, 7  as 1, 2, 3 with zparam a list of depths [L]
%   9        coordinates x; y; z [L]

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'subs_addblock');
   if (nargin<3 || isempty(iblk))
      iblk = 1;
   end
   if (nargin<5 || isempty(xparam))
      xparam = 0;
   end
   if (nargin<6 || isempty(yparam))
      yparam = 0;
   end
   if (isempty(zparam) && iblk==0)
      zparam = 0;
   end
   cntc_call('subs_addblock', ire, icp, iblk, isubs, numel(xparam), numel(yparam), numel(zparam), xparam, yparam, zparam);
   cntc_report_errors('subs_addblock', ire, icp);

end % function subs_addblock
