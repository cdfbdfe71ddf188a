function [ opt ] = plot_2dspline( sol, slcs, opt )
% PLOT_2DSPLINE  Draw the surface of a profile that varies along the rail or around the wheel.
%
%   opt = plot_2dspline                  the options with their default values
%   plot_2dspline( slcs, opt )
%   plot_2dspline( sol, slcs, opt )      sol: struct of LOADCASE, or []: with it, positions on rails are relative to s_ws
%
%   slcs   struct of READ_SLICES, or of READ_PROFILE for such a file
%
%   typplot    'surf' (default), 'topol': lines only, or 'refl': reflection stripes that show the smoothness
%   urange     range of positions [mm], of wheels angles [rad] (default: all)
%   vrange     range along the slices, 0 to 1 between their ends (default: all)
%   xysteps    distance of thin lines on the surface, du or [du dv] (default: 20 lines each way)
%   show_slc   numbers of slices that are highlighted; those that do not exist are omitted;  slc_color: their colours, a name or
%              numbers for MATLAB_COLOR in a column, taken in turn (default 'r')
%   show_feat  numbers of features that are highlighted;  feat_color: their colours (default 'r')
%   refl_avec  direction of the light for 'refl': [azimuth elevation] in degrees, or a vector (default [0 1 0])
%   refl_dth   angle between stripes [deg] (default 30)
%   zoom       factors of u, y and z in the picture (default [1 1 1])
%   view       [azimuth elevation] (default [110 20])
%   addplot    1: draw into the current axes; 0 (default): clear the figure
%
% Slices with corresponding points are connected as by RESAMPLE_SLICES; the spline surface of the program is smoother:
% EVAL_2DSPLINE.
%
% See also: read_slices, resample_slices, eval_2dspline, plot3d.

   defaults = struct('typplot','surf', 'urange',[], 'vrange',[], 'xysteps',[], 'show_slc',[], 'slc_color','r', 'show_feat',[], ...
                     'feat_color','r', 'refl_avec',[0 1 0], 'refl_dth',30, 'zoom',[1 1 1], 'view',[110 20], 'addplot',0);
   if (nargin<1)
      opt = defaults;
      return
   end
   if (isstruct(sol) && isfield(sol, 'nslc'))
      % without sol
      if (nargin<2)
         slcs = [];
      end
      opt  = slcs;
      slcs = sol;
      sol  = [];
   elseif (nargin<3)
      opt = [];
   end
   opt = with_defaults(opt, defaults, 'plot_2dspline');
   if (~any(strcmp(opt.typplot, {'surf','topol','refl'})))
      error('plot_2dspline: option typplot = ''%s'' must be ''surf'', ''topol'' or ''refl''.', opt.typplot);
   end
   if (~isstruct(slcs) || ~isfield(slcs, 'nslc'))
      error('plot_2dspline: a struct of read_slices is needed.');
   end

   [u, y, z, parts] = surface_points(slcs);
   rows = true(size(u));
   if (~isempty(opt.urange))
      rows = (u>=opt.urange(1) & u<=opt.urange(2));
   end
   if (sum(rows)<2)
      error('plot_2dspline: urange has fewer than two slices; the slices are at %g to %g.', u(1), u(end));
   end
   v = linspace(0, 1, size(y,2));
   columns = true(size(v));
   if (~isempty(opt.vrange))
      columns = (v>=opt.vrange(1) & v<=opt.vrange(2));
   end
   origin = 0;
   if (~isempty(sol) && isfield(sol, 'meta') && ~slcs.is_wheel)
      origin = sol(1).meta.s_ws;
   end
   x = repmat(u - origin, 1, size(y,2)) * opt.zoom(1);
   y = y * opt.zoom(2);
   z = z * opt.zoom(3);

   if (~opt.addplot)
      clf
   end
   hold on
   switch (opt.typplot)
      case 'surf'
         surf(x(rows,columns), y(rows,columns), z(rows,columns), 'edgecolor','none', 'facecolor',[0.8 0.8 0.85]);
      case 'refl'
         surf(x(rows,columns), y(rows,columns), z(rows,columns), ...
              stripes(x(rows,columns), y(rows,columns), z(rows,columns), opt), 'edgecolor','none');
         colormap(gray);
   end
   thin_lines(x(rows,columns), y(rows,columns), z(rows,columns), u(rows), opt);
   chosen = opt.show_slc(opt.show_slc>=1 & opt.show_slc<=slcs.nslc);
   for i = 1 : numel(chosen)
      k = chosen(i);
      plot3(x(k,columns), y(k,columns), z(k,columns), '-', 'color',turn_of(opt.slc_color, i), 'linewidth',1.5);
   end
   chosen = opt.show_feat(opt.show_feat>=1 & opt.show_feat<=numel(parts));
   for i = 1 : numel(chosen)
      k = parts(chosen(i));
      plot3(x(rows,k), y(rows,k), z(rows,k), '-', 'color',turn_of(opt.feat_color, i), 'linewidth',1.5);
   end
   set(gca, 'ydir','reverse', 'zdir','reverse');
   view(opt.view);
   grid on
   xlabel('u [mm]');
   if (slcs.is_wheel)
      xlabel('\theta [rad]');
   end
   ylabel('y [mm]');
   zlabel('z [mm]');
   if (nargout<1)
      clear opt
   end

