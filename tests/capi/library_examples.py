#!/usr/bin/env python3
"""Run the examples of the library in C, Fortran and Python: the same results in three languages, and the correct ones.

usage: library_examples.py FOLDER_OF_PROGRAMS
"""
import math
import os
import subprocess
import sys

SOURCE = os.environ["CONTACT_SOURCE"]
failures = []


def check(condition, what):
    """Count one check"""
    if not condition:
        failures.append(what)
        print(f"FAILED {what}")


def table(name, command):
    """What a program prints, as rows of numbers"""
    run = subprocess.run(command, capture_output=True, text=True, check=False,
                         env={**os.environ, "PYTHONPATH": os.path.join(SOURCE, "python")})
    check(run.returncode == 0, f"{name}: exit status {run.returncode}\n{run.stderr}")
    return [[float(word) for word in line.split()] for line in run.stdout.splitlines() if not line.startswith("#")]


def agree(first, second, what):
    """Two tables agree to their last digits"""
    same = len(first) == len(second) > 0 and all(
        len(one) == len(other) and all(abs(a - b) <= 1e-4 * abs(a) + 2e-5 for a, b in zip(one, other))
        for one, other in zip(first, second))
    check(same, f"{what}: {first} and {second}")


def creep_curve(rows):
    """Increasing to the friction coefficient; a layer makes it increase more slowly"""
    check(rows[0][1:] == [0.0, 0.0], "no force without creepage")
    for column in (1, 2):
        ratios = [-row[column] for row in rows]
        check(all(one < other + 1e-5 for one, other in zip(ratios, ratios[1:])), f"column {column} rises")
        if column == 1:
            check(abs(ratios[-1] - 0.35) < 1e-4, "without layer it ends at the friction coefficient")
        else:
            # Tractions on a layer begin at zero at the leading edge and grow by creepage/L = 500 N/mm2 per mm, up to the bound of
            # mu p0 root(2 d/a) = 200 root(d): in the middle row 2.1 N/mm are missing, over 10 mm of width times 0.8, 17 N of 70 kN
            check(2e-4 < 0.35 - ratios[-1] < 4e-4, f"with a layer it ends at {ratios[-1]}, below the friction coefficient")
    check(all(abs(row[2]) < abs(row[1]) for row in rows[1:5]), "the layer makes the curve less steep")
    # Slope by Kalker's coefficient: Fx = G c^2 C11 cksi, C11 = 4.2 within 4 % at this ratio of the ellipse
    slope = -rows[1][1] * 70000.0 / rows[1][0] / (82000.0 * 6.5 * 5.0)
    check(3.6 < slope < 4.6, f"initial slope {slope} is about Kalker's coefficient")


def manchester(rows):
    """Symmetric position without lateral creepage; more wheelset displacement moves the contact to the flange"""
    check([row[0] for row in rows] == [float(y) for y in range(7)], "seven positions")
    check(all(row[1] >= 1 for row in rows), "contact in all positions")
    check(all(abs(row[2]) < 3000.0 for row in rows), "longitudinal forces below the friction")
    check(rows[-1][4] < rows[0][4] - 15.0, "the contact moves towards the gauge corner")
    check(rows[-1][5] < -0.3 < rows[0][5], "its angle grows")


def subsurface(rows):
    """Without friction Hertz: 0.62 of the largest pressure at depth 0.48 a; with much friction at the surface"""
    pressure = 1.5 * 2000.0 / math.pi
    check(abs(rows[0][1] / pressure - 0.62) < 0.01, f"{rows[0][1] / pressure} of the largest pressure, Hertz 0.62")
    check(abs(rows[0][2]) < 0.05 and abs(rows[0][3] - 0.48) < 0.06, "on the axis, at 0.48 a")
    stresses = [row[1] for row in rows]
    check(stresses == sorted(stresses), "friction adds to the stress")
    check(rows[-1][3] == 0.0, "with friction 0.5 the largest stress is at the surface")


def main():
    """All examples"""
    programs = sys.argv[1]
    try:
        import numpy  # noqa: F401
        has_numpy = True
    except ImportError:
        has_numpy = False
        print("skipped: the Python examples, numpy is not installed")
    for name, judge in (("creep_curve", creep_curve), ("manchester", manchester), ("subsurface", subsurface)):
        arguments = [os.path.join(SOURCE, "examples/profiles")] if name == "manchester" else []
        rows = table(f"{name}.c", [os.path.join(programs, f"library_{name}_c"), *arguments])
        fortran = table(f"{name}.f90", [os.path.join(programs, f"library_{name}_f"), *arguments])
        agree(rows, fortran, f"{name} in C and Fortran")
        if has_numpy:
            script = os.path.join(SOURCE, f"examples/library/{name}.py")
            agree(rows, table(f"{name}.py", [sys.executable, script, *arguments]), f"{name} in C and Python")
        if rows and all(rows):
            judge(rows)
    print("library examples: " + ("failed" if failures else "passed"))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
