#!/usr/bin/env python3
"""Forces of a wheel do not depend on previous calls: calls that continue one another against independent ones, by order 2.

Random walks of position, velocities and load, on the tread, at the flange, and with two patches; elements of 1.0 and 0.5 mm. Both
meet the vertical force within EPS, hence twice of it between them, also where an element enters the contact between both heights.
"""
import os
import sys
import warnings

import numpy as np

top = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(top, "python"))
import contact

warnings.simplefilter("ignore")
EPS, SPEED, RADIUS = 1e-5, 25000.0, 460.0
#: Positions along each of three ways, for each size of elements
COUNT = 67
#: Lateral position, yaw, roll, their velocities, and the load: the start, and how far a step goes [mm, rad, s, N]
STEP = np.array([0.03, 3e-5, 1e-5, 3.0, 1e-3, 300.0])
TREAD, FLANGE, TWO = ([0.6, 0.002, 2e-4, 10.0, 0.0, 62500.0], [5.6, 0.002, 2e-4, 10.0, 0.0, 62500.0],
                      [6.05, 0.01, 0.0, 0.0, 0.0, 70e3])
failures = 0


def check(condition, text):
    global failures
    print("ok    " if condition else "FAILED", text)
    failures += not condition


def make(element, continues, two):
    pair = contact.WheelRail("right")
    pair.set_material(82000.0, 0.28)
    pair.set_friction(0.3)
    pair.set_grid(element, element, **({"d_comb": 0.5, "d_sep": 1.0} if two else {}))
    pair.set_track(14.0, 1435.0, 0.05 if two else 0.025)
    pair.set_wheelset(1360.0, -70.0, RADIUS)
    pair.set_rail(f"{top}/examples/profiles/60E1.prr")
    pair.set_wheel(f"{top}/examples/profiles/S1002.prw")
    pair.set_solver(eps=EPS, order=2)
    pair.set_flags(ic_pvtime=0 if continues else 2)
    return pair


def solve(pair, at):
    """Force on the rail relative to the load, and the numbers of elements in contact of each patch"""
    pair.set_position(y=at[0], yaw=at[1], roll=at[2])
    pair.set_velocity(SPEED, vy=at[3], yaw=at[4], pitch=-1.0003 * SPEED / RADIUS)
    pair.set_vertical_force(at[5])
    result = pair.solve()
    check(result.status == "solved", f"at {at}: {result.status}") if result.status != "solved" else None
    return np.array(result.forces.track.force) / at[5], [patch.totals()["ncon"] for patch in result.patches]


def walk(start, seed, two):
    """Positions within the range of two patches, or anywhere"""
    random = np.random.default_rng(seed)
    at = np.array(start)
    for _ in range(COUNT):
        at = at + STEP * random.normal(size=6)
        at[5] = np.clip(at[5], 50e3, 75e3)
        if two:
            at[0] = np.clip(at[0], 5.95, 6.35)
        yield at


for element in (1.0, 0.5):
    for number, (name, start) in enumerate((("tread", TREAD), ("flange", FLANGE), ("two patches", TWO))):
        two, continues = name == "two patches", number == 1
        loop = make(element, continues, two)
        away, patches, steps = [], set(), []
        for at in walk(start, number + 1, two):
            fresh = make(element, False, two)
            (expected, elements), (found, others) = solve(fresh, at), solve(loop, at)
            fresh.close()
            (away if elements == others else steps).append(np.abs(found - expected).max())
            patches.add(len(elements))
        loop.close()
        check(max(away) < 2 * EPS, f"{element} mm, {name}, P = {0 if continues else 2}: {max(away):.1e} FZ away, "
              f"median {np.median(away):.1e}")
        largest = max(steps, default=0.0)
        check(len(steps) <= COUNT // 10 and largest < 2 * EPS,
              f"{element} mm, {name}: an element more or less in {len(steps)} positions, {largest:.1e} FZ")
        check(2 in patches if two else True, f"{element} mm, {name}: patches {sorted(patches)}")
sys.exit(failures > 0)
