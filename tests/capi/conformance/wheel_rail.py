#!/usr/bin/env python3
"""Wheel on rail by the library: conventions, left and right, profiles. usage: wheel_rail.py SCENARIO"""
import os
import re
import shutil
import subprocess
import sys

import numpy as np
from checks import REFERENCE, SOURCE, check, close, finish, profiles, same
from contact import cntc
from contact._library import call, last_error
from contact.cntc import CNTC

#: Signs of the 24 global forces when the wheelset is mirrored: longitudinal, lateral, vertical forces, moments
MIRROR = np.tile([1.0, -1.0, 1.0, -1.0, 1.0, -1.0], 4)


def set_up(ire, side, units="un_cntc", y=2.0, roll=-0.0001128):
    """A case of the Manchester benchmark, coarse grid"""
    big = 1.0 if units == "un_cntc" else 1e-3
    same(cntc.initialize(ire, 1)[1], 0, f"initialize {ire}")
    cntc.setflags(ire, -1, [CNTC[name] for name in ("if_units", "ic_config", "ic_tang", "ic_pvtime", "ic_discns")],
                  [CNTC[units], side, 3, 2, 2])
    cntc.setsolverflags(ire, -1, 0, [999, 100, 30, 1], [1e-5])
    cntc.setmaterialparameters(ire, -1, 0, [0.28, 0.28, 82e3 / big**2, 82e3 / big**2])
    cntc.setfrictionmethod(ire, -1, 0, [0.3, 0.3])
    cntc.setpotcontact(ire, -1, -1, [0.4 * big, 0.4 * big, np.pi / 2, 8 * big, 4 * big])
    cntc.setrollingstepsize(ire, -1, 0.0, 1.0)
    cntc.settrackdimensions(ire, 3, np.array([14.0, 0.0, 1435.0] + 8 * [0.0]) * ([big, 1.0, big] + 8 * [1.0]))
    rail, wheel = profiles()
    cntc.setprofileinputfname(ire, rail, [0], [1.0, 0.0])
    cntc.setprofileinputfname(ire, wheel, [1], [1.0, 0.0])
    cntc.setwheelsetdimensions(ire, 3, np.array([1360.0, -70.0, 460.0]) * big)
    cntc.setwheelsetposition(ire, 1, [0, y * big, 0, roll, 0.0024 * y, 0])
    cntc.setwheelsetvelocity(ire, 2, [2000 * big, 0, 0, 0, 0, -4.3459197])
    cntc.setverticalforce(ire, 10000.0)
    same(cntc.calculate(ire, -1), 0, f"element {ire}: error code")


EXPECTED = {
    # Left and right, as printed by version 25.2.0: figures of the specification of the interface, 10.7 B
    0: {"forces": [547.10, -3095.67, 10000.00, 40025.0, -36098.5, -13238.6, 532.23, -3099.39, 9999.65, -86641.3, 186.74,
                   4795.38],
        "rail": [3.6112, -756.5057, 0.02711, 0.013443, 3.6112, 4.0269, 0.02711, -4.0270, 0.013443, -0.02992, -8.5661,
                 -0.21140, -8.5684, 0.013556, 3.6111, -756.5383],
        "markers": [3.6000, -747.9395, 0.23754, -0.0001128, 0.0048, -760.5326, 0, 0],
        "wheelset": [-0.02992, -758.5661, 459.7886, 0.013556, 0, -750, 460, 0, 0],
        "grid": [25, 28, -4.8, -5.2, 0.4, 0.4], "local": [10040.71, 547.10, -2960.96, 143.50],
        "creepages": [-8.65166e-4, 4.798401e-3, -2.946872e-5], "areas": [34.08, 0.0, 34.08],
        "largest": [466.12, 139.83], "pen": 0.0205036, "V": 1999.135, "z": 0.152945},
    1: {"forces": [-517.36, -2095.05, 9999.99, -194913.6, 33342.2, -3131.4, -527.41, -2093.67, 9999.76, -110174.8,
                   -2092.78, -6281.81],
        "rail": [-3.3682, 740.9147, 0.65484, -0.080607, -3.3682, -19.6179, 0.65484, -19.6328, -0.080607, 0.17838,
                 -11.1296, 0.58534, 11.1474, -0.080495, -3.3684, 740.9038],
        "markers": [-3.6000, 752.0432, 0.06824, -0.0001128, 0.0048, 760.5326, 0, 0],
        "wheelset": [0.17838, 738.8704, 460.5853, -0.080495, 0, 750, 460, 0, 0],
        "grid": [27, 18, -5.2, -3.2, 0.4, 0.4], "local": [9798.83, -517.36, -2893.45, -38.34],
        "creepages": [8.75205e-4, 4.817743e-3, 1.746442e-4], "areas": [21.12, 0.0, 21.12],
        "largest": [745.70, 223.71], "pen": 0.0247755, "V": 2000.876, "z": 0.152844},
}

# The same on the profiles of the examples: figures of this program, which gives the ones above if their profiles are available
OWN = {
    0: {"forces": [-130.49, -3639.75, 9999.98, 122342.2, -34436.2, -10858.2, -147.97, -3640.21, 9999.57, 66962.2, 1240.86,
                   1521.81],
        "rail": [3.43966, -741.3412, 0.262546, 0.058044, 3.43966, 12.14013, 0.262546, -12.14419, 0.058044, -0.128656, 6.59890,
                 0.272116, 6.60580, 0.058157, 3.43975, -741.3427],
        "markers": [3.6000, -747.9395, -0.008825, -0.0001128, 0.0048, -753.4814, 0, 0],
        "wheelset": [-0.128656, -743.4011, 460.2721, 0.058157, 0, -750, 460, 0, 0],
        "grid": [29, 17, -5.6, -3.2, 0.4, 0.4], "local": [10194.29, -130.49, -3053.51, 77.23],
        "creepages": [1.977166e-4, 4.808644e-3, -1.262876e-4], "areas": [20.32, 0.0, 20.32],
        "largest": [806.64, 241.99], "pen": 0.0260139, "V": 2000.1977, "z": -0.093421},
    1: {"forces": [-792.44, -1864.45, 9999.99, -151231.4, 32796.4, -5930.0, -801.39, -1861.76, 9999.78, -136267.3, -2802.23,
                   -11502.8],
        "rail": [-3.31926, 738.2517, 0.502139, -0.096772, -3.31926, -15.22962, 0.502139, -15.24314, -0.096772, 0.214523,
                 -13.79278, 0.821289, 13.82092, -0.096659, -3.319932, 738.2648],
        "markers": [-3.6000, 752.0432, -0.320706, -0.0001128, 0.0048, 753.4814, 0, 0],
        "wheelset": [0.214523, 736.2072, 460.8213, -0.096659, 0, 750, 460, 0, 0],
        "grid": [27, 19, -5.2, -3.6, 0.4, 0.4], "local": [9773.06, -792.44, -2821.94, -49.61],
        "creepages": [1.386026e-3, 4.825901e-3, 2.095624e-4], "areas": [21.76, 0.0, 21.76],
        "largest": [700.65, 210.19], "pen": 0.0242108, "V": 2001.3870, "z": -0.236104},
}


