function [ spl2d ] = surface_spline( spl2d, caller )
% SURFACE_SPLINE  The spline of a surface: a struct of MAKE_2DSPLINE unchanged, or computed from a struct of READ_SLICES.

   if (isstruct(spl2d) && isfield(spl2d, 'tui'))
      return
   end
   if (~isstruct(spl2d) || ~isfield(spl2d, 'nslc'))
      error('%s: a struct of make_2dspline or read_slices is needed.', caller);
   end
   slcs  = resample_slices(spl2d);
   spl2d = make_2dspline(slcs.u, linspace(0, 1, size(slcs.vy,2)), [], slcs.vy, slcs.vz, [], double(slcs.u_method==2));

end % function surface_spline
