#!/usr/bin/env python3
"""The .mat files of wheel on rail: both sides of a mirrored problem, several patches, friction that varies over the rail.

The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import os
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
PROFILES = os.path.join(os.environ["CONTACT_SOURCE"], "examples", "profiles")

CASE = """
1
{c1}203100
{v}0{d}2033
0002201
999 100 30 1 1e-5
{friction}
0.28 0.28 82000 82000
0.5 0.5 1 90d {separate} {combine}
-1 {rail_y} 0 {cant}
'{folder}/{rail}' 0 1 0
{s}0.3 0.1 {s}{roll} 0 0 0
{back}
'{folder}/{wheel}' 0 1 0 {mirror_z}
100 {s}{y} {force} {s}{roll} {s}0.006 0.05
20000 0 0 0 0 -43.5
"""
FLANGE = dict(rail="60E1.prr", wheel="S1002.prw", mirror_z=0, back="1360 -70 460", rail_y=752.0,
              cant=0.025, roll=0.003, y=6.5, force=60000, separate=8, combine=4)
GROOVE = dict(rail="groove.txt", wheel="roller.txt", mirror_z=-1, back="0 0 460", rail_y=0.0,
              cant=0, roll=0.0005, y=0.2, force=4000, separate=1, combine=0.5)
CONSTANT = dict(v=0, friction="0.4 0.4")
BY_ANGLE = dict(v=1, friction="2\n-90d 0.1 0.1\n90d 0.5 0.5")

ODD_REFERENCE = (1, 3, 5)  # indices of values that change their signs: Y_CP(R), DELT_CP(R), Y_CP(W)


def rows(path):
    with open(path, encoding="ascii") as file:
        return [[float(word) for word in line.split()] for line in file if not line.startswith("%")]


class PairMat(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def tables(self, d, friction, shape):
        """Rows of all patches, for the right and for the left side"""
        text = ""
        for c1, s in ((1, ""), (0, "-")):
            values = dict(shape, **friction)
            values["rail_y"] = s + str(values["rail_y"])
            text += CASE.format(c1=c1, s=s, d=d, folder=PROFILES, **values)
        with open(os.path.join(self.folder, "t.inp"), "w", encoding="ascii") as file:
            file.write(text + "0\n")
        run = subprocess.run([PROGRAM, "--quiet", "2", "t"], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                             text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr[-2000:])
        sides = []
        for case in (1, 2):
            names = sorted(name for name in os.listdir(self.folder) if name.startswith("t.%04d" % case))
            self.assertEqual(names, ["t.%04d%s.mat" % (case, "abc"[k]) for k in range(len(names))])
            sides.append([rows(os.path.join(self.folder, name)) for name in names])
        return sides

    def mirrored(self, right, left, patches):
        self.assertEqual((len(right), len(left)), (patches, patches))
        for k, (r, m) in enumerate(zip(right, left)):
            self.assertEqual([row[7:9] for row in (r[2], m[2])], [[patches, k + 1]] * 2)
            mx, my = int(r[3][0]), int(r[3][1])
            # rail: y and roll change signs; wheel: y, roll, yaw; the contact reference: y, angle, y
            for line, odd in ((0, (3, 5)), (1, (1, 3, 4)), (2, ODD_REFERENCE)):
                for i, (a, b) in enumerate(zip(r[line], m[line])):
                    self.assertAlmostEqual(a, -b if i in odd else b, delta=1e-5 * abs(a) + 1e-9,
                                           msg="line %d, value %d" % (line, i))
            self.assertAlmostEqual(m[3][3], -(r[3][3] + my * r[3][5]), delta=1e-4)
            self.assertEqual([r[3][8], m[3][8]], [1, 0])
            self.assertEqual(r[3][:3] + r[3][4:8] + r[3][9:], m[3][:3] + m[3][4:8] + m[3][9:])
            self.assertEqual(r[4:5], m[4:5])
            self.assertEqual([row[0] for row in m[6:]], list(range(1, mx * my + 1)))
            self.assertEqual(min(row[2] for row in r[6:]), 0.0)
            for number, row in enumerate(m[6:]):
                iy, ix = divmod(number, mx)
                other = r[6 + ix + mx * (my - 1 - iy)]
                self.assertEqual(row[1], other[1])
                for i in range(2, 11):
                    self.assertAlmostEqual(row[i], -other[i] if i in (6, 9) else other[i], delta=1e-4 * abs(row[i]) + 1e-7)

    def test_one_patch(self):
        right, left = self.tables(2, CONSTANT, FLANGE)
        self.mirrored(right, left, 1)
        self.assertEqual(right[0][5][3:5], [0.4, 0.4])
        self.assertEqual(right[0][5], left[0][5])

    def test_two_patches_with_friction_by_angle(self):
        right, left = self.tables(2, BY_ANGLE, GROOVE)
        self.mirrored(right, left, 2)
        for side in (right, left):
            for patch in side:
                # the first set; the friction at its position is that of its elements
                self.assertAlmostEqual(patch[5][3], 0.1, delta=1e-6)
                self.assertGreater(patch[6][3], 0.11)

    def test_rows_of_a_curved_patch(self):
        right, left = self.tables(4, BY_ANGLE, FLANGE)
        self.mirrored(right, left, 1)


if __name__ == "__main__":
    unittest.main(verbosity=1)
