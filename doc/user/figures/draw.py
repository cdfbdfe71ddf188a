#!/usr/bin/env python3
"""Draws the figures of the manual: axes, placement of rail and wheelset, patches

Usage: draw.py [--check]. Writes *.svg beside itself, or compares them with what it would write. Profiles are those of
examples/profiles, to scale; what is not to scale says so.
"""
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
PROFILES = HERE.parents[2] / "examples/profiles"
RAIL, WHEEL, INK, ACCENT, MARK = "#4a6fa5", "#a5574a", "#222222", "#0a7d4f", "#888888"


def profile(name):
    """Points y, z of a Simpack file"""
    points, inside = [], False
    for line in (PROFILES / name).read_text().split("\n"):
        inside = (inside or "point.begin" in line) and "point.end" not in line
        words = line.split()
        if inside and len(words) >= 2 and "point" not in line:
            points.append((float(words[0]), float(words[1])))
    return points


def turned(points, angle, origin=(0.0, 0.0)):
    """Rolled by an angle about x (y to the right, z down), then moved"""
    c, s = math.cos(angle), math.sin(angle)
    return [(origin[0] + c*y - s*z, origin[1] + s*y + c*z) for y, z in points]


class Picture:
    """An SVG file in the making; scale and origin turn millimetres into units of the picture"""

    def __init__(self, width, height, title, origin=(0.0, 0.0), scale=1.0):
        self.size, self.title, self.origin, self.scale, self.parts = (width, height), title, origin, scale, []

    def place(self, point):
        return self.origin[0] + self.scale*point[0], self.origin[1] + self.scale*point[1]

    def path(self, points, colour=INK, width=1.5, dash="", fill="none"):
        d = " ".join(f"{'ML'[k > 0]}{x:.1f} {y:.1f}" for k, (x, y) in enumerate(map(self.place, points)))
        extra = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<path d="{d}" stroke="{colour}" stroke-width="{width}" fill="{fill}"{extra}/>')

    def arrow(self, start, end, colour=INK, both=False, width=1.3):
        self.path([start, end], colour, width)
        ends = [(start, end)] + ([(end, start)] if both else [])
        for first, last in ends:
            (x0, y0), (x1, y1) = self.place(first), self.place(last)
            angle = math.atan2(y1 - y0, x1 - x0)
            corners = " ".join(f"{x1 - 9*math.cos(angle + turn):.1f},{y1 - 9*math.sin(angle + turn):.1f}" for turn in (-0.35, 0.35))
            self.parts.append(f'<polygon points="{x1:.1f},{y1:.1f} {corners}" fill="{colour}"/>')

    def arc(self, centre, radius, first, last, colour=INK, arrow=True):
        """Part of a circle; angles in degrees from x to y of the picture"""
        steps = 24
        points = [(centre[0] + radius*math.cos(math.radians(first + (last - first)*k/steps)),
                   centre[1] + radius*math.sin(math.radians(first + (last - first)*k/steps))) for k in range(steps + 1)]
        self.path(points[:-1], colour, 1.3)
        if arrow:
            self.arrow(points[-2], points[-1], colour)

    def text(self, point, words, colour=INK, anchor="middle", size=14, shift=(0, 0), bold=False):
        x, y = self.place(point)
        words = words.replace("&", "&amp;").replace("<", "&lt;")
        weight = ' font-weight="bold"' if bold else ""
        self.parts.append(f'<text x="{x + shift[0]:.1f}" y="{y + shift[1]:.1f}" fill="{colour}" font-size="{size}" '
                          f'text-anchor="{anchor}"{weight}>{words}</text>')

    def dot(self, point, colour=INK, radius=3.5):
        x, y = self.place(point)
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{colour}"/>')

    def measure(self, start, end, words, shift=(0, -6), anchor="middle"):
        """A dimension with arrows at both ends"""
        self.arrow(start, end, MARK, both=True)
        self.text(((start[0] + end[0])/2, (start[1] + end[1])/2), words, anchor=anchor, shift=shift)

    def axes(self, at, right, down, length, colour=INK):
        """Two axes of the picture, to the right and downwards, with their names"""
        self.arrow(at, (at[0] + length, at[1]), colour)
        self.arrow(at, (at[0], at[1] + length), colour)
        self.text((at[0] + length, at[1]), right, colour, "start", shift=(4, 5))
        self.text((at[0], at[1] + length), down, colour, shift=(0, 15))
        self.dot(at, colour)

    def svg(self):
        w, h = self.size
        return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {w} {h}" width="{w}" height="{h}" role="img" '
                f'font-family="sans-serif"><title>{self.title}</title>\n<rect width="{w}" height="{h}" fill="white"/>\n'
                + "\n".join(self.parts) + "\n</svg>\n")


