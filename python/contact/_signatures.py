"""Arguments of the routines of the library, its named numbers, units and meaning of results.

Made by src/capi/make_interface.py from src/capi/interface.txt; change those.
"""

VERSION = "0.1.0"

#: Arguments of each routine: name, > for a result, type: i int, I ints, d double, D doubles, s text
SIGNATURES = {
    "cntc_setfileunits": "nunits:i iunits:I",
    "cntc_initializefirst": (
        "ifcver:>i ierror:>i ioutput:i c_wrkdir:s c_outdir:s c_expnam:s len_wrkdir:i "
        "len_outdir:i len_expnam:i"
    ),
    "cntc_initializefirst_new": (
        "ifcver:>i ierror:>i ioutput:i c_wrkdir:s c_outdir:s c_expnam:s len_wrkdir:i "
        "len_outdir:i len_expnam:i"
    ),
    "cntc_initialize": "ire:i imodul:i ifcver:>i ierror:>i c_outdir:s len_outdir:i",
    "cntc_setglobalflags": "lenflg:i params:I values:I",
    "cntc_getmaxnumthreads": "mxthrd:>i",
    "cntc_finalize": "ire:i",
    "cntc_finalizelast": "",
    "cntc_setflags": "ire:i icp:i lenflg:i params:I values:I",
    "cntc_setmetadata": "ire:i icp:i lenmta:i params:I values:D",
    "cntc_setsolverflags": "ire:i icp:i gdigit:i nints:i iparam:I nreals:i rparam:D",
    "cntc_setmaterialparameters": "ire:i icp:i imeth:i nparam:i rparam:D",
    "cntc_settemperaturedata": "ire:i icp:i imeth:i nparam:i params:D",
    "cntc_setwear": "ire:i icp:i nparam:i params:D",
    "cntc_settimestep": "ire:i icp:i dt:d",
    "cntc_setrollingstepsize": "ire:i icp:i chi:d dq:d",
    "cntc_setfrictionmethod": "ire:i icp:i imeth:i nparam:i params:D",
    "cntc_setpotcontact": "ire:i icp:i ipotcn:i nparam:i params:D",
    "cntc_settangentialforces": "ire:i icp:i fx:d fy:d",
    "cntc_readinpfile": "ire:i inp_type:i c_fname:s len_fname:i ierror:>i",
    "cntc_setreferencevelocity": "ire:i icp:i veloc:d",
    "cntc_sethertzcontact": "ire:i icp:i ipotcn:i nparam:i params:D",
    "cntc_setpenetration": "ire:i icp:i pen:d",
    "cntc_setnormalforce": "ire:i icp:i fn:d",
    "cntc_setundeformeddistc": "ire:i icp:i ibase:i nparam:i prmudf:D",
    "cntc_setcreepages": "ire:i icp:i vx:d vy:d phi:d",
    "cntc_setextrarigidslip": "ire:i icp:i lenarr:i wx:D wy:D",
    "cntc_setverticalforce": "ire:i fz:d",
    "cntc_setprofileinputfname": (
        "ire:i c_fname:s len_fname:i nints:i iparam:I nreals:i rparam:D"
    ),
    "cntc_setprofileinputvalues": "ire:i npoint:i values:D nints:i iparam:I nreals:i rparam:D",
    "cntc_settrackdimensions": "ire:i ztrack:i nparam:i params:D",
    "cntc_setwheelsetdimensions": "ire:i ewheel:i nparam:i params:D",
    "cntc_setwheelsetposition": "ire:i ewheel:i nparam:i params:D",
    "cntc_setwheelsetvelocity": "ire:i ewheel:i nparam:i params:D",
    "cntc_setwheelsetflexibility": "ire:i ewheel:i nparam:i params:D",
    "cntc_calculate": "ire:i icp:i ierror:>i",
    "cntc_getflags": "ire:i icp:i lenflg:i params:I values:>I",
    "cntc_getparameters": "ire:i icp:i itask:i lenarr:i values:>D",
    "cntc_getprofilevalues": (
        "ire:i itask:i nints:i iparam:I nreals:i rparam:D lenarr:i val:>D"
    ),
    "cntc_getprofilevalues_new": (
        "ire:i itask:i nints:i iparam:I nreals:i rparam:D lenarr:i val:>D"
    ),
    "cntc_getwheelsetposition": "ire:i lenarr:i rvalues:>D",
    "cntc_getwheelsetvelocity": "ire:i lenarr:i rvalues:>D",
    "cntc_getnumcontactpatches": "ire:i npatch:>i",
    "cntc_getcontactlocation": "ire:i icp:i lenarr:i rvalues:>D",
    "cntc_getreferencevelocity": "ire:i icp:i veloc:>d",
    "cntc_gethertzcontact": "ire:i icp:i lenarr:i rvalues:>D",
    "cntc_getnumelements": "ire:i icp:i mx:>i my:>i",
    "cntc_getgriddiscretization": "ire:i icp:i dx:>d dy:>d",
    "cntc_getpotcontact": "ire:i icp:i lenarr:i rvalues:>D",
    "cntc_getpenetration": "ire:i icp:i pen:>d",
    "cntc_getcreepages": "ire:i icp:i vx:>d vy:>d phi:>d",
    "cntc_getcontactforces": "ire:i icp:i fn:>d tx:>d ty:>d mz:>d",
    "cntc_getglobalforces": "ire:i icp:i lenarr:i rvalues:>D",
    "cntc_getcontactpatchareas": "ire:i icp:i carea:>d harea:>d sarea:>d",
    "cntc_getelementdivision": "ire:i icp:i lenarr:i eldiv:>I",
    "cntc_getmaximumpressure": "ire:i icp:i pnmax:>d",
    "cntc_getmaximumtraction": "ire:i icp:i ptmax:>d",
    "cntc_getmaximumtemperature": "ire:i icp:i t1max:>d t2max:>d",
    "cntc_geterrors": "ire:i icp:i lenarr:i rvalues:>D",
    "cntc_getwear": "ire:i icp:i lenarr:i rvalues:>D",
    "cntc_getfielddata": "ire:i icp:i ifld:i lenarr:i fld:>D",
    "cntc_gettractions": "ire:i icp:i lenarr:i pn:>D px:>D py:>D",
    "cntc_getmicroslip": "ire:i icp:i lenarr:i sx:>D sy:>D",
    "cntc_getdisplacements": "ire:i icp:i lenarr:i un:>D ux:>D uy:>D",
    "cntc_getsensitivities": "ire:i icp:i lenout:i lenin:i sens:>D",
    "cntc_getcalculationtime": "ire:i icp:i tcpu:>d twall:>d",
    "cntc_resetcalculationtime": "ire:i icp:i",
    "subs_addblock": (
        "ire:i icp:i iblk:i isubs:i npx:i npy:i npz:i xparam:D yparam:D zparam:D"
    ),
    "subs_calculate": "ire:i icp:i ierror:>i",
    "subs_getblocksize": "ire:i icp:i iblk:i nx:>i ny:>i nz:>i",
    "subs_getresults": "ire:i icp:i iblk:i lenarr:i ncol:i icol:I values:>D",
    "cntc_calculate1": "ire:i ierror:>i",
    "cntc_calculate3": "ire:i icp:i ierror:>i",
}

