#!/usr/bin/env python3
"""EFFECTS names the effects that act and no others: every effect with and without, and what did not converge in the same line.

The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import json
import os
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]

STEEL, HEAT = "0.28 0.28 82000 82000", "20 450 0.05 7.85e-6"


def case(digits="203100", laws="0022020", output="0001201", motion="100 0.002 0 0", friction="0.3 0.3", more="",
         rolling="0 0.1 1000", heat="", rows="", last="", limits="999 100 30 1 1e-5", kernel="", material=STEEL):
    """Digits M, C and so on are those of the words; empty lines are omitted"""
    lines = ["3", digits, laws, output, limits, motion, friction, rolling, kernel, material, more, heat, "1",
             "20 20 -1 -1 0.1 0.1", "1 1", "0.01 0 0.01 0 0 0", rows, last, "0"]
    return "\n".join(line for line in lines if line) + "\n"


PLAIN = "elastic half-spaces, Coulomb friction in steady rolling"
# the request, and the whole text
TABLE = {
    "plain": (case(), PLAIN),
    "frictionless": (case(digits="200100", rolling=""), "elastic half-spaces"),
    "shift": (case(digits="201100", rolling="", motion="100 0.001 0 0"), "elastic half-spaces, Coulomb friction in a shift"),
    "transient": (case(digits="202100"), "elastic half-spaces, Coulomb friction in transient rolling"),
    "viscoelastic": (case(laws="0022120", more="1 1 0.001 0.001"),
                     "viscoelastic half-spaces, Coulomb friction in steady rolling"),
    "viscoelastic without memory": (case(laws="0022120", more="0 0 0 0"), PLAIN),
    "elastic layer": (case(laws="0022420", more="8200 0.01 0 0"), PLAIN + ", elastic layer between the bodies"),
    "layer without thickness": (case(laws="0022420", more="8200 0 0 0"), PLAIN),
    "layer that yields": (case(laws="0022420", more="8200 0.01 20 0"),
                          PLAIN + ", elastic layer between the bodies, plastic shearing"),
    "layer far from its limit": (case(laws="0022420", more="8200 0.01 1e6 0"), PLAIN + ", elastic layer between the bodies"),
    "thin sheet": (case(digits="213100", more="1e-6"),
                   "elastic half-spaces, elastic thin sheet, Coulomb friction in steady rolling"),
    "bilinear": (case(laws="0023020"), "elastic half-spaces, bilinear tractions, Coulomb friction in steady rolling"),
    "dissimilar": (case(material="0.28 0.28 82000 8200"), PLAIN + ", dissimilar bodies"),
    "damping": (case(laws="0022020 2", more="1e-3 1e-3 1e10 1e10"), PLAIN),
    "temperature": (case(output="3001201", heat=HEAT + "\n" + HEAT), PLAIN + ", surface temperatures (established)"),
    "falling": (case(laws="0222020", friction="0.2 0.1 1000 0 1\n0 1"),
                "elastic half-spaces, friction falling linearly with slip in steady rolling"),
    "memory": (case(laws="0222020", friction="0.2 0.1 1000 0 1\n0.01 1"),
               "elastic half-spaces, friction falling linearly with slip with memory in steady rolling"),
    "rows": (case(laws="3022020", friction="", rows="\n".join(["0.3 0.3"]*10 + ["0.2 0.2"]*10)),
             "elastic half-spaces, Coulomb friction by row in steady rolling"),
    "extra slip": (case(laws="0022029", last="\n".join(["1e-4 0"]*400)), PLAIN + ", extra rigid slip"),
    "extra slip of zero": (case(laws="0022029", last="\n".join(["0 0"]*400)), PLAIN),
}


class Effects(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        os.symlink(os.path.join(SOURCE, "examples", "profiles"), os.path.join(self.folder, "profiles"))

    def run_program(self, text):
        """Lines of JSON, and the EFFECTS lines of the .out file"""
        with open(os.path.join(self.folder, "a.inp"), "w") as file:
            file.write(text)
        done = subprocess.run([PROGRAM, "--json", "2", "a"], cwd=self.folder, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr + text)
        with open(os.path.join(self.folder, "a.jsonl")) as file:
            lines = [case for case in map(json.loads, file) if case["case"]]
        with open(os.path.join(self.folder, "a.out")) as file:
            return lines, [line for line in file if line.startswith(" EFFECTS: ")]

    def test_each_effect(self):
        for name, (text, expected) in TABLE.items():
            with self.subTest(name):
                lines, effects = self.run_program(text)
                self.assertEqual(lines[0]["patches"][0]["effects"], expected)
                self.assertTrue(effects[0].startswith(" EFFECTS: " + expected + "; SOLVER: "), effects[0])

    def test_damping_acts_from_the_second_case_on(self):
        first = case(laws="0022020 2", more="1e-3 1e-3 1e10 1e10", digits="202100")
        second = "3\n002100\n0100000 1\n0101201\n200 0.002 0 0\n0\n"
        lines, _ = self.run_program(first[:-2] + second)
        self.assertNotIn("damping", lines[0]["patches"][0]["effects"])
        self.assertIn(", damping forces", lines[1]["patches"][0]["effects"])

    def test_what_was_missed(self):
        # tangential force, then the tolerance
        _, effects = self.run_program(case(digits="203110", laws="0222020", motion="100 0.9 0 0",
                                        friction="0.1 0.2 1 0 1\n0 1", rolling="0 0.1 1e7"))
        self.assertIn("; NOT CONVERGED: force, requested FX 27.0000 N, found 10.0000 N", effects[0])
        _, effects = self.run_program(case(limits="2 100 30 1 1e-9"))
        self.assertIn("; NOT CONVERGED: normal problem, NormCG reached the iteration limit", effects[0])

    def test_missed_forces_of_wheel_and_rail(self):
        with open(os.path.join(SOURCE, "examples", "wheel_on_rail.inp")) as file:
            text = file.read()
        first = text[:text.index("1 MODULE", text.index("1 MODULE") + 5)] + "0\n"
        _, effects = self.run_program(first.replace("1203100", "1203110", 1).replace("-43.5", "40000", 1))
        self.assertTrue(effects)
        for line in effects:
            self.assertIn("; NOT CONVERGED: force, requested longitudinal force 40000.0 N", line)


if __name__ == "__main__":
    unittest.main()
