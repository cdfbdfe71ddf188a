"""Errors and times of random contacts beside their goals: goals.py PROGRAM [--contacts N] [--places N] [--seed S] [--check]

PROGRAM is performance_goals. Random contacts of tests/accuracy are solved in steady rolling, and as normal problem with prescribed
approach, on grids with random offsets, with both orders alternately. References are finer grids with offsets of their own,
extrapolated, for rolling, and Hertz's solution for the normal problem. The output is the rms error over contacts and offsets and
the median time of each size, and the smallest size that reaches each goal. With --check the errors of a few contacts on small
grids must decrease according to their order.
"""
import argparse
import math
import os
import random
import statistics
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "accuracy"))

from error_cases import contact, curvatures, elliptic

SIZES = (12, 14, 16, 18, 20, 22, 24, 25, 26, 28, 30, 32, 40, 48, 56, 60, 64, 80, 112, 160)
REFERENCE, REFERENCE_EPS = (120, 240), 1e-7
#: Largest error, and goal for the time [ms]
GOALS = {"rolling": ((1e-3, 0.8), (1e-4, 10.0), (3e-5, 50.0)), "normal": ((1e-4, 1.5),)}
TITLES = {"rolling": "Steady rolling, normal and tangential problem", "normal": "Normal problem"}

TEXT = """## Goals

Part of `sh tests/performance/accuracy.sh`; `--goals` runs this part alone. {contacts} random contacts at {places} offsets of
the grid each, in a potential contact 1.1 times as long as the contact. The error is the largest of those of FX and FY, relative
to the friction bound, and MZ, relative to the bound times the root of a b; reference: {middle} x {middle} and {fine} x {fine}
elements, extrapolated, which changes the finer one by {doubt:.0e} in the median. In the normal problem the approach is
prescribed, and Hertz's force is exact. Both orders are run alternately. Times are medians, processor time of one thread; the
first case of its size includes the set-up of plans and influence coefficients.
"""


def eps_of(n):
    """Tolerance of the solvers: its effect on forces is about a third of the discretisation error."""
    return max(1e-7, 0.2 / n**2)


def numbers_of(c):
    """The input line of a contact."""
    b1, b3 = curvatures(c["a"], c["b"], c["gg"][0] / (1.0 - c["poiss"][0]), c["fn"])
    g = min(c["a"], c["b"]) / max(c["a"], c["b"])
    _, _, k, e = elliptic(g)
    pen = min(c["a"], c["b"])**2 * (b1 + b3) * k / e
    values = (c["a"], c["b"], b1, b3, c["fn"], pen, c["mu"], c["poiss"][0], c["gg"][0], *c["creep"], c["spin"])
    return " ".join(f"{v:.17g}" for v in values)


def measure(program, contacts, source, places, grids):
    """Samples (seconds, seconds of the first, values) by motion, n, contact, place and order."""
    text = [f"{len(contacts)} {places}", *(numbers_of(c) for c in contacts)]
    for motion, n, eps in grids:
        text.append(f"{motion} {n} {eps:g}")
        text += [f"{source.random()!r} {source.random()!r}" for _ in range(places)]
    done = subprocess.run([program], input="\n".join(text) + "\n", capture_output=True, text=True,
                          env=dict(os.environ, OMP_NUM_THREADS="1"))
    if done.returncode:
        sys.exit(done.stderr)
    samples = {}
    for line in done.stdout.splitlines():
        motion, *words = line.split()
        n, number, place, order = (int(word) for word in words[:4])
        seconds, first, *values = (float(word) for word in words[4:])
        samples[motion, n, number, place, order] = (seconds, first, values[:3] if motion == "rolling" else values[3:])
    return samples


def exact_values(program, contacts, source, sizes):
    """Values of steady rolling by contact, and the largest difference between the finest grid and them."""
    samples = measure(program, contacts, source, 1, [("rolling", n, REFERENCE_EPS) for n in sizes])
    exact, doubts = {}, []
    for k in range(1, len(contacts) + 1):
        middle, fine = (samples["rolling", n, k, 1, 2][2] for n in sizes)
        exact[k] = [f + (f - m) / 3.0 for m, f in zip(middle, fine)]
        doubts.append(max(abs(f - e) for f, e in zip(fine, exact[k])))
    return exact, statistics.median(doubts)


def rms(errors):
    """Root of the mean square."""
    return math.sqrt(sum(e * e for e in errors) / len(errors))


