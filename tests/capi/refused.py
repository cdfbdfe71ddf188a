#!/usr/bin/env python3
"""Results after a refused case: those of the case before, whatever was set for the refused one.

Contacts and wheels are solved, then settings change and a case is refused, in different places: before the solution, by rules
between settings, by files, by the search for contact. All getters, and stresses below the surface, give the same values as before.
"""
import contextlib
import os
import sys
import warnings

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import changes
from changes import PROFILES, RADIUS, SPEED, check, contact
from contact import cntc

warnings.simplefilter("ignore")
#: Getters of results by element and patch
GETTERS = ("getreferencevelocity", "gethertzcontact", "getnumelements", "getgriddiscretization", "getpotcontact", "getpenetration",
           "getcreepages", "getcontactforces", "getcontactpatchareas", "getmaximumpressure", "getmaximumtraction",
           "getmaximumtemperature", "geterrors", "getwear", "getelementdivision", "gettractions", "getdisplacements",
           "getmicroslip", "getsensitivities")
POINTS = ([0.0, 0.5], [-0.5, 0.3], [0.5, 1.0])


def flat(value):
    """All numbers of a result"""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, (tuple, list)):
        return np.concatenate([flat(part) for part in value]) if value else np.zeros(0)
    if value is None or isinstance(value, str):
        return np.zeros(0)
    return np.ravel(np.asarray(value, dtype=float))


def look(ire, wheel):
    """Values of all getters of results"""
    seen = {}
    patches = range(1, cntc.getnumcontactpatches(ire) + 1) if wheel else (1,)
    for icp in patches:
        check(cntc.subs_calculate(ire, icp, 0) == 0, "stresses below the surface")
        seen["subs_getresults", icp] = flat(cntc.subs_getresults(ire, icp, 1, list(range(1, 13))))
        for name in GETTERS + (("getcontactlocation", "getglobalforces") if wheel else ()):
            seen[name, icp] = flat(getattr(cntc, name)(ire, icp))
    if wheel:
        seen["sum of forces", 0] = flat(cntc.getglobalforces(ire, -1))
    return seen


def compare(before, after, label):
    check(before.keys() == after.keys(), f"{label}: other patches")
    for key in before.keys() & after.keys():
        same = before[key].shape == after[key].shape and np.array_equal(before[key], after[key], equal_nan=True)
        check(same, f"{label}: {key} {before[key][:6]} {after[key][:6]}")


def new_wheel(config=1):
    wheel = contact.WheelRail(roller=config >= 4)
    number = wheel.number
    wheel.set_flags(ic_config=config, ic_sens=2, own_errors=1)
    wheel.set_rail(PROFILES + "60E1.prr")
    wheel.set_wheel(PROFILES + "S1002.prw")
    wheel.set_track(14.0, 1435.0, 0.025, **({"roller_radius": 500.0} if config >= 4 else {}))
    wheel.set_wheelset(1360.0, -70.0, RADIUS)
    wheel.set_material(82000.0, 0.28)
    wheel.set_friction(0.3)
    wheel.set_grid(1.0, 1.0, d_comb=4.0, d_sep=8.0)
    cntc.setwheelsetposition(number, 1, [0.0, 3.0, 0.0, 0.001, 0.004, 0.0])
    cntc.setwheelsetvelocity(number, 2, [SPEED if config < 4 else -SPEED/500.0, 10.0, 0.0, 0.0, 0.01, -SPEED/RADIUS])
    wheel.set_vertical_force(60000.0)
    cntc.subs_addblock(number, -1, 1, 9, *POINTS)
    return wheel


def new_contact():
    problem = contact.Problem()
    problem.set_flags(ic_sens=2, own_errors=1)
    problem.set_material(82000.0, 0.28, 60000.0, 0.31)
    problem.set_friction(0.3)
    problem.set_solver(maxout=30)
    problem.set_rolling(20000.0)
    set_grid(problem)
    problem.set_distance(lambda x, y: 0.004*x**2 + 0.006*y**2)
    problem.set_normal_force(3000.0)
    problem.set_flags(ic_norm=1)
    problem.set_creepages(0.002, -0.001, 3e-4)
    cntc.subs_addblock(problem.number, 1, 1, 9, *POINTS)
    return problem


def set_grid(problem, mx=14, my=11):
    problem.set_grid(mx, my, 3.0/mx, 2.4/my)


