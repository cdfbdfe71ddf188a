function [ p ] = read_miniprof( fname, idebug, make_plot )
% READ_MINIPROF  Read a profile from a Miniprof file (.ban, .whl) or from a table of two columns.
%
%   p = read_miniprof( fname )
%
%   p   struct with columns ProfileY, ProfileZ [mm] after the offsets of the header, Fname, ColumnDef, and
%       ProfileData with all columns. READ_PROFILE mirrors and orders.
%   idebug, make_plot  accepted for compatibility and ignored; use READ_PROFILE to plot
%
% See also: read_profile, write_miniprof.

   lines   = read_lines(fname, 'read_miniprof');
   lines   = strtrim(regexprep(lines, '[!"%#].*', ''));
   filled  = ~cellfun('isempty', lines);
   numeric = filled & ~cellfun('isempty', regexp(lines, '^[-+0-9.,eEdD\s]*$', 'once'));
   first   = find(numeric, 1);
   if (isempty(first))
      error('read_miniprof: "%s" has no points.', fname);
   end
   keys    = find(filled & ~numeric & ~cellfun('isempty', strfind(lines, '=')));
   if (any(keys>first))
      error('read_miniprof: "%s", line %d: a keyword among the numbers.', fname, keys(end));
   end
   [p, offset] = read_header(lines(keys), fname);

   columns = 'XY';
   allowed = Inf;
   if (~isempty(p.ColumnDef))
      columns = regexprep(p.ColumnDef, '[ ,]', '');       % * is a column without meaning
      allowed = numel(columns);
   end
   ncol = numel(columns);
   [data, skipped] = number_rows(strrep(lines(numeric), ',', ' '), ncol, allowed);
   if (skipped>0)
      warning('read_miniprof: "%s": %d lines do not have %d numbers and are skipped.', fname, skipped, ncol);
   end
   if (size(data,1)<2)
      error('read_miniprof: "%s" has %d points; at least two are required.', fname, size(data,1));
   end

   iy = find(columns=='X', 1);
   iz = find(columns=='Y', 1);
   if (isempty(iy) || isempty(iz))
      error('read_miniprof: ColumnDef=%s of "%s" has no X or no Y.', p.ColumnDef, fname);
   end
   data = data(drop_close_points(data(:,iy), data(:,iz), 1e-4),:);
   p.ProfileData = data;
   p.ProfileY = data(:,iy) + offset(1);
   p.ProfileZ = data(:,iz) + offset(2);

end % function read_miniprof

%------------------------------------------------------------------------------------------------------

function [ p, offset ] = read_header( lines, fname )
% Keywords that matter: offsets in y and z [mm], meaning of the columns

   p = struct('Fname',fname, 'ColumnDef','');
   offset = [0 0];
   for i = 1 : numel(lines)
      equals = find(lines{i}=='=', 1);
      value  = strtrim(lines{i}(equals+1:end));
      switch (strtrim(lines{i}(1:equals-1)))
         case 'ColumnDef'
            p.ColumnDef = value;
         case {'XOffset','Xoffset'}
            offset(1) = sscanf([value ' 0'], '%f', 1);
         case {'YOffset','Yoffset'}
            offset(2) = sscanf([value ' 0'], '%f', 1);
      end
   end

end % function read_header
