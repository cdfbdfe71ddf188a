function [ h ] = plot_axes( O, scl, theta, zpos, axnams, col, mrksiz, siz_o, fontsiz, txtcol, th_txt, fac_txt, no_orie, no_head, ...
                            left_hnd )
% PLOT_AXES  Draw two coordinate axes, seen along the third, with names and the positive sense of rotation.
%
%   h = plot_axes( O, scl, theta, zpos, axnams, col, mrksiz, siz_o, fontsiz, txtcol, th_txt, fac_txt, no_orie, no_head, left_hnd )
%
%   O        origin in the current axes, 2 numbers
%   scl      length of the arrows
%   theta    angle of the first axis [deg], from that of x to that of y of the current axes (default 0)
%   zpos     position of the viewer on the third axis; negative: from below, with the second axis reversed (default 1)
%   axnams   names of the three axes: letters, or an array or cell array of texts (default 'xyz')
%   col      colour: a name, red, green, blue, or a number for MATLAB_COLOR (default 'b')
%   mrksiz   size of the mark in the origin (default 8): a dot if the third axis points to the viewer, else a cross
%   siz_o    radius of the circle around it (default 0.07 scl)
%   fontsiz, txtcol, th_txt   size of the names, their colour (default col) and angle [deg]
%   fac_txt  distance of the names from the origin, relative to scl, one number or three (default 1.15)
%   no_orie, no_head, left_hnd   1: without the sense of rotation, without heads; left-handed axes (default 0)
%
%   h        handles: shaft, head and name of the first and of the second axis, circle, mark (twice), name of the third axis, and four
%            of the sense of rotation
%
% See also: plot_axes3, plot_arrow, circ_arrow.

   if (nargin<3 || isempty(theta)), theta = 0; end
   if (nargin<4 || isempty(zpos)), zpos = 1; end
   if (nargin<5 || isempty(axnams)), axnams = 'xyz'; end
   if (nargin<6), col = []; end
   col = line_color(col);
   if (nargin<7 || isempty(mrksiz)), mrksiz = 8; end
   if (nargin<8 || isempty(siz_o)), siz_o = 0.07*scl; end
   if (nargin<9 || isempty(fontsiz)), fontsiz = get(gca, 'fontsize'); end
   if (nargin<10 || isempty(txtcol)), txtcol = col; end
   if (nargin<11 || isempty(th_txt)), th_txt = 0; end
   if (nargin<12 || isempty(fac_txt)), fac_txt = 1.15; end
   if (nargin<13 || isempty(no_orie)), no_orie = 0; end
   if (nargin<14 || isempty(no_head)), no_head = 0; end
   if (nargin<15 || isempty(left_hnd)), left_hnd = 0; end
   O = O(:)';
   fac_txt = fac_txt(:)' .* ones(1,3);
   axnams = names_of(axnams);
   % a quarter turn as seen on the screen: pictures with one axis reversed are mirrored
   turn = 1 - 2*xor(strcmp(get(gca,'xdir'),'reverse'), strcmp(get(gca,'ydir'),'reverse'));
   turn = turn * (1 - 2*(zpos<0)) * (1 - 2*(left_hnd>0));
   first  = [cosd(theta), sind(theta)];
   second = [cosd(theta+90*turn), sind(theta+90*turn)];
   held = ishold();
   hold on
   named = @(place, i) axis_name(place, axnams{i}, fontsiz, txtcol, th_txt);
   h = [plot_arrow(O, scl*first, col, 1-(no_head>0)); named(O + fac_txt(1)*scl*first, 1)
        plot_arrow(O, scl*second, col, 1-(no_head>0)); named(O + fac_txt(2)*scl*second, 2)];
   round = (0:5:360);
   h(7) = plot(O(1)+siz_o*cosd(round), O(2)+siz_o*sind(round), '-', 'color',col);
   if (zpos<0)
      k = siz_o*[-1 1]/sqrt(2);
      h(8) = plot(O(1)+k, O(2)+k, '-', 'color',col);
      h(9) = plot(O(1)+k, O(2)-k, '-', 'color',col);
   else
      h(8) = plot(O(1), O(2), '.', 'color',col, 'markersize',mrksiz);
      h(9) = h(8);
   end
   h(10) = named(O - fac_txt(3)*2*siz_o*(first+second), 3);
   if (~no_orie)
      % rotation about the third axis turns the first towards the second
      c = O + 0.4*scl*(first+second);
      f = 0.05*scl*[-1 1];
      h(11) = plot(c(1)+f*first(1), c(2)+f*first(2), '-', 'color',col);
      h(12) = plot(c(1)+f*second(1), c(2)+f*second(2), '-', 'color',col);
      h(13:14) = circ_arrow(c, 0.15*scl, theta-120*turn, theta+150*turn, col, 1-(no_head>0));
   end
   if (~held)
      hold off
   end

end % function plot_axes
