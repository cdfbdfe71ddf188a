function draw_figures( program, target, names )
% DRAW_FIGURES  Run the examples and draw the figures of this folder to PNG files.
%
%   draw_figures( program, target, names )
%
%   program   the program, e.g. '../../build/release/bin/contact'
%   target    folder for the pictures; must exist
%   names     figures to be drawn, e.g. {'cattaneo'}; default: all
%
% Inputs are copied to a temporary folder, which is removed at the end.

   % figure, example that it needs (more than one in braces), width and height of the picture in pixels
   figures = {'cattaneo', {'cattaneo'}, [560 420]; 'carter2d', {'carter2d'}, [560 420]; ...
              'bentall', {'bentall'}, [900 400]; 'visc_rollers', {'visc_rollers'}, [560 420]; ...
              'catt_to_cart', {'catt_to_cart'}, [900 400]; 'axis_stresses', {'subsurface'}, [560 420]; ...
              'subsurface', {'subsurface'}, [900 420]; 'contact_positions', {'wheel_on_rail'}, [560 420]; ...
              'wheel_on_rail', {'wheel_on_rail'}, [900 450]; 'rear_view', {'wheel_on_rail'}, [640 420]; ...
              'traction_curve', {'falling_friction','layer_traction'}, [560 420]; ...
              'temperatures', {'sliding_temperature'}, [900 400]; 'layer', {'layer_element'}, [560 420]; ...
              'simplified', {'simplified'}, [800 640]; 'groove', {'groove'}, [900 400]; ...
              'conformal_wheel', {'conformal_wheel'}, [800 640]; 'wheel_flat', {'wheel_flat'}, [1000 560]; ...
              'manchester', {'manchester'}, [900 450]};
   if (nargin<3)
      names = figures(:,1)';
   end
   here    = fileparts(mfilename('fullpath'));
   program = absolute(program);
   target  = absolute(target);
   work    = tempname();
   mkdir(work);
   copyfile(fullfile(here,'..','profiles'), fullfile(work,'profiles'));
   back    = cd(work);
   leave   = onCleanup(@() clean_up(back, work));
   addpath(here, fullfile(here,'..','..','matlab'));
   done    = {};

   for i = 1 : numel(names)
      k = find(strcmp(figures(:,1), names{i}));
      if (isempty(k))
         error('draw_figures: there is no figure "%s".', names{i});
      end
      for j = 1 : numel(figures{k,2})
         example = figures{k,2}{j};
         if (~any(strcmp(done, example)))
            run_program(program, here, example);
            done{end+1} = example;
         end
      end
      pixels = figures{k,3};
      f = figure('visible','off', 'position',[50 50 pixels]);
      draw(['fig_' figures{k,1}]);
      set(f, 'paperunits','inches', 'paperposition',[0 0 pixels/100]);
      print(f, fullfile(target, [figures{k,1} '.png']), '-dpng', '-r80');
      close(f);
   end

end % function draw_figures

%------------------------------------------------------------------------------------------------------

function draw( script )
% In a workspace of its own

   eval(script);

end % function draw

%------------------------------------------------------------------------------------------------------

function run_program( program, here, example )

   copyfile(fullfile(here, '..', [example '.inp']), [example '.inp']);
   [status, output] = system(sprintf('"%s" --quiet 2 %s 2>&1', program, example));
   if (status~=0)
      error('draw_figures: the program could not run %s: %s', example, output);
   end

end % function run_program

%------------------------------------------------------------------------------------------------------

function [ name ] = absolute( name )

   if (name(1)~='/')
      name = fullfile(pwd, name);
   end

end % function absolute

%------------------------------------------------------------------------------------------------------

function clean_up( back, work )

   cd(back);
   if (exist('confirm_recursive_rmdir'))
      confirm_recursive_rmdir(false, 'local');
   end
   rmdir(work, 's');

end % function clean_up
