"""Errors of simplified methods against the full theory: python3 approximate.py [--count N] [--seed S] [--wheels N] [--check]

Random ellipses, with prescribed creepages or forces, are solved by Fastsim and FaStrip with Hertzian pressures, and by the full
theory on two fine grids whose totals are extrapolated. The output is the error of the forces by method, elements and kind of
contact: without spin, with less spin than creepage, with more. With --wheels the same for KPEC and ANALYN on S1002 and 60E1. The
bounds in src/cases/approximate_methods.f90 are taken from these results. --check solves a small sample with a requested accuracy
and simplified methods allowed; it fails if an error exceeds the request, or if no simplified method is chosen. CONTACT_PROGRAM
names the program.
"""
import argparse
import math
import os
import random
import sys
import tempfile
from pathlib import Path

from asked import error_of, exact_totals, timed, wheel_error, wheel_of
from error_cases import PROFILES, contact, curvatures, some_wheels, text_of, wheel_text
from errors import patch_of, run

METHODS = ("fastsim", "fastrip")
#: Elements along each side
SIZES = (14, 20, 40)
#: Methods for wheels on rails: pressures, and theory of the tractions
WHEEL_METHODS = (("full", "elastic"), ("kpec", "elastic"), ("analyn", "elastic"), ("kpec", "fastrip"), ("full", "fastrip"))
#: Accuracies requested by --check
ASKED = (0.1, 0.06)


def simplified(text, c, n, method):
    """The case of a contact by a simplified method, around its ellipse."""
    b1, b3 = curvatures(c["a"], c["b"], c["gg"][0] / (1.0 - c["poiss"][0]), c["fn"])
    head, _ = text.split("[case.grid]")
    head = head.replace('material_model = "elastic"', f'material_model = "{method}"\npressure = "elliptical"')
    head = head.replace("poiss = ", "k0_mf = 1.0\nalfamf = 1.0\nbetamf = 1.0\npoiss = ")
    return head + f'[case.grid]\nform = "hertz_curvatures"\nmx = {n}\nmy = {n}\na1 = {b1!r}\nb1 = {b3!r}\nscale = 1.0\n'


def share_of_spin(c):
    """Fraction of the motion that is spin, 0 to 1."""
    spin = abs(c["spin"]) * math.sqrt(c["a"] * c["b"])
    return spin / (spin + math.hypot(*c["creep"]))


def kind_of(c):
    """Kind of contact by which errors are grouped."""
    if c["tangential"] != "creepages":
        return "forces prescribed" + (", spin" if abs(c["spin"]) > 0.0 else "")
    share = share_of_spin(c)
    return "no spin" if share < 1e-9 else "spin < creepage" if share < 0.5 else "spin > creepage"


def random_contacts(source, count):
    """Contacts of all kinds; ratios of the semi-axes from 0.2 to 5."""
    found = []
    while len(found) < count:
        c = contact(source, source.choice(["rolling", "rolling", "reverse", "forces"]))
        if 0.2 <= c["a"] / c["b"] <= 5.0:
            found.append(c)
    return found


def judge(program, asked, folder):
    """Rows (kind, method, n, error) of all contacts."""
    source = random.Random(asked.seed)
    contacts = random_contacts(source, asked.count)
    reference = [run(program, folder, f"reference{n}", [text_of(c, n, (source.random(), source.random()), 1e-7) for c in contacts],
                     False, ("--order", "2")) for n in (asked.reference, 2 * asked.reference)]
    exact = [exact_totals(c, [r.get(k, {}) for r in reference]) for k, c in enumerate(contacts, 1)]
    rows = []
    for method in METHODS:
        for n in SIZES:
            texts = [simplified(text_of(c, n, (0.5, 0.5), 1e-6), c, n, method) for c in contacts]
            records = run(program, folder, "simplified", texts, False)
            for k, c in enumerate(contacts, 1):
                patch = patch_of(records, k)
                if patch is None or exact[k - 1] is None:
                    rows.append((c, method, n, math.inf))
                    continue
                rows.append((c, method, n, error_of(c, patch["totals"], exact[k - 1][0])))
    return rows