def systems():
    """Track, rail, wheelset, wheel and contact, seen from behind"""
    p = Picture(860, 430, "Coordinate systems seen from behind the wheelset: x points away from the reader", (430, 300), 0.42)
    rail, wheel = profile("60E1.prr"), profile("S1002.prw")
    for side in (-1, 1):
        for points, colour, y, angle, z in ((rail, RAIL, 760.5, -0.025, 0.0), (wheel, WHEEL, 750.0, 0.0, -14.0)):
            shape = [(side*a, b) for a, b in turned(points, angle, (y, z))]
            p.path(shape, colour, 2.5)
    p.path([(-680, -30), (-680, -470), (680, -470), (680, -30)], WHEEL, 1, "4 4")
    p.path([(-840, -474), (840, -474)], MARK, 1, "8 4 2 4")
    p.path([(-960, 0), (960, 0)], MARK, 1, "6 4")
    p.text((-960, 0), "top of the rails", MARK, "start", 12, (0, -5))
    p.axes((0, 0), "y", "z", 150)
    p.text((0, 0), "track (TR)", anchor="end", shift=(-10, 18), bold=True)
    p.axes((0, -474), "y", "z", 150, WHEEL)
    p.text((0, -474), "wheelset (WS)", WHEEL, "end", shift=(-10, -8), bold=True)
    p.axes((760.5, 0), "", "", 90, RAIL)
    p.text((850, 40), "rail (R)", RAIL, "start", shift=(6, 20), bold=True)
    p.dot((750, -14), WHEEL)
    p.text((640, -100), "wheel (W): origin of the", WHEEL, "end", 12, (-10, 0))
    p.text((640, -100), "profile, NOMRADW below the axle", WHEEL, "end", 12, (-10, 15))
    p.arrow((622, -66), (738, -18), WHEEL)
    p.text((0, 0), "x is forward, away from you; y to the right; z down", shift=(0, 105))
    p.text((-750, 0), "left: C1 = 0", anchor="middle", shift=(0, 75))
    p.text((750, 0), "right: C1 = 1", anchor="middle", shift=(0, 95))
    p.arc((0, -474), 190, -155, -25, ACCENT)
    p.text((0, -474), "ROLL > 0: the right side goes down", ACCENT, shift=(0, -88))
    return p


