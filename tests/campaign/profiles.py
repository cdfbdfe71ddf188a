"""Profiles of wheels and rails for the campaign: new, worn, scaled, mirrored, measured, made of arcs, grooved, in slices.

A profile is described by a recipe, a dictionary that JSON can hold. `points` turns it into points (y, z) in mm with z down, a rail
from the gauge side to the field side, a wheel from the field side to the flange; `write` writes it as a file of one of the
formats that users have and returns the profile line of the input, `files` returns the texts; `rail`, `wheel`, `pair` draw
recipes at random.

    body      "rail" or "wheel"
    shape     [name, numbers...], see SHAPES
    scale     factor of the size, about the origin [-]
    wear      [[depth, centre, width], ...]: bells of missing material along z [mm]
    waves     [[amplitude, length, phase], ...]: cosines along y, added to z [mm], [mm], [rad]
    spacing   [least, most]: points at random distances along the curve [mm]
    noise     standard deviation along the normal [mm]
    cut       [first, last]: the range of y that is kept [mm]
    refine    number of intervals that take the place of each, on the spline through the points
    reverse   whether the file lists the points in the other order
    mirror    whether the file holds -y, for MIRRORY = 1
    up        whether the file holds -z
    format    "simpack", "miniprof" or "table"
    metres    whether the file is in metres, for SCALEYZ = 1000
    smooth    [ISMOOTH, SMOOTH] of the profile line
    slices    [[position, dy, dz], ...]: displaced copies along the rail [mm] or around the wheel [rad]; or none
    interpol  U_INTPOL of the slices
    seed      of spacing and noise
"""
import ast
import functools
import importlib.util
import math
import os
import random

import numpy as np

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
STEP = 0.25  # distance of generated points along the curve [mm]
RADIUS = 460.0  # of the wheels, when their scale is 1 [mm]


