function [ y, z, ny, nz ] = points_on_surface( c, s )
% POINTS_ON_SURFACE  Points on the profile for lateral contact coordinates s [mm].
%
%   c        struct of CONTACT_FRAME
%   s        lateral coordinates
%   y, z     points on the profile, NaN beyond its ends [mm]
%   ny, nz   direction normal to the contact there, pointing from the wheel into the rail
%
% In a planar contact points are projected along the normal of the contact plane; in a conformal contact s is the
% arc length along the profile from the contact reference.

   s  = s(:)';
   t  = [cos(c.delta), sin(c.delta)];
   n  = [-sin(c.delta), cos(c.delta)];
   sp = (c.py-c.y)*t(1) + (c.pz-c.z)*t(2);
   np = (c.py-c.y)*n(1) + (c.pz-c.z)*n(2);
   [~, k] = min(sp.^2 + np.^2);

   if (c.conformal)
      len = chord_sums(c.py, c.pz);
      dir = sign(sp(min(end,k+1)) - sp(max(1,k-1)));
      at  = len(k) - dir*sp(k) + dir*s;
      y   = interp1(len, c.py, at);
      z   = interp1(len, c.pz, at);
      h   = 0.01;
      ty  = dir * (interp1(len,c.py,at+h) - interp1(len,c.py,at-h)) / (2*h);
      tz  = dir * (interp1(len,c.pz,at+h) - interp1(len,c.pz,at-h)) / (2*h);
      size_t = hypot(ty, tz);
      ny  = -tz ./ size_t;
      nz  =  ty ./ size_t;
      return
   end

   % the piece of the profile around the contact on which each s occurs once
   ds = diff(sp);
   dir = sign(ds(min(k,numel(ds))));
   first = k;
   while (first>1 && ds(first-1)*dir>0)
      first = first - 1;
   end
   last = k;
   while (last<numel(sp) && ds(last)*dir>0)
      last = last + 1;
   end
   if (last==first)
      error('plot3d: the contact reference (%.3f, %.3f) mm is not on this profile.', c.y, c.z);
   end
   off = interp1(sp(first:last), np(first:last), s);
   y   = c.y + s*t(1) + off*n(1);
   z   = c.z + s*t(2) + off*n(2);
   ny  = n(1) + 0*s;
   nz  = n(2) + 0*s;

end % function points_on_surface
