function [ s ] = add_bound( s )
% ADD_BOUND  Traction bound of a struct of LOADCASE: friction, or the yield limit of a layer; 0 out of contact.

   s.trcbnd = s.mu .* s.pn;
   if (has_plasticity(s.mater))
      s.trcbnd = min(s.trcbnd, s.taucrt);
   end
   s.trcbnd(s.pn==0) = 0;

end % function add_bound
