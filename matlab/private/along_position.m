function [ u ] = along_position( sol, body, x )
% ALONG_POSITION  Position in a slices file for a coordinate x [mm] of the rail or wheel.
%
% Rails: distance along the track. Wheels: angle, zero at the bottom when the wheel is not turned; turning by a
% negative pitch angle, as in forward rolling, brings positive angles to the bottom.

   m = sol.meta;
   if (body=='r')
      u = m.s_ws + x;
      return
   end
   th_ws = 0;
   if (isfield(m, 'th_ws'))
      th_ws = m.th_ws;
   end
   u = asin(min(1, max(-1, x/m.rnom_whl))) - th_ws;
   u = mod(u+pi, 2*pi) - pi;

end % function along_position
