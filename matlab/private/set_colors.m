function set_colors( name )
% SET_COLORS  Select a colormap of the current figure by its name, 'default' too, or as an n x 3 array.
%
% If 'parula' does not exist (Octave), the similar viridis is used.

   if (~ischar(name) || strcmp(name, 'default'))
      colormap(name);
   elseif (exist(name)>0)
      colormap(feval(name, 64));
   elseif (strcmp(name, 'parula'))
      colormap(viridis(64));
   else
      error('set_colors: there is no colormap "%s".', name);
   end

end % function set_colors
