function cntc_setwear( ire, icp, params )
% CNTC_SETWEAR  Set the parameters of wear and fatigue, and the flag CNTC.own_wear.
%
%   cntc_setwear( ire, icp, params )
%
%   params    Archard's wear coefficient [-], hardness of the softer body [F/L2], required with it, and yield stress
%             in cyclic shear [F/L2]; 0: not given
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   cntc_call('cntc_setwear', ire, icp, numel(params), params);

end % function cntc_setwear