def conventions():
    """Left and right in mm, the left in m with the signs of both bodies"""
    figures = EXPECTED if REFERENCE in profiles()[0] else OWN
    runs = ((1, 0, "un_cntc", 1.0, 1.0), (2, 1, "un_cntc", 1.0, 1.0), (3, 0, "un_si", 1e-3, 1.0),
            (4, 0, "un_spck", 1e-3, -1.0))
    for ire, side, units, big, body in runs:
        set_up(ire, side, units)
        expected, label = figures[side], f"{('left', 'right')[side]} {units}"
        same(cntc.getnumcontactpatches(ire), 1, f"{label}: patches")
        times = cntc.getcalculationtime(ire, 1)
        check(min(times) > 0.0, f"{label}: processor and elapsed time {times}")
        cntc.resetcalculationtime(ire, 1)
        same(tuple(cntc.getcalculationtime(ire, 1)), (0.0, 0.0), f"{label}: times from zero again")
        forces = cntc.getglobalforces(ire, -1).reshape(8, 3)
        forces[1::2] /= big
        forces = forces.reshape(-1) * body
        # Moments about markers are forces with arms of a few hundred mm: tolerance by the largest
        tolerance = np.tile([20.0, 20.0, 1.0, 600.0, 120.0, 600.0], 2)
        close(forces[:12], expected["forces"], tolerance, f"{label}: forces about the markers")
        close(forces[12:], forces[:12], 1e-6 * 2e5, f"{label}: no rotation of rail and wheel")
        place = cntc.getcontactlocation(ire, 1)
        lengths, angles = [0, 1, 2, 4, 5, 6, 7, 9, 10, 11, 12, 14, 15], [3, 8, 13]
        close(place[lengths] / big, np.array(expected["rail"])[lengths], 2e-3, f"{label}: contact location")
        close(place[angles], np.array(expected["rail"])[angles], 1e-4, f"{label}: contact angles")
        one = 1.0
        close(place[20:28] / [big, big, big, one, one, big, big, one], expected["markers"], 2e-3, f"{label}: markers")
        close(place[29:38] / [big, big, big, one, big, big, big, one, one], expected["wheelset"], 2e-3,
              f"{label}: wheelset system")
        grid = np.array(cntc.getpotcontact(ire, 1))
        close(grid / [1, 1, big, big, big, big], expected["grid"], [2.1, 2.1, 0.81, 0.81, 1e-9, 1e-9], f"{label}: grid")
        local = np.array(cntc.getcontactforces(ire, 1)) * [1, body, body, body / big]
        close(local, expected["local"], [20, 20, 20, 3], f"{label}: local forces")
        creepages = np.array(cntc.getcreepages(ire, 1)) * [body, body, body * big]
        close(creepages, expected["creepages"], [1e-7, 1e-6, 1e-8], f"{label}: creepages")
        close(np.array(cntc.getcontactpatchareas(ire, 1)[:3]) / big**2, expected["areas"], 2.1 * 0.16,
              f"{label}: areas")
        largest = np.array([cntc.getmaximumpressure(ire, 1), cntc.getmaximumtraction(ire, 1)]) * big**2
        close(largest, expected["largest"], 0.005 * 746, f"{label}: largest pressure and traction")
        close(cntc.getpenetration(ire, 1) / big, expected["pen"], 2e-5, f"{label}: approach")
        close(cntc.getreferencevelocity(ire, 1) / big, expected["V"], 0.01, f"{label}: velocity")
        close(cntc.getwheelsetposition(ire)[2] / big, expected["z"], 1e-4, f"{label}: height")
        same(cntc.getgriddiscretization(ire, -1), (0.4 * big, 0.4 * big), f"{label}: prescribed element")
        flags = [CNTC[name] for name in ("ic_norm", "ic_force", "ic_output", "ic_iestim", "ic_tang")]
        same(cntc.getflags(ire, 1, flags).tolist(), [0, 0, 0, 1, 3], f"{label}: digits of the patch")
        same(cntc.getflags(ire, -1, flags[0]).tolist(), [1], f"{label}: N of the whole")


def rail_points():
    """The points of the rail as its file has them, and the gauge point: 14 mm below the top, on the side of the gauge"""
    with open(profiles()[0], encoding="utf-8") as file:
        text = re.sub("!.*", "", file.read())
    points = np.array(re.search(r"point\.begin(.*?)point\.end", text, re.DOTALL).group(1).split(), float).reshape(-1, 2)
    inner = points[points[:, 0] < points[np.argmin(points[:, 1]), 0]]
    inner = inner[np.argsort(inner[:, 1])]
    return points, np.interp(points[:, 1].min() + 14.0, inner[:, 1], inner[:, 0])


