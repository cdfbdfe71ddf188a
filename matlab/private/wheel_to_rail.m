function [ x, y, z ] = wheel_to_rail( sol, x, y, z )
% WHEEL_TO_RAIL  Points in wheel coordinates moved to rail coordinates [mm].
%
% From the wheel to the track by yaw, then roll, and the position of the wheel; from there to the rail.

   m = sol.meta;
   [x, y] = turn(x, y,  m.yaw_w);
   [y, z] = turn(y, z,  m.roll_w);
   x = x + m.x_w;
   [y, z] = turn(y + m.y_w - m.y_r, z + m.z_w - m.z_r, -m.roll_r);

end % function wheel_to_rail

%------------------------------------------------------------------------------------------------------

function [ a, b ] = turn( a0, b0, angle )

   a = a0*cos(angle) - b0*sin(angle);
   b = a0*sin(angle) + b0*cos(angle);

end % function turn
