#!/usr/bin/env python3
"""Published totals of cases with new descriptions: published.py [SCENE ...]

published/figures.json holds numbers of the outputs that are published with the established program (revision 2707,
July 2025): for each scene its origin, and for each case quantity, value as printed and allowed difference. The inputs are
written here from the physical data of the cases, so that only these numbers are needed.
"""
import json
import math
import os
import subprocess
import sys

import out_file

HERE = os.path.dirname(os.path.abspath(__file__))
STEEL = (0.28, 0.28, 82000, 82000)


def case(module, digits, *rows):
    """Text of one case: three words of control digits, then rows of numbers"""
    return "\n".join([str(module)] + digits.split() + [" ".join(str(value) for value in row) for row in rows]) + "\n"


def iteration(eps, most=999):
    return most, 100, 30, 1, eps


def quadric(mx, my, xl, yl, dx, dy, bx, by):
    """Potential contact by its corner, and bodies with constant curvatures"""
    return (1,), (mx, my, xl, yl, dx, dy), (1, 1), (bx, 0, by, 0, 0, 0)


def sampled(n, scale, elliptical):
    """What the pressures of a formula at the centres of n x n elements add up to, as a part of the force of the formula"""
    squares = [(scale*(2*(k + 0.5)/n - 1))**2 for k in range(n)]
    heights = [max(0.0, 1 - x - y) for x in squares for y in squares]
    if elliptical:
        return sum(math.sqrt(height) for height in heights)*1.5/math.pi*(2*scale/n)**2
    return sum(heights)*2/math.pi*(2*scale/n)**2


def simplified_theory():
    """Ellipse of 8 x 4 mm with spin and lateral creepage: half-space, Fastsim with both bounds, FaStrip; reversed on a fine grid

    The published program takes pressures by formula as they are at the centres; here they are scaled to carry FN. FN is what
    the published ones add up to, so that both have the same pressures."""
    def motion(part, spin=0.000625):
        return 82000*part, 0, -0.000625, spin

    ellipse = ((-3,), (44, 44, 8, 4, 1.1))
    yield case(3, "203100 022020 0001341", iteration(1e-6), motion(1), (0.3, 0.3), (0, 0.4, 30000), STEEL, *ellipse)
    for digits in "233100 122320", "223100 122320", "223100 122520":
        yield case(3, digits + " 0100341", motion(sampled(44, 1.1, digits[1] == "2")), (0, 0.4, 30000), STEEL, (1, 1, 1), *ellipse)
    yield case(3, "233100 122320 0101341", motion(sampled(220, 1.1, False), -0.000625), ("180d", 0.08, 30000), STEEL, (1, 1, 1),
               (-3,), (220, 220, 8, 4, 1.1))


def relaxing_cylinders():
    """Two polymer cylinders of 100 mm, 600 N/mm, relaxation times from none to very long; then both elastic limits"""
    line = ((3,), (99, 1, -7.92, 0, 0.16, 1000), (1, 1), (0.01, 0, 0, 0, 0, 0))
    for tau in 0, 0.009, 0.045, 2:
        yield case(3, "203120 022120 0001341", iteration(1e-5, 100), (600000, -0.6, 0, 0), (0.3, 0.3), (0, 0.16, 1000),
                   (0.4, 0.4, 1143, 1143), (1, 1, tau, tau), *line)
    for g in 571.5, 1143:
        yield case(3, "203120 022020 0001341", iteration(1e-5, 100), (600000, -0.6, 0, 0), (0.3, 0.3), (0, 0.16, 1000),
                   (0.4, 0.4, g, g), *line)


def heated(digits, motion, between, temperatures):
    """A case of the heated wheel: backwards at 30 m/s"""
    return case(3, digits, *between[:1], (100000,) + motion, (0.3, 0.3), ("180d", 0.2, 30000), STEEL,
                *[(t, 450, 0.05, 7.85e-6) for t in temperatures], *quadric(216, 45, -7.9, -11.25, 0.2, 0.5, 0.001015, 0.0004215))


def heated_sliding():
    """Ellipse of 5.88 x 10.54 mm: full sliding at 1 m/s, a hot wheel, both; partial slip"""
    for motion, wheel in ((-0.03333, 0, 0), 0), ((0, 0, 0), 150), ((-0.03333, 0, 0), 150), ((-0.002, 0.001, 0.0002), 150):
        yield heated("203100 022020 3002241", motion, [iteration(1e-5)], (0, wheel))


