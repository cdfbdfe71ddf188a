function cntc_settimestep( ire, icp, dt )
% CNTC_SETTIMESTEP  Set the time step of shifts.
%
%   cntc_settimestep( ire, icp, dt )
%
%   ire, icp   result element (default 1) and contact problem: -1 (default) for wheel and rail, 1 to 9 in module 3
%   dt       time step [T]

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'cntc_settimestep');
   cntc_call('cntc_settimestep', ire, icp, dt);
   cntc_tell('cntc_settimestep', ire, icp);

end % function cntc_settimestep
