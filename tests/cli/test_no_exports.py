#!/usr/bin/env python3
"""Effects that are not requested cost nothing: files made by a run with and without the options for other programs.

System calls are counted where strace is installed. The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]
STRACE = shutil.which("strace")
OPTIONS = ("--hdf5", "--json", "--vtk")
# Case, and the part of it that is repeated
CASE = "3\n203100\n{words}2000 {creep:.9f} 0 0\n{rest}"
REST = "0.3 0.3\n0 0.2 1000\n0.28 0.28 82000 82000\n1\n13 11 -1.3 -1.1 0.2 0.2\n1 1\n0.01 0 0.01 0 0 0\n"


class NoExports(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def run_program(self, *arguments):
        for old in os.listdir(self.folder):
            if not old.endswith(".inp"):
                os.remove(os.path.join(self.folder, old))
        subprocess.run([*arguments], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, check=True, timeout=300)

    def results(self):
        return sorted(name for name in os.listdir(self.folder) if not name.endswith((".inp", ".trace")))

    def table(self, cases):
        with open(os.path.join(self.folder, "table.inp"), "w") as file:
            for k in range(cases):
                words = "022020\n0002001\n999 100 30 1 1e-5\n" if k == 0 else "100000\n0112001\n"
                file.write(CASE.format(words=words, creep=-1e-5 * k, rest=REST if k == 0 else ""))
            file.write("0\n")

    def test_files_of_a_plain_run(self):
        """Module 3 and module 1: .out, .mat and .subs as requested by the input"""
        shutil.copytree(os.path.join(SOURCE, "examples", "profiles"), os.path.join(self.folder, "profiles"))
        for name in ("subsurface", "wheel_on_rail"):
            shutil.copy(os.path.join(SOURCE, "examples", name + ".inp"), self.folder)
        expected = {"subsurface": r"subsurface(\.000[1-4]\.subs|\.out)",
                    "wheel_on_rail": r"wheel_on_rail(\.00\d\d[a-z]\.mat|\.out)"}
        for name, pattern in expected.items():
            before = set(os.listdir(self.folder))
            subprocess.run([PROGRAM, "--quiet", "2", name], cwd=self.folder, stdin=subprocess.DEVNULL, check=True, timeout=300)
            made = set(os.listdir(self.folder)) - before
            self.assertTrue(made)
            for file in made:
                self.assertRegex(file, "^" + pattern + "$")

    def test_the_options_do_not_change_the_usual_files(self):
        self.table(3)

        def contents():
            found = {}
            for name in self.results():
                if name.endswith((".mat", ".out")):
                    with open(os.path.join(self.folder, name)) as file:
                        # the table of times at the end of the .out file differs between runs
                        found[name] = re.split(r"\n.*[Tt]ime", file.read())[0] if name.endswith(".out") else file.read()
            return found

        self.run_program(PROGRAM, "--quiet", "2", "table")
        plain = contents()
        self.assertEqual(len(plain), 4)
        self.run_program(PROGRAM, "--quiet", *OPTIONS, "2", "table")
        self.assertEqual(contents(), plain)

    @unittest.skipUnless(STRACE, "there is no strace")
    def test_system_calls_of_a_plain_run(self):
        def traced(cases, *options):
            self.table(cases)
            trace = os.path.join(self.folder, "calls.trace")
            self.run_program(STRACE, "-f", "-qq", "-o", trace, "-e", "trace=file,write,pwrite64,read", PROGRAM, "--quiet", *options,
                             "2", "table")
            with open(trace, errors="replace") as file:
                return file.read()

        calls = traced(3)
        made = set(re.findall(r'open(?:at)?\((?:AT_FDCWD, )?"([^"]*)", [^)]*O_(?:WRONLY|RDWR)', calls))
        made = {os.path.basename(name) for name in made if not name.startswith(("/dev/", "/proc/"))}
        allowed = r"(table(\.\d{4}\.mat|\.out|\.unfinished)(\.part|\.tmp)?|table\.lock)"
        self.assertTrue(made)
        for name in made:
            self.assertRegex(name, "^" + allowed + "$")
        # system calls of one more case: its .mat file and a few writes of the .out file, the same number each time
        counts = [len(traced(n).splitlines()) for n in (10, 20, 30)]
        self.assertLess((counts[2] - counts[0]) / 20, 60)
        self.assertLess(abs(counts[2] - 2 * counts[1] + counts[0]), 20)
        more = len(traced(30, "--hdf5").splitlines())
        self.assertGreater(more, counts[2])


if __name__ == "__main__":
    unittest.main()