@functools.lru_cache(maxsize=1)
def _standard():
    """The module that generates the profiles of the examples"""
    spec = importlib.util.spec_from_file_location("make_profiles", os.path.join(TOP, "examples", "make_profiles.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


# ---- Shapes: arrays of points (y, z) -------------------------------------------------------------------


def path(start, angle, pieces, step=STEP):
    """Points along lines and arcs that meet without corners

    start      first point (y, z)
    angle      direction there: 0 is towards +y, pi/2 towards +z
    pieces     (length, turn): a line when turn is 0, else an arc whose direction turns by this angle
    """
    y, z = start
    points = [(y, z)]
    for length, turn in pieces:
        count = max(1, math.ceil(length / step))
        for k in range(1, count + 1):
            t = k / count
            if abs(turn) < 1e-12:
                points.append((y + t * length * math.cos(angle), z + t * length * math.sin(angle)))
            else:
                radius = length / turn
                points.append((y + radius * (math.sin(angle + t * turn) - math.sin(angle)),
                               z - radius * (math.cos(angle + t * turn) - math.cos(angle))))
        y, z = points[-1]
        angle += turn
    return np.array(points)


def head(radii, angles, side):
    """Rail head: arcs of these radii through these angles from the top, then straight sides of this length"""
    half = path((0.0, 0.0), 0.0, [(r * a, a) for r, a in zip(radii, angles)] + [(side, 0.0)])
    return np.vstack([(half * [-1.0, 1.0])[:0:-1], half])


def flanged(cone, throat, flank, straight, tip):
    """Wheel of lines and arcs: cone [-], radius of the throat, angle and length of the flank, radius of the flange"""
    slope = math.atan(cone)
    points = path((60.0, -60.0 * cone), math.pi - slope,
                  [(85.0, 0.0), (throat * (flank - slope), -(flank - slope)), (straight, 0.0),
                   (tip * (flank + 1.3), flank + 1.3)])
    return points - [0.0, np.interp(0.0, points[::-1, 0], points[::-1, 1])]


def crown(radius, width):
    """Arc of this radius and half width, its top at the origin"""
    a = math.asin(width / radius)
    half = path((0.0, 0.0), 0.0, [(radius * a, a)])
    return np.vstack([(half * [-1.0, 1.0])[:0:-1], half])


def grooved(depth, width):
    """Top of radius 300 with a groove of this depth and width along it"""
    y = np.arange(-25.0, 25.05, 0.1)
    return np.column_stack([y, y * y / 600.0 + depth * np.exp(-(y / width)**2)])


def guarded(lip, flangeway, bottom):
    """Rail 60E1 with a guard rail on its gauge side: height of the lip below the top, width and depth of the way for the flange"""
    rail = SHAPES["60E1"]()
    rail = rail[np.argmax(rail[:, 1] < bottom - 6.0):]
    steep = 0.05  # inclination of the face of the guard rail
    angle = math.atan2(rail[0, 1] - rail[1, 1], rail[0, 0] - rail[1, 0])  # down along the gauge face
    # From the gauge face through the round corners of the bottom, up to the lip and over it; the file has the other order
    pieces = [(6.0 * (math.pi - angle), math.pi - angle), (max(1.0, flangeway - 12.0), 0.0),
              (6.0 * (math.pi / 2 - steep), math.pi / 2 - steep)]
    rise = path(rail[0], angle, pieces)[-1, 1] - lip - 4.0
    way = path(rail[0], angle, pieces + [(rise, 0.0), (5.6, -1.4), (12.0, 0.0), (3.2, -0.8)])
    return np.vstack([way[:0:-1], rail])


SHAPES = {
    "60E1": lambda: np.array(_standard().rail_points()),
    "S1002": lambda: np.array(_standard().wheel_points()),
    "head": head,  # radii, angles, length of the sides
    "flanged": flanged,  # cone, throat, flank, straight, tip
    "crown": crown,  # radius, half width: a rail
    "grooved": grooved,  # depth, width: a rail
    "guarded": guarded,  # lip, flangeway, bottom: a rail
    "barrel": lambda radius, width: crown(radius, width)[::-1] * [1.0, -1.0],  # a wheel without flange
    "cylinder": lambda width: np.column_stack([np.linspace(width, -width, 2 * int(width) + 1), np.zeros(2 * int(width) + 1)]),
}


# ---- Splines -----------------------------------------------------------------------------------------------


def arc_length(points):
    """Length of the chords up to each point"""
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])


def banded(bands, right):
    """Solution for a symmetric pentadiagonal matrix, by its triangular factors"""
    d, e, g, x = [list(map(float, part)) for part in (*bands, right)]
    n = len(d)
    e += [0.0] * (n - len(e))
    g += [0.0] * (n - len(g))
    for i in range(n):
        first, last = e[i] / d[i], g[i] / d[i]
        if i + 1 < n:
            d[i + 1] -= first * e[i]
            e[i + 1] -= first * g[i]
            x[i + 1] -= first * x[i]
        if i + 2 < n:
            d[i + 2] -= last * g[i]
            x[i + 2] -= last * x[i]
        e[i], g[i] = first, last
    for i in range(n - 1, -1, -1):
        x[i] /= d[i]
        if i + 1 < n:
            x[i] -= e[i] * x[i + 1]
        if i + 2 < n:
            x[i] -= g[i] * x[i + 2]
    return np.array(x)


