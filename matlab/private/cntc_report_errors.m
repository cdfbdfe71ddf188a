function cntc_report_errors( name, ire, icp, ierror, idebug )
% CNTC_REPORT_ERRORS  Report an error of a call of the library by a warning with its reason.
%
%   ierror   error code of the routine, if it has one
%   idebug   0: silent; 1: errors; 2: also positive codes (default: that of cntc_initlibrary)

   if (nargin<4)
      ierror = 0;
   end
   if (nargin<5)
      idebug = cntc_library('idebug');
   end
   code = 0;
   text = '';
   if (cntc_library('mex'))
      [code, text] = cntc_mex('error', ire, icp);
      if (code==0)
         % errors that do not belong to a problem
         [code, text] = cntc_mex('error', 0, -1);
      end
   end
   if (idebug<1)
      return
   end
   if (ierror<0)
      warning('contact:error', '%s: error %d. %s', name, ierror, text);
   elseif (code~=0)
      warning('contact:error', '%s: %s', name, text);
   elseif (ierror>0 && idebug>=2)
      warning('contact:remark', '%s: remark %d. %s', name, ierror, text);
   end

end % function cntc_report_errors
