#!/usr/bin/env python3
"""Worn and measured profiles swept through the program: forces are reached, left and right are mirror images, no jumps.

    worn_profiles.py [--full] [PAIR ...]

CONTACT_PROGRAM names the program; everything is written to the present folder. Profiles are those of examples/make_profiles.py
with wear, noise (fixed seed) and uneven points, in the forms that measuring devices and users leave: Simpack, Miniprof
with a header, tables, reversed, mirrored. Each pair is swept over lateral position, yaw and force for the right and the
left wheel; --full takes finer steps.
"""
import importlib.util
import math
import os
import random
import re
import subprocess
import sys

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FULL = "--full" in sys.argv
QUICK = ("worn", "rough", "rougher_smoothed", "mirrored")  # without --full

# ---- Profiles: lists of points (y, z), z down ------------------------------------------------------


def nominal():
    """Rail 60E1 and wheel S1002"""
    spec = importlib.util.spec_from_file_location("make_profiles", os.path.join(TOP, "examples", "make_profiles.py"))
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made.rail_points(), made.wheel_points(), made.write


def bell(y, centre, width):
    return math.exp(-((y - centre)/width)**2)


def worn_rail(points):
    """Lower crown and gauge corner"""
    return [(y, z + 1.5*bell(y, 5.0, 14.0) + 1.2*bell(y, -24.0, 7.0)) for y, z in points]


def worn_wheel(points, hollow, flange):
    """Hollow tread and thinner flange"""
    return [(y, z - hollow*bell(y, 5.0, 18.0) - flange*bell(y, -36.0, 5.0)) for y, z in points]


def uneven(points, least, most, rng):
    """Points at random distances [mm] along the polyline"""
    chosen, s, next_s = [points[0]], 0.0, rng.uniform(least, most)
    for (ya, za), (yb, zb) in zip(points, points[1:]):
        length = math.hypot(yb - ya, zb - za)
        while next_s < s + length:
            t = (next_s - s)/length
            chosen.append((ya + t*(yb - ya), za + t*(zb - za)))
            next_s += rng.uniform(least, most)
        s += length
    return chosen[:-1] + [points[-1]]


def noisy(points, sigma, rng):
    """Noise along the normal with a standard deviation [mm]"""
    rough = []
    for i, (y, z) in enumerate(points):
        (ya, za), (yb, zb) = points[max(i - 1, 0)], points[min(i + 1, len(points) - 1)]
        shift = rng.gauss(0.0, sigma)/math.hypot(yb - ya, zb - za)
        rough.append((y + shift*(zb - za), z - shift*(yb - ya)))
    return rough


def table(points, name):
    with open(name, "w") as file:
        file.writelines("%14.6f %14.6f\n" % point for point in points)


def miniprof(points, name):
    """As written by the instrument: height up, angles and curvatures in further columns"""
    with open(name, "w", newline="\r\n") as file:
        file.write("FileName=%s\nProgramName=sweep\nDate=01-02-2024\nTime=10:11:12\nXYPoints=%d\nColumnDef=X,Y,A,C\n"
                   "XOffset=0.0\nYOffset=0.0\n\n" % (name, len(points)))
        file.writelines("%.4f\t%.4f\t0.1\t0.001\n" % (y, -z) for y, z in points)


def write_profiles():
    """Pairs of profiles: name -> lines of the input for rail and wheel"""
    rng = random.Random(20241)
    rail, wheel, simpack = nominal()
    simpack("new.prr", 0, "new", rail)
    simpack("new.prw", 1, "new", wheel)
    simpack("worn.prr", 0, "worn", uneven(worn_rail(rail), 0.1, 1.0, rng))
    simpack("hollow.prw", 1, "hollow", uneven(worn_wheel(wheel, 2.0, 1.5), 0.1, 1.0, rng))
    miniprof(noisy(uneven(worn_rail(rail), 0.3, 0.6, rng), 0.01, rng), "rough.ban")
    miniprof(noisy(uneven(worn_wheel(wheel, 1.0, 0.5), 0.3, 0.6, rng), 0.01, rng), "rough.whl")
    miniprof(noisy(uneven(worn_rail(rail), 0.2, 0.5, rng), 0.05, rng)[::-1], "rougher.ban")
    miniprof(noisy(uneven(worn_wheel(wheel, 3.0, 0.5), 0.2, 0.5, rng), 0.05, rng)[::-1], "rougher.whl")
    table([(-y, z) for y, z in uneven(rail, 0.2, 0.9, rng)], "mirrored_rail.txt")
    table([(-y, z) for y, z in uneven(worn_wheel(wheel, 1.0, 1.0), 0.2, 0.9, rng)], "mirrored_wheel.txt")
    weighted, splines = "3.0 0 1\n 1 150d 30d 6d 2.0", "3.0 0 1\n 2 150d 30d 6d 2.0"
    return {
        "new": ("'new.prr' 0 1.0 0.0", "'new.prw' 0 1.0 0.0"),
        "worn": ("'worn.prr' 0 1.0 0.0", "'hollow.prw' 0 1.0 0.0"),
        "rough": ("'rough.ban' 0 1.0 0.0", "'rough.whl' 0 1.0 0.0"),
        "rough_smoothed": ("'rough.ban' 0 1.0 " + weighted, "'rough.whl' 0 1.0 " + weighted),
        "rougher_smoothed": ("'rougher.ban' 0 1.0 " + splines, "'rougher.whl' 0 1.0 " + splines),
        "mirrored": ("'mirrored_rail.txt' 1 1.0 0.0", "'mirrored_wheel.txt' 1 1.0 0.0"),
    }


