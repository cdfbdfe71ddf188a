function [ fld ] = cntc_getfielddata( ire, icp, ifld )
% CNTC_GETFIELDDATA  Get one field for each element.
%
%   fld = cntc_getfielddata( ire, icp, ifld )
%
%   ire, icp  result element and contact patch or problem (default 1, 1)
%   ifld      CNTC.fld_* (default CNTC.fld_pn)
%   fld       value of each element, in the unit of the field
%   Values of elements are (my,mx) arrays; 0 if there is no grid yet.
%
% See also: cntc_getmagicnumbers.
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getfielddata');
   if (nargin<3 || isempty(ifld))
      ifld = 5;   % CNTC.fld_pn
   end
   [mx, my] = cntc_getnumelements(ire, icp);
   if (mx*my<=0)
      fld = 0;
      return
   end
   fld = cntc_call('cntc_getfielddata', ire, icp, ifld, mx*my, zeros(mx,my));
   cntc_report_errors('cntc_getfielddata', ire, icp);
   fld = fld';

end % function cntc_getfielddata
