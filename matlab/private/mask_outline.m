function [ x, y ] = mask_outline( mask, xc, yc )
% MASK_OUTLINE  Lines around the elements of a (my,mx) mask, along the edges of the elements.
%
%   xc, yc   corners of the elements, mx+1 and my+1 numbers
%   x, y     rows of coordinates, with NaN between pieces

   x = [];
   y = [];
   [my, mx] = size(mask);
   % edges normal to x, then edges normal to y: between elements that differ
   d = diff([false(my,1), mask, false(my,1)], 1, 2) ~= 0;
   [iy, ix] = find(d);
   if (~isempty(ix))
      xe = xc(ix(:)');
      x = [x, reshape([xe; xe; NaN(size(xe))], 1, [])];
      y = [y, reshape([yc(iy(:)'); yc(iy(:)'+1); NaN(size(xe))], 1, [])];
   end
   d = diff([false(1,mx); mask; false(1,mx)], 1, 1) ~= 0;
   [iy, ix] = find(d);
   if (~isempty(ix))
      ye = yc(iy(:)');
      x = [x, reshape([xc(ix(:)'); xc(ix(:)'+1); NaN(size(ye))], 1, [])];
      y = [y, reshape([ye; ye; NaN(size(ye))], 1, [])];
   end

end % function mask_outline
