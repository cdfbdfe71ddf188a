function [ opt ] = plot3d( sol, opt, prr, prw, subs )
% PLOT3D  Plot one quantity for the whole contact area, flat, on the rail or wheel surface, or in rear or side view.
%
%   opt = plot3d              the options with their default values; opt = plot3d( [], opt ): completed
%   plot3d( sol )             plot with the default options
%   plot3d( sol, opt )
%   plot3d( sol, opt, prr, prw, subs )
%
%   sol        struct of LOADCASE or cntc_getcpresults; an array of them if several patches are shown together
%   opt        struct of options, below
%   prr, prw   rail and wheel profile: struct of READ_PROFILE or a file name; needed for rw_surf other
%              than 'none' unless sol has them
%   subs       stresses below the surface: a block of LOADSTRS for each patch in sol, drawn in rear and side view: contours of
%              the largest von Mises stress along the line of sight
%
% What is shown:
%
%   field      'eldiv', 'eldiv_spy', 'eldiv_contour'  element division as colours, symbols, outlines
%              'h'                      undeformed distance [mm]
%              'mu', 'taucrt'           coefficient of friction [-], yield limit of a plastic layer [N/mm2]
%              'pn', 'px', 'py'         tractions on body 1 [N/mm2], in module 1 the rail
%              'ptabs', 'ptarg'         magnitude [N/mm2] and direction [deg] of the tangential tractions
%              'ptvec', 'ptabs+vec'     arrows of the tangential tractions, and with their magnitude in colours
%              'un', 'ux', 'uy', 'utabs+vec'   displacement differences [mm]
%              'uplsx', 'uplsy', 'upls+vec'    plastic displacements [mm] (M=4)
%              'sx', 'sy'               slip distances [mm] in shifts, relative slip velocities [-] in rolling
%              'shft', 'shft+vec'       magnitude of the slip distance [mm]
%              'srel', 'srel+vec', 'sabs', 'sabs+vec'  relative [-] and absolute [mm/s] slip velocity (rolling)
%              'fricdens'               frictional power density [W/mm2], in shifts work [J/mm2]
%              'temp1', 'temp2'         surface temperatures [degC] (H>=1)
%              'default'                'ptabs+vec', without friction 'pn'
%   exterval   value at elements out of contact; NaN (default): not drawn; []: as stored in sol
%              or the name of any other array of the struct
%   rw_surf    'none' (default): flat; 'prr': on the rail surface; 'prw': on the wheel surface; 'both': on the rail with the
%              wheel added, in rail coordinates
%   rw_surfc   the same under the name that other scripts use; 'both' in rear and side view then uses track coordinates. A
%              missing profile is omitted, with a warning
%   typplot    'surf' (default), 'contourf', or with profiles 'rw_rear', 'rw_side': rear and side view; the
%              largest value of each row or column is then drawn as a bar along the surface normal
%
% How it is shown:
%
%   view       'default', [azimuth elevation] in degrees, [0 90] for a picture from above, or 'rail': from
%              above with x pointing up and y to the right; 'rdyn': from below, x pointing left
%   xrange     range of x [mm] of the surfaces and of the side view (default: the contact and its surroundings)
%   xysteps    distance of thin lines on surfaces [mm], dxy or [dx dy] (default: from their size)
%   zrange     range of the values for heights and colours
%   ixrange, iyrange   numbers of the first and last element to be shown; 'auto' (default) or 'tight': the
%              contact area and one more element; 'all': the whole grid
%   numvecx, numvecy   largest number of arrows in x- and y-direction (default 15)
%   xstretch   factor of lengths in x-direction against those in y-direction; 1 (default): to scale. A single row or
%              column of elements fills the figure
%   vecscale   length of arrows and bars in mm for a value of 1 (default: from the values)
%   veccolor   their colour (default 'b' for 'ptvec' and bars, else 'k'), vecwidth their line width
%   addeldiv   1, 'y': lines around the contact area and the areas of slip and plasticity; 0, 'n': none; [] (default):
%              with arrows on colours only. In pictures from above
%   eldivcol   colours of these lines, 3 x 3 array or 3 letters; eldivwid their line width
%   colormap   name or array; 'none' or 'black': black lines on white
%   addplot    1: do not clear the figure, draw into the current axes; -1, 2: clear these axes only; 0 (default)
%
% See also: loadcase, plot2d, read_profile.

   defaults = struct('field','default', 'rw_surf','none', 'exterval',NaN, 'typplot','surf', 'view','default', ...
                     'xrange',[], 'xysteps',[], 'zrange',[], 'ixrange','auto', 'iyrange','auto', 'numvecx',15, ...
                     'numvecy',15, 'xstretch',1, 'vecscale',[], 'veccolor',[], 'vecwidth',[], 'addeldiv',[], ...
                     'eldivcol',[0 0 0.56; 0.5 0 0; 0.75 0 0.75], 'eldivwid',[], 'colormap','parula', 'addplot',0);
   if (nargin<1)
      opt = defaults;
      return
   end
   if (nargin<2)
      opt = [];
   end
   if (nargin<3)
      prr = [];
   end
   if (nargin<4)
      prw = [];
   end
   if (nargin<5)
      subs = [];
   end
   other_script = (isstruct(opt) && isfield(opt, 'rw_surfc'));
   if (other_script)
      opt.rw_surf = opt.rw_surfc;
      opt = rmfield(opt, 'rw_surfc');
   end
   opt = with_defaults(opt, defaults, 'plot3d');
   if (isnumeric(sol) && isempty(sol) && nargout>0)
      % nothing to plot: return the completed options without unknown ones
      opt = rmfield(opt, setdiff(fieldnames(opt), fieldnames(defaults)));
      return
   end
   one_of(opt.rw_surf, {'none','prr','prw','both'}, 'rw_surf');
   one_of(opt.typplot, {'surf','contourf','rw_rear','rw_side'}, 'typplot');
   if (isempty(sol))
      warning('plot3d: there is no contact patch to plot.');
      return
   end
   sol = completed(sol);
   opt.field = strrep(opt.field, '_vec', '+vec');
   if (isempty(opt.view))
      opt.view = 'default';
   end
   if (isempty(opt.colormap))
      opt.colormap = 'default';
   end
   if (ischar(opt.addeldiv))
      opt.addeldiv = (lower(opt.addeldiv(1))=='y');
   end
   if (other_script)
      opt.rw_surf = surface_at_hand(sol, opt.rw_surf, prr, prw);
   end
   opt.in_track = (other_script && strcmp(opt.rw_surf, 'both'));

   with_profiles = ~strcmp(opt.rw_surf, 'none');
   if (any(strcmp(opt.typplot, {'rw_rear','rw_side'})) && ~with_profiles)
      error('plot3d: %s needs rw_surf = ''prr'', ''prw'' or ''both'', and the profiles.', opt.typplot);
   end
   check_blocks(subs, sol, opt);
   if (with_profiles)
      [prr, prw] = get_profiles(sol, opt, prr, prw);
      sol = from_reference(sol);
   end

   if (~opt.addplot)
      clf
   elseif (any(opt.addplot==[-1 2]))
      cla
   end
   hold on
   switch (opt.typplot)
      case 'rw_rear'
         draw_section(sol, opt, prr, prw, 'rear', subs);
      case 'rw_side'
         draw_section(sol, opt, prr, prw, 'side', subs);
      otherwise
         if (with_profiles)
            draw_on_surface(sol, opt, prr, prw);
         else
            for i = 1 : numel(sol)
               draw_flat(sol(i), opt);
            end
         end
   end
   if (nargout<1)
      clear opt
   else
      opt = rmfield(opt, 'in_track');
   end

