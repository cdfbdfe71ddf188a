#!/usr/bin/env python3
"""Warnings about a result: truncated contact, stresses between element centres, the kind of temperatures.

The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]
EXAMPLES = os.path.join(SOURCE, "examples")

# A ball of radius 1 on a plane, G = 1: radius of the contact 1.719, pressure 1.508
FORCE = 9.1954
BALL = """3
20{t}{n}0{s}
0022020
0001{o}01
999 100 30 1 1e-6
{load} {cksi} 0 0
0.3 0.3
0d {dx} 1000
0.28 0.28 1 1
{grid}
{shape}
{points}"""
CUT_OFF = "cut off"


def ball(grid, shape="1 1\n0.5 0 0.5 0 0 0", load=FORCE, t=3, n=1, cksi=0.001, dx=0.1, s=0, points="", o=2):
    """Input of one case, without the end"""
    text = BALL.format(grid=grid, shape=shape, load=load, t=t, n=n, cksi=cksi, dx=dx, s=s, points=points, o=o)
    if t == 0:
        text = "\n".join(line for line in text.split("\n") if line not in ("0.3 0.3", f"0d {dx} 1000"))
    return text


def hertz_pressure():
    modulus = 1.0/(1.0 - 0.28)
    return (6.0*FORCE*modulus**2/math.pi**3)**(1.0/3.0)


class Program(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def run_text(self, text, *options):
        """Records of the cases, warnings, and the .out file"""
        with open(os.path.join(self.folder, "run.inp"), "w", encoding="utf-8") as file:
            file.write(text + "\n0\n")
        run = subprocess.run([PROGRAM, "--quiet", "--json", *options, "2", "run"], cwd=self.folder, stdin=subprocess.DEVNULL,
                             capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(os.path.join(self.folder, "run.jsonl"), encoding="utf-8") as file:
            cases = [case for case in map(json.loads, file) if case["case"]]
        with open(os.path.join(self.folder, "run.out"), encoding="utf-8") as file:
            out = file.read()
        return cases, [line for line in out.split("\n") if line.startswith(" Warning:")], out


class Strips(Program):
    def test_gap_in_a_contact_area(self):
        """FaStrip takes two parts, one beside the other, for one ellipse: its force is too small by more than a tenth"""
        for gap in (0.0, 0.3, 0.6):
            force, warned = [], []
            for digit, more in ((0, ""), (3, "\n1 1 1"), (5, "\n1 1 1")):
                text = ball("1\n45 45 -2.25 -2.25 0.1 0.1", f"1 3\n0.5 0 0.5 0 0 0\n-3 3 -3 {-gap} -3 3 {gap} 3", cksi=0.2)
                cases, warnings, _ = self.run_text(text.replace("0022020", f"0022{digit}20").replace(
                    "0.28 0.28 1 1\n", f"0.28 0.28 1 1{more}\n"))
                force.append(cases[0]["patches"][0]["totals"]["fx"]["value"])
                warned.append(any("FaStrip on a contact area with a gap" in line for line in warnings))
            self.assertEqual(warned, [False, False, gap > 0.0])
            self.assertEqual(abs(force[2] - force[0]) > 0.1*abs(force[0]), gap > 0.0)


class Border(Program):
    def alarms(self, text):
        cases, warnings, _ = self.run_text(text)
        messages = [line for line in warnings if CUT_OFF in line]
        patches = [patch for case in cases for patch in case["patches"]]
        self.assertEqual(len(messages), sum("border" in patch for patch in patches), messages)
        return messages, patches

    def enough(self, grid, text):
        """The grid recommended by the warning, or None"""
        found = re.search(r"MX = (\d+), MY = (\d+), XL = (\S+), YL = (\S+) would be enough", text)
        return f"1\n{' '.join(found.groups())} {' '.join(grid.split()[-2:])}" if found else None

    def test_all_sides_are_named_and_a_larger_grid_too(self):
        for grid, load, n in (("10 10 -0.5 -0.5 0.1 0.1", FORCE, 1), ("40 12 -0.4 -0.3 0.02 0.05", FORCE, 1),
                              ("10 10 -0.5 -0.5 0.1 0.1", 2.955, 0)):
            messages, patches = self.alarms(ball("1\n" + grid, load=load, n=n, dx=grid.split()[4]))
            self.assertEqual(len(messages), 1)
            for side in ("x low", "x high", "y low", "y high"):
                self.assertIn(side, messages[0])
                self.assertIn(side, patches[0]["border"]["reached"])
            self.assertGreater(patches[0]["totals"]["border_elements"], 0)
            better = self.enough(grid, messages[0])
            messages, patches = self.alarms(ball(better, load=load, n=n, dx=grid.split()[4]))
            self.assertEqual(messages, [], better)
            self.assertEqual(patches[0]["totals"]["border_elements"], 0)
            self.assertAlmostEqual(patches[0]["totals"]["pmax"]["value"], hertz_pressure(), delta=0.02*hertz_pressure())
            # the window is around the origin as the contact, within the accuracy of elements of a coarse grid
            first = [float(word) for word in better.split()[3:5]]
            for low, number, side in zip(first, better.split()[1:3], grid.split()[4:]):
                high = low + int(number)*float(side)
                self.assertLess(abs(low + high), 2.1*float(side), better)
            # and it is not much too large: twice the contact at most, and some elements
            columns, radius = int(better.split()[1]), 1.719
            self.assertLess(columns*float(grid.split()[4]), 2.0*2.0*radius)

    def test_only_the_sides_that_cut_are_named(self):
        for first, sides in (((-1.0, -2.2), ["x low"]), ((-3.4, -2.2), ["x high"]), ((-2.2, -0.6), ["y low"]),
                             ((-3.4, -3.6), ["x high", "y high"])):
            messages, patches = self.alarms(ball(f"1\n44 44 {first[0]} {first[1]} 0.1 0.1"))
            self.assertEqual(patches[0]["border"]["reached"], f"the border of the potential contact ({', '.join(sides)})")
            better = self.enough("44 44 0 0 0.1 0.1", messages[0])
            self.assertEqual(self.alarms(ball(better))[0], [], better)
            # the prescribed window and the contact of radius 1.72, with some elements beside it
            columns, rows, x, y = better.split()[1:5]
            ends = [float(x), float(y), float(x) + 0.1*int(columns), float(y) + 0.1*int(rows)]
            for side, name in enumerate(("x low", "y low", "x high", "y high")):
                window = [first[0], first[1], first[0] + 4.4, first[1] + 4.4][side]
                if name in sides:
                    self.assertGreater(abs(ends[side]), 1.7, better)
                    self.assertLess(abs(ends[side]), 2.6, better)
                else:
                    self.assertAlmostEqual(ends[side], window, delta=1e-6, msg=better)

    def test_a_larger_grid_is_named_once(self):
        """Later cases on the same grid give the same message, so that they count as one warning"""
        later = "3\n203100\n0100000\n0001201\n999 100 30 1 1e-6\n{load} 0.001 0 0\n"
        messages, _ = self.alarms(ball("1\n10 10 -0.5 -0.5 0.1 0.1") + later.format(load=9.0) + later.format(load=8.0))
        self.assertEqual(["would be enough" in text for text in messages], [True, False, False])
        self.assertEqual(messages[1], messages[2])

    def test_single_row_stays_one(self):
        messages, _ = self.alarms(ball("1\n10 1 -0.5 -500 0.1 1000", shape="1 1\n0.5 0 0 0 0 0", load=2500.0))
        self.assertIn("(x low, x high)", messages[0])
        better = self.enough("10 1 0 0 0.1 1000", messages[0])
        self.assertEqual([better.split()[k] for k in (2, 4)], ["1", "-500"])
        self.assertEqual(self.alarms(ball(better, shape="1 1\n0.5 0 0 0 0 0", load=2500.0))[0], [], better)

    def test_contact_that_turns_up_elsewhere(self):
        """A rotated ellipse in a window that is too narrow along x: free at the lower y while contact is truncated"""
        shape = "1 1\n0.027938643635698302 0.016483396011992665 0.012128411607624984 -0.0011796052442192857 0.0006041789909451606 0"
        grid = "13 21 -0.02872227688322342 -0.11779670523792407 0.002920291453715877 0.007174467852392599"
        messages, patches = self.alarms(ball("1\n" + grid, shape=shape, load=7.640576310631044e-05, n=0, dx=grid.split()[4]))
        self.assertNotIn("y low", patches[0]["border"]["reached"])
        better = self.enough(grid, messages[0])
        self.assertEqual(self.alarms(ball(better, shape=shape, load=7.640576310631044e-05, n=0, dx=grid.split()[4]))[0], [], better)

    def test_profile_over_y(self):
        profile = "2 1\n81 0 1 -4 0.1\n" + "\n".join(f"{0.5*(0.1*k - 4)**2:.6f}" for k in range(81))
        messages, _ = self.alarms(ball("1\n44 20 -2.2 -1.0 0.1 0.1", shape=profile))
        self.assertIn("(y low, y high)", messages[0])
        better = self.enough("44 20 0 0 0.1 0.1", messages[0])
        self.assertEqual(self.alarms(ball(better, shape=profile))[0], [], better)

    def test_given_per_element_knows_no_better_grid(self):
        values = " ".join(f"{0.5*((0.1*i - 0.45)**2 + (0.1*j - 0.45)**2):.6f}" for j in range(10) for i in range(10))
        messages, _ = self.alarms(ball("1\n10 10 -0.5 -0.5 0.1 0.1", shape="9 1\n" + values))
        self.assertEqual(len(messages), 1)
        self.assertNotIn("would be enough", messages[0])

    def test_hertzian_grid_names_its_scale(self):
        # twice the ellipse where there are very few elements
        for mx, my in ((21, 21), (40, 40), (40, 9), (9, 40), (7, 7), (5, 6)):
            messages, _ = self.alarms(ball(f"-1\n{mx} {my} 0.5 0.5 0.7", shape=""))
            scale = float(re.search(r"SCALE = (\S+) would be enough", messages[0]).group(1))
            # two or three elements of the coarser direction are free on each side
            free = 0.5*min(mx, my)*(1.0 - 1.0/scale)
            self.assertTrue(1.4 <= free <= 3.1 if min(mx, my) > 6 else scale == 2.0, (mx, my, scale))
            messages, _patches = self.alarms(ball(f"-1\n{mx} {my} 0.5 0.5 {scale}", shape=""))
            self.assertEqual(messages, [], (mx, my, scale))

    def test_borders_that_are_meant(self):
        cylinder = "1 1\n0.5 0 0 0 0 0"
        # a line contact of length 4 by Hertz: its rows end with it
        self.assertEqual(self.alarms(ball("-4\n40 20 0.5 2.0 1.2", shape="", load=2.0))[0], [])
        punch = "1 1\n0 0 0 0 0 0"
        for grid, shape, load in (("1\n40 1 -2 -5 0.1 10", cylinder, FORCE), ("1\n40 20 -2 -1 0.1 0.1", cylinder, 2.0),
                                  ("1\n20 20 -1 -1 0.1 0.1", punch, FORCE)):
            self.assertEqual(self.alarms(ball(grid, shape=shape, load=load))[0], [], grid)
        # the cylinder that is truncated along x
        self.assertIn("(x low, x high)", self.alarms(ball("1\n10 20 -0.5 -1 0.1 0.1", shape=cylinder))[0][0])

    def test_no_alarm_in_the_examples(self):
        for name in ("bentall", "carter2d", "cattaneo", "wheel_on_rail"):
            run = subprocess.run([PROGRAM, "--quiet", "--json=-", "--output-dir", self.folder, "2", os.path.join(EXAMPLES, name)],
                                 stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, timeout=300)
            for line in run.stdout.splitlines():
                for patch in json.loads(line)["patches"]:
                    self.assertNotIn("border", patch, name)

    def first_case_on_a_short_profile(self, profile, keep, left=False, location="2"):
        """The first case of wheel_on_rail with a part of one of its profiles: contact goes from y = -8 to 2 on the rail"""
        folder = os.path.join(self.folder, "profiles")
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(os.path.join(EXAMPLES, "profiles"), folder)
        rows = []
        with open(os.path.join(folder, profile), encoding="utf-8") as file:
            for row in file.read().split("\n"):
                try:
                    if not keep(float(row.split()[0])):
                        continue
                except (ValueError, IndexError):
                    pass
                rows.append(row)
        with open(os.path.join(folder, profile), "w", encoding="utf-8") as file:
            file.write("\n".join(rows))
        with open(os.path.join(EXAMPLES, "wheel_on_rail.inp"), encoding="utf-8") as file:
            first = file.read().split(" 1 MODULE")[1].replace("0022033", f"00{location}2033")
        return " 1 MODULE" + (first.replace("1203100", "0203100") if left else first)

    def test_ends_of_profiles(self):
        for profile, keep, left, location, end in (
                ("60E1.prr", lambda y: y <= -1.0, False, "2", "outer end of the rail"),
                ("60E1.prr", lambda y: y <= -1.0, True, "2", "outer end of the rail"),
                ("60E1.prr", lambda y: y <= -1.0, False, "4", "outer end of the rail"),
                ("60E1.prr", lambda y: y <= -1.0, False, "5", "outer end of the rail"),
                ("S1002.prw", lambda y: y >= -2.0, False, "2", "inner end of the wheel"),
                ("S1002.prw", lambda y: y <= 2.0, True, "4", "outer end of the wheel")):
            messages, patches = self.alarms(self.first_case_on_a_short_profile(profile, keep, left, location))
            self.assertEqual(patches[0]["border"]["reached"], f"the {end} profile")
            self.assertIn(f"contact patch 1: contact reaches the {end} profile", messages[0])
            self.assertGreater(patches[0]["border"]["pressure"]["value"], 1500.0)

    def test_ends_ahead_of_the_axle(self):
        """Under yaw, contact on the flank is ahead of or behind the axle, and the end of the profile is not where it is below
        the axle"""
        for location, y, yaw in (("2", 7.0, 0.05), ("2", 7.0, -0.05), ("5", 7.0, 0.05), ("5", 8.0, 0.08)):
            text = self.first_case_on_a_short_profile("S1002.prw", lambda y: y >= -36.0, False, location)
            _, patches = self.alarms(text.replace("0.0 0.0 60000. 0.0 0.0 0.0", f"0.0 {y} 60000. 0.0 {yaw} 0.0"))
            self.assertEqual([patch["border"]["reached"] for patch in patches], ["the inner end of the wheel profile"])

    def test_end_in_the_hdf5_file(self):
        try:
            import h5py
        except ImportError:
            self.skipTest("h5py is not installed")
        self.run_text(ball("1\n10 10 -0.5 -0.5 0.1 0.1"), "--hdf5")
        with h5py.File(os.path.join(self.folder, "run.h5")) as file:
            patch = file["case_0001/patch_1"]
            self.assertIn("x low, x high, y low, y high", patch["border"]["reached"][()].decode())
            self.assertEqual(file["patches/border_elements"][0], 36)
        # data of the page
        sys.path.insert(0, os.path.join(SOURCE, "python"))
        from contact.report.read import read_experiment
        described, _ = read_experiment(os.path.join(self.folder, "run.h5"))
        self.assertIn("x low, x high, y low, y high", described["cases"][0]["patches"][0]["border"])


class EndsAheadOfTheAxle(Program):
    """The edge at which the wheel's profile ends touches a guard rail where a yawed wheel approaches it, far from all patches"""
    RADIUS, ROLLER, SIDE = 460.0, 500.0, 750.0
    TOP, WALL = -20.0, ((-51.0, -20.0), (-50.0, 30.0))  # of the guard rail [mm]

    def pair(self, end, yaw, left=False, roller=False, location=2, height=0.05, outside=False):
        """Input of a barrel-shaped wheel from `end` on above a crowned rail with a guard rail on its inner or outer side"""
        rail = [(-80.0, 40.0), (-79.0, self.TOP), *self.WALL, (-45.0, 32.0), (-38.0, 30.0), (-36.0, 10.0)]
        rail = [(a[0] + (b[0] - a[0])*k/20, a[1] + (b[1] - a[1])*k/20) for a, b in zip(rail, rail[1:]) for k in range(20)]
        rail += [(0.5*k, (0.5*k)**2/600.0) for k in range(-70, 71)]
        wheel = [(0.5*k, -(0.5*k)**2/20000.0) for k in range(int(2*end), 121)]  # steps of 0.5 mm
        if outside:
            rail, wheel = ([(-y, z) for y, z in reversed(points)] for points in (rail, wheel))
        for name, points in (("rail.txt", rail), ("wheel.txt", reversed(wheel))):
            with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
                file.write("".join(f"{y:.6f} {z:.6f}\n" for y, z in points))
        sign = -1.0 if left else 1.0
        config = (0 if left else 1) + (4 if roller else 0)
        return f""" 1 MODULE
 {config}203000    C-P-B-T-N-F-S
 00{location}2033    V-L-D-C-M-Z-E
 0001201    H-G-I-A-O-W-R
 999 100 30 1 1e-5
 0.3 0.3
 0.28 0.28 82000. 82000.
 0.5 0.5 1.0 90d 8.0 4.0
 -1 {sign*self.SIDE} 0.0 {self.ROLLER if roller else 0.0}
 'rail.txt' 0 1.0 0.0
 0.0 0.0 0.0 0.0 0.0 0.0
 {2.0*self.SIDE} 0.0 {self.RADIUS}
 'wheel.txt' 0 1.0 0.0
 0.0 0.0 {height} 0.0 {yaw} 0.0
 {20000.0/self.ROLLER if roller else 20000.0} 0.0 0.0 0.0 0.0 {-20000.0/self.RADIUS}
"""

    def depth(self, end, yaw, height, roller):
        """Maximum depth of the wheel's edge below wall and top of the guard rail, and its x: by points on the circle"""
        (y0, z0), (y1, z1) = self.WALL
        best = (0.0, 0.0)
        radius = self.RADIUS - end**2/20000.0
        for k in range(-4000, 4001):
            angle = 1.3e-4*k
            across = self.SIDE + end
            x = math.cos(yaw)*radius*math.sin(angle) - math.sin(yaw)*across
            y = math.sin(yaw)*radius*math.sin(angle) + math.cos(yaw)*across - self.SIDE
            z = height - self.RADIUS + radius*math.cos(angle)
            if roller:
                z = self.ROLLER - math.hypot(x, self.ROLLER - z)
            to_wall = ((y1 - y)*(z1 - z0) - (z1 - z)*(y1 - y0))/math.hypot(y1 - y0, z1 - z0)
            best = max(best, (min(to_wall, z - self.TOP), x))
        return best

    def test_where_it_stands(self):
        for yaw, left, roller, location, outside in (
                (0.03, False, False, 2, False), (-0.03, False, False, 2, False), (0.03, True, False, 2, False),
                (0.03, False, True, 2, False), (-0.03, True, True, 2, False), (0.03, False, False, 2, True),
                (0.03, False, False, 4, False), (-0.03, False, False, 5, False)):
            with self.subTest(yaw=yaw, left=left, roller=roller, location=location, outside=outside):
                end = -49.5 if roller else -48.0
                cases, warnings, _ = self.run_text(self.pair(end, yaw, left, roller, location, outside=outside))
                name = "outer" if outside else "inner"
                depth, place = self.depth(end, -yaw if left else yaw, 0.05, roller)
                messages = [line for line in warnings if "inside the rail, outside all contact patches" in line]
                self.assertEqual(len(messages), 1, warnings)
                found = re.search(r"the (\w+) end of the wheel profile is (\S+) mm inside .* at x = (\S+), y = (\S+), z",
                                  messages[0])
                self.assertEqual(found.group(1), name)
                self.assertIn(found.group(0), " Warning: " + cases[0]["buried"][name])
                if not outside:
                    self.assertGreater(depth, 0.0)
                    self.assertAlmostEqual(float(found.group(2)), depth, delta=2e-3)
                    self.assertAlmostEqual(float(found.group(3)), place, delta=1.0)
                    self.assertGreater(abs(place), 30.0)
                    self.assertEqual(float(found.group(4).rstrip(",")) < 0.0, left)

    def test_nothing_is_told_where_it_stays_apart(self):
        for end, yaw in ((-48.0, 0.005), (-44.0, 0.03), (-48.0, 0.0)):
            cases, warnings, _ = self.run_text(self.pair(end, yaw))
            self.assertEqual(self.depth(end, yaw, 0.05, False)[0], 0.0)
            self.assertNotIn("buried", cases[0])
            self.assertEqual(warnings, [])


