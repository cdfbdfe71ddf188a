function write_simpack( p, fname, comment, z )
% WRITE_SIMPACK  Write a profile to a Simpack file (.prr for rails, .prw for wheels).
%
%   write_simpack( p, fname, comment )
%   write_simpack( fname, comment, y, z )     argument order of other scripts
%
%   p         struct of READ_PROFILE, or an n x 2 array of y and z [mm]
%   fname     name of the file; .prw makes it a wheel profile, .prr a rail profile
%   comment   text for the file (default: none)
%
% See also: read_simpack, write_miniprof.

   if (nargin<3)
      comment = '';
   end
   if (ischar(p) && nargin==4)
      name    = p;
      p       = [comment(:), z(:)];
      comment = fname;
      fname   = name;
   end
   [~, ~, ext] = fileparts(fname);
   type = find(strcmpi(ext, {'.prr','.prw'})) - 1;
   if (isempty(type))
      error('write_simpack: the extension of "%s" must be .prr for rails or .prw for wheels.', fname);
   end
   yz = profile_points(p, 'write_simpack');
   if (isstruct(p) && isfield(p,'is_wheel') && (p.is_wheel~=0)~=type)
      error('write_simpack: the extension of "%s" does not fit this profile.', fname);
   end

   f = open_for_writing(fname, 'write_simpack');
   fprintf(f, 'header.begin\n  version = 1\n  type    = %d\nheader.end\n', type);
   fprintf(f, 'spline.begin\n  comment     = ''%s''\n', strrep(comment, '''', ' '));
   fprintf(f, '  units.len.f = 1000.\n  point.begin\n');
   fprintf(f, '    %18.10f %18.10f\n', yz');
   fprintf(f, '  point.end\nspline.end\n');
   fclose(f);

end % function write_simpack
