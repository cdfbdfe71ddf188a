#!/usr/bin/env python3
"""Contact problems with numbers at and between both ends of their bounds: no NaN in a result, no hang, no crash.

usage: extremes.py [COUNT [SEED]]    default 150 cases, seed 1
The environment gives CONTACT_PROGRAM; CONTACT_JOBS is the number of processes.

A case passes if it ends in time, with results that are all finite numbers or with an error message. An infinite residual of a case
with the status "not converged" is not a result.
"""
import concurrent.futures
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile
from collections import Counter

PROGRAM = os.environ["CONTACT_PROGRAM"]
#: Cases that once trapped in a debug build: distances so large that additions to them are lost in round-off, steps of 1e10
#: elements, strips in full sliding, no slip velocity as a reference, a zero scale of the residual
KNOWN = (100016, 100028, 100029, 100181, 200048, 200052, 200177, 300020)
PATIENCE = 10.0 * float(os.environ.get("CONTACT_SLOWER", "1"))
BAD = re.compile(r"(?<![A-Za-z'\"/.-])[-+]?(NaN|Infinity|Inf)(?![a-z'\"])")


class Draw:
    """Random values, many of them at the ends of their bounds"""

    def __init__(self, seed):
        self.random = random.Random(seed)

    def one_of(self, *choices):
        return self.random.choice(choices)

    def size(self, lowest, highest, usual):
        """A positive number: a bound, a value between them on a logarithmic scale, or a usual one"""
        between = 10 ** self.random.uniform(math.log10(lowest), math.log10(highest))
        return self.one_of(lowest, highest, between, between, usual, usual)

    def signed(self, lowest, highest, usual):
        return self.one_of(0.0, *([-1.0, 1.0] * 3)) * self.size(lowest, highest, usual)


def case(seed):
    """One contact problem of module 3"""
    draw = Draw(seed)
    size, signed, one_of = draw.size, draw.signed, draw.one_of
    motion, by_force = one_of(0, 1, 2, 3, 3), one_of(0, 1)
    forces = one_of(0, 0, 0, 1, 2) if motion else 0
    material, law = one_of(0, 0, 0, 1, 2, 3, 4, 5), one_of(0, 0, 2, 3, 4)
    if motion != 3 and material in (1, 5):
        material = 0
    side = size(1e-8, 1e6, 0.1)
    lines = ["3", f"20{motion}{by_force}{forces}0", f"0{law}22{material}20", "0000301", f"50 50 20 {one_of(1, 5)} 1e-5"]
    load = size(1e-15, 1e15, 10.0) if by_force else size(1e-12, 1e6, 0.01)
    slip = [one_of(0, 0.5, -0.6, 1e-12) if forces > k else signed(1e-20, 1e12, 0.001) for k in range(2)]
    lines.append(f"{load:g} {slip[0]:g} {slip[1]:g} {signed(1e-20, 1e12, 1e-4):g}")
    if law == 0:
        friction = size(1e-6, 1e6, 0.3)
        lines.append(f"{friction:g} {friction:g}")
    else:
        lines += [f"{size(1e-6, 4e5, 0.1):g} {size(1e-6, 4e5, 0.2):g} {size(1e-5, 1e9, 100):g} 0 1",
                  f"{size(1e-9, 1e6, 0.001):g} {size(1e-3, 1e9, 10):g}"]
    if motion >= 2:
        lines.append(f"0 {size(1e-8, 1e6, side):g} {size(1e-9, 1e9, 1000):g}")
    lines.append(f"{one_of(0.28, 0.5, -0.9, 0, 0.49999)} {one_of(0.28, 0.5, -0.9, 0)} {size(1e-5, 1e20, 82000):g} "
                 f"{size(1e-5, 1e20, 82000):g}")
    if material == 1:
        lines.append(" ".join(f"{value:g}" for value in (size(1e-9, 1e10, 1), size(1e-9, 1e10, 1), size(1e-9, 1e15, 0.01),
                                                         size(1e-9, 1e15, 0.01))))
    elif material == 2:
        lines.append(f"{size(1e-10, 1e10, 1e-4):g} {size(1e-10, 1, 1):g} 1 0")
    elif material in (3, 5):
        lines.append(f"{size(1e-10, 1, 1):g} 1 0")
    elif material == 4:
        lines.append(f"{size(1e-5, 1e20, 1000):g} {size(1e-9, 1e6, 0.02):g} {one_of(0, size(1e-9, 1e9, 100)):g} "
                     f"{signed(1e-9, 1e20, 10):g}")
    mx, my = one_of((1, 1), (9, 9), (12, 5), (20, 1), (1, 11))
    curvature = [size(1e-12, 1e9, 0.01) for _ in range(2)]
    if one_of(True, False, False):
        lines += ["-1", f"{mx} {my} {curvature[0]:g} {curvature[1]:g} {size(1e-6, 1e6, 1.2):g}"]
    else:
        dy = size(1e-8, 1e6, side)
        lines += ["1", f"{mx} {my} {max(-1e6, -mx*side/2):g} {max(-1e6, -my*dy/2):g} {side:g} {dy:g}", "1 1",
                  f"{curvature[0]:g} 0 {curvature[1]:g} {signed(1e-9, 1e9, 1e-9):g} 0 {signed(1e-9, 1e9, 1e-9):g}"]
    return "\n".join(lines) + "\n0\n"


