#!/usr/bin/env python3
"""Totals of Python results are those that the program gives for the input that the library writes

Arguments: the program. All totals that both have are compared, with order 2, dissimilar bodies, temperatures and wheels; places of
elements of a wheel are from the contact reference, as the moment is.
"""
import json
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "conformance"))
from checks import SOURCE, check, close, finish
import contact
import numpy as np

PROGRAM = sys.argv[1]
PROFILES = os.path.join(SOURCE, "examples/profiles")


def ball(problem, g2=82000.0):
    problem.set_material(g=82000.0, nu=0.28, g2=g2, nu2=0.28)
    problem.set_friction(0.3)
    problem.set_grid(14, 14, 1.2, 1.2)
    problem.set_distance(lambda x, y: 0.001*(x - 0.3)**2 + 0.001*(y - 0.2)**2)
    problem.set_normal_force(70e3)
    problem.set_solver(eps=1e-8, maxout=40)


def steady(problem):
    ball(problem)
    problem.set_creepages(0.001, 0.0005, 1e-4)


def dissimilar(problem):
    ball(problem, 40000.0)
    problem.set_creepages(0.002)


def hot(problem):
    ball(problem)
    problem.set_creepages(0.01)
    problem.set_rolling(20000.0)
    problem.set_temperatures(10.0, 400.0)


def shift(problem):
    ball(problem)
    problem.set_creepages(0.005, 0.002)


def wheel(pair):
    pair.set_material(g=82000.0, nu=0.28)
    pair.set_friction(0.3)
    pair.set_grid(dx=0.5, ds=0.5)
    pair.set_track(gauge_height=14.0, gauge_width=1435.0, cant=0.025)
    pair.set_wheelset(flange_back=1360.0, flange_back_position=-70.0, radius=460.0)
    pair.set_rail(os.path.join(PROFILES, "60E1.prr"))
    pair.set_wheel(os.path.join(PROFILES, "S1002.prw"))
    pair.set_velocity(20000.0, pitch=-43.5)
    pair.set_position(y=3.0)
    pair.set_vertical_force(90e3)


def shown(name, *options):
    """Totals of the patches, by the program"""
    run = subprocess.run([PROGRAM, "--quiet", "--json", "--order", "2", "--heat", "moving-source", "--contact-angle", "contact",
                          *options, "2", name], capture_output=True, text=True, timeout=120)
    check(run.returncode == 0, f"{name}: {run.stderr}")
    with open(name + ".jsonl", encoding="utf-8") as file:
        case = json.loads(file.readline())
    return [{key: item["value"] if isinstance(item, dict) else item for key, item in patch["totals"].items()}
            for patch in case["patches"]]


def compare(name, patches):
    others = shown(name)
    check(len(others) == len(patches), f"{name}: number of patches")
    for patch, other in zip(patches, others):
        totals = patch.totals()
        check({"fn", "fx", "pen", "pmax", "contact_area"} <= set(totals), f"{name}: {sorted(totals)}")
        check(set(totals) <= set(other), f"{name}: totals that files do not have, {sorted(set(totals) - set(other))}")
        check(("max_temp1" in other) == ("max_temp1" in totals), f"{name}: temperatures")
        for key, value in totals.items():
            scale = {"fx": patch.fn, "fy": patch.fn, "mz": 10*patch.fn, "cksi": 1e-3, "ceta": 1e-3, "cphi": 1e-4}.get(key, 1e-12)
            close(value, other[key], 2e-5*max(abs(other[key]), scale), f"{name}: {key}")
        check(patch.max_pressure == totals["pmax"], f"{name}: largest pressure")


def basic():
    between = 0
    for name, motion, setting in (("steady", "steady", steady), ("dissimilar", "steady", dissimilar), ("hot", "steady", hot),
                                  ("shift", "shift", shift)):
        contact.output_to(".", name)
        with contact.Problem(motion=motion) as problem:
            setting(problem)
            problem.set_flags(if_wrtinp=1)
            result = problem.solve()
        between += result.max_pressure > 1.001*result.pn.max()
        compare(name, [result])
    check(between >= 2, "the largest pressure is between element centres")
    check(result.max_pressure == np.max(result.pn), "in shifts it is that of an element")


def moving():
    """Shifts in which contact moves, is lost and returns: written grids contain the contact of the case before"""
    contact.output_to(".", "moving")
    forces = []
    with contact.Problem(motion="shift") as problem:
        ball(problem)
        problem.set_grid(30, 14, 1.2, 1.2)
        problem.set_flags(if_wrtinp=1)
        for k, place in enumerate((-10.0, 8.0, -4.0, 10.0)):
            problem.set_distance(lambda x, y, place=place: 0.001*(x - place)**2 + 0.001*y**2)
            problem.set_creepages(0.005, 0.002)
            problem.set_approach(0.01 if k == 2 else 0.05)
            if k == 2:
                problem.set_distance(lambda x, y: 1.0 + 0*x)
            result = problem.solve(initiation=k == 0)
            forces.append([result.fn, result.fx, result.fy])
    shown("moving")
    with open("moving.jsonl", encoding="utf-8") as file:
        cases = [case for case in map(json.loads, file) if case["case"]]
    check(len(cases) == len(forces), "all cases are written")
    for case, force in zip(cases, forces):
        for name, value in zip(("fn", "fx", "fy"), force):
            close(case["patches"][0]["totals"][name]["value"], value, 1e-5*max(forces)[0], f"case {case['case']}: {name}")


def wheels():
    contact.output_to(".", "wheel")
    with contact.WheelRail("right") as pair:
        wheel(pair)
        pair.set_temperatures(10.0, 60.0)
        pair.set_flags(if_wrtinp=1)
        result = pair.solve()
    compare("wheel", result.patches)


def steps():
    """Places of elements and the moment refer to the contact reference in all motions"""
    for side in ("left", "right"):
        for motion in ("steady", "transient", "shift"):
            with contact.WheelRail(side, motion=motion) as pair:
                wheel(pair)
                if motion == "shift":
                    pair.set_velocity(0.02, pitch=-4e-5)
                patch = pair.solve().patches[0]
            area = patch.dx*patch.dy
            x, y = np.meshgrid(patch.x, patch.y)
            moment = area*(x*patch.py - y*patch.px).sum()
            close(moment, patch.mz, 1e-3*patch.fn, f"{side}, {motion}: moment about the contact reference")
            check(abs((x*patch.pn).sum()) < 1.0*patch.pn.sum() and abs((y*patch.pn).sum()) < 1.0*patch.pn.sum(),
                  f"{side}, {motion}: pressures around the contact reference")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        os.chdir(scratch)
        basic()
        moving()
        wheels()
        steps()
        os.chdir(SOURCE)
    finish()
