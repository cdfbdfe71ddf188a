function [ x, y, z, theta ] = make_reflec( spl2d, vec_a, vec_v, ui, vj )
% MAKE_REFLEC  Reflection angles of a spline surface; lines of constant angle show how smooth the surface is.
%
%   [x, y, z, theta] = make_reflec( spl2d, vec_a, vec_v, ui, vj )
%
%   spl2d    struct of MAKE_2DSPLINE, or of READ_SLICES for a profile in slices
%   vec_a    direction to the light, vec_v direction to the eye: [x y z], or azimuth and elevation in degrees, from x to y and up z
%   ui, vj   parameters of the points, all of ui with all of vj
%
%   x, y, z  the points, numel(ui) x numel(vj) arrays
%   theta    angle between the reflected ray and the light [deg], 0 to 180
%
% See also: make_2dspline, eval_2dspline, plot_2dspline.

   a = direction(vec_a);
   v = direction(vec_v);
   ui = ui(:);
   vj = vj(:)';
   u = repmat(ui, 1, numel(vj));
   w = repmat(vj, numel(ui), 1);
   shape = size(u);
   [~, x, y, z] = eval_2dspline(spl2d, u(:), w(:));
   [xu, yu, zu] = eval_2dspline_deriv(spl2d, u(:), w(:), 1);
   [xv, yv, zv] = eval_2dspline_deriv(spl2d, u(:), w(:), 2);
   n = cross([xu yu zu], [xv yv zv], 2);
   n = bsxfun(@rdivide, n, sqrt(sum(n.^2, 2)));
   r = bsxfun(@minus, bsxfun(@times, 2*(n*v), n), v');
   theta = reshape(acos(max(-1, min(1, r*a))) * 180/pi, shape);
   x = reshape(x, shape);
   y = reshape(y, shape);
   z = reshape(z, shape);

end % function make_reflec

%------------------------------------------------------------------------------------------------------

function [ d ] = direction( d )
% Unit vector as a column

   d = d(:);
   if (numel(d)==2)
      d = d*pi/180;
      d = [cos(d(1))*cos(d(2)); sin(d(1))*cos(d(2)); sin(d(2))];
   end
   d = d / norm(d);

end % function direction
