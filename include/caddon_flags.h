/* Named numbers of the CONTACT library, as in caddon_flags.inc for Fortran.
 * Made by src/capi/make_interface.py from src/capi/interface.txt; change those. */
#ifndef CADDON_FLAGS_H
#define CADDON_FLAGS_H

enum caddon_flags {
  /* Size that callers give to lists of flags */
  CNTC_FLAGS_DIM = 25, /* largest length of a list of flags */
  /* Flags: units and convention of signs */
  CNTC_if_units = 1933, /* units and signs of a problem, one of the following */
  CNTC_un_cntc = 1934, /* mm, N, results on body 1 (rail in wheel/rail contact) */
  CNTC_un_spck = 1935, /* m, N, results on body 2 (wheel in wheel/rail contact) */
  CNTC_un_si = 1936, /* m, N, results on body 1 */
  CNTC_un_imper = 1937, /* imperial units; not available */
  /* Flags: control digits of a problem */
  CNTC_ic_config = 1967, /* C1: left or right rail (0, 1) or roller (4, 5) */
  CNTC_ic_pvtime = 1970, /* P: relation to the previous case */
  CNTC_ic_bound = 1971, /* B: method of the normal problem */
  CNTC_ic_tang = 1972, /* T: 0 frictionless, 1 shift, 2 transient rolling, 3 steady rolling */
  CNTC_ic_norm = 1973, /* N: 0 approach or position given, 1 normal or vertical force given */
  CNTC_ic_force = 1974, /* F: creepages given, or forces instead */
  CNTC_ic_frclaw = 1976, /* L: friction law; read only, see cntc_setfrictionmethod */
  CNTC_ic_discns = 1977, /* D: way to find and describe the potential contact, wheel/rail */
  CNTC_ic_inflcf = 1978, /* C: influence coefficients */
  CNTC_ic_mater = 1979, /* M: material; read only, see cntc_setmaterialparameters */
  CNTC_ic_exrhs = 1980, /* E: extra term of the rigid slip */
  CNTC_ic_xflow = 1981, /* X: debug print, one digit per part of the solution */
  CNTC_ic_heat = 1982, /* H: surface temperatures; read only, see cntc_settemperaturedata */
  CNTC_ic_iestim = 1983, /* I: initial estimate */
  CNTC_ic_output = 1984, /* O: results in the .out file */
  CNTC_ic_flow = 1985, /* W: trace of the solution in the .out file */
  CNTC_ic_return = 1986, /* R: 0, 1 compute; 2, 3 check only */
  CNTC_ic_matfil = 1987, /* A: .mat files */
  CNTC_ic_sens = 1988, /* S2: sensitivities, 2 normal, 3 all */
  CNTC_ic_ifmeth = 1989, /* method of conformal coefficients (C = 4) */
  CNTC_ic_ifvari = 1990, /* variant of conformal coefficients (C = 4) */
  CNTC_ic_sbsout = 1991, /* subsurface results in the .out file */
  CNTC_ic_sbsfil = 1992, /* .subs files */
  CNTC_ic_npomax = 1993, /* largest number of elements of a patch, wheel/rail */
  /* Flags: the library as a whole */
  CNTC_if_idebug = 2000, /* how much the interface writes to the .out file, -1 to 5 */
  CNTC_if_debug = 2000, /* the same by the name that the published guide uses */
  CNTC_if_licdbg = 2001, /* accepted, without effect */
  CNTC_if_wrtinp = 2002, /* write the cases as an .inp file: 0 no, 1 yes, 2 each complete (wheel/rail) */
  CNTC_if_openmp = 2003, /* threads per problem, -1 for all */
  CNTC_if_timers = 2004, /* table of times at the end: 0 none, 1 short, 2 full */
  CNTC_if_ncase = 2005, /* number of the next case */
  /* Flags that only this library has */
  CNTC_own_heat = 9001, /* temperatures: 0 as the established program, 1 by moving sources */
  CNTC_own_border = 9002, /* read only, where contact is cut off: sum of 1 x low, 2 x high, 4 y low, 8 y high side of the grid; 16 inner, 32 outer end of the rail profile; 64 inner, 128 outer end of the wheel profile; 256 a hidden part of a profile; with icp -1 also 512 inner, 1024 outer end of the wheel profile inside the rail without a patch, 2048 interpenetration at another position along the track without a patch */
  CNTC_own_stepped = 9003, /* read only, number of points of subs_calculate at depths below DX/4 that are not element centres */
  CNTC_own_angle = 9004, /* contact angles on rails that vary along the track: 0 of the rail section below the axle, as in the established program; 1 of wheel and rail where they touch */
  CNTC_own_across = 9005, /* read only, number of elements across the contact in its narrower direction, 0 without contact; fewer than 5 give inaccurate results */
  CNTC_own_classical = 9006, /* solvers selected by G: 0 replaced by the default solver where possible, with as small a residual; 1 used */
  CNTC_own_order = 9007, /* discretisation of rolling: 1 the established one, 2 of second order in the element size */
  CNTC_own_errors = 9008, /* estimate errors of the totals in each calculation: 0 no, 1 yes, see cntc_geterrors */
  CNTC_own_wear = 9011, /* compute wear and fatigue: 0 no, 1 yes, see cntc_setwear and cntc_getwear */
  CNTC_own_accuracy = 9009, /* required accuracy of the forces instead of a grid: the reciprocal of the largest relative error, 10 to 1000000; 0 none, the grid is used as given */
  CNTC_own_approximate = 9012, /* with a required accuracy: 0 full theory only, 1 also simplified methods whose known error is below it */
  CNTC_own_reached = 9010, /* read only, whether the last calculation reached the required accuracy: 0 no, or none required, 1 yes */
  /* Data that are written to the .mat files */
  CNTC_mt_tim = 2011, /* time [s] */
  CNTC_mt_xr = 2012, /* contact point on the rail, x [L] */
  CNTC_mt_yr = 2013, /* contact point on the rail, y [L] */
  CNTC_mt_xw = 2014, /* contact point on the wheel, x [L] */
  CNTC_mt_yw = 2015, /* contact point on the wheel, y [L] */
  CNTC_mt_sw = 2016, /* position along the track [L] */
  CNTC_mt_run = 2021, /* number of the run */
  CNTC_mt_axle = 2022, /* number of the axle */
  CNTC_mt_side = 2023, /* number of the side */
  /* Fields of cntc_getfielddata */
  CNTC_fld_h = 1, /* undeformed distance, approach not subtracted [L] */
  CNTC_fld_mu = 2, /* coefficient of friction [-] */
  CNTC_fld_px = 3, /* longitudinal traction on body 1 [F/L2] */
  CNTC_fld_py = 4, /* lateral traction on body 1 [F/L2] */
  CNTC_fld_pn = 5, /* pressure [F/L2] */
  CNTC_fld_ux = 7, /* longitudinal displacement difference [L] */
  CNTC_fld_uy = 8, /* lateral displacement difference [L] */
  CNTC_fld_un = 9, /* normal displacement difference [L] */
  CNTC_fld_taucrt = 11, /* yield limit [F/L2] */
  CNTC_fld_uplsx = 12, /* longitudinal plastic displacement [L] */
  CNTC_fld_uplsy = 13, /* lateral plastic displacement [L] */
  CNTC_fld_sx = 15, /* longitudinal slip, relative [-]; longitudinal slip distance [mm] */
  CNTC_fld_sy = 16, /* lateral slip, relative [-]; lateral slip distance [mm] */
  CNTC_fld_temp1 = 20, /* surface temperature of body 1 [degC] */
  CNTC_fld_temp2 = 21, /* surface temperature of body 2 [degC] */
  CNTC_fld_wx = 22, /* longitudinal rigid slip, relative [-]; longitudinal rigid shift [mm] */
  CNTC_fld_wy = 23, /* lateral rigid slip, relative [-]; lateral rigid shift [mm] */
  CNTC_fld_power = 25, /* density of frictional power [W/mm2] */
  CNTC_fld_wear = 26, /* wear depth of a passage or a shift [L] */
  /* Kinds of input files of cntc_readinpfile */
  CNTC_inp_vamp = 1984, /* not available */
  CNTC_inp_modul1 = 1988, /* input of wheel/rail contact */
  CNTC_inp_spck = 1990, /* input of the user subroutine of Simpack */
  CNTC_inp_gensys = 1992, /* not available */
  /* Codes of errors */
  CNTC_err_allow = -12, /* not allowed: too many result elements at a time */
  CNTC_err_search = -25, /* the contact search failed */
  CNTC_err_ftot = -26, /* the balance of total forces failed */
  CNTC_err_broydn = -26, /* older name of CNTC_err_ftot */
  CNTC_err_norm = -27, /* the normal problem did not converge */
  CNTC_err_tang = -28, /* the tangential problem did not converge */
  CNTC_err_tol = -29, /* stopped above the tolerance; there are results */
  CNTC_err_icp = -31, /* the contact patch does not exist */
  CNTC_err_profil = -32, /* a profile is missing or unusable */
  CNTC_err_frclaw = -33, /* the friction data are unusable */
  CNTC_err_discr = -34, /* the grid does not match the previous case, or is too large */
  CNTC_err_input = -39, /* the input file is unusable */
  CNTC_err_other = -99 /* anything else */
};

#endif
