function [ index ] = nearest( list, values )
% NEAREST  Indices of the list entries closest to the values, without repetition.

   index = zeros(1, numel(values));
   for i = 1 : numel(values)
      [~, index(i)] = min(abs(list(:) - values(i)));
   end
   index = unique(index);

end % function nearest
