function cntc_finalize( ire )
% CNTC_FINALIZE  Release a result element; with the last one the run ends.
%
%   cntc_finalize( ire )
%
%   ire       number of the result element (default 1)
%
% See also: cntc_closelibrary.
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1 || isempty(ire))
      ire = 1;
   end
   cntc_call('cntc_finalize', ire);

end % function cntc_finalize
