#!/usr/bin/env python3
"""The doors of the program: modules and result elements keep their own values, numbers have bounds, nothing is ignored silently.

The environment tells CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]
PROFILES = os.path.join(SOURCE, "examples", "profiles")

#: Module 3, everything given, and a second case that keeps all it can
NEW3 = """{pbtnfs}
{vldcmze}
{third}
{iteration}
{pen} 0.002 0 0
{friction}
{rolling}
0.28 0.28 {gg} {gg}
1
{mx} {my} -1 -1 {side} {side}
1 1
0.01 0 0.01 0 0 0
"""
KEPT3 = """203100
0111010
0100201
9 0.001 0 0
"""
PLAIN3 = dict(pbtnfs="203100", vldcmze="0022020", third="0000201", iteration="200 100 30 1 1e-5", pen="9", friction="0.4 0.4",
              rolling="0 0.1 1000", gg="200", mx="20", my="20", side="0.1")
#: Module 1, the same
NEW1 = """1203100
0022033
0000201
{iteration}
{friction}
0.28 0.28 {gg} {gg}
{side} {side} 1 90d 8 4
14 0 1435 0
'60E1.prr' 0 1 0
0 0 0 0 0 0
1360 -70 460
'S1002.prw' 0 1 0
0 0 10e3 0 0 0
2000 0 0 0 0 -4.34
"""
KEPT1 = """1203100
0111002
0100201
0 0.5 10e3 0 0 0
2000 0 0 0 0 -4.34
"""
PLAIN1 = dict(iteration="200 100 30 1 1e-5", friction="0.3 0.3", gg="82000", side="0.5")


class Doors(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        for name in ("60E1.prr", "S1002.prw"):
            os.symlink(os.path.join(PROFILES, name), os.path.join(self.folder, name))

    def run_text(self, text, mode="2"):
        """Status, errors, the .out file and the JSON records of an input"""
        with open(os.path.join(self.folder, "x.inp"), "w") as file:
            file.write(text)
        options = ["--json"] if mode == "2" else []
        run = subprocess.run([PROGRAM, *options, mode, "x"], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertNotIn("Backtrace", run.stderr)
        out, records = run.stdout, []
        if mode == "2":
            with open(os.path.join(self.folder, "x.out")) as file:
                out = file.read()
            for name in sorted(os.listdir(self.folder)):
                if name.endswith(".jsonl"):
                    with open(os.path.join(self.folder, name)) as file:
                        records = [json.loads(line) for line in file]
        return run, out, records

    def totals(self, text):
        """Status and, per case, the lines with numbers of the .out file below the case line"""
        run, out, _ = self.run_text(text)
        self.assertEqual(run.returncode, 0, run.stderr + out[-2000:])
        cases = re.split(r"\n Case +\d+.*\n", out)[1:]
        number = re.compile(r"-?\d+\.\d+(?:E[+-]\d+)?")
        return [number.findall(case.split("Parallel run")[0]) for case in cases]


class StoredValues(Doors):
    def interleave(self, pieces):
        """Each piece is a module line with two cases; alone and interleaved they must print the same"""
        alone = []
        for head, cases in pieces:
            alone.append(self.totals("".join(f"{head}\n{case}" for case in cases) + "0\n"))
        mixed = self.totals("".join(f"{head}\n{cases[step]}" for step in range(2) for head, cases in pieces) + "0\n")
        for k in range(len(pieces)):
            for step in range(2):
                self.assertEqual(mixed[step*len(pieces) + k], alone[k][step], (pieces[k][0], step))
                self.assertGreater(len(mixed[step*len(pieces) + k]), 10)

    def test_modules(self):
        """Friction, materials, grid, solver settings: each module keeps its own"""
        for given3, given1 in (({}, {}), ({"gg": "500", "friction": "0.1 0.1"}, {"friction": "0.5 0.5"}),
                               ({"side": "0.05", "mx": "40", "my": "40"}, {"side": "0.7"}),
                               ({"iteration": "200 100 30 1 1e-2"}, {"iteration": "200 100 30 1 1e-7"})):
            self.interleave([("3", [NEW3.format(**{**PLAIN3, **given3}), KEPT3]),
                             ("1", [NEW1.format(**{**PLAIN1, **given1}), KEPT1])])

    def test_elements(self):
        """Result elements, patches and modules of one file"""
        self.interleave([("3 1", [NEW3.format(**PLAIN3), KEPT3]),
                         ("3 2", [NEW3.format(**{**PLAIN3, "gg": "900", "friction": "0.05 0.05"}), KEPT3]),
                         ("3 2 3", [NEW3.format(**{**PLAIN3, "side": "0.07", "mx": "30"}), KEPT3]),
                         ("1 1", [NEW1.format(**PLAIN1), KEPT1]),
                         ("1 7", [NEW1.format(**{**PLAIN1, "gg": "70000", "friction": "0.15 0.15"}), KEPT1])])

    def test_first_case_of_a_module(self):
        """A first case of one module has nothing to keep from the other"""
        run, out, _ = self.run_text("3\n" + NEW3.format(**PLAIN3) + "1\n" + KEPT1 + "0\n")
        self.assertEqual(run.returncode, 1)
        self.assertIn("first case", run.stderr)

    def test_cases_are_counted_together(self):
        run, out, _ = self.run_text("3\n" + NEW3.format(**PLAIN3) + "1\n" + NEW1.format(**PLAIN1) + "3\n" + KEPT3 + "0\n")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(re.findall(r"\n Case +(\d+)", out), ["1", "2", "3"])


if __name__ == "__main__":
    unittest.main(verbosity=1)
