function [ dif ] = diffcase( sol1, sol2 )
% DIFFCASE  Difference sol1 - sol2 of the surface results of two cases on the same grid.
%
%   dif = diffcase( sol1, sol2 )
%
%   sol1, sol2   structs of LOADCASE for one patch each
%   dif          struct of the same kind with the differences of all common fields. The element division is that of
%                sol1, outside its contact area that of sol2; positions and parameters are those of sol1.
%
% Derived fields of plot3d, such as ptabs, then show the magnitude of the difference.
%
% See also: loadcase, diffstrs.

   if (numel(sol1)~=1 || numel(sol2)~=1)
      error('diffcase: each argument must be one contact patch; they have %d and %d.', numel(sol1), numel(sol2));
   end
   if (sol1.mx~=sol2.mx || sol1.my~=sol2.my)
      error('diffcase: the grids have different sizes, %d x %d and %d x %d.', sol1.mx, sol1.my, sol2.mx, sol2.my);
   end
   tolerance = 1e-3 * min(sol1.dx, sol1.dy);
   if (max(abs([sol1.xl-sol2.xl, sol1.yl-sol2.yl, sol1.mx*(sol1.dx-sol2.dx), sol1.my*(sol1.dy-sol2.dy)]))>tolerance)
      warning('diffcase: the grids have different positions or element sizes; elements with the same row and column are compared.');
   end

   dif = sol1;
   fields = {'h','mu','pn','px','py','un','ux','uy','srel','shft','taucrt','uplsx','uplsy','temp1','temp2','trcbnd'};
   for i = 1 : numel(fields)
      f = fields{i};
      if (isfield(sol1,f) && isfield(sol2,f))
         dif.(f) = sol1.(f) - sol2.(f);
      elseif (isfield(dif,f))
         dif = rmfield(dif, f);
      end
   end
   outside = (sol1.eldiv==0);
   dif.eldiv(outside) = sol2.eldiv(outside);

end % function diffcase
