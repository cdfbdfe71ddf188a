function [ h ] = plot_axes3( O, scl, rot, axnams, col, mrksiz, fontsiz, txtcol, th_txt, fac_txt, no_head, left_hnd )
% PLOT_AXES3  Draw three coordinate axes in space, with names.
%
%   h = plot_axes3( O, scl, rot, axnams, col, mrksiz, fontsiz, txtcol, th_txt, fac_txt, no_head, left_hnd )
%
%   O        origin in the current axes, 3 numbers
%   scl      length of the arrows
%   rot      3 x 3 rotation matrix, or angles [roll yaw pitch] in degrees, for the matrix roll * yaw * pitch of a wheelset (default 0)
%   axnams   names of the axes: letters, or an array or cell array of texts (default 'xyz')
%   col, mrksiz, fontsiz, txtcol, th_txt   as for PLOT_AXES
%   fac_txt  positions of the names relative to scl: one number, one per axis, or a 3 x 3 array with one row each (default 1.15)
%   no_head, left_hnd   1: without heads; angles in the opposite direction (default 0)
%
%   h        handles: shaft, head and name of each axis, and the mark in the origin
%
% See also: plot_axes, plot_arrow.

   if (nargin<3 || isempty(rot)), rot = [0 0 0]; end
   if (nargin<4 || isempty(axnams)), axnams = 'xyz'; end
   if (nargin<5), col = []; end
   col = line_color(col);
   if (nargin<6 || isempty(mrksiz)), mrksiz = 8; end
   if (nargin<7 || isempty(fontsiz)), fontsiz = get(gca, 'fontsize'); end
   if (nargin<8 || isempty(txtcol)), txtcol = col; end
   if (nargin<9 || isempty(th_txt)), th_txt = 0; end
   if (nargin<10 || isempty(fac_txt)), fac_txt = 1.15; end
   if (nargin<11 || isempty(no_head)), no_head = 0; end
   if (nargin<12 || isempty(left_hnd)), left_hnd = 0; end
   if (numel(rot)==3)
      rot = rotation(rot * (1 - 2*(left_hnd>0)));
   end
   if (numel(fac_txt)<9)
      fac_txt = bsxfun(@times, fac_txt(:) .* ones(3,1), rot');
   end
   axnams = names_of(axnams);
   O = O(:)';
   held = ishold();
   hold on
   h = [];
   for i = 1 : 3
      h = [h; plot_arrow(O, scl*rot(:,i)', col, 1-(no_head>0))];
      h(end+1,1) = axis_name(O + scl*fac_txt(i,:), axnams{i}, fontsiz, txtcol, th_txt);
   end
   h(10) = plot3(O(1), O(2), O(3), '.', 'color',col, 'markersize',mrksiz);
   if (~held)
      hold off
   end

end % function plot_axes3

%------------------------------------------------------------------------------------------------------

function [ r ] = rotation( angles )
% roll about x, yaw about z, pitch about y

   c = cosd(angles);
   s = sind(angles);
   r = [1 0 0; 0 c(1) -s(1); 0 s(1) c(1)] * [c(2) -s(2) 0; s(2) c(2) 0; 0 0 1] * [c(3) 0 s(3); 0 1 0; -s(3) 0 c(3)];

end % function rotation
