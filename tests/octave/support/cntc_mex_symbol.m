function [ found ] = cntc_mex_symbol( name )
% CNTC_MEX_SYMBOL  The routine's name if the library exports it, else ''.

   persistent exported;
   if (isempty(exported))
      [~, exported] = system(sprintf('nm -D --defined-only "%s"', getenv('CONTACT_LIBRARY')));
   end
   found = regexp(exported, ['\s(' name ')\n'], 'match', 'once');

end % function cntc_mex_symbol
