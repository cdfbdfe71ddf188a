function [ p ] = read_profile( fname, is_wheel, mirror_y, mirror_z, scale_yz, rgt_side, idebug, make_plot, varargin )
% READ_PROFILE  Read a wheel or rail profile of any format and convert it to the form used by CONTACT.
%
%   p = read_profile( fname, is_wheel, mirror_y, mirror_z, scale_yz, rgt_side, idebug, make_plot )
%
%   fname      file: Simpack (.prr, .prw), Miniprof (.ban, .whl), Vampire (.rai, .whe), slices (.slcs, .slcw), or a table of
%              two columns
%   is_wheel   1 for a wheel, 0 for a rail; [] (default): from the extension, otherwise a rail
%   mirror_y   1: change the sign of y; 0 (default): keep it; -1: keep it, overriding a Simpack file
%   mirror_z   1: change the sign of z; 0 (default): detect, for Simpack as the file says; -1: keep it
%   scale_yz   factor of y and z that makes them mm (default 1)
%   rgt_side   Vampire: 1 (default) the right profile of the file, 0 the left one
%   idebug     accepted for compatibility and ignored, as arguments after make_plot
%   make_plot  number of a figure in which the profile is drawn; 0 (default): none
%
%   p   struct with columns ProfileY, ProfileZ [mm] and ProfileS [mm], sums of chords from the first
%       point on, and with Fname and is_wheel. Right-hand side profile, y positive to the field side, z
%       positive down; rails from the track centre to the field side, wheels in the opposite direction.
%       For slices the struct of READ_SLICES.
%
% Smoothing and the removal of zig-zags are done by the program.
%
% See also: read_slices, read_simpack, read_miniprof, modify_profile, plot3d.

   if (nargin<2)
      is_wheel = [];
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

   [~, ~, ext] = fileparts(fname);
   ext = [lower(ext), '    '];
   kind = ext(2:4);
   wheel_kind = any(strcmp(kind, {'prw','whl','whe'})) || strcmp(ext(2:5), 'slcw');
   rail_kind  = any(strcmp(kind, {'prr','ban','rai'})) || strcmp(ext(2:5), 'slcs');
   if (isempty(is_wheel))
      is_wheel = wheel_kind;
   elseif ((is_wheel && rail_kind) || (~is_wheel && wheel_kind))
      body = {'rail','wheel'};
      error('read_profile: "%s" is a %s profile by its extension; a %s was requested.', fname, ...
            body{1+wheel_kind}, body{1+(is_wheel~=0)});
   end

   if (strcmp(kind, 'slc'))
      p = read_slices(fname, mirror_y, mirror_z, scale_yz);
      return
   elseif (any(strcmp(kind, {'rai','whe'})))
      if (nargin<6)
         rgt_side = [];
      end
      p = read_vampire(fname, rgt_side);
      % z points downwards already
      if (mirror_z==0)
         mirror_z = -1;
      end
   elseif (any(strcmp(kind, {'prr','prw'})))
      p = read_simpack(fname);
      if ((p.type==1) ~= is_wheel)
         error('read_profile: "%s" has type = %d in its header, which does not fit its extension.', fname, p.type);
      end
      % mirroring twice has no effect; -1 disables the mirroring of the file
      mirror_y = (mirror_y + p.mirror_y == 1);
      if (p.mirror_z==1 && mirror_z~=0)
         mirror_z = -1;
      elseif (mirror_z==0)
         mirror_z = 2*p.mirror_z - 1;
      end
   else
      p = read_miniprof(fname);
   end
   % the order of points is detected from the shape; that of the file does not apply if y is mirrored, and may be wrong
   p = modify_profile(p, is_wheel, mirror_y, mirror_z, scale_yz);
   if (nargin>=8 && ~isempty(make_plot) && make_plot>0)
      figure(make_plot);
      clf
      plot(p.ProfileY, p.ProfileZ, '-o');
      set(gca, 'ydir','reverse');
      axis equal
      grid on
      xlabel('y [mm]');
      ylabel('z [mm]');
      title(fname, 'interpreter','none');
   end

end % function read_profile
