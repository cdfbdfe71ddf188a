#!/usr/bin/env python3
"""Write the wheel profile S1002 and the rail head 60E1 as Simpack files, from their standard geometry.

    python3 make_profiles.py [folder]          writes S1002.prw, 60E1.prr, flat.slcw, groove.txt and roller.txt (default: profiles)
    python3 make_profiles.py --joints          prints how well neighbouring sections fit

Sources: EN 13715 (wheel S1002), EN 13674-1 (rail 60E1). Coordinates in mm, y to the field side, z down.
The rail is the design section, not inclined: give the inclination 1:20 or 1:40 as CANT.
"""
import math
import os
import sys

STEP = 0.25  # largest distance of points along the curve [mm]
RAIL_BOTTOM = 35.0  # depth of the lower ends of the sides of the rail head below the top [mm]

# ---- S1002: z(y) section by section from the field side to the flange back -------------------------
# Polynomials of the tread (B) and of the throat (C) with their published coefficients, increasing powers
TREAD = [0.0, -3.358537058e-2, 1.565681624e-3, -2.810427944e-5, 5.844240864e-8, -1.562379023e-8,
         5.309217349e-15, -5.957839843e-12, 2.646656573e-13]
THROAT = [-4.320221063e3, -1.038384026e3, -1.065501873e2, -6.051367875, -2.054332446e-1,
          -4.169739389e-3, -4.687195829e-5, -2.252755540e-7]


def polynomial(coefficients):
    return lambda y: sum(c * y**k for k, c in enumerate(coefficients))


def circle(y0, z0, radius, below):
    """Lower or upper half of a circle; below: larger z, as z points down"""
    sign = 1.0 if below else -1.0
    return lambda y: z0 + sign * math.sqrt(max(0.0, radius**2 - (y - y0)**2))


# (name, y at the start, y at the end, z(y)); H is the outer, D the inner side of the flange
WHEEL = [
    ("A cone 1:15", 60.0, 32.15796, lambda y: 1.364323640 - 0.066666667 * y),
    ("B tread", 32.15796, -26.0, polynomial(TREAD)),
    ("C throat", -26.0, -35.0, polynomial(THROAT)),
    ("D radius 13", -35.0, -38.426669, circle(-26.210665, 16.446, 13.0, False)),
    ("E flank 70 degrees", -38.426669, -39.764473, lambda y: -93.576667419 - 2.747477419 * y),
    ("F radius 20", -39.764473, -49.662510, circle(-58.558326413, 8.834924130, 20.0, True)),
    ("G radius 12", -49.662510, -62.764705, circle(-55.0, 16.0, 12.0, True)),
    ("H radius 20.5", -62.764705, -70.0, circle(-49.5, 9.519259302, 20.5, True)),
]


def wheel_points():
    """Points along all sections, including their ends"""
    points = []
    for _, start, end, z in WHEEL:
        fine = 2000
        ys = [start + (end - start) * turn(i / fine) for i in range(fine + 1)]
        zs = [z(y) for y in ys]
        points += by_length(ys, zs)[0 if not points else 1:]
    return points


def turn(t):
    """A map of 0...1 to itself, with small slope at both ends, where the flange back is vertical"""
    return 0.5 - 0.5 * math.cos(math.pi * t)


def by_length(ys, zs):
    """The points of a fine polyline that are nearest to equal distances along it"""
    s = [0.0]
    for i in range(1, len(ys)):
        s.append(s[-1] + math.hypot(ys[i] - ys[i - 1], zs[i] - zs[i - 1]))
    n = max(1, math.ceil(s[-1] / STEP))
    chosen, i = [], 0
    for k in range(n + 1):
        while i < len(s) - 1 and s[i] < s[-1] * k / n - 1e-9:
            i += 1
        chosen.append((ys[i], zs[i]))
    return chosen


# ---- 60E1: arcs 300, 80, 13 and sides 1:20, symmetric ----------------------------------------------
# Half widths at the two upper joints [mm]; everything else follows from tangency
WIDTH_300, WIDTH_80 = 20.456 / 2.0, 52.053 / 2.0
SLOPE = 1.0 / 20.0


def rail_sections():
    """Centres, radii and angles (from the vertical) of the arcs on the right-hand side, top first"""
    a1 = math.asin(WIDTH_300 / 300.0)
    y80, z80 = (300.0 - 80.0) * math.sin(a1), 300.0 - (300.0 - 80.0) * math.cos(a1)
    a2 = math.asin((WIDTH_80 - y80) / 80.0)
    y13, z13 = y80 + (80.0 - 13.0) * math.sin(a2), z80 - (80.0 - 13.0) * math.cos(a2)
    a3 = math.pi / 2.0 - math.atan(SLOPE)
    return [("R300", 0.0, 300.0, 300.0, 0.0, a1), ("R80", y80, z80, 80.0, a1, a2), ("R13", y13, z13, 13.0, a2, a3)]


