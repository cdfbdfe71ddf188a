function [ opt ] = plot2d( sol, opt )
% PLOT2D  Plot tangential tractions and the traction bound along rows or columns of the contact area.
%
%   opt = plot2d         the options with their default values
%   opt = plot2d( [], opt )   opt, completed by defaults
%   plot2d( sol )        plot with the default options
%   plot2d( sol, opt )
%
%   sol   struct of LOADCASE for one patch
%   opt   struct of options:
%
%   orie          2: rows, y = constant (default); 1: columns, x = constant
%   pxory         'x': px (default), 'y': py
%   xslc          orie=1: x [mm] of the columns to be plotted; those of the nearest elements are used (default 0)
%   yslc          orie=2: the same for y [mm] of the rows
%   negpn         1: traction bound on the positive side (default); 0: on both; -1: on the negative side
%   facpt         factor of px or py: 1 (default), or -1 to plot their negatives
%   xlim, ylim    range [mm] of the horizontal axis for rows and for columns; default: the grid and one more element
%   plim          range of the vertical axis [N/mm2]; default: a little more than the traction bound
%   pn_linestyle  line style of the traction bound (default '--')
%   pt_linestyle  line style of the tractions (default '-o')
%
% The lines are added if the figure is held (hold on); otherwise the axes are cleared.
%
% See also: loadcase, plot3d.

   defaults = struct('orie',2, 'pxory','x', 'xslc',0, 'yslc',0, 'negpn',1, 'facpt',1, 'xlim',[], 'ylim',[], ...
                     'plim',[], 'pn_linestyle','--', 'pt_linestyle','-o');
   if (nargin<1)
      opt = defaults;
      return
   end
   if (nargin<2)
      opt = [];
   end
   opt = with_defaults(opt, defaults, 'plot2d');
   if (isnumeric(sol) && isempty(sol) && nargout>0)
      % nothing to plot: return the completed options without unknown ones
      opt = rmfield(opt, setdiff(fieldnames(opt), fieldnames(defaults)));
      return
   end
   if (numel(sol)~=1)
      error('plot2d: the solution must be one contact patch; it has %d.', numel(sol));
   end

   % slices as columns of arrays
   [pos, bound, pt, where, axis_lim] = take_slices(sol, opt);
   pt = opt.facpt * pt;

   held = ishold;
   if (~held && ~isempty(get(gca, 'children')))
      % Octave would keep that of the previous picture
      legend('off');
   end
   colors = get(gca, 'colororder');
   handles = [];
   for i = 1 : size(pt,2)
      c = colors(mod(i-1,size(colors,1))+1,:);
      if (opt.negpn>=0)
         plot(pos,  bound(:,i), opt.pn_linestyle, 'color',c);
         hold on
      end
      if (opt.negpn<=0)
         plot(pos, -bound(:,i), opt.pn_linestyle, 'color',c);
         hold on
      end
      handles(i) = plot(pos, pt(:,i), opt.pt_linestyle, 'color',c, 'markersize',4);
      hold on
   end
   if (~held)
      hold off
   end
   grid on

   axis([axis_lim, vertical_range(opt, bound, pt)]);
   other = 'yx';
   along = 'xy';
   xlabel(sprintf('%s [mm]', along(3-opt.orie)));
   name = ['p' opt.pxory];
   if (opt.facpt==-1)
      name = ['-' name];
   elseif (opt.facpt~=1)
      name = sprintf('%g %s', opt.facpt, name);
   end
   ylabel(sprintf('Traction %s and bound [N/mm^2]', name));
   if (numel(where)>1)
      labels = cell(1, numel(where));
      for i = 1 : numel(where)
         labels{i} = sprintf('%s = %.4g', other(3-opt.orie), rounded(where(i)));
      end
      legend(handles, labels);
   else
      title(sprintf('Tangential tractions at %s = %.4g', other(3-opt.orie), rounded(where)));
   end
   if (nargout<1)
      clear opt
   end

end % function plot2d

%------------------------------------------------------------------------------------------------------

function [ pos, bound, pt, where, axis_lim ] = take_slices( sol, opt )
% Positions along the slices, traction bound and tractions in columns, positions of the slices [mm]

   if (~any(strcmp(opt.pxory, {'x','y'})))
      error('plot2d: option pxory must be ''x'' or ''y''.');
   end
   field = sol.(['p' opt.pxory]);
   if ((opt.orie==2 && isempty(opt.yslc)) || (opt.orie==1 && isempty(opt.xslc)))
      error('plot2d: option yslc (rows, orie = 2) or xslc (columns, orie = 1) must be one position at least.');
   end
   if (opt.orie==2)
      rows  = nearest(sol.y, opt.yslc);
      pos   = sol.x(:);
      bound = sol.trcbnd(rows,:)';
      pt    = field(rows,:)';
      where = sol.y(rows);
      axis_lim = opt.xlim;
      step  = sol.dx;
   elseif (opt.orie==1)
      cols  = nearest(sol.x, opt.xslc);
      pos   = sol.y(:);
      bound = sol.trcbnd(:,cols);
      pt    = field(:,cols);
      where = sol.x(cols);
      axis_lim = opt.ylim;
      step  = sol.dy;
   else
      error('plot2d: option orie must be 1 or 2.');
   end
   if (isempty(axis_lim))
      axis_lim = [pos(1)-step, pos(end)+step];
   end

end % function take_slices

%------------------------------------------------------------------------------------------------------

function [ range ] = vertical_range( opt, bound, pt )
% The requested range, or that of all lines and five percent on both sides

   if (~isempty(opt.plim))
      range = opt.plim;
      return
   end
   pmax = max(bound(:));
   low  = min([0; pt(:)]);
   high = max([0; pt(:)]);
   if (opt.negpn>=0)
      high = max(high, pmax);
   end
   if (opt.negpn<=0)
      low = min(low, -pmax);
   end
   if (high<=low)
      high = low + 1;
   end
   range = [low, high] + 0.05*(high-low)*[-1 1];

end % function vertical_range

%------------------------------------------------------------------------------------------------------

function [ x ] = rounded( x )
% For texts: element centres that should be zero have round-off errors of the file

   x = round(1e4*x)/1e4 + 0;

end % function rounded
