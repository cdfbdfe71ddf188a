function write_miniprof( p, fname, comment )
% WRITE_MINIPROF  Write a profile to a Miniprof file (.ban for rails, .whl for wheels).
%
%   write_miniprof( p, fname, comment )
%
%   p         struct of READ_PROFILE, or an n x 2 array of y and z [mm]
%   fname     name of the file
%   comment   text for the header (default: none)
%
% See also: read_miniprof, write_simpack.

   if (nargin<3)
      comment = '';
   end
   [~, ~, ext] = fileparts(fname);
   if (~any(strcmpi(ext, {'.ban','.whl'})))
      error('write_miniprof: the extension of "%s" must be .ban for rails or .whl for wheels.', fname);
   end
   yz = profile_points(p, 'write_miniprof');
   if (isstruct(p) && isfield(p,'is_wheel') && (p.is_wheel~=0)~=strcmpi(ext,'.whl'))
      error('write_miniprof: the extension of "%s" does not fit this profile.', fname);
   end

   f = open_for_writing(fname, 'write_miniprof');
   fprintf(f, 'Filename=%s\nComment=%s\nXYPoints=%d\nXOffset=0.0000\nYOffset=0.0000\nColumnDef=X,Y\n\n', ...
           fname, comment, size(yz,1));
   fprintf(f, '%18.10f %18.10f\n', yz');
   fclose(f);

end % function write_miniprof
