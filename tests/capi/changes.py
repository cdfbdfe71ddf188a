#!/usr/bin/env python3
"""Settings that change between the calls of a problem: each result is that of a new problem with the same settings.

A problem keeps arrays, plans and starting values from call to call. Here wheels on rails and contacts of two bodies change one
setting before each call, at random, in all combinations that the library accepts or refuses.

    changes.py [--wheels N] [--contacts N] [--changes N] [--seed S]
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
from contact import cntc

warnings.simplefilter("ignore")
PROFILES, SPEED, RADIUS, EPS = f"{top}/examples/profiles/", 25000.0, 460.0, 1e-5
#: Materials: M, and its parameters after the elastic constants
MATERIALS = {"elastic": (0, ()), "viscoelastic": (1, (0.5, 0.5, 1e-5, 2e-5)), "fastsim": (3, (1.0, 0.125, 1.0)),
             "fastrip": (5, (1.0, 0.125, 1.0)), "layer": (4, (8000.0, 0.02, 0.0, 0.0)),
             "yielding layer": (4, (8000.0, 0.02, 100.0, 50.0))}
FRICTION = ((0, (0.35, 0.35)), (0, (0.1, 0.1)), (2, (0.1, 0.2, 1000.0, 0.05, 5000.0, 0.02, 1.0)),
            (4, (0.1, 0.2, 1000.0, 0.05, 3000.0, 0.02, 1.0)))
#: Totals that are compared, beside those that the estimates and wear add
FORCES = ("fn", "fx", "fy")
failures = 0


def check(condition, text):
    global failures
    if not condition:
        print("FAILED", text, flush=True)
    failures += not condition


def set_material(problem, name, second):
    model, parameters = MATERIALS[name]
    problem.set_material(82000.0, 0.28, *second, model=model, parameters=parameters)


def set_temperatures(problem, icp, source):
    if source is None:
        cntc.settemperaturedata(problem.number, icp, 0, [])
    else:
        problem.set_temperatures(20.0, source=source)


def set_wear(problem, expected_names):
    """Wear, with all of its numbers or without any; switched off by its flag"""
    if expected_names is None:
        problem.set_flags(own_wear=0)
    else:
        problem.set_wear(*expected_names)


COMMON = {
    "material": ((("elastic", ()),) * 3 + (("elastic", (40000.0, 0.35)),) + tuple((name, ()) for name in MATERIALS),
                 lambda problem, value: set_material(problem, *value)),
    "friction": (FRICTION, lambda problem, value: problem.set_friction_law(*value)),
    "order": ((1, 2), lambda problem, value: problem.set_solver(eps=EPS, order=value, maxin=200, maxout=60)),
    "errors": ((False, True), lambda problem, value: problem.set_errors(value)),
    "wear": ((None, (), (1e-4, 3000.0, 300.0)), set_wear),
}


def put_wheel(wheel, at):
    """Position, velocity, and the vertical force or the height"""
    y, yaw, vy, slip, force, height = at
    wheel.set_position(y=y, yaw=yaw, z=height)
    wheel.set_velocity(SPEED, vy=vy, pitch=-SPEED / RADIUS * (1.0 + slip))
    if height is None:
        wheel.set_flags(ic_norm=1)
        wheel.set_vertical_force(force)


def some_place(dice):
    """A position on the tread or at the flange, with any load; one in five with a height instead of the load"""
    height = dice.uniform(-0.5, 1.3) if dice.random() < 0.2 else None
    return (dice.uniform(-6.0, 7.0), dice.gauss(0.0, 0.003), dice.gauss(0.0, 60.0), dice.gauss(0.0, 0.002),
            10.0 ** dice.uniform(3.0, 5.2), height)


#: Settings of a wheel on a rail in the order in which they are made: values or a function of random numbers, and how to set them
WHEEL = {
    "motion": ((3, 3, 3, 0), lambda wheel, value: wheel.set_flags(ic_tang=value)),
    "cant": ((0.025, 0.05, 0.0), lambda wheel, value: wheel.set_track(14.0, 1435.0, value)),
    "radius": ((RADIUS, 420.0), lambda wheel, value: wheel.set_wheelset(1360.0, -70.0, value)),
    "rail": (("60E1.prr", "60E1_worn.prr"), lambda wheel, value: wheel.set_rail(PROFILES + value)),
    "wheel": (("S1002.prw", "S1002_worn.prw"), lambda wheel, value: wheel.set_wheel(PROFILES + value)),
    **COMMON,
    "grid": (lambda dice: (dice.choice((0.5, 1.0, 2.0)), dice.choice((0.4, 1.0, 2.0)), dice.choice((0.5, 4.0))),
             lambda wheel, value: wheel.set_grid(value[0], value[1], d_comb=value[2], d_sep=2.0 * value[2])),
    "search": ((2, 5, 7, 3, 4, 6), lambda wheel, value: wheel.set_flags(ic_discns=value)),
    "pressures": ((0, 0, 0, 5, 6), lambda wheel, value: wheel.set_flags(ic_bound=value)),
    "temperatures": ((None, "moving", "established"), lambda wheel, value: set_temperatures(wheel, -1, value)),
    "place": (some_place, put_wheel),
}


def some_grid(dice):
    """Numbers of elements, lengths along and across; elliptic, or a distance for each element"""
    return (dice.randint(3, 40), dice.randint(3, 40), 10.0 ** dice.uniform(-0.5, 0.5), 10.0 ** dice.uniform(-0.5, 0.5),
            dice.random() < 0.5)


def some_load(dice):
    """Normal force or approach"""
    return ("force", 10.0 ** dice.uniform(2.0, 4.0)) if dice.random() < 0.6 else ("approach", 10.0 ** dice.uniform(-3.5, -2.0))


def some_motion(dice):
    """Creepages, or tangential forces and spin"""
    kind = "forces" if dice.random() < 0.3 else "creepages"
    return (kind, dice.gauss(0.0, 0.002), dice.gauss(0.0, 0.002), dice.gauss(0.0, 0.0005))


def set_grid(problem, value):
    mx, my, length, width, is_elliptic = value
    if is_elliptic:
        problem.set_hertz(mx, my, aa=length, bb=width)
    else:
        problem.set_grid(mx, my, 3.0 * length / mx, 3.0 * width / my)
        problem.set_distance(lambda x, y: 0.01 * ((x / length) ** 2 + (y / width) ** 2))


def set_load(problem, value):
    kind, number = value
    if kind == "force":
        problem.set_normal_force(number)
        problem.set_flags(ic_norm=1)
    else:
        problem.set_approach(number)
        problem.set_flags(ic_norm=0)


def set_kinematics(problem, value):
    kind, first, second, spin = value
    problem.set_creepages(first, second, spin)
    if kind == "forces":
        problem.set_tangential_force(0.6 * np.tanh(1e3 * first), 0.6 * np.tanh(1e3 * second), cphi=spin)


#: The same for contacts of two bodies
CONTACT = {
    "motion": ((3, 3, 3, 0, 1, 2), lambda problem, value: problem.set_flags(ic_tang=value)),
    "rolling": (((1e4, 0.1), (3e4, 0.05), (1e4, 0.4)), lambda problem, value: problem.set_rolling(*value)),
    **COMMON,
    "influence": ((2, 2, 3), lambda problem, value: problem.set_flags(ic_inflcf=value)),
    "pressures": ((0, 0, 0, 1, 2, 5, 6), lambda problem, value: problem.set_flags(ic_bound=value)),
    "grid": (some_grid, set_grid),
    "load": (some_load, set_load),
    "kinematics": (some_motion, set_kinematics),
    "temperatures": ((None, "moving", "established"), lambda problem, value: set_temperatures(problem, 1, value)),
}


def chosen(dice, values):
    return values(dice) if callable(values) else dice.choice(values)


def make(kind, table, state):
    problem = kind()
    for name, value in state.items():
        if value is not None:
            table[name][1](problem, value)
    return problem


def solve(problem):
    """Result, and its status or the reason for none"""
    try:
        result = problem.solve()
    except contact.ContactError as error:
        return None, str(error)
    return result, result.status


def totals_of(result):
    """Forces, and the names of totals and estimated errors of each patch"""
    patches = getattr(result, "patches", (result,))
    forces = list(result.forces.track.force) if hasattr(result, "forces") else [getattr(result, name) for name in FORCES]
    names = [sorted(patch.totals()) + sorted(patch.errors or {}) for patch in patches]
    return np.array(forces), names


def is_another_equilibrium(result, table, state, bound):
    """Does a new problem at the height that was found give its forces?

    The vertical force falls with the height where two patches become one with approximate pressures (B = 5, 6), or a few large
    elements: then two heights have the same vertical force, and a wheel stays near that of its previous call.
    """
    if "place" not in state or state["place"][-1] is not None:
        return False
    # a height holds until a vertical force is set
    fresh = make(contact.WheelRail, table, {**state, "place": (*state["place"][:-1], result.totals()["z_ws"])})
    at_height = solve(fresh)[0]
    fresh.close()
    if at_height is None:
        return False
    (forces, names), (right, right_names) = totals_of(result), totals_of(at_height)
    met = abs(forces[2] - state["place"][-2]) <= 2.0 * EPS * state["place"][-2]
    # the errors that are estimated differ: those of the force, or of the height
    return met and np.abs(forces - right).max() < bound * np.abs(right).max() and len(names) == len(right_names)


def change(kind, table, seed, changes, where):
    """One problem, of which a setting changes before each call"""
    dice = random.Random(seed)
    state = {name: values[0] if isinstance(values, tuple) else chosen(dice, values) for name, (values, _) in table.items()}
    problem, past, refused, others = make(kind, table, state), [], 0, []
    for _ in range(changes):
        name = dice.choice(list(table))
        state[name] = chosen(dice, table[name][0])
        past = [*past[-3:], name]
        table[name][1](problem, state[name])
        fresh = make(kind, table, state)
        (found, how), (expected, as_it_should) = solve(problem), solve(fresh)
        fresh.close()
        label = f"{where} of seed {seed} after changes of {', '.join(past)}: "
        check(how == as_it_should, f"{label}{how}; a new problem: {as_it_should}")
        if found is None or expected is None:
            refused += 1
            # refused combinations continue with the first values
            for setting in ("motion", "material", "pressures", "temperatures", "friction"):
                state[setting] = table[setting][0][0]
                table[setting][1](problem, state[setting])
            continue
        (forces, names), (right, right_names) = totals_of(found), totals_of(expected)
        away = np.abs(forces - right).max() / max(np.abs(right).max(), 1e-300)
        # pressures and tractions are within EPS each; forces that friction limits follow its iteration
        bound = 1e-3 if state["friction"][0] else 4.0 * EPS
        if (away >= bound or names != right_names) and is_another_equilibrium(found, table, state, bound):
            others.append(label)
            continue
        check(away < bound, f"{label}{away:.1e} away, {forces} in place of {right}")
        check(names == right_names, f"{label}totals {names} in place of {right_names}")
    problem.close()
    return refused, others


def searches():
    """Searches along the locus after searches over grids, on finer elements than before: arrays have their own sizes"""
    for first, second, third in ((2, 5, 2), (2, 6, 7), (3, 5, 3), (5, 2, 5), (4, 6, 4)):
        state = {name: values[0] if isinstance(values, tuple) else None for name, (values, _) in WHEEL.items()}
        state.update(place=(2.0, 0.002, 0.0, 0.0, 60e3, None))
        wheel = make(contact.WheelRail, WHEEL, {**state, "grid": (2.0, 2.0, 4.0), "search": first})
        solve(wheel)
        for search in (second, third):
            wheel.set_grid(2.0, 0.3, d_comb=4.0, d_sep=8.0)
            wheel.set_flags(ic_discns=search)
            found = solve(wheel)[0]
        fresh = make(contact.WheelRail, WHEEL, {**state, "grid": (2.0, 0.3, 4.0), "search": third})
        expected = solve(fresh)[0]
        wheel.close()
        fresh.close()
        away = np.abs(totals_of(found)[0] - totals_of(expected)[0]).max() / 60e3
        check(away < 4.0 * EPS, f"D = {first}, {second}, {third}: {away:.1e} away")


def heights():
    """A height that a search has found gives the force that it was searched for, and all searches the same place of contact

    On the flange, with few rows of elements, a search on a grid has to see the whole length of a contact, and the next row beyond
    it, at any height at which the gap is computed.
    """
    low, high = (6.9003708, 0.0024564779, 37.590152, 0.0010210906), (8.455554223941213, -0.002594497009012595, 0.0, 2.1028447924e-4)
    for place, load, pressures in ((low, 10e3, 5), (low, 31895.683, 5), (low, 60e3, 5), (high, 37797.411904, 0)):
        places = []
        for search in (2, 5, 6, 7):
            state = {name: values[0] if isinstance(values, tuple) else None for name, (values, _) in WHEEL.items()}
            state.update(wheel="S1002_worn.prw", grid=(0.5, 2.0, 4.0), search=search, pressures=pressures,
                         place=(*place, load, None))
            found = solved_once(state)
            at_height = solved_once({**state, "place": (*place, load, found.totals()["z_ws"])})
            forces, right = totals_of(found)[0], totals_of(at_height)[0]
            away = np.abs(forces - right).max() / np.abs(right).max()
            check(away < 4.0 * EPS, f"D = {search}, {load} N: {away:.1e} away, {forces} in place of {right} at the height")
            places.append(found.patches[0].totals()["xcp_tr"])
        if place == low:
            check(np.ptp(places) < 0.2, f"{load} N: contact at x = {places} mm with D = 2, 5, 6, 7")


def solved_once(state):
    """Result of a new wheel on a rail"""
    wheel = make(contact.WheelRail, WHEEL, state)
    result = solve(wheel)[0]
    wheel.close()
    return result


def main():
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for option, number in (("--wheels", 3), ("--contacts", 6), ("--changes", 40), ("--seed", 1)):
        reader.add_argument(option, type=int, default=number)
    expected_names = reader.parse_args()
    searches()
    heights()
    for kind, table, count, where in ((contact.WheelRail, WHEEL, expected_names.wheels, "wheel"),
                                      (contact.Problem, CONTACT, expected_names.contacts, "contact")):
        outcomes = [change(kind, table, expected_names.seed + number, expected_names.changes, where) for number in range(count)]
        refused, others = sum(outcome[0] for outcome in outcomes), [label for outcome in outcomes for label in outcome[1]]
        print(f"{count} problems with {expected_names.changes} changes each, {where}: {refused} combinations are refused, "
              f"{len(others)} at another height with the same force", *others, sep="\n   ")
        check(refused < 0.5 * count * expected_names.changes or count == 0, f"{where}: most combinations are refused")
        check(len(others) <= max(5, count * expected_names.changes // 500), f"{where}: {len(others)} at another height")
    sys.exit(failures > 0)


if __name__ == "__main__":
    main()
