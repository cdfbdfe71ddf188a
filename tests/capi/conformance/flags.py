#!/usr/bin/env python3
"""Every flag with every value within and around its range: the stored value, refused values, the effect on a calculation"""
import ctypes
import ctypes.util
import os
import re

import numpy as np
from checks import SOURCE, check, close, finish, profiles, same
from contact import cntc
from contact._library import call, last_error
from contact.cntc import CNTC

# Lowest and highest value, and the treatment of others: "near" the nearest of the range, "zero" 0, "keep" nothing is stored
FLAGS = {"ic_config": (0, 5, "near"), "ic_pvtime": (0, 3, "near"), "ic_bound": (0, 6, "near"), "ic_tang": (0, 3, "near"),
         "ic_norm": (0, 1, "near"), "ic_force": (0, 3, "near"), "ic_discns": (0, 9, "keep"), "ic_inflcf": (0, 4, "keep"),
         "ic_iestim": (0, 3, "near"), "ic_output": (0, 6, "near"), "ic_flow": (0, 9, "near"), "ic_return": (0, 3, "near"),
         "ic_matfil": (0, 2, "zero"), "ic_sens": (0, 3, "near"), "ic_ifmeth": (0, 1, "near"), "ic_ifvari": (1, 4, "near"),
         "ic_sbsout": (0, 4, "near"), "ic_sbsfil": (0, 2, "zero"), "ic_npomax": (100, 1000000, "near"), "if_wrtinp": (0, 2, "keep"),
         "own_heat": (0, 1, "keep"), "own_angle": (0, 1, "keep"), "own_classical": (0, 1, "keep"), "own_order": (1, 2, "keep"),
         "own_errors": (0, 1, "keep"), "own_accuracy": (0, 1000000, "keep")}
# Flags that belong to wheel and rail: module 3 does not store them
OF_PAIRS = {"ic_config", "ic_discns", "own_angle"}
# Values within the range that are not digits or not available, but are stored
UNKNOWN = {"ic_config": (2, 3), "ic_bound": (2, 3, 4)}


def read(ire, icp, name):
    return int(cntc.getflags(ire, icp, [CNTC[name]])[0])


def values_of(low, high):
    near = {low - 100, low - 2, low - 1, low, low + 1, high - 1, high, high + 1, high + 2, high + 100}
    return sorted(near | set(range(low, high + 1)) if high < 100 else near)



def documents():
    """The manual lists the flags that store another value than the given one"""
    with open(os.path.join(SOURCE, "doc/user/library.md"), encoding="utf-8") as file:
        listed = file.read().split("replaced by the nearest valid value", 1)[1].split(".", 1)[0].split(":", 1)[1]
    near, zero = (re.sub(r", 3 becomes 2", "", part).replace(" and ", ", ").split(",") for part in listed.split(";"))
    with open(os.path.join(SOURCE, "src/capi/interface.txt"), encoding="utf-8") as file:
        letters = dict(re.findall(r"^CNTC_(ic_\w+) = \d+  ([A-Z]\d?): ", file.read(), re.MULTILINE))
    # E of module 3 cannot be read, see ranges
    outside = {name: row[2] for name, row in FLAGS.items()} | {"ic_exrhs": "near"}
    for words, rule in ((near, "near"), (zero, "zero")):
        expected = sorted(name for name in outside if outside[name] == rule)
        found = sorted(name for name in outside for word in words
                       if f"`{name}`" in word or word.split() == [letters.get(name)])
        same(found, expected, f"flags that doc/user/library.md names, {rule}")
        same(len(words), len(expected), f"number of flags in doc/user/library.md, {rule}")


