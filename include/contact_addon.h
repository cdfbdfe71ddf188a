/* CONTACT: rolling and sliding contact with friction - routines of the library for C and C++.
 * Made by src/capi/make_interface.py from src/capi/interface.txt; change those.
 *
 * Each argument is passed by its address, single numbers included. Arrays are preceded by their
 * length; texts need no terminating null. No address is kept after a call.
 * Units: L length, F force, V velocity, A angle [rad], T time [s]; flag CNTC_if_units selects mm or
 * m. The named numbers are in caddon_flags.h; the library is described in doc/user/library.md. */
#ifndef CONTACT_ADDON_H
#define CONTACT_ADDON_H

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Begin and end ---- */

/* Numbers of Fortran units for the library. Recorded but not used, because the library takes
 * free units. */
void cntc_setfileunits(const int *nunits, const int *iunits);

/* Start a run, once for all result elements. A blank text or length 0 leaves the default.
 *   ifcver: version of the interface
 *   ierror: 0, or a negative code
 *   ioutput: 1 sends the log to the standard output as well
 *   c_wrkdir: folder of input files; default: the current one
 *   c_outdir: folder of results; default: the current one
 *   c_expnam: name of the .out file; default: contact_addon */
void cntc_initializefirst(int *ifcver, int *ierror, const int *ioutput, const char *c_wrkdir,
                          const char *c_outdir, const char *c_expnam, const int *len_wrkdir,
                          const int *len_outdir, const int *len_expnam);

/* Same as cntc_initializefirst, for callers of releases with both names. */
void cntc_initializefirst_new(int *ifcver, int *ierror, const int *ioutput, const char *c_wrkdir,
                              const char *c_outdir, const char *c_expnam, const int *len_wrkdir,
                              const int *len_outdir, const int *len_expnam);

/* Create a result element.
 *   ire: number of the result element, 1 to 999
 *   imodul: 1: wheel and rail; 3: basic contact
 *   c_outdir: folder of results, if the run has not been started yet; default: the current one
 *   ifcver: version of the interface
 *   ierror: 0, or a negative code CNTC_err_* */
void cntc_initialize(const int *ire, const int *imodul, int *ifcver, int *ierror,
                     const char *c_outdir, const int *len_outdir);

/* Set flags of the library as a whole.
 *   params: codes CNTC_if_idebug, CNTC_if_openmp; 0 is skipped
 *   values: one value for each */
void cntc_setglobalflags(const int *lenflg, const int *params, const int *values);

/* Largest number of calculations that may run at the same time. */
void cntc_getmaxnumthreads(int *mxthrd);

/* Release a result element; with the last one the run ends.
 *   ire: number of the result element */
void cntc_finalize(const int *ire);

/* Release all result elements and close the files. */
void cntc_finalizelast(void);

/* ---- Settings of both modules; icp is -1 for wheel and rail, 1 to 9 in basic contact ---- */

/* Set flags and control digits.
 *   params: codes CNTC_if_*, CNTC_ic_* and CNTC_own_*; 0 is skipped
 *   values: one value for each */
void cntc_setflags(const int *ire, const int *icp, const int *lenflg, const int *params,
                   const int *values);

/* Set data that are written to the .mat files.
 *   params: codes CNTC_mt_*; 0 is skipped
 *   values: one value for each: time [s], positions [L], numbers */
void cntc_setmetadata(const int *ire, const int *icp, const int *lenmta, const int *params,
                      const double *values);

/* Set solution methods and their parameters by the G digit.
 *   gdigit    iparam; rparam
 *   0         maxgs, maxin, maxnr, maxout; eps                                    default solvers
 *   1         none                                                                keep all
 *   2, 3      maxgs, maxin, maxnr, maxout, inislp; eps, omegah, omegas, omgslp    ConvexGS, SteadyGS
 *   4         maxgs, maxin, maxnr, maxout, inislp; eps, omgslp                    friction that changes with slip
 *   5         maxgs, maxin, maxnr, maxout, kdowfb;
 *             eps, fdecay, betath, d_ifc, d_lin, d_cns, d_slp, pow_s              GDsteady
 *   6         mxsens; epsens                                                      sensitivities */
