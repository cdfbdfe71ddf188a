function cntc_setrollingstepsize( ire, icp, chi, dq )
% CNTC_SETROLLINGSTEPSIZE  Set rolling direction and step.
%
%   cntc_setrollingstepsize( ire, icp, chi, dq )
%
%   ire, icp   result element (default 1) and contact problem: -1 (default) for wheel and rail, 1 to 9 in module 3
%   chi      rolling direction [A], module 3 (default 0)
%   dq       rolling step: in module 3 [L], in module 1 relative to the size of elements [-]

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
   cntc_tell('cntc_setrollingstepsize', ire, icp);

end % function cntc_setrollingstepsize
