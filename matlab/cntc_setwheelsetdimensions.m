function cntc_setwheelsetdimensions( ire, ewheel, params )
% CNTC_SETWHEELSETDIMENSIONS  Set the dimensions of the wheelset.
%
%   cntc_setwheelsetdimensions( ire, ewheel, params )
%
%   ire       result element of a wheel-rail problem (default 1)
%   ewheel    3, 5: new dimensions; 0, 1, 2, 4: as before (default 3)
%   params    fbdist, fbpos, nomradw, optional ytape [L]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   ire = cntc_ids(ire);
   if (nargin<2 || isempty(ewheel))
      ewheel = 3;
   end
   if (nargin<3 || isempty(params))
      params = [];
   end
   cntc_call('cntc_setwheelsetdimensions', ire, ewheel, numel(params), params);
   cntc_report_errors('cntc_setwheelsetdimensions', ire, -1);

end % function cntc_setwheelsetdimensions
