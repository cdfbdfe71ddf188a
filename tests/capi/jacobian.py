#!/usr/bin/env python3
"""Derivatives of wheel on rail agree with Richardson-extrapolated differences of solutions, and are refused if not available.

Differences are of solutions to a relative 1e-11, over steps so small that hardly an element changes its state. Each row is compared
relative to its largest entry, with inputs scaled by amounts that move a wheel similarly: 1 mm, 1/750 rad, 20 mm/s at 20 m/s.

    jacobian.py --random 400 --seed 2 --location 3

compares random wheels of 100 N to 200 kN instead, and lists those with deviations above ten times the error of the differences.
"""
import argparse
import os
import random
import sys
import warnings

import numpy as np

top = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(top, "python"))
import contact
from contact._jacobian import COLUMNS, ROWS

warnings.simplefilter("ignore")
RADIUS, SPEED = 460.0, 20000.0
#: Step of differences in mm and s; scales of the inputs
STEP = {"y": 1e-5, "z": 1e-5, "roll": 1e-8, "yaw": 1e-7, "vs": 0.01, "vy": 0.01, "vroll": 2e-5, "vyaw": 2e-5, "vpitch": 2e-5,
        "fz": 0.5}
ALIKE = np.array([1.0, 1.0, 1 / 750, 1 / 750, 20.0, 20.0, 20 / 460, 20 / 460, 20 / 460, 600.0])
failures = 0


def check(condition, text):
    global failures
    print("ok    " if condition else "FAILED", text)
    failures += not condition


def make(side="right", element=1.0, units="mm", roller=False, cant=0.025, order=1, **grid):
    """A pair of S1002 on 60E1"""
    length = 1.0 if units == "mm" else 1e-3
    pair = contact.WheelRail(side, units=units, roller=roller)
    pair.set_material(82000.0 if units == "mm" else 82e9, 0.28)
    pair.set_friction(0.3)
    pair.set_grid(element * length, element * length, **grid)
    pair.set_track(14.0 * length, 1435.0 * length, cant, roller_radius=500.0 * length if roller else 0.0)
    pair.set_wheelset(1360.0 * length, -70.0 * length, RADIUS * length)
    pair.set_rail(f"{top}/examples/profiles/60E1.prr")
    pair.set_wheel(f"{top}/examples/profiles/S1002.prw")
    pair.set_solver(eps=1e-11, maxgs=999, maxin=200, maxnr=60, order=order)
    return pair


def place(pair, at, force_given):
    pair.set_position(y=at["y"], roll=at["roll"], yaw=at["yaw"], z=None if force_given else at["z"])
    pair.set_velocity(at["vs"], vy=at["vy"], roll=at["vroll"], yaw=at["vyaw"], pitch=at["vpitch"])
    if force_given:
        pair.set_vertical_force(at["fz"])


def solve(pair, at, force_given):
    """All rows"""
    place(pair, at, force_given)
    result = pair.solve()
    forces = result.forces
    return np.concatenate([forces.track.force, forces.track.moment, forces.wheelset.force, forces.wheelset.moment,
                           result.wheelset_position[2:3]])


def position(y, side=1, length=1.0, roller=False, **changes):
    """A slightly rotated wheelset, with all velocities"""
    at = {"y": side * y, "z": 0.0, "roll": side * 1e-3, "yaw": side * 0.002, "vs": SPEED, "vy": 30.0, "vroll": 0.01, "vyaw": 0.02,
          "vpitch": -1.0005 * SPEED / RADIUS, "fz": 60000.0}
    if roller:
        at.update(vs=40.0, vpitch=-1.0005 * 40.0 * 500.0 / RADIUS)
    at.update(changes)
    for name in ("y", "z", "vy") + (() if roller else ("vs",)):
        at[name] *= length
    return at


def deviation(pair, at, force_given=True, scale=1.0, length=1.0):
    """Derivatives, their deviations from differences, and the error of these: the difference between the two step lengths"""
    unit = np.array([length if name in ("y", "z", "vs", "vy") else 1.0 for name in COLUMNS])
    solve(pair, at, force_given)
    height = solve(pair, at, force_given)[-1]
    if force_given:
        at = dict(at, z=height)
    jacobian = pair.jacobian()
    differences, doubt = np.zeros((13, 10)), np.zeros((13, 10))
    for k, name in enumerate(COLUMNS):
        if name == ("z" if force_given else "fz"):
            continue
        step = STEP[name] * unit[k] * scale * (1e-3 if name == "vs" and at["vs"] < 100.0 * length else 1.0)
        quotient = [(solve(pair, dict(at, **{name: at[name] + n * step}), force_given)
                     - solve(pair, dict(at, **{name: at[name] - n * step}), force_given)) / (2 * n * step) for n in (1, 2)]
        differences[:, k] = (4 * quotient[0] - quotient[1]) / 3
        doubt[:, k] = abs(quotient[0] - quotient[1])
    scaled = ALIKE * unit
    largest = np.abs(differences * scaled).max(axis=1)
    # the vertical force is prescribed, so that its row is trivial
    for row in (2, 8):
        largest[row] = largest[row - 2:row + 1].max()
    largest = np.maximum(largest, 1e-6 * largest.max())
    return jacobian, np.abs(jacobian.values - differences) * scaled / largest[:, None], (doubt * scaled / largest[:, None]).max()


