function draw_flat( sol, opt )
% DRAW_FLAT  The plots of PLOT3D in the plane of the contact.

   before = [];
   if (~isempty(get(gca, 'children')))
      before = axis;
   end
   f = field_values(sol, opt.field);
   [ix, iy] = select_elements(sol, opt);
   [xc, yc] = corners(sol, ix, iy);
   xm  = (xc(1:end-1)+xc(2:end))/2;
   ym  = (yc(1:end-1)+yc(2:end))/2;
   val = shown_values(f, sol, opt);
   val = val(iy,ix);

   flat_field = ~isempty(f.vx) || strncmp(f.name,'eldiv',5) || strcmp(opt.typplot,'contourf');
   [azel, above, y_reversed] = view_angles(opt.view, flat_field);

   switch (f.name)
      case 'eldiv_spy'
         draw_symbols(sol, ix, iy, xm, ym);
      case 'eldiv_contour'
         draw_outlines(sol, opt, ix, iy, xc, yc);
      case 'eldiv'
         draw_states(sol, ix, iy, xc, yc, azel);
      otherwise
         if (f.colors && strcmp(opt.typplot,'contourf'))
            draw_contours(xm, ym, xc, yc, val, azel);
         elseif (f.colors && above)
            z = -sign(azel(2)) * ones(numel(yc), numel(xc));
            paint(xc, yc, z, val([1:end end],[1:end end]), opt);
         elseif (f.colors)
            draw_heights(xm, ym, xc, yc, val, opt);
         end
         if (f.colors)
            finish_colors(val, opt);
         end
         if (~isempty(f.vx))
            draw_arrows(f, sol, opt, ix, iy, xm, ym);
         end
   end
   with_lines = opt.addeldiv;
   if (isempty(with_lines))
      with_lines = (~isempty(f.vx) && f.colors);
   end
   if (with_lines && above)
      draw_outlines(sol, opt, ix, iy, xc, yc);
   end

   view(azel);
   if (y_reversed)
      set(gca, 'ydir','reverse');
   end
   range = [xc(1) xc(end) yc(1) yc(end)];
   if (~isempty(before))
      % added to what has been drawn: other patches, other cases
      range([1 3]) = min(range([1 3]), before([1 3]));
      range([2 4]) = max(range([2 4]), before([2 4]));
   end
   if (above || any(strcmp(f.name, {'eldiv_spy','eldiv_contour'})))
      axis(range);
   end
   if (above)
      box on
   end
   if (opt.xstretch~=1 || (numel(xm)>1 && numel(ym)>1))
      lengths = diff(range([1 2; 3 4]), 1, 2)' .* [1 1/opt.xstretch];
      heights = get(gca, 'zlim');
      % heights take half the length of the longer side
      set(gca, 'dataaspectratio',[1 opt.xstretch 2*diff(heights)/max(lengths)]);
   end
   xlabel('x [mm]');
   ylabel('y [mm]');
   text = f.title;
   if (~isempty(f.unit))
      text = sprintf('%s [%s]', f.title, f.unit);
   end
   title(text);

end % function draw_flat

%------------------------------------------------------------------------------------------------------

function [ azel, above, y_reversed ] = view_angles( view, flat_field )
% Azimuth and elevation; is it a picture from above? As z points down, the view is from below, which is the
% same as from above with the y-axis reversed

   y_reversed = false;
   if (isnumeric(view))
      azel = view;
   elseif (strcmp(view,'rail'))
      azel = [-90 90];
      y_reversed = true;
   elseif (strcmp(view,'rdyn'))
      azel = [180 90];
   elseif (strcmp(view,'default'))
      azel = [-37.5 30];
      if (flat_field)
         azel = [0 90];
      end
   else
      error('plot3d: option view must be ''default'', ''rail'', ''rdyn'' or [azimuth elevation].');
   end
   above = (abs(azel(2))==90);

end % function view_angles

%------------------------------------------------------------------------------------------------------

function paint( x, y, z, c, opt )
% Surface with one colour per element, or black lines on white

   h = surf(x, y, z, c);
   if (is_black(opt.colormap))
      set(h, 'facecolor','w', 'edgecolor','k');
   else
      set(h, 'facecolor','flat', 'edgecolor','none');
   end

end % function paint

%------------------------------------------------------------------------------------------------------

