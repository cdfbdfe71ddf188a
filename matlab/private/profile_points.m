function [ yz ] = profile_points( p, caller )
% PROFILE_POINTS  Coordinates of a profile, struct or array, as n x 2 array.

   if (isstruct(p) && isfield(p,'ProfileY') && isfield(p,'ProfileZ'))
      yz = [p.ProfileY(:), p.ProfileZ(:)];
   elseif (isnumeric(p) && size(p,2)==2)
      yz = p;
   else
      error('%s: the profile must be a struct of read_profile or an n x 2 array.', caller);
   end
   if (size(yz,1)<2)
      error('%s: a profile needs at least two points; this one has %d.', caller, size(yz,1));
   end

end % function profile_points
