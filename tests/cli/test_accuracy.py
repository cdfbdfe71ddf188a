#!/usr/bin/env python3
"""A prescribed accuracy: choices, reports, cost, limits, refused cases

The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import json
import math
import os
import pathlib
import random
import re
import sys
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "accuracy"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from error_cases import contact, text_of, wheel_text
from test_order import Runs, rolling

WHEEL = {"dx": 0.4, "mu": 0.3, "cant": 0.025, "y": 0.0, "yaw": 0.0, "fz": 60000.0, "vs": 20000.0, "vpitch": -43.5}
#: Forms of the grid with the same window: mm, corner and sides, corners, centre and sides, centres
WINDOWS = ("1 IPOTCN\n20 20 -3.6 -6 0.36 0.6 MX MY XL YL DX DY", "2 IPOTCN\n20 20 -3.6 -6 3.6 6 MX MY XL YL XH YH",
           "3 IPOTCN\n20 20 -3.42 -5.7 0.36 0.6 MX MY XC1 YC1 DX DY", "4 IPOTCN\n20 20 -3.42 -5.7 3.42 5.7 MX MY XC1 YC1 XCM YCM")


class Accuracy(Runs):
    def solve(self, name, text, *options):
        """The report, and the record of the first case as a plain dictionary"""
        report, record = self.run_first(name, text, *options)
        return report, plain(record)

    def test_reached(self):
        """The error against a grid of 160 x 160 is below the prescribed accuracy; the chosen grid is reported, not that of the
        file"""
        _, fine = self.solve("fine.inp", rolling().replace("14 14", "160 160"), "--order", "2")
        fine = fine["patches"][0]["totals"]
        before = 0
        for required in (1e-2, 1e-3, 2e-4):
            with self.subTest(required):
                words, record = self.solve("a.inp", rolling(), "--accuracy", str(required))
                patch = record["patches"][0]
                accuracy, totals = patch["accuracy"], patch["totals"]
                self.assertTrue(accuracy["reached"])
                self.assertLessEqual(accuracy["estimated"], required)
                error = max(abs(totals[name] - fine[name]) for name in ("fx_rel", "fy_rel"))
                self.assertLess(max(error, abs(totals["pen"] / fine["pen"] - 1.0)), required)
                self.assertGreater(accuracy["mx"], before)
                before = accuracy["mx"]
                self.assertEqual((accuracy["order"], accuracy["eps"]), (2, min(1e-3, 0.1 * required)))
                self.assertIn("OF THE FORCES, REACHED\n", words)
                self.assertIn(f"elements {accuracy['mx']} x {accuracy['my']} of ", words)
                self.assertIn("_error", "".join(patch["errors"]))

    def test_slip_that_turns_round(self):
        """Rollers of aluminium and steel close to full sliding: FX depends on where slip reverses, which a single element
        determines

        The limit is that of 2400 and 4800 elements, at three positions of the grid each, within 3e-5.
        """
        limit, force = 0.05474, 1e-4 * 16201.9
        case = """3 MODULE
            203100 PBTNFS
            022020 LDCMZE
            0000111 HGIAOWR
            500 100 30 1 {eps} MAXGS MAXIN MAXNR MAXOUT EPS
            16201.9 0.00052 0 0 FN CKSI CETA CPHI
            1e-4 1e-4 FSTAT FKIN
            180d {dx} 1000 CHI DQ VELOC
            0.31 0.28 23000 82000 POISS GG
            1 IPOTCN
            {n} 1 -0.108 -500 {dx} 1000 MX MY XL YL DX DY
            1 1 IBASE IPLAN
            0.02 0 0 0 0 0 B
            """
        for required in (3e-2, 1.2e-2, 1e-2, 9e-3, 3e-3, 1e-3):
            with self.subTest(required):
                _, record = self.solve("a.inp", case.format(eps=1e-6, n=216, dx=0.001), "--accuracy", str(required))
                patch = record["patches"][0]
                self.assertTrue(patch["accuracy"]["reached"])
                self.assertLess(abs(patch["totals"]["fx_rel"] - limit), required)
        for n, eps in ((40, 1e-6), (170, 1e-3), (686, 1e-3), (686, 3e-4), (1639, 3e-3), (1639, 1e-4)):
            with self.subTest(n=n, eps=eps):
                _, record = self.solve("a.inp", case.format(eps=eps, n=n, dx=0.216 / n), "--errors", "--order", "2")
                patch = record["patches"][0]
                error = abs(patch["totals"]["fx_rel"] - limit)
                self.assertGreater(patch["errors"]["fx_error"] / force, 0.3 * error)

    def test_friction_that_follows_temperature(self):
        """Established temperatures count the heat of an element twice: the error has order 1/2, and forces depend on temperatures

        The limit is that of moving sources: 0.91866, and 223.4 degC of sliding without it, within 1e-4 and 0.1.
        """
        case = """3 MODULE
            203100 PBTNFS
            0{law}22020 VLDCMZE
            3000111 HGIAOWR
            999 200 30 1 1e-6 MAXGS MAXIN MAXNR MAXOUT EPS
            70000 0.04 0 0 FN CKSI CETA CPHI
            {friction}
            0 {dx} 20000 CHI DQ VELOC
            0.28 0.28 82000 82000 POISS GG
            90 450 0.05 7.85e-6 BKTEMP HEATCP LAMBDA DENSITY
            15 450 0.05 7.85e-6
            1 IPOTCN
            {n} {n} -12 -8 {dx} {dy} MX MY XL YL DX DY
            1 1 IBASE IPLAN
            0.001 0 0.0008 0 0 0 B
            """
        heated = "0.32 100 -0.107 200 FREF TREF DFHEAT DTHEAT\n0 1 MEMDST MEM_S0"
        for n in (24, 48, 96):
            sides = {"n": n, "dx": 20.0 / n, "dy": 16.0 / n}
            with self.subTest(n):
                for order in ("1", "2"):
                    _, record = self.solve("a.inp", case.format(law=6, friction=heated, **sides), "--errors", "--order", order)
                    patch = record["patches"][0]
                    error = 0.91866 - abs(patch["totals"]["fx_rel"])
                    self.assertTrue(0.3 < patch["errors"]["fx_rel_error"] / error < 3.0, (order, error, patch["errors"]))
                _, record = self.solve("b.inp", case.format(law=0, friction="0.32 0.32 FSTAT FKIN", **sides), "--errors")
                patch = record["patches"][0]
                error = patch["totals"]["max_temp1"] - 223.4
                self.assertTrue(0.3 < patch["errors"]["max_temp1_error"] / error < 3.0, (error, patch["errors"]))
        text = case.format(law=6, friction=heated, n=40, dx=0.5, dy=0.4)
        _, record = self.solve("c.inp", text, "--accuracy", "1e-3", "--limit-elements", "4000")
        self.assertFalse(record["patches"][0]["accuracy"]["reached"])
        _, record = self.solve("c.inp", text, "--accuracy", "1e-3", "--limit-elements", "4000", "--heat", "moving-source")
        patch = record["patches"][0]
        self.assertTrue(patch["accuracy"]["reached"])
        self.assertLess(abs(abs(patch["totals"]["fx_rel"]) - 0.91866), 1e-3)

    def test_windows(self):
        """All forms of a window are refined within the same sides, and the result is that of a case with the chosen numbers"""
        geometry = "\n1 1 IBASE IPLAN\n0.005 0 0.0022 0 0 0 B\n"
        results, forces = [], []
        for number, window in enumerate(WINDOWS):
            text = rolling().replace("-3 IPOTCN", window + geometry.rstrip()).replace("14 14 3 5 1.2 MX MY AA BB SCALE\n", "")
            _, record = self.solve(f"w{number}.inp", text, "--accuracy=2e-3")
            accuracy = record["patches"][0]["accuracy"]
            results.append((accuracy["mx"], accuracy["my"], round(accuracy["dx"], 9)))
            forces.append(record["patches"][0]["totals"]["fx"])
            if number:
                continue
            size = f"{accuracy['mx']} {accuracy['my']} -3.6 -6 {accuracy['dx']!r} {accuracy['dy']!r} MX"
            text = text.replace("20 20 -3.6 -6 0.36 0.6 MX", size).replace("1e-6 MAXGS", "2e-4 MAXGS")
            text = text.replace("0 0.5 30000 CHI", f"0 {accuracy['dx']!r} 30000 CHI")
            _, same = self.solve("same.inp", text, "--order", "2")
            self.assertEqual(same["patches"][0]["totals"]["fx"], record["patches"][0]["totals"]["fx"])
        self.assertEqual(len(set(results)), 1, results)
        # within EPS of the friction bound: elements whose centres lie on the edge may be in contact or not
        self.assertLess(max(forces) - min(forces), 2e-4 * 0.3 * 30000)
        self.assertLess(abs(results[0][0] * results[0][2] - 7.2), 1e-7)

    def test_wheel(self):
        """A wheel on a rail: DX and DS are chosen, the estimate meets the accuracy, and the forces agree with those of a finer
        grid"""
        _, fine = self.solve("f.toml", wheel_text(WHEEL, 4, SOURCE / "examples" / "profiles"), "--order", "2")
        text = wheel_text(WHEEL, 0.5, SOURCE / "examples" / "profiles").replace("output_level = 0", "output_level = 2")
        words, record = self.solve("w.toml", text, "--accuracy", "1e-3")
        accuracy = record["accuracy"]
        self.assertTrue(accuracy["reached"] and accuracy["estimated"] <= 1e-3)
        self.assertNotIn("mx", accuracy)
        bound = 0.3 * sum(p["totals"]["fn"] for p in fine["patches"])
        for name in ("fx_tr", "fy_tr"):
            self.assertLess(abs(record["totals"][name] - fine["totals"][name]), 1e-3 * bound)
        self.assertIn("OF THE FORCES, REACHED\n", words)

    def test_wheel_with_a_long_patch(self):
        """Few elements across a patch need slightly smaller ones in one direction; that was taken for a limit"""
        flange = {"dx": 0.4, "mu": 0.12587320834354052, "cant": 0.025, "y": 5.19271967730047, "yaw": -0.0037212372493698707,
                  "fz": 35218.87049708441, "vs": 20000.0, "vpitch": -43.468563636522646}
        _, record = self.solve("w.toml", wheel_text(flange, 1, SOURCE / "examples" / "profiles"), "--accuracy", "1e-2")
        accuracy = record["accuracy"]
        self.assertTrue(accuracy["reached"] and accuracy["estimated"] <= 1e-2 and accuracy["grids"] > 1)

    def test_limits(self):
        """If limits end the search, the best result is written, with its error and the reason"""
        for option in ("--limit-elements=1000", "--limit-memory=1.5"):
            words, record = self.solve("a.inp", rolling(), "--accuracy", "1e-5", option)
            accuracy = record["patches"][0]["accuracy"]
            self.assertFalse(accuracy["reached"])
            self.assertTrue(1e-5 < accuracy["estimated"] < 5e-3)
            self.assertTrue(record["converged"])
            self.assertLessEqual(accuracy["mx"] * accuracy["my"], 1000)
            self.assertIn("NOT REACHED: more than ", words)
            self.assertIn("elements are not allowed", accuracy["reason"])
            if option == "--limit-elements=1000":
                self.assertEqual(accuracy["reason"], "more than 1000 elements are not allowed")
            self.assertIn("Warning: the required accuracy was not reached", words)
        # bilinear tractions are of first order and need far more elements
        accuracy = self.solve("a.inp", rolling(influence=3), "--accuracy", "1e-4", "--limit-time=0.3")[1]["patches"][0]["accuracy"]
        self.assertRegex(accuracy["reason"], "no time left|time limit")

    def test_no_finer_grid(self):
        """The search ends after few grids, with the reason, where finer ones cannot help: a window that holds a part of the contact
        only, one element along both sides, a roller that is shorter than its contact is wide, whose length is one element"""
        small = rolling().replace("-3 IPOTCN", WINDOWS[0]).replace("14 14 3 5 1.2 MX MY AA BB SCALE",
                                                                   "1 1 IBASE IPLAN\n0.0005 0 0.00022 0 0 0 B")
        roller = rolling().replace("-3 IPOTCN", "-5 IPOTCN")
        ends = {"window": (small, "cuts off a part of the contact", 2),
                "single": (roller.replace("14 14 3 5", "1 1 3 1"), "one or two elements along both sides", 1),
                "roller": (roller.replace("14 14 3 5", "40 1 3 1"), "finer elements did not help", 3)}
        for name, (text, reason, grids) in ends.items():
            with self.subTest(name):
                _, record = self.solve(f"{name}.inp", text, "--accuracy", "1e-3")
                accuracy = record["patches"][0]["accuracy"]
                self.assertFalse(accuracy["reached"])
                self.assertIn(reason, accuracy["reason"])
                self.assertLessEqual(accuracy["grids"], grids)

    def test_short_times(self):
        """The first grid is so coarse that it ends in time: for any accuracy, there is a result with its error"""
        source = random.Random(15)
        kinds = "forces", "dissimilar", "viscoelastic", "profile"
        texts = [(kind, text_of(contact(source, kind), 24, (0.0, 0.0))) for kind in kinds]
        texts.append(("wheel", wheel_text(WHEEL, 1, SOURCE / "examples" / "profiles")))
        for kind, text in texts:
            for seconds in (0.2, 0.8):
                with self.subTest(kind=kind, seconds=seconds):
                    _, record = self.solve("a.toml", text, "--accuracy", "1e-6", f"--limit-time={seconds}")
                    accuracy = record["accuracy"] if kind == "wheel" else record["patches"][0]["accuracy"]
                    self.assertTrue(record["converged"])
                    self.assertFalse(accuracy["reached"])
                    self.assertTrue(1e-6 < accuracy["estimated"] < 0.2)
                    self.assertRegex(accuracy["reason"], "no time left|time limit")

    def test_refused(self):
        """Values out of range, and cases whose grid cannot be chosen"""
        (self.folder / "a.inp").write_text(rolling() + " 0 MODULE\n")
        for word in ("0", "1", "1e-7", "x", "-1e-3", "nan"):
            self.assertIn("is not a number from 1e-6 to 0.1", self.run_program(f"--accuracy={word}", "2", "a", status=1))
        self.assertIn("needs", self.run_program("--accuracy", status=1))
        layer = "1000 0.02 100 10 GG3 LAYTHK TAU_C0 K_TAU"
        for name, why, choice in (("transient", "transient rolling of", {"motion": 2, "material": 4, "layer": layer}),
                                  ("formula", "pressures by formula", {"bound": 3}),
                                  ("yield", "a layer that yields", {"material": 4, "layer": layer})):
            (self.folder / (name + ".inp")).write_text(rolling(**choice) + " 0 MODULE\n")
            said = self.run_program("--accuracy", "1e-3", "2", name, status=1)
            self.assertIn("the grid cannot be chosen with " + why, said)
        # estimates of the approach were a seventh to a fourteenth of the error, which was called reached
        planform = rolling().replace("-3 IPOTCN", "1 IPOTCN").replace("14 14 3 5 1.2", "14 14 -4 -6 0.57 0.86")
        for shape in "2\n1 0 1 0 0 -4", "3\n-9 9 -1.1 1.1 8 9 8 9", "4\n1\n-9 9 -1.1 1.1":
            text = planform + "1 " + shape.replace("\n", "\n0.002 0 0.001 0 0 0\n", 1) + "\n 0 MODULE\n"
            (self.folder / "planform.inp").write_text(text)
            self.assertIn("cannot be chosen with a planform", self.run_program("--accuracy", "1e-3", "2", "planform", status=1))
            self.assertIn("1 solved", self.run_program("2", "planform"))
        oblique = rolling().replace("0 0.5 30000 CHI", "1.57 0.5 30000 CHI")
        (self.folder / "oblique.inp").write_text(oblique + " 0 MODULE\n")
        self.assertIn("not along x", self.run_program("--accuracy", "1e-3", "2", "oblique", status=1))

    def solve_all(self, name, text, *options):
        """The patch of each case"""
        self.solve(name, text, *options)
        lines = (self.folder / (name.split(".")[0] + ".jsonl")).read_text().splitlines()
        return [r["patches"][0] for r in (plain(json.loads(line)) for line in lines) if r.get("patches")]

    def test_series(self):
        """Shifts that continue one another: previous ones are solved on the grid required by the last; the result is that of the
        same cases on the chosen elements, and as accurate as prescribed against finer ones"""
        c = contact(random.Random(4), "shifts")
        fine = self.solve_all("fine.toml", text_of(c, 120, (0.3, 0.1)))[-1]["totals"]
        for first, last in ((1e-2, 1e-2), (5e-2, 1e-3)):
            with self.subTest(required=last):
                text = text_of(c, 30, (0.2, 0.4)).replace("[case.iteration]\n", f"[case.iteration]\naccuracy = {first}\n")
                patches = self.solve_all("a.toml", text + f"[case.iteration]\naccuracy = {last}\n")
                accuracy, totals = [p["accuracy"] for p in patches], patches[-1]["totals"]
                self.assertTrue(all(t["reached"] for t in accuracy))
                bound = totals["mu_scal"] * totals["fn"]
                error = max(abs(totals[name] - fine[name]) for name in ("fx", "fy")) / bound
                self.assertLess(max(error, abs(totals["pen"] / fine["pen"] - 1.0)), last)
                self.assertEqual(accuracy[-1]["mx"] > accuracy[0]["mx"], first > last)
                text = text_of(c, 30, (0.2, 0.4), accuracy[-1]["eps"])
                for name in ("mx", "my", "dx", "dy"):
                    text = re.sub(rf"^{name} = .*$", f"{name} = {accuracy[-1][name]!r}", text, flags=re.MULTILINE)
                again = self.solve_all("b.toml", text)[-1]["totals"]
                self.assertLess(max(abs(totals[n] - again[n]) for n in ("fx", "fy")), 3.0 * accuracy[-1]["eps"] * bound)
        # a decreasing load leaves former contact outside, which the coarse level has to contain
        c["changes"] = {step: {"fn": c["fn"] / 2**step} for step in range(1, c["steps"])}
        for n in (20, 31):
            for patch in self.solve_all("d.toml", text_of(c, n, (0.2, 0.4)), "--errors"):
                self.assertIn("fx_error", patch["errors"], patch["errors"].get("reason"))
        # a repeated step continues from the case before the one that it repeats
        head, *cases = text_of(c, 30, (0.2, 0.4)).split("[[case]]")[1:]
        twice = [*cases[:2], cases[1].replace("continue_all", "repeat_step"), cases[2]]
        once, again = (self.solve_all("c.toml", "[[case]]" + "[[case]]".join([head, *rest]), "--accuracy", "1e-3")[-1]["totals"]
                       for rest in (cases, twice))
        self.assertLess(max(abs(once[n] - again[n]) for n in ("fx", "fy")), 3e-4 * once["mu_scal"] * once["fn"])
        # behind steady rolling it continues from the steady tractions
        rolls = head.replace('motion = "shift"', 'motion = "steady_rolling"') + "[case.rolling]\ndq = 0.1\nveloc = 1000\n"
        shift = cases[0].replace("[case.kinematics]\n", "[case.kinematics]\ncksi = -1e-4\nceta = 0\ncphi = 0\n")
        once, again = (self.solve_all("c.toml", "[[case]]" + "[[case]]".join([rolls, shift.replace("continue_all", link)]),
                                      "--accuracy", "1e-2")[-1]["totals"] for link in ("continue_all", "repeat_step"))
        self.assertEqual([once[n] for n in ("fx", "fy")], [again[n] for n in ("fx", "fy")])
        self.assertGreater(abs(once["fx"]), 0.0)

    def test_steps(self):
        """Steps of transient rolling of a prescribed length: as accurate as prescribed against finer elements, equal to the same
        cases on the chosen elements; an accuracy that cannot be reached is reported with the error that was reached"""
        c = contact(random.Random(1), "transient")
        c["changes"] = {2: {"cksi": -c["creep"][0]}}
        fine = self.solve_all("fine.toml", text_of(c, 160, (0.3, 0.1)))
        patches = self.solve_all("a.toml", text_of(c, 30, (0.2, 0.4)), "--accuracy", "2e-2")
        self.assertEqual(len(patches), c["steps"])
        for patch, exact in zip(patches, fine):
            accuracy, totals = patch["accuracy"], patch["totals"]
            self.assertTrue(accuracy["reached"])
            bound = totals["mu_scal"] * totals["fn"]
            self.assertLess(max(abs(totals[name] - exact["totals"][name]) for name in ("fx", "fy")), 2e-2 * bound)
        text = text_of(c, 30, (0.2, 0.4), accuracy["eps"])
        for name in ("mx", "my", "dx", "dy"):
            text = re.sub(rf"^{name} = .*$", f"{name} = {accuracy[name]!r}", text, flags=re.MULTILINE)
        again = self.solve_all("b.toml", text)[-1]["totals"]
        self.assertLess(max(abs(totals[n] - again[n]) for n in ("fx", "fy")), 3.0 * accuracy["eps"] * bound)
        accuracy = self.solve_all("c.toml", text_of(c, 30, (0.2, 0.4)), "--accuracy", "1e-4",
                                  "--limit-elements=5000")[0]["accuracy"]
        self.assertFalse(accuracy["reached"])
        self.assertGreater(accuracy["estimated"], 1e-4)
        self.assertIn("elements are not allowed", accuracy["reason"])

    def test_series_refused(self):
        """Cases that cannot continue on the elements of previous cases"""
        c = contact(random.Random(4), "shifts")
        text = text_of(c, 30, (0.2, 0.4))
        without = text.replace("[case.iteration]\n", "[case.iteration]\naccuracy = 0\n")
        window = re.search(r"\[case.grid\].*?(?=\[case.geometry)", text, re.DOTALL).group()
        corner, side = (float(re.search(rf"^{name} = (.*)$", window, re.MULTILINE).group(1)) for name in ("xl", "dx"))
        moved = text + re.sub("xl = .*", f"xl = {corner + side!r}", window)
        for name, words, why in (("without", without + "[case.iteration]\naccuracy = 1e-2\n", "continues one without an accuracy"),
                                 ("moved", moved, "a window that moves")):
            (self.folder / f"{name}.toml").write_text(words)
            options = () if name == "without" else ("--accuracy", "1e-2")
            self.assertIn(why, self.run_program(*options, "2", name, status=1))

    def test_resume(self):
        """The accuracy is one of the options that a run was made with"""
        text = rolling() + rolling().replace("0.0005", "0.0004")
        (self.folder / "r.inp").write_text(text + "3 MODULE\nx\n")
        self.run_program("--accuracy", "1e-2", "--json", "2", "r", status=1)
        (self.folder / "r.inp").write_text(text + rolling().replace("0.0005", "0.0003") + " 0 MODULE\n")
        self.assertIn("another accuracy", self.run_program("--resume", "--accuracy", "1e-3", "2", "r", status=1))
        self.run_program("--resume", "2", "r")
        records = [plain(json.loads(line)) for line in (self.folder / "r.jsonl").read_text().splitlines()]
        self.assertEqual([r["patches"][0]["accuracy"]["asked"] for r in records if r["patches"]], [1e-2] * 3)

    def test_readable_format(self):
        """The accuracy is written in the file, is kept from case to case, ends with 0, and is reported by conversion"""
        (self.folder / "a.inp").write_text(rolling() + " 0 MODULE\n")
        self.run_program("convert", "a.inp")
        (self.folder / "a.inp").unlink()
        text = (self.folder / "a.toml").read_text().replace("[case.iteration]\n", "[case.iteration]\naccuracy = 5e-3\n")
        more = "\n[[case]]\n[case.kinematics]\ncphi = 0.0004\n\n[[case]]\n[case.iteration]\naccuracy = 0\n"
        self.solve("b.toml", text + more)
        records = [plain(json.loads(line)) for line in (self.folder / "b.jsonl").read_text().splitlines()]
        required = [r["patches"][0].get("accuracy", {}).get("asked") for r in records if r["patches"]]
        self.assertEqual(required, [5e-3, 5e-3, None])
        self.assertIn("--accuracy", self.run_program("convert", "b.toml"))
        self.assertIn("Accuracy", self.run_program("explain", "b.toml"))
        for word in ("0.5", '"1e-3"', "-1e-3", "1e-7"):
            (self.folder / "d.toml").write_text(text.replace("5e-3", word))
            self.assertIn("accuracy must be a number from 1e-6 to 0.1", self.run_program("3", "d.toml", status=1))

    def test_allowed(self):
        """Simplified methods if allowed: the choice, or the reason for none, in the report, JSON, the readable format, explain"""
        no_spin = rolling().replace("3e-4", "0.0") if "3e-4" in rolling() else rolling().replace("0.0003", "0.0")
        allow = ("--accuracy=0.06", "--allow", "approximate")
        full = self.solve("f.inp", no_spin, "--accuracy", "1e-3")[1]["patches"][0]
        words, record = self.solve("a.inp", no_spin, *allow)
        patch = record["patches"][0]
        self.assertIn("simplified methods allowed: FaStrip on 20 x 20 elements", words)
        self.assertIn("FaStrip", patch["effects"])
        self.assertEqual((patch["accuracy"]["mx"], patch["accuracy"]["estimated"]), (20, 0.055))
        self.assertLess(max(abs(patch["totals"][n] - full["totals"][n]) for n in ("fx_rel", "fy_rel")), 0.055)
        self.assertNotIn("simplified", full["accuracy"])
        for text, required, why in ((no_spin, "0.05", "none, as errors without spin are up to 0.055"),
                                 (rolling(motion=1), "0.06", "none, as errors in shifts are not known"),
                                 (rolling(material=4, layer="1000 0.02 0 0 GG3 LAYTHK TAU_C0 K_TAU"), "0.06",
                                  "elastic half-spaces")):
            words, record = self.solve("n.inp", text, "--accuracy", required, *allow[1:])
            self.assertIn(why, record["patches"][0]["accuracy"]["simplified"])
            self.assertNotIn("FaStrip", record["patches"][0]["effects"])
        unused = "simplified methods are allowed, but no accuracy is requested"
        self.assertIn(unused, self.solve("u.inp", no_spin, *allow[1:])[0])
        self.assertNotIn(unused, words)
        self.assertIn('unknown value of --allow "all"; accepted: approximate',
                      self.run_program("--allow", "all", "2", "a", status=1))
        text = self.run_program("explain", *allow, "a.inp")
        self.assertIn("Simplified methods are allowed: FaStrip on 20 x 20", text)
        self.assertIn("about 400 elements", text)
        self.run_program("convert", "--force", "a.inp")
        text = (self.folder / "a.toml").read_text()
        (self.folder / "a.inp").unlink()
        for word, found in (("approximate", True), ("nothing", False)):
            keys = f'[case.iteration]\naccuracy = 0.06\nallow = "{word}"\n'
            _, record = self.solve("t.toml", text.replace("[case.iteration]\n", keys))
            self.assertEqual("simplified" in record["patches"][0]["accuracy"], found)
        (self.folder / "t.toml").write_text(text.replace("[case.iteration]\n", '[case.iteration]\nallow = "all"\n'))
        self.assertIn('allow must be "approximate" or "nothing"', self.run_program("2", "t.toml", status=1))

    def test_explained(self):
        """The grid that is found: a coarse first grid exactly, a finer one within a factor of two; a wheel; a refused case"""
        (self.folder / "e.inp").write_text(rolling() + " 0 MODULE\n")
        for required in ("1e-2", "2e-4"):
            text = self.run_program("explain", "--accuracy", required, "e")
            expected = int(re.search(r"about (\d+) elements, .*, from a solution on \d+ x \d+ elements", text).group(1))
            self.run_program("--accuracy", required, "--json", "2", "e")
            told = plain(json.loads((self.folder / "e.jsonl").read_text().splitlines()[0]))["patches"][0]["accuracy"]
            self.assertLessEqual(abs(math.log(expected / (told["mx"] * told["my"]))), 0.0 if required == "1e-2" else math.log(2.0))
        self.assertNotIn("from a solution", self.run_program("explain", "e"))
        # the part of a patch in contact does not depend on its elements
        parts = []
        for required in ("1e-2", "2e-4"):
            _, record = self.solve("w.toml", wheel_text(WHEEL, 1, SOURCE / "examples" / "profiles"), "--accuracy", required)
            text = self.run_program("explain", "--accuracy", required, "w")
            expected = int(re.search(r"about (\d+) elements, .*, from a solution on \d+ x \d+ elements", text).group(1))
            parts.append(record["patches"][0]["totals"]["ncon"] / expected)
        self.assertTrue(0.2 < parts[0] < 0.6 and 0.5 < parts[1] / parts[0] < 2.0, parts)
        (self.folder / "r.inp").write_text(rolling(material=2, layer="1e-4 1e-4 0 0 FLX") + " 0 MODULE\n")
        words = self.run_program("explain", "--accuracy", "1e-2", "r")
        self.assertRegex(words, "A run refuses this case: .*simplified theory")

    def test_next_case(self):
        """A case that keeps the grid of one with an accuracy has the grid of the file, and requests no accuracy if it says so"""
        words, _ = self.solve("a.inp", rolling() + rolling(), "--accuracy", "1e-2")
        self.assertEqual(len(re.findall("REQUIRED ACCURACY", words)), 2)


def plain(value):
    """Without units and meanings."""
    if isinstance(value, dict):
        return value["value"] if "value" in value else {k: plain(v) for k, v in value.items()}
    return [plain(v) for v in value] if isinstance(value, list) else value


if __name__ == "__main__":
    unittest.main()