void cntc_setsolverflags(const int *ire, const int *icp, const int *gdigit, const int *nints,
                         const int *iparam, const int *nreals, const double *rparam);

/* Set the material by the M digit, or damping by 10 + the M2 digit.
 *   imeth     rparam; up to 7 it begins with nu1, nu2 [-], G1, G2 [F/L2], shown as ..
 *   0         ..                                          elastic
 *   1         .., fg1, fg2 [-], tc1, tc2 [T]              viscoelastic
 *   2         .., flx [L3/F], k0_mf, alfamf, betamf [-]   Fastsim, one flexibility
 *   3, 5      .., k0_mf, alfamf, betamf [-]               Fastsim with three flexibilities, modified FaStrip
 *   4         .., gg3 [F/L2], laythk [L], tau_c0 [F/L2], k_tau [F/L3]   layer that may yield
 *   6, 7      ..                                          FaStrip as published; with the correction of full sliding
 *   10, 11    none                                        no damping, damping as before
 *   12        cdampn, cdampt [T], dfnmax, dftmax [F/T]    damping
 *   With flag CNTC_ic_bound = 1, set before, 0 to 7 take one value more, the last: the flexibility of a
 *   thin sheet [L3/F]. The limit maxout of outer iterations becomes 10 in place of 1 for unlike bodies;
 *   cntc_setsolverflags, called later, replaces it. Like bodies have one outer iteration. */
void cntc_setmaterialparameters(const int *ire, const int *icp, const int *imeth, const int *nparam,
                                const double *rparam);

/* Set thermal data by the H digit.
 *   imeth: 0: no temperatures; 1: data as before; 3: new data
 *   params: for imeth = 3: of body 1, then of body 2: temperature [degC], heat capacity [J/(kg
 *       degC)], conductivity [W/(L degC)], density [kg/L3]; last, the fraction of plastic work
 *       that becomes heat [-] */
void cntc_settemperaturedata(const int *ire, const int *icp, const int *imeth, const int *nparam,
                             const double *params);

/* Set the parameters of wear and fatigue, and the flag CNTC_own_wear.
 *   params: Archard's wear coefficient [-], hardness of the softer body [F/L2], required with
 *       it, and yield stress in cyclic shear [F/L2]; 0: not given */
void cntc_setwear(const int *ire, const int *icp, const int *nparam, const double *params);

/* Accept a time step, which has no effect: shifts have 1 s, rolling the step over the velocity.
 *   dt: time step [T] */
void cntc_settimestep(const int *ire, const int *icp, const double *dt);

/* Set rolling direction and step.
 *   chi: rolling direction [A], basic contact
 *   dq: rolling step: in basic contact [L], default 2 mm; for wheel and rail relative to the
 *       element size [-]. Calculations leave it, cntc_getparameters returns the step that was
 *       used */
void cntc_setrollingstepsize(const int *ire, const int *icp, const double *chi, const double *dq);

/* Set the friction law, imeth = 10 V + L.
 *   L         params
 *   0         fstat, fkin [-]                                        Coulomb; both become the smaller one
 *   1         none                                                   as before
 *   2, 3, 4   fkin, coef1 [-], sabsh1 [V], coef2 [-], sabsh2 [V], memdst [L], mem_s0 [V]
 *                                                                    falls with slip: linear, rational, exponential
 *   5         fstat [-], polach_a [-], polach_b [1/V]                exponential, after Polach
 *   6         fref [-], tref [degC], dfheat [-], dtheat [degC], memdst [L], mem_s0 [V]      falls with temperature
 *   For V = 1 and 2 (wheel and rail) params are n, then n times an angle [A] or a position [L] with the values above. */
void cntc_setfrictionmethod(const int *ire, const int *icp, const int *imeth, const int *nparam,
                            const double *params);