class TwoPlacesAlongTheTrack(Program):
    """A dip of the rail: the wheel is supported on both of its sides, at the same lateral position"""

    def dip(self, location, z):
        first, slices = self.first_case(location), []
        y = [0.5*k for k in range(-70, 71)]
        for k in range(-25, 26):
            u, depth = 4.0*k, 0.6*math.cos(math.pi*4.0*k/40.0)**2 if abs(k) < 5 else 0.0
            with open(os.path.join(self.folder, f"rail{k}.txt"), "w", encoding="utf-8") as file:
                file.write("".join(f"{v} {v*v/600.0 + depth:.9f}\n" for v in y))
            slices.append(f"{u} 'rail{k}.txt'\n")
        with open(os.path.join(self.folder, "rail.slcs"), "w", encoding="utf-8") as file:
            file.write(f"0.0 1.0   OFFSET SCALE\n{len(slices)}   NSLC\n0 0 0   NFEAT NKINK NACCEL\n1   INTPOL\n" + "".join(slices))
        return first.replace("0.0 0.0 60000. 0.0 0.0 0.0", f"3.0 0.0 {z} 0.0 0.0 0.0").replace("1203100", "1203000") \
            .replace("'profiles/60E1.prr' 0 1.0 0.0", "'rail.slcs' 0 1.0 0.0").replace("14.0 0 1435.0 0.025", "-1 752.0 0.0 0.025")

    def first_case(self, location):
        shutil.copytree(os.path.join(EXAMPLES, "profiles"), os.path.join(self.folder, "profiles"), dirs_exist_ok=True)
        with open(os.path.join(EXAMPLES, "wheel_on_rail.inp"), encoding="utf-8") as file:
            return " 1 MODULE" + file.read().split(" 1 MODULE")[1].replace("0022033", f"00{location}2033")

    def test_the_second_place_is_told(self):
        both, _, _ = self.run_text(self.dip("5", -1.85))
        self.assertEqual(len(both[0]["patches"]), 2)
        second = min(both[0]["patches"], key=lambda patch: patch["totals"]["fn"]["value"])["totals"]
        cases, warnings, _ = self.run_text(self.dip("2", -1.85))
        messages = [line for line in warnings if "as well, where no contact patch is" in line]
        self.assertEqual(len(messages), 1, warnings)
        self.assertIn("D = 5", messages[0])
        self.assertIn(cases[0]["beside"], messages[0])
        found = re.search(r"at x = (\S+), y = (\S+) mm", messages[0])
        self.assertAlmostEqual(float(found.group(1)), second["xcp_tr"]["value"], delta=1.0)
        self.assertAlmostEqual(float(found.group(2)), second["ycp_tr"]["value"], delta=2.0)

    def test_flank_far_from_the_axle(self):
        """At 0.1 rad of yaw the flange touches 90 mm from the point below the axle: every search reaches as far"""
        found = {}
        for location in ("2", "5"):
            text = self.first_case(location).replace("0.0 0.0 60000. 0.0 0.0 0.0", "0.0 5.0 60000. 0.0 0.1 0.0")
            cases, _, _ = self.run_text(text)
            self.assertEqual(len(cases[0]["patches"]), 1)
            found[location] = (cases[0]["totals"]["z_ws"]["value"], cases[0]["patches"][0]["totals"]["deltcp_tr"]["value"])
        self.assertLess(found["2"][1], -1.0)
        self.assertAlmostEqual(found["5"][0], found["2"][0], delta=1e-3)
        self.assertAlmostEqual(found["5"][1], found["2"][1], delta=5e-3)

    def test_nothing_is_told_of_one_place(self):
        for location, z in (("2", -2.0), ("5", -1.85)):
            cases, warnings, _ = self.run_text(self.dip(location, z))
            self.assertNotIn("beside", cases[0])
            self.assertEqual([line for line in warnings if "as well" in line], [])


