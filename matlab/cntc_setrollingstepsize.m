function cntc_setrollingstepsize( ire, icp, chi, dq )
% CNTC_SETROLLINGSTEPSIZE  Set rolling direction and step.
%
%   cntc_setrollingstepsize( ire, icp, chi, dq )
%
%   ire, icp  result element (default 1) and contact patch or problem; -1 (default): wheel and rail as a whole
%   chi       rolling direction [A], basic contact (default 0)
%   dq        rolling step: in basic contact [L], default 2 mm; for wheel and rail relative to the element size [-].
%             Calculations leave it, cntc_getparameters returns the step that was used
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'cntc_setrollingstepsize');
   if (nargin<3 || isempty(chi))
      chi = 0;
   end
   cntc_call('cntc_setrollingstepsize', ire, icp, chi, dq);
   cntc_report_errors('cntc_setrollingstepsize', ire, icp);

end % function cntc_setrollingstepsize
