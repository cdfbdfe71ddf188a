function cntc_setfrictionmethod( ire, icp, imeth, params )
% CNTC_SETFRICTIONMETHOD  Set the friction law, imeth = 10 V + L.
%
%   cntc_setfrictionmethod( ire, icp, imeth, params )
%
%   ire, icp  result element (default 1) and contact patch or problem; -1 (default): wheel and rail as a whole
%   L         params
%   0         fstat, fkin [-]                                        Coulomb; both become the smaller one
%   1         none                                                   as before
%   2, 3, 4   fkin, coef1 [-], sabsh1 [V], coef2 [-], sabsh2 [V], memdst [L], mem_s0 [V]
%                                                                    falls with slip: linear, rational, exponential
%   5         fstat [-], polach_a [-], polach_b [1/V]                exponential, after Polach
%   6         fref [-], tref [degC], dfheat [-], dtheat [degC], memdst [L], mem_s0 [V]      falls with temperature
%   For V = 1 and 2 (wheel and rail) params are n, then n times an angle [A] or a position [L] with the values above.
%   Default: imeth = 0, params = [].
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'cntc_setfrictionmethod');
   if (nargin<3 || isempty(imeth))
      imeth = 0;
   end
   if (nargin<4 || isempty(params))
      params = [];
   end
   cntc_call('cntc_setfrictionmethod', ire, icp, imeth, numel(params), params);
   cntc_report_errors('cntc_setfrictionmethod', ire, icp);

end % function cntc_setfrictionmethod
