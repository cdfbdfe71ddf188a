function cntc_closelibrary(  )
% CNTC_CLOSELIBRARY  Release all result elements, close the files and unload the library.
%
%   cntc_closelibrary()
%
%
% See also: cntc_initlibrary.

   cntc_call('cntc_finalizelast');
   cntc_library('unload');

end % function cntc_closelibrary
