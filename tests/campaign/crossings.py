#!/usr/bin/env python3
"""Crossing noses in slices: first contact and its position against the vertical gap at all points of the wheel.

    crossings.py PROGRAM [NUMBER] [--seed S]

A nose that rises and widens beside a wing rail that falls, from formulas; the rail of the input are slices of them. The judge
knows the formulas and the points of the wheel, and shares nothing else with the program. Exit status 1 when the height of
the wheel or the place of its contact disagree.
"""
import argparse
import json
import math
import os
import random
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    print("SKIPPED: there is no numpy")
    sys.exit(77)
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import profiles

# Slices are 5 to 20 mm apart with points every 0.4 mm, the wheel has points every 0.1 mm: errors of a micrometre or two; the
# load of 10 N presses the wheel in by as much
HEIGHT, PLACE = 0.004, 0.5  # [mm]

INPUT = """ 1 MODULE
 1200100 CPBTNFS
 00{location}2033 VLDCMZE
 0001211 HGIAOWR
 999 100 30 1 1e-5
 0.3 0.3
 0.28 0.28 82000 82000
 {step} {step} 1 90d 8 4
 -1 750 0 0
 'rail.slcs' 0 1 0
 0 0 0 0 0 0
 1360 -70 460
 'wheel.txt' 0 1 0 -1 0
 {s} {y} 10 {roll} {yaw} 0
 0 0 0 0 0 0
 0 MODULE
"""


def smooth(t):
    """Smooth step: 0 below 0, 1 above 1"""
    t = np.clip(t, 0.0, 1.0)
    return t*t*(3.0 - 2.0*t)


def crossing(rng):
    """Height z(u, y) of a rail, z down, and half the length over which the wheel changes from wing to nose"""
    length, end = rng.uniform(80.0, 200.0), rng.uniform(5.0, 20.0)
    start, narrow, wide = end - rng.uniform(-6.0, 6.0), rng.uniform(3.0, 6.0), rng.uniform(8.0, 14.0)
    height, fall, wing, half = rng.uniform(4.0, 12.0), rng.uniform(0.5, 6.0), rng.uniform(-15.0, -5.0), rng.uniform(10.0, 18.0)

    def z(u, y):
        t = smooth((u + length)/(2.0*length))
        nose = height*t*np.exp(-((y - start - (end - start)*t)/(narrow + (wide - narrow)*t))**2)
        lip = height*(1.0 - 0.7*t)*np.exp(-((y - wing + 6.0*t)/half)**4)
        return fall*(0.3 + t) + 0.6*height + y*y/600.0 - nose - lip + 30.0*smooth((-15.0 - y)/25.0)**2

    return z, length


def axes(roll, yaw):
    c, s = math.cos(roll), math.sin(roll)
    rolled = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    c, s = math.cos(yaw), math.sin(yaw)
    return rolled @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def first_touch(z, wheel, case):
    """Height of the wheelset at first contact, and its position"""
    length = profiles.arc_length(wheel)
    places = np.arange(0.0, length[-1], 0.1)
    across, radius = (profiles.Spline(length, wheel[:, k])(places) for k in (0, 1))
    angles = np.linspace(-0.3, 0.3, 2401)
    best = (math.inf, 0.0, 0.0)
    for part in np.array_split(np.arange(len(places)), 10):
        r = profiles.RADIUS + radius[part][None, :]
        points = np.stack([r*np.sin(angles)[:, None], np.broadcast_to(across[part] + 750.0, (len(angles), len(part))),
                           r*np.cos(angles)[:, None]])
        x, y, down = np.tensordot(axes(case["roll"], case["yaw"]), points, 1)
        y = y + case["y"]
        gap = np.where(np.abs(y - 750.0) <= 39.9, z(x + case["s"], y - 750.0) - down + profiles.RADIUS, math.inf)
        k = np.unravel_index(np.argmin(gap), gap.shape)
        best = min(best, (gap[k], x[k], y[k]))
    return best


def write(folder, name, text):
    with open(os.path.join(folder, name), "w") as file:
        file.write(text)


def judge(program, number, seed):
    """Disagreements in one scene"""
    rng = random.Random(f"{seed}:{number}")
    z, length = crossing(rng)
    case = {"s": rng.uniform(-length, length), "y": rng.uniform(-6.0, 8.0), "yaw": rng.choice([0.0, rng.uniform(-0.02, 0.02)]),
            "roll": rng.choice([0.0, rng.uniform(-0.01, 0.01)])}
    step, apart = rng.choice([0.2, 0.5, 1.0]), rng.choice([5.0, 10.0, 20.0])
    wheel = profiles._shape(repr(["S1002"]))
    touch, x, y = first_touch(z, wheel, case)
    findings = []
    with tempfile.TemporaryDirectory() as folder:
        lines = []
        for k, u in enumerate(np.arange(-400.0, 400.1, apart)):
            write(folder, f"rail_{k}.txt", "".join("%.10g %.10g\n" % (v, z(u, v)) for v in np.arange(-40.0, 40.01, 0.4)))
            lines.append(f"{u:.10g} 'rail_{k}.txt'\n")
        write(folder, "rail.slcs", f"0 1\n{len(lines)}\n0 0 0\n1\n" + "".join(lines))
        write(folder, "wheel.txt", "".join("%.12g %.12g\n" % tuple(point) for point in wheel))
        for location in (2, 5):
            write(folder, "x.inp", INPUT.format(location=location, step=step, **case))
            run = subprocess.run([program, "--json", "--quiet", "2", "x"], cwd=folder, stdin=subprocess.DEVNULL,
                                 capture_output=True, text=True, timeout=120)
            if run.returncode:
                findings.append(f"D = {location}: exit status {run.returncode}, {run.stderr.strip()[-200:]}")
                continue
            with open(os.path.join(folder, "x.jsonl")) as file:
                result = json.loads(file.readline())
            found = result["totals"]["z_ws"]["value"]
            places = [(patch["totals"]["xcp_tr"]["value"], patch["totals"]["ycp_tr"]["value"]) for patch in result["patches"]]
            if abs(found - touch) > HEIGHT:
                findings.append(f"D = {location}: Z_WS {found:.5f}, touches at {touch:.5f} mm, x = {x:.2f}, y = {y:.2f}")
            elif not any(abs(a - x) < PLACE and abs(b - y) < PLACE for a, b in places):
                findings.append(f"D = {location}: contact at {places}, touches at {x:.2f}, {y:.2f}")
    return findings


def main():
    ap = argparse.ArgumentParser()
    ap.add_argument("program")
    ap.add_argument("number", type=int, nargs="?", default=30)
    ap.add_argument("--seed", type=int, default=1)
    options = ap.parse_args()
    wrong = 0
    for number in range(options.number):
        for line in judge(os.path.abspath(options.program), number, options.seed):
            print(f"crossing {number} of seed {options.seed}: {line}")
            wrong += 1
    print(f"{options.number} crossings of seed {options.seed}, {wrong} disagreements")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
