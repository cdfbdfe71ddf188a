function [ fric ] = add_static( fric )
% ADD_STATIC  Static and kinetic coefficients of friction for laws that do not have them as parameters, as in established scripts.

   if (isfield(fric, 'fref'))
      fric.fstat = fric.fref;
      fric.fkin  = fric.fref + fric.dfheat;
      return
   end
   for law = {'flin','frat','fexp'}
      first = [law{1} '1'];
      if (all(isfield(fric, {'fkin', first, [law{1} '2']})))
         fric.fstat = fric.fkin + fric.(first) + fric.([law{1} '2']);
      end
   end

end % function add_static
