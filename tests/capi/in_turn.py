#!/usr/bin/env python3
"""Every two settings in turn: nothing of the first remains when the second is solved.

Each alternative to the settings of a problem is solved directly after each other one, on the same problem, and compared with a new
problem. Values that a caller has set, as the step of rolling, are set once: a calculation that replaces them, because shifts,
steady rolling or layers have their own, changes the results of all later ones. `changes.py` makes chains at random.
"""
import math
import os
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import changes
from changes import CONTACT, EPS, FRICTION, MATERIALS, WHEEL, check, contact, make, solve
from contact import cntc

#: A distance for each element, and a grid by semi-axes with other numbers of elements
DISTANCES, AXES = (17, 7, 1.4, 0.7, False), (14, 9, 0.9, 0.6, True)
#: Friction that falls with the surface temperature: L = 6
HEATED = (6, (0.3, 0.0, -0.1, 400.0, 0.05, 1.0))
#: Where friction changes with slip or temperature, its iteration stops at changes of 1e-3 [-]
FALLING = 1e-3


def set_classical(problem, method):
    """Solvers of the established program: G = 2, 3, 5"""
    if method:
        numbers = [-0.9, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0] if method == 5 else [0.9, 1.0, 1.0]
        cntc.setsolverflags(problem.number, 1, method, [999, 200, 30, 60, 1 if method == 5 else 0], [EPS, *numbers])
        problem.set_flags(own_classical=1)
    else:
        problem.set_flags(own_classical=0)
        cntc.setsolverflags(problem.number, 1, 0, [999, 200, 30, 60], [EPS])


def set_extra_slip(problem, slip):
    """An extra term of the rigid slip in each element; a grid has at most 200 of them here"""
    if slip:
        cntc.setextrarigidslip(problem.number, 1, np.full(200, slip), np.zeros(200))
    else:
        problem.set_flags(ic_exrhs=0)


def set_damping(problem, values):
    cntc.setmaterialparameters(problem.number, 1, 12 if values else 10, values or [])


#: Settings of contacts of two bodies beside those of changes.py
TABLE = {**CONTACT, "rolling": (None, lambda problem, value: problem.set_rolling(1e4, value[0], value[1])),
         "solver": (None, set_classical), "slip": (None, set_extra_slip), "damping": (None, set_damping),
         "sensitivities": (None, lambda problem, value: problem.set_flags(ic_sens=value)),
         "accuracy": (None, lambda problem, value: problem.set_flags(own_accuracy=value))}
BASE = {"motion": 2, "rolling": (0.1, 0.0), "material": ("elastic", ()), "friction": FRICTION[0], "order": 1, "errors": False,
        "wear": None, "influence": 2, "pressures": 0, "grid": DISTANCES, "load": ("force", 2000.0),
        "kinematics": ("creepages", 7e-4, 3e-3, 4e-4), "temperatures": None, "solver": 0, "slip": 0.0, "damping": (),
        "sensitivities": 0, "accuracy": 0}
#: Other values of each setting
OTHERS = {"motion": (0, 1, 2, 3), "rolling": ((0.05, 0.0), (0.4, 0.0), (0.1, math.pi), (0.1, 0.5)),
          "material": (("elastic", (40000.0, 0.35)), *((name, ()) for name in MATERIALS if name != "elastic")),
          "friction": (*FRICTION[1:], HEATED), "order": (2,), "errors": (True,), "wear": ((1e-4, 3000.0, 300.0),),
          "influence": (3,), "pressures": (1, 2, 5, 6), "grid": (AXES,), "load": (("approach", 2e-3), ("force", 500.0)),
          "kinematics": (("forces", 1e-3, -4e-4, 2e-4), ("creepages", -1e-3, 0.0, 0.0)), "temperatures": ("moving", "established"),
          "solver": (2, 3, 5), "slip": (1e-3,), "damping": ((1e-5, 1e-5, 1e9, 1e9),), "sensitivities": (3,), "accuracy": (100,)}
#: The same for a wheel on a rail
PAIR = {"motion": 3, "cant": 0.025, "radius": 460.0, "rail": "60E1.prr", "wheel": "S1002.prw", "material": ("elastic", ()),
        "friction": FRICTION[0], "order": 1, "errors": False, "wear": None, "grid": (1.0, 1.0, 4.0), "search": 2, "pressures": 0,
        "temperatures": None, "place": (2.0, 0.002, 10.0, 5e-4, 60e3, None)}
