function [ h ] = plot_cm( O, r, veclen, theta, col, no_vec, no_head )
% PLOT_CM  Draw the symbol of a centre of mass: a circle with two filled quarters, and arrows along its axes.
%
%   h = plot_cm( O, r, veclen, theta, col, no_vec, no_head )
%
%   O        position in the current axes (default [0 0])
%   r        radius (default 1)
%   veclen   length of the arrows, which begin at the circle (default 2 r)
%   theta    angle of the first arrow [deg] (default 0)
%   col      colour: a name, red, green, blue, or a number for MATLAB_COLOR (default 'b')
%   no_vec   1: no arrows;  no_head  1: arrows without heads (default 0)
%
%   h        handles of circle, quarters, and shafts and heads of the arrows
%
% See also: plot_arrow, matlab_color.

   given = {[0 0], 1, [], 0, 'b', 0, 0};
   names = {'O','r','veclen','theta','col','no_vec','no_head'};
   values = given;
   if (nargin>=1), values{1} = O; end
   if (nargin>=2), values{2} = r; end
   if (nargin>=3), values{3} = veclen; end
   if (nargin>=4), values{4} = theta; end
   if (nargin>=5), values{5} = col; end
   if (nargin>=6), values{6} = no_vec; end
   if (nargin>=7), values{7} = no_head; end
   for i = 1 : numel(names)
      if (isempty(values{i}))
         values{i} = given{i};
      end
   end
   [O, r, veclen, theta, col, no_vec, no_head] = values{:};
   if (isempty(veclen))
      veclen = 2*r;
   end
   col = line_color(col);
   O = O(:)';
   held = ishold();
   hold on
   turn = @(from, to) (theta + linspace(from, to, 25))*pi/180;
   round = linspace(0, 2*pi, 97);
   h = plot(O(1)+r*cos(round), O(2)+r*sin(round), '-', 'color',col);
   for from = [90 270]
      a = turn(from, from+90);
      h(end+1,1) = fill(O(1)+r*[0 cos(a)], O(2)+r*[0 sin(a)], col, 'edgecolor','none');
   end
   if (~no_vec)
      for angle = theta + [0 90]
         n = [cos(angle*pi/180), sin(angle*pi/180)];
         h = [h; plot_arrow(O+r*n, veclen*n, col, 1-no_head)];
      end
   end
   if (~held)
      hold off
   end

end % function plot_cm
