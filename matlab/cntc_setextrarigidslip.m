function cntc_setextrarigidslip( ire, icp, wx, wy )
% CNTC_SETEXTRARIGIDSLIP  Set the extra term of the rigid slip (basic contact).
%
%   cntc_setextrarigidslip( ire, icp, wx, wy )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   wx, wy    values for each element [-], in shifts [mm]
%   Values of elements are (my,mx) arrays.
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_setextrarigidslip');
   if (numel(wx)~=numel(wy))
      error('cntc_setextrarigidslip: wx has %d values, wy has %d.', numel(wx), numel(wy));
   end
   wx = wx';
   wy = wy';
   cntc_call('cntc_setextrarigidslip', ire, icp, numel(wx), wx(:), wy(:));
   cntc_report_errors('cntc_setextrarigidslip', ire, icp);

end % function cntc_setextrarigidslip
