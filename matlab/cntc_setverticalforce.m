function cntc_setverticalforce( ire, fz )
% CNTC_SETVERTICALFORCE  Prescribe the vertical force of wheel on rail; sets N = 1.
%
%   cntc_setverticalforce( ire, fz )
%
%   ire       result element of a wheel-rail problem (default 1)
%   fz        vertical force [F]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   ire = cntc_ids(ire);
   cntc_call('cntc_setverticalforce', ire, fz);
   cntc_report_errors('cntc_setverticalforce', ire, -1);

end % function cntc_setverticalforce
