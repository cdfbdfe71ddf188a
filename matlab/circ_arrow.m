function [ h ] = circ_arrow( pos_c, r, th0, th1, col, scale, width, rot )
% CIRC_ARROW  Draw an arrow along a circle into the current axes, in two or three dimensions.
%
%   h = circ_arrow( pos_c, r, th0, th1, col, scale, width, rot )
%
%   pos_c   centre, 2 or 3 numbers
%   r       radius, or [rx ry] of an ellipse; negative: angles are counted in the opposite direction
%   th0, th1   angles of tail and tip [deg]
%   col     colour: a name, red, green, blue, or a number for MATLAB_COLOR (default 'b')
%   scale   size of the head; 1 (default): a quarter of the radius
%   width   width of the head; 1 (default): 15 degrees to each side
%   rot     in three dimensions: rotation of the x-y plane in which the arrow is drawn (default: none)
%
%   h       handles of the arc and of the head
%
% See also: plot_arrow, plot_axes.

   if (nargin<5), col = []; end
   col = line_color(col);
   if (nargin<6 || isempty(scale)), scale = 1; end
   if (nargin<7 || isempty(width)), width = 1; end
   if (nargin<8 || isempty(rot)), rot = eye(3); end
   n = numel(pos_c);
   if (~any(n==[2 3]))
      error('circ_arrow: pos_c must have 2 or 3 numbers, it has %d.', n);
   end
% one radius applies to both directions
   r = [r(1), r(end)];
   if (r(1)<0)
      r = [abs(r(1)), -abs(r(2))];
   end
   point = @(th) [r(1)*cosd(th); r(2)*sind(th); 0*th];
   arc = point(linspace(th0, th1, max(7, 1+ceil(abs(th1-th0)/3))));
   tip = point(th1);
   % the middle of the rear edge of the head is on the arc, too
   back = tip - point(th1 - sign(th1-th0)*min(0.25*scale*180/pi, abs(th1-th0)));
   side = width*tan(15*pi/180) * [-back(2); back(1); 0];
   head = [tip-back+side, tip, tip-back-side];
   centre = [pos_c(:); zeros(3-n,1)];
   arc  = bsxfun(@plus, centre, rot*arc);
   head = bsxfun(@plus, centre, rot*head);
   held = ishold();
   hold on
   if (n==2)
      h = [plot(arc(1,:), arc(2,:), '-', 'color',col); plot(head(1,:), head(2,:), '-', 'color',col)];
   else
      h = [plot3(arc(1,:), arc(2,:), arc(3,:), '-', 'color',col); plot3(head(1,:), head(2,:), head(3,:), '-', 'color',col)];
   end
   if (~held)
      hold off
   end

end % function circ_arrow
