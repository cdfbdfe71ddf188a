function cntc_setmaterialparameters( ire, icp, imeth, rparam )
% CNTC_SETMATERIALPARAMETERS  Set the material by the M digit, or damping by 10 + the M2 digit.
%
%   cntc_setmaterialparameters( ire, icp, imeth, rparam )
%
%   ire, icp  result element (default 1) and contact patch or problem; -1 (default): wheel and rail as a whole
%   imeth     rparam; up to 7 it begins with nu1, nu2 [-], G1, G2 [F/L2], shown as ..
%   0         ..                                          elastic
%   1         .., fg1, fg2 [-], tc1, tc2 [T]              viscoelastic
%   2         .., flx [L3/F], k0_mf, alfamf, betamf [-]   Fastsim, one flexibility
%   3, 5      .., k0_mf, alfamf, betamf [-]               Fastsim with three flexibilities, modified FaStrip
%   4         .., gg3 [F/L2], laythk [L], tau_c0 [F/L2], k_tau [F/L3]   layer that may yield
%   6, 7      ..                                          FaStrip as published; with the correction of full sliding
%   10, 11    none                                        no damping, damping as before
%   12        cdampn, cdampt [T], dfnmax, dftmax [F/T]    damping
%   With flag CNTC.ic_bound = 1, set before, 0 to 7 take one value more, the last: the flexibility of a
%   thin sheet [L3/F]. The limit maxout of outer iterations becomes 10 in place of 1 for unlike bodies;
%   cntc_setsolverflags, called later, replaces it. Like bodies have one outer iteration.
%   Default: imeth = 0, rparam = [].
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'cntc_setmaterialparameters');
   if (nargin<3 || isempty(imeth))
      imeth = 0;
   end
   if (nargin<4 || isempty(rparam))
      rparam = [];
   end
   cntc_call('cntc_setmaterialparameters', ire, icp, imeth, numel(rparam), rparam);
   cntc_report_errors('cntc_setmaterialparameters', ire, icp);

end % function cntc_setmaterialparameters
