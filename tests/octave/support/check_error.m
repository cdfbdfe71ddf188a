function check_error( fun, part )
% CHECK_ERROR  Stop unless a call fails with a message that contains a text.

   check_count(1);
   try
      fun();
   catch problem
      if (isempty(strfind(problem.message, part)))
         error('FAILED: the message was "%s", without "%s"', problem.message, part);
      end
      return
   end
   error('FAILED: no error with "%s"', part);

end % function check_error
