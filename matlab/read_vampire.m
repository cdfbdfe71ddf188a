function [ p ] = read_vampire( fname, right_side, idebug, make_plot )
% READ_VAMPIRE  Read a profile from a Vampire file (.rai for rails, .whe for wheels).
%
%   p = read_vampire( fname, right_side )
%
%   fname       file: WHEELPROFILE or RAILPROFILE, a title, TREADDATUM or GAUGEPOINT, FLANGEBACK or GAUGE, and rows of y and z
%               of the left and of the right profile
%   right_side  1 (default): the right profile; 0: the left one, mirrored to the right side
%   idebug, make_plot  accepted for compatibility and ignored; use READ_PROFILE to plot
%
%   p   struct with columns ProfileY, ProfileZ [mm], z positive down; Title, is_wheel; ProfileData: the rows of the file;
%       wheels:  TreadDatum, FlangeBackDist, FlangeBackPos [mm]: FBDIST and FBPOS of CONTACT; y = 0 at the tread datum
%       rails:   GaugePoint, GaugeHeight, GaugeWidth [mm], rail_y0, rail_z0: the gauge point in the file, which becomes
%                y = 0, and the top of the rail, which becomes z = 0
%
% Datums: EUROPEAN (70 mm), US1 (2 27/32 in), US2 (3 1/16 in) and CUSTOM with a number; gauge points: EUROPEAN (14 mm), US (5/8
% in) and CUSTOM with a number. READ_PROFILE mirrors and orders.
%
% See also: read_profile, read_simpack, read_miniprof.

   if (nargin<2 || isempty(right_side))
      right_side = 1;
   end
   inch  = 25.4;
   lines = read_lines(fname, 'read_vampire');
   lines = strtrim(lines);
   if (numel(lines)<5 || ~any(strcmpi(lines{1}, {'WHEELPROFILE','RAILPROFILE'})))
      error('read_vampire: "%s" does not begin with WHEELPROFILE or RAILPROFILE.', fname);
   end
   p = struct('Fname',fname, 'is_wheel',strcmpi(lines{1},'WHEELPROFILE'), 'Title',lines{2});
   if (p.is_wheel)
      p.TreadDatum     = behind(lines{3}, 'TREADDATUM', fname);
      p.FlangeBackPos  = -datum(p.TreadDatum, {'EUROPEAN','US1','US2'}, [70, (2+27/32)*inch, (3+1/16)*inch], fname);
      p.FlangeBackDist = number(behind(lines{4}, 'FLANGEBACK', fname), fname);
   else
      p.GaugePoint  = behind(lines{3}, 'GAUGEPOINT', fname);
      p.GaugeHeight = datum(p.GaugePoint, {'EUROPEAN','US'}, [14, 5/8*inch], fname);
      p.GaugeWidth  = number(behind(lines{4}, 'GAUGE', fname), fname);
   end
   rows = regexprep(lines(5:end), '["!%].*', '');
   rows = strtrim(strrep(rows, ',', ' '));
   rows = rows(~cellfun('isempty', rows));
   table = zeros(numel(rows), 4);
   for i = 1 : numel(rows)
      v = sscanf(rows{i}, '%f')';
      if (numel(v)<4 || any(~isfinite(v(1:4))))
         error('read_vampire: "%s": the row "%s" needs four numbers, y and z of both profiles.', fname, rows{i});
      end
      table(i,:) = v(1:4);
   end
   if (size(table,1)<2)
      error('read_vampire: "%s" has fewer than two points.', fname);
   end
   p.ProfileData = table;
   y = table(:,3);
   z = table(:,4);
   if (~right_side)
      y = -table(:,1);
      z = table(:,2);
   end
   if (p.is_wheel)
      y = y - p.FlangeBackDist/2 + p.FlangeBackPos;
   else
      % z of rails points upwards in the file
      z = -z;
      if (y(end)<y(1))
         y = flipud(y);
         z = flipud(z);
      end
      p.rail_z0 = min(z);
      z = z - p.rail_z0;
      % first crossing of the gauge height, from the track centre
      k = find(z<p.GaugeHeight, 1);
      p.rail_y0 = y(1);
      if (k>1)
         p.rail_y0 = y(k-1) + (y(k)-y(k-1)) * (p.GaugeHeight-z(k-1))/(z(k)-z(k-1));
      end
      y = y - p.rail_y0;
   end
   p.ProfileY = y;
   p.ProfileZ = z;

end % function read_vampire

%------------------------------------------------------------------------------------------------------

function [ text ] = behind( line, word, fname )
% The text after a word at the beginning of a line

   if (~strncmpi(line, word, numel(word)))
      error('read_vampire: "%s": the line "%s" should begin with %s.', fname, line, word);
   end
   text = strtrim(line(numel(word)+1:end));

end % function behind

%------------------------------------------------------------------------------------------------------

function [ v ] = number( text, fname )

   v = sscanf(text, '%f', 1);
   if (isempty(v))
      error('read_vampire: "%s": a number is expected instead of "%s".', fname, text);
   end

end % function number

%------------------------------------------------------------------------------------------------------

function [ v ] = datum( text, words, values, fname )
% The value of a datum, which is a name or CUSTOM with a number

   k = find(strcmpi(text, words), 1);
   if (~isempty(k))
      v = values(k);
   elseif (strncmpi(text, 'CUSTOM', 6))
      v = number(text(7:end), fname);
   else
      error('read_vampire: "%s": unknown word "%s"; accepted: %s, CUSTOM.', fname, text, strjoin(words, ', '));
   end

end % function datum
