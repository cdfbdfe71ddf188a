function [ ix, iy ] = select_elements( sol, opt )
% SELECT_ELEMENTS  Indices of the columns and rows that are shown, by ixrange and iyrange of PLOT3D.

   inside = (sol.eldiv>0);
   ix = one_range(opt.ixrange, any(inside,1), 'ixrange');
   iy = one_range(opt.iyrange, any(inside,2)', 'iyrange');

end % function select_elements

%------------------------------------------------------------------------------------------------------

function [ list ] = one_range( range, used, name )

   n = numel(used);
   if (isempty(range) || strcmp(range,'all'))
      list = 1 : n;
   elseif (any(strcmp(range,{'auto','tight'})))
      list = max(1,find(used,1)-1) : min(n,find(used,1,'last')+1);
      if (isempty(list))
         list = 1 : n;
      end
   elseif (isnumeric(range) && numel(range)>=2)
      list = max(1,range(1)) : min(n,range(end));
   else
      error('plot3d: option %s must be ''auto'', ''all'' or [first last].', name);
   end

end % function one_range