def patch_as_in_matlab():
    """A patch as returned by Matlab's loadcase"""
    points, gauge = rail_points()
    set_up(1, 1)
    patch = cntc.getcpresults(1, 1)
    same(patch["pn"].shape, (patch["my"], patch["mx"]), "shape of fields")
    same((patch["config"], patch["kincns"]["t_digit"], patch["meta"]["npatch"]), (1, 3, 1), "digits")
    close(patch["pn"].sum() * patch["dx"] * patch["dy"], cntc.getcontactforces(1, 1)[0], 1.0, "normal force")
    traction = np.hypot(patch["px"], patch["py"])
    check(bool(np.all(traction <= patch["trcbnd"] * (1 + 1e-6) + 1e-9)), "tractions below their bound")
    same(len(patch["prr"]["ProfileY"]), len(points), "rail profile")
    same(patch["prw"]["ProfileS"].shape, patch["prw"]["ProfileZ"].shape, "wheel profile")
    close(patch["meta"]["y_r"], 717.5 - gauge, 2e-3, "marker of the rail")
    for side in (0, 1):
        set_up(2, side)
        cntc.setflags(2, -1, CNTC["ic_tang"], 2)
        same(cntc.calculate(2, -1), 0, "a step")
        step = cntc.getcpresults(2, 1)
        # pressures of a step are around the contact reference in the coordinates of the elements
        where = [(step["pn"].sum(axis)*step[name]).sum()/step["pn"].sum() for axis, name in ((0, "x"), (1, "y"))]
        check(np.hypot(*where) > 2.0, "elements of a step have another origin")
        close([step["meta"]["spinxo"], step["meta"]["spinyo"]], where, 0.5, "contact reference of a step")
    same((patch["meta"]["spinxo"], patch["meta"]["spinyo"]), (0.0, 0.0), "contact reference in steady rolling")
    same((patch["meta"]["rnom_whl"], patch["meta"]["rnom_rol"]), (460.0, 0.0), "radii on a track")
    set_up(2, 1)
    cntc.setflags(2, -1, CNTC["ic_config"], 5)
    cntc.settrackdimensions(2, 3, [14.0, 0.0, 1435.0, 0.0, 500.0] + 6*[0.0])
    cntc.setwheelsetvelocity(2, 2, [-4.0, 0, 0, 0, 0, -4.3459197])
    same(cntc.calculate(2, -1), 0, "a roller")
    on_roller = cntc.getcpresults(2, 1)
    same((on_roller["meta"]["rnom_whl"], on_roller["meta"]["rnom_rol"]), (460.0, 500.0), "radii on a roller")
    for ire, units in ((2, "un_si"), (3, "un_spck")):
        set_up(ire, 1, units)
        other = cntc.getcpresults(ire, 1)
        close(cntc.getparameters(ire, 1, 4)["nomradw"], 0.46, 1e-12, f"{units}: radius of the wheel")
        same(int(cntc.getflags(ire, -1, CNTC["if_units"])[0]), CNTC[units], f"{units}: units are as before")
        for name in ("x", "y", "pn", "px", "ux"):
            close(other[name], patch[name], 2e-4*np.abs(patch[name]).max(), f"{units}: {name} in mm, on the rail")
        for name in ("z_w", "zcp_r", "yaw_w", "deltcp_r"):
            close(other["meta"][name], patch["meta"][name], 1e-6, f"{units}: {name}")
    check("temp1" not in patch and "taucrt" not in patch, "fields of effects that did not act are absent")


def mirrored():
    """A left problem is the mirror image of the right one with opposite displacement and yaw"""
    set_up(1, 0)
    set_up(2, 1, y=-2.0, roll=0.0001128)
    left, right = cntc.getglobalforces(1, -1), cntc.getglobalforces(2, -1)
    close(left, right * MIRROR, 1e-6 * 2e5, "forces and moments")
    place_left, place_right = cntc.getcontactlocation(1, 1), cntc.getcontactlocation(2, 1)
    close(place_left[:3], place_right[:3] * [1, -1, 1], 1e-7, "contact location")
    close(place_left[[3, 8, 13]], -place_right[[3, 8, 13]], 1e-9, "contact angles")
    close(place_left[[7, 12]], place_right[[7, 12]], 1e-7, "arc lengths keep the sign of the mirrored problem")
    mx, my, x, y, dx, dy = cntc.getpotcontact(2, 1)
    close(cntc.getpotcontact(1, 1), [mx, my, x, -(y + (my - 1) * dy), dx, dy], 1e-7, "grid")
    same(cntc.getelementdivision(1, 1).tolist(), cntc.getelementdivision(2, 1)[::-1].tolist(), "element division")
    for name, sign in (("pn", 1), ("px", 1), ("py", -1), ("un", 1), ("ux", 1), ("uy", -1), ("sx", 1), ("sy", -1),
                       ("wx", 1), ("wy", -1), ("h", 1), ("mu", 1)):
        one, other = (cntc.getfielddata(ire, 1, CNTC["fld_" + name]) for ire in (1, 2))
        close(one, sign * other[::-1], 1e-7 * np.abs(other).max() + 1e-15, f"field {name}")
    close(cntc.getcreepages(1, 1), np.array(cntc.getcreepages(2, 1)) * [1, -1, -1], 1e-12, "creepages")
    close(cntc.getcontactforces(1, 1), np.array(cntc.getcontactforces(2, 1)) * [1, 1, -1, -1], 1e-3, "local forces")


def profile_values():
    """Profiles before and after loading, in all samplings"""
    rail, wheel = profiles()
    points_of_file, gauge_y = rail_points()
    cntc.initialize(1, 1)
    same(cntc.getprofilevalues(1, -1, [0, 0]), [CNTC["err_profil"], 1], "state before loading")
    room = np.full(3, 7.5)
    call("cntc_getprofilevalues", 1, 0, 2, np.array([0, 0]), 1, np.array([1.0]), 3, room)
    close(room, np.full(3, 7.5), 0, "a profile that is not loaded leaves the output")
    cntc.setprofileinputfname(1, rail, [0], [1.0, 0.0])
    cntc.setprofileinputfname(1, wheel, [1], [1.0, 0.0])
    same(cntc.getprofilevalues(1, -1, [0, 0])[0], 0, "state after loading")
    same(cntc.getprofilevalues(1, 0, [0, 0]), len(points_of_file), "points of the rail")
    for kind in (0, 1):
        count = cntc.getprofilevalues(1, 0, [kind, 0])
        for sampling in (-1, 0, 1, 5):
            points = cntc.getprofilevalues(1, 0, [kind, sampling], [0.7])
            table = cntc.getprofilevalues(1, 1, [kind, sampling], [0.7])
            length = cntc.getprofilevalues(1, 4, [kind, sampling], [0.7])
            angle = cntc.getprofilevalues(1, 5, [kind, sampling], [0.7])
            label = f"kind {kind}, sampling {sampling}"
            same((table.shape, length.shape, angle.shape), ((points, 2), (points,), (points,)), f"{label}: shapes")
            if sampling >= 0:
                check(bool(np.all(np.diff(length) > 0)), f"{label}: arc length grows")
            else:
                continue
            y_order = np.diff(table[:, 0])
            check(bool(np.all(y_order > -1e-6) or np.all(y_order < 1e-6)) or kind == 1, f"{label}: y is monotone")
            if sampling == 5:
                same(points, 5 * (count - 1) + 1, f"{label}: number of points")
            if sampling == 1:
                full = cntc.getprofilevalues(1, 4, [kind, 0])
                same(points, int(np.floor((full[-1] - full[0]) / 0.7)) + 1, f"{label}: number of points")
                close(np.diff(length), np.full(points - 1, 0.7), 1e-6, f"{label}: step")
    state = cntc.getprofilevalues(1, 1, [0, 7])
    check(state.shape[0] == 7 * (len(points_of_file) - 1) + 1, "seven parts per interval")
    cntc.finalize(1)
    set_up(2, 1)
    gauge = cntc.getprofilevalues(2, 3, [0, 0])
    close(gauge[:3], [gauge_y, 14.0, 717.5 - gauge_y], 2e-3, "gauge point and offset of the right rail")
    set_up(3, 0)
    gauge = cntc.getprofilevalues(3, 3, [0, 0])
    close(gauge[:3], [gauge_y, 14.0, gauge_y - 717.5], 2e-3, "gauge point and offset of the left rail")
    own, track = (cntc.getprofilevalues(2, task, [0, 0]) for task in (1, 2))
    offset = track - own
    close(offset, np.tile(offset[0], (len(own), 1)), 1e-6, "track coordinates are shifted, the rail is not turned")
    close(offset[0, 0], 717.5 - gauge_y, 2e-3, "shift of the rail profile")
    same(cntc.getprofilevalues(2, 3, [1, 0]), CNTC["err_profil"], "a wheel has no gauge point")


