function [ nx, ny, nz ] = subs_getblocksize( ire, icp, iblk )
% SUBS_GETBLOCKSIZE  Get the numbers of points of a block.
%
%   [nx, ny, nz] = subs_getblocksize( ire, icp, iblk )
%
%   ire, icp    result element and contact patch or problem (default 1, 1)
%   iblk        number of the block (default 1)
%   nx, ny, nz  numbers of points, -1 if there is no such block
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'subs_getblocksize');
   if (nargin<3 || isempty(iblk))
      iblk = 1;
   end
   [nx, ny, nz] = cntc_call('subs_getblocksize', ire, icp, iblk, [], [], []);
   cntc_report_errors('subs_getblocksize', ire, icp);

end % function subs_getblocksize