def rows_of(samples, exact, motion, order, sizes, with_half=False):
    """(n, rms error, median seconds, median seconds of first cases) by size; with_half extrapolates from half as many elements."""
    rows = []
    for n in sizes:
        errors, seconds, firsts = [], [], []
        for (m, size, number, place, scheme), (time, first, values) in samples.items():
            if (m, size, scheme) != (motion, n, order) or (
                    with_half and (n % 2 or (m, n // 2, number, place, scheme) not in samples)):
                continue
            if with_half:
                half = samples[m, n // 2, number, place, scheme]
                values = [v + (v - w) / 3.0 for v, w in zip(values, half[2])]
                time, first = time + half[0], first + half[1]
            goal = exact[number] if motion == "rolling" else [1.0]
            errors.append(max(abs(v - e) for v, e in zip(values, goal)))
            seconds.append(time)
            firsts.append(first)
        if errors:
            rows.append((n, rms(errors), statistics.median(seconds), statistics.median(firsts)))
    return rows


def report(tables, motion):
    """Lines of Markdown: errors and times of each size, and the sizes that reach the goals."""
    lines = [f"### {TITLES[motion]}", "", "| " + " | ".join(["elements along a side", "EPS", *(
        f"{name}: rms error | ms | ms, first of its size" for name in tables)]) + " |", "|---" * (2 + 3 * len(tables)) + "|"]
    for n in SIZES:
        cells = []
        for rows in tables.values():
            found = [r for r in rows if r[0] == n]
            cells += [f"{found[0][1]:.1e}", f"{1e3 * found[0][2]:.3g}", f"{1e3 * found[0][3]:.3g}"] if found else ["-"] * 3
        lines.append(f"| {n} | {eps_of(n):.0e} | " + " | ".join(cells) + " |")
    lines += ["", "| error required | " + " | ".join(f"{name}: elements, error, ms" for name in tables) + " | goal |",
              "|---" * (2 + len(tables)) + "|"]
    for error, goal in GOALS[motion]:
        cells, best = [], math.inf
        for rows in tables.values():
            reached = [r for r in rows if r[1] <= error]
            cells.append(f"{reached[0][0]}, {reached[0][1]:.1e}, {1e3 * reached[0][2]:.3g}" if reached else "not reached")
            best = min([best, *(1e3 * r[2] for r in reached)])
        lines.append(f"| {error:g} | " + " | ".join(cells) + f" | {goal:g} ms: {'met' if best <= goal else 'MISSED'} |")
    return [*lines, ""]


def main():
    """Study or test."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--contacts", type=int, default=30)
    parser.add_argument("--places", type=int, default=10)
    parser.add_argument("--seed", type=int, default=30)
    parser.add_argument("--check", action="store_true", help="a small sample; fail if errors do not follow their order")
    asked = parser.parse_args()
    sizes, reference = SIZES, REFERENCE
    if asked.check:
        asked.contacts, asked.places, sizes, reference = 4, 3, (14, 28), (56, 112)
    source = random.Random(asked.seed)
    contacts = [contact(source, "rolling") for _ in range(asked.contacts)]
    exact, doubt = exact_values(asked.program, contacts, source, reference)
    samples = measure(asked.program, contacts, source, asked.places,
                      [(motion, n, eps_of(n)) for motion in GOALS for n in sizes])
    rolling = {name: rows_of(samples, exact, "rolling", order, sizes, half) for name, order, half in
               (("order 1", 1, False), ("order 2", 2, False), ("order 2, extrapolated from half as many", 2, True))}
    normal = {"normal force": rows_of(samples, exact, "normal", 2, sizes)}
    if asked.check:
        errors = [[r[1] for r in rows] for rows in (rolling["order 1"], rolling["order 2"], normal["normal force"])]
        print(errors)
        # first order halves, second order quarters, with the scatter of few contacts
        good = errors[0][1] < 0.8 * errors[0][0] and all(e[1] < 0.5 * e[0] for e in errors[1:])
        good = good and errors[1][1] < 0.3 * errors[0][1]
        sys.exit(0 if good else "errors do not decrease according to their order")
    print(TEXT.format(contacts=asked.contacts, places=asked.places, middle=reference[0], fine=reference[1], doubt=doubt))
    print("\n".join(report(rolling, "rolling") + report(normal, "normal")), end="")


if __name__ == "__main__":
    main()
