function cntc_setflags( ire, icp, params, values )
% CNTC_SETFLAGS  Set flags and control digits.
%
%   cntc_setflags( ire, icp, params, values )
%
%   ire, icp  result element (default 1) and contact patch or problem; -1 (default): wheel and rail as a whole
%   params    codes CNTC.if_*, CNTC.ic_* and CNTC.own_*; 0 is skipped
%   values    one value for each
%
% See also: cntc_getmagicnumbers, cntc_getflags.
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'cntc_setflags');
   if (numel(params)~=numel(values))
      error('cntc_setflags: there are %d params and %d values.', numel(params), numel(values));
   end
   cntc_call('cntc_setflags', ire, icp, numel(params), params, values);
   cntc_report_errors('cntc_setflags', ire, icp);

end % function cntc_setflags
