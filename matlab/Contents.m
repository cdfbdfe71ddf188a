% Matlab and GNU Octave scripts for the results of CONTACT.
%
% Loading results.
%
%   loadcase        - load the surface results of one case.
%   diffcase        - difference of the results of two cases.
%   loadstrs        - load displacements and stresses below the surface.
%   diffstrs        - difference of stresses below the surface of two cases.
%   parse_out1      - read overall results of wheel-rail cases (module 1) from an .out file.
%   parse_out3      - read overall results of basic contact cases (module 3) from an .out file.
%
% Plotting results.
%
%   plot2d          - tractions along rows or columns of the contact area.
%   plot3d          - all kinds of results for the whole contact area, also on rails and wheels.
%   plotstrs        - displacements and stresses below the surface.
%   plot_2dspline   - the surface of a profile that varies along the rail or around the wheel.
%   plot_update     - two profiles and their difference, magnified.
%   plot_arrow      - an arrow in two or three dimensions.
%   plot_cm         - the symbol of a centre of mass.
%   circ_arrow      - an arrow along a circle.
%   plot_axes       - two coordinate axes with their names.
%   plot_axes3      - three coordinate axes in space.
%   cntc_boundbox   - bounding rectangle of the elements in contact.
%   matlab_color    - line colours by their numbers.
%
% Access to fields by names with dots, such as 'kincns.t_digit'.
%
%   mygetfield      - get a field.
%   mysetfield      - set a field.
%   myisfield       - does a struct have a field?
%
% Wheel and rail profiles.
%
%   read_profile    - read a profile in any of the formats.
%   read_slices     - read a profile that varies along the rail or around the wheel.
%   read_simpack    - read a Simpack file (prr, prw).
%   read_miniprof   - read a Miniprof file (ban, whl) or a table.
%   read_vampire    - read a Vampire file (rai, whe).
%   smooth_profile  - smooth a profile by a cubic spline.
%   make_spline     - cubic smoothing spline through the points of a curve.
%   eval_spline     - points on such a spline, at given positions or given y.
%   eval_spline_deriv - its derivatives and curvature.
%   make_2dspline   - surface of cubic splines, for profiles in slices.
%   eval_2dspline   - points on it, at given u and v or given u and y.
%   eval_2dspline_deriv - its first derivatives.
%   eval_bspline_basisfnc - B-splines at points.
%   make_ppform     - piecewise polynomials of a B-spline curve.
%   solve_cubic_eq  - position at which one piece of a spline has a given value.
%   make_reflec     - reflection angles of a surface.
%   make_arclength  - arc length at the points of a profile.
%   modify_profile  - mirror, scale and order the points of a profile.
%   resample_slices - corresponding points on the slices of a varying profile.
%   write_simpack   - write a Simpack file.
%   write_miniprof  - write a Miniprof file.
%
% The library: begin and end.
%
%   cntc_buildmex               - build the gateway between Octave and the library.
%   cntc_initlibrary            - load the library and begin a run.
%   cntc_managelicense          - no licence is needed; returns 0.
%   cntc_getmagicnumbers        - struct with the named numbers of flags, fields, and so on.
%   cntc_closelibrary           - release all result elements, close the files and unload the library.
%   cntc_initialize             - create a result element.
%   cntc_setglobalflags         - set flags of the library as a whole.
%   cntc_finalize               - release a result element; with the last one the run ends.
%
% The library: settings of both modules.
%
%   cntc_setmaterialproperties  - set elastic bodies; abbreviation of cntc_setmaterialparameters with M = 0.
%   cntc_setflags               - set flags and control digits.
%   cntc_setmetadata            - set data that are written to the .mat files.
%   cntc_setsolverflags         - set solution methods and their parameters by the G digit.
%   cntc_setmaterialparameters  - set the material by the M digit, or damping by 10 + the M2 digit.
%   cntc_settemperaturedata     - set thermal data by the H digit.
%   cntc_setwear                - set the parameters of wear and fatigue, and the flag CNTC_own_wear.
%   cntc_settimestep            - accept a time step, which has no effect: shifts have 1 s, rolling the step over the velocity.
%   cntc_setrollingstepsize     - set rolling direction and step.
%   cntc_setfrictionmethod      - set the friction law, imeth = 10 V + L.
%   cntc_setpotcontact          - set the grid.
%   cntc_settangentialforces    - prescribe tangential forces.
%   cntc_readinpfile            - take the settings of wheel and rail from the first case of an input file.
%
% The library: settings of basic contact.
%
%   cntc_setinterfaciallayer    - set a layer between the bodies, older name; elastic constants are kept.
%   cntc_setreferencevelocity   - set the rolling velocity (basic contact).
%   cntc_sethertzcontact        - set a Hertzian geometry and its grid (basic contact).
%   cntc_setpenetration         - prescribe the approach of the bodies (basic contact); sets N = 0.
%   cntc_setnormalforce         - prescribe the normal force (basic contact); sets N = 1.
%   cntc_setundeformeddistc     - set the undeformed distance (basic contact), after cntc_setpotcontact.
%   cntc_setcreepages           - set creepages, in shifts the shift (basic contact).
%   cntc_setextrarigidslip      - set the extra term of the rigid slip (basic contact).
%
% The library: settings of wheel and rail.
%
%   cntc_settrackdimensions_new - older name of cntc_settrackdimensions.
%   cntc_settrackdimensions_old - set the track by values in an older order.
%   cntc_setverticalforce       - prescribe the vertical force of wheel on rail; sets N = 1.
%   cntc_setprofileinputfname   - set the profile of wheel or rail by the name of a file.
%   cntc_setprofileinputvalues  - set the profile of wheel or rail by its points.
%   cntc_settrackdimensions     - set the track by the Z digit.
%   cntc_setwheelsetdimensions  - set the dimensions of the wheelset.
%   cntc_setwheelsetposition    - set the position of the wheelset.
%   cntc_setwheelsetvelocity    - set the velocity of the wheelset.
%   cntc_setwheelsetflexibility - set deviations of the wheel from the rigid wheelset.
%
% The library: calculation.
%
%   cntc_calculate              - solve a contact problem.
%
% The library: results.
%
%   cntc_getcpresults           - get all results of one contact patch in the form of loadcase, for plot2d and plot3d.
%   cntc_getflags               - get flags and control digits.
%   cntc_getparameters          - get parameters of kinematics, material or friction, or radii.
%   cntc_getprofilevalues       - get a profile as used by the library.
%   cntc_getwheelsetposition    - get the position of the wheelset.
%   cntc_getwheelsetvelocity    - get the velocity of the wheelset.
%   cntc_getnumcontactpatches   - get the number of contact patches of wheel and rail.
%   cntc_getcontactlocation     - get the position of a contact patch of wheel and rail.
%   cntc_getreferencevelocity   - get the rolling velocity.
%   cntc_gethertzcontact        - get the parameters of a Hertzian geometry (basic contact).
%   cntc_getnumelements         - get the size of the grid.
%   cntc_getgriddiscretization  - get the sizes of elements.
%   cntc_getpotcontact          - get the grid.
%   cntc_getpenetration         - get the approach of the bodies.
%   cntc_getcreepages           - get creepages, in shifts the shift.
%   cntc_getcontactforces       - get forces in the directions of the contact.
%   cntc_getglobalforces        - get forces and moments of wheel and rail; with icp = -1 the sum of all patches.
%   cntc_getcontactpatchareas   - get the areas of contact, adhesion and slip.
%   cntc_getelementdivision     - get the state of each element.
%   cntc_getmaximumpressure     - get the largest pressure.
%   cntc_getmaximumtraction     - get the largest tangential traction.
%   cntc_getmaximumtemperature  - get the largest surface temperatures in contact.
%   cntc_geterrors              - get the estimated errors of the totals of a patch, after a calculation with the flag CNTC_own_errors = 1.
%   cntc_getwear                - get totals of wear and fatigue of a patch, after a calculation with the flag CNTC_own_wear = 1.
%   cntc_getfielddata           - get one field for each element.
%   cntc_gettractions           - get the tractions of each element.
%   cntc_getmicroslip           - get the slip of each element.
%   cntc_getdisplacements       - get the displacement differences of each element.
%   cntc_getsensitivities       - get derivatives of forces with respect to approach and creepages.
%   cntc_getcalculationtime     - get the time of the calculations.
%   cntc_resetcalculationtime   - set the time of the calculations to zero.
%
% The library: stresses below the surface.
%
%   subs_addblock               - add a block of subsurface points.
%   subs_calculate              - compute subsurface displacements and stresses, after cntc_calculate.
%   subs_getblocksize           - get the numbers of points of a block.
%   subs_getresults             - get results below the surface.
