function [ ire, icp ] = cntc_ids( ire, icp, kind, caller )
% CNTC_IDS  Result element and contact problem of a call, with their defaults.
%
%   kind   'patch': a contact patch or problem, default 1; 'whole': default -1, wheel and rail as a whole;
%          'patch or whole': both are allowed, default 1

   if (isempty(ire))
      ire = 1;
   end
   if (nargin<2)
      return
   end
   if (isempty(icp))
      icp = 1;
      if (strcmp(kind, 'whole'))
         icp = -1;
      end
   end
   if (strcmp(kind,'patch') && icp<=0)
      error('%s: icp must be the number of a contact patch or problem, 1 or larger; it is %d.', caller, icp);
   end

end % function cntc_ids
