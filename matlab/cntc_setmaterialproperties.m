function cntc_setmaterialproperties( ire, icp, g1, nu1, g2, nu2 )
% CNTC_SETMATERIALPROPERTIES  Set elastic bodies; abbreviation of cntc_setmaterialparameters with M = 0.
%
%   cntc_setmaterialproperties( ire, icp, g1, nu1, g2, nu2 )
%
%   ire, icp   result element (default 1) and contact problem: -1 (default) for wheel and rail, 1 to 9 in module 3
%   g1, g2     moduli of rigidity [F/L2]
%   nu1, nu2   Poisson's ratios [-]
%
% See also: cntc_setmaterialparameters.

   cntc_setmaterialparameters(ire, icp, 0, [nu1 nu2 g1 g2]);

end % function cntc_setmaterialproperties