end % function plot3d

%------------------------------------------------------------------------------------------------------

function [ sol ] = completed( sol )
% Add fields that may be missing in a struct made by hand from results of the library

   if (~isfield(sol,'x_offset'))
      [sol.x_offset] = deal([]);
   end
   if (~isfield(sol,'y_offset'))
      [sol.y_offset] = deal([]);
   end
   if (~isfield(sol,'x') || ~isfield(sol,'y'))
      for i = 1 : numel(sol)
         sol(i).x = sol(i).xl + ((1:sol(i).mx) - 0.5) * sol(i).dx;
         sol(i).y = sol(i).yl + ((1:sol(i).my) - 0.5) * sol(i).dy;
      end
   end
   if (~isfield(sol,'kincns'))
      [sol.kincns] = deal(struct('t_digit',3));
   end

end % function completed

%------------------------------------------------------------------------------------------------------

function [ sol ] = from_reference( sol )
% Positions of the elements relative to the contact reference, as the surfaces have them; in steps (T = 1, 2) of wheel and rail
% elements have another origin

   for i = 1 : numel(sol)
      if (isfield(sol(i).meta,'spinxo'))
         sol(i).x = sol(i).x - sol(i).meta.spinxo;
         sol(i).y = sol(i).y - sol(i).meta.spinyo;
      end
   end