def turns():
    """Yaw from above, pitch from the right"""
    p = Picture(860, 330, "Signs of yaw and pitch", (0, 0), 1.0)
    p.text((215, 26), "seen from above", bold=True)
    for y in (90, 340):
        p.path([(y - 6, 60), (y - 6, 300)], RAIL, 2)
        p.path([(y + 6, 60), (y + 6, 300)], RAIL, 2)
    yaw = math.radians(8)

    def turned_place(y, x):
        return 215 + y*math.cos(yaw) - x*math.sin(yaw)*-1, 180 + y*math.sin(yaw) - x*math.cos(yaw)
    p.path([turned_place(-150, 0), turned_place(150, 0)], WHEEL, 4)
    for y in (-125, 125):
        p.path([turned_place(y - 8, -45), turned_place(y + 8, -45), turned_place(y + 8, 45), turned_place(y - 8, 45),
                turned_place(y - 8, -45)], WHEEL, 2)
    p.arrow((215, 300), (215, 60))
    p.text((215, 60), "x, S_WS, VS", anchor="start", shift=(8, 6))
    p.arrow((215, 180), (275, 180))
    p.text((275, 180), "y", anchor="start", shift=(3, -4))
    p.arc((215, 180), 92, -90, -62, ACCENT)
    p.text((262, 90), "YAW > 0", ACCENT, "start")
    p.text((215, 180), "z down", size=12, anchor="end", shift=(-8, 18))
    p.text((640, 26), "seen from the right", bold=True)
    p.path([(480, 280), (820, 280)], RAIL, 3)
    points = [(640 + 110*math.cos(math.radians(a)), 170 + 110*math.sin(math.radians(a))) for a in range(0, 361, 5)]
    p.path(points, WHEEL, 2.5)
    p.dot((640, 170))
    p.arrow((640, 170), (800, 170))
    p.text((800, 170), "VS > 0", anchor="start", shift=(2, -8))
    p.text((800, 170), "x", anchor="start", shift=(4, 5))
    p.arrow((640, 170), (640, 250))
    p.text((640, 250), "z", anchor="start", shift=(6, 0))
    p.text((640, 170), "y towards you", size=12, anchor="end", shift=(-8, -6))
    p.arc((640, 170), 80, -150, -35, ACCENT)
    p.text((640, 76), "a wheel that rolls forward: VPITCH < 0", ACCENT, shift=(0, -24))
    p.text((640, 280), "VPITCH = -VS / rolling radius rolls freely", size=13, shift=(0, 28))
    return p


def rail_placement():
    """Gauge point, cant, origin of the rail's profile"""
    cant = 0.05
    points = turned(profile("60E1.prr"), -cant)
    top = min(points, key=lambda point: point[1])
    gauge = min((point for point in points if point[1] <= top[1] + 14.0), key=lambda point: point[0])
    p = Picture(860, 400, "How the rail is placed by its gauge point (cant drawn as 1:20)", (500, 130), 5.2)
    p.path(points, RAIL, 3)
    p.path([(-85, top[1]), (60, top[1])], MARK, 1, "6 4")
    p.text((-85, top[1]), "z = 0 of the track: top of the rail", MARK, "start", 13, (0, -6))
    p.dot(gauge, ACCENT, 5)
    p.text(gauge, "gauge point", ACCENT, "start", shift=(10, 5), bold=True)
    p.path([(-60, top[1] + 14), (0, top[1] + 14)], MARK, 1, "3 3")
    p.measure((-46, top[1]), (-46, top[1] + 14), "GAUGHT", (-8, 5), "end")
    p.measure((-88, top[1] + 24), (gauge[0], top[1] + 24), "GAUGWD/2, from the middle of the track", (0, 18))
    p.path([(gauge[0], top[1] + 14), (gauge[0], top[1] + 28)], MARK, 1, "3 3")
    origin = (0.0, 0.0)
    axis = turned([(0, 0), (28, 0), (0, 28)], -cant)
    p.arrow(axis[0], axis[1], RAIL)
    p.arrow(axis[0], axis[2], RAIL)
    p.text(axis[1], "y of the profile", RAIL, "start", 13, (4, 2))
    p.text(axis[2], "z of the profile", RAIL, "start", 13, (6, 6))
    p.dot(origin, RAIL, 5)
    p.path([(0, 0), (0, 36)], MARK, 1, "3 3")
    p.text((0, 36), "CANT > 0: the rail leans to the middle of the track", INK, "middle", 13, (60, 26))
    p.text((0, 0), "origin of the profile: RAILY0, RAILZ0", INK, "start", 13, (70, 34))
    p.text((-85, 44), "gauge side", MARK, "start", 13, (0, 20))
    p.text((62, 44), "field side", MARK, "end", 13, (0, 20))
    return p