function draw_contours( xm, ym, xc, yc, val, azel )
% Filled contours. Elements without a value get the lowest one, and are covered by white afterwards

   if (numel(xm)<2 || numel(ym)<2)
      error('plot3d: typplot = ''contourf'' needs at least 2 x 2 elements; %d x %d are shown.', numel(xm), numel(ym));
   end
   missing = isnan(val);
   if (all(missing(:)))
      return
   end
   low  = min(val(:));
   high = max(val(:));
   val(missing) = low;
   filled_contours(xm, ym, val, low + (high-low)*(0:11)/12);
   if (any(missing(:)))
      z = sign(azel(2)) * ones(numel(yc), numel(xc));
      c = ones(numel(ym), numel(xm), 3);
      c(repmat(~missing, [1 1 3])) = NaN;
      cover = z;
      surf(xc, yc, cover, c([1:end end],[1:end end],:), 'edgecolor','none', 'facecolor','flat');
   end

end % function draw_contours

%------------------------------------------------------------------------------------------------------

function draw_heights( xm, ym, xc, yc, val, opt )
% Values as heights. A single row or column of elements is drawn with its width

   if (numel(ym)==1)
      ym = yc;
      val = val([1 1],:);
   end
   if (numel(xm)==1)
      xm = xc;
      val = val(:,[1 1]);
   end
   h = surf(xm, ym, val, val);
   if (is_black(opt.colormap))
      set(h, 'facecolor','w', 'edgecolor','k');
   else
      set(h, 'edgecolor',[0.3 0.3 0.3], 'linewidth',0.25);
   end
   grid on
   if (~isempty(opt.zrange))
      zlim(opt.zrange);
   end

end % function draw_heights

%------------------------------------------------------------------------------------------------------

function draw_arrows( f, sol, opt, ix, iy, xm, ym )

   [jx, jy, scale] = pick_arrows(f, sol, opt, ix, iy);
   vx = scale * f.vx(jy,jx);
   vy = scale * f.vy(jy,jx);
   [x, y] = meshgrid(xm(jx-ix(1)+1), ym(jy-iy(1)+1));
   there = (hypot(vx,vy)>0);
   color = opt.veccolor;
   if (isempty(color))
      color = 'k';
      if (~f.colors)
         color = 'b';
      end
   end
   args = line_options(color, opt.vecwidth);
   % quiver fails without arrows
   if (any(there(:)))
      quiver(x(there), y(there), vx(there), vy(there), 0, args{:});
   end

end % function draw_arrows

%------------------------------------------------------------------------------------------------------

function draw_outlines( sol, opt, ix, iy, xc, yc )
% Lines around contact, slip and plasticity, in front of surfaces seen from above and from below

   masks = element_masks(sol);
   width = opt.eldivwid;
   if (isempty(width))
      width = 1.5;
   end
   for i = [2 3 1]
      [x, y] = mask_outline(masks{i}(iy,ix), xc, yc);
      if (~isempty(x))
         for z = [-1 1]
            plot3(x, y, z + 0*x, '-', 'color',opt.eldivcol(i,:), 'linewidth',width);
         end
      end
   end

end % function draw_outlines

%------------------------------------------------------------------------------------------------------

function draw_states( sol, ix, iy, xc, yc, azel )
% One colour for each state

   states = sol.eldiv(iy,ix);
   surf(xc, yc, -sign(azel(2))*ones(numel(yc),numel(xc)), states([1:end end],[1:end end]), 'edgecolor','none');
   colormap([1 1 1; 0.35 0.55 0.85; 0.90 0.45 0.35; 0.85 0.70 0.25]);
   caxis([-0.5 3.5]);
   h = colorbar;
   set(h, 'ytick',0:3, 'yticklabel',{'exterior','adhesion','slip','plastic'});

end % function draw_states

%------------------------------------------------------------------------------------------------------

function draw_symbols( sol, ix, iy, xm, ym )
% One symbol for each element in contact

   [x, y] = meshgrid(xm, ym);
   states  = sol.eldiv(iy,ix);
   symbols = {'*','o','s'};
   colors  = {[0 0 0.7], [0.8 0 0], [0.75 0 0.75]};
   names   = {'adhesion','slip','plastic'};
   shown   = {};
   for i = 1 : 3
      k = (states==i);
      if (any(k(:)))
         plot(x(k), y(k), symbols{i}, 'color',colors{i}, 'markersize',4);
         shown{end+1} = names{i};
      end
   end
   if (~isempty(shown))
      legend(shown);
   end

end % function draw_symbols