end % function plot_2dspline

%------------------------------------------------------------------------------------------------------

function [ u, y, z, parts ] = surface_points( slcs )
% Points of all slices, with equal numbers between consecutive features; columns of the features

   u = slcs.u(:);
   nfeat = size(slcs.s_feat, 2);
   per_part = 1 + max(8, round(80/max(1,nfeat-1)));
   parts = 1 + (0:nfeat-1)*(per_part-1);
   y = NaN(slcs.nslc, parts(end));
   z = y;
   for i = 1 : slcs.nslc
      p = slcs.prof{i};
      s = p.ProfileS(:);
      f = min(slcs.s_feat(i,:), s(end));
      for k = 1 : nfeat-1
         % negative positions mark features that a slice does not have
         if (f(k)<0 || f(k+1)<0)
            continue
         end
         at = linspace(f(k), f(k+1), per_part);
         y(i, parts(k):parts(k+1)) = interp1(s, p.ProfileY(:), at);
         z(i, parts(k):parts(k+1)) = interp1(s, p.ProfileZ(:), at);
      end
   end

end % function surface_points

%------------------------------------------------------------------------------------------------------

function thin_lines( x, y, z, u, opt )
% Lines at equal distances

   if (isempty(opt.xysteps))
      nu = max(1, round(size(x,1)/20));
      nv = max(1, round(size(x,2)/20));
   else
      steps = [opt.xysteps(:); opt.xysteps(end)];
      nu = max(1, round(steps(1) / max(eps, mean(abs(diff(u))))));
      widths = hypot(diff(y, 1, 2), diff(z, 1, 2));
      nv = max(1, round(steps(2) / max(eps, mean(widths(~isnan(widths))))));
   end
   grey = {'-', 'color',[0.45 0.45 0.45], 'linewidth',0.5};
   i = unique([1:nu:size(x,1), size(x,1)]);
   j = unique([1:nv:size(x,2), size(x,2)]);
   plot3(x(i,:)', y(i,:)', z(i,:)', grey{:});
   plot3(x(:,j), y(:,j), z(:,j), grey{:});

end % function thin_lines

%------------------------------------------------------------------------------------------------------

function [ c ] = stripes( x, y, z, opt )
% Brightness by the angle between the normal and the direction of the light

   a = opt.refl_avec(:)';
   if (numel(a)==2)
      a = a*pi/180;
      a = [cos(a(2))*sin(a(1)), cos(a(2))*cos(a(1)), -sin(a(2))];
   end
   a = a / norm(a);
   [nx, ny, nz] = surfnorm(x, y, z);
   angle = acos(max(-1, min(1, nx*a(1) + ny*a(2) + nz*a(3)))) * 180/pi;
   c = mod(floor(angle/opt.refl_dth), 2);

end % function stripes

%------------------------------------------------------------------------------------------------------

function [ col ] = turn_of( colors, i )
% The colours, repeated cyclically

   if (ischar(colors) && size(colors,1)==1)
      col = colors;
      return
   end
   col = line_color(colors(mod(i-1, size(colors,1))+1, :));

end % function turn_of