class Spline:
    """Natural cubic spline through values at increasing abscissas, or smoothed: weights w, penalty lam on the curvature"""

    def __init__(self, s, f, lam=0.0, w=None):
        self.s = s = np.asarray(s, float)
        f = np.asarray(f, float)
        n = len(s)
        h = np.diff(s)
        m = np.zeros(n)  # second derivatives
        if n > 2:
            # columns of second differences: 1/h, -1/h - 1/h, 1/h
            before, after = 1.0 / h[:-1], 1.0 / h[1:]
            middle = -before - after
            second = before * f[:-2] + middle * f[1:-1] + after * f[2:]
            bands = [(h[:-1] + h[1:]) / 3.0, h[1:-1] / 6.0, np.zeros(max(n - 4, 0))]
            if lam > 1e-10:
                v = np.ones(n) if w is None else 1.0 / np.asarray(w, float)
                bands[0] = bands[0] + lam * (v[:-2] * before**2 + v[1:-1] * middle**2 + v[2:] * after**2)
                bands[1] = bands[1] + lam * (v[1:-2] * middle[:-1] * before[1:] + v[2:-1] * after[:-1] * middle[1:])
                bands[2] = bands[2] + lam * v[2:-2] * after[:-2] * before[2:]
            m[1:-1] = banded(bands, second)
            if lam > 1e-10:
                change = np.zeros(n)
                change[:-2] += before * m[1:-1]
                change[1:-1] += middle * m[1:-1]
                change[2:] += after * m[1:-1]
                f = f - lam * v * change
        self.f, self.m, self.h = f, m, h

    def __call__(self, s, order=0):
        """Value, or derivative of this order; straight beyond the ends"""
        s = np.asarray(s, float)
        inside = np.clip(s, self.s[0], self.s[-1])
        k = np.clip(np.searchsorted(self.s, inside, side="right") - 1, 0, len(self.h) - 1)
        h, m, f = self.h[k], self.m, self.f
        t, u = inside - self.s[k], self.s[k + 1] - inside
        slope = (f[k + 1] - f[k]) / h - h * (m[k + 1] - m[k]) / 6.0 + (m[k + 1] * t**2 - m[k] * u**2) / (2.0 * h)
        if order == 1:
            return slope
        if order == 2:
            return (m[k] * u + m[k + 1] * t) / h
        value = (m[k] * u**3 + m[k + 1] * t**3) / (6.0 * h) + (f[k] / h - m[k] * h / 6.0) * u
        return value + (f[k + 1] / h - m[k + 1] * h / 6.0) * t + slope * (s - inside)


@functools.lru_cache(maxsize=16)
def _shape(words):
    """Points of a shape, computed once"""
    name, *numbers = ast.literal_eval(words)
    return np.array(SHAPES[name](*numbers))


# ---- Recipes ------------------------------------------------------------------------------------------------


def points(recipe):
    """Points (y, z) [mm] of a recipe, as in its file, with order, mirroring and unit reversed"""
    rng = random.Random(recipe.get("seed", 0))
    curve = _shape(repr(recipe["shape"])).copy()
    rail = recipe["body"] == "rail"
    for depth, centre, width in recipe.get("wear") or []:
        curve[:, 1] += (1.0 if rail else -1.0) * depth * np.exp(-((curve[:, 0] - centre) / width)**2)
    for amplitude, length, phase in recipe.get("waves") or []:
        curve[:, 1] += amplitude * np.cos(2.0 * math.pi * curve[:, 0] / length + phase)
    if recipe.get("cut"):
        first, last = recipe["cut"]
        curve = curve[(curve[:, 0] >= first) & (curve[:, 0] <= last)]
    if recipe.get("spacing"):
        s = arc_length(curve)
        places, place = [], 0.0
        while place < s[-1]:
            places.append(place)
            place += rng.uniform(*recipe["spacing"])
        places.append(s[-1])
        curve = np.column_stack([np.interp(places, s, curve[:, 0]), np.interp(places, s, curve[:, 1])])
    if recipe.get("noise"):
        along = np.gradient(curve, axis=0)
        along /= np.hypot(*along.T)[:, None]
        shift = np.array([rng.gauss(0.0, recipe["noise"]) for _ in curve])
        curve = curve + shift[:, None] * np.column_stack([along[:, 1], -along[:, 0]])
    curve = curve * recipe.get("scale", 1.0)
    if recipe.get("refine"):
        s = arc_length(curve)
        places = np.interp(np.arange((len(s) - 1) * recipe["refine"] + 1) / recipe["refine"], np.arange(len(s)), s)
        curve = np.column_stack([Spline(s, curve[:, k])(places) for k in (0, 1)])
    return np.round(curve, 10)