end % function from_reference

%------------------------------------------------------------------------------------------------------

function [ surface ] = surface_at_hand( sol, surface, prr, prw )
% The surface requested by the option of other scripts, without missing profiles

   bodies = {'prr','prw'};
   there  = [~isempty(prr) || isfield(sol,'prr'), ~isempty(prw) || isfield(sol,'prw')];
   asked  = strcmp(surface, 'both') | strcmp(surface, bodies);
   if (any(asked & ~there))
      warning('plot3d: rw_surfc = ''%s'' without the profile, which is left out.', surface);
      left = [bodies(asked & there), {'none'}];
      surface = left{1};
   end

end % function surface_at_hand

%------------------------------------------------------------------------------------------------------

function check_blocks( subs, sol, opt )
% Blocks of stresses below the surface: one for each patch, in the views that show them

   if (isempty(subs))
      return
   end
   if (numel(subs)~=numel(sol))
      error('plot3d: %d blocks of stresses are given for %d patches.', numel(subs), numel(sol));
   elseif (~any(strcmp(opt.typplot, {'rw_rear','rw_side'})))
      warning('plot3d: stresses below the surface are drawn in rear and side view only; see also plotstrs.');
   end

end % function check_blocks

%------------------------------------------------------------------------------------------------------

function one_of( value, allowed, name )

   if (~any(strcmp(value, allowed)))
      error('plot3d: unknown %s ''%s''; accepted: %s.', name, value, ...
            ['''', strjoin(allowed, ''', '''), '''']);
   end

end % function one_of

%------------------------------------------------------------------------------------------------------

function [ prr, prw ] = get_profiles( sol, opt, prr, prw )
% Profiles as structs in the coordinates of the case: from the arguments, from files, or from the solution

   if (isempty(prr) && isfield(sol,'prr'))
      prr = sol(1).prr;
   end
   if (isempty(prw) && isfield(sol,'prw'))
      prw = sol(1).prw;
   end
   if (ischar(prr))
      prr = read_profile(prr, 0);
   end
   if (ischar(prw))
      prw = read_profile(prw, 1);
   end
   if (isempty(prr) && ~strcmp(opt.rw_surf,'prw'))
      error('plot3d: rw_surf = ''%s'' needs the rail profile.', opt.rw_surf);
   end
   if (isempty(prw) && ~strcmp(opt.rw_surf,'prr'))
      error('plot3d: rw_surf = ''%s'' needs the wheel profile.', opt.rw_surf);
   end
   prr = in_case_coordinates(prr, sol(1));
   prw = in_case_coordinates(prw, sol(1));

end % function get_profiles

%------------------------------------------------------------------------------------------------------

function [ p ] = in_case_coordinates( p, sol )
% Profiles are those of the right-hand side: y changes its sign for left wheels. Slices get corresponding points

   if (isempty(p))
      return
   end
   side = 1;
   if (sol.config==0 || sol.config==4)
      side = -1;
   end
   if (isfield(p, 'prof'))
      p = resample_slices(p);
      p.vy = side * p.vy;
   else
      p.ProfileY = side * p.ProfileY;
   end

end % function in_case_coordinates
