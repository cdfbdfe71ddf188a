#!/usr/bin/env python3
"""The order of the discretisation: --order, the key of the readable format, the report, cases that remain at order 1

The environment gives CONTACT_PROGRAM.
"""
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]


#: Cases for which the second order is not suited: reason, and the choices that make them
RELAXATION = "1 1 0 0.5 OMEGAH OMEGAS INISLP OMGSLP"
OTHERS = (("shift", "order 2 is for rolling", {"motion": 1}),
          ("long_step", "order 2 has steps of one element along x", {"motion": 2}),
          ("bilinear", "bilinear tractions", {"influence": 3}),
          ("formula", "pressures by formula", {"bound": 3}),
          ("gauss", "order 2 is for the default solver", {"solver": 3, "extra": RELAXATION}),
          ("layer", "plastic layer", {"material": 4, "layer": "1000 0.02 100 0 GG3 LAYTHK TAU_C0 K_TAU"}))


def rolling(motion=3, bound=0, force=0, friction=0, influence=2, material=0, solver=0, layer="", extra="", eps="1e-6", maxout=1,
            stiffer=1.0):
    """A case of an ellipse in an input file; fields that are blank are absent"""
    rows = ["3 MODULE", f"2{bound}{motion}1{force}0 PBTNFS", f"{friction}2{influence}{material}20 LDCMZE",
            f"0{solver}00111 HGIAOWR",
            f"999 100 30 {maxout} {eps} MAXGS MAXIN MAXNR MAXOUT EPS", extra,
            "30000 0.0005 0.0002 0.0003 FN CKSI CETA CPHI", "0.3 0.3 FSTAT FKIN",
            "0 0.5 30000 CHI DQ VELOC" if motion > 1 else "", f"0.28 0.28 82000 {82000 * stiffer} POISS GG", layer,
            "-3 IPOTCN", "14 14 3 5 1.2 MX MY AA BB SCALE"]
    return "\n".join(row for row in rows if row) + "\n"


class Runs(unittest.TestCase):
    """Runs of the program in a separate folder"""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def run_program(self, *words, status=0):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def run_first(self, name, text, *options):
        """The report, and the record of the first case"""
        if text:
            (self.folder / name).write_text(text + (" 0 MODULE\n" if name.endswith(".inp") else ""))
        self.run_program("--json", *options, "2", name)
        stem = name.split(".")[0]
        return ((self.folder / (stem + ".out")).read_text(),
                json.loads((self.folder / (stem + ".jsonl")).read_text().split("\n")[0]))


