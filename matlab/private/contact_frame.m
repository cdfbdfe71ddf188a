function [ c ] = contact_frame( sol, body, p )
% CONTACT_FRAME  Contact reference of a patch in rail or wheel coordinates, with the section of the profile there.
%
%   sol    struct of one patch
%   body   'r' rail, 'w' wheel
%   p      profile in the coordinates of the case
%
%   c      x, y, z: contact reference [mm]; delta: angle from the body's y-axis to the lateral contact
%          axis [rad]; radius: of the surface of revolution [mm], Inf for a rail, negative for a roller, whose
%          centre is below; py, pz: section of the profile [mm]; conformal: is the lateral coordinate measured
%          along the profile?

   m = sol.meta;
   c.conformal = (sol.d_digit==4);
   if (body=='r')
      c.x = m.xcp_r;   c.y = m.ycp_r;   c.z = m.zcp_r;
      c.delta  = m.deltcp_r;
      c.radius = Inf;
      if (sol.config>=4)
         c.radius = -m.rnom_rol;
      end
   else
      c.x = m.xcp_w;   c.y = m.ycp_w;   c.z = m.zcp_w;
      c.delta  = m.deltcp_r + m.roll_r - m.roll_w;
      c.radius = m.rnom_whl;
   end
   [c.py, c.pz] = section_at(p, along_position(sol, body, c.x));

end % function contact_frame
