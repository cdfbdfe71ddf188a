function cntc_setglobalflags( params, values )
% CNTC_SETGLOBALFLAGS  Set flags of the library as a whole.
%
%   cntc_setglobalflags( params, values )
%
%   params    codes CNTC.if_idebug, CNTC.if_openmp; 0 is skipped
%   values    one value for each
%
% See also: cntc_getmagicnumbers.
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (numel(params)~=numel(values))
      error('cntc_setglobalflags: there are %d params and %d values.', numel(params), numel(values));
   end
   cntc_call('cntc_setglobalflags', numel(params), params, values);

end % function cntc_setglobalflags