def rail_points():
    """Points from the gauge side to the field side"""
    half = [(0.0, 0.0)]
    for _, y0, z0, radius, a, b in rail_sections():
        n = math.ceil(radius * (b - a) / STEP)
        for k in range(1, n + 1):
            angle = a + (b - a) * k / n
            half.append((y0 + radius * math.sin(angle), z0 - radius * math.cos(angle)))
    y, z = half[-1]
    n = math.ceil((RAIL_BOTTOM - z) / STEP)
    half += [(y + SLOPE * (RAIL_BOTTOM - z) * k / n, z + (RAIL_BOTTOM - z) * k / n) for k in range(1, n + 1)]
    return [(-y, z) for y, z in reversed(half[1:])] + half


# ---- A wheel flat with rounded ends: slices of S1002 with a smaller radius --------------------------
FLAT_DEPTH, FLAT_LENGTH, FLAT_RADIUS = 0.4, 60.0, 460.0  # [mm]
FLAT_SLICES = [3.0 * k for k in range(-12, 13)]  # along the circumference [mm]


def flat_depth(x):
    """Radial deviation at a distance from the middle of the flat"""
    return 0.5 * FLAT_DEPTH * (1.0 + math.cos(2.0 * math.pi * x / FLAT_LENGTH)) if abs(x) < 0.5 * FLAT_LENGTH else 0.0


def write_flat(folder):
    """The slices, every fourth point of tread and throat, and the file that lists them"""
    points = [p for p in wheel_points() if -45.0 < p[0] < 40.0][::4]
    os.makedirs(os.path.join(folder, "flat"), exist_ok=True)
    with open(os.path.join(folder, "flat.slcw"), "w", newline="\n") as f:
        f.write("%% A flat of %g mm, %g mm deep, on a wheel S1002 of radius %g mm; written by make_profiles.py\n\n"
                % (FLAT_LENGTH, FLAT_DEPTH, FLAT_RADIUS))
        f.write("0.0  %.12f    TH_OFFSET [mm], TH_SCALE [rad/mm]\n%d              NSLC\n0 0 0           NFEAT NKINK NACCEL\n"
                "1               TH_INTPOL: 1 = through the slices\n\n" % (1.0 / FLAT_RADIUS, len(FLAT_SLICES)))
        for k, x in enumerate(FLAT_SLICES):
            name = "flat/slice_%02d.prw" % (k + 1)
            f.write("%6.1f  '%s'\n" % (x, name))
            write(os.path.join(folder, name), 1, "S1002, %g mm from the middle of a flat" % x,
                  [(y, z - flat_depth(x)) for y, z in points])


# ---- A rail of radius 300 with a groove along its top, and a wheel that is a cylinder: tables of y and z ----
GROOVE_DEPTH, GROOVE_WIDTH = 0.05, 3.0  # [mm]


def groove_points():
    return [(y, y * y / 600.0 + GROOVE_DEPTH * math.exp(-(y / GROOVE_WIDTH)**2)) for y in (0.1 * k for k in range(-250, 251))]


def write_table(name, points):
    with open(name, "w", newline="\n") as f:
        f.write("% Written by make_profiles.py; y and z in mm\n")
        f.writelines(f"{y:10.4f} {z:12.8f}\n" for y, z in points)


# ---- Output ----------------------------------------------------------------------------------------
def write(name, kind, comment, points):
    with open(name, "w", newline="\n") as f:
        f.write("! Written by make_profiles.py; coordinates in mm\n"
                f"header.begin\n  version = 1\n  type    = {kind}\nheader.end\n"
                f"spline.begin\n  comment     = '{comment}'\n  units.len.f = 1000.\n  inversion   = 0\n  point.begin\n")
        f.writelines(f"  {round(y, 9) + 0.0:15.9f} {round(z, 9) + 0.0:15.9f}\n" for y, z in points)
        f.write("  point.end\nspline.end\n")


def joints():
    print("S1002: step in z [mm] and in the direction [mrad] where sections meet")
    for (_, _, y, left), (name, _, _, right) in zip(WHEEL, WHEEL[1:]):
        h = 1e-5
        directions = (math.atan((left(y + h) - left(y)) / h), math.atan((right(y) - right(y - h)) / h))
        print(f"  y = {y:11.6f}  {right(y) - left(y):10.2e} {1e3 * (directions[1] - directions[0]):8.3f}  before {name}")
    print("60E1: centres and lower ends of the arcs [mm]")
    for name, y0, z0, radius, _, b in rail_sections():
        print(f"  {name:5} centre ({y0:8.4f}, {z0:9.4f})  end ({y0 + radius*math.sin(b):8.4f}, {z0 - radius*math.cos(b):8.4f})")


if __name__ == "__main__":
    if "--joints" in sys.argv[1:]:
        joints()
    else:
        folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(os.path.abspath(__file__)), "profiles")
        write(os.path.join(folder, "S1002.prw"), 1, "S1002, EN 13715", wheel_points())
        write(os.path.join(folder, "60E1.prr"), 0, "60E1, EN 13674-1, not inclined", rail_points())
        write_flat(folder)
        write_table(os.path.join(folder, "groove.txt"), groove_points())
        write_table(os.path.join(folder, "roller.txt"), [(30.0 - k, 0.0) for k in range(61)])
