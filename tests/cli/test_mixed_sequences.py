#!/usr/bin/env python3
"""Random sequences in which every case chooses its motion, law of friction, material, solver and what it keeps.

Fields of each case are judged by plain sums over influence coefficients (tests/campaign/elastic.py, written without the program):
gap, slip and friction with the tractions that P says the previous case has left. The same sequence with all numbers written out in
each case, and translated to the readable format, must give the same fields. Totals that Python reads from the .out file are
those of the JSON file.

Skipped (exit status 77) without h5py. The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import copy
import json
import math
import os
import random
import subprocess
import sys
import tempfile
import unittest

import numpy as np

try:
    import h5py
except ImportError:
    sys.exit(77)

sys.path[:0] = [os.path.join(os.environ["CONTACT_SOURCE"], *folder) for folder in (("tests", "campaign"), ("python",))]
import contact
import elastic

PROGRAM = os.environ["CONTACT_PROGRAM"]
EPS = 1e-8
# Residuals are within EPS of the program's scales, which differ from those of this file; laws of friction end at 1e-3
TOLERANCE, OF_LAWS = 100*EPS, 3e-3
SEEDS = range(1, 25)


def numbers(*values):
    return " ".join(str(v) if isinstance(v, int) else repr(float(v)) for v in values)


class Sequence:
    """Cases of a sequence: each has its digits, its load, and a copy of all numbers in store"""

    def __init__(self, seed):
        self.rng = rng = random.Random(seed)
        self.a = 10**rng.uniform(-1, 1.5)
        self.b = self.a*10**rng.uniform(-0.6, 0.6)
        self.curvature = 10**rng.uniform(-3, -2)/self.a
        self.pen = 0.8*self.curvature*self.a**2
        self.g = 10**rng.uniform(0, 5)
        self.sides = rng.choice([1, 7, 9, 11]), rng.choice([5, 6, 8])
        self.cases, self.store = [], {}
        for _ in range(rng.randint(2, 6)):
            self.add()

    def add(self):
        rng, store, first = self.rng, self.store, not self.cases
        c = {"T": rng.choice([0, 1, 1, 2, 2, 3, 3]), "N": rng.choice([0, 1]), "M": rng.choice([0, 0, 0, 4])}
        c["F"] = rng.choice([0, 0, 0, 1, 2]) if c["T"] else 0
        c["P"], c["I"] = (2, 0) if first else (rng.choice([0, 0, 0, 1, 2, 3]), rng.choice([0, 1, 2, 3]))
        c["G"] = 0 if first else rng.choice([0, 1, 1, 4])
        self.cases.append(c)
        self.choose_grid(c, first)
        self.choose_material(c, first)
        self.choose_geometry(c, first)
        self.choose_friction(c, first)
        self.choose_motion(c)
        c["store"] = copy.deepcopy(store)

    def choose_grid(self, c, first):
        c["D"] = 2 if first or self.rng.random() < 0.3 else self.rng.choice([0, 1])
        if c["D"] != 2:
            return
        mx, my = self.sides
        dx, dy = 2.6*self.a/mx, 2.6*self.b/my
        # the window of a later case is larger or smaller on some sides
        west, east, south, north = (0 if first or mx == 1 else self.rng.randint(0, 2) for _ in range(4))
        self.store["grid"] = (mx + west + east, my + south + north, -1.3*self.a - west*dx, -1.3*self.b - south*dy, dx, dy)

    def choose_material(self, c, first):
        rng, store, rolls = self.rng, self.store, c["T"] >= 2
        new = first or rng.random() < 0.4 or (rolls and "rolling" not in store) or rolls != store.get("rolled")
        new = new or (c["M"] == 4 and "layer" not in store)
        if rolls and "rolling" in store and (c["T"] == 3 or c["M"] == 4):
            # these roll along x by one element
            new = new or abs(math.sin(store["rolling"][0])) > 1e-9 or store["rolling"][1] != store["grid"][4]
        c["C"] = rng.choice([2, 2, 3]) if new else 1 if c["D"] else rng.choice([0, 1])
        if new:
            store["C"] = c["C"]
            if first or rng.random() < 0.7:
                g, nu = self.g*rng.uniform(0.5, 2), rng.choice([0.0, 0.28, 0.5])
                store["material"] = (nu, nu, g, g) if rng.random() < 0.5 else (nu, rng.uniform(0, 0.5), g, g*rng.uniform(0.3, 3))
            if rolls:
                general = c["T"] == 2 and c["M"] == 0
                chi = rng.uniform(-3, 3) if general and rng.random() < 0.3 else rng.choice([0.0, math.pi])
                step = rng.choice([1, rng.uniform(0.2, 1)]) if general else 1
                store["rolling"] = (chi, store["grid"][4]*step, 10**rng.uniform(0, 4))
            if c["M"] == 4:
                store["layer"] = (self.g*rng.uniform(0.05, 1), self.a*rng.choice([0, 0.01, 0.1]), 0.0, 0.0)
        if not rolls:
            store.pop("rolling", None)
        store["rolled"] = rolls

    def choose_geometry(self, c, first):
        rng = self.rng
        c["Z"] = 2 if first or rng.random() < 0.25 else 1 if c["D"] else rng.choice([0, 1])
        if c["Z"] == 2:
            k = self.curvature*rng.uniform(0.8, 1.2)
            slope = self.a/self.b
            self.store["gap"] = (k, rng.choice([0, 0.3])*k*slope, k*slope**2, rng.uniform(-0.3, 0.3)*k*self.a,
                                 rng.uniform(-0.3, 0.3)*k*self.a*slope, rng.choice([0, self.pen*rng.uniform(-1, 1)]))

    def choose_friction(self, c, first):
        rng, store = self.rng, self.store
        c["L"] = rng.choice([0, 0, 2, 3, 4]) if first or rng.random() < 0.3 else 1
        if c["L"] == 1:
            return
        mu, speed = rng.uniform(0.1, 0.6), max(1e-4, 10**rng.uniform(-2, 2)*self.pen/self.a*store.get("rolling", (0, 0, self.a))[2])
        store["law"] = c["L"]
        store["friction"] = [(mu, mu)] if c["L"] == 0 else \
            [(mu, rng.uniform(0, 0.2), speed, rng.choice([0, 0.05]), 10*speed), rng.choice([(0.0, 1.0), (self.a*0.1, speed)])]

    def choose_motion(self, c):
        rng, store, length = self.rng, self.store, self.a if c["T"] == 1 else 1
        mx, my = store["grid"][:2]
        size = 0.3*self.pen/self.a*length
        c["E"] = 0
        if c["T"]:
            c["E"] = rng.choice([0, 0, 0, 0, 2, 3, 9, 1])
        kept = len(self.cases) > 1 and self.cases[-2]["E"] in (1, 9) and len(store["extra"]) == mx*my
        if c["E"] == 1 and not (kept and c["D"] == 0):
            c["E"] = 0
        if c["E"] == 9:
            store["extra"] = [(size*rng.uniform(-1, 1), size*rng.uniform(-1, 1)) for _ in range(mx*my)]
        g = elastic.combined(store["material"][2:], store["material"][:2])[0]
        lowest = self.gap(store).min()
        c["load"] = g*math.sqrt(self.a*self.b)*self.pen*rng.uniform(0.3, 2) if c["N"] else lowest + self.pen*rng.uniform(0.1, 1.2)
        if rng.random() < 0.07:
            # contact is lost
            c["N"], c["load"] = 0, lowest - 0.3*self.pen
        size *= 10**rng.uniform(-1.5, 0.7)
        c["x"], c["y"], c["spin"] = (rng.choice([0, size*rng.uniform(-1, 1)]) for _ in range(3))
        c["spin"] /= self.a
        if c["F"]:
            c["x"] = rng.uniform(-0.6, 0.6)
        if c["F"] == 2:
            c["y"] = rng.uniform(-0.6, 0.6)
        c["centre"] = (rng.uniform(-1, 1)*self.a, rng.uniform(-1, 1)*self.b) if rng.random() < 0.2 else ()

    @staticmethod
    def places(store):
        mx, my, xl, yl, dx, dy = store["grid"]
        return np.meshgrid(xl + (np.arange(mx) + 0.5)*dx, yl + (np.arange(my) + 0.5)*dy)

    def gap(self, store):
        x, y = self.places(store)
        b = store["gap"]
        return b[0]*x*x + b[1]*x*y + b[2]*y*y + b[3]*x + b[4]*y + b[5]

    def text(self, complete=False):
        """The input; complete: all cases give all numbers"""
        lines = []
        for c in self.cases:
            s = c["store"]
            d = dict(c, L=s["law"], D=2, C=s["C"], Z=2, E=9 if c["E"] == 1 else c["E"], G=c["G"] if c["G"] != 1 else 0) \
                if complete else c
            lines += ["3", f"{c['P']}0{c['T']}{c['N']}{c['F']}0", "0{L}{D}{C}{M}{Z}{E} 0".format(**d), f"0{d['G']}{c['I']}0201"]
            if d["G"] != 1:
                lines.append(f"9999 300 100 30 {EPS}")
            if d["G"] == 4:
                lines.append("1 1.0")
            lines.append(numbers(c["load"], c["x"], c["y"], c["spin"], *c["centre"]))
            if d["L"] != 1:
                lines += [numbers(*row) for row in s["friction"]]
            if d["C"] >= 2:
                lines += [numbers(*s["rolling"])] if c["T"] >= 2 else []
                lines.append(numbers(*s["material"]))
                lines += [numbers(*s["layer"])] if c["M"] == 4 else []
            if d["D"] == 2:
                lines += ["1", numbers(*s["grid"])]
            if d["Z"] == 2:
                lines += ["1 1", numbers(*s["gap"])]
            if d["E"] == 9:
                lines += [numbers(*pair) for pair in s["extra"]]
        return "\n".join(lines + ["0", ""])


def on_grid(field, old, new):
    """A field of one window in another one of the same elements, zero outside"""
    result = np.zeros((new[1], new[0]))
    kx, ky = round((new[2] - old[2])/new[4]), round((new[3] - old[3])/new[5])
    for iy in range(max(0, -ky), min(new[1], old[1] - ky)):
        for ix in range(max(0, -kx), min(new[0], old[0] - kx)):
            result[iy, ix] = field[iy + ky, ix + kx]
    return result


def law_of(store, speed):
    k, f1, s1, f2, s2 = store["friction"][0]
    if store["law"] == 2:
        return k + f1*np.maximum(0, 1 - speed/(2*s1)) + f2*np.maximum(0, 1 - speed/(2*s2))
    if store["law"] == 3:
        return k + f1/(1 + speed/s1) + f2/(1 + (speed/s2)**2)
    return k + f1*2**(-speed/s1) + f2*2**(-speed/s2)


class MixedSequences(unittest.TestCase):
    def solve(self, text, name="x"):
        """Records and fields of all cases"""
        if text:
            with open(os.path.join(self.folder, name + ".inp"), "w", encoding="utf-8") as file:
                file.write(text)
        run = subprocess.run([PROGRAM, "--quiet", "--json", "--hdf5", "2", name], cwd=self.folder, stdin=subprocess.DEVNULL,
                             capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(os.path.join(self.folder, name + ".jsonl"), encoding="utf-8") as file:
            records = [case for case in map(json.loads, file) if case["case"]]
        with h5py.File(os.path.join(self.folder, name + ".h5")) as file:
            fields = [{key: value[()] for key, value in file[f"case_{k + 1:04d}/patch_1/fields"].items()}
                      for k in range(len(records))]
        return records, fields

    def test_all(self):
        for seed in SEEDS:
            with self.subTest(seed=seed), tempfile.TemporaryDirectory() as self.folder:
                sequence = Sequence(seed)
                records, fields = self.solve(sequence.text())
                self.assertEqual(len(records), len(sequence.cases))
                self.judge(sequence, records, fields)
                self.printed(records)
                self.same(records, fields, *self.solve(sequence.text(complete=True), "complete"))
                subprocess.run([PROGRAM, "convert", "x.inp"], cwd=self.folder, check=True, capture_output=True)
                os.rename(os.path.join(self.folder, "x.toml"), os.path.join(self.folder, "readable.toml"))
                self.same(records, fields, *self.solve("", "readable"))

    def printed(self, records):
        """Totals of the .out file, which has four figures"""
        for record, case in zip(records, contact.load(os.path.join(self.folder, "x.out")), strict=True):
            totals = record["patches"][0]["totals"]
            for name, found in case.patch.totals().items():
                value = totals.get(name)
                value = value["value"] if isinstance(value, dict) else value
                # values below the tolerance are printed as zero
                if value is not None and abs(found) > 0:
                    self.assertLess(abs(found - value), 6e-4*abs(value), f"{name} of case {record['case']}")

    def same(self, records, fields, other_records, other_fields):
        for k, (one, two) in enumerate(zip(fields, other_fields)):
            self.assertEqual(records[k]["status"], other_records[k]["status"])
            if records[k]["status"] != "solved":
                # what follows starts from another state
                return
            for name in ("pn", "px", "py"):
                if name in one:
                    size = np.abs(one["pn"]).max() + 1e-300
                    self.assertLess(np.abs(one[name] - two[name]).max()/size, 1e-5, f"{name} of case {k + 1}")

    def judge(self, sequence, records, fields):
        last = previous = None
        for k, (c, record, f) in enumerate(zip(sequence.cases, records, fields), start=1):
            store = c["store"]
            zero = np.zeros_like(f["pn"])
            now = [f.get(name, zero) for name in ("px", "py", "pn")]
            source = {0: last, 1: last, 2: None, 3: previous}[c["P"]]
            before = [zero]*3 if source is None else [on_grid(field, source[1], store["grid"]) for field in source[0]]
            if c["P"] == 1:
                before[:2] = zero, zero
            last = now, store["grid"]
            # steady tractions are those of the previous time, too
            previous = last if c["T"] == 3 else (before, store["grid"])
            if record["status"] == "solved":
                totals = {name: value["value"] if isinstance(value, dict) else value
                          for name, value in record["patches"][0]["totals"].items()}
                self.judge_case(sequence, c, f, totals, now, before, f"case {k}")

    def judge_case(self, sequence, c, f, totals, now, before, where):
        store, inside = c["store"], f["eldiv"] > 0
        mx, my, _, _, dx, dy = store["grid"]
        spaces = elastic.HalfSpaces(store["material"][2:], store["material"][:2], mx, my, dx, dy, hats=store["C"] == 3)
        gap = sequence.gap(store) - totals["pen"] + spaces.displacement("n", *now)
        self.assertGreaterEqual(gap[~inside].min(initial=0)/sequence.pen, -TOLERANCE, where)
        if c["N"]:
            self.assertAlmostEqual(now[2].sum()*dx*dy/c["load"], 1, 9, where)
        if not inside.any():
            return
        self.assertLess(np.abs(gap[inside]).max()/sequence.pen, TOLERANCE, where)
        if c["T"] == 0:
            return
        step, speed, ahead, layer = 1.0, 1.0, (0.0, 0.0), 0.0
        x, y = sequence.places(store)
        xo, yo = c["centre"] or (0.0, 0.0)
        cksi, ceta = (totals["cksi"], totals["ceta"]) if c["T"] >= 2 else (totals["shift_x"], totals["shift_y"])
        if c["T"] >= 2:
            chi, step, speed = store["rolling"]
            ahead = step*math.cos(chi), step*math.sin(chi) if abs(math.sin(chi)) > 1e-9 else 0.0
            xo, yo = xo - ahead[0]/6, yo - ahead[1]/6
        if c["M"] == 4 and store["layer"][1] > 0:
            layer = store["layer"][1]/store["layer"][0]
        rigid = [cksi - (c["E"] != 3)*c["spin"]*(y - yo), ceta + (c["E"] != 2)*c["spin"]*(x - xo)]
        if c["E"] in (1, 9):
            extra = np.array(store["extra"]).reshape(my, mx, 2)
            rigid = [rigid[0] + extra[:, :, 0], rigid[1] + extra[:, :, 1]]
        old = now if c["T"] == 3 else before
        slip = []
        for i in (0, 1):
            was = elastic.shifted(old[i], round(ahead[0]/dx), 0) if c["T"] >= 2 else old[i]
            slip.append(rigid[i]*step + spaces.displacement("xy"[i], *now) - spaces.displacement("xy"[i], *old, ahead=ahead)
                        + layer*(now[i] - was))
        bound = f["mu"]*now[2]
        stiffness = 1/(spaces.centre("xx") + layer)
        trial = [now[i] - stiffness*slip[i] for i in (0, 1)]
        share = np.minimum(1, bound/np.maximum(np.hypot(*trial), 1e-300))
        wrong = np.hypot(now[0] - share*trial[0], now[1] - share*trial[1])
        self.assertLess(wrong[inside].max()/bound.max(), TOLERANCE, where)
        if store["law"] == 0:
            self.assertEqual(np.abs(f["mu"] - store["friction"][0][0])[inside].max(), 0, where)
        elif store["friction"][1][0] == 0:
            mu = law_of(store, np.hypot(*slip)/step*speed)
            self.assertLess(np.abs(f["mu"]/mu - 1)[inside].max(), OF_LAWS, where)


if __name__ == "__main__":
    unittest.main()
