function cntc_settrackdimensions_new( ire, ztrack, params )
% CNTC_SETTRACKDIMENSIONS_NEW  Older name of cntc_settrackdimensions.
%
%   cntc_settrackdimensions_new( ire, ztrack, params )
%
% See also: cntc_settrackdimensions.

   if (nargin<3)
      params = [];
   end
   cntc_settrackdimensions(ire, ztrack, params);

end % function cntc_settrackdimensions_new
