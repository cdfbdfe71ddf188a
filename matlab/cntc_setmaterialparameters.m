function cntc_setmaterialparameters( ire, icp, m_digit, rparam )
% CNTC_SETMATERIALPARAMETERS  Set the material by the M digit, or damping by 10 + the M2 digit.
%
%   cntc_setmaterialparameters( ire, icp, m_digit, rparam )
%
%   ire, icp   result element (default 1) and contact problem: -1 (default) for wheel and rail, 1 to 9 in module 3
%   m_digit  rparam; up to 7 it begins with nu1, nu2 [-], g1, g2 [F/L2], shown as ..
%   0        ..                                          elastic
%   1        .., fg1, fg2 [-], tc1, tc2 [T]              viscoelastic
%   2        .., flx [L3/F], k0_mf, alfamf, betamf [-]   Fastsim, one flexibility
%   3, 5     .., k0_mf, alfamf, betamf [-]               Fastsim with three flexibilities, FaStrip
%   4        .., gg3 [F/L2], laythk [L], tau_c0 [F/L2], k_tau [F/L3]   layer
%   10, 11   none                                        no damping, damping as before
%   12       cdampn, cdampt [T], dfnmax, dftmax [F/T]    damping

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'cntc_setmaterialparameters');
   if (nargin<3 || isempty(m_digit))
      m_digit = 0;
   end
   if (nargin<4 || isempty(rparam))
      rparam = [];
   end
   cntc_call('cntc_setmaterialparameters', ire, icp, m_digit, numel(rparam), rparam);
   cntc_tell('cntc_setmaterialparameters', ire, icp);

end % function cntc_setmaterialparameters