/* Set the grid.
 *   ipotcn    params
 *   wheel and rail:
 *   0         dx, ds [L], unused
 *   -1        dx, ds [L], a_sep [A], d_sep, d_comb [L], optional d_turn [L], g_miss [L]
 *   basic contact:
 *   1         mx, my, xl, yl, dx, dy [L]             lower left corner, sizes of elements
 *   2         mx, my, xl, yl, xh, yh [L]             lower left and upper right corner
 *   3         mx, my, xc1, yc1, dx, dy [L]           centre of the first element, sizes
 *   4         mx, my, xc1, yc1, xcm, ycm [L]         centres of the first and last element */
void cntc_setpotcontact(const int *ire, const int *icp, const int *ipotcn, const int *nparam,
                        const double *params);

/* Prescribe tangential forces.
 *   fx, fy: basic contact: relative to fstat * fn [-]; wheel and rail (icp = -1): longitudinal
 *       force on the rail fx [F], fy unused */
void cntc_settangentialforces(const int *ire, const int *icp, const double *fx, const double *fy);

/* Take the settings of wheel and rail from the first case of an input file.
 *   inp_type: CNTC_inp_modul1; or CNTC_inp_spck: MODULE = 0 or 11, Z and E = 0 or 3; C1, P, N,
 *       F, H, S and I keep their values
 *   c_fname: name of the file; with CNTC_inp_modul1 .inp or .toml, the readable format
 *   ierror: 0, or a negative code CNTC_err_* */
void cntc_readinpfile(const int *ire, const int *inp_type, const char *c_fname,
                      const int *len_fname, int *ierror);

/* ---- Settings of basic contact ---- */

/* Set the rolling velocity (basic contact).
 *   veloc: velocity [V]; its absolute value is used, at least 1e-9 mm/s */
void cntc_setreferencevelocity(const int *ire, const int *icp, const double *veloc);

/* Set a Hertzian geometry and its grid (basic contact).
 *   ipotcn    params
 *   -1        mx, my, a1, b1 [1/L], scale [-]        distance a1 x^2 + b1 y^2: half the sum of the bodies' curvatures
 *   -2        mx, my, a1 [1/L], aob [-], scale       the same along x, and ratio of the axes
 *   -3        mx, my, aa, bb [L], scale              half-axes
 *   -4        mx, my, a1 [1/L], bb [L], scale        rectangle: the same along x, half-width
 *   -5        mx, my, aa, bb [L], scale              rectangle: half-lengths
 *   -6        mx, my, aa, bneg, bpos [L], scale      two halves of ellipses (set B = 4 yourself) */
void cntc_sethertzcontact(const int *ire, const int *icp, const int *ipotcn, const int *nparam,
                          const double *params);

/* Prescribe the approach of the bodies (basic contact); sets N = 0.
 *   pen: approach [L] */
void cntc_setpenetration(const int *ire, const int *icp, const double *pen);

/* Prescribe the normal force (basic contact); sets N = 1.
 *   fn: normal force [F] */
void cntc_setnormalforce(const int *ire, const int *icp, const double *fn);

/* Set the undeformed distance (basic contact), after cntc_setpotcontact.
 *   ibase     prmudf
 *   1         b1 ... b6 of b1 x2 + b2 xy + b3 y2 + b4 x + b5 y + b6
 *   2         nn, xm, rm, y1, dy1, then nn heights [L]   circular along x with a profile across
 *   3         b1 ... b8 of b1 sin(b2(x-b3)) - b4 sin(b5(x-b6)) + x2/b7 + y2/b8
 *   9         distance of each element [L], along x first; refused for a grid of other numbers of columns and rows that is
 *             set later, and kept for one at another place */
void cntc_setundeformeddistc(const int *ire, const int *icp, const int *ibase, const int *nparam,
                             const double *prmudf);

/* Set creepages, in shifts the shift (basic contact).
 *   vx, vy: longitudinal and lateral creepage [-], in shifts (T = 1) distances [L]
 *   phi: spin [A/L], in shifts rotation [A] */
void cntc_setcreepages(const int *ire, const int *icp, const double *vx, const double *vy,
                       const double *phi);

/* Set the extra term of the rigid slip (basic contact).
 *   wx, wy: values for each element [-], in shifts [mm] */
