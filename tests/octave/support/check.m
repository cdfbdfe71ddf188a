function check( condition, what )
% CHECK  Stop unless a condition holds.

   check_count(1);
   if (~condition)
      error('FAILED: %s', what);
   end

end % function check
