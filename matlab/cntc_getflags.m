function [ values ] = cntc_getflags( ire, icp, params )
% CNTC_GETFLAGS  Get flags and control digits.
%
%   values = cntc_getflags( ire, icp, params )
%
%   ire, icp   result element (default 1) and contact patch or problem; -1 (default): wheel and rail as a whole
%   params   codes, CNTC.if_... and CNTC.ic_...
%   values   one value for each, in a column
%
% See also: cntc_setflags.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'cntc_getflags');
   values = cntc_call('cntc_getflags', ire, icp, numel(params), params, zeros(numel(params),1));
   cntc_tell('cntc_getflags', ire, icp);

end % function cntc_getflags
