function [ p ] = read_simpack( fname, idebug, make_plot )
% READ_SIMPACK  Read a profile from a Simpack file (.prr for rails, .prw for wheels).
%
%   p = read_simpack( fname )
%
%   p   struct with columns ProfileY, ProfileZ [mm], Fname, and from the file: type (0 rail, 1 wheel), mirror_y,
%       mirror_z (0, 1), inversion (0, 1, or [] if not given), comment. Points that are too
%       close are dropped, shifts and bounds are applied; READ_PROFILE mirrors and orders.
%   idebug, make_plot  accepted for compatibility and ignored; use READ_PROFILE to plot
%
% See also: read_profile, write_simpack.

   lines = read_lines(fname, 'read_simpack');
   key   = struct('type',NaN, 'point_dist_min',1e-4, 'shift_y',0, 'shift_z',0, 'rotate',0, 'bound_y_min',0, ...
                  'bound_y_max',0, 'bound_z_min',0, 'bound_z_max',0, 'mirror_y',0, 'mirror_z',0, 'inversion',[], ...
                  'units_len_f',1, 'units_ang_f',1);
   section = '';
   comment = '';
   ended   = false;
   lines   = strip_comments(lines);
   filled  = find(~cellfun('isempty', lines));
   % the list of points is read at once: all lines up to the next keyword
   begins  = find(strcmp(lines, 'point.begin'), 1);
   ends    = find(strcmp(lines, 'point.end'), 1);
   points  = zeros(0, 2);
   if (~isempty(begins) && ~isempty(ends))
      inside  = filled(filled>begins & filled<ends);
      words   = ~cellfun('isempty', regexp(lines(inside), '^[a-z]', 'once'));
      [points, skipped] = number_rows(lines(inside(~words)), 2, 3);
      if (skipped>0)
         warning('read_simpack: "%s": %d lines do not have two or three numbers and are skipped.', fname, skipped);
      end
      filled = filled(~(filled>begins & filled<ends));
   end
   npoint  = size(points, 1);

   for i = filled
      line = lines{i};
      equals = find(line=='=', 1);
      if (~isempty(equals) && line(1)~='''')
         name  = strtrim(line(1:equals-1));
         value = strtrim(line(equals+1:end));
         field = strrep(name, '.', '_');
         if (strcmp(section,'header') && strcmp(name,'type'))
            key.type = one_number(value, fname, i);
         elseif (strcmp(section,'spline') && strcmp(name,'comment'))
            comment = strrep(value, '''', '');
         elseif (strcmp(section,'spline') && isfield(key,field) && ~strcmp(name,'type'))
            key.(field) = one_number(value, fname, i);
         end
      elseif (~isempty(regexp(line, '^[a-z]', 'once')))
         [section, ended] = next_section(section, line, fname, i);
         if (ended)
            break
         end
      else
         error('read_simpack: "%s", line %d is outside the list of points.', fname, i);
      end
   end
   if (~ended)
      error('read_simpack: "%s" has no spline.end.', fname);
   elseif (npoint<2)
      error('read_simpack: "%s" has %d points; at least two are required.', fname, npoint);
   elseif (~any(key.type==[0 1]))
      error('read_simpack: "%s" needs type = 0 (rail) or 1 (wheel) in its header.', fname);
   end

   p = apply_keys(points, key, fname);
   p.Fname     = fname;
   p.type      = key.type;
   p.mirror_y  = key.mirror_y;
   p.mirror_z  = key.mirror_z;
   p.inversion = key.inversion;
   p.comment   = comment;

end % function read_simpack

%------------------------------------------------------------------------------------------------------

function [ lines ] = strip_comments( lines )
% Remove comments, which begin with ! or % outside of quotes

   for i = find(~cellfun('isempty', strfind(lines, '''')))
      quoted = mod(cumsum(lines{i}==''''), 2)==1;
      k = find((lines{i}=='!' | lines{i}=='%') & ~quoted, 1);
      if (~isempty(k))
         lines{i} = lines{i}(1:k-1);
      end
   end
   plain = cellfun('isempty', strfind(lines, ''''));
   lines(plain) = regexprep(lines(plain), '[!%].*', '');
   lines = strtrim(lines);

end % function strip_comments

%------------------------------------------------------------------------------------------------------

function [ value ] = one_number( text, fname, i )

   value = sscanf(text, '%f');
   if (numel(value)~=1)
      error('read_simpack: "%s", line %d needs one number after the equals sign.', fname, i);
   end

end % function one_number

%------------------------------------------------------------------------------------------------------

function [ section, ended ] = next_section( section, word, fname, i )
% Follow the sections header.begin ... spline.end

   steps = {'','header.begin','header'; 'header','header.end',''; '','spline.begin','spline'; ...
            'spline','point.begin','point'; 'point','point.end','spline'; 'spline','spline.end',''};
   ended = strcmp(word, 'spline.end');
   k = find(strcmp(section,steps(:,1)) & strcmp(word,steps(:,2)));
   if (isempty(k))
      error('read_simpack: "%s", line %d: "%s" is not expected here.', fname, i, word);
   end
   section = steps{k,3};

end % function next_section

%------------------------------------------------------------------------------------------------------

function [ p ] = apply_keys( points, key, fname )
% Close points, shift, rotation, bounds and unit, in this order

   keep = drop_close_points(points(:,1), points(:,2), max(1e-6, key.point_dist_min));
   y = points(keep,1) + key.shift_y;
   z = points(keep,2) + key.shift_z;
   angle = key.rotate / key.units_ang_f;
   if (abs(angle)>pi)
      error('read_simpack: rotate = %g in "%s" is an angle of %g rad; expected at most pi.', key.rotate, fname, angle);
   end
   [y, z] = deal(cos(angle)*y - sin(angle)*z, sin(angle)*y + cos(angle)*z);
   if (key.bound_y_min<key.bound_y_max)
      inside = (y>=key.bound_y_min & y<=key.bound_y_max);
      y = y(inside);
      z = z(inside);
   end
   if (key.bound_z_min<key.bound_z_max)
      z = min(key.bound_z_max, max(key.bound_z_min, z));
      keep = drop_close_points(y, z, max(1e-6, key.point_dist_min));
      y = y(keep);
      z = z(keep);
   end
   p.ProfileY = y * 1000/key.units_len_f;
   p.ProfileZ = z * 1000/key.units_len_f;

end % function apply_keys
