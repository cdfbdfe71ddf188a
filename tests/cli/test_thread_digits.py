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

#: Elements along each side: loops over more than 40,000 elements are shared among threads
LARGE = 212


def totals(text, threads):
    """The line of a case, without its time"""
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "x.inp"), "w", encoding="utf-8") as file:
            file.write(text)
        subprocess.run([PROGRAM, "--json", "--quiet", "2", "x"], cwd=folder, check=True,
                       env=dict(os.environ, OMP_NUM_THREADS=str(threads), OMP_WAIT_POLICY="passive"))
        with open(os.path.join(folder, "x.jsonl"), encoding="utf-8") as file:
            case = json.loads(file.readline())
    assert case["status"] == "solved", case
    return json.dumps({name: value for name, value in case.items() if name != "seconds"})


class Threads(unittest.TestCase):
    """Each compared with one thread"""

    def compare(self, text):
        one = totals(text, 1)
        for threads in (2, 3):
            self.assertEqual(one, totals(text, threads), threads)

    def test_normal_problem(self):
        self.compare(asked_inputs.ball(LARGE))

    def test_steady_rolling(self):
        self.compare(asked_inputs.ball(LARGE, 3, 0, "", "5e-4 0 3e-4"))

    def test_shift_with_forces(self):
        self.compare(asked_inputs.ball(LARGE, 1, 0, "", "5e-3 0 1e-3"))


if __name__ == "__main__":
    unittest.main()
