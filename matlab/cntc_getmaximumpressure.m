function [ pmax ] = cntc_getmaximumpressure( ire, icp )
% CNTC_GETMAXIMUMPRESSURE  Get the largest pressure.
%
%   pmax = cntc_getmaximumpressure( ire, icp )
%
%   ire, icp   result element and contact patch or problem (default 1, 1)
%   pmax     pressure [F/L2]

   if (nargin<1)
      ire = [];
   end
   if (nargin<2)
      icp = [];
   end
   [ire, icp] = cntc_ids(ire, icp, 'patch', 'cntc_getmaximumpressure');
   pmax = cntc_call('cntc_getmaximumpressure', ire, icp, []);
   cntc_tell('cntc_getmaximumpressure', ire, icp);

end % function cntc_getmaximumpressure
