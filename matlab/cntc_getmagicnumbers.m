function [ CNTC ] = cntc_getmagicnumbers( )
% CNTC_GETMAGICNUMBERS  Struct with the named numbers of flags, fields, and so on.
%
%   CNTC = cntc_getmagicnumbers()
%
% Size that callers give to lists of flags
%
%   CNTC.FLAGS_DIM    largest length of a list of flags
%
% Flags: units and convention of signs
%
%   CNTC.if_units     units and signs of a problem, one of the following
%   CNTC.un_cntc      mm, N, results on body 1 (rail in wheel/rail contact)
%   CNTC.un_spck      m, N, results on body 2 (wheel in wheel/rail contact)
%   CNTC.un_si        m, N, results on body 1
%   CNTC.un_imper     imperial units; not available
%
% Flags: control digits of a problem
%
%   CNTC.ic_config    C1: left or right rail (0, 1) or roller (4, 5)
%   CNTC.ic_pvtime    P: relation to the previous case
%   CNTC.ic_bound     B: method of the normal problem
%   CNTC.ic_tang      T: 0 frictionless, 1 shift, 2 transient rolling, 3 steady rolling
%   CNTC.ic_norm      N: 0 approach or position given, 1 normal or vertical force given
%   CNTC.ic_force     F: creepages given, or forces instead
%   CNTC.ic_frclaw    L: friction law; read only, see cntc_setfrictionmethod
%   CNTC.ic_discns    D: way to find and describe the potential contact, wheel/rail
%   CNTC.ic_inflcf    C: influence coefficients
%   CNTC.ic_mater     M: material; read only, see cntc_setmaterialparameters
%   CNTC.ic_exrhs     E: extra term of the rigid slip
%   CNTC.ic_xflow     X: debug print, one digit per part of the solution
%   CNTC.ic_heat      H: surface temperatures; read only, see cntc_settemperaturedata
%   CNTC.ic_iestim    I: initial estimate
%   CNTC.ic_output    O: results in the .out file
%   CNTC.ic_flow      W: trace of the solution in the .out file
%   CNTC.ic_return    R: 0, 1 compute; 2, 3 check only
%   CNTC.ic_matfil    A: .mat files
%   CNTC.ic_sens      S2: sensitivities, 2 normal, 3 all
%   CNTC.ic_ifmeth    method of conformal coefficients (C = 4)
%   CNTC.ic_ifvari    variant of conformal coefficients (C = 4)
%   CNTC.ic_sbsout    subsurface results in the .out file
%   CNTC.ic_sbsfil    .subs files
%   CNTC.ic_npomax    largest number of elements of a patch, wheel/rail
%
% Flags: the library as a whole
%
%   CNTC.if_idebug    how much the interface writes to the .out file, -1 to 5
%   CNTC.if_debug     the same by the name that the published guide uses
%   CNTC.if_licdbg    accepted, without effect
%   CNTC.if_wrtinp    write the cases as an .inp file: 0 no, 1 yes, 2 each complete (wheel/rail)
%   CNTC.if_openmp    threads per problem, -1 for all
%   CNTC.if_timers    table of times at the end: 0 none, 1 short, 2 full
%   CNTC.if_ncase     number of the next case
%
% Flags that only this library has
%
%   CNTC.own_heat     temperatures: 0 as the established program, 1 by moving sources
%   CNTC.own_border   read only, where contact is cut off: sum of 1 x low, 2 x high, 4 y low, 8 y high side of the grid; 16 inner, 32 outer end of the rail profile; 64 inner, 128 outer end of the wheel profile; 256 a hidden part of a profile; with icp -1 also 512 inner, 1024 outer end of the wheel profile inside the rail without a patch, 2048 interpenetration at another position along the track without a patch
%   CNTC.own_stepped  read only, number of points of subs_calculate at depths below DX/4 that are not element centres
%   CNTC.own_angle    contact angles on rails that vary along the track: 0 of the rail section below the axle, as in the established program; 1 of wheel and rail where they touch
%   CNTC.own_across   read only, number of elements across the contact in its narrower direction, 0 without contact; fewer than 5 give inaccurate results
%   CNTC.own_classical solvers selected by G: 0 replaced by the default solver where possible, with as small a residual; 1 used
%   CNTC.own_order    discretisation of rolling: 1 the established one, 2 of second order in the element size
%   CNTC.own_errors   estimate errors of the totals in each calculation: 0 no, 1 yes, see cntc_geterrors
%   CNTC.own_wear     compute wear and fatigue: 0 no, 1 yes, see cntc_setwear and cntc_getwear
%   CNTC.own_accuracy required accuracy of the forces instead of a grid: the reciprocal of the largest relative error, 10 to 1000000; 0 none, the grid is used as given
%   CNTC.own_approximate with a required accuracy: 0 full theory only, 1 also simplified methods whose known error is below it
%   CNTC.own_reached  read only, whether the last calculation reached the required accuracy: 0 no, or none required, 1 yes
%
% Data that are written to the .mat files
%
%   CNTC.mt_tim       time [s]
%   CNTC.mt_xr        contact point on the rail, x [L]
%   CNTC.mt_yr        contact point on the rail, y [L]
%   CNTC.mt_xw        contact point on the wheel, x [L]
%   CNTC.mt_yw        contact point on the wheel, y [L]
%   CNTC.mt_sw        position along the track [L]
%   CNTC.mt_run       number of the run
%   CNTC.mt_axle      number of the axle
%   CNTC.mt_side      number of the side
%
% Fields of cntc_getfielddata
%
%   CNTC.fld_h        undeformed distance, approach not subtracted [L]
%   CNTC.fld_mu       coefficient of friction [-]
%   CNTC.fld_px       longitudinal traction on body 1 [F/L2]
%   CNTC.fld_py       lateral traction on body 1 [F/L2]
%   CNTC.fld_pn       pressure [F/L2]
%   CNTC.fld_ux       longitudinal displacement difference [L]
%   CNTC.fld_uy       lateral displacement difference [L]
%   CNTC.fld_un       normal displacement difference [L]
%   CNTC.fld_taucrt   yield limit [F/L2]
%   CNTC.fld_uplsx    longitudinal plastic displacement [L]
%   CNTC.fld_uplsy    lateral plastic displacement [L]
%   CNTC.fld_sx       longitudinal slip, relative [-]; longitudinal slip distance [mm]
%   CNTC.fld_sy       lateral slip, relative [-]; lateral slip distance [mm]
%   CNTC.fld_temp1    surface temperature of body 1 [degC]
%   CNTC.fld_temp2    surface temperature of body 2 [degC]
%   CNTC.fld_wx       longitudinal rigid slip, relative [-]; longitudinal rigid shift [mm]
%   CNTC.fld_wy       lateral rigid slip, relative [-]; lateral rigid shift [mm]
%   CNTC.fld_power    density of frictional power [W/mm2]
%   CNTC.fld_wear     wear depth of a passage or a shift [L]
%
% Kinds of input files of cntc_readinpfile
%
%   CNTC.inp_vamp     not available
%   CNTC.inp_modul1   input of wheel/rail contact
%   CNTC.inp_spck     input of the user subroutine of Simpack
%   CNTC.inp_gensys   not available
%
% Codes of errors
%
%   CNTC.err_allow    not allowed: too many result elements at a time
%   CNTC.err_search   the contact search failed
%   CNTC.err_ftot     the balance of total forces failed
%   CNTC.err_broydn   older name of CNTC_err_ftot
%   CNTC.err_norm     the normal problem did not converge
%   CNTC.err_tang     the tangential problem did not converge
%   CNTC.err_tol      stopped above the tolerance; there are results
%   CNTC.err_icp      the contact patch does not exist
%   CNTC.err_profil   a profile is missing or unusable
%   CNTC.err_frclaw   the friction data are unusable
%   CNTC.err_discr    the grid does not match the previous case, or is too large
%   CNTC.err_input    the input file is unusable
%   CNTC.err_other    anything else
%
% Made by src/capi/make_interface.py from src/capi/interface.txt; change those.

   CNTC.FLAGS_DIM = 25;
   CNTC.if_units = 1933;
   CNTC.un_cntc = 1934;
   CNTC.un_spck = 1935;
   CNTC.un_si = 1936;
   CNTC.un_imper = 1937;
   CNTC.ic_config = 1967;
   CNTC.ic_pvtime = 1970;
   CNTC.ic_bound = 1971;
   CNTC.ic_tang = 1972;
   CNTC.ic_norm = 1973;
   CNTC.ic_force = 1974;
   CNTC.ic_frclaw = 1976;
   CNTC.ic_discns = 1977;
   CNTC.ic_inflcf = 1978;
   CNTC.ic_mater = 1979;
   CNTC.ic_exrhs = 1980;
   CNTC.ic_xflow = 1981;
   CNTC.ic_heat = 1982;
   CNTC.ic_iestim = 1983;
   CNTC.ic_output = 1984;
   CNTC.ic_flow = 1985;
   CNTC.ic_return = 1986;
   CNTC.ic_matfil = 1987;
   CNTC.ic_sens = 1988;
   CNTC.ic_ifmeth = 1989;
   CNTC.ic_ifvari = 1990;
   CNTC.ic_sbsout = 1991;
   CNTC.ic_sbsfil = 1992;
   CNTC.ic_npomax = 1993;
   CNTC.if_idebug = 2000;
   CNTC.if_debug = 2000;
   CNTC.if_licdbg = 2001;
   CNTC.if_wrtinp = 2002;
   CNTC.if_openmp = 2003;
   CNTC.if_timers = 2004;
   CNTC.if_ncase = 2005;
   CNTC.own_heat = 9001;
   CNTC.own_border = 9002;
   CNTC.own_stepped = 9003;
   CNTC.own_angle = 9004;
   CNTC.own_across = 9005;
   CNTC.own_classical = 9006;
   CNTC.own_order = 9007;
   CNTC.own_errors = 9008;
   CNTC.own_wear = 9011;
   CNTC.own_accuracy = 9009;
   CNTC.own_approximate = 9012;
   CNTC.own_reached = 9010;
   CNTC.mt_tim = 2011;
   CNTC.mt_xr = 2012;
   CNTC.mt_yr = 2013;
   CNTC.mt_xw = 2014;
   CNTC.mt_yw = 2015;
   CNTC.mt_sw = 2016;
   CNTC.mt_run = 2021;
   CNTC.mt_axle = 2022;
   CNTC.mt_side = 2023;
   CNTC.fld_h = 1;
   CNTC.fld_mu = 2;
   CNTC.fld_px = 3;
   CNTC.fld_py = 4;
   CNTC.fld_pn = 5;
   CNTC.fld_ux = 7;
   CNTC.fld_uy = 8;
   CNTC.fld_un = 9;
   CNTC.fld_taucrt = 11;
   CNTC.fld_uplsx = 12;
   CNTC.fld_uplsy = 13;
   CNTC.fld_sx = 15;
   CNTC.fld_sy = 16;
   CNTC.fld_temp1 = 20;
   CNTC.fld_temp2 = 21;
   CNTC.fld_wx = 22;
   CNTC.fld_wy = 23;
   CNTC.fld_power = 25;
   CNTC.fld_wear = 26;
   CNTC.inp_vamp = 1984;
   CNTC.inp_modul1 = 1988;
   CNTC.inp_spck = 1990;
   CNTC.inp_gensys = 1992;
   CNTC.err_allow = -12;
   CNTC.err_search = -25;
   CNTC.err_ftot = -26;
   CNTC.err_broydn = -26;
   CNTC.err_norm = -27;
   CNTC.err_tang = -28;
   CNTC.err_tol = -29;
   CNTC.err_icp = -31;
   CNTC.err_profil = -32;
   CNTC.err_frclaw = -33;
   CNTC.err_discr = -34;
   CNTC.err_input = -39;
   CNTC.err_other = -99;

end % function cntc_getmagicnumbers
