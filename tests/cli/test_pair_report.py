#!/usr/bin/env python3
"""The report of wheel and rail: every number below its name is that of the input or of the JSON record, on both sides.

The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import json
import math
import os
import re
import subprocess
import tempfile
import unittest
import unittest.mock

PROGRAM = os.environ["CONTACT_PROGRAM"]
PROFILES = os.path.join(os.environ["CONTACT_SOURCE"], "examples", "profiles")
# Nothing is zero and nothing symmetric; {s} is the sign of what changes its sign on the left
CASE = """1
{c1}{p}0{t}{n}{f}0
{v}0{d}2033
000{a}{o}01
999 100 30 1 1e-6
{friction}
0.28 0.31 82000 79000
0.9 0.7 {dqrel} 90d 8 4
-1 {s}752.0 0.3 0.025 {s}1e-6
'{folder}/60E1.prr' 0 1.01 0
{s}0.3 0.1 {s}0.003 {s}1.1 2.2 {s}0.0013
{springs}1360 -70 460
'{folder}/S1002.prw' 0 1.01 0
100 {s}6.5 {z} {s}0.004 {s}0.006 0.05
20000 {s}17 3 {s}0.0017 {s}0.0021 -43.5
0.011 {s}0.012 0.013 {s}0.0014 {s}0.0015 0.016
1.1 {s}1.2 1.3 {s}0.014 {s}0.015 0.16
"""
PLAIN = dict(p=2, t=3, n=1, f=0, v=0, d=2, a=0, o=4, friction="0.35 0.35", dqrel=1, springs="", z=60000)
BY_ANGLE = dict(v=1, friction="2\n-90d 0.1 0.1\n90d 0.5 0.5")
# Numbers of the input by their names in the report, with those that change their sign on the left
GIVEN = {"POISS(R)": 0.28, "POISS(W)": 0.31, "GG(R)": 82000, "GG(W)": 79000, "EPS": 1e-6, "DX": 0.9, "DS": 0.7,
         "A_SEP": math.pi / 2, "D_SEP": 8, "D_COMB": 4, "GAUGHT": -1, "RAILZ0": 0.3, "CANT": 0.025, "MIRRORY": 0, "MIRRORZ": 0,
         "ISMOOTH": 0, "LAMBDA": 0, "DZRAIL": 0.1, "VZRAIL": 2.2, "S_WS": 100, "PITCH_WS": 0.05, "VX_WS": 20000, "VZ_WS": 3,
         "VPITCH_WS": -43.5, "DXWHL": 0.011, "DZWHL": 0.013, "DPITCHW": 0.016, "VXWHL": 1.1, "VZWHL": 1.3, "VPITCHW": 0.16,
         "ZIGTHRS": math.radians(150), "KINKHIG": math.pi / 6, "KINKLOW": math.pi / 30, "KINKWID": 2, "MAXOMIT": 0.5}
GIVEN_ODD = {"RAILY0": 752, "CURV": 1e-6, "DYRAIL": 0.3, "DROLLR": 0.003, "VYRAIL": 1.1, "VROLLR": 0.0013, "Y_WS": 6.5,
             "ROLL_WS": 0.004, "YAW_WS": 0.006, "VY_WS": 17, "VROLL_WS": 0.0017, "VYAW_WS": 0.0021, "DYWHL": 0.012,
             "DROLLW": 0.0014, "DYAWW": 0.0015, "VYWHL": 1.2, "VROLLW": 0.014, "VYAWW": 0.015}
# Names of the JSON record
FOUND = {"FX(TR)": "fx_tr", "FY(TR)": "fy_tr", "FZ(TR)": "fz_tr", "FX(WS)": "fx_ws", "FY(WS)": "fy_ws", "FZ(WS)": "fz_ws",
         "MX@R(TR)": "mx_r_tr", "MY@R(TR)": "my_r_tr", "MZ@R(TR)": "mz_r_tr", "MX@W(WS)": "mx_w_ws", "MY@W(WS)": "my_w_ws",
         "MZ@W(WS)": "mz_w_ws", "Z_WS": "z_ws", "DY_DEFL": "dy_defl", "DZ_DEFL": "dz_defl", "XCP(TR)": "xcp_tr",
         "YCP(TR)": "ycp_tr", "ZCP(TR)": "zcp_tr", "DELTCP(TR)": "deltcp_tr", "YCP(R)": "ycp_r", "ZCP(R)": "zcp_r",
         "XCP(W)": "xcp_w", "YCP(W)": "ycp_w", "ZCP(W)": "zcp_w", "CKSI": "cksi", "CETA": "ceta", "CPHI": "cphi", "FN": "fn",
         "FX": "fx", "FS": "fy", "MN": "mz", "ELAST.EN.": "elastic_energy", "FRIC.POWER": "friction_power", "FX/FSTAT/FN": "fx_rel",
         "FS/FSTAT/FN": "fy_rel", "FX/FN": "fx_rel", "FS/FN": "fy_rel", "APPROACH": "pen", "PMAX": "pmax", "NCON": "ncon",
         "NADH": "nadh", "NSLIP": "nslip", "BAR_FN": "bar_fn", "BAR_FX": "bar_fx", "BAR_FS": "bar_fs", "TILDE_FN": "fn"}
SHIFTED = {"cksi": "shift_x", "ceta": "shift_y", "cphi": "rotation", "friction_power": "friction_work"}
ODD = {"shift_y", "rotation", "ycp_r", "ycp_tr", "ycp_w", "deltcp_r", "deltcp_tr", "fy", "fy_rel", "fy_tr", "fy_ws", "mx_r_tr",
       "mx_w_ws", "mz", "mz_r_tr", "mz_elem", "mz_w_ws", "roll_ws", "y_ws", "yaw_ws", "ceta", "cphi", "bar_fs", "bar_mn", "dy_defl"}


def value(entry):
    return entry["value"] if isinstance(entry, dict) else entry


def rows_of(text):
    """Pairs of names and numbers: a line of names, and the line with the same number of values below"""
    lines = text.split("\n")
    for line, below in zip(lines, lines[1:]):
        names, words = line.split(), below.split()
        if len(names) != len(words) or not re.fullmatch(r"[ A-Z0-9_()@/.]+", line):
            continue
        if all(re.fullmatch(r"-?[\d.]+(E[+-]\d+)?", word) for word in words) and re.search("[A-Z]{2}", line):
            yield from zip(names, words)


class PairReport(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def run_both(self, *steps, roller=False, options=()):
        """Cases in turn, on the right and on the left: reports and records"""
        sides = []
        for c1, s in ((5, ""), (4, "-")) if roller else ((1, ""), (0, "-")):
            text = "".join(CASE.format(c1=c1, s=s, folder=PROFILES, **{**PLAIN, **step}).replace("2033", "2035") for step in steps)
            with open(os.path.join(self.folder, "x.inp"), "w", encoding="utf-8") as file:
                # two sign changes cancel
                file.write(text.replace("{s}", s).replace("--", "") + "0\n")
            run = subprocess.run([PROGRAM, "--quiet", "--json", *options, "2", "x"], cwd=self.folder, stdin=subprocess.DEVNULL,
                                 capture_output=True, text=True, timeout=60)
            self.assertEqual(run.returncode, 0, run.stderr)
            with open(os.path.join(self.folder, "x.out"), encoding="utf-8") as file:
                reports = re.split(r"\n Case +\d+", file.read())[1:]
            with open(os.path.join(self.folder, "x.jsonl"), encoding="utf-8") as file:
                records = [case for case in map(json.loads, file) if case["case"]]
            self.assertEqual([record["status"] for record in records], ["solved"]*len(steps))
            sides.append((reports, records))
        return sides

    def compare(self, steps):
        """All numbers of the reports; required names; both sides are mirror images"""
        sides = self.run_both(*steps)
        names = set()
        for left, (reports, records) in enumerate(sides):
            for report, record in zip(reports, records):
                self.assertIn("LEFT WHEEL" if left else "RIGHT WHEEL", report)
                self.assertEqual(record["side"], "left" if left else "right")
                parts = re.split(r" ----- DATA FOR CONTACT PATCH.*", report)
                self.assertEqual(len(parts) - 1, len(record["patches"]))
                for k, part in enumerate(parts):
                    totals = record["patches"][k - 1]["totals"] if k else record["totals"]
                    for name, word in rows_of(part):
                        if name in FOUND:
                            key = FOUND[name]
                            # in a shift the names of creepages are those of distances
                            expected = value(totals[key] if key in totals else totals[SHIFTED[key]])
                        elif name in GIVEN or name in GIVEN_ODD:
                            expected = GIVEN[name] if name in GIVEN else GIVEN_ODD[name]*(-1)**left
                        else:
                            continue
                        names.add(name)
                        if name == "MN" and "bar_mn" in totals:
                            expected = value(totals["bar_mn"])
                        elif name == "MN" and "mz_elem" in totals:
                            expected = value(totals["mz_elem"])
                        # four figures, or the number of decimals that are printed
                        decimals = len(word.split("E")[0].partition(".")[2])
                        unit = 10.0**(-decimals + (int(word.split("E")[1]) if "E" in word else 0)) if "." in word else 1.0
                        self.assertAlmostEqual(float(word), expected, delta=0.501*unit if "." in word else 1e-9, msg=(name, left))
        for right, left in zip(sides[0][1], sides[1][1]):
            for a, b in [(right, left), *zip(right["patches"], left["patches"])]:
                self.assertEqual(a["totals"].keys(), b["totals"].keys())
                for name, entry in a["totals"].items():
                    expected = value(entry)*(-1 if name in ODD else 1)
                    self.assertAlmostEqual(value(b["totals"][name]), expected, delta=1e-7*abs(expected) + 1e-12, msg=name)
        return names, sides

    def test_plane_patch(self):
        names, sides = self.compare([PLAIN])
        self.assertLessEqual(set(GIVEN) | set(GIVEN_ODD), names | {"ZIGTHRS", "KINKHIG", "KINKLOW", "KINKWID", "MAXOMIT"})
        self.assertLessEqual(set(FOUND), names | {"FX/FN", "FS/FN", "BAR_FN", "BAR_FX", "BAR_FS", "TILDE_FN", "DY_DEFL", "DZ_DEFL"})
        self.assertNotIn("SPINXO", sides[0][0][0])
        # finer choices of profiles are printed in longer reports
        names, _sides = self.compare([dict(PLAIN, o=3)])
        self.assertLessEqual({"ZIGTHRS", "KINKHIG", "KINKLOW", "KINKWID", "MAXOMIT"}, names)
        self.assertNotIn("MX@R(TR)", names)
        self.assertNotIn("MAXOMIT", self.compare([dict(PLAIN, o=2)])[0])

    def test_curved_patch(self):
        names, sides = self.compare([dict(PLAIN, d=4, o=3, **BY_ANGLE)])
        self.assertLessEqual({"BAR_FN", "BAR_FX", "BAR_FS", "TILDE_FN", "FX/FN", "FS/FN"}, names)
        curves = []
        for reports, records in sides:
            number = int(re.search(r"CURVED REFERENCE SURFACE, TRACK COORDINATES, +(\d+) POINTS", reports[0]).group(1))
            rows = [[float(word) for word in line.split()]
                    for line in reports[0].split("    I        Y(I)       Z(I)       A(I)\n")[1].split("\n")[:number]]
            self.assertEqual([row[0] for row in rows], list(range(1, number + 1)))
            curves.append(rows)
            totals = records[0]["patches"][0]["totals"]
            # the reference is one of its points or between two, and the angle is the slope
            near = min(rows, key=lambda row: abs(row[1] - value(totals["ycp_tr"])))
            self.assertAlmostEqual(near[2], value(totals["zcp_tr"]), delta=0.2)
            self.assertAlmostEqual(near[3], value(totals["deltcp_tr"]), delta=0.02)
            for a, b, c in zip(rows, rows[1:], rows[2:]):
                self.assertAlmostEqual(b[3], math.atan2(c[2] - a[2], abs(c[1] - a[1]))*(1 if c[1] > a[1] else -1),
                                       delta=0.02)
            angles = re.search(r"Contact angle +(\S+) deg at the reference, from +(\S+) to +(\S+) deg", reports[0]).groups()
            self.assertAlmostEqual(float(angles[0]), math.degrees(value(totals["deltcp_tr"])), delta=0.006)
            first, last = map(int, re.search(r"Contact in rows +(\d+) to +(\d+) of +%d" % number, reports[0]).groups())
            for angle, row in zip(angles[1:], (first, last)):
                self.assertAlmostEqual(float(angle), math.degrees(rows[row - 1][3]), delta=0.006)
            moments = re.search(r"Moments about the reference MX, MS, MN: +(\S+) +(\S+) +(\S+) N mm", reports[0]).groups()
            self.assertAlmostEqual(float(moments[2])/value(totals["bar_mn"]), 1.0, delta=1e-3)
        for right, left in zip(*curves):
            self.assertEqual([right[1], right[2], right[3]], [-left[1], left[2], -left[3]])

    def test_steps_and_springs(self):
        """Two steps of transient rolling, whose reference of spin moves off the origin; the rail on springs"""
        for extra in (dict(t=2), dict(t=1)):
            _names, sides = self.compare([dict(PLAIN, **extra), dict(PLAIN, p=0, **extra)])
            for reports, records in sides:
                for report, record in zip(reports, records):
                    totals = record["patches"][0]["totals"]
                    self.assertEqual("SPINXO" in report, value(totals.get("mz_elem", totals["mz"])) != value(totals["mz"]))
            origins = [re.findall(r"SPINXO +SPINYO\n +(\S+) +(\S+)", report) for reports, _ in sides for report in reports]
            for right, left in zip(origins[:2], origins[2:]):
                self.assertEqual(len(right), len(left))
                for (a, b), record in zip(zip(right, left), sides[0][1]):
                    totals = {name: value(entry) for name, entry in record["patches"][0]["totals"].items()}
                    # position of the contact reference in the coordinates of the elements
                    self.assertAlmostEqual(totals["mz"] + float(a[0])*totals["fy"] - float(a[1])*totals["fx"], totals["mz_elem"],
                                           delta=2e-3*abs(totals["mz_elem"]))
                    self.assertAlmostEqual(float(a[0]), float(b[0]), delta=1e-6 + 1e-3*abs(float(a[0])))
                    self.assertAlmostEqual(float(a[1]), -float(b[1]), delta=1e-6 + 1e-3*abs(float(a[1])))
            self.assertTrue(any(origins), origins)

    def test_rail_on_springs(self):
        """Springs and their preloads are printed in the report as given; the springs carry the force of the wheel"""
        springs = dict(KY_RAIL=20000, FY_RAIL=300, KZ_RAIL=50000, FZ_RAIL=-400)
        names, sides = self.compare([dict(PLAIN, f=3, springs="20000 {s}300 50000 -400\n")])
        self.assertLessEqual({"DY_DEFL", "DZ_DEFL"}, names)
        for left, (reports, records) in enumerate(sides):
            names, words = (line.split() for line in re.search(r"MASSLESS RAIL DEFLECTION\n(.*)\n(.*)\n", reports[0]).groups())
            printed = dict(zip(names, map(float, words)))
            for name, number in springs.items():
                expected = number*(-1 if left and name == "FY_RAIL" else 1)
                self.assertAlmostEqual(printed[name], expected, delta=1e-3*abs(number))
            totals = {name: value(entry) for name, entry in records[0]["totals"].items()}
            for way in "yz":
                force = totals[f"f{way}_tr"] + printed[f"F{way.upper()}_RAIL"]
                self.assertAlmostEqual(totals[f"d{way}_defl"]*springs[f"K{way.upper()}_RAIL"], force, delta=1e-3*60000)

    def test_rolling_backwards(self):
        """The mirror image along the track: longitudinal velocities, yaw and pitch change their signs, and so do FX, MY, MZ"""
        backwards = CASE.replace("100 {s}6.5 {z} {s}0.004 {s}0.006 0.05", "100 {s}6.5 {z} {s}0.004 -{s}0.006 -0.05").replace(
            "20000 {s}17 3 {s}0.0017 {s}0.0021 -43.5", "-20000 {s}17 3 {s}0.0017 -{s}0.0021 43.5").replace(
            "0.011 {s}0.012 0.013 {s}0.0014 {s}0.0015 0.016", "-0.011 {s}0.012 0.013 {s}0.0014 -{s}0.0015 -0.016").replace(
            "1.1 {s}1.2 1.3 {s}0.014 {s}0.015 0.16\n", "-1.1 {s}1.2 1.3 {s}0.014 -{s}0.015 -0.16\n")
        odd = {"fx_tr", "fx_ws", "my_r_tr", "mz_r_tr", "my_w_ws", "mz_w_ws", "yaw_ws", "vpitch_ws", "fx", "mz", "bar_fx", "bar_mn",
               "xcp_tr", "xcp_w", "fx_rel", "cphi", "cksi"}
        for d in (2, 3, 4):
            forwards = self.run_both(dict(PLAIN, d=d))
            with unittest.mock.patch(__name__ + ".CASE", backwards):
                back = self.run_both(dict(PLAIN, d=d))
            for one, other in zip(forwards, back):
                for a, b in [(one[1][0], other[1][0]), (one[1][0]["patches"][0], other[1][0]["patches"][0])]:
                    for name, entry in a["totals"].items():
                        if name in ("force_trials", "s_ws"):
                            continue
                        expected = value(entry)*(-1 if name in odd else 1)
                        self.assertAlmostEqual(value(b["totals"][name]), expected, delta=1e-4*abs(expected) + 1e-7, msg=(d, name))

    def test_digits_of_the_curvature(self):
        """Number of decimals for four figures"""
        for curvature, text in (("2.5e-4", "2.500E-04"), ("1e-6", "1.000E-06"), ("0", "0.000"), ("9.99996e-5", "1.000E-04"),
                                ("0.125", "0.1250")):
            for track, numbers in (("-1 {s}752.0 0.3 0.025 ", "    -1.000    752.0000      0.3000      0.0250"),
                                   ("14 0 1435 0.025 ", "    14.000    1435.000      0.0250")):
                case = CASE.replace("-1 {s}752.0 0.3 0.025 {s}1e-6", track + curvature)
                text_of_case = case.format(c1=1, s="", folder=PROFILES, **dict(PLAIN, t=0, n=0, z=-100)).replace("2033", "2035")
                with open(os.path.join(self.folder, "x.inp"), "w", encoding="utf-8") as file:
                    file.write(text_of_case.replace("{s}", "") + "0\n")
                subprocess.run([PROGRAM, "--quiet", "2", "x"], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                               timeout=60)
                with open(os.path.join(self.folder, "x.out"), encoding="utf-8") as file:
                    line = re.search(r"CANT +CURV\n(.*)", file.read()).group(1)
                self.assertEqual(line, numbers + text.rjust(12))

    def test_roller(self):
        """A roller instead of a track: its names, its numbers, and the other side as a mirror image"""
        track = CASE.replace("0.3 0.025 {s}1e-6\n", "0.3 500\n").replace("20000 {s}17 3", "40 {s}17 3")
        track = track.replace("100 {s}6.5", "1.5 {s}6.5")
        with unittest.mock.patch(__name__ + ".CASE", track):
            sides = self.run_both(PLAIN, roller=True)
        for left, (reports, records) in enumerate(sides):
            self.assertIn("WHEEL-ROLLER CONTACT, " + ("LEFT" if left else "RIGHT"), reports[0])
            self.assertIn("FORCES AND MOMENTS ON ROLLER", reports[0])
            printed = {}
            for name, word in rows_of(reports[0]):
                printed.setdefault(name, float(word))
            sign = -1 if left else 1
            for name, number in (("X_WS", 1.5), ("Y_WS", 6.5*sign), ("ROLL_WS", 0.004*sign), ("YAW_WS", 0.006*sign),
                                 ("PITCH_WS", 0.05),
                                 ("VPITCH_ROL", 40), ("VY_WS", 17*sign), ("VZ_WS", 3), ("VROLL_WS", 0.0017*sign),
                                 ("VYAW_WS", 0.0021*sign), ("VPITCH_WS", -43.5), ("RAILY0", 752*sign), ("RAILZ0", 0.3)):
                self.assertAlmostEqual(printed[name], number, delta=1e-3*abs(number), msg=name)
            self.assertNotIn("S_WS", printed)
            self.assertNotIn("VX_WS", printed)
            # the moment of friction about the axis of the roller has its radius as a lever
            self.assertAlmostEqual(printed["FX(TR)"], value(records[0]["totals"]["fx_tr"]), delta=6e-4*abs(printed["FX(TR)"]) + 0.6)
        for a, b in zip(sides[0][1], sides[1][1]):
            for name, entry in a["totals"].items():
                expected = value(entry)*(-1 if name in ODD else 1)
                self.assertAlmostEqual(value(b["totals"][name]), expected, delta=1e-7*abs(expected) + 1e-12, msg=name)

    def test_places_of_the_bodies(self):
        """Rail and wheel in the track, in the HDF5 file and in the head of the .mat file: given values, and computed rotations"""
        try:
            import h5py
        except ImportError:
            self.skipTest("h5py is not installed")
        expected = {"roll_r": 0.003 - 0.025, "y_r": 752.3, "z_r": 0.4, "roll_w": 0.004 + 0.0014, "yaw_w": 0.006 + 0.0015}
        odd = ("roll_r", "y_r", "roll_w", "yaw_w", "y_w")
        found = []
        for c1, s in ((1, ""), (0, "-")):
            text = CASE.format(c1=c1, s=s, folder=PROFILES, **dict(PLAIN, a=1)).replace("2033", "2035").replace("{s}", s)
            with open(os.path.join(self.folder, "x.inp"), "w", encoding="utf-8") as file:
                file.write(text + "0\n")
            subprocess.run([PROGRAM, "--quiet", "--hdf5", "2", "x"], cwd=self.folder, check=True)
            with h5py.File(os.path.join(self.folder, "x.h5")) as file:
                markers = {name: float(item[()]) for name, item in file["case_0001/markers"].items()}
            for name, number in expected.items():
                sign = -1 if s and name in odd else 1
                # successive rotations couple roll and yaw slightly
                self.assertAlmostEqual(markers[name], sign*number, delta=2e-5 if "w" in name else 1e-9, msg=(name, s))
            with open(os.path.join(self.folder, "x.0001a.mat"), encoding="utf-8") as file:
                rows = [[float(word) for word in line.split()] for line in file if not line.startswith("%")]
            # time, x, s, y, z, roll of the rail; x, y, z, roll, yaw, pitch of the wheel in the second row
            self.assertIn(round(markers["roll_r"], 6), [round(number, 6) for number in rows[0]])
            self.assertIn(round(markers["y_r"], 3), [round(number, 3) for number in rows[0]])
            for name in ("roll_w", "yaw_w", "y_w", "z_w"):
                allowed = 1e-4*abs(markers[name]) + 1e-6
                self.assertTrue(any(abs(number - markers[name]) <= allowed for number in rows[1]), (name, rows[1]))
            found.append(markers)
        for name in found[0]:
            self.assertAlmostEqual(found[1][name], found[0][name]*(-1 if name in odd else 1), delta=1e-6, msg=name)

    def test_standing_wheel(self):
        """No motion: a rolling velocity of 0 gives no NaN"""
        standing = CASE.replace("20000 {s}17 3 {s}0.0017 {s}0.0021 -43.5", "0 0 0 0 0 0").replace(
            "{s}1.1 2.2 {s}0.0013", "0 0 0").replace("1.1 {s}1.2 1.3 {s}0.014 {s}0.015 0.16", "0 0 0 0 0 0")
        for d in (2, 3, 4):
            with unittest.mock.patch(__name__ + ".CASE", standing):
                for reports, records in self.run_both(dict(PLAIN, d=d)):
                    totals = records[0]["totals"]
                    self.assertAlmostEqual(value(totals["fz_tr"]), 60000, delta=0.06)
                    # friction at rest: the report contains numbers only, and no force is larger than friction allows
                    self.assertLess(math.hypot(value(totals["fx_tr"]), 0), 0.35*60000*1.2)
                    self.assertNotIn("NaN", reports[0])

    def test_words_of_the_problem(self):
        for step, words in ((dict(n=0, z=-2.88), "PRESCRIBED POSITION, FULL"), (dict(t=0), "PRESCRIBED VERTICAL FORCE, FULL"),
                            (dict(t=1), "SHIFT TRANSIENT, SHIFT PRESCRIBED"), (dict(t=2), "TRANSIENT ROLLING, CREEPAGE PRESCRIBED"),
                            (dict(t=3), "STEADY STATE ROLLING, CREEPAGE PRESCRIBED"), (dict(d=4), "FULL SOLUTION")):
            text = dict(PLAIN, **step)
            reports, _ = self.run_both(text)[1]
            self.assertIn(words, reports[0])
            self.assertEqual("FRICTION LAW" in reports[0], text["t"] > 0)


if __name__ == "__main__":
    unittest.main()
