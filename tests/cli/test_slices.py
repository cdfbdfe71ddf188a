#!/usr/bin/env python3
"""Profiles in slices: narrow ridges, overlap far from the wheel, ends of a wheel that is out of round.

Heights come from the shapes that the slices are made of. The environment gives CONTACT_PROGRAM.
"""
import json
import math
import os
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
RADIUS = 460.0

INPUT = """ 1 MODULE
 1200100 CPBTNFS
 00{location}2033 VLDCMZE
 0001211 HGIAOWR
 999 100 30 1 1e-5
 0.3 0.3
 0.28 0.28 82000 82000
 {step} {step} 1 90d 8 4
 -1 750 0 0
 '{rail}' 0 1 0
 0 0 0 0 0 0
 1360 -70 460
 '{wheel}' 0 1 0
 {s} 0 {fz} 0 0 0
 0 0 0 0 0 0
 0 MODULE
"""


class Slices(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w") as file:
            file.write(text)

    def table(self, name, places, height):
        """A profile of two columns"""
        self.write(name, "".join("%.10g %.10g\n" % (y, height(y)) for y in places))

    def slices(self, name, positions, places, height):
        """Slices at positions: places(u) and height(u, y)"""
        lines = []
        for k, u in enumerate(positions):
            part = "%s_%d.txt" % (name.replace(".", "_"), k)
            self.table(part, places(u), lambda y, u=u: height(u, y))
            lines.append("%.10g '%s'\n" % (u, part))
        self.write(name, "0 1\n%d\n0 0 0\n1\n%s" % (len(lines), "".join(lines)))

    def solve(self, location=2, rail="rail.slcs", wheel="wheel.txt", fz=1000.0, step=1.0, s=0.0):
        self.write("x.inp", INPUT.format(location=location, rail=rail, wheel=wheel, fz=fz, step=step, s=s))
        run = subprocess.run([PROGRAM, "--json", "2", "x"], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                             text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stdout[-2000:] + run.stderr[-2000:])
        with open(os.path.join(self.folder, "x.jsonl")) as file:
            result = [case for case in map(json.loads, file) if case["case"]]
        return result[0], [line for line in run.stdout.splitlines() if "Warning" in line]

    def cylinder(self):
        self.table("wheel.txt", [0.5*k for k in range(80, -81, -1)], lambda y: 0.0)

    def ridge(self, u, y):
        """A crowned rail with a ridge about 1 mm wide, 12.3 mm beside its middle and 0.14 mm higher than that"""
        return y*y/200.0 - 0.9*math.exp(-((y - 12.3)/0.6)**2)

    def test_ridge_between_coarse_rows(self):
        self.cylinder()
        self.slices("rail.slcs", range(-200, 201, 40), lambda u: [0.25*k for k in range(-160, 161)], self.ridge)
        for location in (2, 5):
            # elements of 1 mm: the search has points every 0.3 mm, and had them every 2.4 mm
            result, _warnings = self.solve(location, fz=20.0)
            patches = result["patches"]
            self.assertEqual(len(patches), 1, "D = %d" % location)
            self.assertAlmostEqual(patches[0]["totals"]["ycp_tr"]["value"], 762.3, delta=0.3)

    def test_short_bump_between_coarse_columns(self):
        self.cylinder()

        def height(u, y):
            return y*y/200.0 - 0.85*math.exp(-((u - 26.0)/1.0)**2)*math.exp(-((y - 1.0)/4.0)**2)

        # the bump, 26 mm ahead, is 0.1 mm higher than the wheel there; points every 4 mm miss it
        positions = [-100, -60, -30, 0] + [0.5*k for k in range(30, 75)] + [50, 80, 120, 160]
        self.slices("rail.slcs", positions, lambda u: [0.5*k for k in range(-40, 41)], height)
        for location in (2, 5):
            result, _warnings = self.solve(location, fz=20.0, step=0.25)
            self.assertEqual(len(result["patches"]), 1, "D = %d" % location)
            patch = result["patches"][0]
            self.assertAlmostEqual(patch["totals"]["xcp_tr"]["value"], 26.0, delta=0.5)

    def test_rows_that_are_not_announced(self):
        """NSLC below the number of rows, and features without NFEAT, cut the rail: that is no silent matter"""
        self.cylinder()
        self.slices("rail.slcs", range(-100, 101, 40), lambda u: [0.5*k for k in range(-60, 61)], lambda u, y: y*y/200.0)
        path = os.path.join(self.folder, "rail.slcs")
        with open(path) as file:
            whole = file.read()
        _result, warnings = self.solve()
        self.assertEqual([line for line in warnings if "NSLC" in line], [])
        for text, line in ((whole.replace("0 1\n6\n", "0 1\n4\n"), 8), (whole + "".join("%g 0 70\n" % u for u in (-100, -60)), 10)):
            self.write("rail.slcs", text)
            _result, warnings = self.solve()
            found = [warning for warning in warnings if "NSLC" in warning]
            self.assertEqual(len(found), 1, warnings)
            self.assertIn("what stands below line %d is ignored" % line, found[0])
        self.write("rail.slcs", whole + "\n% a comment\n")
        _result, warnings = self.solve()
        self.assertEqual([line for line in warnings if "NSLC" in line], [])

    def test_overlap_beyond_the_reach(self):
        self.cylinder()

        def height(u, y):
            return -35.0*math.exp(-((u - 150.0)/25.0)**2)

        self.slices("rail.slcs", range(-300, 301, 10), lambda u: [float(k) for k in range(-30, 31)], height)
        # penetration of the wheel into the ramp if it is supported by the level part
        depth = max(35.0*math.exp(-((x - 150.0)/25.0)**2) - RADIUS + math.sqrt(RADIUS**2 - x**2) for x in range(100, 230))
        self.assertGreater(depth, 5.0)
        for location in (2, 5):
            _result, warnings = self.solve(location)
            said = [line for line in warnings if "overlap by" in line]
            self.assertEqual(len(said), 1, "D = %d: %s" % (location, warnings))
            self.assertAlmostEqual(float(said[0].split("overlap by ")[1].split()[0]), depth, delta=0.1*depth)
        # no warning for a rail without the ramp
        self.slices("rail.slcs", range(-300, 301, 10), lambda u: [float(k) for k in range(-30, 31)], lambda u, y: 0.0)
        _result, warnings = self.solve(2)
        self.assertFalse([line for line in warnings if "overlap" in line])

    def test_ends_of_a_wheel_at_the_contact(self):
        # a wheel of 60 mm that is narrower on its outer side near the bottom: contact ends where its slice there ends
        self.table("rail.txt", range(-40, 41), lambda y: 0.0)
        self.slices("wheel.slcw", [0.05*k for k in range(-12, 13)],
                    lambda u: [30.0 - 25.0*math.exp(-(u/0.25)**2) - k*(60.0 - 25.0*math.exp(-(u/0.25)**2))/60.0 for k in range(61)],
                    lambda u, y: 0.0)
        _result, warnings = self.solve(2, rail="rail.txt", wheel="wheel.slcw", fz=20000.0, step=0.5)
        said = " ".join(warnings)
        self.assertIn("end of the wheel profile", said)
        self.assertNotIn("cannot be seen", said)


if __name__ == "__main__":
    unittest.main()