# ---- Cases -----------------------------------------------------------------------------------------
CONTROL = """ 1 MODULE
 %d203%d00    C-P-B-T-N-F-S
 %s    V-L-D-C-M-Z-E
 0001201    H-G-I-A-O-W-R
 999 100 30 1 1e-5
"""
DATA = """ 0.30 0.30
 0.28 0.28 82000. 82000.
 0.4 0.4 1.0 90d 8.0 4.0
 14.0 0 1435.0 0.025
 %s
 0.0 0.0 0.0 0.0 0.0 0.0
 1360.0 -70.0 460.0
 %s
"""


def solve(name, pair, side, forces, cases):
    """Results of cases (y, yaw, z or force) of the right (1) or left (0) wheel: heights and total forces"""
    sign = 1 if side == 1 else -1
    with open(name + ".inp", "w") as file:
        for i, (y, yaw, third) in enumerate(cases):
            file.write(CONTROL % (side, forces, "0022033" if i == 0 else "0111002"))
            file.write(DATA % pair if i == 0 else "")
            file.write(" 0.0 %g %.9g 0.0 %g 0.0\n 20000. 0.0 0.0 0.0 0.0 -43.5\n\n" % (sign*y, third, sign*yaw))
        file.write(" 0 MODULE\n")
    run = subprocess.run([os.environ["CONTACT_PROGRAM"], "2", name], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    with open(name + ".out") as file:
        lines, results = file.read().splitlines(), []
    for i, line in enumerate(lines):
        if re.match(r" ?Case +\d+", line):
            results.append([math.nan]*4)
        if "Z_WS" in line and "S_WS" in line:
            results[-1][0] = float(lines[i + 1].split()[2])
        if "FZ(TR)" in line:
            results[-1][1:] = [float(word) for word in lines[i + 1].split()[:3]]
    return run.returncode, results


def main():
    pairs, failures = write_profiles(), 0

    def check(good, text):
        nonlocal failures
        if not good:
            print("FAILED: " + text)
            failures += 1

    lateral = [0.5*i for i in range(-20, 21)] if FULL else [-10, -4, 2, 6, 7, 10]
    yaws = (-0.02, -0.01, 0.0, 0.01, 0.02) if FULL else (-0.02, 0.02)
    cases = [(y, yaw, force) for y in lateral for yaw in yaws for force in (5e3, 50e3, 150e3)[::1 if FULL else 2]]
    chosen = [word for word in sys.argv[1:] if word in pairs] or (pairs if FULL else QUICK)
    for name in chosen:
        both = []
        for side in (1, 0):
            status, results = solve("%s_%d" % (name, side), pairs[name], side, 1, cases)
            check(status == 0 and len(results) == len(cases), "%s: %d of %d cases end" % (name, len(results), len(cases)))
            for (y, yaw, force), result in zip(cases, results):
                check(abs(result[3] - force) <= 1e-3*force, "%s: y %g, yaw %g: the force is %g instead of %g"
                      % (name, y, yaw, result[3], force))
            both.append(results)
        mirrored = all(a[0] == b[0] and [abs(f) for f in a[1:]] == [abs(f) for f in b[1:]] for a, b in zip(*both))
        check(mirrored, name + ": the left wheel is the mirror image of the right one")

    # two patches on the flank of the flange become one as the wheel sinks: the force rises evenly
    heights = [-0.60 + 0.005*i for i in range(41)]
    status, results = solve("sinking", pairs["mirrored"], 1, 0, [(7.0, 0.0, z) for z in heights])
    steps = [b[3] - a[3] for a, b in zip(results, results[1:])]
    check(status == 0 and len(steps) == 40, "sinking wheel: all cases end")
    check(min(steps) > 0.0 and max(steps) < 2.0*sorted(steps)[20],
          "sinking wheel: the force grows by %g to %g N per step" % (min(steps), max(steps)))
    print("%d checks failed" % failures)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