def simpack(body, curve, keywords):
    """Text of a file of a curve; lines with further keywords"""
    return ("header.begin\n  version = 1\n  type    = %d\nheader.end\nspline.begin\n" % (0 if body == "rail" else 1)
            + "".join("  %s\n" % line for line in keywords) + "  point.begin\n"
            + "".join("  %.13g %.13g\n" % tuple(point) for point in curve) + "  point.end\nspline.end\n")


def miniprof(curve):
    """Text as the instrument writes it, with angles and curvatures in further columns"""
    text = "FileName=campaign\nDate=01-02-2024\nXYPoints=%d\nColumnDef=X,Y,A,C\nXOffset=0.0\nYOffset=0.0\n\n" % len(curve)
    return (text + "".join("%.13g\t%.13g\t0.1\t0.001\n" % tuple(point) for point in curve)).replace("\n", "\r\n")


def table(curve):
    """Text of two columns"""
    return "% y z\n" + "".join("%.13g %.13g\n" % tuple(point) for point in curve)


EXTENSIONS = {("simpack", "rail"): "prr", ("simpack", "wheel"): "prw", ("miniprof", "rail"): "ban", ("miniprof", "wheel"): "whl",
              ("table", "rail"): "txt", ("table", "wheel"): "txt"}


def files(recipe, stem):
    """The profile lines of the input, and the text of the file, or of the files of slices, by their names"""
    body, form = recipe["body"], recipe.get("format", "simpack")
    factor = 1e-3 if recipe.get("metres") else 1.0
    sign = [-factor if recipe.get("mirror") else factor, -factor if recipe.get("up") else factor]
    order = -1 if recipe.get("reverse") else 1
    extension = EXTENSIONS[form, body]

    def one(curve):
        held = (curve * sign)[::order]
        if form == "simpack":
            return simpack(body, held, [] if recipe.get("metres") else ["units.len.f = 1000."])
        return miniprof(held) if form == "miniprof" else table(held)

    curve = points(recipe)
    if recipe.get("slices"):
        name = "%s.%s" % (stem, "slcs" if body == "rail" else "slcw")
        held, lines = {}, []
        for k, (place, dy, dz) in enumerate(recipe["slices"]):
            part = "%s_%02d.%s" % (stem, k + 1, extension)
            held[part] = one(curve + [dy, dz])
            lines.append("%.12g '%s'\n" % (place, part))
        held[name] = ("0.0 1.0   OFFSET SCALE\n%d   NSLC\n0 0 0   NFEAT NKINK NACCEL\n%d   INTPOL\n%s"
                      % (len(lines), recipe.get("interpol", 1), "".join(lines)))
    else:
        name = "%s.%s" % (stem, extension)
        held = {name: one(curve)}
    scale = 1000.0 if recipe.get("metres") and form != "simpack" else 1.0
    method, smooth = recipe.get("smooth") or [0, 0.0]
    up = 1 if recipe.get("up") else -1 if form != "simpack" else 0
    line = " '%s' %d %g %.12g %d %d" % (name, 1 if recipe.get("mirror") else 0, scale, smooth, up, 1 if method else 0)
    return line + ("\n %d 150d 30d 6d 2.0" % method if method else ""), held


def write(recipe, folder, stem):
    """Write the file, or the files of slices, into the folder; returns the profile lines of the input"""
    lines, held = files(recipe, stem)
    for name, text in held.items():
        with open(os.path.join(folder, name), "w", newline="") as file:
            file.write(text)
    return lines