def slices():
    """A nose of a crossing in slices, with the rail placed absolutely; figures of version 25.2.0"""
    folder = os.path.join(os.path.dirname(REFERENCE), "testbank/profiles")
    if not os.path.isfile(os.path.join(folder, "cross_nose.slcs")):
        print("skipped: the profiles of the crossing are not here")
        sys.exit(77)
    cntc.initialize(1, 1)
    cntc.setflags(1, -1, [CNTC[name] for name in ("ic_config", "ic_tang", "ic_pvtime", "ic_discns")], [1, 3, 2, 2])
    cntc.setsolverflags(1, -1, 0, [999, 100, 30, 1], [1e-5])
    cntc.setmaterialparameters(1, -1, 0, [0.28, 0.28, 82e3, 82e3])
    cntc.setfrictionmethod(1, -1, 0, [0.3, 0.3])
    cntc.setpotcontact(1, -1, -1, [0.2, 0.05, np.pi / 2, 8.0, 4.0])
    cntc.setrollingstepsize(1, -1, 0.0, 1.0)
    cntc.settrackdimensions(1, 3, [-1.0, 750.0] + 9 * [0.0])
    cntc.setprofileinputfname(1, os.path.join(folder, "cross_nose.slcs"), [0, 0, 0, -1], [1.0, 0.0])
    cntc.setprofileinputfname(1, os.path.join(folder, "MBench_S1002_v3.prw"), [1, 0, 0, -1], [1.0, 0.0])
    cntc.setwheelsetdimensions(1, 3, [1360.0, -70.0, 460.0])
    cntc.setwheelsetposition(1, 1, [0, 0, -2.1275, 0, 0, 0])
    cntc.setwheelsetvelocity(1, 2, [2000.0, 0, 0, 0, 0, -4.3481181])
    cntc.setflags(1, -1, CNTC["ic_norm"], 0)
    same(cntc.calculate(1, -1), 0, "error code")
    close(cntc.getglobalforces(1, -1)[:3], [2814.0, -915.0, 10110.0], 0.002 * 10110, "forces")
    # lines u = 0.5 mm, v = line 40, y = 0.5 mm of the surface; v counts lines across the rail, whose distances are at most 0.5 mm
    across, on_line, along = (cntc.getprofilevalues(1, task, [0, 1], [step, place])
                              for task, step, place in ((6, 0.25, 0.5), (7, 0.5, 40.0), (8, 0.5, 0.5)))
    check(bool(np.all(across[:, 0] == 0.5)) and across.shape[1] == 3, "a line across the rail at x = 0.5")
    check(bool(np.all(along[:, 1] == 0.5)) and along.shape[1] == 3, "a line along the rail at y = 0.5")
    there = np.isfinite(across[:, 1])
    steps = np.hypot(*np.diff(across[there][:, 1:], axis=0).T)
    check(bool(np.all(steps < 0.13)) and steps.max() > 0.1, f"quarters of lines are a quarter of the distance: {steps.max()}")
    fine = cntc.getprofilevalues(1, 6, [0, 1], [0.01, 0.5])
    fine = fine[np.isfinite(fine[:, 1])]
    close(np.interp(0.5, fine[:, 1], fine[:, 2]), np.interp(0.5, along[:, 0], along[:, 2]), 1e-5, "two lines cross")
    close(across[4 * 40, 1:], [np.interp(0.5, on_line[:, 0], on_line[:, k]) for k in (1, 2)], 1e-4, "line 40 crosses")
    same(len(cntc.getprofilevalues(1, 6, [0, 1], [0.5, 0.5, 40.0, 45.0])), 11, "a part of a line")
    beside = cntc.getprofilevalues(1, 7, [0, 1], [1.0, -3.0])
    check(bool(np.all(np.isnan(beside[:, 1]))), "no points beside the surface")
    room = np.full(20, 7.5)
    call("cntc_getprofilevalues", 1, 7, 2, np.array([0, 1]), 4, np.array([0.5, 40.0, 0.0, 5.0]), 20, room)
    close(room, np.concatenate([np.arange(11) * 0.5, [np.interp(k * 0.5, on_line[:, 0], on_line[:, 1]) for k in range(9)]]), 1e-9,
          "an array that is too short for all points")
    cntc.getprofilevalues(1, 9, [0, 1])
    with open("dump_spl2d.m", encoding="utf-8") as file:
        dumped = file.read()
    number = [[float(word) for word in re.search(rf"group\({group}\)\.{name} = \[(.*?)\]", dumped, re.DOTALL).group(1).split()]
              for group in (1,) for name in ("knots", "v", "y")]
    same(len(number[2]), (len(number[0]) - 4) * len(number[1]), "coefficients of the written surface")
    cntc.settrackdimensions(1, 3, [14.0, 0.0, 1435.0] + 8 * [0.0])
    same(cntc.calculate(1, -1, idebug=0), CNTC["err_profil"], "a rail in slices has no gauge point")


def program_forces(name, folder="."):
    """Forces Fx, Fy, Fz in the track of all cases of an input file by the program, as printed"""
    os.makedirs("program", exist_ok=True)
    subprocess.run([os.environ["CONTACT_PROGRAM"], "--quiet", "--output-dir", "program", "2", os.path.join(folder, name)],
                   check=True)
    with open(f"program/{os.path.basename(name)}.out", encoding="utf-8") as file:
        lines = file.read().splitlines()
    return [[float(word) for word in lines[number + 1].split()[:3]] for number, line in enumerate(lines) if "FX(TR)" in line]


def compare_replay(name, forces, label, folder="."):
    """Cases that the library wrote as input give its forces in the program"""
    printed = program_forces(name, folder)
    same(len(printed), len(forces), f"{label}: cases of the program")
    for number, (row, force) in enumerate(zip(printed, forces), 1):
        # as many digits as are printed, the last ones of small components by the largest
        close(force, row, 5.1e-4 * np.abs(row) + 1e-6 * np.abs(row).max(), f"{label}, case {number}: forces of the program")


