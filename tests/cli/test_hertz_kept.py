#!/usr/bin/env python3
"""Grids of Hertzian options in later cases: kept, formed from the values in store, or given again, in both formats of input.

Pressures are compared with Hertz's formulas, and formed grids with those of the same case alone. The environment gives
CONTACT_PROGRAM.
"""
import json
import math
import os
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
LOADS = (1e3, 2e4)
#: Values of each option after MX MY: curvatures, curvature and ratio, axes, and the two for lines
VALUES = {-1: "0.001 0.002 1.2", -2: "0.001 1.5 1.2", -3: "3 2 1.2", -4: "0.001 3 1.2", -5: "3 2 1.2"}


def given(option, load, modulus=82000.0, link="20", force=1):
    """A case with everything"""
    return (f"{link[0]}00{force}00\n0022020 0\n00{link[1]}2201\n200 100 30 1 1e-7\n{load} 0 0 0\n0.3 0.3\n"
            f"0.28 0.28 {modulus} {modulus}\n{option}\n25 25 {VALUES[option]}\n")


def later(digits, load, modulus=None, link="20", force=1):
    """A case with the digits D C Z that gives a load, and materials with C = 2"""
    d, c, z = digits
    materials = f"0.28 0.28 {modulus} {modulus}\n" if modulus else ""
    return f"{link[0]}00{force}00\n01{d}{c}0{z}0 0\n01{link[1]}2201\n{load} 0 0 0\n{materials}"


class HertzKept(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def call(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=60)

    def records(self, name):
        run = self.call("--quiet", "--json", "2", name)
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(os.path.join(self.folder, os.path.splitext(name)[0] + ".jsonl")) as file:
            cases = [case for case in map(json.loads, file) if case["case"]]
        found = []
        for case in cases:
            self.assertTrue(case["converged"])
            totals = {key: item["value"] if isinstance(item, dict) else item for key, item in case["patches"][0]["totals"].items()}
            with open(os.path.join(self.folder, f"{os.path.splitext(name)[0]}.{case['case']:04d}.mat")) as file:
                numbers = [line.split() for line in file if not line.lstrip().startswith("%")]
            totals["sides"] = tuple(float(word) for word in numbers[3][4:6])
            found.append(totals)
        return found

    def solve(self, *cases):
        """Totals of the cases, which are the same through the readable format and back"""
        with open(os.path.join(self.folder, "a.inp"), "w") as file:
            file.write("".join("3\n" + case for case in cases) + "0\n")
        found = self.records("a.inp")
        for name in ("a.inp", "b.toml"):
            self.assertEqual(self.call("convert", "--force", name).returncode, 0)
            new = os.path.splitext(name)[0] + (".toml" if name.endswith("inp") else ".inp")
            other = new.replace("a.", "b.") if new.startswith("a.") else new.replace("b.", "c.")
            os.rename(os.path.join(self.folder, new), os.path.join(self.folder, other))
            for one, two in zip(found, self.records(other), strict=True):
                self.assertEqual(set(one), set(two), other)
                for key, value in one.items():
                    self.assertTrue(value == two[key] or abs(value - two[key]) <= 1e-9*abs(value), (other, key, value, two[key]))
        return found

    def same(self, one, two, what):
        self.assertEqual(one["sides"], two["sides"], what)
        for key in ("fn", "pen", "pmax", "contact_area"):
            self.assertLess(abs(one[key] - two[key]), 1e-6*abs(two[key]), (what, key, one[key], two[key]))

    def test_formed(self):
        """D = 1 and Z = 1: the grid and the distance of this load and of these materials"""
        for option in VALUES:
            alone = self.solve(given(option, LOADS[1]))[0]
            self.same(self.solve(given(option, LOADS[0]), later("101", LOADS[1]))[1], alone, (option, "load"))
            self.same(self.solve(given(option, LOADS[1], 30000.0), later("121", LOADS[1], 82000.0))[1], alone, (option, "moduli"))
            if option >= -3:
                alone = self.solve(given(option, 0.02, force=0))[0]
                self.same(self.solve(given(option, 0.003, force=0), later("101", 0.02, force=0))[1], alone, (option, "approach"))

    def test_distance_formed(self):
        """D = 0 and Z = 1, 2: the grid is kept, and given semi-axes are those of this load"""
        for z in (1, 2):
            first, second = self.solve(given(-3, LOADS[0]), later(f"00{z}", LOADS[1]))
            self.assertEqual(first["sides"], second["sides"])
            for totals in (first, second):
                self.assertAlmostEqual(totals["pmax"]/(1.5*totals["fn"]/(math.pi*3.0*2.0)), 1.0, delta=0.01)
            # curvatures do not depend on the load: a grid that is kept is too small for a larger one, and said to be
            first, second = self.solve(given(-1, LOADS[0]), later(f"00{z}", LOADS[1]))
            self.assertEqual(first["sides"], second["sides"])
            self.assertGreater(second["border_elements"], 0)

    def test_all_kept(self):
        """D = 0 and Z = 0: the bodies stay as they are, so that a smaller load has a smaller ellipse"""
        first, second = self.solve(given(-3, LOADS[1]), later("000", LOADS[1]/8))
        self.assertEqual(first["sides"], second["sides"])
        self.assertAlmostEqual(second["pmax"]/first["pmax"], 0.5, delta=0.01)

    def test_continued(self):
        """A case that continues has the elements of the one before; a grid formed for another load is refused"""
        self.solve(given(-3, LOADS[0]), later("000", LOADS[1], link="01"), later("101", LOADS[0], link="00"))
        with open(os.path.join(self.folder, "d.inp"), "w") as file:
            file.write("3\n" + given(-1, LOADS[0]) + "3\n" + later("101", LOADS[1], link="01") + "0\n")
        run = self.call("--quiet", "2", "d")
        self.assertEqual(run.returncode, 1)
        self.assertIn("the previous case", run.stderr)

    def test_readable(self):
        """In the readable format a new load or material forms the grid anew; renew = [] keeps it, as a case that continues does"""
        text = """[[case]]
module = "contact"
motion = "none"
normal = "force"
mat_file = 2
[case.kinematics]
fn = 1e3
[case.iteration]
eps = 1e-7
[case.material]
poiss = [0.28, 0.28]
gg = [82000, 82000]
[case.grid]
form = "hertz_axes"
mx = 25
my = 25
aa = 3
bb = 2
scale = 1.2
[[case]]
[case.kinematics]
fn = 2e4
[[case]]
[case.material]
gg = [30000, 30000]
[[case]]
renew = []
[case.kinematics]
fn = 2.5e3
[[case]]
sequence = "continue_all"
[case.kinematics]
fn = 2e4
"""
        with open(os.path.join(self.folder, "b.toml"), "w") as file:
            file.write(text)
        found = self.records("b.toml")
        self.assertEqual(len({totals["sides"] for totals in found}), 1)
        for totals, pressure in zip(found, (1.5e3, 3e4, 3e4, 1.5e4, 3e4), strict=True):
            self.assertAlmostEqual(totals["pmax"]/(pressure/(math.pi*3.0*2.0)), 1.0, delta=0.01)
        self.assertEqual(self.call("convert", "--force", "b.toml").returncode, 0)
        os.rename(os.path.join(self.folder, "b.inp"), os.path.join(self.folder, "c.inp"))
        for one, two in zip(found, self.records("c.inp"), strict=True):
            self.assertLess(abs(one["pmax"] - two["pmax"]), 1e-9*one["pmax"])


if __name__ == "__main__":
    unittest.main()
