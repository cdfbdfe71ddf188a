function [ values ] = cntc_getflags( ire, icp, params )
% CNTC_GETFLAGS  Get flags and control digits.
%
%   values = cntc_getflags( ire, icp, params )
%
%   ire, icp  result element (default 1) and contact patch or problem; -1 (default): wheel and rail as a whole
%   params    codes CNTC.if_*, CNTC.ic_* and CNTC.own_*
%   values    one value for each
%
% See also: cntc_setflags.
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'cntc_getflags');
   values = cntc_call('cntc_getflags', ire, icp, numel(params), params, zeros(numel(params),1));
   cntc_report_errors('cntc_getflags', ire, icp);

end % function cntc_getflags