class FewElements(Program):
    """Contact of a few elements has an inaccurate area and force, whatever its residual: FZ was off by four on two elements"""

    def warned(self, text):
        cases, warnings, _ = self.run_text(text)
        messages = [line for line in warnings if "elements wide at most" in line]
        patches = [patch for case in cases for patch in case["patches"]]
        self.assertEqual(len(messages), sum("coarse" in patch for patch in patches), messages)
        return messages, patches

    def test_contact_problem(self):
        # a radius of 1.719: elements of 1.2 and 0.9 give 3 and 4 of them across, of 0.6 six
        for side, n, wide in ((1.2, 7, "3 x 3"), (0.9, 8, "4 x 4"), (0.6, 11, "")):
            messages, patches = self.warned(ball(f"1\n{n} {n} {-0.5*n*side} {-0.5*n*side} {side} {side}", dx=side))
            self.assertEqual(len(messages), 1 if wide else 0, side)
            if not wide:
                continue
            self.assertIn(f"contact is {wide} elements wide at most", messages[0])
            self.assertEqual([patches[0]["coarse"]["along_x"], patches[0]["coarse"]["along_y"]], [int(wide[0])]*2)
            # the recommended size is sufficient
            better = float(re.search(r"DX = (\S+),", messages[0]).group(1))
            n = math.ceil(5.0/better)
            messages, patches = self.warned(ball(f"1\n{n} {n} {-0.5*n*better} {-0.5*n*better} {better} {better}", dx=better))
            self.assertEqual(messages, [])
            self.assertAlmostEqual(patches[0]["totals"]["pmax"]["value"], hertz_pressure(), delta=0.05*hertz_pressure())

    def test_rows_stand_for_plane_strain(self):
        self.assertEqual(self.warned(ball("1\n40 1 -2 -5 0.1 10", shape="1 1\n0.5 0 0 0 0 0"))[0], [])
        self.assertEqual(len(self.warned(ball("1\n6 1 -6 -5 2 10", shape="1 1\n0.5 0 0 0 0 0", dx=2.0))[0]), 1)

    def test_wheel_on_rail(self):
        with open(os.path.join(EXAMPLES, "wheel_on_rail.inp"), encoding="utf-8") as file:
            first = " 1 MODULE" + file.read().split(" 1 MODULE")[1]
        os.symlink(os.path.join(EXAMPLES, "profiles"), os.path.join(self.folder, "profiles"))
        self.assertEqual(self.warned(first)[0], [])
        messages, _ = self.warned(first.replace("0.25 0.25 1.0 90d", "4.0 1.0 1.0 90d"))
        self.assertEqual(len(messages), 1)
        self.assertRegex(messages[0], r"contact patch 1: contact is [34] x \d+ elements .* DX = \S+, DS = 1.00 mm")

    def test_in_the_hdf5_file(self):
        try:
            import h5py
        except ImportError:
            self.skipTest("h5py is not installed")
        self.run_text(ball("1\n7 7 -4.2 -4.2 1.2 1.2", dx=1.2), "--hdf5")
        with h5py.File(os.path.join(self.folder, "run.h5")) as file:
            self.assertEqual(file["case_0001/patch_1/coarse/along_y"][()], 3)
        sys.path.insert(0, os.path.join(SOURCE, "python"))
        from contact.report.read import read_experiment
        described, _ = read_experiment(os.path.join(self.folder, "run.h5"))
        self.assertEqual(described["cases"][0]["patches"][0]["coarse"], [3, 3])