class Order(Runs):
    def solve(self, name, text, *options):
        """Text on the solver in the report, and the record of the first patch"""
        report, record = self.run_first(name, text, *options)
        return re.search(r"SOLVER: (.*?); RESIDUAL", report).group(1), record["patches"][0]

    def test_asked_for(self):
        plain, one = self.solve("a.inp", rolling())
        before = (self.folder / "a.jsonl").read_text()
        first, same = self.solve("a.inp", "", "--order", "1")
        second, two = self.solve("a.inp", "", "--order=2")
        self.assertEqual((plain, first), ("NormCG, Newton-Krylov",) * 2)
        self.assertEqual(second, "NormCG, Newton-Krylov of order 2")
        self.assertEqual(two["solver"]["tangential_order"], 2)
        self.assertNotIn("tangential_order", one["solver"])
        self.assertEqual(one["totals"], same["totals"])
        self.solve("a.inp", "")
        self.assertEqual(re.sub(r'"(seconds|date)[^,]*', "", (self.folder / "a.jsonl").read_text()),
                         re.sub(r'"(seconds|date)[^,]*', "", before))
        change = abs(two["totals"]["fy_rel"]["value"] - one["totals"]["fy_rel"]["value"])
        self.assertTrue(1e-3 < change < 3e-2, change)

    def test_left_at_order_1(self):
        """Cases for which the second order is not suited are solved as before, and the report gives the reason"""
        for name, reason, choice in OTHERS:
            with self.subTest(name):
                text = rolling(**choice)
                options = ["--classical"] if name == "gauss" else []
                _, one = self.solve(name + ".inp", text, *options)
                words, two = self.solve(name + ".inp", "", "--order", "2", *options)
                self.assertTrue(words.endswith(f" of order 1 ({reason})"), words)
                self.assertEqual((two["solver"]["tangential_order"], two["solver"]["tangential_order_reason"]), (1, reason))
                self.assertEqual(one["totals"], two["totals"])

    def test_soft_layers_on_fine_grids(self):
        """Newton's method finds the border of adhesion without a fall-back, in few steps"""
        for force in (0, 1, 2):
            creep = {0: "0.01 0.004 0.006", 1: "-0.5 0.004 0.006", 2: "-0.5 -0.3 0.006"}[force]
            text = rolling(material=4, force=force, layer="820 0.1 0 0 GG3 LAYTHK TAU_C0 K_TAU")
            text = text.replace("0.0005 0.0002 0.0003", creep).replace("14 14 3", "128 128 3")
            for order in ("1", "2"):
                with self.subTest(force=force, order=order):
                    words, record = self.solve("soft.inp", text, "--order", order)
                    self.assertIn("Newton-Krylov", words)
                    self.assertNotIn("Gauss", words)
                    self.assertEqual(record["solver"].get("tangential_order", 1), int(order))
                    self.assertLess(record["solver"]["tangential_iterations"], 16)

    def test_readable_format(self):
        """The order is written in the file, is kept from case to case, and is kept by conversion as far as possible"""
        (self.folder / "a.inp").write_text(rolling() + " 0 MODULE\n")
        _, one = self.solve("a.inp", "")
        self.run_program("convert", "a.inp")
        converted = (self.folder / "a.toml").read_text()
        (self.folder / "a.inp").rename(self.folder / "b.inp")
        _, again = self.solve("a.toml", "")
        self.assertEqual(one["totals"], again["totals"])
        plain = re.sub(r"order = 1.*\n", "", converted)
        second = plain.replace("[case.iteration]\n", "[case.iteration]\norder = 2\n")
        words, two = self.solve("c.toml", second + "\n[[case]]\n[case.kinematics]\ncphi = 0.0004\n")
        self.assertEqual(words, "NormCG, Newton-Krylov of order 2")
        kept = json.loads((self.folder / "c.jsonl").read_text().split("\n")[1])["patches"][0]
        self.assertEqual(kept["solver"]["tangential_order"], 2)
        _, requested = self.solve("b.inp", "", "--order", "2")
        self.assertEqual(two["totals"], requested["totals"])
        _, lowered = self.solve("c.toml", "", "--order", "1")
        self.assertEqual(lowered["totals"], one["totals"])
        self.assertIn("order 2", self.run_program("explain", "c.toml"))
        said = self.run_program("convert", "c.toml")
        self.assertIn("--order 2", said)

    def test_usual_order_of_the_readable_format(self):
        """2 if not prescribed and the case is suited, otherwise 1 without an error; converted files have 1"""
        for name, reason, choice in (("plain", "", {}), *OTHERS):
            with self.subTest(name):
                options = ["--classical"] if name == "gauss" else []
                _, one = self.solve(name + ".inp", rolling(**choice), *options)
                self.run_program("convert", name + ".inp")
                text = (self.folder / (name + ".toml")).read_text()
                self.assertEqual(text.count("order = 1 "), 1)
                (self.folder / (name + ".inp")).unlink()
                _, converted = self.solve(name + ".toml", "", *options)
                self.assertEqual(one["totals"], converted["totals"])
                self.assertNotIn("tangential_order", converted["solver"])
                words, usual = self.solve("usual.toml", re.sub(r"order = 1 .*\n", "", text), *options)
                self.assertTrue(words.endswith(f" of order 1 ({reason})" if reason else " of order 2"), words)
                self.assertEqual(usual["totals"] == one["totals"], name != "plain")

    def test_centre_of_sliding_within_an_element(self):
        """The mean slip over that element vanishes, and its direction does not jump there: neighbours have nearly the same
        forces"""
        case = """[[case]]
module = "contact"
motion = "steady_rolling"
normal = "force"
kinematics = { fn = 10.0, cksi = 3.507061191278639e-06, ceta = 6.371278392218111e-07, cphi = 8.967427223470155e-07 }
friction = { fstat = 0.3, fkin = 0.3 }
material = { poiss = [0.28, 0.28], gg = [82000.0, 82000.0] }
rolling = { veloc = 1000.0, dq = 1.0 }
grid = { form = "hertz_axes", mx = 31, my = 34, aa = 4.577743897939514, bb = 5.461205466573335, scale = 1.05 }
iteration = { order = 2 }
"""
        lateral = [6.371278392218111e-07 * (1.0 + 1e-4 * k) for k in range(-4, 5)]
        others = "".join(f"[[case]]\nestimate = \"fresh\"\nkinematics.ceta = {value!r}\n" for value in lateral)
        self.run_first("a.toml", case + others)
        patches = [json.loads(line)["patches"][0] for line in (self.folder / "a.jsonl").read_text().splitlines()[:len(lateral) + 1]]
        self.assertEqual([patch["solver"]["tangential_order"] for patch in patches], [2] * (len(lateral) + 1))
        forces = [patch["totals"]["fy_rel"]["value"] for patch in patches[1:]]
        self.assertLess(max(forces) - min(forces), 5e-4)

    def ellipse(self, name, n, order, first, sides, kinematics, friction, poisson, curvatures):
        """Text on the solver and the record of an ellipse with spin and prescribed forces on a grid of which the first corner and
        the sides of elements are given"""
        place = f"xl = {first[0]!r}, yl = {first[1]!r}, dx = {sides[0]!r}, dy = {sides[1]!r}"
        return self.solve(name, f"""[[case]]
module = "contact"
motion = "steady_rolling"
normal = "force"
tangential = "fx_and_fy"
kinematics = {{ {kinematics} }}
friction = {{ fstat = {friction}, fkin = {friction} }}
material = {{ poiss = [{poisson}, {poisson}], gg = [1000.0, 1000.0] }}
rolling = {{ veloc = 1000.0, dq = {sides[0]!r} }}
grid = {{ form = "corner_and_sides", mx = {n[0]}, my = {n[1]}, {place} }}
geometry = {{ form = "quadratic", planform = "unrestricted", b = [{curvatures[0]}, 0.0, {curvatures[1]}, 0.0, 0.0, 0.0] }}
iteration = {{ order = {order}, eps = 1e-6 }}
""")

    def test_elements_longer_than_wide(self):
        """Linear systems of Newton's method with turned slip are solved for such elements as well, in few steps, and the creepage
        is that of square elements"""
        def solved(name, n, order, offset=(0.1, 0.9)):
            """An ellipse of 6.7 x 2.1 mm"""
            sides = [2 * side / count for side, count in zip((7.686, 2.3862), n)]
            first = [-side * (count / 2 + part) for side, count, part in zip(sides, n, offset)]
            return self.ellipse(name, (n[0] + 1, n[1] + 1), order, first, sides,
                                "fn = 125.5686, cphi = -0.00055270566, fx = 0.1892349, fy = -0.1768918", 0.47641453, 0.45,
                                (0.00018257624, 0.00108004))

        exact = solved("square.toml", (80, 25), 2)[1]["totals"]["ceta"]["value"]
        plain = solved("plain.toml", (80, 60), 1)[1]["totals"]["ceta"]["value"]
        # five of these ten grids did not converge with a preconditioner that inverted the turns
        for n in (80, 60), (46, 34), (46, 68), (92, 68), (92, 102):
            for offset in (0.1, 0.9), (0.4, 0.6):
                words, found = solved("long.toml", n, 2, offset)
                self.assertTrue(words.endswith(" of order 2"), (n, offset, words))
                self.assertLess(found["solver"]["tangential_iterations"], 12, (n, offset))
                self.assertLess(20 * abs(found["totals"]["ceta"]["value"] - exact), abs(plain - exact), (n, offset))

    def test_slip_in_a_short_row(self):
        """An element of a short outermost row alternated between adhesion and turned slip before terms behind oblique edges were
        bounded. Order 2 solves the case, and the creepage differs from that of another grid by a fifth of what the first order
        differs by"""
        def solved(name, n, order, first, sides):
            return self.ellipse(name, n, order, first, sides,
                                "fn = 125.57, cphi = 0.0004826919238281146, fx = -0.09972804870106783, fy = -0.18159485495819233",
                                0.5845960101701317, 0.4445825398860461, (0.00014323999418861547, 0.0014536107715117604))

        words, found = solved("finer.toml", (197, 23), 2, (-7.790706937556407, -2.017790908857636),
                              (0.07931894662549793, 0.16941989159174106))
        self.assertTrue(words.endswith(" of order 2"), words)
        grid = (197, 13), (-7.790706937556407, -2.3413829017978616), (0.07931894662549793, 0.3388397831834821)
        exact = found["totals"]["ceta"]["value"]
        wrong = {}
        for order, words in (1, "Newton-Krylov"), (2, " of order 2"):
            said, found = solved("rows.toml", grid[0], order, *grid[1:])
            self.assertTrue(said.endswith(words), said)
            wrong[order] = abs(found["totals"]["ceta"]["value"] - exact)
        self.assertLess(5 * wrong[2], wrong[1])

    def test_bodies_that_end_in_the_contact(self):
        """Contact that ends with the bodies at its leading edge, where pressures grow instead of falling: at the border of a
        planform, at excluded elements, and at the border of the grid; also with parts of reduced interaction. Order 2 is much
        closer to the limit of the first order than that itself; it was 1.4 to 4 times farther off, or made no progress"""
        def solved(name, n, order, geometry, ends=2.1):
            side = 4.2 / n
            mx = round((ends + 2.1) / side)
            rows = ["3 MODULE", "203100", "022020", "0000111", "999 100 30 1 1e-7", "6000 0.0012 0.0008 0.0006", "0.3 0.3",
                    f"0 {side!r} 20000", "0.28 0.28 82000 82000", "1 IPOTCN", f"{mx} {n} -2.1 -2.1 {side!r} {side!r}", geometry,
                    "0 MODULE"]
            (self.folder / (name + ".inp")).write_text("\n".join(rows) + "\n")
            words, patch = self.solve(name + ".inp", "", "--order", str(order))
            self.assertTrue(words.endswith(" of order 2" if order == 2 else "Newton-Krylov"), words)
            return [patch["totals"][name]["value"] for name in ("fx", "fy")]

        quadratic = "0.0111 0.001 0.014 0 0 0\n"
        for name, geometry, ends in (("ahead", f"1 3\n{quadratic}-9 0.525 -9 9 8 9 8 9", 2.1),
                                     ("both", f"1 3\n{quadratic}-0.525 0.525 -9 9 8 9 8 9", 2.1),
                                     ("two", f"1 3\n{quadratic}-9 -0.35 -9 9 0.35 9 -9 9", 2.1),
                                     ("parts", f"1 4\n{quadratic}2\n-9 0.525 -9 0 -9 0.525 0 9\n0.8", 2.1),
                                     ("grid", f"1 1\n{quadratic}", 0.525)):
            with self.subTest(name):
                plain = {n: solved(name, n, 1, geometry, ends) for n in (48, 96, 192)}
                limit = [2 * fine - coarse for fine, coarse in zip(plain[192], plain[96])]
                wrong = [math.dist(found, limit) for found in (plain[48], solved(name, 48, 2, geometry, ends))]
                self.assertLess(2.5 * wrong[1], wrong[0], (limit, wrong))

    def roll(self, order, n, offset, *options, distance=6.6, chi=0.0, motion=2):
        """Relative FX and FY, and MZ over the bound, after a quarter, a half and all of a distance in steps of one element

        Estimated errors instead if the options request them.
        """
        half = (3.3, 5.5)
        dx, dy = (2 * side / n for side in half)
        steps = round(distance / dx) if motion == 2 else 1
        rows = ["3", f"20{motion}100", "022020", "0000111", "999 100 30 1 1e-6", "30000 0.0005 -0.0002 0.0003", "0.3 0.3",
                f"{chi}d {dx:.15g} 30000", "0.28 0.28 82000 82000", "1",
                f"{n + 2} {n + 2} {-half[0] - (1 - offset) * dx:.15g} {-half[1] - (1 - offset) * dy:.15g} {dx:.15g} {dy:.15g}",
                "1 1", "0.002436996253160624 0 0.001130294718810031 0 0 0"]
        again = ["3", f"00{motion}100", "111010", "0101111", "30000 0.0005 -0.0002 0.0003"]
        (self.folder / "r.inp").write_text("\n".join(rows + (steps - 1) * again + ["0", ""]))
        self.run_program("--json", *options, "--order", str(order), "2", "r")
        records = map(json.loads, (self.folder / "r.jsonl").read_text().splitlines())
        patches = [record["patches"][0] for record in records if record.get("patches")]
        self.assertEqual(len(patches), steps)
        self.assertEqual({patch["solver"].get("tangential_order", 1) for patch in patches}, {order})
        part, end = ("errors", "_error") if "--errors" in options else ("totals", "")
        found = [[patch[part][name + end]["value"] for name in ("fx_rel", "fy_rel")]
                 + [patch[part]["mz" + end]["value"] / (9000 * 15**0.5)] for patch in patches]
        return [found[round(steps * share) - 1] for share in (0.25, 0.5, 1.0)]

    def test_transient_rolling(self):
        """Starting without tractions: errors at the same distances decrease with the square of the size of elements, in both
        directions"""
        limit = {}
        for chi in 0.0, 180.0:
            fine, half = (self.roll(2, n, 0.3, chi=chi) for n in (80, 40))
            limit[chi] = [[f + (f - h) / 3 for f, h in zip(*rows)] for rows in zip(fine, half)]
            error = {}
            for order, n in (1, 20), (1, 40), (2, 20), (2, 40):
                found = self.roll(order, n, 0.3, chi=chi)
                error[order, n] = max(abs(f - r) for rows in zip(found, limit[chi]) for f, r in zip(*rows))
            self.assertLess(error[2, 20], 1.2e-3, error)
            self.assertLess(error[2, 40], 0.4 * error[2, 20], error)
            for n in 20, 40:
                self.assertGreater(error[1, n], 5 * error[2, n], error)
                estimated = max(map(max, self.roll(2, n, 0.3, "--errors", chi=chi)))
                self.assertTrue(0.3 < estimated / error[2, n] < 5.0, (n, estimated, error))

    def test_energy_next_to_the_border(self):
        """The elastic energy by the virial formula needs no elements around the contact"""
        errors = []
        for n in 14, 18:
            text = rolling().replace("14 14 3 5 1.2", f"{n} {n} 3 5 {1.2 * n / 14!r}")
            errors.append(self.solve("e.inp", text, "--errors", "--order", "2")[1]["errors"]["elastic_energy_error"]["value"])
        self.assertAlmostEqual(errors[0] / errors[1], 1.0, delta=1e-3)

    def test_slip_that_turns(self):
        """Estimates detect that the direction of slip turns from element to element, around a pole in the contact and without
        one"""
        scales = {"fx": 9000.0, "fy": 9000.0, "mz": 9000.0 * 15**0.5}

        def solve(creep, n):
            text = rolling().replace("0.0005 0.0002 0.0003", creep).replace("14 14 3 5", f"{n} {n} 3 5")
            return self.solve("t.inp", text, "--errors", "--order", "2")[1]

        for creep in "0 0.0001 0.002", "0.0005 0.001 0.0015":
            exact = solve(creep, 84)["totals"]
            for n in 15, 17, 19:
                found = solve(creep, n)
                true = max(abs(found["totals"][name]["value"] - exact[name]["value"]) / scale for name, scale in scales.items())
                estimate = max(found["errors"][name + "_error"]["value"] / scale for name, scale in scales.items())
                self.assertTrue(1.0 < estimate / true < 6.0, (creep, n, estimate, true))

    def test_transient_rolling_becomes_steady(self):
        """After ten contact lengths no effect of the start remains, except directions of slip that were set from another start"""
        for order, bound in (1, 1e-5), (2, 2e-4):
            rolled = self.roll(order, 12, 0.2, distance=66.0)[-1]
            steady = self.roll(order, 12, 0.2, motion=3)[-1]
            away = max(abs(r - s) for r, s in zip(rolled, steady))
            self.assertLess(away, bound, (order, rolled, steady))

    def test_unlike_bodies_converge(self):
        """Outer iterations between pressures and tractions converge to a small tolerance, in the number needed by the first
        order"""
        passes = {}
        for order in "1", "2":
            _, found = self.solve("unlike.inp", rolling(stiffer=4.0, eps="1e-8", maxout=15), "--order", order)
            self.assertLess(found["solver"]["coupled_residual"], 1e-8)
            passes[order] = found["solver"]["outer_iterations"]
        self.assertLessEqual(passes["2"], passes["1"] + 1)

    def test_refused(self):
        (self.folder / "a.inp").write_text(rolling() + " 0 MODULE\n")
        self.assertIn('unknown order of the discretisation "3"; accepted: 1, 2',
                      self.run_program("--order", "3", "2", "a", status=1))
        self.run_program("convert", "a.inp")
        for word in ("3", '"2"', "1.5"):
            text = re.sub(r"order = 1.*\n", "", (self.folder / "a.toml").read_text())
            text = text.replace("[case.iteration]\n", f"[case.iteration]\norder = {word}\n")
            (self.folder / "d.toml").write_text(text + "\n[[case]]\n[case.iteration]\n")
            said = self.run_program("3", "d.toml", status=1)
            self.assertEqual(said.count("order must be 1 or 2"), 1, "once, although the next case keeps it")


if __name__ == "__main__":
    unittest.main()
