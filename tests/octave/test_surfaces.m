% Places and directions on a profile that is an arc, whatever order its points are in: against the circle itself

addpath(fullfile(fileparts(which('plot3d')), 'private'));
radius = 13;
for order = [1 -1]
   for middle = [-0.4 0 0.7]
      % an arc with its centre below, as a rail: angle 0 on top, z down
      angle = middle + (-0.6:0.0005:0.6);
      if (order<0)
         angle = fliplr(angle);
      end
      c = struct('py', 100+radius*sin(angle)', 'pz', 5-radius*cos(angle)', 'delta', middle, ...
                 'y', 100+radius*sin(middle), 'z', 5-radius*cos(middle));
      s = -5:0.37:5;
      for conformal = [true false]
         c.conformal = conformal;
         [y, z, ny, nz] = points_on_surface(c, s);
         name = sprintf('order %d, middle %g, conformal %d: ', order, middle, conformal);
         if (conformal)
            at = middle + s/radius;
            check_near(ny, -sin(at), 1e-3, [name 'normal along y']);
            check_near(nz,  cos(at), 1e-3, [name 'normal along z']);
         else
            at = middle + asin(s/radius);
            check_near(ny, -sin(middle)+0*s, 1e-12, [name 'normal along y']);
            check_near(nz,  cos(middle)+0*s, 1e-12, [name 'normal along z']);
         end
         check_near(y, 100+radius*sin(at), 1e-3, [name 'y']);
         check_near(z,   5-radius*cos(at), 1e-3, [name 'z']);
      end
      % beyond the ends there is no profile
      [y, z] = points_on_surface(c, [-12 0 12]);
      check(isequal(isnan(y), [true false true]) && isequal(isnan(z), isnan(y)), 'NaN beyond the ends');
   end
end

% A surface of revolution: a ball of 460 mm, its axis above (wheel) and below (roller), and what does not turn
x = -470:47:470;
for radius = [460 -460]
   z = revolve(-3, x, radius);
   outside = abs(x)>abs(abs(radius)-sign(radius)*3);
   check(isequal(isnan(z), outside) && any(outside), 'no height beyond the surface');
   at = ~outside;
   % the same distance from the axis everywhere
   check_near(hypot(z(at)+radius, x(at)), (radius-3)*sign(radius)+0*x(at), 1e-9, 'distance from the axis');
end
check_near(revolve([1;2]*ones(size(x)), x, Inf), [1;2]*ones(size(x)), 0, 'a rail');
