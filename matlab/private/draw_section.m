function draw_section( sol, opt, prr, prw, which, subs )
% DRAW_SECTION  Rear view (y,z) or side view (x,z) of PLOT3D: outlines of rail and wheel, with bars for the values.
%
% Rail coordinates are used, for rw_surf = 'prw' wheel coordinates, with opt.in_track those of the track. For each row of
% elements (side view: column) the value of largest magnitude is drawn from the surface along the normal of the contact into the
% body, over the stresses of the blocks subs.

   body = 'r';
   if (strcmp(opt.rw_surf, 'prw'))
      body = 'w';
   end
   rear = strcmp(which, 'rear');
   if (~rear)
      xrange = shown_range(sol, opt.xrange, 1, 0.5);
      if (isempty(opt.xrange))
         xrange = xrange + sol(1).meta.(['xcp_' body]);
      end
   end

   profile = {prr, prw};
   profile = profile{1+(body=='w')};
   for i = 1 : numel(subs)
      draw_subsurface(subs(i), sol(i), opt, contact_frame(sol(i), body, profile), rear);
   end

   before = get(gca, 'children');
   for i = 1 : numel(sol)
      c = contact_frame(sol(i), body, profile);
      if (i==1)
         if (rear)
            outline(c.py, c.pz, body);
            if (strcmp(opt.rw_surf, 'both'))
               cw = contact_frame(sol(i), 'w', prw);
               xw = cw.x + 0*cw.py;
               [~, yw, zw] = wheel_to_rail(sol(i), xw, cw.py, revolve(cw.pz, xw, cw.radius));
               outline(yw, zw, 'w');
            end
         else
            x = linspace(xrange(1), xrange(2), 200);
            outline(x, revolve(c.z + 0*x, x, c.radius), body);
            if (strcmp(opt.rw_surf, 'both'))
               % the rolling circle through the contact
               cw = contact_frame(sol(i), 'w', prw);
               x0 = x - sol(i).meta.x_w;
               [xx, ~, zz] = wheel_to_rail(sol(i), x0, cw.y + 0*x0, revolve(cw.z + 0*x0, x0, cw.radius));
               outline(xx, zz, 'w');
            end
         end
      end
      draw_bars(sol(i), opt, c, rear, body);
      % contact reference
      if (rear)
         plot(c.y, c.z, 'ko', 'markerfacecolor','k', 'markersize',4);
      else
         plot(c.x, c.z, 'ko', 'markerfacecolor','k', 'markersize',4);
      end
   end

   named = body;
   if (opt.in_track)
      to_track(setdiff(get(gca, 'children'), before), sol(1).meta, rear, c.y);
      named = 'tr';
   end
   f = field_values(sol(1), opt.field);
   set(gca, 'ydir','reverse');
   axis equal
   if (~rear)
      xlim(xrange);
   end
   if (~isempty(opt.zrange))
      ylim(opt.zrange);
   end
   box on
   grid on
   horizontal = 'xy';
   xlabel(sprintf('%s_{%s} [mm]', horizontal(1+rear), named));
   ylabel(sprintf('z_{%s} [mm]', named));
   views = {'side view','rear view'};
   title(sprintf('%s [%s], %s', f.title, f.unit, views{1+rear}));

end % function draw_section

%------------------------------------------------------------------------------------------------------

function to_track( lines, m, rear, y )
% Move what was drawn in rail coordinates to those of the track; in a side view at the lateral position of the contact

   for h = lines(:)'
      [a, b] = rail_to_track(m, rear, y, get(h, 'xdata'), get(h, 'ydata'));
      set(h, 'xdata',a, 'ydata',b);
   end

end % function to_track

%------------------------------------------------------------------------------------------------------

function outline( a, b, body )

   color = [0.25 0.25 0.25];
   if (body=='w')
      color = [0.3 0.5 0.7];
   end
   plot(a, b, '-', 'color',color, 'linewidth',1.2);

end % function outline

%------------------------------------------------------------------------------------------------------

function draw_bars( sol, opt, c, rear, body )
% Bars and their envelope for one patch

   f = field_values(sol, opt.field);
   v = f.val;
   v(sol.eldiv==0) = 0;
   v(isnan(v)) = 0;
   [ix, iy] = select_elements(sol, opt);
   v = v(iy,ix);
   if (rear)
      v = largest(v');
      [a, b, na, nb] = points_on_surface(c, sol.y(iy));
      nmax = opt.numvecy;
   else
      v = largest(v);
      a = c.x + sol.x(ix);
      b = revolve(c.z + 0*a, a, c.radius);
      na = 0*a;
      nb = 1 + 0*a;
      nmax = opt.numvecx;
   end
   v = v(:)';
   scale = opt.vecscale;
   if (isempty(scale))
      scale = 1;
      if (any(v))
         scale = 0.5 * (max(hypot(a-a(1),b-b(1)))) / max(abs(v));
      end
   end
   if (body=='w')
      % into the wheel
      na = -na;
      nb = -nb;
   end
   color = opt.veccolor;
   if (isempty(color))
      color = 'b';
   end
   args = line_options(color, opt.vecwidth);
   ta = a + scale*v.*na;
   tb = b + scale*v.*nb;
   plot(ta, tb, '-', args{:});
   step = max(1, ceil(numel(a)/nmax));
   k = ceil(step/2) : step : numel(a);
   n = NaN(size(k));
   plot(reshape([a(k); ta(k); n],1,[]), reshape([b(k); tb(k); n],1,[]), '-', args{:});

end % function draw_bars

%------------------------------------------------------------------------------------------------------

function [ v ] = largest( v )
% The value of largest magnitude in each column, with its sign

   [~, k] = max(abs(v), [], 1);
   v = v(sub2ind(size(v), k, 1:size(v,2)));

end % function largest