def compare(text, pair, at, force_given=True, limit=5e-5, scale=1.0, length=1.0):
    jacobian, error, worth = deviation(pair, at, force_given, scale, length)
    i, k = np.unravel_index(error.argmax(), error.shape)
    check(jacobian.state == "exact" and error.max() <= limit and worth <= limit,
          f"{text}: {error.max():.1e} at {ROWS[i]} by {COLUMNS[k]}, differences good to {worth:.1e}")
    return jacobian


def refused(text, pair, part):
    try:
        pair.jacobian()
    except contact.ContactError as error:
        check(part in str(error), f"{text}: {error}")
        return
    check(False, f"{text}: not refused")


def agree(order):
    for y in (0.0, 3.0, 4.6, 5.4, 6.0):
        compare(f"order {order}, y = {y} mm", make(order=order), position(y), scale=3.0 if y > 5.0 else 1.0)
    compare(f"order {order}, height given", make(order=order), position(1.4, z=0.1), force_given=False)
    compare(f"order {order}, 0.5 mm in the flange", make(element=0.5, order=order), position(5.4), scale=0.3)
    compare(f"order {order}, left", make("left", order=order), position(5.5, side=-1))
    compare(f"order {order}, backwards", make(order=order), position(2.0, vs=-SPEED, vpitch=SPEED / RADIUS), scale=2.0)
    compare(f"order {order}, roller", make(roller=True, order=order), position(1.0, roller=True))
    two = {"d_comb": 0.5, "d_sep": 1.0, "order": order}
    compare(f"order {order}, two patches", make(cant=0.05, **two), position(6.05, yaw=0.01, roll=0.0, fz=90e3))
    compare(f"order {order}, two parts of a patch", make(cant=0.05, d_comb=0.5, d_sep=60.0, order=order),
            position(6.1, yaw=0.01, roll=0.0, fz=90e3))
    compare(f"order {order}, two parts of a light wheel", make(cant=0.05, d_comb=0.5, d_sep=60.0, order=order),
            position(6.1, yaw=0.01, roll=0.0, fz=1e3))
    compare(f"order {order}, a light wheel", make(order=order), position(0.0, yaw=0.01, roll=0.0, fz=100.0))
    for y in (0.0, 5.4, 6.0):
        along = make(order=order)
        along.set_flags(ic_discns=3)
        compare(f"order {order}, slip of each element, y = {y} mm", along, position(y), scale=3.0 if y > 5.0 else 1.0)
    parts = make("left", cant=0.05, d_comb=0.5, d_sep=60.0, order=order)
    parts.set_flags(ic_discns=3)
    compare(f"order {order}, slip of each element in two parts", parts, position(6.1, side=-1, yaw=-0.01, roll=0.0, fz=90e3))
    turned = make(roller=True, order=order)
    turned.set_flags(ic_discns=3)
    compare(f"order {order}, slip of each element on a roller", turned, position(1.0, roller=True))
    still = make(order=order)
    still.set_flags(ic_tang=0)
    compare(f"order {order}, without friction", still, position(1.3))


