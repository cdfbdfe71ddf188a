#!/usr/bin/env python3
"""Every number of the input of module 1 changes a result of a case in which it acts, alike on both sides of the track.

The names are those of the tables in doc/user/wheel_rail.md. The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import json
import math
import os
import re
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]
# Limits of iterations, the first step of a search, an extension of the grid, and a number that is documented as not used
NO_RESULT = {"MAXGS", "MAXIN", "MAXNR", "MAXOUT", "DYSTEP0", "G_MISS", "GAUGSQ"}

# Words in braces are numbers of VALUES or choices of a scene
TEXT = """1
{side}20{T}{N}{F}0
00{D}2035
0000001
999 100 30 1 EPS NPOT_MAX
0.3 0.3
0.28 0.28 82000 82000
DX DS DQREL A_SEP D_SEP D_COMB D_TURN G_MISS
{track}
'{rail}' 0 1 0
DYRAIL DZRAIL DROLLR VYRAIL VZRAIL VROLLR{springs}
FBDIST FBPOS NOMRADW YTAPE
'{wheel}' 0 1 0
{ahead} Y_WS {height} ROLL YAW PITCH
{forward} VY VZ VROLL VYAW {turning}
DXWHL DYWHL DZWHL DROLLW DYAWW DPITCHW
VXWHL VYWHL VZWHL VROLLW VYAWW VPITCHW
0
"""
# Numbers and the amounts by which they are changed
VALUES = dict(EPS=(1e-5, 1e-3), NPOT_MAX=(20000, -19900), DX=(1.0, 0.3), DS=(0.8, 0.3), DQREL=(1, 1), A_SEP=(1.5, -1.49),
              D_SEP=(8, 4), D_COMB=(4, -2), D_TURN=(12, 8), G_MISS=(-1, 1.5), GAUGHT=(14, -4), GAUGSQ=(0, 1), GAUGWD=(1435, 1),
              RAILY0=(753, 0.5), RAILZ0=(0, 0.5), CANT=(0.025, 0.01), CURV=(0, 1e-6), NOMRADR=(500, 50), DYRAIL=(0, 0.5),
              DZRAIL=(0, 0.5), DROLLR=(0, 0.003), VYRAIL=(0, 10), VZRAIL=(0, 10), VROLLR=(0, 0.1), KYRAIL=(1e4, 5e3),
              FYRAIL=(0, 1e3), KZRAIL=(1e5, 5e4), FZRAIL=(0, 1e4), FBDIST=(1360, 1), FBPOS=(-70, 0.5), NOMRADW=(460, 5),
              YTAPE=(0, 10), S_WS=(0, 40), X_WS=(0, 3), Y_WS=(1, 0.5), Z_WS=(0.25, 0.02), FZ=(6e4, 1e4), ROLL=(0, 0.002),
              YAW=(0, 0.004), PITCH=(0, 0.3), VS=(20000, 500), VY=(0, 20), VZ=(0, 20), VROLL=(0, 0.05), VYAW=(0, 0.05),
              VPITCH=(-43.4, 0.2), FX_WS=(2000, 1000), RPITCH=(40, 0.5), DXWHL=(0, 2), DYWHL=(0, 0.5), DZWHL=(0, 0.5),
              DROLLW=(0, 0.003), DYAWW=(0, 0.004), DPITCHW=(0, 0.3), VXWHL=(0, 50), VYWHL=(0, 20), VZWHL=(0, 20),
              VROLLW=(0, 0.05), VYAWW=(0, 0.05), VPITCHW=(0, 0.1))
# Positions and velocities to the right, angles and rates about x and z: opposite on the left
ODD = {"RAILY0", "CURV", "DYRAIL", "DROLLR", "VYRAIL", "VROLLR", "FYRAIL", "Y_WS", "ROLL", "YAW", "VY", "VROLL", "VYAW", "DYWHL",
       "DROLLW", "DYAWW", "VYWHL", "VROLLW", "VYAWW"}
PLAIN = dict(side=1, T=3, N=1, F=0, D=2, rail="60E1.prr", wheel="S1002.prw", track="GAUGHT GAUGSQ GAUGWD CANT CURV", ahead="S_WS",
             height="FZ", forward="VS", turning="VPITCH", springs="")
ABSOLUTE = dict(track="-1 RAILY0 RAILZ0 CANT CURV")
SLICES = dict(ABSOLUTE, rail="rail.slcs", wheel="wheel.slcw")
ROLLER = dict(side=5, track="GAUGHT GAUGSQ GAUGWD NOMRADR", ahead="X_WS", forward="RPITCH")
SPRINGS = dict(F=3, springs="\nKYRAIL FYRAIL KZRAIL FZRAIL")
# A groove along the rail: two contacts
GROOVE = dict(ABSOLUTE, rail="groove.txt")
ROLLED = dict(ROLL=0.0015)
# The case of a number where that is not the plain one, and other values of this case
SCENES = dict(RAILY0=(ABSOLUTE,), RAILZ0=(ABSOLUTE,), S_WS=(SLICES,), PITCH=(SLICES,), DPITCHW=(SLICES,), NOMRADR=(ROLLER,),
              X_WS=(ROLLER,), RPITCH=(ROLLER,), Z_WS=(dict(N=0, height="Z_WS"),), FX_WS=(dict(F=1, turning="FX_WS"),),
              DQREL=(dict(T=2),), KYRAIL=(SPRINGS,), FYRAIL=(SPRINGS,), KZRAIL=(SPRINGS,), FZRAIL=(SPRINGS,),
              D_COMB=(GROOVE, ROLLED), D_SEP=(GROOVE, ROLLED), D_TURN=(GROOVE, dict(ROLLED, D_COMB=1, D_SEP=2, D_TURN=2.5)),
              A_SEP=(GROOVE, dict(ROLLED, D_COMB=20, D_SEP=20, D_TURN=20)))


def documented():
    """Names of the tables of numbers; a row may have several"""
    with open(os.path.join(SOURCE, "doc", "user", "wheel_rail.md")) as file:
        text = file.read()
    names = set()
    for title in ("Iteration", "Search and elements", "Track and rail", "Rail on springs", "Wheelset", "Flexible wheelset"):
        part = re.search(r"\n### %s\n(.*?)(?=\n##)" % title, text, re.DOTALL).group(1)
        for row in re.findall(r"^\| ([A-Z][A-Z0-9_, ]*) \| [^|]+ \|", part, re.MULTILINE):
            names.update(row.split(", "))
    return names


def points(profile):
    """Points of a Simpack file of the examples [mm]"""
    with open(os.path.join(SOURCE, "examples", "profiles", profile)) as file:
        lines = re.search(r"point.begin\n(.*?)\n *point.end", file.read(), re.DOTALL).group(1)
    return [tuple(map(float, line.split()[:2])) for line in lines.splitlines()]


class NumbersAct(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = scratch.name
        for profile in ("60E1.prr", "S1002.prw"):
            os.symlink(os.path.join(SOURCE, "examples", "profiles", profile), os.path.join(cls.folder, profile))
        cls.slices("rail.slcs", "60E1.prr", [10.0*k for k in range(-20, 21)],
                   lambda u: (0.5*math.sin(u/40.0), 0.2*math.cos(u/30.0)))
        cls.slices("wheel.slcw", "S1002.prw", [math.pi*k/18 for k in range(-18, 19)], lambda u: (0.0, 0.3*math.cos(3.0*u - 0.5)))
        cls.table("groove.txt", [(0.1*k, (0.1*k)**2/400.0 + 0.3*math.exp(-(0.1*k/2.5)**2)) for k in range(-150, 151)])

    @classmethod
    def table(cls, name, profile):
        """A profile of two columns"""
        with open(os.path.join(cls.folder, name), "w") as file:
            file.write("".join("%.12g %.12g\n" % point for point in profile))

    @classmethod
    def slices(cls, name, profile, positions, shift):
        """Displaced copies of a profile"""
        lines = []
        for k, place in enumerate(positions):
            part, (dy, dz) = "%s_%d.txt" % (name.split(".")[0], k), shift(place)
            cls.table(part, [(y + dy, z + dz) for y, z in points(profile)])
            lines.append("%.15g '%s'\n" % (place, part))
        with open(os.path.join(cls.folder, name), "w") as file:
            file.write("0 1\n%d\n0 0 0\n1\n%s" % (len(lines), "".join(lines)))

    def solve(self, scene, values, left=False):
        """Numbers of the results of a case; values are those of a right wheel"""
        words = {**PLAIN, **scene}
        words["side"] -= left
        numbers = {**{name: value for name, (value, _) in VALUES.items()}, **values}
        text = re.sub(r"\b[A-Z][A-Z0-9_]+\b(?=[^']*(?:'[^']*'[^']*)*$)", lambda match: "%.12g" % (
            numbers[match[0]]*(-1 if left and match[0] in ODD else 1)), TEXT.format(**words))
        with open(os.path.join(self.folder, "x.inp"), "w") as file:
            file.write(text)
        done = subprocess.run([PROGRAM, "--json", "--quiet", "2", "x"], cwd=self.folder, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, text + done.stdout[-2000:] + done.stderr[-2000:])
        with open(os.path.join(self.folder, "x.jsonl")) as file:
            case = json.loads(file.readline())
        found = {}
        for place, totals in [("", case["totals"])] + [("%d " % k, patch["totals"]) for k, patch in enumerate(case["patches"])]:
            for name, value in totals.items():
                found[place + name] = value["value"] if isinstance(value, dict) else value
        return found

    def test_all_numbers_are_known(self):
        self.assertEqual(documented() - set(VALUES) - NO_RESULT, set())

    def test_each_number_acts(self):
        """On the left, values have the size of those on the right"""
        known, repeated = {}, {"s_ws", "y_ws", "roll_ws", "yaw_ws", "vpitch_ws", "force_trials"}
        for name in sorted(set(VALUES) - NO_RESULT):
            with self.subTest(name):
                scene, *values = SCENES.get(name, ({},))
                values = values[0] if values else {}
                key = repr((scene, values))
                if key not in known:
                    known[key] = self.solve(scene, values)
                first, step = VALUES[name]
                changed = {**values, name: values.get(name, first) + step}
                right, left = self.solve(scene, changed), self.solve(scene, changed, left=True)
                moved = [quantity for quantity in right if quantity not in repeated
                         and abs(right[quantity] - known[key].get(quantity, math.inf)) > 1e-9*abs(right[quantity])]
                self.assertTrue(moved)
                self.assertEqual(set(right), set(left))
                for quantity, value in right.items():
                    self.assertAlmostEqual(abs(value), abs(left[quantity]), delta=1e-9*abs(value) + 1e-9, msg=quantity)

    def test_deviation_of_pitch_adds_to_pitch(self):
        """Half of a pitch as deviation of a flexible wheelset: the same position on the wheel"""
        whole, half, none = (self.solve(SLICES, values) for values in (
            dict(PITCH=0.3), dict(PITCH=0.15, DPITCHW=0.15), dict(PITCH=0.15)))
        self.assertGreater(abs(whole["z_ws"] - none["z_ws"]), 0.01)
        for quantity, value in whole.items():
            self.assertAlmostEqual(value, half[quantity], delta=1e-9*abs(value), msg=quantity)


if __name__ == "__main__":
    unittest.main()
