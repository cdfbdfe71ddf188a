function [ s ] = make_arclength( y, z )
% MAKE_ARCLENGTH  Arc length at the points of a profile: sums of chords, zero where y is zero.
%
%   s = make_arclength( y, z )
%
%   y, z     coordinates of the points
%   s        column of arc lengths; they start at zero if y has no zero, or several
%
% See also: make_spline, eval_spline.

   y = y(:);
   s = chord_sums(y, z);
   i = find(y(1:end-1)<=0 & y(2:end)>0 | y(1:end-1)>=0 & y(2:end)<0);
   if (numel(i)==1)
      s = s - interp1(y([i i+1]), s([i i+1]), 0);
   end

end % function make_arclength