#: The named numbers without CNTC_
MAGIC_NUMBERS = {
    # Size that callers give to lists of flags
    "FLAGS_DIM": 25,  # largest length of a list of flags
    # Flags: units and convention of signs
    "if_units": 1933,  # units and signs of a problem, one of the following
    "un_cntc": 1934,  # mm, N, results on body 1 (rail in wheel/rail contact)
    "un_spck": 1935,  # m, N, results on body 2 (wheel in wheel/rail contact)
    "un_si": 1936,  # m, N, results on body 1
    "un_imper": 1937,  # imperial units; not available
    # Flags: control digits of a problem
    "ic_config": 1967,  # C1: left or right rail (0, 1) or roller (4, 5)
    "ic_pvtime": 1970,  # P: relation to the previous case
    "ic_bound": 1971,  # B: method of the normal problem
    "ic_tang": 1972,  # T: 0 frictionless, 1 shift, 2 transient rolling, 3 steady rolling
    "ic_norm": 1973,  # N: 0 approach or position given, 1 normal or vertical force given
    "ic_force": 1974,  # F: creepages given, or forces instead
    "ic_frclaw": 1976,  # L: friction law; read only, see cntc_setfrictionmethod
    "ic_discns": 1977,  # D: way to find and describe the potential contact, wheel/rail
    "ic_inflcf": 1978,  # C: influence coefficients
    "ic_mater": 1979,  # M: material; read only, see cntc_setmaterialparameters
    "ic_exrhs": 1980,  # E: extra term of the rigid slip
    "ic_xflow": 1981,  # X: debug print, one digit per part of the solution
    "ic_heat": 1982,  # H: surface temperatures; read only, see cntc_settemperaturedata
    "ic_iestim": 1983,  # I: initial estimate
    "ic_output": 1984,  # O: results in the .out file
    "ic_flow": 1985,  # W: trace of the solution in the .out file
    "ic_return": 1986,  # R: 0, 1 compute; 2, 3 check only
    "ic_matfil": 1987,  # A: .mat files
    "ic_sens": 1988,  # S2: sensitivities, 2 normal, 3 all
    "ic_ifmeth": 1989,  # method of conformal coefficients (C = 4)
    "ic_ifvari": 1990,  # variant of conformal coefficients (C = 4)
    "ic_sbsout": 1991,  # subsurface results in the .out file
    "ic_sbsfil": 1992,  # .subs files
    "ic_npomax": 1993,  # largest number of elements of a patch, wheel/rail
    # Flags: the library as a whole
    "if_idebug": 2000,  # how much the interface writes to the .out file, -1 to 5
    "if_debug": 2000,  # the same by the name that the published guide uses
    "if_licdbg": 2001,  # accepted, without effect
    "if_wrtinp": 2002,  # write the cases as an .inp file: 0 no, 1 yes, 2 each complete (wheel/rail)
    "if_openmp": 2003,  # threads per problem, -1 for all
    "if_timers": 2004,  # table of times at the end: 0 none, 1 short, 2 full
    "if_ncase": 2005,  # number of the next case
    # Flags that only this library has
    "own_heat": 9001,  # temperatures: 0 as the established program, 1 by moving sources
    "own_border": 9002,  # read only, where contact is cut off: sum of 1 x low, 2 x high, 4 y low, 8 y high side of the grid; 16 inner, 32 outer end of the rail profile; 64 inner, 128 outer end of the wheel profile; 256 a hidden part of a profile; with icp -1 also 512 inner, 1024 outer end of the wheel profile inside the rail without a patch, 2048 interpenetration at another position along the track without a patch
    "own_stepped": 9003,  # read only, number of points of subs_calculate at depths below DX/4 that are not element centres
    "own_angle": 9004,  # contact angles on rails that vary along the track: 0 of the rail section below the axle, as in the established program; 1 of wheel and rail where they touch
    "own_across": 9005,  # read only, number of elements across the contact in its narrower direction, 0 without contact; fewer than 5 give inaccurate results
    "own_classical": 9006,  # solvers selected by G: 0 replaced by the default solver where possible, with as small a residual; 1 used
    "own_order": 9007,  # discretisation of rolling: 1 the established one, 2 of second order in the element size
    "own_errors": 9008,  # estimate errors of the totals in each calculation: 0 no, 1 yes, see cntc_geterrors
    "own_wear": 9011,  # compute wear and fatigue: 0 no, 1 yes, see cntc_setwear and cntc_getwear
    "own_accuracy": 9009,  # required accuracy of the forces instead of a grid: the reciprocal of the largest relative error, 10 to 1000000; 0 none, the grid is used as given
    "own_approximate": 9012,  # with a required accuracy: 0 full theory only, 1 also simplified methods whose known error is below it
    "own_reached": 9010,  # read only, whether the last calculation reached the required accuracy: 0 no, or none required, 1 yes
    # Data that are written to the .mat files
    "mt_tim": 2011,  # time [s]
    "mt_xr": 2012,  # contact point on the rail, x [L]
    "mt_yr": 2013,  # contact point on the rail, y [L]
    "mt_xw": 2014,  # contact point on the wheel, x [L]
    "mt_yw": 2015,  # contact point on the wheel, y [L]
    "mt_sw": 2016,  # position along the track [L]
    "mt_run": 2021,  # number of the run
    "mt_axle": 2022,  # number of the axle
    "mt_side": 2023,  # number of the side
    # Fields of cntc_getfielddata
    "fld_h": 1,  # undeformed distance, approach not subtracted [L]
    "fld_mu": 2,  # coefficient of friction [-]
    "fld_px": 3,  # longitudinal traction on body 1 [F/L2]
    "fld_py": 4,  # lateral traction on body 1 [F/L2]
    "fld_pn": 5,  # pressure [F/L2]
    "fld_ux": 7,  # longitudinal displacement difference [L]
    "fld_uy": 8,  # lateral displacement difference [L]
    "fld_un": 9,  # normal displacement difference [L]
    "fld_taucrt": 11,  # yield limit [F/L2]
    "fld_uplsx": 12,  # longitudinal plastic displacement [L]
    "fld_uplsy": 13,  # lateral plastic displacement [L]
    "fld_sx": 15,  # longitudinal slip, relative [-]; longitudinal slip distance [mm]
    "fld_sy": 16,  # lateral slip, relative [-]; lateral slip distance [mm]
    "fld_temp1": 20,  # surface temperature of body 1 [degC]
    "fld_temp2": 21,  # surface temperature of body 2 [degC]
    "fld_wx": 22,  # longitudinal rigid slip, relative [-]; longitudinal rigid shift [mm]
    "fld_wy": 23,  # lateral rigid slip, relative [-]; lateral rigid shift [mm]
    "fld_power": 25,  # density of frictional power [W/mm2]
    "fld_wear": 26,  # wear depth of a passage or a shift [L]
    # Kinds of input files of cntc_readinpfile
    "inp_vamp": 1984,  # not available
    "inp_modul1": 1988,  # input of wheel/rail contact
    "inp_spck": 1990,  # input of the user subroutine of Simpack
    "inp_gensys": 1992,  # not available
    # Codes of errors
    "err_allow": -12,  # not allowed: too many result elements at a time
    "err_search": -25,  # the contact search failed
    "err_ftot": -26,  # the balance of total forces failed
    "err_broydn": -26,  # older name of CNTC_err_ftot
    "err_norm": -27,  # the normal problem did not converge
    "err_tang": -28,  # the tangential problem did not converge
    "err_tol": -29,  # stopped above the tolerance; there are results
    "err_icp": -31,  # the contact patch does not exist
    "err_profil": -32,  # a profile is missing or unusable
    "err_frclaw": -33,  # the friction data are unusable
    "err_discr": -34,  # the grid does not match the previous case, or is too large
    "err_input": -39,  # the input file is unusable
    "err_other": -99,  # anything else
}