def conventions():
    """The same case in metres, and on the wheel: of the same numbers"""
    plain = make()
    solve(plain, position(3.0), True)
    expected = plain.jacobian()
    metre = make(units="si")
    solve(metre, position(3.0, length=1e-3), True)
    found = metre.jacobian()
    row = np.array([1, 1, 1, 1e-3, 1e-3, 1e-3] * 2 + [1e-3])
    column = np.array([1e-3, 1e-3, 1, 1, 1e-3, 1e-3, 1, 1, 1, 1])
    largest = np.abs(expected.values * ALIKE).max(axis=1)[:, None]
    worst = (np.abs(found.values / row[:, None] * column - expected.values) * ALIKE / largest).max()
    check(worst < 1e-9, f"metres: {worst:.1e}")
    wheel = make(units="simpack")
    solve(wheel, position(3.0, length=1e-3), True)
    other = wheel.jacobian()
    check(np.allclose(other.values[:12], -found.values[:12]) and np.allclose(other.values[12], found.values[12]),
          "forces on the wheel are the opposite")
    check(expected["fy_tr", "yaw"] == expected.values[1, 3] and expected["z_ws"].shape == (10,)
          and expected[["fx_ws", "fy_ws"], ["y", "yaw"]].shape == (2, 2), "names of rows and columns")
    mirrored = make("left")
    solve(mirrored, position(3.0, side=-1, vy=-30.0, vroll=-0.01, vyaw=-0.02), True)
    sign_row = np.array([1, -1, 1, -1, 1, -1] * 2 + [1])
    sign_column = np.array([-1, 1, -1, -1, 1, -1, -1, -1, 1, 1])
    check(np.array_equal(mirrored.jacobian().values * sign_row[:, None] * sign_column, expected.values), "left mirrors right")
    before = solve(plain, position(3.0), True)
    again = make()
    solve(again, position(3.0), True)
    check(np.array_equal(solve(again, position(3.0), True), before), "asking for derivatives changes nothing")


def refusals():
    fresh = make()
    refused("before a calculation", fresh, "nothing has been calculated")
    for text, flags, part in (("transient", {"ic_tang": 2}, "transient rolling"), ("approximate", {"ic_bound": 5}, "approximate")):
        pair = make()
        pair.set_solver(eps=1e-5, order=1)
        pair.set_flags(**flags)
        solve(pair, position(1.3), True)
        refused(text, pair, part)
    pair = make()
    pair.set_material(82000.0, 0.28, 40000.0, 0.35)
    pair.set_solver(eps=1e-5, order=1)
    solve(pair, position(1.3), True)
    refused("bodies that differ", pair, "bodies that differ")
    pair = make()
    at = position(1.3, z=-50.0)
    place(pair, at, False)
    pair.solve()
    refused("apart", pair, "do not touch")


def random_wheels(count, seed, location):
    """Random wheels; those whose differences include an element that comes into contact are ignored"""
    profiles = f"{top}/examples/profiles"
    deviate = 0
    for number in range(count):
        draw = random.Random(1000 * seed + number)
        options = {"element": draw.choice([0.3, 0.5, 1.0, 1.5]), "cant": draw.choice([0.0, 0.025, 0.05]),
                   "order": draw.choice([1, 2])}
        if draw.random() < 0.5:
            options.update(d_comb=draw.choice([0.5, 2.0, 5.0]), d_sep=draw.choice([1.0, 8.0, 60.0]))
        side = draw.choice([-1, 1])
        at = position(draw.uniform(-4.0, 7.0), side=side, fz=10.0**draw.uniform(2.0, 5.3), yaw=draw.uniform(-0.02, 0.02),
                      roll=draw.uniform(-0.004, 0.004), vy=draw.uniform(-200.0, 200.0), vroll=draw.uniform(-0.05, 0.05),
                      vyaw=draw.uniform(-0.2, 0.2), vpitch=-SPEED / RADIUS * (1.0 + draw.uniform(-0.01, 0.01)))
        names = draw.choice(["60E1", "60E1_worn"]) + ".prr", draw.choice(["S1002", "S1002_worn"]) + ".prw"
        pair = make("right" if side > 0 else "left", **options)
        pair.set_rail(f"{profiles}/{names[0]}")
        pair.set_wheel(f"{profiles}/{names[1]}")
        pair.set_flags(ic_discns=location)
        jacobian, error, worth = deviation(pair, at)
        if jacobian.state == "exact" and error.max() > 10.0 * max(worth, 5e-6):
            deviate += 1
            print(f"{number}: {error.max():.1e}, differences good to {worth:.1e}: {names}, {options}, y = {at['y']:.3f} mm, "
                  f"{at['fz']:.0f} N")
    print(f"{deviate} of {count} wheels deviate by more than ten times the error of their differences")


parser = argparse.ArgumentParser()
parser.add_argument("--random", type=int, metavar="WHEELS")
parser.add_argument("--seed", type=int, default=1)
parser.add_argument("--location", type=int, default=2, choices=(2, 3), help="digit D: slip of the reference, or of each element")
arguments = parser.parse_args()
if arguments.random:
    random_wheels(arguments.random, arguments.seed, arguments.location)
    sys.exit()
for both in (1, 2):
    agree(both)
conventions()
refusals()
sys.exit(failures > 0)
