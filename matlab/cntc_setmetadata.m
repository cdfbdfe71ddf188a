function cntc_setmetadata( ire, icp, params, values )
% CNTC_SETMETADATA  Set data that are written to the .mat files.
%
%   cntc_setmetadata( ire, icp, params, values )
%
%   ire, icp  result element (default 1) and contact patch or problem; -1 (default): wheel and rail as a whole
%   params    codes CNTC.mt_*; 0 is skipped
%   values    one value for each: time [s], positions [L], numbers
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
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'cntc_setmetadata');
   if (numel(params)~=numel(values))
      error('cntc_setmetadata: there are %d params and %d values.', numel(params), numel(values));
   end
   cntc_call('cntc_setmetadata', ire, icp, numel(params), params, values);
   cntc_report_errors('cntc_setmetadata', ire, icp);

end % function cntc_setmetadata