void cntc_setextrarigidslip(const int *ire, const int *icp, const int *lenarr, const double *wx,
                            const double *wy);

/* ---- Settings of wheel and rail ---- */

/* Prescribe the vertical force of wheel on rail; sets N = 1.
 *   fz: vertical force [F] */
void cntc_setverticalforce(const int *ire, const double *fz);

/* Set the profile of wheel or rail by the name of a file.
 *   c_fname: name of the file, relative to the folder of input files
 *   iparam: itype, unused, mirrory, mirrorz, errhndl, ismooth; itype: 0 rail, 1 wheel, -1 by the
 *       extension; mirrory: 1 mirrors y, 0 and -1 leave it as the file says; others as in input
 *       files
 *   rparam: factor to mm (-1 by the units), smoothing [-] or [mm], maxomit [-], zigthrs,
 *       kinkhigh, kinklow [rad], kinkwid [L] */
void cntc_setprofileinputfname(const int *ire, const char *c_fname, const int *len_fname,
                               const int *nints, const int *iparam, const int *nreals,
                               const double *rparam);

/* Set the profile of wheel or rail by its points.
 *   npoint: number of points
 *   values: y1, z1, y2, z2, ...
 *   iparam, rparam: as in cntc_setprofileinputfname */
void cntc_setprofileinputvalues(const int *ire, const int *npoint, const double *values,
                                const int *nints, const int *iparam, const int *nreals,
                                const double *rparam);

/* Set the track by the Z digit.
 *   ztrack    params
 *   0         none                                              as before
 *   1         gaught [L]; then, for gaught > 0, gaugsq [-], gaugwd [L], else raily0, railz0 [L];
 *             cant [A], nomradr [L], optional curv [1/L]
 *   2         dyrail, dzrail [L], drollr [A], vyrail, vzrail [V], vrollr [A/T]
 *   3         those of 1 and 2
 *   32, 33    kyrail [F/L], fyrail [F], kzrail [F/L], fzrail [F], optional dystep0 [L] */
void cntc_settrackdimensions(const int *ire, const int *ztrack, const int *nparam,
                             const double *params);

/* Set the dimensions of the wheelset.
 *   ewheel: 3, 5: new dimensions; 0, 1, 2, 4: as before
 *   params: fbdist, fbpos, nomradw, optional ytape [L] */
void cntc_setwheelsetdimensions(const int *ire, const int *ewheel, const int *nparam,
                                const double *params);

/* Set the position of the wheelset.
 *   ewheel: 1 to 5
 *   params: s, y, z [L], roll, yaw, pitch [A] */
void cntc_setwheelsetposition(const int *ire, const int *ewheel, const int *nparam,
                              const double *params);

/* Set the velocity of the wheelset.
 *   ewheel: 2 to 5
 *   params: vs, vy, vz [V], vroll, vyaw, vpitch [A/T]; on rollers the first value is the
 *       roller's rate [A/T] */
void cntc_setwheelsetvelocity(const int *ire, const int *ewheel, const int *nparam,
                              const double *params);

/* Set deviations of the wheel from the rigid wheelset.
 *   ewheel: 4, 5: new deviations; others: none
 *   params: dx, dy, dz [L], droll, dyaw, dpitch [A], vx, vy, vz [V], vroll, vyaw, vpitch [A/T] */
void cntc_setwheelsetflexibility(const int *ire, const int *ewheel, const int *nparam,
                                 const double *params);

/* ---- Calculation ---- */

/* Solve a contact problem.
 *   ierror: 0; negative: an error, CNTC_err_*; positive: elements in contact at the border of
 *       the grid (basic contact) */
void cntc_calculate(const int *ire, const int *icp, int *ierror);

/* ---- Results ---- */

/* Get flags and control digits.
 *   params: codes CNTC_if_*, CNTC_ic_* and CNTC_own_*
 *   values: one value for each */
void cntc_getflags(const int *ire, const int *icp, const int *lenflg, const int *params,
                   int *values);

