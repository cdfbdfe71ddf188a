function [ bbox ] = cntc_boundbox( sol, bbox )
% CNTC_BOUNDBOX  Bounding rectangle of the elements in contact.
%
%   bbox = cntc_boundbox( sol )
%   bbox = cntc_boundbox( sol, bbox )      enlarged to contain the given one
%
%   sol      struct of LOADCASE or cntc_getcpresults, or an array of them
%   bbox     [xmin xmax ymin ymax] [mm], for AXIS; [] without contact
%
% See also: loadcase, plot3d.

   if (nargin<2)
      bbox = [];
   end
   for i = 1 : numel(sol)
      [iy, ix] = find(sol(i).eldiv>=1);
      if (isempty(ix))
         continue
      end
      half = [sol(i).dx sol(i).dy] / 2;
      own  = [sol(i).x(min(ix))-half(1), sol(i).x(max(ix))+half(1), sol(i).y(min(iy))-half(2), sol(i).y(max(iy))+half(2)];
      if (isempty(bbox))
         bbox = own;
      end
      bbox = [min(bbox(1),own(1)), max(bbox(2),own(2)), min(bbox(3),own(3)), max(bbox(4),own(4))];
   end

end % function cntc_boundbox