class Stresses(Program):
    def stepped(self, points):
        _, warnings, _ = self.run_text(ball("1\n44 44 -2.2 -2.2 0.1 0.1", s=3, points=points))
        return [line for line in warnings if "centres of elements" in line]

    def test_points_between_centres(self):
        near = self.stepped("0 1\n9\n3 1 4\n0 0.02 0.05\n0.05\n0 0.02 0.025 0.5\n0")
        self.assertEqual(len(near), 1)
        # two depths above DX/4, two of three x off the centres; z = DX/4 is deep enough
        self.assertIn(" 4 points ", near[0])
        self.assertEqual(self.stepped("0 1\n9\n3 1 2\n0 0.02 0.05\n0.05\n0.025 0.5\n0"), [])
        self.assertEqual(self.stepped("0 1\n9\n2 2 1\n0.05 0.15\n-0.05 0.05\n0\n0"), [])
        self.assertEqual(self.stepped("0 1\n5\n2\n0 0.5\n0"), [])
        # beside the contact there are no steps
        self.assertEqual(self.stepped("0 1\n9\n1 1 1\n2.0\n2.0\n0\n0"), [])

    def test_blocks_without_points(self):
        """Columns or rows outside the grid, in all forms of a block: it is empty, and the run goes on in all formats"""
        with open(os.path.join(EXAMPLES, "subsurface.inp"), encoding="utf-8") as file:
            ball = file.read().partition("% ---- case 2")[0]
        head = ball[:ball.index("1                                       ISUBS")]
        inside = "7\n1 1\n21\n21\n1\n0.5\n"
        for block in ("7\n1 1\n210\n21\n2\n0.2 0.4\n", "7\n1 1\n21\n210\n2\n0.2 0.4\n", "3\n1 1\n210\n21\n2 0.5 0.5\n",
                      "6\n100 4 137\n5 4 37\n2\n0.1 1\n", "2\n5 4 37\n100 4 137\n2 0.5 0.5\n"):
            cases, _, said = self.run_text(head + block + inside + "0\n0\n", "--hdf5", "--vtk", "--errors")
            self.assertEqual([case["status"] for case in cases], ["solved"], (block, said))
            self.assertIn("max_mises", json.dumps(cases))

    def test_cases_that_are_not_solved(self):
        """R = 3 with points below the surface: there are no pressures and no stresses"""
        shutil.copytree(os.path.join(EXAMPLES, "profiles"), os.path.join(self.folder, "profiles"))
        blocks = "2 1\n1\n3 0.1 0.5\n0\n"
        with open(os.path.join(EXAMPLES, "wheel_on_rail.inp"), encoding="utf-8") as file:
            wheel = " 1 MODULE" + file.read().split(" 1 MODULE")[1].split("\n\n")[0]
        with open(os.path.join(EXAMPLES, "subsurface.inp"), encoding="utf-8") as file:
            ball = file.read().partition("% ---- case 2")[0]
        pair = re.sub(r"0 +C-P-B-T-N-F-S", "3 C-P-B-T-N-F-S", wheel).replace("0001201 ", "0001203 ") + "\n" + blocks
        for text in (pair, ball.replace("0000131", "0000133")):
            cases, _, _ = self.run_text(text, "--hdf5", "--vtk", "--errors")
            self.assertEqual(len(cases), 0)
            self.assertNotIn("max_mises", json.dumps(cases))


