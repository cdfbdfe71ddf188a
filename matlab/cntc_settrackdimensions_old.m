function cntc_settrackdimensions_old( ire, ztrack, params )
% CNTC_SETTRACKDIMENSIONS_OLD  Set the track by values in an older order.
%
%   cntc_settrackdimensions_old( ire, ztrack, params )
%
%   ire       result element of a wheel-rail problem (default 1)
%   ztrack    params
%   1         gaugwd, gaught [L], cant [A], nomradr [L]
%   2         dyrail, dzrail [L], drollr [A], vyrail, vzrail [V], vrollr [A/T]
%   3         those of 1 and 2
%
% See also: cntc_settrackdimensions.

   counts = [4 6 10];
   if (~any(ztrack==[1 2 3]) || numel(params)~=counts(ztrack))
      error('cntc_settrackdimensions_old: ztrack = %d with %d values; accepted: 1 with 4, 2 with 6, 3 with 10.', ...
            ztrack, numel(params));
   end
   params = params(:)';
   if (ztrack~=2)
      % measured at a height, no second point
      params = [params(2) 0 params([1 3 4]) params(5:end)];
   end
   cntc_settrackdimensions(ire, ztrack, params);

end % function cntc_settrackdimensions_old
