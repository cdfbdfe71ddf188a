function check_near( value, expected, tol, what )
% CHECK_NEAR  Stop unless arrays have the same shape and all values are within an absolute tolerance; NaN equals NaN.

   check_count(1);
   if (~isequal(size(value), size(expected)))
      error('FAILED: %s: %s instead of %s values', what, mat2str(size(value)), mat2str(size(expected)));
   end
   if (~isequal(isnan(value), isnan(expected)))
      error('FAILED: %s: other values are NaN', what);
   end
   difference = max(abs(value(:) - expected(:)));
   if (difference > tol)
      error('FAILED: %s: difference %g, allowed %g; first value %g instead of %g', what, difference, tol, ...
            value(1), expected(1));
   end

end % function check_near