def replay():
    """Cases written as input give the same forces in the program, from folders of all kinds"""
    for number, (level, folder) in enumerate(((1, "."), (2, "."), (1, "dumps"), (2, os.path.abspath("dumps"))), 1):
        os.makedirs(folder, exist_ok=True)
        name = f"replay{number}"
        cntc.initlibrary(outdir=folder if folder != "." else "", expnam=name)
        set_up(1, 0)
        cntc.setflags(1, -1, [CNTC["if_wrtinp"], CNTC["ic_output"]], [level, 2])
        forces = []
        for y in (2.0, 1.0):
            cntc.setwheelsetposition(1, 1, [0, y, 0, 0, 0.0024 * y, 0])
            same(cntc.calculate(1, -1), 0, "error code")
            forces.append(cntc.getglobalforces(1, -1)[:3])
        cntc.finalize(1)
        compare_replay(name, forces, f"level {level} in {folder}", folder)
        # later runs keep the folder of results, unless they name another one
        cntc.initlibrary(outdir=os.getcwd(), expnam="between")
        cntc.finalizelast()


def replay_values():
    """Profiles given by values are written beside the input file that uses them"""
    shutil.rmtree("dumps", ignore_errors=True)
    os.makedirs("dumps")
    cntc.initlibrary(outdir="dumps", expnam="values")
    _rail, _wheel = profiles()
    set_up(1, 1)
    forces = [cntc.getglobalforces(1, -1)[:3]]
    cntc.setflags(1, -1, [CNTC["if_wrtinp"], CNTC["ic_output"]], [1, 2])
    for kind, factor in ((0, 1.0), (1, 1e-3)):
        table = cntc.getprofilevalues(1, 1, [kind, -1])
        cntc.setprofileinputvalues(1, table * factor, [kind, 0, 0, 0], [1.0 / factor, 0.0])
    same(cntc.calculate(1, -1), 0, "error code")
    by_values = cntc.getglobalforces(1, -1)[:3]
    close(by_values, forces[0], 2e-4 * 1e4, "the points of the file as values")
    forces[0] = by_values
    same(sorted(name for name in os.listdir("dumps") if name.startswith("caddon_re001")),
         ["caddon_re001.0002.rail.txt", "caddon_re001.0002.wheel.txt"], "files of the profiles")
    cntc.setwheelsetposition(1, 1, [0, 1.0, 0, 0, 0.0024, 0])
    same(cntc.calculate(1, -1), 0, "error code")
    forces.append(cntc.getglobalforces(1, -1)[:3])
    # a new table gets a new file
    cntc.setprofileinputvalues(1, cntc.getprofilevalues(1, 1, [0, -1]) + [0.0, 0.0], [0], [1.0, 0.0])
    same(cntc.calculate(1, -1), 0, "error code")
    forces.append(cntc.getglobalforces(1, -1)[:3])
    check(os.path.isfile("dumps/caddon_re001.0004.rail.txt"), "a new table is written to a separate file")
    check(not os.path.isfile("dumps/caddon_re001.0004.wheel.txt"), "the wheel keeps its file")
    cntc.finalize(1)
    compare_replay("values", forces, "profiles by values", "dumps")


def _flag(name, value):
    return lambda ire: cntc.setflags(ire, -1, CNTC[name], value)


#: What can be chosen for wheel and rail: settings before the first and before the second case
OPTIONS = {
    "F = 1": ([_flag("ic_force", 1), lambda ire: cntc.settangentialforces(ire, -1, -700.0, 0.0)], []),
    "F = 3": ([_flag("ic_force", 3), lambda ire: cntc.settrackdimensions(ire, 33, [5e3, 0.0, 8e4, 0.0, 0.5])], []),
    "T = 1": ([_flag("ic_tang", 1), _flag("ic_pvtime", 2)], []),
    "T = 2": ([_flag("ic_tang", 2)], [_flag("ic_pvtime", 0)]),
    "V = 1": ([lambda ire: cntc.setfrictionmethod(ire, -1, 10, [2, -0.2, 0.1, 0.1, 0.1, 0.4, 0.4])], []),
    "V = 2": ([lambda ire: cntc.setfrictionmethod(ire, -1, 20, [2, -100.0, 0.1, 0.1, 100.0, 0.4, 0.4])], []),
    "V = 1, L = 2": ([lambda ire: cntc.setfrictionmethod(ire, -1, 12, [
        2, -0.2, 0.2, 0.1, 100.0, 0.05, 50.0, 0.001, 10.0, 0.2, 0.3, 0.1, 100.0, 0.05, 50.0, 0.001, 10.0])], []),
    "L = 2": ([lambda ire: cntc.setfrictionmethod(ire, -1, 2, [0.2, 0.1, 100.0, 0.05, 50.0, 0.001, 10.0])], []),
    "L = 3": ([lambda ire: cntc.setfrictionmethod(ire, -1, 3, [0.2, 0.1, 100.0, 0.05, 50.0, 0.001, 10.0])], []),
    "L = 4": ([lambda ire: cntc.setfrictionmethod(ire, -1, 4, [0.2, 0.1, 100.0, 0.05, 50.0, 0.001, 10.0])], []),
    "L = 5": ([lambda ire: cntc.setfrictionmethod(ire, -1, 5, [0.4, 0.5, 1e-2])], []),
    "L = 6, H = 3": ([lambda ire: cntc.setfrictionmethod(ire, -1, 6, [0.4, 0.0, -0.2, 100.0, 0.001, 10.0]),
                      lambda ire: cntc.settemperaturedata(ire, -1, 3, 2 * [20.0, 450.0, 0.05, 7.85e-6] + [1.0])], []),
    "M = 2": ([lambda ire: cntc.setmaterialparameters(ire, -1, 2, [0.28, 0.28, 82e3, 82e3, 6e-5, 1.0, 1.0, 1.0])], []),
    "M = 3": ([lambda ire: cntc.setmaterialparameters(ire, -1, 3, [0.28, 0.28, 82e3, 82e3, 0.5, 1.0, 1.0])], []),
    "M = 4": ([lambda ire: cntc.setmaterialparameters(ire, -1, 4, [0.28, 0.28, 82e3, 82e3, 4e3, 0.2, 0.0, 0.0])], []),
    "M = 5": ([lambda ire: cntc.setmaterialparameters(ire, -1, 5, [0.28, 0.28, 82e3, 82e3, 0.5, 1.0, 1.0])], []),
    "M2 = 2": ([_flag("ic_tang", 2), lambda ire: cntc.setmaterialparameters(ire, -1, 12, [1e-3, 1e-3, 1e9, 1e9])],
               [_flag("ic_pvtime", 0)]),
    "D = 3": ([_flag("ic_discns", 3)], []), "D = 4": ([_flag("ic_discns", 4)], []),
    "D = 5": ([_flag("ic_discns", 5)], []), "D = 6": ([_flag("ic_discns", 6)], []),
    "D = 7": ([_flag("ic_discns", 7)], []),
    "B = 5": ([_flag("ic_bound", 5)], []), "B = 6": ([_flag("ic_bound", 6)], []),
    "C = 3": ([_flag("ic_inflcf", 3)], []),
    "G = 2": ([lambda ire: cntc.setsolverflags(ire, -1, 2, [999, 100, 30, 1, 0], [1e-6, 0.9, 1.0, 0.5])], []),
    "E = 5": ([lambda ire: cntc.setwheelsetflexibility(ire, 5, [0, 0.3, 0, 1e-3, 1e-3, 0, 0, 3.0, 0, 0, 0, 0.01])], []),
    "rail deviations": ([lambda ire: cntc.settrackdimensions(ire, 2, [0.5, 0.1, 5e-3, 1.0, 0.0, 0.0])], []),
    "cant": ([lambda ire: cntc.settrackdimensions(ire, 1, [14.0, 0.0, 1435.0, 0.025, 0.0])], []),
    "curve": ([lambda ire: cntc.settrackdimensions(ire, 1, [14.0, 0.0, 1435.0, 0.0, 0.0, 2e-6])], []),
    "N = 0": ([_flag("ic_norm", 0), lambda ire: cntc.setwheelsetposition(ire, 1, [0, 2.0, 0.16, 0, 0.0048, 0])], []),
    "roller": ([_flag("ic_config", 4), lambda ire: cntc.settrackdimensions(ire, 1, [14.0, 0.0, 1435.0, 0.0, 500.0]),
                lambda ire: cntc.setwheelsetvelocity(ire, 2, [4.0, 0, 0, 0, 0, -4.35])], []),
}


