function [ npatch ] = cntc_getnumcontactpatches( ire )
% CNTC_GETNUMCONTACTPATCHES  Get the number of contact patches of wheel and rail.
%
%   npatch = cntc_getnumcontactpatches( ire )
%
%   ire       result element of a wheel-rail problem (default 1)
%   npatch    number of patches
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   ire = cntc_ids(ire);
   npatch = cntc_call('cntc_getnumcontactpatches', ire, []);
   cntc_report_errors('cntc_getnumcontactpatches', ire, -1);

end % function cntc_getnumcontactpatches