/* Get parameters of kinematics, material or friction, or radii.
 *   itask     values
 *   1         veloc [V], chi [A], dq [L], spinxo, spinyo [L], tau_c0 [F/L2]
 *             of wheel and rail spinxo, spinyo: contact reference in the coordinates of the elements, in steps (T = 1, 2)
 *   2         gg1, gg2, gg [F/L2], poiss1, poiss2, poiss, ak [-], flx1, flx2, flx3 [L3/F], k0_mf, alfamf, betamf,
 *             k_eff [-], gg3 [F/L2], laythk [L], tau_c0 [F/L2], k_tau [F/L3], cdampn, cdampt [T], dfnmax, dftmax [F/T]
 *   3         lmeth, nvf, memdst [mm], mem_s0 [mm/s], nvf times alpha [rad] or [mm], fstat, fkin [-]
 *   4         nominal radii of wheel and roller [L], 0 without them (not in the published library) */
void cntc_getparameters(const int *ire, const int *icp, const int *itask, const int *lenarr,
                        double *values);

/* Get a profile as used by the library.
 *   itask     val
 *   -1        state: 0 or CNTC_err_profil, and its detail
 *   0         number of points
 *   1, 2      y of all points, then z of all points: 1 in profile, 2 in track coordinates [mm]
 *   3         for rails y, z of the innermost point within the gauge height, offsets y, z of the profile,
 *             y, z of the point at the gauge height [L]
 *   4, 5      arc length [mm], inclination [A] of the points
 *   6, 7, 8   x, then y, then z along a line with constant u, v or y on a varying profile [mm]
 *   9         writes the surface of a varying profile to dump_spl2d.m
 *   iparam: itype: 0 rail, 1 wheel; isampl: -1 points of the input, 0 of the spline, 1 equal
 *       distances, n > 1 n steps between points of the spline
 *   rparam: distance of points [mm], and for varying profiles: position [mm] or [rad], first and
 *       last place on the line */
void cntc_getprofilevalues(const int *ire, const int *itask, const int *nints, const int *iparam,
                           const int *nreals, const double *rparam, const int *lenarr, double *val);

/* Same as cntc_getprofilevalues, for callers of releases with both names. */
void cntc_getprofilevalues_new(const int *ire, const int *itask, const int *nints,
                               const int *iparam, const int *nreals, const double *rparam,
                               const int *lenarr, double *val);

/* Get the position of the wheelset.
 *   rvalues: s, y, z [L], roll, yaw, pitch [A]; z is computed if the vertical force is
 *       prescribed */
void cntc_getwheelsetposition(const int *ire, const int *lenarr, double *rvalues);

/* Get the velocity of the wheelset.
 *   rvalues: vs, vy, vz [V], vroll, vyaw, vpitch [A/T] */
void cntc_getwheelsetvelocity(const int *ire, const int *lenarr, double *rvalues);

/* Get the number of contact patches of wheel and rail.
 *   npatch: number of patches */
void cntc_getnumcontactpatches(const int *ire, int *npatch);

/* Get the position of a contact patch of wheel and rail.
 *   rvalues
 *   1-4       contact reference x, y, z [L] and its angle [A] in track coordinates
 *   5-9       x, y, z, s [L], angle [A] in rail coordinates; 10-14 the same in wheel coordinates
 *   15, 16    centre of pressure x, y in track coordinates [L]
 *   18, 19    deflections of the rail dy, dz [L]; dy of a left rail is that of its mirror image
 *   21-25     wheel marker x, y, z [L], roll, yaw [A]; 26-28 rail marker y, z [L], roll [A]; track coordinates
 *   30-33     contact reference x, y, z [L], angle [A] in wheelset coordinates
 *   34-38     wheel marker x, y, z [L], roll, yaw [A] in wheelset coordinates */
void cntc_getcontactlocation(const int *ire, const int *icp, const int *lenarr, double *rvalues);

/* Get the rolling velocity.
 *   veloc: velocity [V] */
void cntc_getreferencevelocity(const int *ire, const int *icp, double *veloc);

