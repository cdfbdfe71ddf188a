function [ opt ] = plotstrs( sol, opt )
% PLOTSTRS  Plot displacements or stresses below the surface in a slice through a block of points.
%
%   opt = plotstrs       the options with their default values; opt = plotstrs( [], opt ): completed
%   plotstrs( sol )      plot with the default options
%   plotstrs( sol, opt )
%
%   sol   struct of LOADSTRS or DIFFSTRS
%   opt   struct of options:
%
%   field      'ux', 'uy', 'uz'            displacements [mm], in the upper (z>0) or lower body (z<0)
%              'sighyd' or 'hydro'         mean hydrostatic stress [N/mm2]
%              'sigvm' or 'mises'          von Mises stress [N/mm2] (default)
%              with the full stress tensor (A=2):
%              'sigxx', 'sigxy', 'sigxz', 'sigyy', 'sigyz', 'sigzz'   its components [N/mm2]
%              'sigma1', 'sigma2', 'sigma3'   principal stresses [N/mm2]
%              'sigtr' or 'tresca'         maximum shear stress sigma1 - sigma3 [N/mm2]
%   dir        'y' (default): slice y = constant; 'x', 'z': x or z = constant
%   xslc, yslc, zslc   position of the slice [mm]; that of the nearest points is used (default 0)
%   addplot    1: do not clear the figure; 0 (default)
%   typplot    'contourf' (default), 'contour', or 'surf' for one colour per cell
%   cntrlvl    values for contour lines; 'auto' (default)
%   clabel     'on': numbers on contour lines; 'off' (default)
%   scale      'linear' (default) or 'log': colours for the logarithm (base 10) of the magnitude
%   colormap   name, e.g. 'parula' (default), 'jet', 'hot', or an n x 3 array
%
% See also: loadstrs, diffstrs, plot3d.

   defaults = struct('field','mises', 'dir','y', 'xslc',0, 'yslc',0, 'zslc',0, 'addplot',0, 'typplot','contourf', ...
                     'cntrlvl','auto', 'clabel','off', 'scale','linear', 'colormap','parula');
   if (nargin<1)
      opt = defaults;
      return
   end
   if (nargin<2)
      opt = [];
   end
   opt = with_defaults(opt, defaults, 'plotstrs');
   if (isnumeric(sol) && isempty(sol) && nargout>0)
      % nothing to plot: return the completed options without unknown ones
      opt = rmfield(opt, setdiff(fieldnames(opt), fieldnames(defaults)));
      return
   end

   [val, name, unit] = field_of_block(sol, opt.field);
   [a, b, val, labels, at] = take_slice(sol, opt, val);
   if (numel(a)<2 || numel(b)<2)
      error('plotstrs: the slice has %d x %d points; a plot needs at least 2 x 2.', numel(a), numel(b));
   end
   levels = opt.cntrlvl;
   if (strcmp(opt.scale, 'log'))
      val  = log10(max(abs(val), 1e-6*max(abs(val(:)))));
      name = ['log_{10} |' name '|'];
      if (isnumeric(levels))
         levels = log10(levels(levels>0));
      end
   elseif (~strcmp(opt.scale, 'linear'))
      error('plotstrs: option scale must be ''linear'' or ''log''.');
   end

   if (~opt.addplot)
      clf
   end
   hold on
   draw(a, b, val, levels, opt);
   if (~strcmp(opt.typplot, 'contour'))
      set_colors(opt.colormap);
   end
   colorbar;
   axis([min(a) max(a) min(b) max(b)]);
   if (~strcmp(opt.dir, 'z'))
      % z points down
      set(gca, 'ydir','reverse');
   end
   box on
   xlabel([labels{1} ' [mm]']);
   ylabel([labels{2} ' [mm]']);
   title(sprintf('%s [%s] at %s = %.4g mm', name, unit, opt.dir, at));
   if (nargout<1)
      clear opt
   end

end % function plotstrs

%------------------------------------------------------------------------------------------------------

function [ val, name, unit ] = field_of_block( sol, field )

   switch (field)
      case {'sighyd','hydro'}
         f = 'sighyd';   name = '\sigma_{hyd}';
      case {'sigvm','mises'}
         f = 'sigvm';    name = '\sigma_{vm}';
      case {'sigtr','tresca'}
         f = 'sigtr';    name = '\sigma_{tresca}';
      case {'ux','uy','uz'}
         f = field;      name = ['u_' field(2)];
      case {'sigxx','sigxy','sigxz','sigyy','sigyz','sigzz'}
         f = field;      name = ['\sigma_{' field(4:5) '}'];
      case {'sigma1','sigma2','sigma3'}
         f = field;      name = ['\sigma_' field(6)];
      otherwise
         error('plotstrs: there is no field ''%s''; help plotstrs lists them.', field);
   end
   if (~isfield(sol, f))
      error('plotstrs: this block has no field ''%s''; stress tensors need A = 2 in the input.', f);
   end
   val  = sol.(f);
   unit = 'N/mm^2';
   if (f(1)=='u')
      unit = 'mm';
   end

end % function field_of_block

%------------------------------------------------------------------------------------------------------

function [ a, b, val, labels, at ] = take_slice( sol, opt, val )
% Horizontal and vertical coordinates, values with one row per vertical position, position of the slice

   switch (opt.dir)
      case 'x'
         k = nearest(sol.x, opt.xslc);
         a = sol.y;   b = sol.z;   labels = {'y','z'};   at = sol.x(k);
         val = reshape(val(k,:,:), sol.ny, sol.nz)';
      case 'y'
         k = nearest(sol.y, opt.yslc);
         a = sol.x;   b = sol.z;   labels = {'x','z'};   at = sol.y(k);
         val = reshape(val(:,k,:), sol.nx, sol.nz)';
      case 'z'
         k = nearest(sol.z, opt.zslc);
         a = sol.x;   b = sol.y;   labels = {'x','y'};   at = sol.z(k);
         val = reshape(val(:,:,k), sol.nx, sol.ny)';
      otherwise
         error('plotstrs: option dir must be ''x'', ''y'' or ''z''.');
   end
   if (numel(k)~=1)
      error('plotstrs: one slice can be plotted at a time; %d were requested.', numel(k));
   end

end % function take_slice

%------------------------------------------------------------------------------------------------------

function draw( a, b, val, levels, opt )

   args = {};
   if (isnumeric(levels))
      args = {levels};
   end
   switch (opt.typplot)
      case 'surf'
         h = surf(a, b, zeros(size(val)), val);
         set(h, 'edgecolor','none', 'facecolor','interp');
         view([0 90]);
         return
      case 'contourf'
         [c, h] = filled_contours(a, b, val, args{:});
         view([0 90]);
      case 'contour'
         [c, h] = contour(a, b, val, args{:});
      otherwise
         error('plotstrs: option typplot must be ''surf'', ''contour'' or ''contourf''.');
   end
   if (strcmp(opt.clabel, 'on'))
      if (~isempty(c))
         clabel(c, h);
      end
   elseif (~strcmp(opt.clabel, 'off'))
      error('plotstrs: option clabel must be ''on'' or ''off''.');
   end

end % function draw
