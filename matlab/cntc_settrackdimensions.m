function cntc_settrackdimensions( ire, ztrack, params )
% CNTC_SETTRACKDIMENSIONS  Set the track by the Z digit.
%
%   cntc_settrackdimensions( ire, ztrack, params )
%
%   ire       result element of a wheel-rail problem (default 1)
%   ztrack    params
%   0         none                                              as before
%   1         gaught [L]; then, for gaught > 0, gaugsq [-], gaugwd [L], else raily0, railz0 [L];
%             cant [A], nomradr [L], optional curv [1/L]
%   2         dyrail, dzrail [L], drollr [A], vyrail, vzrail [V], vrollr [A/T]
%   3         those of 1 and 2
%   32, 33    kyrail [F/L], fyrail [F], kzrail [F/L], fzrail [F], optional dystep0 [L]
%   Default: params = [].
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   ire = cntc_ids(ire);
   if (nargin<3 || isempty(params))
      params = [];
   end
   cntc_call('cntc_settrackdimensions', ire, ztrack, numel(params), params);
   cntc_report_errors('cntc_settrackdimensions', ire, -1);

end % function cntc_settrackdimensions
