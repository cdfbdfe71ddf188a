function [ slcs ] = read_slices( fname, mirror_y, mirror_z, scale_yz, idebug )
% READ_SLICES  Read a profile that varies along the rail or around the wheel (.slcs, .slcw) with all its slices.
%
%   slcs = read_slices( fname, mirror_y, mirror_z, scale_yz )
%
%   arguments as for READ_PROFILE, for all slices. The extension distinguishes rails and wheels; a fifth argument,
%   idebug, is ignored
%
%   slcs   struct with Fname, is_wheel, nslc,
%          u          positions of the slices along the track [mm], for wheels angles [rad]
%          prof       cell array with the struct of READ_PROFILE for each slice
%          u_intpol, u_method  1: interpolation between slices, 2: approximation
%          s_feat     nslc x nfeat array of positions of features along the slices [mm], negative where absent
%          slc_ib     numbers of the first and the last feature of each slice; slc_file, and s or th, are Fname and u
%                     under the names of other scripts
%          kink, accel   numbers of parts with kinks and accelerations to the next part
%          xsurf, ysurf, zsurf   points of the surface, one row for each slice, see RESAMPLE_SLICES
%
% Names inside the file are relative to its own folder.
%
% See also: read_profile, resample_slices, plot3d.

   if (nargin>=4 && isnumeric(scale_yz) && ~isempty(scale_yz) && scale_yz<=0)
      % no scale: the arguments of READ_PROFILE, with is_wheel first
      mirror_y = mirror_z;
      mirror_z = scale_yz;
      scale_yz = [];
      if (nargin>=5)
         scale_yz = idebug;
      end
   end
   is_wheel = ~isempty(regexp(lower(fname), '\.slcw', 'once'));
   if (nargin<2)
      mirror_y = [];
   end
   if (nargin<3)
      mirror_z = [];
   end
   if (nargin<4)
      scale_yz = [];
   end

   lines = read_lines(fname, 'read_slices');
   lines = strtrim(regexprep(lines, '%.*', ''));
   lines = lines(~cellfun('isempty', lines));
   if (numel(lines)<5)
      error('read_slices: "%s" ends before the list of slices.', fname);
   end

   v = first_numbers(lines{1}, 2, fname);
   u_offset = v(1);
   u_scale  = v(2);
   nslc     = first_numbers(lines{2}, 1, fname);
   v        = sscanf(lines{3}, '%d');
   v        = [v(:)', 0, 0];
   nfeat    = v(1);
   nkink    = v(2) * (nfeat>1);
   naccel   = v(3) * (nfeat>1);
   u_intpol = first_numbers(lines{4}, 1, fname);
   if (~any(u_intpol==[1 2]))
      error('read_slices: "%s" has interpolation method %d; it must be 1 or 2.', fname, u_intpol);
   end
   if (numel(lines) < 4+nslc)
      error('read_slices: "%s" ends before slice %d.', fname, nslc);
   end

   slcs = struct('Fname',fname, 'is_wheel',is_wheel, 'nslc',nslc, 'u_intpol',u_intpol, 'u_method',u_intpol, 'nfeat',nfeat);
   slcs.u = zeros(nslc, 1);
   slcs.prof = cell(nslc, 1);
   folder = fileparts(fname);
   for i = 1 : nslc
      name = regexp(lines{4+i}, '''([^'']*)''', 'tokens', 'once');
      if (isempty(name))
         error('read_slices: "%s", slice %d: the name of the profile in quotes is missing.', fname, i);
      end
      slcs.u(i) = first_numbers(lines{4+i}, 1, fname);
      file = fullfile(folder, strrep(name{1}, '\', '/'));
      slcs.prof{i} = read_profile(file, is_wheel, mirror_y, mirror_z, scale_yz);
   end
   next = 5 + nslc;
   slcs.kink  = [];
   slcs.accel = [];
   if (nkink>0)
      slcs.kink = first_numbers(lines{next}, nkink, fname);
      next = next + 1;
   end
   if (naccel>0)
      slcs.accel = first_numbers(lines{next}, naccel, fname);
      next = next + 1;
   end
   if (nfeat<=1)
      slcs.s_feat = repmat([0 1e6], nslc, 1);
   else
      slcs.s_feat = read_features(lines, next, slcs.u, nfeat, u_scale, fname);
   end
   slcs.u = u_scale * (u_offset + slcs.u);
   % names of other scripts
   slcs.slc_file = fname;
   if (is_wheel)
      slcs.th = slcs.u;
   else
      slcs.s = slcs.u;
   end
   slcs.slc_ib = zeros(nslc, 2);
   for i = 1 : nslc
      there = find(slcs.s_feat(i,:)>=0);
      if (~isempty(there))
         slcs.slc_ib(i,:) = there([1 end]);
      end
   end
   if (any(diff(slcs.u)<=1e-3))
      error('read_slices: positions of slices in "%s" must increase by more than 0.001 mm or rad.', fname);
   end
   slcs = resample_slices(slcs);

end % function read_slices

%------------------------------------------------------------------------------------------------------

function [ v ] = first_numbers( line, n, fname )

   v = sscanf(line, '%f', n)';
   if (numel(v)<n)
      error('read_slices: "%s": the line "%s" needs %d numbers.', fname, line, n);
   end

end % function first_numbers

%------------------------------------------------------------------------------------------------------

function [ s_feat ] = read_features( lines, next, u, nfeat, u_scale, fname )
% Positions of features; each line repeats the position of its slice

   nslc = numel(u);
   if (numel(lines) < next+nslc-1)
      error('read_slices: "%s" ends before the features of slice %d.', fname, nslc);
   end
   s_feat = zeros(nslc, nfeat);
   for i = 1 : nslc
      v = first_numbers(lines{next+i-1}, nfeat+1, fname);
      if (abs(u_scale*(v(1)-u(i)))>1e-3)
         error('read_slices: "%s": features of slice %d have position %g instead of %g.', fname, i, v(1), u(i));
      end
      s_feat(i,:) = v(2:end);
   end

end % function read_features
