#!/usr/bin/env python3
"""Rules of grids, accepted and refused: cases that continue another one, strips, rows of friction.

The environment gives CONTACT_PROGRAM.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
FIRST = """3
201100
022020
0001201
999 100 30 1 1e-6
600 {shift} 0 0
0.3 0.3
0.28 0.28 82000 82000
1
{grid}
1 1
0.001 0 0.001 0 0 0
"""
NEXT = """3
{p}01100
122020
01{i}0201
600 {shift} 0 0
0.28 0.28 82000 82000
1
{grid}
1 1
0.001 0 0.001 0 0 0
"""


class Runs(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def run_text(self, text):
        """Cases as JSON, and the .out file"""
        with open(os.path.join(self.folder, "x.inp"), "w", encoding="utf-8") as file:
            file.write(text)
        self.run = subprocess.run([PROGRAM, "--quiet", "--json", "2", "x"], cwd=self.folder, stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True, timeout=60)
        with open(os.path.join(self.folder, "x.jsonl"), encoding="utf-8") as file:
            cases = [case for case in map(json.loads, file) if case["case"]]
        with open(os.path.join(self.folder, "x.out"), encoding="utf-8") as file:
            return cases, file.read()

    def total(self, case, name):
        return case["patches"][0]["totals"][name]["value"]


class Linked(Runs):
    """P = 0: the previous tractions are used, so the elements must be those of the previous case"""

    def second(self, grid, p=0, i=1):
        cases, out = self.run_text(FIRST.format(shift=-0.0002, grid="20 22 -2.0 -3.3 0.2 0.3")
                                   + NEXT.format(shift=-0.0002, grid=grid, p=p, i=i) + "0\n")
        return cases[-1] if len(cases) == 2 and cases[-1]["status"] == "solved" else None, out + self.run.stderr

    def test_other_sizes_are_refused(self):
        for dx, dy in ((0.21, 0.3), (0.19, 0.3), (0.2, 0.31), (0.2, 0.29)):
            with self.subTest(dx=dx, dy=dy):
                for corner in (f"{-11*dx} {-12*dy}", "-2.2 -3.6", "-2.0 -3.3"):
                    case, output = self.second(f"22 24 {corner} {dx} {dy}")
                    self.assertIsNone(case)
                    self.assertIn("of the previous case; the solution of the previous case cannot be used", output)
                self.assertIsNotNone(self.second(f"22 24 {-11*dx} {-12*dy} {dx} {dy}", p=2, i=0)[0])

    def test_windows_that_are_moved(self):
        alone = self.total(self.second("20 22 -2.0 -3.3 0.2 0.3")[0], "fx")
        # the same elements in other windows
        for grid in ("24 22 -2.4 -3.3 0.2 0.3", "20 26 -2.0 -3.9 0.2 0.3", "22 23 -2.2 -3.6 0.2 0.3"):
            self.assertAlmostEqual(self.total(self.second(grid)[0], "fx"), alone, delta=2e-5*abs(alone), msg=grid)
        # between them
        for x, y in ((-2.1, -3.3), (-1.9, -3.3), (-2.0, -3.45), (-2.0, -3.15)):
            self.assertIsNone(self.second(f"20 22 {x} {y} 0.2 0.3")[0], f"{x} {y}")
        # contact that is outside
        for x, y in ((-0.6, -3.3), (-3.4, -3.3), (-2.0, -0.9), (-2.0, -5.7)):
            self.assertIsNone(self.second(f"20 22 {x} {y} 0.2 0.3")[0], f"{x} {y}")

    def test_the_second_shift_adds_to_the_first(self):
        once = self.total(self.run_text(FIRST.format(shift=-0.0002, grid="20 22 -2.0 -3.3 0.2 0.3") + "0\n")[0][0], "fx")
        twice = self.total(self.second("20 22 -2.0 -3.3 0.2 0.3")[0], "fx")
        whole = self.total(self.run_text(FIRST.format(shift=-0.0004, grid="20 22 -2.0 -3.3 0.2 0.3") + "0\n")[0][0], "fx")
        self.assertAlmostEqual(twice, whole, delta=1e-3*abs(whole))
        self.assertGreater(abs(twice), 1.2*abs(once))


class Strips(Runs):
    """Two-dimensional Hertzian contact in rows: pressures as in a single row, and free rows on both sides"""

    CASE = ("3\n200100\n022020\n0001201\n999 100 30 1 1e-6\n{load} 0 0 0\n0.3 0.3\n0.28 0.28 82000 82000\n{kind}\n"
            "24 {my} {a} {bb} {scale}\n")

    def test_rows(self):
        one = self.run_text(self.CASE.format(load=40000, kind=-4, my=1, a=0.001, bb=10, scale=1.2) + "0\n")[0][0]
        totals = one["patches"][0]["totals"]
        for my, rows in ((11, 9), (12, 10), (24, 20), (5, 5)):
            case = self.run_text(self.CASE.format(load=40000, kind=-4, my=my, a=0.001, bb=10, scale=1.2) + "0\n")[0][0]
            with self.subTest(my=my):
                self.assertEqual(case["status"], "solved")
                found = case["patches"][0]["totals"]
                # the contact of a row has 20 elements, fewer at the ends of the strip
                self.assertGreaterEqual(found["ncon"], 18*rows)
                self.assertLessEqual(found["ncon"], 22*rows)
                self.assertAlmostEqual(found["fn"]["value"], totals["fn"]["value"], delta=1e-6*totals["fn"]["value"])


class Friction(Runs):
    """Friction that varies from row to row is printed in the .out file row by row"""

    def test_rows_of_the_table(self):
        values = [0.11, 0.22, 0.33, 0.24, 0.15]
        text = ("3\n203100\n3022020\n0000521\n999 100 30 1 1e-6\n1000 0.001 0 0\n0 0.5 1000\n0.28 0.28 82000 82000\n1\n"
                "7 5 -1.75 -1.25 0.5 0.5\n1 1\n0.01 0 0.01 0 0 0\n" + "".join(f"{v} {v}\n" for v in values) + "0\n")
        _, out = self.run_text(text)
        rows = re.findall(r"^ +(\d+) +(0\.\d+) +(0\.\d+) *$", out[out.index("FRICTION LAW"):out.index("KINEMATIC")], re.MULTILINE)
        self.assertEqual([(int(k), float(a), float(b)) for k, a, b in rows], [(k + 1, v, v) for k, v in enumerate(values)],
                         out[:3000])


if __name__ == "__main__":
    sys.exit(unittest.main())
