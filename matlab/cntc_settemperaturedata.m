function cntc_settemperaturedata( ire, icp, imeth, params )
% CNTC_SETTEMPERATUREDATA  Set thermal data by the H digit.
%
%   cntc_settemperaturedata( ire, icp, imeth, params )
%
%   ire, icp   result element (default 1) and contact problem: -1 (default) for wheel and rail, 1 to 9 in module 3
%   imeth    0: no temperatures; 1: data as before; 3: new data
%   params   imeth = 3: for body 1, then body 2: temperature [degC], heat capacity [J/(kg degC)],
%            conductivity [W/(L degC)], density [kg/L3]; last, betapl, the fraction of plastic work that becomes heat [-]

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'cntc_settemperaturedata');
   if (nargin<3 || isempty(imeth))
      imeth = 0;
   end
   if (nargin<4 || isempty(params))
      params = [];
   end
   if (imeth<=1)
      params = [];
   end
   cntc_call('cntc_settemperaturedata', ire, icp, imeth, numel(params), params);
   cntc_report_errors('cntc_settemperaturedata', ire, icp);

end % function cntc_settemperaturedata
