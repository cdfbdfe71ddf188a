function cntc_setnormalforce( ire, icp, fn )
% CNTC_SETNORMALFORCE  Prescribe the normal force (module 3); sets N = 1.
%
%   cntc_setnormalforce( ire, icp, fn )
%
%   ire, icp   result element and contact patch or problem (default 1, 1)
%   fn       normal force [F]

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_setnormalforce');
   cntc_call('cntc_setnormalforce', ire, icp, fn);
   cntc_tell('cntc_setnormalforce', ire, icp);

end % function cntc_setnormalforce