def relaxing(problem, **flags):
    """A viscoelastic material, with flags that do not go with it"""
    problem.set_material(20000.0, 0.4, model=1, parameters=(0.5, 0.5, 1e-5, 1e-5))
    problem.set_flags(**flags)


def heated(problem, **flags):
    """Friction by temperatures that are not calculated"""
    problem.set_friction_law(6, (0.3, 0.0, -0.1, 400.0, 0.05, 1.0))
    problem.set_flags(**flags)


def move(wheel, config, *place):
    """Another position and configuration"""
    cntc.setwheelsetposition(wheel.number, 1, place)
    wheel.set_flags(ic_config=config)


def other_elements(problem, wheel):
    """In a sequence that must have the same ones"""
    if wheel:
        problem.set_grid(0.9, 1.0)
    else:
        set_grid(problem, 9, 9)
    problem.set_flags(ic_pvtime=0, ic_tang=2)


#: What follows a wheel of configuration c, o being the other side: most of it is refused
WHEELS = {
    "viscoelastic in transient rolling": lambda w, c, o: relaxing(w, ic_tang=2),
    "the same on the other side": lambda w, c, o: relaxing(w, ic_tang=2, ic_config=o),
    "law of temperature": lambda w, c, o: heated(w, ic_tang=0, ic_config=o),
    "a track or a roller": lambda w, c, o: w.set_flags(ic_config=(c + 4) % 8),
    "a track or a roller on the other side": lambda w, c, o: w.set_flags(ic_config=(o + 4) % 8),
    "no profile": lambda w, c, o: cntc.setprofileinputfname(w.number, "missing.prr", [0, 0, 0, 1, 0, 0], [1.0, 0.0]),
    "far away": lambda w, c, o: move(w, o, 0.0, 500.0, 0.0, 0.0, 0.0, 0.0),
    "upside down": lambda w, c, o: move(w, o, 0.0, 0.0, 0.0, 1.4, 0.0, 0.0),
    "small wheels": lambda w, c, o: (w.set_wheelset(1360.0, -70.0, 10.0), w.set_flags(ic_config=o)),
    "other elements": lambda w, c, o: other_elements(w, True),
    "no file of coefficients": lambda w, c, o: w.set_flags(ic_config=o, ic_inflcf=9),
    "huge force": lambda w, c, o: (w.set_flags(ic_config=o), w.set_vertical_force(1e15)),
}
CONTACTS = {
    "extra slip of another grid": lambda p: (cntc.setextrarigidslip(p.number, 1, np.ones(154)*1e-3, np.ones(154)*1e-3),
                                             set_grid(p, 10, 10)),
    "KPEC with a force": lambda p: p.set_flags(ic_bound=5, ic_norm=1),
    "pressure of an ellipse": lambda p: p.set_flags(ic_bound=2),
    "other elements": lambda p: other_elements(p, False),
    "law of temperature": heated,
    "viscoelastic in a shift": lambda p: relaxing(p, ic_tang=1),
    "no contact": lambda p: p.set_distance(lambda x, y: 1e30 + 0.0*x),
    "huge grid": lambda p: set_grid(p, 30000, 30000),
    "coefficients of another grid": lambda p: (set_grid(p, 28, 22), p.set_flags(ic_inflcf=0)),
}


def refuse(problem, wheel, spoil, label, *sides):
    """Is a case refused after a solved one? Then results are compared"""
    number, icp = problem.number, -1 if wheel else 1
    check(cntc.calculate(number, icp, 0) >= 0, f"{label}: solved before")
    before = look(number, wheel)
    with contextlib.suppress(contact.ContactError):
        spoil(problem, *sides)
    is_refused = cntc.calculate(number, icp, 0) in (-99, -34, -33, -32)
    if is_refused:
        compare(before, look(number, wheel), label)
    problem.close()
    return is_refused


def main():
    refused = 0
    for config, other, kind in ((1, 0, "right"), (0, 1, "left"), (5, 4, "right roller"), (4, 5, "left roller")):
        for name, spoil in WHEELS.items():
            refused += refuse(new_wheel(config), True, spoil, f"{kind} wheel, {name}", config, other)
    for name, spoil in CONTACTS.items():
        refused += refuse(new_contact(), False, spoil, f"contact, {name}")
    print(refused, "refused cases")
    check(refused > 40, "most of them are refused")
    return changes.failures


if __name__ == "__main__":
    sys.exit(1 if main() else 0)
