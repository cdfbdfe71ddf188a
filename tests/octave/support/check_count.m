function [ n ] = check_count( add )
% CHECK_COUNT  Number of checks so far; add counts more.

   persistent count;
   if (isempty(count))
      count = 0;
   end
   if (nargin>0)
      count = count + add;
   end
   n = count;

end % function check_count