def forces_without_damping(ire):
    """Forces in the track as the program prints them, of flat patches"""
    total = np.zeros(3)
    for icp in range(1, cntc.getnumcontactpatches(ire) + 1):
        (fn, tx, ty, _), angle = cntc.getcontactforces(ire, icp), cntc.getcontactlocation(ire, icp)[3]
        total += [tx, ty * np.cos(angle) - fn * np.sin(angle), fn * np.cos(angle) + ty * np.sin(angle)]
    return total


def options():
    """Every choice for wheel and rail acts, and is written into input files with the same effect"""
    set_up(999, 0)
    plain = cntc.getglobalforces(999, -1)[:3]
    cntc.finalize(999)
    for number, (name, (first, second)) in enumerate(OPTIONS.items(), 1):
        dump = f"option{number}"
        cntc.initlibrary(expnam=dump)
        set_up(1, 0)
        cntc.setflags(1, -1, [CNTC["if_wrtinp"], CNTC["ic_output"], CNTC["if_ncase"]], [2, 2, 1])
        forces = []
        for setting in first:
            setting(1)
        for index in range(2):
            if index == 1:
                for setting in second:
                    setting(1)
                cntc.setwheelsetposition(1, 1, [0.8, 1.8, 0.16, 0, 0.0043, 0])
            code, reason = cntc.calculate(1, -1, idebug=0), last_error(1, -1)[1]
            same(code, 0, f"{name}: error code of case {index + 1} ({reason})")
            forces.append(cntc.getglobalforces(1, -1)[:3])
        # without the choice all digits are the same; G = 2 only makes the default solver more accurate than EPS
        check(np.abs(forces[0] - plain).max() > 1e-6, f"{name} acts: {forces[0]} instead of {plain}")
        if name == "M2 = 2":
            elastic = forces_without_damping(1)
            check(np.abs(forces[1] - elastic).max() > 1.0, "the forces of the library include damping")
            forces[1] = elastic
        cntc.finalize(1)
        compare_replay(dump, forces, name)


def _cases_of(name):
    """The cases of an input file of module 1 as separate texts, with full names of the profiles"""
    bank = os.path.join(os.path.dirname(REFERENCE), "testbank")
    if not os.path.isdir(bank):
        print("skipped: the reference files are not here")
        sys.exit(77)
    with open(os.path.join(bank, name + ".inp"), encoding="utf-8") as file:
        text = re.sub(r"'\.\./profiles/", "'" + os.path.join(bank, "profiles") + "/", file.read())
    with open(os.path.join(bank, name + ".ref_out"), encoding="utf-8") as file:
        lines = file.read().splitlines()
    forces = [[float(word) for word in lines[number + 1].split()[:3]] for number, line in enumerate(lines) if "FX(TR)" in line]
    starts = [match.start() for match in re.finditer(r"^ *1 +MODULE", text, re.MULTILINE)]
    return [text[one:other] for one, other in zip(starts, starts[1:] + [None])], forces


def _move_wheelset(ire, text):
    """A later case: the position, perhaps the velocity, by routines; all else is kept"""
    rows = [line.split("%")[0].split() for line in text.splitlines()[1:] if line.split("%")[0].strip()]
    force_is_given, wheelset = rows[0][0][-3] == "1", int(rows[1][0][-1])
    numbers = [[np.radians(float(word[:-1])) if word.endswith("d") else float(word) for word in row[:6]]
               for row in rows[3:3 + wheelset]]
    if force_is_given:
        cntc.setverticalforce(ire, numbers[0][2])
    cntc.setwheelsetposition(ire, wheelset, numbers[0])
    if wheelset == 2:
        cntc.setwheelsetvelocity(ire, wheelset, numbers[1])


def varying():
    """Rails and wheels in slices, case after case with digits that keep what was given; figures of version 25.2.0

    As in the published test of varying profiles. With the argument all: every case of the files.
    """
    most = None if "all" in sys.argv else 3
    for ire, name in enumerate(("s+c/cross_locus", "s+c/wing_locus", "s+c/mbench_brute", "s+c/mbench_intrup", "s+c/mbench_locus",
                                "oor/rounded_flat_d09"), 1):
        cases, expected = _cases_of("examples_" + name)
        same(len(expected), len(cases), f"{name}: cases of the reference")
        cntc.initialize(ire, 1)
        worst = 0.0
        for number, (text, forces) in enumerate(zip(cases[:most], expected), 1):
            if number == 1:
                with open("one.inp", "w", encoding="utf-8") as file:
                    file.write(text)
                same(cntc.readinpfile(ire, CNTC["inp_modul1"], "one.inp"), 0, f"{name}: readinpfile")
            else:
                _move_wheelset(ire, text)
            same(cntc.calculate(ire, -1), 0, f"{name} {number}: error code")
            got = cntc.getglobalforces(ire, -1)[:3]
            tolerance = 0.002 * np.abs(forces).max()
            worst = max(worst, np.abs(got - forces).max() / tolerance)
            close(got, forces, tolerance, f"{name} {number}: forces")
            # what is kept must not change anything
            cntc.setfrictionmethod(ire, -1, 1, [])
            cntc.setmaterialparameters(ire, -1, 11, [])
            cntc.settrackdimensions(ire, 0, [])
            cntc.setwheelsetdimensions(ire, 0, [])
            cntc.setsolverflags(ire, -1, 1)
            cntc.setflags(ire, -1, [CNTC["ic_discns"], CNTC["ic_inflcf"]], [1, 1])
            if number == 1:
                same(cntc.calculate(ire, -1), 0, f"{name}, the first case again: error code")
                close(cntc.getglobalforces(ire, -1)[:3], got, 1e-4 * np.abs(got).max(), f"{name}: the first case again")
        print(f"{name}: {len(cases[:most])} cases, forces within {worst:.2f} of their tolerance")


