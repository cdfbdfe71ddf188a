function [ val ] = shown_values( f, sol, opt )
% SHOWN_VALUES  Values of a field with exterior elements according to the option exterval of PLOT3D.

   val = f.val;
   if (~isempty(opt.exterval))
      val(sol.eldiv==0) = opt.exterval;
   end

end % function shown_values