def wheel_placement():
    """FBDIST, FBPOS, NOMRADW, Y_WS, Z_WS; not to scale"""
    p = Picture(860, 400, "How the wheel is placed in the wheelset, and the wheelset in the track (not to scale)", (110, 60), 1.0)
    wheel = [(560 + 2.0*y, 250 + 2.0*z) for y, z in profile("S1002.prw")]
    back = 560 - 2*70
    p.path([(0, 0), (680, 0)], MARK, 1, "8 4 2 4")
    p.path(wheel, WHEEL, 3)
    p.path([(back, 0), (back, 285)], WHEEL, 1, "4 4")
    p.path([(0, -40), (0, 315)], MARK, 1, "8 4 2 4")
    p.dot((0, 0), WHEEL, 5)
    p.text((0, 0), "middle of the axle", WHEEL, "start", shift=(8, -10), bold=True)
    p.dot((560, 250), WHEEL, 5)
    p.text((560, 250), "origin of the", WHEEL, "end", 13, (-12, -28))
    p.text((560, 250), "wheel's profile", WHEEL, "end", 13, (-12, -12))
    p.measure((0, 60), (back, 60), "FBDIST/2")
    p.measure((back, 190), (560, 190), "-FBPOS")
    p.path([(560, 0), (560, 250)], MARK, 1, "3 3")
    p.measure((620, 0), (620, 250), "NOMRADW", (8, 0), "start")
    p.text((620, 125), "(to the profile at", size=12, anchor="start", shift=(8, 18))
    p.text((620, 125), "YTAPE, if given)", size=12, anchor="start", shift=(8, 33))
    p.path([(-70, 275), (690, 275)], RAIL, 1, "6 4")
    p.text((690, 275), "z = 0 of the track", RAIL, "end", 12, (0, 32))
    p.path([(560, 250), (690, 250)], MARK, 1, "3 3")
    p.measure((660, 250), (660, 275), "-Z_WS", (8, 5), "start")
    p.text((back, 285), "back of the flange", WHEEL, "end", 13, (-8, 18))
    p.path([(-70, -40), (-70, 315)], RAIL, 1, "6 4")
    p.text((-70, 315), "middle of the track", RAIL, "start", 12, (-30, 16))
    p.measure((-70, 120), (0, 120), "Y_WS", (0, -6))
    p.text((10, 230), "Z_WS = 0: the axle is NOMRADW above z = 0;", size=13, anchor="start")
    p.text((10, 230), "Z_WS > 0: it is lower", size=13, anchor="start", shift=(0, 17))
    return p


def contact_axes():
    """Axes of a contact on the gauge side of a right rail"""
    p = Picture(860, 360, "Axes of a contact on the gauge side of a right rail", (560, 90), 5.5)
    rail = profile("60E1.prr")
    p.path(rail, RAIL, 3)
    at = min(rail, key=lambda point: abs(point[0] + 31.0) + 10*(point[1] > 12))
    beside = rail[rail.index(at) + 3] if rail.index(at) + 3 < len(rail) else rail[rail.index(at) - 3]
    before = rail[rail.index(at) - 3]
    delta = math.atan2(beside[1] - before[1], beside[0] - before[0])
    s = (math.cos(delta), math.sin(delta))
    n = (-math.sin(delta), math.cos(delta))
    p.path([(at[0] - 16*s[0], at[1] - 16*s[1]), (at[0] + 16*s[0], at[1] + 16*s[1])], MARK, 1, "5 4")
    p.arrow(at, (at[0] + 12*s[0], at[1] + 12*s[1]), ACCENT, width=2)
    p.arrow(at, (at[0] + 12*n[0], at[1] + 12*n[1]), ACCENT, width=2)
    p.text((at[0] + 12*s[0], at[1] + 12*s[1]), "s: FS, CETA", ACCENT, "end", shift=(-10, 2))
    p.text((at[0] + 12*n[0], at[1] + 12*n[1]), "n: FN", ACCENT, "start", shift=(8, 10))
    p.path([(at[0], at[1]), (at[0] + 16, at[1])], MARK, 1, "5 4")
    p.arc(at, 9, 0, math.degrees(delta), INK)
    p.text((at[0] + 9, at[1]), "DELTCP < 0", INK, "start", shift=(12, -8))
    p.dot(at, ACCENT, 5)
    p.text(at, "contact reference: YCP, ZCP", ACCENT, "end", shift=(-26, 4))
    p.axes((-95, -6), "y", "z", 12)
    p.text((-95, -6), "track", anchor="start", shift=(8, -8), bold=True)
    p.text((-95, 24), "x, FX, CKSI: away from you", anchor="start", size=13)
    p.text((-95, 24), "n points into the rail; FN > 0 presses", anchor="start", size=13, shift=(0, 18))
    p.text((-95, 24), "FY(TR) = FS cos δ - FN sin δ", anchor="start", size=13, shift=(0, 42), bold=True)
    p.text((-95, 24), "FZ(TR) = FS sin δ + FN cos δ", anchor="start", size=13, shift=(0, 62), bold=True)
    return p


