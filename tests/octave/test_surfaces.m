% Positions and directions on a circular profile, independent of the order of its points: against the circle itself

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
      % no profile beyond the ends
      [y, z] = points_on_surface(c, [-12 0 12]);
      check(isequal(isnan(y), [true false true]) && isequal(isnan(z), isnan(y)), 'NaN beyond the ends');
   end
end

% A contact at the first or last point of a profile, and on a profile that turns by more than half a circle
for at = [-1.2 1.2]
   angle = (-1.2:0.0005:1.2);
   c = struct('py', radius*sin(angle)', 'pz', -radius*cos(angle)', 'delta', at, 'y', radius*sin(at), 'z', -radius*cos(at), ...
              'conformal', true);
   s = -sign(at)*(0.5:0.5:4);
   [y, z] = points_on_surface(c, s);
   check_near(y,  radius*sin(at+s/radius), 1e-3, 'y beside an end');
   check_near(z, -radius*cos(at+s/radius), 1e-3, 'z beside an end');
end
angle = (-2.6:0.0005:2.6);
c = struct('py', radius*sin(angle)', 'pz', -radius*cos(angle)', 'delta', -0.9, ...
           'y', radius*sin(-0.9), 'z', -radius*cos(-0.9), 'conformal', true);
[y, z] = points_on_surface(c, [-3 3]);
check_near(y,  radius*sin(-0.9+[-3 3]/radius), 1e-3, 'y on a long arc');
check_near(z, -radius*cos(-0.9+[-3 3]/radius), 1e-3, 'z on a long arc');

% A surface of revolution: a ball of 460 mm, its axis above (wheel) and below (roller), and a surface that does not rotate
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
