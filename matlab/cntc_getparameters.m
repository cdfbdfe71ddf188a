function [ sol ] = cntc_getparameters( ire, icp, itask )
% CNTC_GETPARAMETERS  Get parameters of kinematics, material or friction, or radii.
%
%   sol = cntc_getparameters( ire, icp, itask )
%
%   ire, icp   result element and contact patch or problem (default 1, 1)
%   itask    1: kinematics (default); 2: material; 3: friction; 4: radii
%   sol      struct. 1: veloc [V], chi [A], dq [L], spinxo, spinyo [L], tau_c0 [F/L2]
%            2: gg1, gg2, gg [F/L2], poiss1, poiss2, poiss, ak [-], flx1, flx2, flx3 [L3/F], k0_mf, alfamf, betamf,
%               k_eff [-], gg3 [F/L2], laythk [L], tau_c0 [F/L2], k_tau [F/L3], cdampn, cdampt [T], dfnmax, dftmax [F/T]
%            3: lmeth, nvf, memdst [mm], mem_s0 [mm/s], columns alpha [rad] or [mm], fstat, fkin [-]
%            4: nomradw, nomradr [L], 0 without a wheel or a roller

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getparameters');
   if (nargin<3 || isempty(itask))
      itask = 1;
   end
   names = {{'veloc','chi','dq','spinxo','spinyo','tau_c0'}, ...
            {'gg1','gg2','gg','poiss1','poiss2','poiss','ak','flx1','flx2','flx3','k0_mf','alfamf','betamf','k_eff', ...
             'gg3','laythk','tau_c0','k_tau','cdampn','cdampt','dfnmax','dftmax'}, {'lmeth','nvf','memdst','mem_s0'}, {'nomradw','nomradr'}};
   if (~any(itask==[1 2 3 4]))
      error('cntc_getparameters: itask must be 1, 2, 3 or 4.');
   end
   % friction of up to 1000 rows
   len = 30 + 3000*(itask==3);
   v   = cntc_call('cntc_getparameters', ire, icp, itask, len, zeros(len,1));
   cntc_report_errors('cntc_getparameters', ire, icp);
   sol = struct();
   for i = 1 : numel(names{itask})
      sol.(names{itask}{i}) = v(i);
   end
   if (itask==3)
      rows = reshape(v(4+(1:3*sol.nvf)), 3, sol.nvf)';
      sol.alpha = rows(:,1);
      sol.fstat = rows(:,2);
      sol.fkin  = rows(:,3);
   end

end % function cntc_getparameters
