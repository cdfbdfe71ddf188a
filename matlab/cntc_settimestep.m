function cntc_settimestep( ire, icp, dt )
% CNTC_SETTIMESTEP  Accept a time step, which has no effect: shifts have 1 s, rolling the step over the velocity.
%
%   cntc_settimestep( ire, icp, dt )
%
%   ire, icp  result element (default 1) and contact patch or problem; -1 (default): wheel and rail as a whole
%   dt        time step [T]
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'whole', 'cntc_settimestep');
   cntc_call('cntc_settimestep', ire, icp, dt);
   cntc_report_errors('cntc_settimestep', ire, icp);

end % function cntc_settimestep
