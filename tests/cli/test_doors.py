#!/usr/bin/env python3
"""Inputs of the program: modules and result elements keep their own values, numbers have bounds, nothing is ignored silently.

The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import json
import os
import re
import subprocess
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

    def run_text(self, text, mode="2", *more):
        """Status, errors, the .out file and the JSON records of an input"""
        with open(os.path.join(self.folder, "x.inp"), "w") as file:
            file.write(text)
        options = ["--json"] if mode == "2" else []
        run = subprocess.run([PROGRAM, *options, *more, mode, "x"], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertNotIn("Backtrace", run.stderr)
        out, records = run.stdout, []
        if mode == "2":
            with open(os.path.join(self.folder, "x.out")) as file:
                out = file.read()
            for name in sorted(os.listdir(self.folder)):
                if name.endswith(".jsonl"):
                    with open(os.path.join(self.folder, name)) as file:
                        records = [case for case in map(json.loads, file) if case["case"]]
        return run, out, records

    def totals(self, text):
        """Status and, per case, the lines with numbers of the .out file below the case line"""
        run, out, _ = self.run_text(text)
        self.assertEqual(run.returncode, 0, run.stderr + out[-2000:])
        cases = re.split(r"\n Case +\d+.*\n", out)[1:]
        number = re.compile(r"-?\d+\.\d+(?:E[+-]\d+)?")
        return [number.findall(re.split("Parallel run|Time spent", case)[0]) for case in cases]


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
        """A first case of one module has no values of the other to keep"""
        run, _out, _ = self.run_text("3\n" + NEW3.format(**PLAIN3) + "1\n" + KEPT1 + "0\n")
        self.assertEqual(run.returncode, 1)
        self.assertIn("first case", run.stderr)

    def test_cases_are_counted_together(self):
        run, out, _ = self.run_text("3\n" + NEW3.format(**PLAIN3) + "1\n" + NEW1.format(**PLAIN1) + "3\n" + KEPT3 + "0\n")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(re.findall(r"\n Case +(\d+)", out), ["1", "2", "3"])


class Refusals(Doors):
    """Inputs that were once accepted silently"""

    def refused(self, text, *words, modes=("2", "3")):
        for mode in modes:
            run, out, _ = self.run_text(text, mode)
            self.assertEqual(run.returncode, 1, out[-2000:])
            for word in words:
                self.assertIn(word, run.stderr)

    def case3(self, **changes):
        return "3\n" + NEW3.format(**{**PLAIN3, **changes}) + "0\n"

    def test_numbers_beyond_their_bounds(self):
        """Bound, unit and reason are reported with the position in the file"""
        for changes, words in (({"gg": "1e-30"}, "x.inp:9:11: GG1 = 1e-30 is below its lower bound 1.00000E-05 N/mm2: "),
                               ({"pen": "1e300"}, "x.inp:6:1: FN = 1e300 is above its upper bound"),
                               ({"side": "1e300"}, "DX = 1e300 is above its upper bound"),
                               ({"friction": "-0.4 -0.4"}, "FSTAT = -0.4 is below"),
                               ({"rolling": "180 0.1 1000"}, "CHI = 180 is above its upper bound 12.57 rad: "),
                               ({"rolling": "0 nan 1000"}, "x.inp:8:3: "), ({"mx": "99999999999"}, "too large")):
            self.refused(self.case3(**changes), words)

    def test_creepages_and_slopes_of_1e300(self):
        for old, new in (("0.002 0 0", "0.002 1e300 0"), ("0.01 0 0.01 0 0 0", "0.01 0 0.01 1e300 0 0"),
                         ("0.01 0 0.01 0 0 0", "0.01 0 0.01 0 0 1e20")):
            self.refused(self.case3().replace(old, new), new.split()[-2 if new.endswith(" 0") else -1])

    def test_wheel_and_rail(self):
        text = "1\n" + NEW1.format(**PLAIN1) + "0\n"
        self.refused(text.replace("14 0 1435 0\n", "500 0 1435 0\n"), "GAUGHT = 500 is above its upper bound 200 mm: ")
        self.refused(text.replace("0 0 0 0 0 0\n", "0 0 1e5 0 0 0\n"), "DROLLR = 1e5 is above its upper bound")
        self.refused(text.replace("1360 -70 460", "1360 -70 1e-5"), "NOMRADW = 1e-5 is below its lower bound 0.001 mm: ")
        self.refused(text.replace("14 0 1435 0\n", "0 0 1e300 0\n"), "RAILZ0 = 1e300 is above")

    def test_options_of_profiles(self):
        """Values that were clipped or replaced"""
        text = "1\n" + NEW1.format(**PLAIN1) + "0\n"
        for scale, smoothing, handling, words in (
                ("-1", "0 150d 30d 6d 2", "0 0.5", "x.inp:10:14: SCALEYZ = -1 cannot be used; accepted is a factor"),
                ("1", "3 150d 30d 6d 2", "0 0.5", "ISMOOTH = 3 is outside its range 0 to 2"),
                ("1", "0 -1 30d 6d 2", "0 0.5", "ZIGTHRS = -1 cannot be used; accepted is an angle of at least 45 degrees"),
                ("1", "0 150d 30d 6d 2", "2 0.5", "ERRHND = 2 is outside its range -2 to 1"),
                ("1", "0 150d 30d 6d 2", "0 1.5", "MAXOMIT = 1.5 cannot be used; accepted is a part of the length")):
            line = f"'60E1.prr' 0 {scale} 0 0 2\n{smoothing}\n{handling}\n"
            self.refused(text.replace("'60E1.prr' 0 1 0\n", line), words)
        line = "'60E1.prr' 0 1 0 0 2\n0 45d 30d 6d 2\n-2 1\n"
        self.assertEqual(self.run_text(text.replace("'60E1.prr' 0 1 0\n", line))[0].returncode, 0)

    def test_first_case_keeps_nothing(self):
        """Digits that keep values which no previous case has given"""
        for digits, word in (({"vldcmze": "0021020"}, "C = 1"), ({"vldcmze": "0020020"}, "C = 0"),
                             ({"vldcmze": "0022010"}, "Z = 1"), ({"vldcmze": "0022021"}, "E = 1"), ({"third": "1000201"}, "H = 1"),
                             ({"vldcmze": "0122020"}, "L = 1"), ({"vldcmze": "0012020"}, "D = 1"), ({"pbtnfs": "203101"}, "S = 1")):
            self.refused(self.case3(**digits), word, "first case")
        text = "1\n" + NEW1.format(**PLAIN1) + "0\n"
        for old, new, word in (("0022033", "0021033", "C = 1"), ("0022033", "0012033", "D = 1"), ("0022033", "0022013", "Z = 1"),
                               ("0022033", "0022031", "E = 1"), ("0000201", "1000201", "H = 1")):
            self.refused(text.replace(old, new), word, "first case")

    def test_checking_sees_what_solving_refuses(self):
        """An oblique rolling direction and a file of influence coefficients"""
        self.refused(self.case3(rolling="45d 0.1 1000"), "CHI = 0 or 180 degrees")
        text = self.case3(vldcmze="0029020", iteration="200 100 30 10 1e-5").replace("0.28 0.28", "'none.txt'\n0.28 0.28")
        self.refused(text, "none.txt")
        with open(os.path.join(self.folder, "none.txt"), "w") as file:
            file.write("1 1\n0 312\nword\n")
        self.refused(text, "none.txt:3:")

    def test_signs_of_forces(self):
        """A force relative to friction is accepted or refused independently of its direction, alone or with the other one"""
        def verdict(fx, fy, f):
            text = self.case3(pbtnfs=f"2031{f}0").replace("9 0.002 0 0", f"9 {fx} {fy} 0")
            run, _, _ = self.run_text(text, "3")
            same_words = run.stderr.replace("below its lower", "above its upper")
            return run.returncode, re.sub(r"-|x.inp:\d+:\d+:", "", same_words)

        verdicts = set()
        for f in (1, 2):
            for size_x, size_y in ((0.8, 0.3), (0.8, 0.8), (1.5, 0.0), (1.5, 0.3), (0.3, 1.5), (1.5, 1.5), (1.0, 0.0), (0.7, 0.7)):
                expected = verdict(size_x, size_y, f)
                verdicts.add(expected[0])
                for x, y in ((-1, 1), (1, -1), (-1, -1)):
                    self.assertEqual(verdict(x*size_x, y*size_y, f), expected, (f, x*size_x, y*size_y))
        self.assertEqual(verdicts, {0, 1})

    def test_words_of_digits_with_a_sign(self):
        """Each of the three words, at its position, in both modules"""
        for module, case in (("3", NEW3.format(**PLAIN3)), ("1", NEW1.format(**PLAIN1))):
            lines = case.split("\n")
            for k in range(3):
                changed = lines[:k] + ["  -" + lines[k]] + lines[k + 1:]
                self.refused(f"{module}\n" + "\n".join(changed) + "0\n", f"x.inp:{k + 2}:3: ", f"= -{lines[k]} is negative")

    def test_table_of_too_many_coefficients(self):
        """99800 x (2 x 279 - 1) x 9 numbers are more than 5e8, one row of offsets less is not"""
        with open(os.path.join(self.folder, "large.txt"), "w") as file:
            file.write("1 1\n0 312\n1 0\n99800 279 0.5 0.5\n")
        text = "1\n" + NEW1.format(**{**PLAIN1, "iteration": "200 100 30 10 1e-5"}).replace("0022033", "0029033").replace(
            "0.28 0.28", "'large.txt'\n0.28 0.28") + "0\n"
        self.refused(text, "99800 by 279 elements with 1 matrices needs too many coefficients; accepted are 5e8")

    def test_solvers(self):
        """G selects the solver of steady rolling in both modules with --classical, and is reported without; G = 1 keeps it"""
        chosen = ((0, "", "Newton-Krylov"), (2, "\n0.9 1 0 0.5", "ConvexGS"), (3, "\n0.9 1 0 0.5", "SteadyGS"),
                  (4, "\n0 0.5", "Newton-Krylov"),
                  (5, "\n1.0 0.5 2 1.5 0.01 2.5 1.2 1.3", "GDsteady"))
        for module, new, plain, kept in (("3", NEW3, PLAIN3, KEPT3), ("1", NEW1, PLAIN1, KEPT1)):
            for digit, settings, solver in chosen:
                case = new.format(**{**plain, "third": f"0{digit}00201", "iteration": "200 100 30 1 1e-5" + settings,
                                     **({"side": "1.0"} if module == "1" else {})})
                if module == "1":
                    case = case.replace("0000201", f"0{digit}00201")
                text = f"{module}\n{case}{module}\n{kept}0\n"
                _, _, records = self.run_text(text, "2", "--classical")
                found = [record["patches"][0]["solver"] for record in records]
                self.assertEqual([one["tangential_method"] for one in found], [solver, solver], (module, digit))
                self.assertFalse([one for one in found if "tangential_asked" in one])
                _, out, records = self.run_text(text)
                found = [record["patches"][0]["solver"] for record in records]
                self.assertEqual([one["tangential_method"] for one in found], ["Newton-Krylov"]*2, (module, digit))
                self.assertEqual([one.get("tangential_asked", "Newton-Krylov") for one in found], [solver, solver], (module, digit))
                self.assertLessEqual(max(one["tangential_residual"] for one in found), 1e-5)
                self.assertEqual(out.count(f"Newton-Krylov instead of {solver};"), 2*(solver != "Newton-Krylov"), (module, digit))

    def test_backslashes_in_names_of_profiles(self):
        """Names in various notations, with folders, absolute and relative"""
        text = "1\n" + NEW1.format(**PLAIN1) + "0\n"
        os.mkdir(os.path.join(self.folder, "sub"))
        for name in (os.path.join(PROFILES, "60E1.prr"), "./60E1.prr", "sub/../60E1.prr"):
            for written in (name, name.replace("/", "\\")):
                run, _, records = self.run_text(text.replace("60E1.prr", written))
                self.assertEqual(run.returncode, 0, (written, run.stderr))
                self.assertEqual(records[0]["status"], "solved")

    def test_lists_of_another_grid(self):
        """One value per element remains with the elements for which it was given, when the window changes in either direction"""
        def window(mx=6, my=5, x=-0.85, y=-1.0, dx=0.3, dy=0.4):
            # by the centre of the first element, which stays where sizes change
            return f"{mx} {my} {x - 0.5*dx:.6g} {y - 0.5*dy:.6g} {dx} {dy}"

        first = ("3\n203100\n002202{e}\n0000201\n200 100 30 1 1e-5\n9 0.002 0 0\n0.4 0.4\n0 0.3 1000\n0.28 0.28 200 200\n1\n"
                 + window() + "\n{shape}\n{slip}").format
        second = "3\n203100\n01210{z}{e}\n0000201\n200 100 30 1 1e-5\n9 0.002 0 0\n1\n{window}\n{shape}0\n".format
        plain, numbers = "1 1\n0.01 0 0.01 0 0 0\n", " ".join(["0.01"]*30) + "\n"
        slips = " ".join(["1e-4 0"]*30) + "\n"
        for first_case, kept, words in (
                (first(e=9, shape=plain.strip(), slip=slips), dict(z=2, e=1, shape=plain), "E = 1 keeps the extra rigid"),
                (first(e=0, shape="9 1\n" + numbers.strip(), slip=""), dict(z=1, e=0, shape=""), "IBASE = 9, one per element")):
            for change in (dict(mx=7), dict(mx=5), dict(my=6), dict(my=4), dict(dx=0.33), dict(dx=0.27), dict(dy=0.44),
                           dict(dy=0.36), dict(x=-0.75), dict(x=-0.95), dict(y=-0.9), dict(y=-1.2), {}):
                text = second(window=window(**change), **kept)
                run, out, _ = self.run_text(first_case + text, "3")
                if change:
                    self.assertEqual(run.returncode, 1, change)
                    self.assertIn(words, run.stderr, change)
                else:
                    self.assertEqual(run.returncode, 0, run.stderr + out)

    def test_output_digits_of_stresses(self):
        text = self.case3(pbtnfs="203103").replace("0.01 0 0.01 0 0 0\n", "0.01 0 0.01 0 0 0\n{}\n1\n1 0 1\n0\n")
        self.refused(text.format("3 0"), "MATFIL_S = 3 is outside its range 0 to 2")
        self.refused(text.format("0 5"), "OUTPUT_S = 5 is outside its range 0 to 4")

    def test_window_that_leaves_the_contact(self):
        """Tractions that are continued must be in the new window; with P = 2 they are not continued"""
        text = self.case3(pbtnfs="201100", rolling="").replace("1000\n\n", "1000\n").replace("\n\n", "\n")[:-2]
        moved = NEW3.format(**{**PLAIN3, "pbtnfs": "{p}01100", "rolling": "", "mx": "10"}).replace("\n\n", "\n")
        # the right half of the first window
        moved = moved.replace("10 20 -1 -1", "10 20 0 -1")
        for p in "01":
            self.refused(text + "3\n" + moved.format(p=p) + "0\n", "leaves out", "elements that were in contact", "P = 2",
                         modes=("2",))
        run, _, _ = self.run_text(text + "3\n" + moved.format(p="2") + "0\n")
        self.assertEqual(run.returncode, 0, run.stderr)
        run, _out, _ = self.run_text(text + "3\n" + moved.replace("10 20 0 -1", "30 20 -1 -1").format(p="0") + "0\n")
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_distances_that_nothing_can_be_added_to(self):
        """An approach that vanishes compared to distances of 1e9 mm once gave NaN: the load is carried, and the next case is
        correct"""
        viscous = ("203120\n0022120\n0000301\n50 50 20 5 1e-5\n1e-15 0.5 -0.6 -0.0001\n1e-06 1e-06\n0 0.00129981 1e-09\n"
                   "0.5 0.5 1.34976e+14 82000\n1 1 494063 75.379\n1\n1 11 -0.155375 -0.642326 0.310751 0.116787\n1 1\n"
                   "0.645908 0 1e-12 1.40772e-05 0 -1e+09\n")
        run, out, records = self.run_text("3\n" + viscous + "3\n" + NEW3.format(**PLAIN3) + "0\n")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertNotRegex(out.replace("RESIDUAL", ""), r"\bNaN\b")
        self.assertAlmostEqual(records[0]["patches"][0]["totals"]["fn"]["value"], 1e-15, delta=1e-27)
        self.assertEqual(records[0]["patches"][0]["totals"]["ncon"], 1)
        _alone, _, expected = self.run_text("3\n" + NEW3.format(**PLAIN3) + "0\n")
        self.assertEqual(len(expected[-1]["patches"]), 1)
        self.assertEqual(records[-1]["patches"], expected[-1]["patches"])


class Words(Doors):
    """Messages about replaced and missing values"""

    def test_text_below_the_end(self):
        run, out, _ = self.run_text("3\n" + NEW3.format(**PLAIN3) + "0 MODULE\n\n% a comment\n")
        self.assertNotIn("WARNING", out)
        run, out, _ = self.run_text("3\n" + NEW3.format(**PLAIN3) + "0 MODULE\n3\n" + KEPT3 + "0\n")
        self.assertIn("MODULE = 0 ends the input; text below it is not read", out)
        self.assertEqual(run.returncode, 0)

    def test_gauge_point_below_the_profile(self):
        text = "1\n" + NEW1.format(**PLAIN1) + "0\n"
        self.assertNotIn("gauge end", self.run_text(text)[1])
        self.assertIn("its gauge end is used as the gauge point",
                      self.run_text(text.replace("14 0 1435 0\n", "150 0 1435 0\n"))[1])

    def test_gauge_point_below_one_end(self):
        """A profile that ends above the gauge point on the gauge side only; the depth in a later case; the cant"""
        with open(os.path.join(self.folder, "60E1.prr")) as file:
            profile = file.read()
        os.unlink(os.path.join(self.folder, "60E1.prr"))
        with open(os.path.join(self.folder, "60E1.prr"), "w") as file:
            file.write(profile.replace("  point.begin", "  bound.y.min = -34.\n  bound.y.max = 60.\n  point.begin"))
        text, kept = NEW1.format(**PLAIN1), KEPT1.replace("0111002", "0111012").replace("\n0 0.5", "\n14 0 1435 0\n0 0.5")
        points = [tuple(map(float, line.split())) for line in re.findall(r"^ +-?\d+\.\d+ +-?\d+\.\d+$", profile, re.MULTILINE)]
        depth = next(z for y, z in points if y >= -34.0) - min(z for _, z in points)
        warning = "ends %.7g mm below its top on the gauge side: its gauge end is used as the gauge point" % depth
        self.assertIn(warning, self.run_text("1\n" + text + "0\n")[1])
        text = text.replace("14 0 1435 0\n", "6 0 1435 0\n")
        self.assertNotIn("gauge end", self.run_text("1\n" + text + "0\n")[1])
        for mode in ("2", "3"):
            run, out, _ = self.run_text("1\n" + text + "1\n" + kept + "0\n", mode)
            self.assertIn(warning, out + run.stdout)
        # canted by 0.1 rad, the end is 34 mm times 0.1 higher: above the top of a rail that leans inwards
        self.assertIn("gauge end", self.run_text("1\n" + text.replace("6 0 1435 0\n", "6 0 1435 -0.1\n") + "0\n")[1])

    def test_tape_line_beside_the_wheel(self):
        """NOMRADW at a point where the wheel has no surface was that of the end of its profile"""
        for tape in (500, 61, -71, -998):
            for mode in ("2", "3"):
                text = "1\n" + NEW1.format(**PLAIN1).replace("1360 -70 460\n", "1360 -70 460 %d\n" % tape) + "0\n"
                run, out, _ = self.run_text(text, mode)
                self.assertIn("YTAPE = %d mm is beside the wheel profile, which extends from y = -70 to 60 mm" % tape,
                              out + run.stdout + run.stderr)
                self.assertEqual(run.returncode, 1)
        for tape in (999, 60, -70):
            text = "1\n" + NEW1.format(**PLAIN1).replace("1360 -70 460\n", "1360 -70 460 %d\n" % tape) + "0\n"
            self.assertNotIn("YTAPE", self.run_text(text)[0].stderr)

    def test_no_results(self):
        run, out, _ = self.run_text("3\n" + NEW3.format(**{**PLAIN3, "third": "0000001"}) + "0\n")
        self.assertNotIn("No results were requested", out)
        with open(os.path.join(self.folder, "y.inp"), "w") as file:
            file.write("3\n" + NEW3.format(**{**PLAIN3, "third": "0000001"}) + "0\n")
        run = subprocess.run([PROGRAM, "2", "y"], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertIn("No results were requested", run.stdout)

    def test_largest_number_of_elements(self):
        """Elements that are doubled for NPOT_MAX are reported; a replaced number too"""
        text = "1\n" + NEW1.format(**{**PLAIN1, "iteration": "200 100 30 1 1e-5 200", "side": "0.1"}) + "0\n"
        run, out, _ = self.run_text(text)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("instead of DX x DS = 0.1 x 0.1 mm, because there are at most NPOT_MAX = 200", out)
        run, out, _ = self.run_text(text.replace(" 200\n", " 50\n"))
        self.assertIn("NPOT_MAX = 50 is replaced by 100", out)
        run, out, _ = self.run_text("1\n" + NEW1.format(**PLAIN1) + "0\n")
        self.assertNotIn("NPOT_MAX", out)

    def test_step_of_hertzian_rolling(self):
        """DX of a Hertzian grid is not known beforehand: a different DQ gives no warning"""
        hertz = ("203100\n022020\n0000201\n200 100 30 1 1e-5\n9 0.002 0 0\n0.4 0.4\n0 0.5 1000\n0.28 0.28 200 200\n-1\n"
                 "15 15 0.01 0.01 1.2\n")
        _, out, _ = self.run_text("3\n" + hertz + "0\n")
        self.assertNotIn("Warning", out)
        _run, out, _ = self.run_text("3\n" + NEW3.format(**{**PLAIN3, "rolling": "0 0.5 1000"}) + "0\n")
        self.assertIn("DQ is set to DX", out)


if __name__ == "__main__":
    unittest.main(verbosity=1)
