#!/usr/bin/env python3
"""The readable format: conversion in both directions, results, error messages with positions, explain

The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
EXAMPLES = pathlib.Path(os.environ["CONTACT_SOURCE"]) / "examples"
# run in all three forms; the others are converted only
QUICK = ("cattaneo", "catt_to_cart", "approximate", "spence35", "sliding_temperature", "manchester", "roller_rig")
HEAD = '[[case]]\nmodule = "contact"\nmotion = "shift"\nnormal = "force"\n'
REST = ('[case.kinematics]\nfn = 1000\ncksi = 0.001\n[case.friction]\nfstat = 0.3\n[case.material]\npoiss = [0.28, 0.28]\n'
        'gg = ["82 GPa", 82000]\n[case.grid]\nform = "hertz_axes"\nmx = 11\nmy = 11\naa = "3 mm"\nbb = 0.3e1\nscale = 1.2\n')


def figures(path):
    """A report without lines that differ between runs: times, names, warnings about the input, and those digits of its echo that
    say R, and whether solvers (G) and velocities (E) were given again with the values they had"""
    return [re.sub(r"(RETURN|GAUSEI|EWHEEL) +\d", r"\1", line) for line in path.read_text(errors="replace").split("\n")
            if not re.search(r"^\||Input: WARNING|CONTACT|suffix|seconds| ended |There are|started", line)]


def words(text):
    """An explanation without positions, warnings, and seconds, in which the measured speed of the machine appears"""
    return re.sub(r"line \d+|\.inp|\.toml|.*Input: WARNING.*\n|[-+.0-9E]+ s\b", "", text)


class Readable(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def run_program(self, *words):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, timeout=120)
        return done.returncode, done.stdout, done.stderr

    def check(self, text):
        (self.folder / "a.toml").write_text(text)
        return self.run_program("3", "a.toml")

    def complaints(self, text):
        status, _, errors = self.check(text)
        self.assertEqual(status, 1, errors)
        return errors

    def test_examples_are_current(self):
        shutil.copytree(EXAMPLES, self.folder, dirs_exist_ok=True, ignore=shutil.ignore_patterns("*.out", "*.toml", "figures"))
        names = sorted(path.stem for path in EXAMPLES.glob("*.inp"))
        self.assertGreater(len(names), 20)
        for name in names:
            status, _, errors = self.run_program("convert", name + ".inp")
            self.assertEqual(status, 0, errors)
            new = (self.folder / (name + ".toml")).read_text()
            self.assertEqual(new, (EXAMPLES / (name + ".toml")).read_text(),
                             f"{name}.toml is not current: contact convert --force {name}.inp")
            (self.folder / "back.toml").write_text(new)
            status, _, errors = self.run_program("convert", "--force", "back.toml")
            self.assertEqual(status, 0, errors)
            status, _, errors = self.run_program("convert", "--force", "back.inp")
            self.assertEqual(status, 0, errors)
            self.assertEqual((self.folder / "back.toml").read_text(), new, name + ": there and back")

    def test_results_are_the_same(self):
        shutil.copytree(EXAMPLES, self.folder, dirs_exist_ok=True, ignore=shutil.ignore_patterns("*.out", "figures"))
        for name in QUICK:
            (self.folder / "other.toml").write_text((EXAMPLES / (name + ".toml")).read_text())
            self.assertEqual(self.run_program("convert", "--force", "other.toml")[0], 0)
            self.assertEqual(self.run_program("2", name + ".inp", "--quiet")[0], 0)
            right = figures(self.folder / (name + ".out"))
            for other in (name + ".toml", "other.inp"):
                status, _, errors = self.run_program("2", other, "--quiet")
                self.assertEqual(status, 0, errors)
                self.assertEqual(figures((self.folder / other).with_suffix(".out")), right, other)

    def test_tables_without_keys(self):
        """Converted files have no empty tables of groups that are kept without them"""
        for path in sorted(EXAMPLES.glob("*.toml")):
            empty = set(re.findall(r"^\[case\.(\w+)\]\n(?=\n|$)", path.read_text(), re.MULTILINE))
            self.assertFalse(empty & {"iteration", "kinematics", "velocity"}, path.name)

    def test_converted_into_another_folder(self):
        """Names of files are relative to an input; conversion into another folder warns, if there are any"""
        (self.folder / "other").mkdir()
        for name, warns in (("wheel_on_rail", True), ("cattaneo", False)):
            said = self.run_program("convert", "--output-dir", str(self.folder / "other"), str(EXAMPLES / (name + ".inp")))
            self.assertEqual("copy them there" in "".join(said[1:]), warns, said)

    def test_what_ends(self):
        """Temperatures, damping and wear of a case can end in the next one, in both formats and by conversion"""
        text = (HEAD.replace('"shift"', '"steady_rolling"') + 'output_level = 2\n' + REST +
                '[case.rolling]\ndq = 0.6\nveloc = 20000\n'
                '[case.heat]\nbktemp = [20, 20]\nheatcp = [450, 450]\nlambda = [0.05, 0.05]\ndens = [7.85e-6, 7.85e-6]\n'
                '[case.damping]\ncdampn = 1e-3\ncdampt = 1e-3\ndfnmax = 1e6\ndftmax = 1e6\n[case.wear]\n')
        ends = "".join('[case.%s]\nmodel = "none"\n' % group for group in ("heat", "damping", "wear"))
        (self.folder / "ends.toml").write_text(text + "[[case]]\n[[case]]\n" + ends)
        expected = None
        for step in ("ends.toml", "ends.inp", "again.toml"):
            if step == "again.toml":
                shutil.move(self.folder / "ends.inp", self.folder / "again.inp")
            if step != "ends.toml":
                status, _, errors = self.run_program("convert", ("ends.toml" if step == "ends.inp" else "again.inp"))
                self.assertEqual(status, 0, errors)
            status, _, errors = self.run_program("--json", "--quiet", "--order", "2", "2", step)
            self.assertEqual(status, 0, errors)
            lines = (self.folder / step).with_suffix(".jsonl").read_text().splitlines()[:3]
            totals = [json.loads(line)["patches"][0]["totals"] for line in lines]
            self.assertEqual(["max_temp1" in found for found in totals], [True, True, False], step)
            printed = (self.folder / step).with_suffix(".out").read_text().split(" Case ")[1:]
            self.assertEqual(["MAX(T1,T2)" in case for case in printed], [True, True, False], step)
            forces = [found["fx"]["value"] for found in totals]
            expected = expected or forces
            self.assertEqual(forces, expected, step)
        errors = self.complaints(text + '[[case]]\n[case.heat]\nmodel = "none"\nbktemp = [20, 20]\n')
        self.assertIn('unknown key "bktemp", or one without meaning in this case; accepted: ', errors)

    def test_motion_that_changes(self):
        """Direction, step and velocity of rolling are kept through cases without it; creepages are not kept as shifts"""
        law = 'law = "rational"\nfkin = 0.2\nfrat1 = 0.2\nsabsh1 = 20\nfrat2 = 0\nsabsh2 = 1\n'
        rolling = HEAD.replace("shift", "steady_rolling") + REST.replace("fstat = 0.3\n", law)
        rolling += '[case.rolling]\ndq = 0.6\nveloc = 20000\n'
        shift, ceta = '[[case]]\nmotion = "shift"\n', "[case.kinematics]\nceta = 0\n"
        again = '[[case]]\nmotion = "steady_rolling"\n[case.kinematics]\ncksi = 0.001\n'
        for between in ('motion = "none"\n', 'motion = "shift"\n[case.kinematics]\ncksi = 0.01\n'):
            text = rolling + "[[case]]\n" + between + again
            (self.folder / "a.toml").write_text(text)
            powers = []
            for step in ("a.toml", "a.inp", "b.toml"):
                if step == "a.inp":
                    self.assertEqual(self.run_program("convert", "--force", "a.toml")[0], 0)
                elif step == "b.toml":
                    shutil.move(self.folder / "a.inp", self.folder / "b.inp")
                    self.assertEqual(self.run_program("convert", "--force", "b.inp")[0], 0)
                status, _, errors = self.run_program("--json", "--quiet", "--order", "2", "2", step)
                self.assertEqual(status, 0, errors)
                lines = (self.folder / step).with_suffix(".jsonl").read_text().splitlines()[:3]
                totals = [json.loads(line)["patches"][0]["totals"] for line in lines]
                powers += [totals[0]["friction_power"]["value"], totals[2]["friction_power"]["value"]]
            # the iteration of friction ends within 1e-3
            for power in powers[1:]:
                self.assertAlmostEqual(power/powers[0], 1, 2, powers)
            self.assertLess(powers[0], -1)
        # never given
        errors = self.complaints(HEAD + REST + '[[case]]\nmotion = "steady_rolling"\n[case.kinematics]\ncksi = 0.001\n')
        self.assertIn("dq is missing", errors)
        for text, kept in ((rolling + shift, "rolling"), (rolling + '[[case]]\nmotion = "none"\n' + shift + ceta, "rolling"),
                           (HEAD + REST + '[[case]]\nmotion = "steady_rolling"\n[case.rolling]\ndq = 1\nveloc = 1\n', "a shift")):
            self.assertIn(f"cksi = 0.001 is kept from {kept}, but", self.complaints(text))
        self.assertEqual(self.check(rolling + '[[case]]\nmotion = "transient_rolling"\n')[0], 0)
        # an input file that keeps what a shift has reset has the same values in the readable format
        inp = ("3\n203100\n0022020\n0000201\n200 100 30 1 1e-6\n1000 0.001 0 0\n0.3 0.3\n0 0.6 20000\n0.28 0.28 82000 82000\n"
               "-3\n11 11 3 3 1.2\n3\n201100\n0101000\n0000201\n200 100 30 1 1e-6\n1000 0.01 0 0\n"
               "3\n202100\n0101000\n0000201\n200 100 30 1 1e-6\n1000 0.01 0 0\n0\n")
        (self.folder / "c.inp").write_text(inp)
        self.assertEqual(self.run_program("convert", "c.inp")[0], 0)
        shutil.move(self.folder / "c.toml", self.folder / "d.toml")
        found = []
        for name in ("c", "d"):
            self.assertEqual(self.run_program("--json", "--quiet", "2", name)[0], 0)
            lines = (self.folder / (name + ".jsonl")).read_text().splitlines()[:3]
            found.append([json.loads(line)["patches"][0]["totals"] for line in lines])
        self.assertEqual(*found)

    def test_what_returns(self):
        """Choices that end and return with the numbers in store: E, H and S digits of both modules, all ways through 0 and 1"""
        first3 = ("203103\n0022029 2\n3002201\n200 100 30 1 1e-6\n1000 0.01 0 0\n0.3 0.3\n0 1 20000\n0.28 0.28 82000 82000\n"
                  "1e-4 1e-4 1e9 1e9\n20 450 0.05 7.85e-6\n40 450 0.05 7.85e-6\n-3\n4 4 2 2 1.2\n" + 16*"1e-3 0\n"
                  + "2 1\n1\n2 0.5 0.5\n0\n")
        first1 = ("1203103\n0022035 2\n3002201\n200 100 30 1 1e-6\n0.3 0.3\n0.28 0.28 82000 82000\n1e-4 1e-4 1e9 1e9\n"
                  "20 450 0.05 7.85e-6\n40 450 0.05 7.85e-6\n1 1 1 90d 8 4\n14 0 1435 0\n'60E1.prr' 0 1 0\n0 0 0 0 0 0\n"
                  "1360 -70 460\n'S1002.prw' 0 1 0\n0 0 50e3 0 0 0\n2000 0 0 0 0 -4.3\n0 0.1 0 0 0 0\n0 0 0 0 0 0\n"
                  "2 1\n1\n2 0.5 0.5\n0\n")
        for name in ("60E1.prr", "S1002.prw"):
            shutil.copy(EXAMPLES / "profiles" / name, self.folder)
        for module, first in ((3, first3), (1, first1)):
            text = f"{module} MODULE\n" + first
            for e, m2, h, s in ((0, 1, 1, 1), (0, 0, 0, 0), (1, 1, 1, 1), (0, 1, 1, 0), (1, 1, 0, 1), (0, 0, 1, 1), (0, 1, 0, 0)):
                text += f"{module} MODULE\n"
                text += f"{'1' if module == 1 else ''}20310{s}\n010000{e if module == 3 else 0} {m2}\n{h}102201\n"
                text += "1000 0.01 0 0\n" if module == 3 else ""
            (self.folder / "a.inp").write_text(text + "0\n")
            found = []
            for name in ("a.inp", "a.toml", "a.inp"):
                status, _, errors = self.run_program("--quiet", "--json", "2", name)
                self.assertEqual(status, 0, errors)
                cases = [json.loads(line) for line in (self.folder / "a.jsonl").read_text().splitlines()][:-1]
                found.append([[(patch["effects"], patch["totals"]) for patch in case["patches"]] for case in cases])
                self.assertEqual(len(cases), 8)
                files = sorted(path.name for path in self.folder.glob("a.*.subs"))
                self.assertGreater(len(files), 4)
                found[-1].append(files)
                for path in self.folder.glob("a.*.subs"):
                    path.unlink()
                self.assertEqual(self.run_program("convert", "--force", name)[0], 0)
            heat = ["surface temperatures" in case[0][0] for case in found[0][:-1]]
            self.assertEqual(heat, [True, True, False, True, True, False, True, False])
            self.assertEqual(found[0], found[1], f"module {module}, readable")
            self.assertEqual(found[0], found[2], f"module {module}, and back")

    def test_names_with_all_letters(self):
        """A name of a file survives both conversions, with quotes, marks of comments and separators in it"""
        folder = "driver's wheels, 50% \"a=b\" ''"
        shutil.copytree(EXAMPLES / "profiles", self.folder / folder)
        text = (EXAMPLES / "manchester.toml").read_text().replace("profiles/", folder.replace('"', '\\"') + "/")
        for name in ("names.toml", "back.toml"):
            (self.folder / name).write_text(text)
        for name in ("back.toml", "back.inp"):
            self.assertEqual(self.run_program("convert", "--force", name)[::2], (0, ""))
            self.assertEqual(self.run_program("3", "back.inp")[::2], (0, ""))
        self.assertEqual((self.folder / "back.toml").read_text(), text)

    def test_numbers_of_all_lengths(self):
        """Lists of the longest numbers, negative with seventeen digits, are the same bits after both conversions"""
        rest = REST[:REST.index("[case.grid]")]
        for count in (1, 2, 4, 6, 7, 8, 9, 14):
            values = [-(k + 1) * 0.00012345678901234567 * 10.0**(-k % 5) for k in range(count)]
            self.assertEqual(max(len(f"{value:.16e}") for value in values), 23)
            text = (HEAD + rest + f'[case.grid]\nform = "corner_and_sides"\nmx = {count}\nmy = 1\nxl = -0.1\nyl = -0.1\ndx = 0.1\n'
                    + f'dy = 0.1\n[case.geometry]\nform = "elementwise"\nplanform = "unrestricted"\nh = {values}\n')
            (self.folder / "list.toml").write_text(text)
            for name in ("list.toml", "list.inp"):
                self.assertEqual(self.run_program("convert", "--force", name)[::2], (0, ""))
            told = re.search(r"\nh = \[([^]]*)\]", (self.folder / "list.toml").read_text())[1]
            self.assertEqual([float(word) for word in told.split(",")], values)

    def test_spin_centre_with_a_zero(self):
        """A coordinate of zero is left out of converted files, and is zero when they are read; both were set to zero"""
        forces = {}
        for x, y in (0.0, 0.0), (0.7, 0.0), (0.0, 0.7), (0.7, 0.7):
            (self.folder / "a.inp").write_text(f"""3 MODULE
                203100 PBTNFS
                022020 LDCMZE
                0000101 HGIAOWR
                999 100 30 1 1e-6
                1000 0.001 0 0.002 {x} {y} FN CKSI CETA CPHI SPINXO SPINYO
                0.3 0.3
                0d 0.3 1000
                0.28 0.28 82000 82000
                -3
                12 12 3 3 1.2
                0 END""")
            self.assertEqual(self.run_program("2", "a", "--quiet", "--json")[::2], (0, ""))
            told = (self.folder / "a.jsonl").read_text()
            self.assertEqual(self.run_program("convert", "--force", "a.inp")[::2], (0, ""))
            status, _, errors = self.run_program("2", "a.toml", "--quiet", "--json")
            self.assertEqual((status, errors), (0, ""))
            again = (self.folder / "a.jsonl").read_text()
            found = [json.loads(text.split("\n")[0])["patches"][0]["totals"] for text in (told, again)]
            self.assertEqual(found[0], found[1], (x, y))
            forces[x, y] = found[0]["fx"]["value"], found[0]["fy"]["value"]
        self.assertEqual(len(set(forces.values())), 4, forces)

    def test_a_case_by_hand(self):
        status, out, errors = self.check("# a ball\n" + HEAD + REST + "[[case]]\n[case.kinematics]\ncksi = 0.002\n")
        self.assertEqual((status, errors), (0, ""), out)
        self.assertIn("2 cases checked", out)
        self.assertEqual(self.run_program("2", "a", "--quiet", "--json", "--confine")[0], 0)
        forces = re.findall(r'"fn":{"value":([0-9.]+)', (self.folder / "a.jsonl").read_text())
        self.assertEqual({round(float(force)) for force in forces}, {1000})

    def test_errors_of_some_cases(self):
        """errors = true applies from its case on, as --errors does to all; conversion keeps it as far as possible"""
        case = "[[case]]\n{}[case.kinematics]\ncksi = 0.002\n"
        text = HEAD + REST + case.format("errors = true\n") + case.format("") + case.format("errors = false\n")
        self.assertEqual(self.check(text)[0], 0)
        self.assertEqual(self.run_program("2", "a", "--quiet", "--json")[0], 0)
        records = [json.loads(line) for line in (self.folder / "a.jsonl").read_text().splitlines()]
        groups = [record["patches"][0].get("errors") for record in records if record.get("patches")]
        self.assertEqual([group is not None for group in groups], [False, True, True, False])
        self.assertGreater(groups[1]["fx_error"]["value"], 0.0)
        self.assertIn("Errors of the totals are estimated.", self.run_program("explain", "a.toml")[1])
        converted = "".join(self.run_program("convert", "a.toml")[1:])
        self.assertEqual(converted.count("needs --errors"), 1, converted)
        remarks = (self.folder / "a.inp").read_text(encoding="utf-8").count("% needs --errors")
        self.assertEqual(remarks, 2, "each case has a remark of its own")
        self.assertIn("errors must be true or false", self.complaints(HEAD + REST + case.format("errors = 1\n")))

    def test_places_and_nearest_words(self):
        errors = self.complaints(HEAD.replace("shift", "shfit") + REST)
        self.assertIn('a.toml:3:10: unknown motion "shfit"; did you mean "shift"? Accepted: "none", ', errors)
        errors = self.complaints(HEAD + REST.replace("fstat", "fsat"))
        self.assertIn('a.toml:9:1: unknown key "fsat"; did you mean "fstat"?', errors)
        self.assertIn("a.toml:8:1: fstat is missing: static coefficient of friction; it belongs under [case.friction]", errors)
        errors = self.complaints(HEAD + REST.replace("[case.material]", "[case.material]\ngg3 = 1.0"))
        self.assertIn('"gg3" has no meaning in this case, whose choices do not use it; did you mean "gg', errors)
        errors = self.complaints(HEAD + REST.replace("[case.material]", "[case.materials]"))
        self.assertIn('unknown key "materials"; did you mean "material"?', errors)
        self.assertIn("gg1 is missing: modulus of rigidity [N/mm2]", errors)
        errors = self.complaints(HEAD + REST.replace("hertz_axes", "hertz_axis"))
        self.assertIn('a.toml:14:8: unknown form "hertz_axis"; did you mean "hertz_axes"?', errors)
        errors = self.complaints(HEAD + REST.replace("hertz_axes", "heptagon"))
        self.assertIn('unknown form "heptagon"; accepted: "', errors)
        errors = self.complaints(HEAD + REST.replace("[case.friction]", '[case.friction]\nlaw = " "'))
        self.assertIn('unknown law ""; accepted: "coulomb"', errors)
        errors = self.complaints("[case]\nx = 1\n")
        self.assertIn("a.toml:1:1: case is a table; each case begins with [[case]], in double brackets", errors)
        errors = self.complaints(HEAD + REST + "[cas.grid]\n")
        self.assertIn('"cas" is outside of a case; did you mean "case"?', errors)
        errors = self.complaints(HEAD + REST + "[case.springs]\n")
        self.assertIn('"springs" has no meaning in this case', errors)
        self.assertIn('the first case must give: motion', self.complaints('[[case]]\nmodule = 3\nnormal = "force"\n' + REST))
        self.assertIn("the first case must have the key module", self.complaints("[[case]]\n" + REST))
        # after an invalid case the next ones can still keep values
        errors = self.complaints('[[case]]\nmodule = "wheel_rail"\nmotion = "x"\n[[case]]\n[case.position]\nfz = 1\n[[case]]\n')
        self.assertIn('unknown motion "x"; accepted: "', errors)

    def test_values(self):
        self.assertIn('a.toml:6:6: fn = "10 mm" has the unit "mm", expected is N', self.complaints(
            HEAD + REST.replace("fn = 1000", 'fn = "10 mm"')))
        self.assertIn("a.toml:6:6: fn = -5 is below its lower bound 0 N", self.complaints(HEAD + REST.replace("1000", "-5")))
        self.assertIn("mx = 11.5 must be an integer", self.complaints(HEAD + REST.replace("mx = 11", "mx = 11.5")))
        self.assertIn("fstat = (an array) must be a number", self.complaints(HEAD + REST.replace("fstat = 0.3", "fstat = [1]")))
        self.assertIn("poiss must be an array of two values", self.complaints(HEAD + REST.replace("[0.28, 0.28]", "[0.28]")))
        self.assertIn('"fn" is given twice; it was given in line 6', self.complaints(HEAD + REST.replace("cksi", "fn")))
        # the bounds and rules of the established format, in the words of this one
        errors = self.complaints(HEAD.replace("motion", 'material_model = "viscoelastic"\nmotion') + REST.replace(
            "[case.grid]", "fg = [1, 1]\ntc = [1, 1]\n[case.grid]"))
        self.assertIn('a.toml:3:18: material_model = "viscoelastic", ', errors)
        self.assertIn('motion = "steady_rolling", not motion = "shift"', errors)

    def test_units_follow_the_motion(self):
        """In shifts creepages and velocities are distances and rotations; their units are checked for the motion of the case"""
        rolls = HEAD.replace("shift", "steady_rolling") + REST + "[case.rolling]\ndq = 0.6\nveloc = 1000\n"
        for text, key, good, bad, expected in (
                (rolls, "cksi", "0.1 %", "0.001 mm", "a plain number"), (HEAD + REST, "cksi", "1 um", "0.1 %", "mm"),
                (rolls, "cphi", "1 deg/m", "1 mrad", "rad/mm"), (HEAD + REST, "cphi", "1 deg", "1 mrad/mm", "rad")):
            given = text.replace("cksi = 0.001", f'{key} = "{bad}"')
            self.assertIn(f", expected is {expected} or a unit", self.complaints(given))
            self.assertEqual(self.check(given.replace(bad, good))[0], 0, good)
        # either unit without motion, for the cases that follow
        for value in ("1 um", "0.1 %"):
            self.assertEqual(self.check((HEAD + REST).replace('"shift"', '"none"').replace("0.001", f'"{value}"'))[0], 0, value)
        list_of_slip = '[case.extra_slip]\nexrhs = [' + 121*'["1 um", 0], ' + "]\n"
        self.assertEqual(self.check(HEAD + REST + list_of_slip)[0], 0)
        self.assertIn("expected is a plain number", self.complaints(rolls + list_of_slip))
        # a wheel on a rail
        shutil.copytree(EXAMPLES / "profiles", self.folder / "profiles")
        pair = "[[case]]".join((EXAMPLES / "single_wheel.toml").read_text().split("[[case]]")[:2])
        for moves, good, bad, expected in (("transient_rolling", "1 m/s", "1 mm", "mm/s"), ("shift", "1 um", "1 mm/s", "mm")):
            turn = ("1 deg/s", "1 mrad", "rad/s") if moves != "shift" else ("1 mrad", "1 deg/s", "rad")
            for key, values in (("vs", (good, bad, expected)), ("vyaw", turn)):
                text = re.sub('motion = "[a-z_]*"', f'motion = "{moves}"', pair)
                text = re.sub(rf"(?m)^{key} = .*\n", "", text)
                text = text.replace("[case.velocity]\n", f'[case.velocity]\n{key} = "{values[1]}"\n')
                self.assertIn(f", expected is {values[2]} or a unit", self.complaints(text))
                self.assertEqual(self.check(text.replace(f'"{values[1]}"', f'"{values[0]}"'))[0], 0, values)

    def test_choices_in_messages_of_a_computation(self):
        """Messages use words for inputs with words, digits for inputs with digits"""
        oblique = HEAD.replace("shift", "steady_rolling") + REST + '[case.rolling]\nchi = "90 deg"\ndq = 0.1\nveloc = 1000\n'
        self.assertIn('motion = "steady_rolling" with ConvexGS (iteration.solver = "convex_gs")', self.complaints(oblique))
        status, _, errors = self.run_program("convert", "a.toml")
        self.assertEqual(status, 0, errors)
        for mode in "3", "2":
            status, _, errors = self.run_program(mode, "a.inp")
            self.assertEqual(status, 1)
            self.assertIn("T = 2, or T = 3 with ConvexGS (G = 2)", errors)

    def test_which_file(self):
        (self.folder / "a.toml").write_text(HEAD + REST)
        status, out, errors = self.run_program("3", "a")
        self.assertEqual((status, errors), (0, ""))
        self.assertIn("a.toml: 1 case checked", out)
        self.assertEqual(self.run_program("convert", "a.toml")[0], 0)
        status, out, _ = self.run_program("3", "a")
        self.assertIn("There are a.inp and a.toml; a.inp is read", out)
        self.assertIn("a.inp: 1 case checked", out)
        self.assertIn("a.toml: 1 case checked", self.run_program("3", "a.toml")[1])
        before = (self.folder / "a.inp").read_bytes()
        status, _, errors = self.run_program("convert", "a.toml")
        self.assertEqual(status, 1)
        self.assertIn("a.inp: the file exists already; --force replaces it", errors)
        self.assertIn("the suffix must say", self.run_program("convert", "a")[2])
        (self.folder / "a.toml").write_text(HEAD)
        self.assertEqual(self.run_program("convert", "--force", "a.toml")[0], 1)
        self.assertEqual((self.folder / "a.inp").read_bytes(), before, "an unchanged file after a failure")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["a.inp", "a.toml"])

    def test_temperatures(self):
        text = HEAD.replace("shift", "steady_rolling") + REST + (
            "[case.rolling]\ndq = 1\nveloc = \"20 m/s\"\n[case.heat]\nbktemp = [0, 0]\nheatcp = [450, 450]\n"
            "lambda = [0.05, 0.05]\ndens = [\"7850 kg/m3\", 7.85e-6]\n")
        highest = {}
        for name, source in (("moving", ""), ("established", 'source = "established"\n')):
            (self.folder / (name + ".toml")).write_text(text + source)
            self.assertEqual(self.run_program("2", name, "--quiet", "--json")[0], 0)
            highest[name] = (self.folder / (name + ".jsonl")).read_text()
        highest = {name: re.findall(r'"max_temp1":[^,]*', text) for name, text in highest.items()}
        self.assertTrue(highest["moving"])
        self.assertNotEqual(highest["moving"], highest["established"])
        # the command line has precedence over the file
        self.assertEqual(self.run_program("2", "moving", "--quiet", "--json", "--heat", "established")[0], 0)
        self.assertEqual(re.findall(r'"max_temp1":[^,]*', (self.folder / "moving.jsonl").read_text()), highest["established"])
        status, _, errors = self.run_program("convert", "moving.toml")
        self.assertEqual(status, 0)
        self.assertIn("--heat moving-source", errors)

    def test_interrupted_run(self):
        text = HEAD + REST + "[[case]]\n[case.kinematics]\ncksi = 0.002\n"
        (self.folder / "a.toml").write_text(text + "[[case]]\nmotion = \"no\"\n")
        self.assertEqual(self.run_program("2", "a", "--quiet")[0], 1)
        (self.folder / "a.toml").write_text(text + "[[case]]\n[case.kinematics]\ncksi = 0.003\n")
        status, out, errors = self.run_program("2", "a", "--resume")
        self.assertEqual(status, 0, out + errors)
        self.assertIn("2 cases finished before", out)
        (self.folder / "b.toml").write_text((self.folder / "a.toml").read_text())
        self.assertEqual(self.run_program("2", "b", "--quiet")[0], 0)
        self.assertEqual([line for line in figures(self.folder / "a.out") if "ERROR" not in line and "run ends" not in line][-30:],
                         figures(self.folder / "b.out")[-30:])

    def test_explain(self):
        shutil.copytree(EXAMPLES, self.folder, dirs_exist_ok=True, ignore=shutil.ignore_patterns("*.out", "figures"))
        for name in sorted(path.name for path in EXAMPLES.glob("*.inp")):
            status, out, errors = self.run_program("explain", name)
            self.assertEqual((status, errors), (0, ""))
            self.assertIn("Motion: ", out)
            self.assertIn("Not simulated: inertia", out)
            self.assertIn("Expected on one thread: ", out)
            digits = re.findall(r"\b(?:C1|M2|[PBTNFSVLDCMZEHGIAOWR]) = \d|\bas \d", out)
            self.assertEqual(digits, [], name)
            # both formats give the same
            other = self.run_program("explain", name.replace(".inp", ".toml"))[1]
            self.assertEqual(words(out), words(other))

    def test_groups_of_all_cases(self):
        source = pathlib.Path(os.environ["CONTACT_SOURCE"]) / "src"
        visited = re.findall(r'open_group\("(\w+)"\)', (source / "cases/whole_case.f90").read_text())
        block = re.search(r"group_names\(\*\) = (.*?)\]", (source / "input/toml_case.f90").read_text(), re.DOTALL).group(1)
        self.assertEqual(set(visited), set(re.findall(r'"(\w+)"', block)))


if __name__ == "__main__":
    unittest.main()
