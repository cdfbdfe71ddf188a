#!/usr/bin/env python3
"""Limits of time, memory and elements; estimates before a case; early end of cases that cannot converge.

The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import json
import os
import subprocess
import tempfile
import time
import unittest

from small_case import case, endless

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]


class Limits(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        os.symlink(os.path.join(SOURCE, "examples", "profiles"), os.path.join(self.folder, "profiles"))

    def run_program(self, text, *arguments, mode="2"):
        with open(os.path.join(self.folder, "a.inp"), "w") as file:
            file.write(text)
        start = time.monotonic()
        done = subprocess.run([PROGRAM, *arguments, "--json", mode, "a"], cwd=self.folder, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=120)
        self.seconds = time.monotonic() - start
        lines = []
        if mode == "2":
            with open(os.path.join(self.folder, "a.jsonl")) as file:
                lines = [case for case in map(json.loads, file) if case["case"]]
        return done, lines

    def test_elements(self):
        done, lines = self.run_program(case(40) + case(20) + "0\n", "--limit-elements", "400")
        self.assertEqual([line["status"] for line in lines], ["refused", "solved"])
        self.assertIn("1600 elements are more than the limit of 400", lines[0]["reason"])
        self.assertEqual(done.returncode, 1)
        self.assertIn("1 solved, 0 not converged, 1 refused", done.stdout)

    def test_memory(self):
        _done, lines = self.run_program(case(60) + case(20) + "0\n", "--limit-memory=1")
        self.assertEqual([line["status"] for line in lines], ["refused", "solved"])
        self.assertIn("more than the limit of 1 MB", lines[0]["reason"])
        _, lines = self.run_program(case(20) + "0\n", "--limit-memory=0.25")
        self.assertIn("400 elements need about 0.6 MB of memory, more than the limit of 0.25 MB", lines[0]["reason"])
        _, lines = self.run_program(case(60) + case(20) + "0\n", "--limit-memory=800")
        self.assertEqual([line["status"] for line in lines], ["solved", "solved"])

    def test_time_inside_a_solution(self):
        done, lines = self.run_program(endless(80) + case(10) + "0\n", "--limit-time", "0.5")
        self.assertEqual([(line["status"], line.get("iteration", "")) for line in lines],
                         [("not converged", "time"), ("solved", "")])
        self.assertIn("time limit of 0.5", lines[0]["reason"])
        self.assertFalse(lines[0]["solved"] or lines[0]["converged"])
        self.assertLess(self.seconds, 30.0)
        self.assertIn("1 solved, 1 not converged, 0 refused", done.stdout)

    def test_time_inside_a_search_for_forces(self):
        """The search ends with the solution that ran out of time, and reports it"""
        for digits, forces in (("203110", "2000 0.5 0 0"), ("203120", "2000 0.5 0.2 0")):
            text = endless(80).replace("203100", digits).replace("2000 0.001 0 0", forces)
            _, lines = self.run_program(text + case(10) + "0\n", "--limit-time", "0.5")
            self.assertEqual([line.get("iteration") for line in lines], ["time", None])
            self.assertLess(self.seconds, 30.0)

    def test_time_of_wheel_and_rail(self):
        with open(os.path.join(SOURCE, "examples", "wheel_on_rail.inp")) as file:
            text = file.read()
        _done, lines = self.run_program(text, "--limit-time", "1e-6")
        self.assertTrue(lines)
        self.assertEqual({line["iteration"] for line in lines}, {"time"})

    def test_a_case_after_one_without_result(self):
        # there is no previous time step: neither the tractions of the case that ran out of time, nor those it continued
        def shift(text, link):
            return text.replace("203100", link + "01100").replace("0 0.05 1000\n", "").replace(" 0.001 0 0", " 2e-5 0 0")

        whole = shift(case(40), "2")
        _, lines = self.run_program(whole + shift(endless(40), "0") + shift(case(40), "0") + "0\n", "--limit-time", "0.5")
        self.assertEqual([line.get("iteration") for line in lines[:3]], [None, "time", None])
        first, third = (lines[k]["patches"][0]["totals"]["fx"]["value"] for k in (0, 2))
        self.assertAlmostEqual(third, first, delta=1e-4*abs(first))
        # a case that continues the first one would differ
        _, lines = self.run_program(whole + shift(case(40), "0") + "0\n")
        second = lines[1]["patches"][0]["totals"]["fx"]["value"]
        self.assertGreater(abs(second - first), 0.01*abs(first))

    def test_options(self):
        for option in ("--limit-time=0", "--limit-time=-1", "--limit-memory=much", "--limit-elements=nan", "--limit-time"):
            done = subprocess.run([PROGRAM, option], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                                  text=True, timeout=60)
            self.assertEqual(done.returncode, 1, option)
            self.assertIn("positive number", done.stderr, option)

    def test_estimate(self):
        done, _ = self.run_program(case(20) + case(400) + case(1400) + "0\n", mode="3")
        self.assertEqual(done.returncode, 0, done.stderr)
        estimates = [line for line in done.stdout.splitlines() if "Estimate" in line]
        self.assertEqual(len(estimates), 3, estimates)
        self.assertIn("Estimate of case 2 on one thread: about 160000 elements", estimates[0])
        self.assertIn("1960000 elements", estimates[2])

    def test_estimate_of_a_large_case(self):
        """A warning before a case that is long or needs much memory; either is sufficient. The limit ends it at once"""
        stresses = case(20).replace("203100", "203103", 1).rstrip("\n") + "\n0 0\n9\n200 200 100\n" + "".join(
            " ".join(f"{0.01*k:.2f}" for k in range(1, n + 1)) + "\n" for n in (200, 200, 100)) + "0\n"
        slow = case(400, g=2, limits="999 100 30 1 1e-5\n0.9 1.0 0 0.5")
        for text, memory, warns in ((case(40), 10000, False), (stresses, 100, True), (slow, 100, True)):
            done, _lines = self.run_program(text + "0\n", f"--limit-memory={memory}", "--classical")
            self.assertEqual("Estimate of this case" in done.stdout, warns, done.stdout + done.stderr)

    def soft_rolling(self, modulus):
        """The first step of the example with a soft wheel"""
        with open(os.path.join(SOURCE, "examples", "rolling_steps.inp")) as file:
            text = file.read().replace("0.28 0.28 82000. 82000.", f"0.28 0.28 {modulus} 82000.", 1)
        return text[:text.index("1 MODULE", text.index("1 MODULE") + 5)] + "0\n"

    def test_soft_bodies_in_a_transient_case(self):
        # the contact of a first trial would cover much of the wheel
        _done, lines = self.run_program(self.soft_rolling("8.2"))
        self.assertLess(self.seconds, 60.0)
        self.assertNotEqual(lines[0]["status"], "solved")
        self.assertIn("NPOT_MAX", lines[0]["reason"])

    def test_bodies_that_the_force_would_press_flat(self):
        _done, lines = self.run_program(self.soft_rolling("1e-3"))
        self.assertEqual(lines[0]["status"], "refused")
        self.assertIn("more than the radius of the wheel, 460 mm", lines[0]["reason"])


if __name__ == "__main__":
    unittest.main()