class Temperatures(Program):
    # The ball of before is a wheel here: 100 kN, a = 5.88, b = 10.54 mm, full sliding at 1 m/s
    CASE = """3
203100
022020
3001201
999 100 30 1 1e-6
100000 {cksi} 0 0
0.3 0.3
180d {dx} {veloc}
0.28 0.28 82000 82000
0 450 0.05 7.85e-6
0 450 0.05 7.85e-6
1
{mx} 23 -7.9 -11.5 {dx} 1.0
1 1
0.001015 0 0.0004215 0 0 0"""

    def highest(self, *options, mx=79, dx=0.2, cksi=-0.3333333, veloc=3000.0):
        cases, warnings, _ = self.run_text(self.CASE.format(mx=mx, dx=dx, cksi=cksi, veloc=veloc), *options)
        patch = cases[0]["patches"][0]
        return patch["totals"]["max_temp1"]["value"], patch, warnings

    def moving_source(self, patch, veloc):
        """Highest temperature of a Hertzian heat source of fast motion, without elastic slip: the integral over the
        pressure from the leading edge on, by the midpoint rule in t, distance = d (1 - t**2)"""
        semi_axis = 5.88
        effusivity = 1e3*math.sqrt(0.05*7.85e-6*450.0)
        flux = 0.3*patch["totals"]["pmax"]["value"]*1000.0
        n, highest = 400, 0.0
        for k in range(1, 101):
            d = 0.02*k
            integral = sum(math.sqrt(max(0.0, 1.0 - (d*(1.0 - ((i - 0.5)/n)**2) - 1.0)**2)) for i in range(1, n + 1))
            highest = max(highest, 2.0*math.sqrt(d)*integral/n)
        return flux*math.sqrt(semi_axis)/(2.0*effusivity*math.sqrt(math.pi*veloc))*highest

    def test_moving_source_against_its_integral(self):
        found, patch, warnings = self.highest("--heat", "moving-source")
        self.assertAlmostEqual(found/self.moving_source(patch, 3000.0), 1.0, delta=4e-3)
        self.assertIn("surface temperatures (moving source)", patch["effects"])
        self.assertEqual(warnings, [])

    def test_established_is_what_nobody_asked_for(self):
        for options in ((), ("--heat", "established"), ("--heat=established",)):
            found, patch, _ = self.highest(*options)
            self.assertAlmostEqual(found/self.moving_source(patch, 3000.0), 1.096, delta=0.01)
            self.assertIn("surface temperatures (established)", patch["effects"])

    def test_refinement(self):
        """Half the step: an error of the order of the root of the step, or almost none"""
        rough, fine = (self.highest(mx=mx, dx=dx)[0] for mx, dx in ((40, 0.4), (160, 0.1)))
        exact = self.highest("--heat", "moving-source", mx=160, dx=0.1)[0]
        self.assertAlmostEqual((rough/exact - 1.0)/(fine/exact - 1.0), 2.0, delta=0.15)
        self.assertAlmostEqual(self.highest("--heat", "moving-source", mx=40, dx=0.4)[0]/exact, 1.0, delta=3e-3)

    def test_fields_are_those_of_the_named_source(self):
        """Temperatures of every element from slip and tractions in the HDF5 file, by the exact integral over the elements
        upstream of heat that is constant on each element"""
        try:
            import h5py
            import numpy as np
        except ImportError:
            self.skipTest("numpy or h5py is not installed")
        effusivity = 1e3*math.sqrt(0.05*7.85e-6*450.0)
        for source, own in (("moving-source", 1.0), ("established", 2.0)):
            self.run_text(self.CASE.format(mx=79, dx=0.2, cksi=-0.002, veloc=30000.0), "--heat", source, "--hdf5")
            with h5py.File(os.path.join(self.folder, "run.h5")) as file:
                self.assertEqual(file["case_0001/inputs/heat/source"][()].decode().strip(), source.split("-")[0])
                fields = {name: item[...] for name, item in file["case_0001/patch_1/fields"].items()}
            heat = 30000.0*np.hypot(fields["sx"], fields["sy"])*np.hypot(fields["px"], fields["py"])
            # rolling towards -x: particles enter at low x
            edges = np.sqrt(0.2*np.abs(np.arange(80) - 0.5))
            weight = np.concatenate([[own*math.sqrt(0.1)], edges[2:] - edges[1:-1]])
            expected = np.array([np.convolve(row, weight)[:79] for row in heat])/(effusivity*math.sqrt(math.pi*30000.0))
            self.assertGreater(expected.max(), 5.0)
            for body in ("temp1", "temp2"):
                self.assertLess(abs(fields[body] - expected).max(), 1e-6*expected.max(), source)

    def test_slow_motion_is_told(self):
        for veloc, slow in ((3.0, True), (3000.0, False)):
            _, _, warnings = self.highest("--heat", "moving-source", veloc=veloc)
            self.assertEqual(sum("Peclet" in line for line in warnings), int(slow), warnings)

    def test_friction_that_falls_takes_the_chosen_one(self):
        """Temperature-dependent friction: the established temperatures are higher, friction is lower"""
        text = self.CASE.replace("022020", "622020").replace("\n0.3 0.3\n", "\n0.3 20 -0.15 200\n0 1\n")
        force = {}
        for source in ("established", "moving-source"):
            cases, _, _ = self.run_text(text.format(mx=79, dx=0.2, cksi=-0.3333333, veloc=3000.0), "--heat", source)
            force[source] = abs(cases[0]["patches"][0]["totals"]["fx"]["value"])
        self.assertGreater(force["moving-source"], 1.005*force["established"])

    def test_unknown_name(self):
        run = subprocess.run([PROGRAM, "--heat", "hot", "2", "run"], cwd=self.folder, stdin=subprocess.DEVNULL,
                             capture_output=True, text=True, timeout=20)
        self.assertEqual(run.returncode, 1)
        self.assertIn("accepted: established, moving-source", run.stderr)


