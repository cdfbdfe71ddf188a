function draw_on_surface( sol, opt, prr, prw )
% DRAW_ON_SURFACE  The plots of PLOT3D on the surface of the rail or the wheel.

   body = 'r';
   p    = prr;
   if (strcmp(opt.rw_surf, 'prw'))
      body = 'w';
      p    = prw;
   end
   reach  = shown_range(sol, [], 1, 1.0);
   center = sol(1).meta.(['xcp_' body]);
   xrange = opt.xrange;
   if (isempty(xrange))
      xrange = center + max(abs(reach))*[-1 1];
   end

   % the body, a little below the contact so that colours and lines are on top of it
   lift = 0.01 * diff(xrange);
   draw_body(sol(1), opt, body, p, xrange, lift);
   if (strcmp(opt.rw_surf, 'both'))
      draw_wheel_lines(sol(1), opt, prw, xrange);
   end

   all_values = [];
   for i = 1 : numel(sol)
      f   = field_values(sol(i), opt.field);
      val = draw_patch(sol(i), f, opt, contact_frame(sol(i), body, p), body, lift);
      all_values = [all_values; val(:)];
   end

   set(gca, 'zdir','reverse', 'ydir','reverse', 'dataaspectratio',[1 opt.xstretch 1]);
   if (isnumeric(opt.view))
      view(opt.view);
   elseif (strcmp(opt.view,'rail'))
      view([-90 90]);
   else
      % the contact in front of the top of the rail; wheels are seen from below
      side = 1 - 2*(sol(1).meta.(['ycp_' body])<0);
      elevation = 30 - 60*(body=='w');
      view([-90+side*25, elevation]);
   end
   xlim(xrange);
   if (f.colors)
      finish_colors(all_values, opt);
   end
   xlabel(sprintf('x_{%s} [mm]', body));
   ylabel(sprintf('y_{%s} [mm]', body));
   zlabel(sprintf('z_{%s} [mm]', body));
   if (isempty(f.unit))
      title(f.title);
   else
      title(sprintf('%s [%s]', f.title, f.unit));
   end

end % function draw_on_surface

%------------------------------------------------------------------------------------------------------

function draw_body( sol, opt, body, p, xrange, lift )
% Grey surface with thin lines

   x = linspace(xrange(1), xrange(2), 25);
   [Y, Z] = surface_points(sol, body, p, x);
   inward = 1 - 2*(body=='w');
   Z = Z + inward*lift;
   X = ones(size(Y,1),1) * x;
   surf(X, Y, Z, repmat(reshape([0.82 0.82 0.80],1,1,3), size(Z)), 'edgecolor','none', 'facecolor','flat');

   [dx, dy] = line_steps(opt.xysteps, xrange, Y);
   xl = unique([xrange(1), ceil(xrange(1)/dx)*dx : dx : xrange(2), xrange(2)]);
   [yl, zl] = surface_points(sol, body, p, xl);
   % between surface and contact: the antialiased edges of lines hide objects at the same distance
   zl = zl + 0.8*inward*lift;
   for i = 1 : numel(xl)
      plot3(xl(i)+0*yl(:,i), yl(:,i), zl(:,i), '-', 'color',[0.6 0.6 0.6]);
   end
   len = chord_sums(Y(:,1), Z(:,1));
   for s = 0 : dy : len(end)
      [~, k] = min(abs(len-s));
      plot3(x, Y(k,:), Z(k,:)-0.2*inward*lift, '-', 'color',[0.6 0.6 0.6]);
   end

end % function draw_body

%------------------------------------------------------------------------------------------------------

function draw_wheel_lines( sol, opt, prw, xrange )
% The wheel as thin lines in rail coordinates, so that the contact can be seen through it

   xw = xrange - sol.meta.x_w;
   x  = linspace(xw(1), xw(2), 25);
   [Y, Z] = surface_points(sol, 'w', prw, x);
   [dx, dy] = line_steps(opt.xysteps, xrange, Y);
   xl = xw(1) : dx : xw(2);
   [yl, zl] = surface_points(sol, 'w', prw, xl);
   for i = 1 : numel(xl)
      [X1, Y1, Z1] = wheel_to_rail(sol, xl(i)+0*yl(:,i), yl(:,i), zl(:,i));
      plot3(X1, Y1, Z1, '-', 'color',[0.3 0.5 0.7]);
   end
   len = chord_sums(Y(:,1), Z(:,1));
   for s = 0 : dy : len(end)
      [~, k] = min(abs(len-s));
      [X1, Y1, Z1] = wheel_to_rail(sol, x, Y(k,:), Z(k,:));
      plot3(X1, Y1, Z1, '-', 'color',[0.3 0.5 0.7]);
   end

