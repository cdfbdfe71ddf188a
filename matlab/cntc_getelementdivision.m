function [ eldiv ] = cntc_getelementdivision( ire, icp )
% CNTC_GETELEMENTDIVISION  Get the state of each element.
%
%   eldiv = cntc_getelementdivision( ire, icp )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   eldiv     0 exterior, 1 adhesion, 2 slip, 3 plastic
%   Values of elements are (my,mx) arrays; 0 if there is no grid yet.
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getelementdivision');
   [mx, my] = cntc_getnumelements(ire, icp);
   if (mx*my<=0)
      eldiv = 0;
      return
   end
   eldiv = cntc_call('cntc_getelementdivision', ire, icp, mx*my, zeros(mx,my));
   cntc_report_errors('cntc_getelementdivision', ire, icp);
   eldiv = eldiv';

end % function cntc_getelementdivision
