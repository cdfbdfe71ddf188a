#!/usr/bin/env python3
"""The user interface of the program: texts, exit codes, modes, prompts, options, files.

The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import os
import pty
import re
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]

# One case of a frictionless ball; {name} is a part that tests vary
CASE = """{module}
{first}
{second}
{third}
100 100 30 1 1e-5
{fn} 0 0 0
0.3 0.3
{poiss} 0.28 82000 82000
-1
{mx} 7 0.001 0.001 1.2
"""
PLAIN = dict(module="3", first="200100", second="022020", third="0000201", fn="100", poiss="0.28", mx="7")


def case(**changes):
    return CASE.format(**dict(PLAIN, **changes))


class Cli(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", newline="") as file:
            file.write(text)

    def read(self, name):
        with open(self.path(name)) as file:
            return file.read()

    def files(self, folder=""):
        return sorted(os.listdir(self.path(folder)))

    def run_program(self, *arguments, answers=None, environment=None):
        given = dict(stdin=subprocess.DEVNULL) if answers is None else dict(input=answers)
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=60, env=environment,
                              **given)

    def fails(self, run, *texts):
        """The run ended with an error, with these texts in order on the standard error stream"""
        self.assertEqual(run.returncode, 1, run.stdout + run.stderr)
        for text in texts:
            self.assertIn(text, run.stderr)
        self.assertNotIn("Backtrace", run.stderr)

    def succeeds(self, run):
        self.assertEqual((run.returncode, run.stderr), (0, ""), run.stdout)


class Words(Cli):
    def test_help(self):
        run = self.run_program("--help")
        self.succeeds(run)
        for word in ("Usage", "IMODE", "EXPNAM", "--output-dir", "--threads", "--quiet", "--version"):
            self.assertIn(word, run.stdout)
        self.assertNotRegex(run.stdout, r"[a-z]_[a-z]", "a name of the sources among the words")
        for command in ("convert", "explain"):
            for option in ("--help", "-h"):
                run = self.run_program(command, option)
                self.succeeds(run)
                self.assertEqual(run.stderr, "")
                self.assertIn("contact " + command, run.stdout)

    def test_version(self):
        run = self.run_program("--version")
        self.succeeds(run)
        self.assertRegex(run.stdout, r"\Acontact \d+\.\d+\.\d+\n")
        self.assertRegex(run.stdout, r"\ntransforms by (FFTW 3 \(GPL\)|pocketfft \(BSD\)|MKL)\n\Z")

    def test_licence_mode(self):
        run = self.run_program("1")
        self.succeeds(run)
        self.assertIn("no licence is needed", run.stdout)

    def test_wrong_words(self):
        for words, text in [(["0"], "'0'"), (["4", "x"], "'4'"), (["-3"], "-3"), (["two", "x"], "'two'"),
                            (["2.0", "x"], "'2.0'"), (["99999999999999999999", "x"], "9999"),
                            (["--fast", "2", "x"], "'--fast'"), (["2", "x", "--fast"], "'--fast'"),
                            (["-q", "2", "x"], "'-q'"), (["--quiet=1", "2", "x"], "--quiet"),
                            (["--threads", "none", "2", "x"], "'none'"), (["--threads=0", "2", "x"], "'0'"),
                            (["2", "x", "--threads"], "--threads"), (["2", "x", "--output-dir"], "--output-dir"),
                            (["--output-dir=", "2", "x"], "--output-dir")]:
            with self.subTest(words=words):
                run = self.run_program(*words)
                self.fails(run, text, "Usage: contact")
                self.assertEqual(len(run.stderr.splitlines()), 2, "one sentence and the usage line")
                self.assertEqual(run.stdout, "")
        self.assertEqual(self.files(), [])

    def test_order_of_words(self):
        self.write("ball.inp", case() + "0\n")
        for words in (["--quiet", "2", "ball"], ["2", "--quiet", "ball"], ["2", "ball", "--quiet"],
                      ["2", "ball", "ignored", "words", "--quiet"], ["--quiet", "--", "2", "ball"],
                      ["--threads", "2", "--quiet", "2", "ball.inp"]):
            with self.subTest(words=words):
                run = self.run_program(*words)
                self.succeeds(run)
                self.assertEqual(run.stdout, "")
                self.assertEqual(self.files(), ["ball.inp", "ball.out"])
                os.remove(self.path("ball.out"))


class Questions(Cli):
    def test_both(self):
        self.write("ball.inp", case() + "0\n")
        self.succeeds(self.run_program(answers="2\nball\n"))
        self.assertIn("ball.out", self.files())

    def test_repeated_until_a_mode_is_chosen(self):
        run = self.run_program(answers="0\nx\n\n17\n1\n")
        self.succeeds(run)
        self.assertEqual(run.stdout.count("Mode (1, 2 or 3)"), 5)

    def test_empty_name(self):
        self.write("contact.inp", case() + "0\n")
        self.succeeds(self.run_program("2", answers="\n"))
        self.assertIn("contact.out", self.files())

    def test_foreign_line_ends(self):
        self.write("ball.inp", case() + "0\n")
        self.succeeds(self.run_program(answers="2\r\nball\r\n"))

    def test_end_of_input(self):
        for words, answers in ([], None), ([], ""), ([], "x\n"), ([], "2\n"), (["3"], ""):
            with self.subTest(words=words, answers=answers):
                self.fails(self.run_program(*words, answers=answers), "the input ended")


class Runs(Cli):
    def test_out_file(self):
        self.write("ball.inp", case() + case(fn="200") + "0\n")
        run = self.run_program("2", "ball")
        self.succeeds(run)
        lines = self.read("ball.out").splitlines()
        self.assertIn("detailed investigation of 3D", lines[1])
        self.assertEqual([line for line in lines if "Case" in line], [" Case     1", " Case     2"])
        self.assertIn(" Case     2", run.stdout)
        self.assertIn("ended normally", lines[-1])
        self.assertNotIn("TOTAL FORCES", run.stdout)
        self.assertNotIn("\r", run.stdout)

    def test_foreign_input(self):
        text = case() + "0\n"
        self.write("ball.inp", text)
        self.write("foreign.inp", text.replace(" ", "\t").replace("\n", "\r\n"))
        for name in "ball", "foreign":
            self.succeeds(self.run_program("2", name))
        results = [self.read(name + ".out").split("|Activity")[0] for name in ("ball", "foreign")]
        self.assertEqual(*results)

    def test_folders_and_suffix(self):
        os.mkdir(self.path("a"))
        os.mkdir(self.path("results"))
        self.write("a/ball.inp", case(third="0001201") + "0\n")
        for name in ("a/ball", "a\\ball", "./a/ball.inp", self.path("a/ball")):
            with self.subTest(name=name):
                self.succeeds(self.run_program("2", name))
                self.assertEqual(self.files("a"), ["ball.0001.mat", "ball.inp", "ball.out"])
                for made in "ball.0001.mat", "ball.out":
                    os.remove(self.path("a/" + made))
        for folder in ("results", "results/"):
            with self.subTest(folder=folder):
                self.succeeds(self.run_program("2", "a/ball", "--output-dir", folder))
                self.assertEqual(self.files("a"), ["ball.inp"])
                self.assertEqual(self.files("results"), ["ball.0001.mat", "ball.out"])
        self.fails(self.run_program("2", "a/ball", "--output-dir", "nowhere"), "nowhere/ball.out")
        self.assertEqual(self.files(), ["a", "results"])

    def test_mat_file_per_case(self):
        self.write("ball.inp", case(third="0001001") + case(third="0000001") + case(third="0002001") + "0\n")
        self.succeeds(self.run_program("2", "ball"))
        self.assertEqual(self.files(), ["ball.0001.mat", "ball.0003.mat", "ball.inp", "ball.out"])
        tables = []
        for name in "ball.0001.mat", "ball.0003.mat":
            rows = [line.split() for line in self.read(name).splitlines() if not line.startswith("%")]
            tables.append(rows[6:])
        self.assertEqual(len(tables[1]), 49)
        self.assertLess(len(tables[0]), 49)

    def test_result_elements(self):
        third = "0001201"
        self.write("ball.inp", "".join(case(module="3 %d" % element, third=third) for element in (7, 2, 7)) + "0\n")
        self.succeeds(self.run_program("2", "ball"))
        self.assertEqual(self.files(), ["ball.inp", "ball.out", "ball_re002.0001.mat", "ball_re007.0001.mat",
                                        "ball_re007.0002.mat"])
        self.assertEqual(re.findall(r"^ Case.*", self.read("ball.out"), re.MULTILINE),
                         [" Case     1, result element   7", " Case     1, result element   2",
                          " Case     2, result element   7"])

    def test_many_result_elements(self):
        """More problems than the initial size of the table of sessions, each with its own memory"""
        loads = [100 + 10*element for element in range(1, 21)]
        first = "".join(case(module="3 %d" % k, third="0000101", fn=load) for k, load in enumerate(loads, 1))
        again = "".join("3 %d\n200100\n100000\n0100101\n%d 0 0 0\n" % (k, load) for k, load in enumerate(loads, 1))
        self.write("ball.inp", first + again + "0\n")
        self.succeeds(self.run_program("2", "ball"))
        found = re.findall(r"FRIC.*\n +([\d.]+)", self.read("ball.out"))
        self.assertEqual([float(value) for value in found], loads + loads)

    def test_subsurface_file(self):
        self.write("ball.inp", case(first="200103") + "1 0\n1\n2 0.5 0.5\n0\n0\n" + "0\n")
        run = self.run_program("2", "ball")
        self.succeeds(run)
        self.assertIn("ball.0001.subs", self.files())

    def test_stored_only(self):
        """R = 2 stays in the module and prints the case line only"""
        self.write("ball.inp", case(third="0001202") + "200100\n000000\n0101201\n100 0 0 0\n0.3 0.3\n0\n")
        self.succeeds(self.run_program("2", "ball"))
        self.assertEqual(self.read("ball.out").count("TOTAL FORCES"), 1)
        self.assertEqual(self.files(), ["ball.0002.mat", "ball.inp", "ball.out"])

    def test_pictures_in_the_flow_trace(self):
        for level, pictures in (("8", 0), ("9", 1)):
            self.write("ball.inp", case(third="00002" + level + "1") + "0\n")
            run = self.run_program("2", "ball")
            self.succeeds(run)
            rows = re.findall(r"^ +\d+   o( [.*]){5} o$", run.stdout, re.MULTILINE)
            self.assertEqual(len(rows), 2*pictures, "corner rows of the element division")

    def test_threads(self):
        self.write("ball.inp", case() + "0\n")
        self.succeeds(self.run_program("2", "ball", "--threads", "3"))
        self.assertIn("using  3 threads", self.read("ball.out"))
        self.succeeds(self.run_program("2", "ball", "--threads", "1"))
        self.assertNotIn("threads", self.read("ball.out"))

    def test_progress_on_a_terminal_only(self):
        self.write("ball.inp", case(mx="51") + "3\n200100\n100000\n0100001\n100 0 0 0\n"*20000 + "0\n")
        self.succeeds(self.run_program("2", "ball"))
        plain = self.read("ball.out").split("|Activity")[0]
        try:
            terminal, other_end = pty.openpty()
        except OSError as why:  # a bare chroot has no pseudo-terminals
            self.skipTest(str(why))
        with open(self.path("screen"), "w") as screen:
            child = subprocess.Popen([PROGRAM, "2", "ball"], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=screen,
                                     stderr=other_end)
        os.close(other_end)
        seen = b""
        while True:
            try:
                part = os.read(terminal, 4096)
            except OSError:
                break
            if not part:
                break
            seen += part
        os.close(terminal)
        self.assertEqual(child.wait(60), 0)
        self.assertRegex(seen, rb"\r case \d+ of 20001, \d+:\d\d left")
        self.assertTrue(seen.endswith(b"\r\x1b[K"), "the line is cleared at the end")
        self.assertNotIn("\r", self.read("screen"))
        self.assertEqual(self.read("ball.out").split("|Activity")[0], plain)


class Failures(Cli):
    def test_missing_file(self):
        for mode in "2", "3":
            self.fails(self.run_program(mode, "nowhere/ball"), "nowhere/ball.inp")
        self.fails(self.run_program("2", "./"), "names no experiment")
        self.assertEqual(self.files(), [])

    def test_place_of_an_error(self):
        self.write("ball.inp", case() + case(fn="12x4") + "0\n")
        run = self.run_program("2", "ball")
        self.fails(run, "ball.inp:16:1: ", "12x4")
        out = self.read("ball.out")
        self.assertEqual(out.count("TOTAL FORCES"), 1, "the first case was computed")
        self.assertIn("12x4", out)
        self.assertIn("ended with errors", out)

    def test_wrong_value(self):
        self.write("ball.inp", case(poiss="0.7", third="0001201") + case() + "0\n")
        run = self.run_program("2", "ball")
        self.fails(run, "Input: ERROR", "ball.inp:8:1: ", "0.7")
        self.assertNotIn("TOTAL FORCES", self.read("ball.out"))
        self.assertEqual(self.files(), ["ball.inp", "ball.out"])

    def test_quiet_tells_errors_only(self):
        self.write("ball.inp", case(poiss="0.7") + "0\n")
        run = self.run_program("--quiet", "2", "ball")
        self.fails(run, "Input: ERROR")
        self.assertEqual(run.stdout, "")

    def test_end_of_file(self):
        """All cases before the end are computed"""
        self.write("ball.inp", case())
        self.fails(self.run_program("2", "ball"), "ball.inp:")
        self.assertEqual(self.read("ball.out").count("TOTAL FORCES"), 1)
        self.write("ball.inp", "\n".join(case().splitlines()[:6]) + "\n")
        self.fails(self.run_program("2", "ball"), "ball.inp:")
        self.assertNotIn("TOTAL FORCES", self.read("ball.out"))

    def test_wheel_rail(self):
        """Cases of wheel-rail contact: missing profiles, wrong values, effects that are not implemented"""
        first = """1
            1203100
            0022033
            0000321
            999 100 30 1 1e-5
            0.3 0.3
            0.28 0.28 82000. 82000.
            0.2 0.2 1. 90d %s 4.
            14. 0 1435. 0.
            'rail.prr' 0 1. 0.
            0. 0. 0. 0. 0. 0.
            1360. -70. 460.
            'wheel.prw' 0 1. 0.
            0. 0. 10000. 0. 0. 0.
            2000. 0. 0. 0. 0. -4.3
            0\n"""
        self.write("ball.inp", first % "8.")
        for mode in "2", "3":
            self.fails(self.run_program(mode, "ball"), "rail.prr", "rail profile", "case 1")
        self.write("rail.prr", "header.begin\n version = 1\n type = 0\nheader.end\nspline.begin\npoint.begin\n 1. x\n")
        self.fails(self.run_program("3", "ball"), "rail.prr:7:", "case 1")
        self.write("ball.inp", first % "3.")
        self.fails(self.run_program("3", "ball"), "D_SEP = 3. is smaller than D_COMB = 4.")
        self.write("ball.inp", (first % "8.").replace("0022033", "0082033"))
        for mode in "2", "3":
            self.fails(self.run_program(mode, "ball"), "ball.inp:3:13: ", "D = 8",
                       "not implemented in this version for wheel on rail", "use D = 2 or 7")
        self.assertNotIn("TOTAL FORCES", self.read("ball.out"))

    def test_unknown_module(self):
        self.write("ball.inp", "5\n")
        self.fails(self.run_program("2", "ball"), "ball.inp:1:1: ", "MODULE = 5")

    def test_check_reports_all_cases(self):
        self.write("ball.inp", case(poiss="0.7", mx="0") + case() + case(fn="-1", poiss="-1.1") + case(second="022420") + "0\n")
        run = self.run_program("3", "ball")
        self.fails(run, "ball.inp:8:1: ", "ball.inp:10:1: ", "ball.inp:26:1: ", "ball.inp:28:1: ")
        self.assertIn("4 cases checked", run.stdout)
        self.assertEqual(self.files(), ["ball.inp"], "a check writes no files")

    def test_check_without_errors(self):
        self.write("ball.inp", case() + "0\n")
        run = self.run_program("3", "ball")
        self.succeeds(run)
        self.assertIn("1 case checked, 0 faulty cases", run.stdout)
        for name in os.listdir(os.path.join(SOURCE, "examples")):
            if name.endswith(".inp"):
                self.succeeds(self.run_program("3", os.path.join(SOURCE, "examples", name)))

    def test_case_that_cannot_be_solved(self):
        """It is reported, the next cases are computed, and the run counts as failed"""
        hertz = "-1\n7 7 0.001 0.001 1.2\n"
        without_contact = "1\n7 7 -1 -1 0.3 0.3\n1 2\n0.001 0 0.001 0 0 0\n0 0 0 0 0 1\n"
        third = "0001201"
        self.write("ball.inp", case(third=third) + case(third=third).replace(hertz, without_contact) + case(third=third) + "0\n")
        run = self.run_program("2", "ball")
        self.fails(run, "ERROR", "case 2", "planform")
        self.assertEqual(self.read("ball.out").count("TOTAL FORCES"), 2)
        self.assertEqual(self.files(), ["ball.0001.mat", "ball.0003.mat", "ball.inp", "ball.out"])

    def test_unwritable_mat_file(self):
        self.write("ball.inp", case(third="0001201") + case() + "0\n")
        os.mkdir(self.path("ball.0001.mat"))
        run = self.run_program("2", "ball")
        self.fails(run, "ball.0001.mat")
        self.assertEqual(self.read("ball.out").count("TOTAL FORCES"), 2, "the run continues")
        self.assertEqual(self.files(), ["ball.0001.mat", "ball.inp", "ball.out"])


if __name__ == "__main__":
    unittest.main(verbosity=1)