def ranges():
    """One flag after the other on an element of each module: the flag itself, and no other one, changes"""
    for ire, module in ((1, 1), (2, 3)):
        same(cntc.initialize(ire, module)[1], 0, f"initialize module {module}")
        icp = -1 if module == 1 else 1
        for name, (low, high, outside) in FLAGS.items():
            if name == "ic_force" and module == 3:
                high = 2
            before = {other: read(ire, icp, other) for other in FLAGS}
            stored = before[name]
            for value in values_of(low, high):
                cntc.setflags(ire, icp, [CNTC[name]], [value])
                expected = value
                if not low <= value <= high:
                    expected = {"near": min(max(value, low), high), "zero": 0, "keep": stored}[outside]
                if name == "ic_sbsout" and expected == 3:
                    expected = 2
                if (module == 3 and name in OF_PAIRS) or (module == 1 and name == "ic_force" and expected == 2):
                    expected = stored
                if name == "own_accuracy" and 0 < value < 10:
                    expected = stored
                if module == 3 and name == "ic_npomax":
                    expected = 0
                stored = read(ire, icp, name)
                same(stored, expected, f"module {module}: {name} = {value}")
            for other in FLAGS:
                if other != name:
                    same(read(ire, icp, other), before[other], f"module {module}: {other} after {name}")
            cntc.setflags(ire, icp, [CNTC[name]], [before[name]])
            # a refused value does not keep the others back
            cntc.finalize(ire)
            cntc.initialize(ire, module)
    # one entry after the other, those of code 0 are skipped, unknown ones do not stop the rest
    cntc.initialize(3, 3)
    cntc.setflags(3, 1, [CNTC["ic_tang"], 0, 4711, CNTC["ic_norm"]], [2, 5, 6, 1])
    check("4711" in last_error(3, 1)[1], "an unknown flag is named")
    same([read(3, 1, "ic_tang"), read(3, 1, "ic_norm")], [2, 1], "others of the list")
    values = np.array([-5, -6, -7], np.intc)
    call("cntc_getflags", 3, 1, 3, np.array([CNTC["ic_tang"], 0, CNTC["ic_norm"]], np.intc), values)
    same(list(values), [2, -6, 1], "entries of code 0")


def pair(ire):
    """A wheel on a rail, some thirty elements"""
    same(cntc.initialize(ire, 1)[1], 0, f"initialize {ire}")
    cntc.setflags(ire, -1, [CNTC[name] for name in ("ic_config", "ic_tang", "ic_pvtime", "ic_discns")], [1, 3, 2, 2])
    cntc.setsolverflags(ire, -1, 0, [999, 100, 30, 1], [1e-5])
    cntc.setmaterialparameters(ire, -1, 0, [0.28, 0.28, 82e3, 82e3])
    cntc.setfrictionmethod(ire, -1, 0, [0.3, 0.3])
    cntc.setpotcontact(ire, -1, -1, [1.0, 1.0, np.pi / 2, 8, 4])
    cntc.setrollingstepsize(ire, -1, 0.0, 1.0)
    cntc.settrackdimensions(ire, 3, [14.0, 0.0, 1435.0] + 8 * [0.0])
    rail, wheel = profiles()
    cntc.setprofileinputfname(ire, rail, [0], [1.0, 0.0])
    cntc.setprofileinputfname(ire, wheel, [1], [1.0, 0.0])
    cntc.setwheelsetdimensions(ire, 3, [1360.0, -70.0, 460.0])
    cntc.setwheelsetposition(ire, 1, [0, 2.0, 0, -0.0001, 0.0048, 0])
    cntc.setwheelsetvelocity(ire, 2, [2000, 0, 0, 0, 0, -4.3459197])
    cntc.setverticalforce(ire, 10000.0)