end % function draw_wheel_lines

%------------------------------------------------------------------------------------------------------

function [ Y, Z ] = surface_points( sol, body, p, x )
% Points of the surface at positions x along the body, one column each

   radius = Inf;
   if (body=='w')
      radius = sol.meta.rnom_whl;
   elseif (sol.config>=4)
      radius = -sol.meta.rnom_rol;
   end
   [y, z] = section_at(p, along_position(sol, body, x(1)));
   if (~isfield(p, 'vy'))
      Y = y * ones(size(x));
      Z = z * ones(size(x));
   else
      % parts of slices may be missing, so all points are kept here
      Y = zeros(size(p.vy,2), numel(x));
      Z = Y;
      for i = 1 : numel(x)
         u = min(p.u(end), max(p.u(1), along_position(sol, body, x(i))));
         Y(:,i) = interp1(p.u, p.vy, u)';
         Z(:,i) = interp1(p.u, p.vz, u)';
      end
   end
   Z = revolve(Z, ones(size(Z,1),1)*x, radius);

end % function surface_points

%------------------------------------------------------------------------------------------------------

function [ dx, dy ] = line_steps( steps, xrange, Y )

   if (isempty(steps))
      dx = diff(xrange) / 8;
      dy = (max(Y(:)) - min(Y(:))) / 16;
   else
      dx = steps(1);
      dy = steps(end);
   end

end % function line_steps

%------------------------------------------------------------------------------------------------------

function [ val ] = draw_patch( sol, f, opt, c, body, lift )
% Colours, arrows and outlines of one patch on its body; returns the values shown

   [ix, iy] = select_elements(sol, opt);
   [xc, yc] = corners(sol, ix, iy);
   val = shown_values(f, sol, opt);
   val = val(iy,ix);
   outward = 2*(body=='w') - 1;

   if (f.colors)
      [X, Y, Z] = on_body(c, xc, yc);
      h = surf(X, Y, Z, val([1:end end],[1:end end]));
      if (is_black(opt.colormap))
         set(h, 'facecolor','w', 'edgecolor','k');
      else
         set(h, 'facecolor','flat', 'edgecolor','none');
      end
   end
   if (~isempty(f.vx))
      [jx, jy, scale] = pick_arrows(f, sol, opt, ix, iy);
      [X, Y, Z, ty, tz] = on_body(c, sol.x(jx), sol.y(jy));
      vx = scale*f.vx(jy,jx);
      vy = scale*f.vy(jy,jx);
      there = hypot(vx,vy)>0;
      color = opt.veccolor;
      if (isempty(color))
         color = 'k';
      end
      args = line_options(color, opt.vecwidth);
      Z  = Z + outward*0.5*lift;
      vz = vy.*tz;
      vy = vy.*ty;
      if (any(there(:)))
         quiver3(X(there), Y(there), Z(there), vx(there), vy(there), vz(there), 0, args{:});
      end
   end
   if (~isempty(opt.addeldiv) && opt.addeldiv || strcmp(f.name,'eldiv_contour'))
      masks = element_masks(sol);
      for i = [2 3 1]
         [x, y] = mask_outline(masks{i}(iy,ix), xc, yc);
         if (~isempty(x))
            [yy, zz] = points_on_surface(c, y);
            zz = revolve(zz, c.x+x, c.radius) + outward*0.5*lift;
            plot3(c.x+x, yy, zz, '-', 'color',opt.eldivcol(i,:), 'linewidth',max([1 opt.eldivwid]));
         end
      end
   end

end % function draw_patch

%------------------------------------------------------------------------------------------------------

function [ X, Y, Z, ty, tz ] = on_body( c, x, s )
% Positions on the surface for all x and s, one row per s, and the lateral direction there

   [y, z, ny, nz] = points_on_surface(c, s);
   X  = ones(numel(s),1) * (c.x + x(:)');
   Y  = y(:) * ones(1,numel(x));
   Z  = revolve(z(:)*ones(1,numel(x)), X, c.radius);
   ty =  nz(:) * ones(1,numel(x));
   tz = -ny(:) * ones(1,numel(x));

end % function on_body
