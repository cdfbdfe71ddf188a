/* CONTACT: rolling and sliding contact with friction - routines of the library for C and C++.
 * Made by src/capi/make_interface.py from src/capi/interface.txt; change those.
 *
 * Each argument is passed by its address, single numbers included. Arrays have the length that stands
 * in front of them; texts need no null at the end, their length counts. Nothing that is passed is kept.
 * Units: L length, F force, V velocity, A angle [rad], T time [s]; flag CNTC_if_units chooses between
 * mm and m. The named numbers are in caddon_flags.h; doc/user/library.md tells all. */
#ifndef CONTACT_ADDON_H
#define CONTACT_ADDON_H

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Begin and end ---- */

/* Numbers of Fortran units that the library might use. Recorded, not needed: it asks the run-time
 * library for free units. */
void cntc_setfileunits(const int *nunits, const int *iunits);

/* Start a run, once for all result elements. ifcver: version of the interface; ioutput: 1 sends the
 * log to the standard output as well; wrkdir: folder of input files; outdir: folder of results;
 * expnam: name of the .out file. A blank text or length 0 leaves the default. */
void cntc_initializefirst(int *ifcver, int *ierror, const int *ioutput, const char *c_wrkdir,
                          const char *c_outdir, const char *c_expnam, const int *len_wrkdir,
                          const int *len_outdir, const int *len_expnam);

/* The same as cntc_initializefirst, for callers of releases that had both. */
void cntc_initializefirst_new(int *ifcver, int *ierror, const int *ioutput, const char *c_wrkdir,
                              const char *c_outdir, const char *c_expnam, const int *len_wrkdir,
                              const int *len_outdir, const int *len_expnam);

/* Create result element ire (1..999) for module imodul: 1 wheel/rail contact, 3 basic contact. */
void cntc_initialize(const int *ire, const int *imodul, int *ifcver, int *ierror,
                     const char *c_outdir, const int *len_outdir);

/* Set flags that hold for the whole library: CNTC_if_idebug, CNTC_if_openmp. */
void cntc_setglobalflags(const int *lenflg, const int *params, const int *values);

/* Largest number of calculations that may run at the same time. */
void cntc_getmaxnumthreads(int *mxthrd);

/* Free a result element; after the last one the run ends. */
void cntc_finalize(const int *ire);

/* Free all result elements and close the files. */
void cntc_finalizelast(void);

/* ---- Settings of both modules; icp is -1 in wheel/rail contact and 1..9 in basic contact ---- */

/* Set flags and control digits; 0 in params skips an entry. */
void cntc_setflags(const int *ire, const int *icp, const int *lenflg, const int *params,
                   const int *values);

/* Data that go along into the .mat files, CNTC_mt_*. */
void cntc_setmetadata(const int *ire, const int *icp, const int *lenmta, const int *params,
                      const double *values);

/* Solution methods and their parameters, by the G digit; 6 sets those of the sensitivities. */
void cntc_setsolverflags(const int *ire, const int *icp, const int *gdigit, const int *nints,
                         const int *iparam, const int *nreals, const double *rparam);

/* Material by the M digit, or 10 + M2 for damping. rparam begins with nu1, nu2 [-], G1, G2 [F/L2].
 * */
void cntc_setmaterialparameters(const int *ire, const int *icp, const int *imeth, const int *nparam,
                                const double *rparam);

/* Thermal data by the H digit: per body temperature [degrees C], heat capacity [J/(kg K)],
 * conductivity [W/(L K)], density [kg/L3]; at the end the share of plastic work that heats [-]. */
void cntc_settemperaturedata(const int *ire, const int *icp, const int *imeth, const int *nparam,
                             const double *params);

/* Time step dt [T] of shifts. */
void cntc_settimestep(const int *ire, const int *icp, const double *dt);

/* Rolling direction chi [A] and step dq: [L] in basic contact, ratio to dx in wheel/rail contact.
 * */
void cntc_setrollingstepsize(const int *ire, const int *icp, const double *chi, const double *dq);

/* Friction law, imeth = 10 V + L with the digits V and L. */
void cntc_setfrictionmethod(const int *ire, const int *icp, const int *imeth, const int *nparam,
                            const double *params);

/* Grid: in basic contact 1..4 for mx, my and the extent [L]; in wheel/rail contact 0 or -1 for dx,
 * ds [L] and the distances and angle that separate patches. */
void cntc_setpotcontact(const int *ire, const int *icp, const int *ipotcn, const int *nparam,
                        const double *params);

/* Tangential forces: relative to fstat Fn in basic contact [-], longitudinal force [F] in
 * wheel/rail. */
void cntc_settangentialforces(const int *ire, const int *icp, const double *fx, const double *fy);

/* Settings from an input file of wheel/rail contact, kind CNTC_inp_*. */
void cntc_readinpfile(const int *ire, const int *inp_type, const char *c_fname,
                      const int *len_fname, int *ierror);

