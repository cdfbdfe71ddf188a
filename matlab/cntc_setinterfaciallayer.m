function cntc_setinterfaciallayer( ire, icp, imeth, params )
% CNTC_SETINTERFACIALLAYER  Set a layer between the bodies, older name; elastic constants are kept.
%
%   cntc_setinterfaciallayer( ire, icp, imeth, params )
%
%   ire, icp   result element (default 1) and contact problem, 1 to 9 in module 3; not for wheel and rail
%   imeth      params
%   0          none                                            no layer
%   2          flx [L3/F], k0_mf, alfamf, betamf [-]           Fastsim, one flexibility
%   3          k0_mf, alfamf, betamf [-]                       Fastsim with three flexibilities
%   4          gg3 [F/L2], laythk [L], tau_c0 [F/L2], k_tau [F/L3]   layer that may yield
%
% See also: cntc_setmaterialparameters, cntc_setmaterialproperties.

   if (nargin<1), ire = []; end
   if (nargin<4), params = []; end
   methods = [0 2 3 4];
   counts  = [0 4 3 4];
   if (~any(methods==imeth) || numel(params)~=counts(methods==imeth))
      error('cntc_setinterfaciallayer: method %d with %d values; accepted: 0 with none, 2 with 4, 3 with 3, 4 with 4.', ...
            imeth, numel(params));
   end
   if (isempty(icp) || icp==-1)
      error('cntc_setinterfaciallayer: for wheel and rail the elastic constants are not known here; use cntc_setmaterialparameters.');
   end
   m = cntc_getparameters(ire, icp, 2);
   cntc_setmaterialparameters(ire, icp, imeth, [m.poiss1 m.poiss2 m.gg1 m.gg2 params(:)']);

end % function cntc_setinterfaciallayer
