function [ a, b ] = rail_to_track( m, rear, y_contact, a, b )
% RAIL_TO_TRACK  Points of a rear or side view of the rail in track coordinates.
%
%   m      meta of the patch
%   rear   (a,b) are (y,z); else (x,z), at the lateral position y_contact of the contact

   y = y_contact;
   if (rear)
      y = a;
      a = m.y_r + cos(m.roll_r)*y - sin(m.roll_r)*b;
   end
   b = m.z_r + sin(m.roll_r)*y + cos(m.roll_r)*b;

end % function rail_to_track
