function require_file( fname, caller, expnam, icase )
% REQUIRE_FILE  Stop if RESULT_FILE has not found a file.

   if (isempty(fname))
      error(['%s: there are no results of case %d of "%s"; .mat files need A>=1 in the input, .subs files S>=1, ' ...
             'an .h5 file the option --hdf5.'], caller, icase, expnam);
   end

end % function require_file