OTHER_PAIRS = {"motion": (0, 1, 2), "radius": (420.0,), "material": (("elastic", (40000.0, 0.35)), ("layer", ()), ("fastrip", ())),
               "friction": (FRICTION[2],), "grid": ((2.0, 0.7, 4.0),), "search": (5, 3, 4), "pressures": (5,),
               "temperatures": ("moving",), "place": ((6.2, 0.01, 0.0, 0.0, 60e3, None), (2.0, 0.002, 0.0, 0.0, 60e3, 0.4),
                                                      (9.0, 0.0, 0.0, 0.0, 60e3, -30.0))}


def in_turn(many):
    """Every ordered pair of different members, one after the other"""
    for number, first in enumerate(many):
        for second in many[number + 1:]:
            yield first
            yield second


def totals_of(result):
    """Totals with a size each: forces relative to the normal force, the moment also to a length of the contact [mm]"""
    for patch in getattr(result, "patches", (result,)):
        totals = {name: value for name, value in patch.totals().items() if isinstance(value, float)}
        force, length = abs(totals["fn"]), math.sqrt(totals["contact_area"])
        sizes = {"fx": force, "fy": force, "mz": force * length}
        yield {name: (value, max(abs(value), sizes.get(name, 0.0))) for name, value in totals.items()}


def compare(found, expected, tolerance):
    """Names of the totals that differ, with both values"""
    found, expected = list(totals_of(found)), list(totals_of(expected))
    if [sorted(patch) for patch in found] != [sorted(patch) for patch in expected]:
        return f"totals {found} in place of {expected}"
    return ", ".join(f"{name} {patch[name][0]:.6g} in place of {value:.6g}" for patch, right in zip(found, expected)
                     for name, (value, size) in right.items() if not abs(patch[name][0] - value) <= tolerance * size)


def every_two(kind, table, base, others, where):
    """Solve each alternative after each other one"""
    first = ("motion", base["motion"])
    many = [first] + [(name, value) for name, values in others.items() for value in values if value != base[name]]
    right = {}
    for name, value in many:
        fresh = make(kind, table, {**base, name: value})
        right[name, value] = solve(fresh)
        fresh.close()
    problem, last, solved = make(kind, table, base), first, 0
    for name, value in in_turn(many):
        if name != last[0]:
            table[last[0]][1](problem, base[last[0]])
        table[name][1](problem, value)
        (found, how), (expected, as_it_should) = solve(problem), right[name, value]
        label = f"{where}, {name} = {value} after {last[0]} = {last[1]}: "
        check(how == as_it_should, f"{label}{how}; a new problem: {as_it_should}")
        last = (name, value)
        if found is None or expected is None:
            continue
        solved += 1
        friction = value if name == "friction" else base["friction"]
        differences = compare(found, expected, FALLING if friction[0] else TOLERANCE)
        check(not differences, label + differences)
    problem.close()
    print(f"{where}: {len(many)} settings in turn, {solved} solutions")
    check(solved > len(many) ** 2 / 2, f"{where}: most pairs are refused")


def rolling_as_used():
    """Callers get the step of the last calculation, the size of an element in steady rolling; what they set remains"""
    def check_rolling(velocity, step, when):
        found = cntc.getparameters(problem.number, 1, 1)
        check(np.allclose((found["veloc"], found["dq"]), (velocity, step), rtol=1e-12), f"rolling {when}: {found}")

    problem = make(contact.Problem, TABLE, BASE)
    for motion, velocity, step in ((3, 1e4, 3.0 * DISTANCES[2] / DISTANCES[0]), (1, 1.0, 1.0), (2, 1e4, 0.1)):
        problem.set_flags(ic_tang=motion)
        problem.solve()
        check_rolling(velocity, step, f"after T = {motion}")
    problem.set_rolling(2e4, 0.2)
    check_rolling(2e4, 0.2, "after it was set")
    problem.close()


#: Tractions are within EPS; approaches, areas and creepages for given forces follow with a factor
TOLERANCE = 20.0 * EPS

if __name__ == "__main__":
    for moves in (2, 3, 1):
        every_two(contact.Problem, TABLE, {**BASE, "motion": moves}, OTHERS, f"contact, T = {moves}")
    every_two(contact.WheelRail, WHEEL, PAIR, OTHER_PAIRS, "wheel")
    rolling_as_used()
    sys.exit(changes.failures > 0)