def heated_friction():
    """The same with friction that decreases, then increases with temperature"""
    yield heated("203100 022020 3002431", (-0.03333, 0, 0), [iteration(1e-5)], (0, 0))
    for change in -0.18, 0.18:
        yield case(3, "203100 600000 1102431", (100000, -0.03333, 0, 0), (0.3, 0, change, 400), (0, 1))


def yielding_line():
    """Carter's problem with a layer that yields at 35 N/mm2 and hardens, is ideal, or softens"""
    for k_tau in 4018000, 123000, 0, -20500:
        yield case(3, "203100 022420 000341", iteration(1e-5), (35780, -0.0004, 0, 0), (0.5, 0.5), (0, 0.08, 30000), STEEL,
                   (82000, 0, 35, k_tau), (3,), (30, 1, -1.16, 0, 0.08, 200), (1, 1), (0.001, 0, 0, 0, 0, 0))


def yielding_ball():
    """Cattaneo to Carter with a layer that yields: steady by two solvers, the shift, then steps of rolling"""
    grid = quadric(34, 33, -4.125, -4.125, 0.25, 0.25, 0.002963, 0.002963)
    unit = (0.28, 0.28, 1, 1)
    yield case(3, "203100 022420 001341", iteration(1e-5), (0.4705, -0.0034, 0, 0), (0.4013, 0.4013), (0, 0.25, 1000), unit,
               (1, 0, 0.005, 0.42857), *grid)
    yield case(3, "203100 121420 201341", iteration(1e-5), (0.9, 0.9, 1, 0.9), (0.4705, -0.0034, 0, 0), *grid)
    yield case(3, "202110 101400 101341", (0.4705, 0.6918, 0, 0))
    for _ in range(6):
        yield case(3, "002100 100400 110341", (0.4705, -0.0034, 0, 0))


def two_branches():
    """Carter's problem with friction that decreases with slip velocity: steady, then steps from below and from above"""
    friction = ((0.18, 0.12, 100, 0, 0), (0, 1))
    steady = [(5000, 2000, 30, 1, 1e-7), (0.5, 1, 1, 1.1), (622216, -0.0009999, 0, 0)]
    yield case(3, "203100 422020 0201331", *steady, *friction, (0, 0.1, 45000), STEEL, (3,), (92, 1, -4.6, 0, 0.1, 200), (2, 1),
               (2, 0, 460, -10, 20), (0, 0))
    yield case(3, "002100 100000 0401331", (5000, 2000, 30, 1, 1e-7), (1, 1.1), (622216, -0.001, 0, 0))
    yield case(3, "203100 100000 0200131", *steady)
    for _ in range(4):
        yield case(3, "002100 100000 0401331", (5000, 2000, 30, 1, 1e-7), (-1, 1.1), (622216, -0.001, 0, 0))


def loaded_square():
    """Stresses below a square of 1 mm with unit pressure; then with unit shear as well"""
    depths = [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1, 1.25, 1.667, 2.5, 5]
    places = [-5, -3, -2, -1, -0.8, -0.6, -0.4, -0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1, 2, 3, 5]
    blocks = []
    for points in [1e-5], places:
        blocks += [(9,), (len(points), len(points), len(depths)), points, points, depths]
    yield case(3, "200103 022020 0001541", iteration(1e-6, 80), (1, 0, 0, 0), (1, 1), (0.28, 0.28, 1, 1),
               (1,), (1, 1, -0.4999, -0.4998, 1, 1), (1, 1), (2.16, 0, 2.16, 0, 0, 0), (2, 1), *blocks, (0,))
    yield case(3, "203111 102000 0101541", (1, 0.999, 0, 0), (0, 1, 30000), (0.28, 0.28, 1, 1))


def creep_force_curve():
    """A locomotive wheel, 107 kN: Coulomb friction, ellipse of ratio 0.5"""
    yield case(3, "203100 022020 0000341", (80, 200, 5, 1, 1e-6), (106700, 1e-5, 0, 0), (0.33, 0.33), (0, 0.5, 10000), STEEL,
               (-2,), (48, 44, 0.0008, 0.5, 1.1))
    for k in range(1, 6):
        yield case(3, "203100 100000 0100341", (106700, 0.0004*k, 0, 0))