#: Unit and meaning of element fields: in rolling, and in shifts if these differ
FIELDS = {
    "h": (("mm", "undeformed distance, approach not subtracted"),),
    "mu": (("-", "coefficient of friction"),),
    "pn": (("N/mm2", "pressure"),),
    "power": (("W/mm2", "density of frictional power"),),
    "px": (("N/mm2", "longitudinal traction on body 1"),),
    "py": (("N/mm2", "lateral traction on body 1"),),
    "sx": (("-", "longitudinal slip, relative"), ("mm", "longitudinal slip distance"),),
    "sy": (("-", "lateral slip, relative"), ("mm", "lateral slip distance"),),
    "taucrt": (("N/mm2", "yield limit"),),
    "temp1": (("degC", "surface temperature of body 1"),),
    "temp2": (("degC", "surface temperature of body 2"),),
    "un": (("mm", "normal displacement difference"),),
    "uplsx": (("mm", "longitudinal plastic displacement"),),
    "uplsy": (("mm", "lateral plastic displacement"),),
    "ux": (("mm", "longitudinal displacement difference"),),
    "uy": (("mm", "lateral displacement difference"),),
    "wear": (("mm", "wear depth of a passage or a shift"),),
    "wx": (("-", "longitudinal rigid slip, relative"), ("mm", "longitudinal rigid shift"),),
    "wy": (("-", "lateral rigid slip, relative"), ("mm", "lateral rigid shift"),),
}

