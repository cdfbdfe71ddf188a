function [ h ] = plot_arrow( pos0, vec, col, scale, width, pln )
% PLOT_ARROW  Draw an arrow into the current axes, in two or three dimensions.
%
%   h = plot_arrow( pos0, vec, col, scale, width, pln )
%
%   pos0    its tail, 2 or 3 numbers
%   vec     from tail to tip
%   col     colour: a name, red, green, blue, or a number for MATLAB_COLOR (default 'b')
%   scale   size of the head; 1 (default): a quarter of the length
%   width   width of the head; 1 (default): 15 degrees to each side
%   pln     in three dimensions: normal of the plane of the head (default [0 0 1], or [1 0 0] for an arrow along z)
%
%   h       handles of the shaft and of the head
%
% See also: plot_cm, matlab_color.

   if (nargin<3), col = []; end
   col = line_color(col);
   if (nargin<4 || isempty(scale))
      scale = 1;
   end
   if (nargin<5 || isempty(width))
      width = 1;
   end
   n = numel(pos0);
   if (~any(n==[2 3]) || numel(vec)~=n)
      error('plot_arrow: pos0 and vec must both have 2 or 3 numbers, they have %d and %d.', n, numel(vec));
   end
   tail = [pos0(:); 0];
   along = [vec(:); 0];
   tail = tail(1:3);
   along = along(1:3);
   normal = [0; 0; 1];
   if (nargin>=6 && ~isempty(pln))
      normal = pln(:);
   end
   across = cross(normal, along);
   if (norm(across) <= 1e-10*norm(normal)*norm(along))
      across = cross([1; 0; 0], along);
   end
   if (norm(across)>0)
      across = across * norm(along)/norm(across);
   end
   tip  = tail + along;
   back = tip - 0.25*scale*along;
   side = 0.25*scale*width*tan(15*pi/180)*across;
   head = [back+side, tip, back-side];
   held = ishold();
   hold on
   if (n==2)
      h = [plot([tail(1) tip(1)], [tail(2) tip(2)], '-', 'color',col); plot(head(1,:), head(2,:), '-', 'color',col)];
   else
      h = [plot3([tail(1) tip(1)], [tail(2) tip(2)], [tail(3) tip(3)], '-', 'color',col)
           plot3(head(1,:), head(2,:), head(3,:), '-', 'color',col)];
   end
   if (~held)
      hold off
   end

end % function plot_arrow