class Area(Program):
    def test_area_of_the_contact(self):
        cases, _, out = self.run_text(ball("1\n44 44 -2.2 -2.2 0.1 0.1"))
        totals = cases[0]["patches"][0]["totals"]
        self.assertAlmostEqual(totals["contact_area"]["value"], 0.01*totals["ncon"], delta=1e-9)
        self.assertAlmostEqual(totals["contact_area"]["value"], math.pi*1.719**2, delta=0.1)
        self.assertRegex(out, r"CONTACT AREA: +%.3f mm2" % totals["contact_area"]["value"])


class Profiles(Program):
    def test_profiles_used(self):
        """O = 4: rail and wheel in track coordinates; the contact reference lies on both"""
        shutil.copytree(os.path.join(EXAMPLES, "profiles"), os.path.join(self.folder, "profiles"))
        with open(os.path.join(EXAMPLES, "wheel_on_rail.inp"), encoding="utf-8") as file:
            cases = file.read().split(" 1 MODULE")
        for text, sign in ((cases[1], 1), (cases[1].replace("1203100", "0203100"), -1)):
            records, _, out = self.run_text(" 1 MODULE" + text.replace("0001201", "0001401"))
            totals = records[0]["patches"][0]["totals"]
            for title, columns in (("RAIL PROFILE USED, TRACK COORDINATES,", 3),
                                   ("PRINCIPAL WHEEL PROFILE, TRACK COORDINATES,", 4)):
                _head, rest = out.split(title)
                number = int(rest.split()[0])
                rows = [[float(word) for word in row.split()] for row in rest.split("\n")[2:2 + number]]
                self.assertGreater(number, 100)
                self.assertEqual([int(row[0]) for row in rows], list(range(1, number + 1)))
                y, z = totals["ycp_tr"]["value"], totals["zcp_tr"]["value"]
                self.assertGreater(sign*y, 700.0)
                nearest = min(rows, key=lambda row: abs(row[columns - 1] - y))
                self.assertAlmostEqual(nearest[columns - 1], y, delta=0.5)
                self.assertAlmostEqual(nearest[columns], z, delta=0.1)

    def test_upside_down(self):
        """A direction of z that the input or a Simpack file requests against the shape is used, with a warning"""
        profiles = os.path.join(self.folder, "profiles")
        shutil.copytree(os.path.join(EXAMPLES, "profiles"), profiles)
        with open(os.path.join(EXAMPLES, "wheel_on_rail.inp"), encoding="utf-8") as file:
            text = " 1 MODULE" + file.read().split(" 1 MODULE")[1]
        for name in ("60E1.prr", "S1002.prw"):
            with open(os.path.join(profiles, name), encoding="utf-8") as file:
                points = file.read()
            with open(os.path.join(profiles, "up_" + name), "w", encoding="utf-8") as file:
                file.write(points.replace("inversion   = 0", "inversion   = 0\n  mirror.z    = 1"))
            line = re.search(rf"'profiles/{name}' +0 +1\.0 +0\.0\b", text).group()
            for changed, expected in ((line, []), (line + " -1", []), (line + " 1", [name]),
                                      (line.replace(name, "up_" + name), ["up_" + name]),
                                      (line.replace(name, "up_" + name) + " 1", [])):
                _cases, warnings, _out = self.run_text(text.replace(line, changed))
                found = [warning for warning in warnings if "upside down" in warning]
                self.assertEqual(len(found), len(expected), (changed, warnings))
                for warning, file in zip(found, expected):
                    self.assertIn(f"profiles/{file}: by its shape", warning)

    def test_flange_on_the_outer_side(self):
        """A wheel with its flange at large y, as in profiles of left wheels, is used with a warning"""
        profiles = os.path.join(self.folder, "profiles")
        shutil.copytree(os.path.join(EXAMPLES, "profiles"), profiles)
        with open(os.path.join(EXAMPLES, "wheel_on_rail.inp"), encoding="utf-8") as file:
            text = " 1 MODULE" + file.read().split(" 1 MODULE")[1]
        with open(os.path.join(profiles, "S1002.prw"), encoding="utf-8") as file:
            points = re.findall(r"^ +(-?\d+\.\d+) +(-?\d+\.\d+)$", file.read(), re.MULTILINE)
        with open(os.path.join(profiles, "left.whl"), "w", encoding="utf-8") as file:
            file.writelines(f"{-float(y)} {-float(z)}\n" for y, z in points)
        with open(os.path.join(profiles, "tread.txt"), "w", encoding="utf-8") as file:
            file.writelines(f"{-float(y)} {z}\n" for y, z in points if float(y) > -30.0)
        line = "'profiles/S1002.prw' 0 1.0 0.0"
        self.assertIn(line, text)
        for name, mirror, expected in (("S1002.prw", 0, 0), ("S1002.prw", 1, 1), ("left.whl", 0, 1), ("left.whl", 1, 0),
                                       ("tread.txt", 1, 0), ("tread.txt", 0, 0)):
            _cases, warnings, _out = self.run_text(text.replace(line, f"'profiles/{name}' {mirror} 1.0 0.0"))
            found = [warning for warning in warnings if "flange on the outer side" in warning]
            self.assertEqual(len(found), expected, (name, mirror, warnings))


if __name__ == "__main__":
    unittest.main()
