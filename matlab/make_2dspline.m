function [ spl2d ] = make_2dspline( ui, vj, varargin )
% MAKE_2DSPLINE  Surface of cubic splines through points on a grid of two parameters, such as a profile in slices.
%
%   spl2d = make_2dspline( ui, vj, xij, yij, zij, mask_j, use_approx )
%   spl2d = make_2dspline( ui, vj, yij, zij, mask_j, use_approx )
%
%   ui, vj   rising parameters: positions of the slices, and of the points along them; at least 4 of each
%   xij, yij, zij   coordinates, numel(ui) x numel(vj) arrays; without xij, or with [], x is ui
%   mask_j   [] or ones: surfaces that lack points are not built
%   use_approx   1 (default): along u the points are the control points, as for slices with U_METHOD 2; 0: the surface goes
%            through the points
%
% Along v, and along u with use_approx = 0, splines go through the points without knots at the second and the last but one.
%
%   spl2d    struct with ui, vj, knots tui, tvj, coefficients cij_y, cij_z and, where x is given, cij_x; mask_j
%
% See also: eval_2dspline, eval_2dspline_deriv, read_slices.

   ui = ui(:);
   vj = vj(:);
   shape = [numel(ui) numel(vj)];
   args  = varargin;
   % the form without xij has its mask, or nothing, in the place of zij
   if (numel(args)<3 || ~isequal(size(args{3}), shape) || (numel(args)<5 && all(args{3}(:)==0 | args{3}(:)==1)))
      args = [{[]}, args];
   end
   args(end+1:5) = {[]};
   [x, y, z, mask, use_approx] = args{1:5};
   if (isempty(use_approx))
      use_approx = 1;
   end
   if (any(shape<4) || any(diff(ui)<=0) || any(diff(vj)<=0))
      error('make_2dspline: ui and vj must rise and have 4 values at least.');
   end
   if (~isequal(size(y), shape) || ~isequal(size(z), shape) || (~isempty(x) && ~isequal(size(x), shape)))
      error('make_2dspline: arrays of %d x %d coordinates are needed.', shape);
   end
   if (any(isnan(y(:))) || any(isnan(z(:))) || any(mask(:)==0))
      error('make_2dspline: surfaces that lack points are not built.');
   end
   spl2d = struct('ui',ui, 'vj',vj, 'tui',knots(ui), 'tvj',knots(vj));
   if (use_approx)
      steps = [ui(2)-ui(1), ui(end)-ui(end-1)];
      spl2d.tui = [ui(1)-(3:-1:1)'*steps(1); ui; ui(end)+(1:3)'*steps(2)];
   end
   for name = 'xyz'
      data = eval(name);
      if (isempty(data))
         continue
      end
      c = (bspline_basis(spl2d.tvj, vj, 0) \ data')';
      if (use_approx)
         c = [2*c(1,:)-c(2,:); c; 2*c(end,:)-c(end-1,:)];
      else
         c = bspline_basis(spl2d.tui, ui, 0) \ c;
      end
      spl2d.(['cij_' name]) = c;
   end
   spl2d.mask_j = ones(size(spl2d.cij_y));

end % function make_2dspline

%------------------------------------------------------------------------------------------------------

function [ t ] = knots( x )
% Knots of the interpolating spline, all but the second and the last but one of its points

   t = [x([1 1 1 1]); x(3:end-2); x([end end end end])];

end % function knots