def merging():
    """What D_COMB, D_SEP and D_TURN do over the distance of two patches"""
    d_comb, d_sep = 4.0, 8.0
    d_turn = 2*d_sep - d_comb
    p = Picture(860, 330, "Two patches over their distance, for D_COMB = 4, D_SEP = 8, D_TURN = 12 mm", (90, 270), 1.0)
    across, up = 48.0, 200.0
    p.arrow((0, 0), (across*15, 0))
    p.arrow((0, 0), (0, -up - 35))
    p.text((across*15, 0), "distance of the patches [mm]", anchor="end", shift=(0, 38), size=13)
    for value, name in ((d_comb, "D_COMB"), (d_sep, "D_SEP"), (d_turn, "D_TURN")):
        p.path([(across*value, 0), (across*value, -up - 20)], MARK, 1, "4 4")
        p.text((across*value, 0), name, shift=(0, 18))
    steps = [d_comb + (d_sep - d_comb)*k/60 for k in range(61)]
    p.path([(0, -up)] + [(across*d, -up*((d_sep - d)/(d_sep - d_comb))**0.8) for d in steps] + [(across*14.5, 0)], RAIL, 3)
    p.path([(0, -up), (across*d_sep, -up), (across*d_turn, 0), (across*14.5, 0)], WHEEL, 2, "7 4")
    p.text((0, -up), "1", anchor="end", shift=(-8, 5))
    p.text((0, 0), "0", anchor="end", shift=(-8, 5))
    p.text((across*0.2, -up*0.5), "pressures of one act on the other", RAIL, "start", 13)
    p.text((across*0.2, -up*0.5), "(solid)", RAIL, "start", 13, (0, 17))
    p.text((across*11.2, -up*0.62), "planes are turned towards", WHEEL, "start", 13)
    p.text((across*11.2, -up*0.62), "a common one (dashed)", WHEEL, "start", 13, (0, 17))
    for value, words in ((2.0, "one patch"), (6.0, "one patch of two parts"), (10.0, "two, planes turned"), (13.6, "two patches")):
        p.text((across*value, -up - 8), words, size=12)
    return p


FIGURES = {"systems": systems, "turns": turns, "rail_placement": rail_placement, "wheel_placement": wheel_placement,
           "contact_axes": contact_axes, "merging": merging}


def main():
    bad = []
    for name, draw in FIGURES.items():
        path = HERE / f"{name}.svg"
        current = draw().svg()
        if "--check" not in sys.argv:
            path.write_text(current)
        elif not path.exists() or path.read_text() != current:
            bad.append(path.name)
    if bad:
        sys.exit(f"FAILED {', '.join(bad)} of doc/user/figures: python3 doc/user/figures/draw.py")
    print(f"{len(FIGURES)} figures")


if __name__ == "__main__":
    main()