def not_finite(value):
    """Is there a NaN or an infinity in a record of JSON? Residuals are ignored"""
    if isinstance(value, dict):
        return any(not_finite(entry) for name, entry in value.items() if "residual" not in name)
    if isinstance(value, list):
        return any(not_finite(entry) for entry in value)
    return isinstance(value, float) and not math.isfinite(value)


def run(seed):
    """The status of one case, and whether it passes"""
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "x.inp"), "w") as file:
            file.write(case(seed))
        try:
            done = subprocess.run([PROGRAM, "--quiet", "--json", "--threads", "1", "2", "x"], cwd=folder, timeout=PATIENCE,
                                  capture_output=True, text=True, errors="replace", stdin=subprocess.DEVNULL)
        except subprocess.TimeoutExpired:
            return False, "does not end in time"
        if done.returncode not in (0, 1) or "Backtrace" in done.stderr or (done.returncode == 1 and not done.stderr.strip()):
            places = re.findall(r"in (\S+)\n\s+at (\S+)", done.stderr)
            where = " < ".join(f"{name} {place}" for name, place in places[:5]) or done.stderr[-300:]
            return False, f"ends with {done.returncode}: {where}"
        with open(os.path.join(folder, "x.out"), errors="replace") as file:
            out = file.read()
        with open(os.path.join(folder, "x.jsonl"), errors="replace") as file:
            records = [case for case in map(json.loads, file) if case["case"]]
        for line in out.splitlines():
            if BAD.search(line) and "residual" not in line.lower():
                return False, f"status {done.returncode}: {line.strip()[:150]}"
        if not_finite(records):
            return False, f"status {done.returncode}: a record that is not finite"
        if done.returncode == 1:
            return True, "refused: not finite" if "not finite" in done.stderr else "refused"
        return True, "not converged" if "did not reach" in out else "solved"


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 150
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    ends, failures = Counter(), 0
    seeds = [*KNOWN, *(100000*seed + k for k in range(count))]
    with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("CONTACT_JOBS", "2"))) as pool:
        for number, (right, how) in zip(seeds, pool.map(run, seeds)):
            ends[how if right else "wrong"] += 1
            if not right:
                failures += 1
                print(f"FAILED case {number}: {how}")
    print(f"{len(seeds)} cases, seed {seed}: " + ", ".join(f"{number} {how}" for how, number in sorted(ends.items())))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