/* Get the parameters of a Hertzian geometry (basic contact).
 *   rvalues: distance a1 x^2 + b1 y^2 [1/L], semi-axes aa, bb, effective radius rho, cp [L],
 *       scale [-], sides of the axis bneg, bpos [L], ratio aob [-] */
void cntc_gethertzcontact(const int *ire, const int *icp, const int *lenarr, double *rvalues);

/* Get the size of the grid.
 *   mx, my: numbers of elements along x and y */
void cntc_getnumelements(const int *ire, const int *icp, int *mx, int *my);

/* Get the sizes of elements.
 *   dx, dy: sizes [L] */
void cntc_getgriddiscretization(const int *ire, const int *icp, double *dx, double *dy);

/* Get the grid.
 *   rvalues: numbers of elements mx, my, centre of the first element xc1, yc1 [L], sizes of
 *       elements dx, dy [L] */
void cntc_getpotcontact(const int *ire, const int *icp, const int *lenarr, double *rvalues);

/* Get the approach of the bodies.
 *   pen: approach [L] */
void cntc_getpenetration(const int *ire, const int *icp, double *pen);

/* Get creepages, in shifts the shift.
 *   vx, vy: creepages [-], in shifts [L]
 *   phi: spin [A/L], in shifts [A] */
void cntc_getcreepages(const int *ire, const int *icp, double *vx, double *vy, double *phi);

/* Get forces in the directions of the contact.
 *   fn: normal force [F]
 *   tx, ty: tangential forces [F]
 *   mz: moment about the normal [F L] */
void cntc_getcontactforces(const int *ire, const int *icp, double *fn, double *tx, double *ty,
                           double *mz);

/* Get forces and moments of wheel and rail; with icp = -1 the sum of all patches.
 *   rvalues in threes, forces Fx, Fy, Fz [F] and moments Mx, My, Mz [F L]:
 *   1-6       track directions, about the rail marker; 7-12 wheelset directions, about the wheel marker
 *   13-18     rail directions, about the rail marker; 19-24 wheel directions, about the wheel marker
 *   They act on the rail, in Simpack units on the wheel. With damping its forces are included, which totals of files and
 *   prescribed forces do not contain. */
void cntc_getglobalforces(const int *ire, const int *icp, const int *lenarr, double *rvalues);

/* Get the areas of contact, adhesion and slip.
 *   carea, harea, sarea: areas [L2] */
void cntc_getcontactpatchareas(const int *ire, const int *icp, double *carea, double *harea,
                               double *sarea);

/* Get the state of each element.
 *   eldiv: 0 exterior, 1 adhesion, 2 slip, 3 plastic */
void cntc_getelementdivision(const int *ire, const int *icp, const int *lenarr, int *eldiv);

/* Get the largest pressure.
 *   pnmax: pressure [F/L2] */
void cntc_getmaximumpressure(const int *ire, const int *icp, double *pnmax);

/* Get the largest tangential traction.
 *   ptmax: traction [F/L2] */
void cntc_getmaximumtraction(const int *ire, const int *icp, double *ptmax);

/* Get the largest surface temperatures in contact.
 *   t1max, t2max: of bodies 1 and 2 [degC] */
void cntc_getmaximumtemperature(const int *ire, const int *icp, double *t1max, double *t2max);

/* Get the estimated errors of the totals of a patch, after a calculation with the flag
 * CNTC_own_errors = 1.
 *   rvalues: errors of the normal force, the tangential forces [F], the spin moment [F L], the
 *       approach [L], the largest pressure [F/L2], the contact area [L2], the longitudinal and
 *       lateral creepage or shift [-] or [L], the frictional power [W] or work [J], the elastic
 *       energy [J], the highest temperature of body 1 [degC]; not negative; -1 for prescribed
 *       quantities and those without an estimate */
void cntc_geterrors(const int *ire, const int *icp, const int *lenarr, double *rvalues);