def from_inputs():
    """The first case of input files: by the library and by the program"""
    names = [os.path.join(SOURCE, "examples", name) for name in ("wheel_on_rail", "roller_rig", "single_wheel")]
    bank = os.path.join(os.path.dirname(REFERENCE), "testbank")
    for name in ("examples_s+c/cross_locus", "examples_s+c/wing_locus", "examples_trans/m1_steady_roll"):
        if os.path.isfile(os.path.join(bank, name + ".inp")):
            names.append(os.path.join(bank, name))
        else:
            print(f"skipped: {name} is not here")
    for ire, name in enumerate(names, 1):
        label = os.path.basename(name)
        cntc.initialize(ire, 1)
        same(cntc.readinpfile(ire, CNTC["inp_modul1"], name + ".inp"), 0, f"{label}: readinpfile")
        same(cntc.calculate(ire, -1), 0, f"{label}: error code")
        forces = cntc.getglobalforces(ire, -1)
        printed = program_forces(name)[0]
        close(forces[[0, 1, 2]], printed, 5.1e-4 * np.abs(printed), f"{label}: forces to the printed digits")
        if os.path.isfile(name + ".toml"):
            other = 100 + ire
            cntc.initialize(other, 1)
            same(cntc.readinpfile(other, CNTC["inp_modul1"], name + ".toml"), 0, f"{label}: the readable format")
            same(cntc.calculate(other, -1), 0, f"{label}: error code of the readable format")
            same(list(cntc.getglobalforces(other, -1)), list(forces), f"{label}: forces of the readable format")
    for name, kind, reason in (("cattaneo", "inp_modul1", "module 1"), ("roller_rig", "inp_spck", "readable format")):
        same(cntc.readinpfile(1, CNTC[kind], os.path.join(SOURCE, "examples", name + ".toml")), CNTC["err_input"], name)
        check(reason in last_error(1, -1)[1], f"{name}.toml is refused by name")
    with open("wrong.toml", "w", encoding="utf-8") as file, \
            open(os.path.join(SOURCE, "examples/wheel_on_rail.toml"), encoding="utf-8") as right:
        file.write(right.read().replace("cant = 0.025", "cant = 25.0", 1))
    same(cntc.readinpfile(1, CNTC["inp_modul1"], "wrong.toml"), CNTC["err_input"], "a cant of 25 rad")
    check(re.search(r"wrong.toml:\d+:\d+: cant = 25.0 is above", last_error(1, -1)[1]),
          "a cant of 25 rad is reported with its position")
    same(cntc.readinpfile(1, CNTC["inp_modul1"], "no_such_file.inp"), CNTC["err_input"], "a missing file")
    same(cntc.readinpfile(1, CNTC["inp_vamp"], "no_such_file.inp"), CNTC["err_input"], "an unknown kind")


def changed_folder():
    """The host changes its current folder between settings and calculations: files written as input name what was read"""
    start = os.getcwd()
    for number, outdir in enumerate(("", os.path.join(start, "results"))):
        name, folder = f"moved{number}", os.path.join(start, f"host{number}")
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(os.path.join(folder, "other"))
        os.makedirs(outdir or ".", exist_ok=True)
        os.chdir(folder)
        shutil.copy(profiles()[0], "near.prr")
        cntc.initlibrary(outdir=outdir, expnam=name)
        set_up(1, 1)
        cntc.setprofileinputfname(1, "near.prr", [0], [1.0, 0.0])
        cntc.setflags(1, -1, [CNTC["if_wrtinp"], CNTC["ic_output"]], [1, 2])
        forces = []
        for place, force in ((folder, 1e4), (os.path.join(folder, "other"), 2e4), (os.path.join(folder, "other"), 3e4)):
            os.chdir(place)
            cntc.setverticalforce(1, force)
            same(cntc.calculate(1, -1), 0, f"{name}: error code")
            forces.append(cntc.getglobalforces(1, -1)[:3])
            # the last case has a profile by values, which is written beside the input file
            cntc.setprofileinputvalues(1, cntc.getprofilevalues(1, 1, [1, -1]), [1], [1.0, 0.0])
        cntc.finalizelast()
        os.chdir(start)
        compare_replay(name, forces, name, outdir or folder)


def keep_all(ire):
    """All digits of the next input file say that their groups are kept"""
    cntc.setfrictionmethod(ire, -1, 1, [])
    cntc.setmaterialparameters(ire, -1, 11, [])
    cntc.settrackdimensions(ire, 0, [])
    cntc.setwheelsetdimensions(ire, 0, [])
    cntc.setsolverflags(ire, -1, 1)
    cntc.setflags(ire, -1, [CNTC["ic_discns"], CNTC["ic_inflcf"]], [1, 1])