/* ---- Settings of basic contact ---- */

/* Rolling velocity [V]. */
void cntc_setreferencevelocity(const int *ire, const int *icp, const double *veloc);

/* Hertzian geometry -1..-6: mx, my, curvatures [1/L] or semi-axes [L], scale of the grid [-]. */
void cntc_sethertzcontact(const int *ire, const int *icp, const int *ipotcn, const int *nparam,
                          const double *params);

/* Approach of the bodies [L]; sets N = 0. */
void cntc_setpenetration(const int *ire, const int *icp, const double *pen);

/* Normal force [F]; sets N = 1. */
void cntc_setnormalforce(const int *ire, const int *icp, const double *fn);

/* Undeformed distance [L]: 1 quadratic, 2 circular in x with heights, 3 sines plus quadratic, 9
 * given per element, x running fastest. Comes after cntc_setpotcontact. */
void cntc_setundeformeddistc(const int *ire, const int *icp, const int *ibase, const int *nparam,
                             const double *prmudf);

/* Creepages [-], [-], [A/L]; shifts [L], [L], [A] when T = 1, which has to be set before. */
void cntc_setcreepages(const int *ire, const int *icp, const double *vx, const double *vy,
                       const double *phi);

/* Extra term of the rigid slip per element [-]; in shifts [mm]. */
void cntc_setextrarigidslip(const int *ire, const int *icp, const int *lenarr, const double *wx,
                            const double *wy);

/* ---- Settings of wheel/rail contact ---- */

/* Vertical force on the contact [F]; sets N = 1. */
void cntc_setverticalforce(const int *ire, const double *fz);

/* Profile of rail or wheel from a file. iparam: kind (0 rail, 1 wheel, -1 by extension), unused,
 * mirror y, mirror z, errors, smoothing method; rparam: factor to mm, smoothing, fraction that may
 * be left out, angles of zigzag and kinks [rad], width of kinks [L]. */
void cntc_setprofileinputfname(const int *ire, const char *c_fname, const int *len_fname,
                               const int *nints, const int *iparam, const int *nreals,
                               const double *rparam);

/* The same from a table y1, z1, y2, z2, ... */
void cntc_setprofileinputvalues(const int *ire, const int *npoint, const double *values,
                                const int *nints, const int *iparam, const int *nreals,
                                const double *rparam);

/* Track by the Z digit: 1 gauge and cant, 2 deviations, 3 both, 32 and 33 springs. */
void cntc_settrackdimensions(const int *ire, const int *ztrack, const int *nparam,
                             const double *params);

/* Flange back distance, its position, nominal radius, position of the tape circle [L]. */
void cntc_setwheelsetdimensions(const int *ire, const int *ewheel, const int *nparam,
                                const double *params);

/* s, y, z [L], roll, yaw, pitch [A]. */
void cntc_setwheelsetposition(const int *ire, const int *ewheel, const int *nparam,
                              const double *params);

/* vs, vy, vz [V], roll, yaw, pitch rate [A/T]; on rollers the rate of the roller comes first. */
void cntc_setwheelsetvelocity(const int *ire, const int *ewheel, const int *nparam,
                              const double *params);

/* Deviations of the wheel from the rigid wheelset: positions [L], [A] and velocities [V], [A/T]. */
void cntc_setwheelsetflexibility(const int *ire, const int *ewheel, const int *nparam,
                                 const double *params);

/* ---- Calculation ---- */

/* Solve. ierror: 0, a negative CNTC_err_*, or in basic contact the number of contact elements on
 * the border of the grid. */
void cntc_calculate(const int *ire, const int *icp, int *ierror);

/* ---- Results ---- */

/* Control digits as they stand. */
void cntc_getflags(const int *ire, const int *icp, const int *lenflg, const int *params,
                   int *values);

/* 1 kinematics, 2 material, 3 friction. */
void cntc_getparameters(const int *ire, const int *icp, const int *itask, const int *lenarr,
                        double *values);

/* Profiles as the library sees them: -1 state, 0 number of points, 1, 2 y and z, 3 gauge, 4 arc
 * length, 5 angle, 6 to 8 lines on a surface. */
void cntc_getprofilevalues(const int *ire, const int *itask, const int *nints, const int *iparam,
                           const int *nreals, const double *rparam, const int *lenarr, double *val);

/* The same, for callers of releases that had both. */
void cntc_getprofilevalues_new(const int *ire, const int *itask, const int *nints,
                               const int *iparam, const int *nreals, const double *rparam,
                               const int *lenarr, double *val);

/* s, y, z [L], roll, yaw, pitch [A]. */
void cntc_getwheelsetposition(const int *ire, const int *lenarr, double *rvalues);

/* vs, vy, vz [V], roll, yaw, pitch rate [A/T]. */
void cntc_getwheelsetvelocity(const int *ire, const int *lenarr, double *rvalues);

