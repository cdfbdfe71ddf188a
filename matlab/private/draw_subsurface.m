function draw_subsurface( b, sol, opt, c, rear )
% DRAW_SUBSURFACE  Stresses below the surface of one patch in the rear or side view of PLOT3D, as filled contours.
%
%   b       block of points of LOADSTRS; the largest von Mises stress along the line of sight is shown
%   c       struct of CONTACT_FRAME: depth is measured from the surface, along the normal of the contact
%   rear    rear view (y,z), else side view (x,z)

   b = whole_block(b);
   if (rear)
      val = reshape(max(b.sigvm, [], 1), b.ny, b.nz);
      [y, z, ny, nz] = points_on_surface(c, b.y);
      h = y(:)*ones(1,b.nz) + ny(:)*b.z';
      v = z(:)*ones(1,b.nz) + nz(:)*b.z';
   else
      val = reshape(max(b.sigvm, [], 2), b.nx, b.nz);
      x = c.x + b.x;
      h = x*ones(1,b.nz);
      v = revolve(c.z + 0*x, x, c.radius)*ones(1,b.nz) + ones(b.nx,1)*b.z';
   end
   if (opt.in_track)
      [h, v] = rail_to_track(sol.meta, rear, c.y, h, v);
   end
   % no contours where the profile ends
   there = ~any(isnan(v), 2);
   if (sum(there)<2 || b.nz<2)
      error('plot3d: to plot stresses below the surface a block needs at least 2 x 2 points.');
   end
   contourf(h(there,:), v(there,:), val(there,:), 'linestyle','none');
   if (~is_black(opt.colormap))
      set_colors(opt.colormap);
   end
   set(get(colorbar, 'ylabel'), 'string','\sigma_{vm} [N/mm^2]');

end % function draw_subsurface

%------------------------------------------------------------------------------------------------------

function [ b ] = whole_block( b )

   if (~isstruct(b) || numel(b)~=1 || ~all(isfield(b, {'x','y','z','sigvm'})))
      error('plot3d: subs must have a block of loadstrs for each patch.');
   end
   b.x = b.x(:);
   b.y = b.y(:);
   b.z = b.z(:);
   b.nx = numel(b.x);
   b.ny = numel(b.y);
   b.nz = numel(b.z);

end % function whole_block