def written_changes():
    """What changes after digits that keep everything, or before them, is in the input file that the library writes"""
    wheel = profiles()[1]
    flexible = [0.5, 0.5, 0.2, 0.001, 0.001] + 7 * [0.0]
    changes = {
        "vertical force": lambda: cntc.setverticalforce(1, 15000.0),
        "friction": lambda: cntc.setfrictionmethod(1, -1, 0, [0.2, 0.2]),
        "friction by its angle": lambda: cntc.setfrictionmethod(1, -1, 10, [2, 0.0, 0.3, 0.3, 0.8, 0.1, 0.1]),
        "material": lambda: cntc.setmaterialparameters(1, -1, 0, [0.3, 0.3, 7e4, 7e4]),
        "Fastsim": lambda: cntc.setmaterialparameters(1, -1, 3, [0.28, 0.28, 8e4, 8e4, 0.5, 0.8, 1.0]),
        "full theory": lambda: cntc.setmaterialparameters(1, -1, 0, [0.28, 0.28, 8e4, 8e4]),
        "flexibility": lambda: cntc.setwheelsetflexibility(1, 4, flexible),
        "no flexibility": lambda: cntc.setwheelsetflexibility(1, 1, [0]),
        "track": lambda: cntc.settrackdimensions(1, 1, [14.0, 0.0, 1434.0, 0.01, 0.0]),
        "deviations": lambda: cntc.settrackdimensions(1, 2, [0.5, 0.2, 0.001, 1.0, 0.0, 0.0]),
        "track and deviations": lambda: cntc.settrackdimensions(1, 3, [14.0, 0.0, 1435.0, 0.0, 0.0, 0.2] + 5 * [0.0]),
        "wheelset": lambda: cntc.setwheelsetdimensions(1, 3, [1360.5, -70.0, 461.0]),
        "velocity": lambda: cntc.setwheelsetvelocity(1, 2, [2000, 3.0, 0, 0, 0, -4.35]),
        "elements": lambda: cntc.setpotcontact(1, -1, -1, [0.9, 0.8, np.pi / 2, 8, 4]),
        "search": lambda: cntc.setflags(1, -1, [CNTC["ic_discns"]], [4]),
        "rail": lambda: cntc.setprofileinputvalues(1, cntc.getprofilevalues(1, 1, [0, -1]) * [1.0, 1.05], [0], [1.0, 0.0]),
        "wheel": lambda: cntc.setprofileinputfname(1, wheel, [1], [1.0, 5.0]),
        "longitudinal force": lambda: (cntc.settangentialforces(1, -1, 300.0, 0.0),
                                       cntc.setflags(1, -1, [CNTC["ic_force"]], [1])),
        "pitch rate": lambda: (cntc.setwheelsetvelocity(1, 2, [2000, 2.0, 0, 0, 0, -4.34]),
                               cntc.setflags(1, -1, [CNTC["ic_force"]], [0])),
        "height": lambda: (cntc.setwheelsetposition(1, 1, [0, 2.0, cntc.getwheelsetposition(1)[2] + 0.01, 0, 0.0048, 0]),
                           cntc.setflags(1, -1, [CNTC["ic_norm"]], [0]))}
    for level, kept_last in ((1, False), (1, True), (2, False)):
        name = f"changes{level}{kept_last}"
        cntc.initlibrary(expnam=name)
        # a case before is not written: the first one of the file must not refer to it
        set_up(1, 1)
        cntc.setflags(1, -1, [CNTC["if_wrtinp"], CNTC["ic_output"]], [level, 2])
        forces = []
        for what, change in changes.items():
            if not kept_last:
                keep_all(1)
            change()
            if kept_last:
                keep_all(1)
            same(cntc.calculate(1, -1), 0, f"{what}: error code ({last_error(1, -1)[1]})")
            forces.append(cntc.getglobalforces(1, -1)[:3])
            check(len(forces) < 2 or np.abs(forces[-1] - forces[-2]).max() > 0.3, f"{what} acts")
        # another result element with this number, in the same file; its solver is that of dissimilar bodies
        cntc.initialize(2, 1)
        cntc.setwheelsetflexibility(1, 4, flexible)
        same(cntc.calculate(1, -1), 0, "a flexible wheelset: error code")
        forces.append(cntc.getglobalforces(1, -1)[:3])
        cntc.finalize(1)
        set_up(1, 1)
        cntc.setflags(1, -1, [CNTC["if_wrtinp"], CNTC["ic_output"]], [level, 2])
        cntc.setmaterialparameters(1, -1, 0, [0.28, 0.28, 82e3, 41e3])
        same(cntc.calculate(1, -1), 0, "a new result element: error code")
        forces.append(cntc.getglobalforces(1, -1)[:3])
        cntc.finalizelast()
        compare_replay(name, forces, name)


def simpack_file():
    """A file of the Simpack user routine: what it gives acts as the same settings by routines, what it keeps are those before it"""
    rail, wheel = profiles()
    head = ("0 MODULE", "1203000", "00220{}", "0000001", "999 100 30 1 1e-5", "0.2 0.2", "0.28 0.28 82000 82000",
            "0.6 0.6 1 90d 8 4")
    track = f" 14 0 1435 0.02\n '{rail}' 0 1 0\n 0.5 0 0 0 0 0\n"
    wheelset = f" 1360 -70 460\n '{wheel}' 0 1 0\n 0 1.5 0.2 0 0.003 0\n 2000 0 0 0 0 -4.34\n"
    for side, digits in ((1, "00"), (1, "03"), (1, "30"), (1, "33"), (0, "00"), (5, "00")):
        label = f"C1 = {side}, Z and E {digits}"
        with open("spck.inp", "w", encoding="utf-8") as file:
            file.write("\n".join((*head, "")).replace("{}", digits) + track * (digits[0] == "3") + wheelset * (digits[1] == "3"))
        for ire in (1, 2):
            set_up(ire, 1 if side == 5 else side)
            if side == 5:
                cntc.setflags(ire, -1, [CNTC["ic_config"]], [side])
                cntc.settrackdimensions(ire, 3, [14.0, 0.0, 1435.0, 0.02, 500.0] + 7 * [0.0])
                cntc.setwheelsetvelocity(ire, 2, [4.0, 0, 0, 0, 0, -4.3459197])
        same(cntc.readinpfile(1, CNTC["inp_spck"], "spck.inp"), 0, f"{label}: readinpfile ({last_error(1, -1)[1]})")
        cntc.setfrictionmethod(2, -1, 0, [0.2, 0.2])
        cntc.setpotcontact(2, -1, -1, [0.6, 0.6, np.pi / 2, 8, 4])
        if digits[0] == "3":
            cntc.settrackdimensions(2, 3, [14.0, 0.0, 1435.0, 0.02, 0.0, 0.5] + 5 * [0.0])
        if digits[1] == "3":
            cntc.setwheelsetposition(2, 1, [0, 1.5, 0, 0, 0.003, 0])
            cntc.setwheelsetvelocity(2, 2, [2000, 0, 0, 0, 0, -4.34])
        forces = []
        for ire in (1, 2):
            same(cntc.calculate(ire, -1), 0, f"{label}: error code of element {ire}")
            forces.append(cntc.getglobalforces(ire, -1)[:3])
            same(list(cntc.getflags(ire, -1, [CNTC["ic_config"], CNTC["ic_norm"]])), [side, 1], f"{label}: kept digits")
        close(forces[0], forces[1], 0.1, f"{label}: forces")


if __name__ == "__main__":
    scenarios = (conventions, patch_as_in_matlab, mirrored, profile_values, slices, replay, replay_values, options, varying,
                 from_inputs, simpack_file, written_changes, changed_folder)
    chosen = [scenario for scenario in scenarios if scenario.__name__ in sys.argv[1:]]
    if not chosen:
        raise SystemExit("usage: wheel_rail.py " + " | ".join(scenario.__name__ for scenario in scenarios))
    chosen[0]()
    finish()