def prepared(recipe):
    """Curve y(s), z(s) of a recipe as the program should represent it: two splines over the arc length, smoothed as requested

    The corners that the program keeps are not looked for: shapes of this module have none within the parts that touch.
    """
    curve = points(recipe)
    s = arc_length(curve)
    method, smooth = recipe.get("smooth") or [0, 0.0]
    if method == 2 and smooth > 0.0:
        raise ValueError("no spline of method 2 here")
    lam, weights = smooth, None
    if method == 1:
        lam = (smooth / (2.0 * math.pi))**4
        weights = np.gradient(s)
        weights[0], weights[-1] = 20.0 * (s[1] - s[0]), 20.0 * (s[-1] - s[-2])
        weights[1:-1] = 0.5 * (s[2:] - s[:-2])
    return Spline(s, curve[:, 0], lam, weights), Spline(s, curve[:, 1], lam, weights)


# ---- At random ----------------------------------------------------------------------------------------------


def _file(rng, recipe):
    """Draw the form of the file"""
    recipe["format"] = rng.choice(["simpack", "simpack", "miniprof", "table"])
    if rng.random() < 0.2:
        recipe["mirror"] = 1
    if rng.random() < 0.2:
        recipe["reverse"] = 1
    if rng.random() < 0.15 or (recipe["format"] == "miniprof" and rng.random() < 0.7):
        recipe["up"] = 1
    if rng.random() < 0.1:
        recipe["metres"] = 1
    return recipe


def _measured(rng, recipe):
    """Sometimes points at uneven distances, with noise, and then smoothed"""
    recipe["seed"] = rng.randrange(10**6)
    kind = rng.choice(["drawn", "drawn", "drawn", "uneven", "rough", "smoothed"])
    if kind == "uneven":
        recipe["spacing"] = [0.2, rng.uniform(0.4, 1.0)]
        recipe["smooth"] = [1, rng.uniform(1.0, 4.0)]
    elif kind == "rough":
        recipe["spacing"] = [0.2, rng.uniform(0.3, 0.7)]
        recipe["noise"] = 10.0**rng.uniform(-3.3, -2.0)
        recipe["smooth"] = [1, rng.uniform(3.0, 6.0)]
    elif kind == "smoothed":
        recipe["smooth"] = rng.choice([[0, rng.uniform(0.1, 10.0)], [1, rng.uniform(1.0, 5.0)], [2, rng.uniform(1.0, 5.0)]])
    return recipe


def rail(rng):
    """Recipe of a rail with a gauge face"""
    recipe = {"body": "rail", "shape": ["60E1"]}
    if rng.random() < 0.4:
        a1, a2 = rng.uniform(0.02, 0.05), rng.uniform(0.12, 0.25)
        corner = rng.uniform(8.0, 16.0)
        radii = [rng.uniform(150.0, 500.0), rng.uniform(60.0, 120.0), corner]
        recipe["shape"] = ["head", radii, [a1, a2, math.pi / 2 - rng.uniform(0.03, 0.1) - a1 - a2], rng.uniform(12.0, 25.0)]
    if rng.random() < 0.35:
        recipe["wear"] = [[rng.uniform(0.2, 2.5), rng.uniform(-5.0, 10.0), rng.uniform(10.0, 20.0)],
                          [rng.uniform(0.2, 2.0), rng.uniform(-30.0, -20.0), rng.uniform(5.0, 10.0)]]
    if rng.random() < 0.1:
        recipe["waves"] = [[rng.uniform(0.005, 0.05), rng.uniform(15.0, 40.0), rng.uniform(0.0, 6.28)]]
    return _file(rng, _measured(rng, recipe))


def wheel(rng):
    """Recipe of a wheel with a flange"""
    recipe = {"body": "wheel", "shape": ["S1002"]}
    if rng.random() < 0.4:
        recipe["shape"] = ["flanged", rng.uniform(0.02, 0.12), rng.uniform(12.0, 18.0), math.radians(rng.uniform(58.0, 74.0)),
                           rng.uniform(1.0, 4.0), rng.uniform(10.0, 14.0)]
    if rng.random() < 0.35:
        recipe["wear"] = [[rng.uniform(0.2, 3.0), rng.uniform(-5.0, 10.0), rng.uniform(14.0, 22.0)],
                          [rng.uniform(0.1, 1.5), rng.uniform(-40.0, -34.0), rng.uniform(4.0, 8.0)]]
    return _file(rng, _measured(rng, recipe))