def unknown():
    """Values within the range for which there is no digit: the calculation reports it, and succeeds again with a valid one"""
    pair(4)
    same(cntc.calculate(4, -1), 0, "a good case")
    force = cntc.getglobalforces(4, -1)[0]
    for name, values in UNKNOWN.items():
        good = read(4, -1, name)
        for value in values:
            cntc.setflags(4, -1, [CNTC[name]], [value])
            check(cntc.calculate(4, -1) < 0, f"{name} = {value} is refused")
            text = last_error(4, -1)[1]
            digit = {"ic_config": "C1", "ic_bound": "B"}[name]
            check(f"{digit} = {value} is not a known digit of wheel-rail contact" in text, f"{name} = {value}: {text}")
        cntc.setflags(4, -1, [CNTC[name]], [good])
        same(cntc.calculate(4, -1), 0, f"{name} as it was")
        # pressures start from those of the last case, and end within EPS of the vertical force
        close(cntc.getglobalforces(4, -1)[0], force, 1e-5*1e4, f"{name} as it was: force")
    cntc.setpotcontact(4, -1, -1, [0.0, 1.0, np.pi / 2, 8, 4])
    check(cntc.calculate(4, -1) < 0, "elements without length")


def solvers():
    """G = 3 through the routines: the default solver unless the flag asks for the sweeps; both agree within the tolerance"""
    pair(7)
    cntc.setsolverflags(7, -1, 0, [999, 100, 30, 1], [1e-4])
    forces = {}
    for digit, classical in ((0, 0), (3, 0), (3, 1), (0, 1)):
        cntc.setsolverflags(7, -1, digit, [999, 100, 30, 1] + [0]*(digit == 3), [1e-4] + [0.9, 1.0, 0.5]*(digit == 3))
        cntc.setflags(7, -1, [CNTC["own_classical"]], [classical])
        same(cntc.calculate(7, -1), 0, f"G = {digit}, classical {classical}: {last_error(7, -1)}")
        forces[digit, classical] = np.array(cntc.getcontactforces(7, 1)[:3])
    close(forces[0, 0], forces[0, 1], 1e-4*1e4, "the flag is for other solvers than the default one")
    check((forces[3, 0] != forces[3, 1]).any(), "the flag acts")
    # the tolerance is relative to the tractions as a whole
    check(np.abs(forces[3, 1] - forces[3, 0]).max() < 1e-3*np.abs(forces[3, 0]).max(), f"the solvers agree: {forces}")
    cntc.finalize(7)


def rollers():
    """A roller needs its radius, and is solved with it"""
    pair(5)
    cntc.setflags(5, -1, [CNTC["ic_config"]], [5])
    check(cntc.calculate(5, -1) < 0, "a roller without a radius is refused")
    check("nominal radius of the roller" in last_error(5, -1)[1], "the radius is required")
    cntc.settrackdimensions(5, 3, [14.0, 0.0, 1435.0, 0.0, 500.0] + 6 * [0.0])
    same(cntc.calculate(5, -1), 0, f"a roller with its radius: {last_error(5, -1)}")


def refused_in_parts():
    """Track and deviations that were refused together are corrected together, or one after the other"""
    pair(6)
    nan = float("nan")
    track, deviations = [14.0, 0.0, 1435.0, 0.0, 0.0], [0.0] * 6
    for cures in ([(3, track + deviations)], [(1, track), (2, deviations)], [(2, deviations), (1, track)]):
        for wrong in ([nan] + track[1:] + deviations, track + [nan] + deviations[1:]):
            cntc.settrackdimensions(6, 3, wrong)
            for method, values in cures:
                check(cntc.calculate(6, -1) < 0, f"refused before method {method}")
                cntc.settrackdimensions(6, method, values)
            same(cntc.calculate(6, -1), 0, f"healed by {[method for method, _ in cures]}: {last_error(6, -1)}")


def threads():
    """The largest number of threads is the present one of OpenMP; it increases with the number that a host sets in OpenMP"""
    openmp = ctypes.CDLL(ctypes.util.find_library("gomp"), mode=ctypes.RTLD_GLOBAL)
    first = call("cntc_getmaxnumthreads")
    for number in (first + 2, first + 5):
        openmp.omp_set_num_threads(number)
        same(call("cntc_getmaxnumthreads"), number, "threads of OpenMP")
    openmp.omp_set_num_threads(1)
    same(call("cntc_getmaxnumthreads"), first + 5, "earlier threads remain")


documents()
ranges()
unknown()
solvers()
rollers()
refused_in_parts()
threads()
finish()
