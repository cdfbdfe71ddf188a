#!/usr/bin/env python3
"""Results on large grids are identical to the last digit for all numbers of threads.

The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
sys.path.insert(0, os.path.join(os.environ["CONTACT_SOURCE"], "tests", "performance"))
import asked_inputs
import threads as large_cases

#: Elements along each side: loops over more than 40,000 elements, and over the contact in nine tenths of the width, are shared
#: among threads
LARGE = 240


def results(text, threads, suffix):
    """The lines of the cases without their times, and the tables of elements"""
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "x" + suffix), "w", encoding="utf-8") as file:
            file.write(text)
        subprocess.run([PROGRAM, "--json", "--quiet", "2", "x"], cwd=folder, check=True,
                       env=dict(os.environ, OMP_NUM_THREADS=str(threads), OMP_WAIT_POLICY="passive"))
        with open(os.path.join(folder, "x.jsonl"), encoding="utf-8") as file:
            cases = [json.loads(line) for line in file]
        tables = []
        for name in sorted(os.listdir(folder)):
            if name.endswith((".mat", ".out")):
                with open(os.path.join(folder, name), encoding="utf-8") as file:
                    tables.append([line for line in file if "OF THE POTENTIAL CONTACT" in line or line.lstrip()[:1].isdigit()
                                   or line.lstrip()[:1] == "-"])
    cases = [case for case in cases if "status" in case and "seconds" in case]
    assert cases and all(case["status"] == "solved" for case in cases), cases
    for case in cases:
        del case["seconds"]
    return json.dumps(cases), tables


class Threads(unittest.TestCase):
    """Each compared with one thread"""

    def compare(self, text, suffix=".inp", numbers=(2, 3)):
        one = results(text, 1, suffix)
        for threads in numbers:
            self.assertEqual(one, results(text, threads, suffix), threads)

    def test_normal_problem(self):
        self.compare(asked_inputs.ball(LARGE))

    def test_steady_rolling(self):
        self.compare(asked_inputs.ball(LARGE, 3, 0, "", "5e-4 0 3e-4"))

    def test_shift_with_forces(self):
        self.compare(asked_inputs.ball(LARGE, 1, 0, "", "5e-3 0 1e-3"))

    def test_other_kinds(self):
        for name, text in large_cases.kinds(LARGE):
            # the ball in compression, and rolling of order 1, are compared above
            if name in ("normal problem", "steady rolling, order 1"):
                continue
            with self.subTest(name):
                self.compare(text, ".toml", (3,))


if __name__ == "__main__":
    unittest.main()
