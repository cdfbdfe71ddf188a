function [ v ] = spline_values( spl, name, s, order )
% SPLINE_VALUES  Values of one coordinate of a spline of MAKE_SPLINE, or of its derivative.
%
%   name     'y' or 'z'
%   s        positions; beyond the ends the end points are used; NaN gives NaN
%   order    order of the derivative with respect to s: 0, 1 or 2

   n = numel(spl.s) - 1;
   a = zeros(n, 4);
   for k = 0 : 3
      a(:,k+1) = spl.(sprintf('a%d%s', k, name))(1:n);
   end
   inside = min(max(s(:), spl.s(1)), spl.s(end));
   i = lookup_piece(spl.s, inside);
   known = ~isnan(inside);
   d = inside(known) - spl.s(i(known));
   a = a(i(known),:);
   switch (order)
      case 0
         w = a(:,1) + d.*(a(:,2) + d.*(a(:,3) + d.*a(:,4)));
      case 1
         w = a(:,2) + d.*(2*a(:,3) + 3*d.*a(:,4));
      case 2
         w = 2*a(:,3) + 6*d.*a(:,4);
   end
   v = NaN(size(s));
   v(known) = w;

end % function spline_values

%------------------------------------------------------------------------------------------------------

function [ i ] = lookup_piece( s, x )
% Index of the piece that contains each x

   i = min(floor(interp1(s, (1:numel(s))', x)), numel(s)-1);

end % function lookup_piece
