#!/usr/bin/env python3
"""A confined run: regular files below the folder of the experiment only, and limits of its resources.

The environment gives CONTACT_PROGRAM and CONTACT_SOURCE, and by INJECT_NO_OPENAT2 that the system has no openat2
(tests/faults/inject.c).
"""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = pathlib.Path(os.environ["CONTACT_SOURCE"])
EXAMPLES = SOURCE / "examples"

PROFILES = ("60E1.prr", "S1002.prw")
#: Can the system not resolve links safely? Then a confined run follows none
NO_LINKS = "INJECT_NO_OPENAT2" in os.environ
OUTSIDE, BEHIND_LINK = "not below the folder", "there is a symbolic link in its name"
BALL = """3
203100
{digits}
0001{output}01
999 100 30 1 1e-5
100 0.001 0 0
0.3 0.3
0 {dx} 1000
{file}
0.28 0.28 82000 82000
1
{n} {n} -1 -1 {dx} {dx}
1 1
0.01 0 0.01 0 0 0
"""


def ball(n=20, output="2", coefficients=""):
    digits = "0029020" if coefficients else "0022020"
    text = BALL.format(digits=digits, output=output, dx=2 / n, n=n, file=coefficients)
    return text.replace("\n\n", "\n")


class Confined(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.outside = pathlib.Path(scratch.name) / "outside"
        self.folder = pathlib.Path(scratch.name) / "inside"
        shutil.copytree(EXAMPLES / "profiles", self.outside / "profiles")
        shutil.copytree(EXAMPLES / "profiles", self.folder / "profiles")
        self.rail = (EXAMPLES / "wheel_on_rail.inp").read_text(encoding="utf-8")
        (self.outside / "secret.txt").write_text("the secret of the operator\n")

    def run_program(self, *arguments, cwd=None):
        done = subprocess.run([PROGRAM, *arguments], cwd=cwd or self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=60)
        return done.returncode, done.stdout, done.stderr

    def write(self, text, name="a.inp"):
        (self.folder / name).write_text(text, encoding="utf-8")

    def refused(self, why, text):
        """Refused by a check and by a run; without --confine not refused for this reason"""
        self.write(text)
        for mode in ("3", "2"):
            for place, words in ((self.folder, ["a"]), (self.folder.parent, ["inside/a"]),
                                 (self.outside, [str(self.folder / "a")])):
                status, _, err = self.run_program("--confine", mode, *words, cwd=place)
                self.assertEqual(status, 1, (mode, words, err))
                self.assertIn(why, err, (mode, words))
                self.assertNotIn("secret of", err)

    def test_what_is_inside_is_read(self):
        self.write(self.rail)
        (self.folder / "links").symlink_to("profiles")
        for text in (self.rail, self.rail.replace("profiles/", "links/"), self.rail.replace("profiles/", "profiles//./")):
            self.write(text)
            places = ((self.folder, ["a"]), (self.folder.parent, ["inside/a"]), (self.outside, [str(self.folder / "a")]))
            for place, words in places:
                status, _, err = self.run_program("--confine", "--limit-elements=1000000", "3", *words, cwd=place)
                if NO_LINKS and "links/" in text:
                    self.assertEqual((status, err.count(BEHIND_LINK)), (1, 2), err)
                else:
                    self.assertEqual((status, err), (0, ""), (text[:40], words))

    def test_profiles_outside(self):
        outside, behind_link = OUTSIDE, BEHIND_LINK if NO_LINKS else OUTSIDE
        self.refused(outside, self.rail.replace("profiles/", "../outside/profiles/"))
        self.refused(outside, self.rail.replace("profiles/", str(self.outside / "profiles") + "/"))
        self.refused(outside, self.rail.replace("profiles/", "profiles/../../outside/profiles/"))
        self.refused(outside, self.rail.replace("profiles/", "..\\outside\\profiles\\"))
        (self.folder / "away").symlink_to(self.outside / "profiles")
        self.refused(behind_link, self.rail.replace("profiles/", "away/"))
        (self.folder / "up").symlink_to("..")
        self.refused(behind_link, self.rail.replace("profiles/", "up/outside/profiles/"))
        for name in PROFILES:
            (self.folder / "profiles" / name).unlink()
            (self.folder / "profiles" / name).symlink_to(self.outside / "profiles" / name)
        self.refused(behind_link, self.rail)

    def test_files_of_other_kinds(self):
        for name in PROFILES:
            (self.folder / "profiles" / name).unlink()
            os.mkfifo(self.folder / "profiles" / name)
        self.refused("not a regular file", self.rail)
        self.assertEqual(self.run_program("3", "a")[0], 1)   # and no process waits for it
        self.refused("not below the folder", ball(coefficients="'/dev/zero'"))
        self.refused("not below the folder", ball(coefficients="'/proc/self/environ'"))

    def test_slices_outside(self):
        slices = self.folder / "profiles" / "flat.slcw"
        text = slices.read_text(encoding="utf-8")
        names = [word for word in text.replace("'", " ").split() if word.startswith("flat/")]
        slices.write_text(text.replace(names[0], "../../outside/secret.txt"), encoding="utf-8")
        self.refused("not below the folder", (EXAMPLES / "wheel_flat.inp").read_text(encoding="utf-8"))

    def test_coefficients_outside(self):
        self.refused("not below the folder", ball(coefficients="'../outside/secret.txt'"))
        self.refused("No such file", ball(coefficients="'missing.txt'"))
        # without --confine the message contains at most one line of what is read, truncated
        (self.folder / "long.txt").write_text("x" * 5000 + "\n")
        self.write(ball(coefficients="'long.txt'"))
        status, _, err = self.run_program("2", "a")
        self.assertEqual(status, 1)
        self.assertLess(len(err), 600)

    def test_input_and_results_are_no_links(self):
        (self.folder / "a.inp").symlink_to(self.outside / "secret.txt")
        status, _, err = self.run_program("--confine", "2", "a")
        self.assertEqual(status, 1)
        self.assertIn(BEHIND_LINK if NO_LINKS else OUTSIDE, err)
        secret = (self.outside / "secret.txt").read_text()
        for suffix in ("out", "jsonl", "pvd", "h5.tmp", "h5", "0001.mat", "0001.mat.tmp"):
            for name in os.listdir(self.folder):
                if name.startswith("b."):
                    (self.folder / name).unlink()
            self.write(ball(), "b.inp")
            (self.folder / ("b." + suffix)).symlink_to(self.outside / "secret.txt")
            status, _, err = self.run_program("--confine", "--json", "--vtk", "--hdf5", "2", "b")
            self.assertEqual((self.outside / "secret.txt").read_text(), secret, suffix)
            if suffix in ("out", "jsonl", "pvd"):
                self.assertEqual(status, 1, suffix)
                self.assertIn("not a regular file", err)

    def size(self):
        return sum(path.stat().st_size for path in self.folder.rglob("*") if path.is_file() and path.suffix not in (".inp", ".slcs")
                   and path.parent.name != "profiles")

    def test_output(self):
        self.write(ball(60, output="5") * 60 + "0\n")
        for outputs in ([], ["--json"], ["--hdf5"], ["--vtk"]):
            for path in self.folder.glob("a.*"):
                if path.suffix != ".inp":
                    path.unlink()
            status, out, err = self.run_program("--limit-output=2", *outputs, "2", "a")
            self.assertEqual(status, 1, (outputs, out[-300:]))
            self.assertIn("more than the limit of 2 MB (--limit-output)", err)
            self.assertLess(self.size(), 3.0e6, outputs)
            report = (self.folder / "a.out").read_text(encoding="utf-8")
            self.assertIn("limit of 2 MB", report)
            self.assertTrue(report.rstrip().endswith("CONTACT ended with errors."))
            self.assertFalse([path for path in self.folder.iterdir() if path.suffix in (".tmp", ".lock")])
        status, _, err = self.run_program("--limit-output=1000", "2", "a")
        self.assertEqual((status, err), (0, ""))

    def test_time_of_the_run(self):
        self.write(ball(80) * 1000 + "0\n")
        status, out, err = self.run_program("--limit-run-time=1", "2", "a")
        self.assertEqual(status, 1)
        self.assertIn("time limit of 1", err)
        self.assertIn("by the run as a whole", err)
        self.assertIn("Not complete", out)

    def test_defaults(self):
        self.write(ball(1400) + "0\n")
        status, _, err = self.run_program("--confine", "2", "a")
        self.assertEqual(status, 1)
        self.assertIn("1960000 elements are more than the limit of 1000000", err)


if __name__ == "__main__":
    unittest.main()
