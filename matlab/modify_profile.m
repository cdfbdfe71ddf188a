function [ p ] = modify_profile( p, is_wheel, mirror_y, mirror_z, scale_yz, inversion )
% MODIFY_PROFILE  Mirror, scale and order the points of a profile.
%
%   p = modify_profile( p, is_wheel, mirror_y, mirror_z, scale_yz, inversion )
%
%   p          struct with columns ProfileY and ProfileZ
%   is_wheel   1 for a wheel, 0 for a rail (default)
%   mirror_y   1: change the sign of y
%   mirror_z   1: change the sign of z; 0 (default): find out from the side faces; -1: keep it
%   scale_yz   factor of y and z (default 1)
%   inversion  1: reverse the list of points; 0: keep it; [] (default): find out
%
%   p          the struct with new ProfileY, ProfileZ, ProfileS and is_wheel
%
% See also: read_profile.

   if (nargin<2 || isempty(is_wheel))
      is_wheel = 0;
   end
   if (nargin<3 || isempty(mirror_y))
      mirror_y = 0;
   end
   if (nargin<4 || isempty(mirror_z))
      mirror_z = 0;
   end
   if (nargin<5 || isempty(scale_yz))
      scale_yz = 1;
   end
   if (nargin<6)
      inversion = [];
   end

   y = p.ProfileY(:);
   z = p.ProfileZ(:);
   if (numel(y)<2)
      error('modify_profile: a profile needs at least two points, there are %d.', numel(y));
   end
   if (mirror_y==1)
      y = -y;
   end
   if (mirror_z==1 || (mirror_z==0 && is_upside_down(z, is_wheel)))
      z = -z;
   end
   y = scale_yz * y;
   z = scale_yz * z;
   if (isempty(inversion))
      inversion = runs_backwards(y, z, is_wheel);
   end
   if (inversion)
      y = flipud(y);
      z = flipud(z);
   end
   if ((y(end)-y(1))*(1-2*(is_wheel~=0)) <= 0)
      order = {'increase from the track centre to the field side','decrease from the field side to the track centre'};
      error('modify_profile: y of the profile must %s; it runs from %g to %g.', order{1+(is_wheel~=0)}, y(1), y(end));
   end

   p.ProfileY = y;
   p.ProfileZ = z;
   p.ProfileS = chord_sums(y, z);
   p.is_wheel = is_wheel;

end % function modify_profile

%------------------------------------------------------------------------------------------------------

function [ upside_down ] = is_upside_down( z, is_wheel )
% Does z point up? The sides of a rail hang down; of a wheel the flange does, and the field side is highest

   n = numel(z);
   [zmin, lowest]  = min(z);
   [zmax, highest] = max(z);
   if (is_wheel)
      near = max(1, fix(0.05*n));
      if (at_end(lowest, near, n))
         upside_down = false;
      elseif (at_end(highest, near, n))
         upside_down = true;
      else
         upside_down = z(fix((lowest+highest)/2)) > (zmin+zmax)/2;
      end
      return
   end

   % where z falls inwards from an end, the side face points down
   near  = max(1, fix(0.10*n));
   limit = 0.001 * (zmax-zmin);
   last  = min(n, 1+near);
   votes = direction(z(1:last), limit) + direction(z(n:-1:n+1-last), limit);
   known = direction(z(1:last), limit)~=0 || direction(z(n:-1:n+1-last), limit)~=0;
   if (known)
      upside_down = votes<0;
   else
      upside_down = at_end(lowest, near, n) && limit>0;
   end

end % function is_upside_down

%------------------------------------------------------------------------------------------------------

function [ yes ] = at_end( i, near, n )

   yes = (i<=near || i>n-near);

end % function at_end

%------------------------------------------------------------------------------------------------------

function [ d ] = direction( z, limit )
% 1: z falls inwards from the first point; -1: it rises; 0: there is no visible change

   d = 0;
   i = find(abs(z-z(1))>limit, 1);
   if (~isempty(i))
      d = sign(z(1) - z(i));
   end

end % function direction

%------------------------------------------------------------------------------------------------------

function [ backwards ] = runs_backwards( y, z, is_wheel )
% Must the list be reversed? Told by the steps at the highest point of a rail and at the tip of a flange

   n = numel(y);
   if (~is_wheel)
      [~, i] = min(z);
      i = min(i, n-1);
      backwards = y(i+1) < y(i);
      return
   end
   [~, i] = max(z);
   if (i==1 || i==n)
      i = min(i, n-1);
      backwards = y(i+1) > y(i);
      return
   end
   before = y(i) - y(i-1);
   behind = y(i+1) - y(i);
   if (before<=0 && behind<=0)
      backwards = false;
   elseif (before>=0 && behind>=0)
      backwards = true;
   else
      % the material stays on the right-hand side, so the tip is a turn to the right
      backwards = before*(z(i+1)-z(i)) - behind*(z(i)-z(i-1)) < 0;
   end

end % function runs_backwards
