function [ p ] = modify_profile( p, is_wheel, mirror_y, mirror_z, scale_yz, varargin )
% MODIFY_PROFILE  Mirror, scale and order the points of a profile.
%
%   p = modify_profile( p, is_wheel, mirror_y, mirror_z, scale_yz, inversion )
%
%   p          struct with columns ProfileY and ProfileZ
%   is_wheel   1 for a wheel, 0 for a rail (default)
%   mirror_y   1: change the sign of y
%   mirror_z   1: change the sign of z; 0 (default): detect it from the side faces; -1: keep it
%   scale_yz   factor of y and z (default 1)
%   inversion  1: reverse the list of points; 0: keep it; [] (default): detect
%
%   p          the struct with new ProfileY, ProfileZ, ProfileS and is_wheel
%
% Argument list of established scripts, recognised by seven or more arguments, or a y_tape that is neither 0 nor 1:
%
%   p = modify_profile( p, is_wheel, mirror_y, mirror_z, scale_yz, y_tape, reverse_order, point_dist_min, delete_foldback, make_plot )
%
%   mirror_z         1: change the sign of z; direction and order are not detected
%   y_tape           a wheel is moved such that z = 0 at this y; [] (default): not moved
%   reverse_order    1: reverse the list of points
%   point_dist_min   points closer than this to the last point kept, along the profile, are omitted (default: none)
%   delete_foldback  points at which y turns back, seen from the top of a rail or the tip of a flange: 1: p.Mask is 0 there; 2: they
%                    are omitted; 0 (default): they are kept
%   make_plot        number of a figure in which both profiles are drawn; 0 (default): none
%
%   p then has ProfileAngle, ProfileCurvature, ProfileData with these four columns, OrigData, XYPoints and Mask, too
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
   inversion = [];
   if (nargin>6 || (nargin==6 && ~isempty(varargin{1}) && ~any(varargin{1}==[0 1])))
      p = as_established(p, is_wheel, mirror_y, mirror_z, scale_yz, varargin);
      return
   elseif (nargin==6)
      inversion = varargin{1};
   end

   y = p.ProfileY(:);
   z = p.ProfileZ(:);
   if (numel(y)<2)
      error('modify_profile: a profile needs at least two points; this one has %d.', numel(y));
   end
   if (mirror_y==1)
      y = -y;
   end
   if (mirror_z==1 || (mirror_z==0 && is_upside_down(y, z, is_wheel)))
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

function [ p ] = as_established( p, is_wheel, mirror_y, mirror_z, scale_yz, more )
% The list of arguments of established scripts: y_tape, reverse_order, point_dist_min, delete_foldback, make_plot, idebug

   defaults = {[], 0, -1, 0, 0, 0};
   for i = 1 : min(numel(more), numel(defaults))
      if (~isempty(more{i}))
         defaults{i} = more{i};
      end
   end
   [y_tape, reverse_order, point_dist_min, delete_foldback, make_plot] = defaults{1:5};

   data = [p.ProfileY(:), p.ProfileZ(:), zeros(numel(p.ProfileY), 2)];
   columns = {'ProfileY','ProfileZ','ProfileAngle','ProfileCurvature'};
   for i = 3 : 4
      if (isfield(p, columns{i}) && numel(p.(columns{i}))==size(data,1))
         data(:,i) = p.(columns{i})(:);
      end
   end
   p.OrigData = data;
   if (mirror_y>=1)
      data(:,[1 3]) = -data(:,[1 3]);
   end
   if (mirror_z>=1)
      data(:,2:3) = -data(:,2:3);
   end
   data = data .* [scale_yz, scale_yz, 1, 1/scale_yz];
   if (is_wheel && ~isempty(y_tape))
      % the profile near y_tape, where y can be used as its coordinate
      near = find(abs(data(:,1)-y_tape) < 5);
      if (numel(near)<2)
         error('modify_profile: there is no profile at y_tape = %g.', y_tape);
      end
      data(:,2) = data(:,2) - interp1(data(near,1), data(near,2), y_tape);
   end
   if (reverse_order)
      data = flipud(data);
   end
   if (point_dist_min>0)
      data = data(far_apart(data(:,1), data(:,2), point_dist_min), :);
   end
   mask = true(size(data,1), 1);
   if (delete_foldback)
      mask = advances(data(:,1), data(:,2), is_wheel);
   end
   if (delete_foldback>1)
      data = data(mask,:);
      mask = mask(mask);
   end

   for i = 1 : 4
      p.(columns{i}) = data(:,i);
   end
   p.ProfileData = data;
   p.XYPoints = size(data,1);
   p.Mask     = double(mask);
   p.ProfileS = chord_sums(data(:,1), data(:,2));
   p.is_wheel = is_wheel;
   if (make_plot)
      figure(make_plot);
      clf
      plot(p.OrigData(:,1), p.OrigData(:,2), '-*', data(:,1), data(:,2), '-o');
      grid on
      set(gca, 'ydir','reverse');
      xlabel('y [mm]');
      ylabel('z [mm]');
   end

