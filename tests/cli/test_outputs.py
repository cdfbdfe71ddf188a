#!/usr/bin/env python3
"""Values in the files of results against their sources: bounds of tractions, times, names of files that cannot be written.

The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]
LAYER = """3
203100
022420
0001501
999 100 30 1 1e-7
{load} -0.002 0.0003 0.0001
0.3 0.3
0 0.25 1000
0.28 0.28 82000 82000
4000 0.02 {limit} {slope}
1
16 18 -2.0 -2.25 0.25 0.25
1 1
0.01 0 0.01 0 0 0
0
"""


class Outputs(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def run_text(self, text, *options):
        with open(os.path.join(self.folder, "x.inp"), "w", encoding="utf-8") as file:
            file.write(text)
        self.run = subprocess.run([PROGRAM, "--quiet", *options, "2", "x"], cwd=self.folder, stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True, timeout=120)
        with open(os.path.join(self.folder, "x.out"), encoding="utf-8") as file:
            return file.read()

    def elements(self, number=1):
        """Columns of a .mat file by their names"""
        with open(os.path.join(self.folder, f"x.{number:04d}.mat"), encoding="utf-8") as file:
            lines = file.read().splitlines()
        names = lines[12].replace("%", " ").split()
        return [dict(zip(names, map(float, line.split()))) for line in lines[13:]]

    def test_bound_of_an_interfacial_layer(self):
        """Tractions are limited by friction or by the yield limit, whichever is less; both occur"""
        for limit, slope in ((60.0, 0.0), (60.0, 3000.0)):
            self.run_text(LAYER.format(load=2000, limit=limit, slope=slope).replace("0001501", "0011501"))
            rows = [row for row in self.elements() if row["IGS"] > 0]
            states = {row["IGS"] for row in rows}
            self.assertTrue({2, 3} <= states, states)
            for row in rows:
                bound = min(0.3*row["PN"], row["TAUCRT"])
                self.assertAlmostEqual(row["MU"], 0.3)
                self.assertGreaterEqual(row["TAUCRT"], limit*(1 - 1e-6))
                self.assertLessEqual((row["PX"]**2 + row["PY"]**2)**0.5, bound*(1 + 1e-4) + 1e-3)

    def test_table_of_elements(self):
        """The table of the .out file, column by column from the .mat file and from geometry"""
        out = self.run_text(LAYER.format(load=2000, limit=60.0, slope=0.0).replace("0001501", "0011651"))
        elements = {int(row["I"]): row for row in self.elements()}
        approach = float(re.search(r"APPROACH +PMAX.*\n +(.*)", out).group(1).split()[3])
        found, iy = 0, 0
        for line in out[out.index("H-PEN        PN      TRCBND"):].splitlines()[1:]:
            row = re.match(r" Y = +(\S+) +ROW +(\d+) OF", line)
            if row:
                iy = int(row.group(2))
                self.assertAlmostEqual(float(row.group(1)), -2.25 + 0.25*(iy - 0.5), places=4)
                continue
            words = line.split()
            if line.startswith((" Parallel", " Time", "|")):
                break
            if len(words) != 9:
                continue
            # with the blanks at the end, as in published outputs
            self.assertEqual(len(line), 102, line)
            x, gap, pn, bound, size, direction, slip, rigid_x, rigid_y = map(float, words)
            ix = round((x + 2.0)/0.25 + 0.5)
            self.assertAlmostEqual(x, -2.0 + 0.25*(ix - 0.5), places=4)
            element = elements.get(ix + 16*(iy - 1))
            y = -2.25 + 0.25*(iy - 0.5)
            self.assertAlmostEqual(gap, 0.01*(x*x + y*y) - approach, delta=2e-4)
            # creepages -0.002 and 0.0003 with spin 0.0001
            self.assertAlmostEqual(rigid_x, -0.002 - 0.0001*y, delta=6e-6)
            self.assertAlmostEqual(rigid_y, 0.0003 + 0.0001*x, delta=6e-6)
            if element is None or element["IGS"] == 0:
                self.assertEqual((pn, bound, size, slip), (0, 0, 0, 0), line)
                continue
            found += 1
            traction = (element["PX"]**2 + element["PY"]**2)**0.5
            for value, expected in ((pn, element["PN"]), (bound, min(0.3*element["PN"], element["TAUCRT"])), (size, traction),
                                    (slip, element["SREL"])):
                self.assertAlmostEqual(value, expected, delta=5.1e-3*abs(expected) + 1e-9, msg=line)
            if traction > 1e-3:
                angle = math.degrees(math.atan2(element["PY"], element["PX"]))
                self.assertLess(abs((direction - angle + 180) % 360 - 180), 0.15, line)
        self.assertEqual(found, sum(row["IGS"] > 0 for row in elements.values()))

    def test_rigid_slip_of_forces(self):
        """With prescribed forces, the rigid slip is that of the computed creepages"""
        for digits, motion in (("203110", "0.4 0.0003 0.0001"), ("203120", "0.4 -0.3 0.0001"), ("202120", "0.4 -0.3 0.0001"),
                               ("203120", "-0.2 0.5 -0.0003")):
            text = LAYER.format(load=2000, limit=60.0, slope=0.0).replace("203100", digits).replace("-0.002 0.0003 0.0001", motion)
            text = text.replace("022420", "022020").replace("4000 0.02 60.0 0.0\n", "")
            out = self.run_text(text.replace("0001501", "0011651"), "--json")
            with open(os.path.join(self.folder, "x.jsonl"), encoding="utf-8") as file:
                totals = json.loads(file.readline())["patches"][0]["totals"]
            cksi, ceta = totals["cksi"]["value"], totals["ceta"]["value"]
            spin = float(motion.split()[2])
            # slip is that of a step, at most half an element away; three digits are printed
            tolerance = abs(spin)*0.5*0.25 + 5e-3*(abs(cksi) + abs(ceta))
            y, count = 0.0, 0
            for line in out[out.index("H-PEN        PN      TRCBND"):].splitlines()[1:]:
                row = re.match(r" Y = +(\S+) +ROW", line)
                if row:
                    y = float(row.group(1))
                elif re.fullmatch(r"[ \d.E+-]+", line) and len(line.split()) == 9:
                    x, slip_x, slip_y = (float(line.split()[k]) for k in (0, 7, 8))
                    count += 1
                    self.assertAlmostEqual(slip_x, cksi - spin*y, delta=tolerance)
                    self.assertAlmostEqual(slip_y, ceta + spin*x, delta=tolerance)
            self.assertGreater(count, 100)

    def test_picture(self):
        """The picture of the contact, character by character from the .mat file: windows, numbers of columns, wide and narrow"""
        case = ("3\n203100\n022020\n0002301\n999 100 30 1 1e-5\n{load} 0.001 0.0004 0\n0.3 0.3\n{chi} {dx} 1000\n"
                "0.28 0.28 82000 82000\n1\n{mx} {my} {x} {y} {dx} {dy}\n1 1\n{b} 0 0.01 0 0 0\n")
        # contact nearly everywhere or in the middle; up to 46 columns have a blank before each, from 10 and 200 on a digit more
        for mx, my, x, dx, dy, chi in ((9, 9, -0.9, 0.2, 0.2, 0), (12, 30, -2.4, 0.4, 0.3, "180d"), (46, 9, -1.0, 0.0435, 0.2, 0),
                                       (47, 9, -1.0, 0.0426, 0.2, 0), (60, 12, -3.0, 0.1, 0.3, 0), (210, 7, -1.0, 0.0095, 0.25, 0),
                                       (199, 7, -1.0, 0.01, 0.25, 0), (120, 7, -1.0, 0.01, 0.25, 0), (8, 8, 5.0, 0.2, 0.2, 0),
                                       (30, 8, 5.0, 0.2, 0.2, 0)):
            load = 0.005 if x > 0 else 400
            text = case.format(load=load, chi=chi, dx=dx, dy=dy, mx=mx, my=my, x=x, y=-0.5*my*dy, b=0.01)
            out = self.run_text((text.replace("203100", "203000") if x > 0 else text) + "0\n")
            states = [int(row["IGS"]) for row in self.elements()]
            columns = [ix for ix in range(mx) if any(states[ix::mx])]
            rows = [iy for iy in range(my) if any(states[iy*mx:(iy + 1)*mx])]

            def window(touched, size):
                if not touched:
                    middle = (size + 1)//2 - 1
                    return max(0, middle - 5), min(size - 1, middle + 5)
                if touched[0] < 5 and touched[-1] >= size - 5:
                    return 0, size - 1
                return max(0, touched[0] - 1), min(size - 1, touched[-1] + 1)

            (x0, x1), (y0, y1) = window(columns, mx), window(rows, my)
            gap = " " if x1 - x0 + 1 <= 46 else ""
            expected = []
            for iy in range(y1, y0 - 1, -1):
                marks = [".*S|"[states[ix + mx*iy]] for ix in range(x0, x1 + 1)]
                if iy in (y0, y1):
                    for end in (0, -1):
                        marks[end] = "o" if marks[end] == "." else marks[end]
                expected.append(f"{iy + 1:6d}  " + "".join(gap + mark for mark in marks))
            for unit in (100, 10, 1):
                if x1 - x0 + 1 >= {1: 1, 10: 10, 100: 200}[unit]:
                    numbers = "".join(gap + (str(ix//unit % 10) if ix % unit == 0 else " ") for ix in range(x0 + 1, x1 + 2))
                    expected.append(("        " + numbers).rstrip())
            expected.append("     X  -->        Chi=%6.2f degrees" % (180 if chi else 0))
            shown = out.split("ADHESION AND SLIP-AREA`S:\n")[1].split("\n")[:len(expected)]
            self.assertEqual([line.rstrip() for line in shown], expected, (mx, my))

    def test_times(self):
        """The table of times: parts are within the whole, the whole is within the elapsed time"""
        text = LAYER.format(load=2000, limit=60.0, slope=0.0).replace("16 18 -2.0 -2.25 0.25 0.25",
                                                                      "160 180 -2.0 -2.25 0.025 0.025")
        started = time.monotonic()
        out = self.run_text(text.replace("0 0.25 1000", "0 0.025 1000"))
        waited = time.monotonic() - started
        rows = {name.strip(): (int(calls), float(processor), float(elapsed))
                for name, calls, processor, elapsed in re.findall(r"^\|([^|]+)\| +(\d+) \| +([\d.]+) \| +[\d.]+ \| +([\d.]+) \|",
                                                                  out, re.MULTILINE)}
        self.assertLessEqual({"Total", "Reading input", "Solving cases", "Writing results"}, set(rows))
        self.assertLessEqual(rows["Total"][2], waited + 0.1)
        self.assertGreaterEqual(rows["Total"][2], 0.3*waited - 0.1)
        self.assertLessEqual(sum(rows[name][2] for name in rows if name != "Total"), rows["Total"][2] + 0.2)
        self.assertEqual(rows["Solving cases"][0], 1)

    def test_a_file_that_cannot_be_written_is_named(self):
        stresses = LAYER.format(load=2000, limit=0.0, slope=0.0).replace("203100", "203103").replace("0.01 0 0.01 0 0 0\n",
            "0.01 0 0.01 0 0 0\n1 1\n1\n2 0 0.5\n0\n")
        os.mkdir(os.path.join(self.folder, "x.0001.subs"))
        self.run_text(stresses)
        self.assertEqual(self.run.returncode, 1)
        self.assertIn(".subs", self.run.stderr)
        self.assertIn("writing the .subs file", self.run.stderr)

    def test_each_kind_of_file_is_named(self):
        """A folder has the name of a file: the error gives the name, and the operation"""
        text = LAYER.format(load=2000, limit=0.0, slope=0.0).replace("0001501", "0011501")
        for name, options in (("x.0001.mat", ()), ("x.out", ()), ("x.jsonl", ("--json",)), ("x.h5", ("--hdf5",))):
            place = os.path.join(self.folder, name)
            for left in os.listdir(self.folder):
                os.remove(os.path.join(self.folder, left))
            os.mkdir(place)
            with open(os.path.join(self.folder, "x.inp"), "w", encoding="utf-8") as file:
                file.write(text)
            run = subprocess.run([PROGRAM, "--quiet", *options, "2", "x"], cwd=self.folder, stdin=subprocess.DEVNULL,
                                 capture_output=True, text=True, timeout=120)
            self.assertEqual(run.returncode, 1, name)
            self.assertIn(name, run.stderr)
            if name.endswith(".mat"):
                self.assertIn("writing the .mat file", run.stderr)
            os.rmdir(place)

    def test_where_contact_angles_are_taken(self):
        """--contact-angle accepts two words only"""
        for option, status in ((["--contact-angle=contact"], 0), (["--contact-angle", "established"], 0),
                               (["--contact-angle=there"], 2),
                               (["--contact-angle="], 2)):
            run = subprocess.run([PROGRAM, "--quiet", "--output-dir", self.folder, *option, "3", os.path.join(SOURCE, "examples",
                "manchester")],
                                 cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60)
            self.assertEqual(run.returncode == 0, status == 0, (option, run.stderr))
            if status:
                self.assertIn("contact", run.stderr)
                self.assertIn("established", run.stderr)

    def test_a_page_is_whole_or_not_there(self):
        """A file with the name of a page is kept until the new page is complete"""
        sys.path.insert(0, os.path.join(SOURCE, "python"))
        try:
            from contact.report import page
        except ImportError as reason:
            self.skipTest(str(reason))
        self.run_text(LAYER.format(load=2000, limit=0.0, slope=0.0), "--hdf5")
        target = os.path.join(self.folder, "x.html")
        with open(target, "w", encoding="utf-8") as file:
            file.write("old")

        def refuse(*_):
            raise OSError("no")
        with unittest.mock.patch.object(page.os, "replace", refuse), self.assertRaises(OSError):
            page.write_page(os.path.join(self.folder, "x.h5"))
        with open(target, encoding="utf-8") as file:
            self.assertEqual(file.read(), "old")
        self.assertEqual(page.write_page(os.path.join(self.folder, "x.h5")), target)
        with open(target, encoding="utf-8") as file:
            text = file.read()
        self.assertTrue(text.rstrip().endswith("</html>"))
        self.assertGreater(len(text), 20000)
        self.assertEqual([name for name in os.listdir(self.folder) if name.endswith(".tmp")], [])

    def test_control_characters_are_not_echoed(self):
        """A message about a word contains none of its control characters"""
        for word in ("\x01\x02bad", "b\x1b[31mad", "bad\x7f"):
            self.run_text(LAYER.format(load=2000, limit=0.0, slope=0.0).replace("999 100", word + " 100"))
            self.assertEqual(self.run.returncode, 1)
            self.assertIn("ad", self.run.stderr)
            self.assertFalse(re.search(r"[\x00-\x08\x0b-\x1f\x7f]", self.run.stderr), repr(self.run.stderr))


if __name__ == "__main__":
    sys.exit(unittest.main())
