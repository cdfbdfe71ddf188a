function [ y, z ] = section_at( p, u )
% SECTION_AT  Points of a profile, for slices interpolated at the position u [mm, for wheels rad].
%
% Beyond the first or last slice that slice is used.

   if (~isfield(p, 'vy'))
      y = p.ProfileY(:);
      z = p.ProfileZ(:);
      return
   end
   u = min(p.u(end), max(p.u(1), u));
   y = interp1(p.u, p.vy, u)';
   z = interp1(p.u, p.vz, u)';
   there = ~isnan(y) & ~isnan(z);
   y = y(there);
   z = z(there);

end % function section_at
