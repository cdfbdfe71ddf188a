function [ spl2d ] = make_2dspline( ui, vj, varargin )
% MAKE_2DSPLINE  Surface of cubic splines through points on a grid of two parameters, such as a profile in slices.
%
%   spl2d = make_2dspline( ui, vj, xij, yij, zij, mask_j, use_approx )
%   spl2d = make_2dspline( ui, vj, yij, zij, mask_j, use_approx )
%
%   ui, vj   increasing parameters: positions of the slices, and of the points along them; at least 4 of each
%   xij, yij, zij   coordinates, numel(ui) x numel(vj) arrays; without xij, or with [], x is ui
%   mask_j   numel(ui) x numel(vj) array, 0 where a slice has no point, for example beyond its end. NaN in a coordinate
%            has the same meaning. The surface exists where its four surrounding points exist; elsewhere values are
%            NaN
%   use_approx   1 (default): along u the points are the control points, as for slices with U_METHOD 2; 0: the surface goes
%            through the points
%
% Along v, and along u with use_approx = 0, splines interpolate the points, with "not a knot" conditions at the second and the
% last but one point. Three points give a parabola, two a line.
%
%   spl2d    struct with ui, vj, knots tui, tvj, coefficients cij_y, cij_z and, if x is given, cij_x; mask_j: 0 for
%            missing coefficients
%
% See also: eval_2dspline, eval_2dspline_deriv, read_slices.

   ui = ui(:);
   vj = vj(:);
   shape = [numel(ui) numel(vj)];
   args  = varargin;
   % the form without xij has its mask, or nothing, in the position of zij
   if (numel(args)<3 || ~isequal(size(args{3}), shape) || (numel(args)<5 && all(args{3}(:)==0 | args{3}(:)==1)))
      args = [{[]}, args];
   end
   args(end+1:5) = {[]};
   [x, y, z, mask, use_approx] = args{1:5};
   if (isempty(use_approx))
      use_approx = 1;
   end
   if (any(shape<4) || any(diff(ui)<=0) || any(diff(vj)<=0))
      error('make_2dspline: ui and vj must increase and have at least 4 values.');
   end
   if (~isequal(size(y), shape) || ~isequal(size(z), shape) || (~isempty(x) && ~isequal(size(x), shape)))
      error('make_2dspline: arrays of %d x %d coordinates are needed.', shape);
   end
   names  = {'cij_x','cij_y','cij_z'};
   points = {x, y, z};
   there  = true(shape);
   if (~isempty(mask))
      there = (reshape(mask, shape)~=0);
   end
   for i = find(~cellfun(@isempty, points))
      there = there & ~isnan(points{i});
   end
   spl2d = struct('ui',ui, 'vj',vj, 'tui',knots(ui), 'tvj',knots(vj), 'mask_j',zeros(shape+2));
   for i = find(~cellfun(@isempty, points))
      % curves along the slices, then their coefficients along u
      [c, known] = curves(spl2d.tvj, vj, points{i}', there', @curve_through);
      method = @curve_through;
      if (use_approx)
         method = @control_points;
      end
      [c, known] = curves(spl2d.tui, ui, c', known', method);
      spl2d.(names{i}) = c;
      spl2d.mask_j = double(known);
   end

end % function make_2dspline

%------------------------------------------------------------------------------------------------------

function [ t ] = knots( x )
% All points, and three more on each side

   t = [x(1)-(3:-1:1)'*(x(2)-x(1)); x; x(end)+(1:3)'*(x(end)-x(end-1))];

end % function knots

%------------------------------------------------------------------------------------------------------

function [ c, known ] = curves( t, x, values, there, method )
% Coefficients of the splines of all columns, in which points may be missing

   c = zeros(size(values) + [2 0]);
   known = false(size(c));
   % columns in which the same points are missing are solved together
   [masks, ~, which] = unique(there', 'rows');
   for i = 1 : size(masks,1)
      j = find(which==i);
      % sequences of consecutive points; points without a neighbour do not belong to a surface
      step  = diff([0; masks(i,:)'; 0]);
      first = find(step==1);
      last  = find(step==-1) - 1;
      for r = find(last>first)'
         k = (first(r):last(r))';
         rows = [k; k(end)+1; k(end)+2];
         if (any(known(rows,j(1))))
            error('make_2dspline: point %d is missing alone between others, along u or v.', k(1)-1);
         end
         c(rows,j) = method(t, x, k, values(k,j));
         known(rows,j) = true;
      end
   end

end % function curves

%------------------------------------------------------------------------------------------------------

function [ c ] = curve_through( t, x, k, values )
% Coefficients of the splines through values at the points x(k), one column each

   n  = numel(k);
   at = (k(1):k(end)+2)';
   b  = bspline_basis(t, x(k), 0);
   % unknowns: second derivative at the first point, third derivatives of all pieces
   [~, b2] = eval_bspline_basisfnc(t, x(k(1)), 2);
   second = b2 * bspline_derivative(t, 3) * bspline_derivative(t, 4);
   b1 = eval_bspline_basisfnc(t, (x(k(1:end-1)) + x(k(2:end)))/2, 1);
   third = b1 * bspline_derivative(t, 2) * bspline_derivative(t, 3) * bspline_derivative(t, 4);
   if (n==2)
      ends = [second; third];
   elseif (n==3)
      ends = third;
   else
      ends = [third(2,:)-third(1,:); third(n-1,:)-third(n-2,:)];
   end
   ends = full(ends(:,at));
   ends = bsxfun(@rdivide, ends, max(abs(ends), [], 2));
   c = [full(b(:,at)); ends] \ [values; zeros(2,size(values,2))];

end % function curve_through

%------------------------------------------------------------------------------------------------------

function [ c ] = control_points( t, x, k, values )
% The values, and one linearly extrapolated value on each side

   d = diff(t);
   i = 3 + [k(1); k(end)];
   c = [values(1,:) - d(i(1)-1)/d(i(1))*(values(2,:)-values(1,:)); values
        values(end,:) + d(i(2))/d(i(2)-1)*(values(end,:)-values(end-1,:))];

end % function control_points
