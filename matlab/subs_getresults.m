function [ res ] = subs_getresults( ire, icp, iblk, icol )
% SUBS_GETRESULTS  Get results below the surface.
%
%   res = subs_getresults( ire, icp, iblk, icol )
%
%   ire, icp   result element and contact patch or problem (default 1, 1)
%   iblk     number of the block (default 1)
%   icol     requested columns, or 'all' (default)
%            1-3 x, y, z [L]; 4-6 ux, uy, uz [L]; 7-9 hydrostatic, von Mises, Tresca stress; 10-12 principal
%            stresses; 13-21 tensor xx, yx, zx, xy, yy, zy, xz, yz, zz [F/L2]
%   res      (npoint,ncol) array; for 'all' a struct like that of loadstrs
%
% See also: subs_addblock, plotstrs.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'subs_getresults');
   if (nargin<3 || isempty(iblk))
      iblk = 1;
   end
   if (nargin<4 || isempty(icol))
      icol = 'all';
   end
   [nx, ny, nz] = subs_getblocksize(ire, icp, iblk);
   if (min([nx ny nz])<1)
      error('subs_getresults: there is no block %d.', iblk);
   end
   all_columns = ischar(icol) && strcmp(icol, 'all');
   if (all_columns)
      icol = 1:21;
   end
   n   = nx*ny*nz;
   res = cntc_call('subs_getresults', ire, icp, iblk, n, numel(icol), icol, zeros(n,numel(icol)));
   cntc_report_errors('subs_getresults', ire, icp);
   if (~all_columns)
      return
   end
   t   = res;
   res = struct('nx',nx, 'ny',ny, 'nz',nz, 'npoints',n);
   res.x = t(1:nx, 1);
   res.y = t(1:nx:nx*ny, 2);
   res.z = t(1:nx*ny:n, 3);
   names = {'ux',4; 'uy',5; 'uz',6; 'sighyd',7; 'sigvm',8; 'sigtr',9; 'sigma1',10; 'sigma2',11; 'sigma3',12; ...
            'sigxx',13; 'sigxy',16; 'sigyy',17; 'sigxz',19; 'sigyz',20; 'sigzz',21};
   for i = 1 : size(names,1)
      res.(names{i,1}) = reshape(t(:,names{i,2}), [nx ny nz]);
   end

end % function subs_getresults