/* Get totals of wear and fatigue of a patch, after a calculation with the flag CNTC_own_wear =
 * 1.
 *   rvalues: T-gamma [F], wear index [F/L2], largest density of frictional power [W/mm2],
 *       largest wear depth [L] and worn area of the section [L2] per passage, tangential over
 *       normal force [-], largest pressure over yield stress in shear [-], the same over its
 *       shakedown limit [-], surface fatigue index [-], largest von Mises and Tresca stress at
 *       the subsurface points [F/L2]; 0 for quantities that do not apply */
void cntc_getwear(const int *ire, const int *icp, const int *lenarr, double *rvalues);

/* Get one field for each element.
 *   ifld: CNTC_fld_*
 *   fld: value of each element, in the unit of the field */
void cntc_getfielddata(const int *ire, const int *icp, const int *ifld, const int *lenarr,
                       double *fld);

/* Get the tractions of each element.
 *   pn, px, py: normal and tangential tractions [F/L2] */
void cntc_gettractions(const int *ire, const int *icp, const int *lenarr, double *pn, double *px,
                       double *py);

/* Get the slip of each element.
 *   sx, sy: relative slip velocities [-], in shifts distances [mm] */
void cntc_getmicroslip(const int *ire, const int *icp, const int *lenarr, double *sx, double *sy);

/* Get the displacement differences of each element.
 *   un, ux, uy: normal and tangential differences [L] */
void cntc_getdisplacements(const int *ire, const int *icp, const int *lenarr, double *un,
                           double *ux, double *uy);

/* Get derivatives of forces with respect to approach and creepages.
 *   lenout, lenin: numbers of rows and columns
 *   sens: rows: Fn [F], Fx, Fy relative to fstat * Fn [-], Mz [F L]; columns, one after the
 *       other: approach [L], creepages and spin; on body 1 and with respect to the creepages as
 *       set, in all units; zero if not computed, see the flag CNTC_ic_sens */
void cntc_getsensitivities(const int *ire, const int *icp, const int *lenout, const int *lenin,
                           double *sens);

/* Get the time of the calculations.
 *   tcpu, twall: processor and wall clock time since the last reset [s] */
void cntc_getcalculationtime(const int *ire, const int *icp, double *tcpu, double *twall);

/* Set the time of the calculations to zero. */
void cntc_resetcalculationtime(const int *ire, const int *icp);

/* ---- Stresses below the surface ---- */

/* Add a block of subsurface points.
 *   iblk: number of the block; this and later blocks are deleted, 0 deletes all
 *   isubs     xparam; yparam; zparam, depths below the surface
 *   1         none; none; nz, zl, dz [L]                                     all element centres
 *   2         ixl, ixinc, ixh; iyl, iyinc, iyh; nz, zl, dz                   ranges of elements
 *   3         numbers of columns; numbers of rows; nz, zl, dz                lists of elements
 *   5, 6, 7   as 1, 2, 3 with zparam a list of depths [L]
 *   9         coordinates x; y; z [L] */
void subs_addblock(const int *ire, const int *icp, const int *iblk, const int *isubs,
                   const int *npx, const int *npy, const int *npz, const double *xparam,
                   const double *yparam, const double *zparam);

/* Compute subsurface displacements and stresses, after cntc_calculate.
 *   ierror: 0; negative: an error, CNTC_err_*; 305: another thread works on the problem */
void subs_calculate(const int *ire, const int *icp, int *ierror);

/* Get the numbers of points of a block.
 *   iblk: number of the block
 *   nx, ny, nz: numbers of points, -1 if there is no such block */
void subs_getblocksize(const int *ire, const int *icp, const int *iblk, int *nx, int *ny, int *nz);

/* Get results below the surface.
 *   iblk: number of the block
 *   lenarr: number of points
 *   icol: requested columns: 1-3 x, y, z [L]; 4-6 ux, uy, uz [L]; 7-9 hydrostatic, von Mises,
 *       Tresca stress; 10-12 principal stresses; 13-21 tensor xx, yx, zx, xy, yy, zy, xz, yz, zz
 *       [F/L2]
 *   values: the columns one after the other */
void subs_getresults(const int *ire, const int *icp, const int *iblk, const int *lenarr,
                     const int *ncol, const int *icol, double *values);

#ifdef __cplusplus
}
#endif

#endif