#: Unit and meaning of totals
TOTALS = {
    "bar_fn": ("N", "normal force of a curved patch, axes of the contact reference"),
    "bar_fs": ("N", "lateral force of a curved patch, axes of the contact reference"),
    "bar_fx": ("N", "longitudinal force of a curved patch, axes of the contact reference"),
    "bar_mn": ("N mm", "moment of a curved patch about the normal of the contact reference"),
    "border_elements": ("", "elements in contact in the outer rows and columns"),
    "ceta": ("-", "lateral creepage, prescribed or computed"),
    "cksi": ("-", "longitudinal creepage, prescribed or computed"),
    "contact_area": ("mm2", "area of the elements in contact"),
    "cphi": ("rad/mm", "spin"),
    "deltcp_r": ("rad", "contact angle in the rail profile"),
    "deltcp_tr": ("rad", "contact angle in track coordinates"),
    "dy_defl": ("mm", "lateral deflection of the rail"),
    "dz_defl": ("mm", "vertical deflection of the rail"),
    "elastic_energy": ("J", "elastic energy"),
    "fatigue_index": ("-", "surface fatigue index, above 0: fatigue of the surface is expected"),
    "fn": ("N", "normal force"),
    "fn_damp": ("N", "normal damping force, not part of FN"),
    "force_trials": ("", "heights tried in a search for the vertical force, at most"),
    "friction_power": ("W", "frictional power, dissipation negative"),
    "friction_work": ("J", "frictional work, dissipation negative"),
    "fx": ("N", "longitudinal force on body 1"),
    "fx_damp": ("N", "longitudinal damping force, not part of FX"),
    "fx_rel": ("-", "FX over friction coefficient times FN"),
    "fx_tr": ("N", "force on the rail along the track"),
    "fx_ws": ("N", "longitudinal force on the rail in wheelset coordinates"),
    "fy": ("N", "lateral force on body 1"),
    "fy_damp": ("N", "lateral damping force, not part of FY"),
    "fy_rel": ("-", "FY over friction coefficient times FN"),
    "fy_tr": ("N", "lateral force on the rail in track coordinates"),
    "fy_ws": ("N", "lateral force on the rail in wheelset coordinates"),
    "fz_tr": ("N", "vertical force on the rail in track coordinates"),
    "fz_ws": ("N", "vertical force on the rail in wheelset coordinates"),
    "max_mises": ("N/mm2", "largest von Mises stress at the points below the surface"),
    "max_power": ("W/mm2", "largest density of frictional power"),
    "max_temp": ("degC", "highest surface temperature in contact"),
    "max_temp1": ("degC", "highest surface temperature of body 1 in contact"),
    "max_temp2": ("degC", "highest surface temperature of body 2 in contact"),
    "max_tresca": ("N/mm2", "largest Tresca stress at the points below the surface"),
    "max_wear": ("mm", "largest wear depth of a passage of the contact, or of a shift"),
    "mu_scal": ("-", "friction coefficient of the relative forces"),
    "mx_r_tr": ("N mm", "roll moment about the rail marker, track axes"),
    "mx_w_ws": ("N mm", "roll moment about the wheel marker, wheelset axes"),
    "my_r_tr": ("N mm", "pitch moment about the rail marker, track axes"),
    "my_w_ws": ("N mm", "pitch moment about the wheel marker, wheelset axes"),
    "mz": ("N mm", "moment about the normal through the origin, on body 1; wheel on rail: through the contact reference"),
    "mz_elem": ("N mm", "moment about the normal through the origin of the elements, MN of the .out file"),
    "mz_r_tr": ("N mm", "yaw moment about the rail marker, track axes"),
    "mz_w_ws": ("N mm", "yaw moment about the wheel marker, wheelset axes"),
    "nadh": ("", "elements in adhesion"),
    "ncon": ("", "elements in contact"),
    "nplast": ("", "yielding elements"),
    "nslip": ("", "slipping elements"),
    "pen": ("mm", "approach of the bodies"),
    "pmax": ("N/mm2", "largest pressure"),
    "roll_r": ("rad", "roll angle of the rail"),
    "roll_w": ("rad", "roll angle of the wheel"),
    "roll_ws": ("rad", "roll angle of the wheelset"),
    "rotation": ("rad", "rotation"),
    "s_ws": ("mm", "position of the wheelset along the track"),
    "shakedown": ("-", "largest pressure over its shakedown limit, above 1: plastic strain accumulates"),
    "shakedown_load": ("-", "largest pressure over yield stress in shear"),
    "shift_x": ("mm", "longitudinal shift, prescribed or computed"),
    "shift_y": ("mm", "lateral shift, prescribed or computed"),
    "smallest_gap": ("mm", "smallest vertical gap, negative: overlap"),
    "t_gamma": ("N", "forces times creepages, moment times spin: energy per distance rolled"),
    "traction": ("-", "tangential over normal force"),
    "vpitch_ws": ("rad/s", "pitch rate of the wheelset, prescribed or computed"),
    "wear_index": ("N/mm2", "T-gamma over the contact area"),
    "worn_section": ("mm2", "worn area of the section per passage of the contact"),
    "x_elem": ("mm", "contact reference in the coordinates of the elements"),
    "x_w": ("mm", "wheel marker, longitudinal"),
    "xcp_tr": ("mm", "contact reference along the track"),
    "xcp_w": ("mm", "contact reference, longitudinal, wheel profile"),
    "y_elem": ("mm", "contact reference in the coordinates of the elements"),
    "y_r": ("mm", "rail marker, lateral"),
    "y_w": ("mm", "wheel marker, lateral"),
    "y_ws": ("mm", "lateral position of the wheelset"),
    "yaw_w": ("rad", "yaw angle of the wheel"),
    "yaw_ws": ("rad", "yaw angle of the wheelset"),
    "ycp_r": ("mm", "contact reference, lateral, rail profile"),
    "ycp_tr": ("mm", "contact reference, lateral, track coordinates"),
    "ycp_w": ("mm", "contact reference, lateral, wheel profile"),
    "ynom_whl": ("mm", "origin of the profile from the middle of the wheelset, outwards"),
    "z_r": ("mm", "rail marker, vertical"),
    "z_w": ("mm", "wheel marker, vertical"),
    "z_ws": ("mm", "height of the wheelset, prescribed or computed"),
    "zcp_r": ("mm", "contact reference, vertical, rail profile"),
    "zcp_tr": ("mm", "contact reference, vertical, track coordinates"),
    "zcp_w": ("mm", "contact reference, vertical, wheel profile"),
}
