function [ sens ] = cntc_getsensitivities( ire, icp, lenout, lenin )
% CNTC_GETSENSITIVITIES  Get derivatives of forces with respect to approach and creepages.
%
%   sens = cntc_getsensitivities( ire, icp, lenout, lenin )
%
%   ire, icp       result element and contact patch or problem (default 1, 1)
%   lenout, lenin  numbers of rows and columns (default 4, 4)
%   sens           rows: Fn [F], Fx, Fy relative to fstat * Fn [-], Mz [F L]; columns, one after the other: approach
%                  [L], creepages and spin; on body 1 and with respect to the creepages as set, in all units; zero if
%                  not computed, see the flag CNTC.ic_sens
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getsensitivities');
   if (nargin<3 || isempty(lenout))
      lenout = 4;
   end
   if (nargin<4 || isempty(lenin))
      lenin = 4;
   end
   sens = cntc_call('cntc_getsensitivities', ire, icp, lenout, lenin, zeros(lenout,lenin));
   cntc_report_errors('cntc_getsensitivities', ire, icp);

end % function cntc_getsensitivities
