function [ range ] = shown_range( sol, given, corner_index, margin )
% SHOWN_RANGE  The given range, or that of the elements in contact of all patches with a margin on both sides.
%
%   corner_index   1: x of the body, from meta and grid; 2: lateral

   if (~isempty(given))
      range = given;
      return
   end
   range = [Inf -Inf];
   for i = 1 : numel(sol)
      [ix, iy] = select_elements(sol(i), struct('ixrange','auto','iyrange','auto'));
      [xc, yc] = corners(sol(i), ix, iy);
      both  = {xc, yc};
      c     = both{corner_index};
      range = [min(range(1),c(1)), max(range(2),c(end))];
   end
   range = range + margin*[-1 1]*max(1, diff(range));

end % function shown_range