def pair(rng):
    """Rail, wheel and their positions: a dictionary with the recipes, the track and the wheelset

    track      GAUGHT GAUGSQ GAUGWD CANT, or RAILY0 and RAILZ0 in place of GAUGSQ and GAUGWD when GAUGHT is not positive; for
               the right side of the track
    wheelset   FBDIST FBPOS NOMRADW
    kind       "flanged", "scaled", "crown", "grooved", "guarded", "flat", "varying"
    """
    kind = rng.choices(["flanged", "scaled", "crown", "grooved", "guarded", "flat", "varying"], [10, 2, 2, 1, 1, 1, 1])[0]
    cant = rng.choice([0.0, 0.025, 0.05, rng.uniform(-0.02, 0.08)])
    size = rng.choice([0.2, 0.25, 0.5, 0.8, 1.25]) if kind == "scaled" else 1.0
    if kind in ("crown", "grooved"):
        shape = ["grooved", rng.uniform(0.01, 0.3), rng.uniform(1.0, 6.0)] if kind == "grooved" else \
            ["crown", 10.0**rng.uniform(1.5, 3.0), rng.uniform(15.0, 25.0)]
        other = rng.choice([["cylinder", 30], ["barrel", 10.0**rng.uniform(2.0, 3.5), 25.0]])
        return {"kind": kind, "rail": {"body": "rail", "shape": shape, "format": "table"},
                "wheel": {"body": "wheel", "shape": other, "format": "table"},
                "track": [-1.0, 0.0, 0.0, rng.choice([0.0, 0.0, 0.01])], "wheelset": [0.0, 0.0, 10.0**rng.uniform(1.7, 2.8)]}
    one, two = rail(rng), wheel(rng)
    track = [14.0 * size, 0, 1435.0 * size, cant]
    if kind == "scaled":
        one["scale"] = two["scale"] = size
        one.pop("smooth", None), two.pop("smooth", None)
        one.pop("noise", None), two.pop("noise", None)
        if size < 0.8:  # points nearer than 1e-4 file units are dropped
            one.pop("metres", None), two.pop("metres", None)
    elif kind == "guarded":
        one = {"body": "rail", "shape": ["guarded", rng.uniform(0.0, 4.0), rng.uniform(36.0, 45.0), rng.uniform(38.0, 47.0)],
               "format": rng.choice(["simpack", "table"])}
    elif kind == "flat":
        depth, half = rng.uniform(0.05, 0.8), rng.uniform(15.0, 40.0) / RADIUS
        two = {"body": "wheel", "shape": ["S1002"], "cut": [-56.0, 45.0], "format": "simpack", "spacing": [1.0, 1.0],
               "slices": [[angle, 0.0, -round(depth * math.cos(min(1.0, abs(angle) / half) * math.pi / 2)**2, 9)]
                          for angle in (round(0.006 * k, 6) for k in range(-22, 23))]}
    elif kind == "varying":
        count, step = rng.choice([5, 9, 15]), rng.uniform(20.0, 100.0)
        one = {"body": "rail", "shape": ["60E1"], "format": "simpack", "spacing": [0.5, 0.5], "interpol": rng.choice([1, 1, 2]),
               "slices": [[round(step * (k - count // 2), 6), round(rng.gauss(0.0, 0.1), 6), round(rng.gauss(0.0, 0.05), 6)]
                          for k in range(count)]}
    if kind in ("guarded", "varying") or rng.random() < 0.15:
        track = [-1.0, 752.0 * size, 0.0, cant]
    return {"kind": kind, "rail": one, "wheel": two, "track": track,
            "wheelset": [1360.0 * size, -70.0 * size, RADIUS * size]}