/* Number of contact patches. */
void cntc_getnumcontactpatches(const int *ire, int *npatch);

/* Contact reference point in the systems of track, rail, wheel and wheelset, 38 values [L], [A]. */
void cntc_getcontactlocation(const int *ire, const int *icp, const int *lenarr, double *rvalues);

/* Rolling velocity [V]. */
void cntc_getreferencevelocity(const int *ire, const int *icp, double *veloc);

/* Curvatures, semi-axes, effective radius, scale, sides of the axis, ratio: 10 values. */
void cntc_gethertzcontact(const int *ire, const int *icp, const int *lenarr, double *rvalues);

/* Size of the grid. */
void cntc_getnumelements(const int *ire, const int *icp, int *mx, int *my);

/* Sides of an element [L]. */
void cntc_getgriddiscretization(const int *ire, const int *icp, double *dx, double *dy);

/* mx, my, centre of the first element [L], sides of an element [L]. */
void cntc_getpotcontact(const int *ire, const int *icp, const int *lenarr, double *rvalues);

/* Approach [L]. */
void cntc_getpenetration(const int *ire, const int *icp, double *pen);

/* Creepages [-], [-], [A/L], or shifts [L], [L], [A]. */
void cntc_getcreepages(const int *ire, const int *icp, double *vx, double *vy, double *phi);

/* Forces [F] and spin moment [F L] in the directions of the contact. */
void cntc_getcontactforces(const int *ire, const int *icp, double *fn, double *tx, double *ty,
                           double *mz);

/* Forces and moments in the systems of track, wheelset, rail and wheel, 24 values [F], [F L]; sum
 * of the patches with icp = -1. */
void cntc_getglobalforces(const int *ire, const int *icp, const int *lenarr, double *rvalues);

/* Areas of contact, adhesion and slip [L2]. */
void cntc_getcontactpatchareas(const int *ire, const int *icp, double *carea, double *harea,
                               double *sarea);

/* Per element 0 exterior, 1 adhesion, 2 slip, 3 plastic. */
void cntc_getelementdivision(const int *ire, const int *icp, const int *lenarr, int *eldiv);

/* Largest pressure [F/L2]. */
void cntc_getmaximumpressure(const int *ire, const int *icp, double *pnmax);

/* Largest tangential traction [F/L2]. */
void cntc_getmaximumtraction(const int *ire, const int *icp, double *ptmax);

/* Largest surface temperatures [degrees C]. */
void cntc_getmaximumtemperature(const int *ire, const int *icp, double *t1max, double *t2max);

/* One field CNTC_fld_*, x running fastest. */
void cntc_getfielddata(const int *ire, const int *icp, const int *ifld, const int *lenarr,
                       double *fld);

/* Tractions [F/L2], normal first. */
void cntc_gettractions(const int *ire, const int *icp, const int *lenarr, double *pn, double *px,
                       double *py);

/* Micro-slip [-]; shift distance in mm when T is 0 or 1. */
void cntc_getmicroslip(const int *ire, const int *icp, const int *lenarr, double *sx, double *sy);

/* Displacement differences [L], normal first. */
void cntc_getdisplacements(const int *ire, const int *icp, const int *lenarr, double *un,
                           double *ux, double *uy);

/* Derivatives of Fn, Fx, Fy, Mz by approach and creepages, columns one after the other; Fx and Fy
 * relative to fstat Fn. */
void cntc_getsensitivities(const int *ire, const int *icp, const int *lenout, const int *lenin,
                           double *sens);

/* Time of the calculations since the last reset [s]. */
void cntc_getcalculationtime(const int *ire, const int *icp, double *tcpu, double *twall);

/* Set the time to zero. */
void cntc_resetcalculationtime(const int *ire, const int *icp);

/* ---- Stresses below the surface ---- */

/* Block iblk of points, chosen by ISUBS 1, 2, 3, 5, 6, 7, 9; blocks from iblk on are forgotten, 0
 * forgets all. z [L] is the depth; explicit coordinates in [L]. */
void subs_addblock(const int *ire, const int *icp, const int *iblk, const int *isubs,
                   const int *npx, const int *npy, const int *npz, const double *xparam,
                   const double *yparam, const double *zparam);

/* Displacements and stresses in all blocks, after cntc_calculate. */
void subs_calculate(const int *ire, const int *icp, int *ierror);

/* Size of a block, -1 when there is none. */
void subs_getblocksize(const int *ire, const int *icp, const int *iblk, int *nx, int *ny, int *nz);

/* Columns of the results one after the other: 1-3 place [L], 4-6 displacement [L], 7-9 hydrostatic,
 * von Mises and Tresca stress, 10-12 principal stresses, 13-21 tensor by columns [F/L2]. */
void subs_getresults(const int *ire, const int *icp, const int *iblk, const int *lenarr,
                     const int *ncol, const int *icol, double *values);

#ifdef __cplusplus
}
#endif

#endif