def write_profile(name, kind, points):
    """A profile of a wheel (1) or rail (0) in the form of Simpack"""
    with open(name, "w", encoding="utf-8") as file:
        file.write("header.begin\n version = 1\n type = %d\nheader.end\nspline.begin\n approx.smooth = 0.\n units.len.f = 1000.\n"
                   " units.ang.f = 1.\n point.begin\n" % kind)
        file.writelines("%12.6f %12.6f\n" % point for point in points)
        file.write(" point.end\nspline.end\n")


def ball_on_plane(digits, position, velocity):
    """The first case of a wheel with a flat tread on a rail with a round head of 100 mm, rolled by 5 degrees"""
    write_profile("ball.prr", 0, [(0.1*k, 100 - math.sqrt(100**2 - (0.1*k)**2)) for k in range(-999, 1000)])
    write_profile("plane.prw", 1, [(float(k), 0.0) for k in range(50, -51, -1)])
    return case(1, digits, iteration(1e-5), (0.4, 0.4), (0.28, 0.28, 200, 200), (0.2, 0.2, 1, "90d", 8, 4), (-1, 0, 0, 0),
                ("'ball.prr'", 0, 1, 0), (0,)*6, (0, 0, 100), ("'plane.prw'", 0, 1, 0), position, velocity, (0, 0, 0, "5d", 0,
                    0), (0,)*6)


def pair_shifted():
    """A wheel on a rail with a prescribed vertical force, a shift, then shifts from it"""
    shift = (0.2, 0, 0, 0, 0, -0.001992)
    yield ball_on_plane("1201100 0022035 0001321", (0, 0, 237, 0, 0.004, 0), shift)
    for k in range(1, 8):
        yield case(1, "1001100 0101002 0111321", (round(0.2*k, 1), 0, 237, 0, 0.004, -0.002 if k == 1 else -0.004), shift)


def pair_rolling():
    """The same pair at a prescribed height: transient rolling"""
    moving = (100, 0, 0, 0, 0, -0.996)
    yield ball_on_plane("1202000 0022035 0001321", (0, 0, -0.2201, 0, 0.004, 0), moving)
    for _ in range(7):
        yield case(1, "1002000 0101002 0101321", (0, 0, -0.2201, 0, 0.004, 0), moving)


def pair_steady():
    """The same pair in steady rolling under its force"""
    yield ball_on_plane("1203100 0022035 0001321", (0, 0, 237, 0, 0.004, 0), (100, 0, 0, 0, 0, -0.996))


SCENES = [simplified_theory, relaxing_cylinders, heated_sliding, heated_friction, yielding_line, yielding_ball, two_branches,
          loaded_square,
          creep_force_curve, pair_shifted, pair_rolling, pair_steady]


def solve(scene):
    """Results of all cases of a scene"""
    name = scene.__name__
    with open(name + ".inp", "w", encoding="utf-8") as file:
        file.write("\n".join(scene()) + "\n0\n")
    run = subprocess.run([os.environ["CONTACT_PROGRAM"], "--quiet", "2", name], stdin=subprocess.DEVNULL, capture_output=True,
                         text=True)
    if run.returncode:
        print("FAILED: %s: exit status %d\n%s%s" % (name, run.returncode, run.stdout, run.stderr[-2000:]))
        return {}
    return out_file.read(name + ".out")


def main(names):
    with open(os.path.join(HERE, "published", "figures.json"), encoding="utf-8") as file:
        stored = json.load(file)
    failures = count = 0
    for scene in SCENES:
        if names and scene.__name__ not in names:
            continue
        cases = solve(scene)
        for number, quantity, value, allowed in stored[scene.__name__]["figures"]:
            count += 1
            found = cases.get(number, {}).get(quantity)
            if found is None or not abs(found - value) <= allowed:
                failures += 1
                print("FAILED: %s, case %d, %s = %s instead of %s within %.2g" % (scene.__name__, number, quantity, found, value,
                                                                                  allowed))
    print("%d published figures, %d failures" % (count, failures))
    return 1 if failures or not count else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
