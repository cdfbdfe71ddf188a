#!/usr/bin/env python3
"""Check of an input: an error of one case is reported once, and not again for later cases that keep its values.

Each number and word of a first case is replaced by values that cannot be used; the second case keeps everything but its force.
The environment gives CONTACT_PROGRAM.
"""
import os
import re
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
SECOND = "SECOND"
DIGITS = f"""3  MODULE
 203110   P-B-T-N-F-S
0022020   V-L-D-C-M-Z-E
0000301   H-G-I-A-O-W-R
 100  100  30  1  1e-5
 9.2  -0.5  0.0  0.0
 0.4   0.4
 0d    0.1  1000.
 0.42  0.42  200. 200.
 1
 24  24  -1.2  -1.2  0.1  0.1
 1  1
 0.01  0  0.01  0  0  0
3  MODULE {SECOND}
 203110   P-B-T-N-F-S
0100000   V-L-D-C-M-Z-E
0100301   H-G-I-A-O-W-R
 {{fn}}  -0.5  0.0  0.0
0  END
"""
WORDS = f"""[[case]]
module = "contact"
motion = "steady_rolling"
normal = "force"
tangential = "fx_and_ceta"
[case.iteration]
maxgs = 100
[case.kinematics]
fn = 9.2
fx = -0.5
[case.friction]
law = "coulomb"
fstat = 0.4
fkin = 0.4
[case.rolling]
dq = 0.1
veloc = 1000.0
[case.material]
poiss = [0.42, 0.42]
gg = [200.0, 200.0]
[case.grid]
form = "corner_and_sides"
mx = 24
my = 24
xl = -1.2
yl = -1.2
dx = 0.1
dy = 0.1
[case.geometry]
form = "quadratic"
planform = "unrestricted"
b = [0.01, 0.0, 0.01, 0.0, 0.0, 0.0]

[[case]]  # {SECOND}
[case.kinematics]
fn = {{fn}}
"""
#: A number or a word in quotes
VALUE = re.compile(r'(?<![\w.])-?\d+\.?\d*(?:e-?\d+)?(?![\w.])|"[^"]*"')
HINT = "values of a case with errors; check again when these are corrected"


class KeptErrors(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def check(self, text, suffix):
        """Lines of the errors, and the text on the screen"""
        with open(os.path.join(self.folder, "x" + suffix), "w", encoding="utf-8") as file:
            file.write(text)
        run = subprocess.run([PROGRAM, "3", "x" + suffix], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                             text=True, timeout=60, check=False)
        errors = [line for line in run.stderr.splitlines() if "ERROR" in line]
        self.assertEqual(run.returncode, 1 if errors else 0, run.stderr)
        return [int(re.search(r"x\.\w+:(\d+)", line).group(1)) for line in errors], run.stdout

    def replaced(self, text, suffix):
        """Replace values of the first case; returns the numbers of inputs with errors and of those with a hint"""
        lines = text.format(fn=9.5).splitlines()
        second = next(k for k, line in enumerate(lines) if SECOND in line)
        faulty = hints = 0
        for k in range(1 if suffix == ".toml" else 4, second):
            for found in VALUE.finditer(lines[k]):
                for value in ("-7", "1e99", "0", '"nonsense"', "17"):
                    line = lines[k][:found.start()] + value + lines[k][found.end():]
                    errors, screen = self.check("\n".join([*lines[:k], line, *lines[k + 1:]]) + "\n", suffix)
                    self.assertFalse(errors and min(errors) <= second < max(errors), f"{line}: {errors}")
                    faulty += bool(errors)
                    hints += HINT in screen
        return faulty, hints

    def test_digits(self):
        faulty, hints = self.replaced(DIGITS, ".inp")
        self.assertGreater(faulty, 60)
        self.assertGreater(hints, 20)

    def test_words(self):
        faulty, hints = self.replaced(WORDS, ".toml")
        self.assertGreater(faulty, 80)
        self.assertGreater(hints, 40)

    def test_own_errors_are_reported(self):
        """Errors of the values that the second case gives itself"""
        for text, suffix, old, new in ((DIGITS, ".inp", "0.42  200.", "0.42  -200."), (WORDS, ".toml", "[200.0", "[-200.0")):
            second = text[:text.index(SECOND)].count("\n") + 1
            own, screen = self.check(text.format(fn="1e99"), suffix)
            self.assertTrue(own and min(own) > second, own)
            self.assertNotIn(HINT, screen)
            both, screen = self.check(text.format(fn="1e99").replace(old, new), suffix)
            self.assertEqual([line > second for line in both], [False, True])
            kept, screen = self.check(text.format(fn="9.5").replace(old, new), suffix)
            self.assertEqual([line > second for line in kept], [False])
            self.assertIn(f"1 of the faulty cases keeps {HINT}", screen)
            self.assertIn("2 faulty cases, 1 error,", screen)


if __name__ == "__main__":
    unittest.main(verbosity=2)