end % function as_established

%------------------------------------------------------------------------------------------------------

function [ keep ] = far_apart( y, z, least )
% Indices of points that are at least a distance from the last point kept, along the profile

   along = [0; cumsum(hypot(diff(y), diff(z)))];
   keep  = 1;
   for i = 2 : numel(along)
      if (along(i)-along(keep(end)) >= least)
         keep(end+1) = i; %#ok<AGROW>
      end
   end

end % function far_apart

%------------------------------------------------------------------------------------------------------

function [ yes ] = advances( y, z, is_wheel )
% Points at which y is farther from the top of a rail, or the tip of a flange, than at all points between

   if (is_wheel)
      y = -y;
      z = -z;
   end
   least = 1e-6 * (max(y)-min(y));
   [~, top] = min(z);
   yes  = false(size(y));
   yes(top) = true;
   right = cummax(y(top:end));
   yes(top+1:end) = y(top+1:end) >= right(1:end-1) + least;
   left = cummin(y(top:-1:1));
   yes(top-1:-1:1) = y(top-1:-1:1) <= left(1:end-1) - least;

end % function advances

%------------------------------------------------------------------------------------------------------

function [ upside_down ] = is_upside_down( y, z, is_wheel )
% Does z point up? The sides of a rail point down; on a wheel the flange does, and the field side is highest

   n = numel(z);
   [zmin, lowest]  = min(z);
   [zmax, highest] = max(z);
   if (is_wheel)
      near = max(1, fix(0.05*n));
      if (at_end(lowest, near, n))
         % a wheel may end at the tip of a flange that points up; the tip has the lowest y
         width = max(y) - min(y);
         upside_down = zmax-zmin > 0.1*width && y(highest)-y(lowest) > 0.5*width && ...
                       z(fix((lowest+highest)/2)) > (zmin+zmax)/2;
      elseif (at_end(highest, near, n))
         upside_down = true;
      else
         upside_down = z(fix((lowest+highest)/2)) > (zmin+zmax)/2;
      end
      return
   end

   % if z decreases inwards from an end, the side face points down
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
% 1: z decreases inwards from the first point; -1: it increases; 0: no significant change

   d = 0;
   i = find(abs(z-z(1))>limit, 1);
   if (~isempty(i))
      d = sign(z(1) - z(i));
   end

end % function direction

%------------------------------------------------------------------------------------------------------

function [ backwards ] = runs_backwards( y, z, is_wheel )
% Must the list be reversed? Determined from the steps at the highest point of a rail and at the tip of a flange

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
      % the material is on the right-hand side, so the profile turns right at the tip
      backwards = before*(z(i+1)-z(i)) - behind*(z(i)-z(i-1)) < 0;
   end

end % function runs_backwards