def table(rows):
    """Lines of the table: quantiles by method, elements and kind."""
    lines = ["| method | elements | kind | contacts | median error | 95 % | largest |", "|---|---|---|---|---|---|---|"]
    for method in METHODS:
        for n in SIZES:
            for kind in ("no spin", "spin < creepage", "spin > creepage", "forces prescribed", "forces prescribed, spin"):
                errors = sorted(e for c, m, size, e in rows if (m, size) == (method, n) and kind_of(c) == kind)
                if errors:
                    at = errors[len(errors) // 2], errors[min(len(errors) - 1, int(0.95 * len(errors)))], errors[-1]
                    lines.append(f"| {method} | {n} x {n} | {kind} | {len(errors)} | " + " | ".join(f"{e:.1e}" for e in at) + " |")
    return lines


def wheels(program, asked, folder):
    """Lines of the table for wheels on rails: errors of the forces and of the height relative to the approach, and milliseconds."""
    source = random.Random(asked.seed)
    cases = some_wheels(source, asked.wheels)
    fine = run(program, folder, "wheels", [wheel_text(c, 4.0, PROFILES) for c in cases], False, ("--order", "2"))
    lines = ["| pressures | tractions | wheels | median error | 95 % | largest | ms |", "|---|---|---|---|---|---|---|"]
    for pressure, model in WHEEL_METHODS:
        texts = []
        for c in cases:
            choices = f'pressure = "{pressure}"\nmaterial_model = "{model}"\nmotion = '
            text = wheel_text(c, 1.0, PROFILES).replace("motion = ", choices, 1)
            if model != "elastic":
                text = text.replace("poiss = ", "k0_mf = 1.0\nalfamf = 1.0\nbetamf = 1.0\npoiss = ")
            texts.append(text)
        records, seconds = timed(program, folder, "simplified", texts, False)
        found = [(c, wheel_of(records, k), wheel_of(fine, k)) for k, c in enumerate(cases, 1)]
        errors = sorted(wheel_error(c, a, b) for c, a, b in found if None not in (a, b))
        lines.append(f"| {pressure} | {model} | {len(errors)} | {errors[len(errors) // 2]:.1e} | "
                     f"{errors[int(0.95 * len(errors))]:.1e} | {errors[-1]:.1e} | {1e3 * seconds / len(cases):.1f} |")
    return lines


def allowed(c, text, n):
    """The case of a contact around its ellipse."""
    b1, b3 = curvatures(c["a"], c["b"], c["gg"][0] / (1.0 - c["poiss"][0]), c["fn"])
    head, _ = text.split("[case.grid]")
    return head + f'[case.grid]\nform = "hertz_curvatures"\nmx = {n}\nmy = {n}\na1 = {b1!r}\nb1 = {b3!r}\nscale = 1.2\n'


def misses(program, asked, folder):
    """Failures of accuracies with simplified methods allowed, "" for none."""
    source = random.Random(asked.seed)
    contacts = [contact(source, "normal") for _ in range(4)] + random_contacts(source, 24)
    contacts = [c for c in contacts if 0.2 <= c["a"] / c["b"] <= 5.0]
    reference = [run(program, folder, f"reference{n}", [text_of(c, n, (source.random(), source.random()), 1e-7) for c in contacts],
                     False, ("--order", "2")) for n in (24, 48)]
    complaints, chosen = [], {}
    for tolerance in ASKED:
        texts = [allowed(c, text_of(c, 20, (0.5, 0.5), 1e-6), 20) for c in contacts]
        records = run(program, folder, "asked", texts, False, ("--accuracy", str(tolerance), "--allow", "approximate"))
        for k, c in enumerate(contacts, 1):
            exact, patch = exact_totals(c, [r.get(k, {}) for r in reference]), patch_of(records, k)
            told = records[k]["patches"][0]["accuracy"]
            if exact is None or patch is None or not told["reached"]:
                complaints.append(f"{kind_of(c)}: no result")
                continue
            words = told["simplified"].split()[0]
            chosen[words] = chosen.get(words, 0) + 1
            error = error_of(c, patch["totals"], exact[0])
            if error > tolerance:
                complaints.append(f"{words}, {kind_of(c)}: error {error:.2e}, asked {tolerance}")
    if set(chosen) != {"pressures", "FaStrip", "none,"}:
        complaints.append(f"what was chosen: {chosen}")
    return "\n".join(complaints)


def main():
    """Study or test."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=60, help="number of ellipses")
    parser.add_argument("--wheels", type=int, default=0, help="number of wheels on rails")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--reference", type=int, default=40, help="elements along each side of the coarser reference grid")
    parser.add_argument("--check", action="store_true", help="a small sample of accuracies; fail if one is not reached")
    asked = parser.parse_args()
    program = os.environ["CONTACT_PROGRAM"]
    with tempfile.TemporaryDirectory() as name:
        if asked.check:
            sys.exit(misses(program, asked, Path(name)) or 0)
        if asked.count:
            print("\n".join(table(judge(program, asked, Path(name)))))
        if asked.wheels:
            print("\n".join(wheels(program, asked, Path(name))))


if __name__ == "__main__":
    main()
