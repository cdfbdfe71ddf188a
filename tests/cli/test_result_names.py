#!/usr/bin/env python3
"""Profiles, slices and files of influence coefficients that are a result by name or by a link: refused before anything is written.

The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import os
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
EXAMPLES = os.path.join(os.environ["CONTACT_SOURCE"], "examples")
RAIL = "profiles/60E1.prr"
#: Files that runs write or delete, after the name of the experiment
RESULTS = (".out", ".jsonl", ".h5", ".pvd", ".unfinished", ".lock", ".0001.mat", ".0012a.mat", "_re005.0001.subs",
           ".0001.block2.vts", ".h5.tmp", ".h5.part", ".0001.mat.tmp")
#: Names that belong to no result
OTHERS = (".prr", ".txt", "x.out", ".rail.out", "_rail.mat")
COEFFICIENTS = """3
203100
0029020
0000301
100 100 30 1 1e-5
9.2 0.001 0 0
0.4 0.4
0d 0.1 1000.
'{name}'
0.42 0.42 200. 200.
1
24 24 -1.2 -1.2 0.1 0.1
1 1
0.01 0 0.01 0 0 0
0
"""


class ResultNames(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        shutil.copytree(os.path.join(EXAMPLES, "profiles"), os.path.join(self.folder, "profiles"))
        with open(os.path.join(EXAMPLES, "wheel_on_rail.inp"), encoding="utf-8") as file:
            self.wheel = " 1 MODULE" + file.read().split(" 1 MODULE")[1].split("\n\n")[0] + "\n 0 MODULE\n"

    def run_on(self, mode, name, text, *options):
        """Run the experiment "exp" with a copy of the rail of this name; the text of the errors, and the new files"""
        path = os.path.join(self.folder, name)
        rail = os.path.join(self.folder, RAIL)
        shutil.copyfile(rail, path)
        with open(os.path.join(self.folder, "exp.inp"), "w", encoding="utf-8") as file:
            file.write(text)
        before = set(os.listdir(self.folder))
        run = subprocess.run([PROGRAM, "--quiet", *options, mode, "exp"], cwd=self.folder, stdin=subprocess.DEVNULL,
                             capture_output=True, text=True, timeout=60, check=False)
        new = set(os.listdir(self.folder)) - before
        with open(path, "rb") as file, open(rail, "rb") as copy:
            self.assertEqual(file.read(), copy.read(), f"{name} is unchanged")
        os.remove(path)
        for file in new:
            os.remove(os.path.join(self.folder, file))
        return run.stderr, new

    def test_profiles(self):
        for rest in RESULTS:
            for name in ("exp" + rest, "./profiles/../exp" + rest):
                for mode in "23":
                    said, new = self.run_on(mode, name, self.wheel.replace(RAIL, name))
                    self.assertIn(f"{name} is the name of a result of this experiment", said)
                    self.assertIn("exp.inp:", said)
                    self.assertEqual(new, set())

    def test_other_names(self):
        for rest in OTHERS:
            said, _ = self.run_on("3", "exp" + rest, self.wheel.replace(RAIL, "exp" + rest))
            self.assertNotIn("is the name of a result", said)

    def test_other_folder(self):
        os.mkdir(os.path.join(self.folder, "results"))
        said, _ = self.run_on("2", "exp.h5", self.wheel.replace(RAIL, "exp.h5"), "--output-dir", "results")
        self.assertNotIn("is the name of a result", said)

    def test_coefficients(self):
        for rest in (".out", ".0001.mat"):
            said, new = self.run_on("2", "exp" + rest, COEFFICIENTS.format(name="exp" + rest))
            self.assertIn(f"exp{rest} is the name of a result of this experiment", said)
            self.assertEqual(new, set())

    def slices(self, name):
        """A slices file with the rail in four places, and the input that uses it"""
        with open(os.path.join(self.folder, "profiles", "rail.slcs"), "w", encoding="utf-8") as file:
            file.write("0.0 1.0\n4\n0 0 0\n1\n" + "".join(f"{u} '60E1.prr'\n" for u in (-900, -300, 300)) + f"900 '{name}'\n")
        return self.wheel.replace(RAIL, "profiles/rail.slcs").replace("14.0 0 1435.0 0.025", "-1.0 753.0 0.1 0.025")

    def test_slices(self):
        for name in ("exp.out", "exp.0001.mat"):
            for mode in "23":
                said, new = self.run_on(mode, name, self.slices("../" + name))
                self.assertIn(f"../{name} is the name of a result of this experiment", said)
                self.assertIn("rail.slcs:8:", said)
                self.assertEqual(new, set())
        said, _ = self.run_on("3", "exp.prr", self.slices("../exp.prr"))
        self.assertEqual(said, "")

    def test_links(self):
        """A result that is a link to the profile, which would be written through the link, and a profile that is one to a result"""
        for link in (os.symlink, os.link):
            for rest in (".out", ".jsonl", ".pvd"):
                result = os.path.join(self.folder, "exp" + rest)
                link(os.path.join(self.folder, RAIL), result)
                for text, name in ((self.wheel, RAIL), (self.slices("60E1.prr"), "60E1.prr")):
                    said, new = self.run_on("2", "other.prr", text)
                    self.assertIn(f"{name} leads by a link to a result of this experiment", said)
                    self.assertEqual(new, set())
                os.remove(result)
        for rest in (".out", ".0001.mat"):
            link = os.path.join(self.folder, "linked.prr")
            os.symlink("exp" + rest, link)
            said, new = self.run_on("2", "exp" + rest, self.wheel.replace(RAIL, "linked.prr"))
            self.assertIn("linked.prr leads by a link to a result of this experiment", said)
            self.assertEqual(new, set())
            os.remove(link)
        # a link to another file is none
        os.symlink(RAIL, os.path.join(self.folder, "linked.prr"))
        self.assertEqual(self.run_on("3", "other.prr", self.wheel.replace(RAIL, "linked.prr"))[0], "")

    def test_readable_format(self):
        subprocess.run([PROGRAM, "convert", os.path.join(EXAMPLES, "wheel_on_rail.inp"), "--output-dir", self.folder], check=True,
                       capture_output=True, timeout=60)
        with open(os.path.join(self.folder, "wheel_on_rail.toml"), encoding="utf-8") as file:
            text = file.read()
        with open(os.path.join(self.folder, "exp.toml"), "w", encoding="utf-8") as file:
            file.write(text)
        os.symlink(os.path.join(self.folder, RAIL), os.path.join(self.folder, "exp.out"))
        run = subprocess.run([PROGRAM, "--quiet", "2", "exp.toml"], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                             text=True, timeout=60, check=False)
        self.assertIn(f"{RAIL} leads by a link to a result of this experiment", run.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
