"""Requested accuracies against true errors: python3 asked.py [--count N] [--wheels N] [--pairs N] [--seed S] [--check]

Random contacts, and wheels on rails, are solved with --accuracy and on two fine fixed grids with offsets of their own, whose totals
are extrapolated. Output by accuracy and kind of contact: the number of true errors below the request, their size, and the time
beside that of the best fixed grid, the coarsest one with which as many contacts have an error below the request. --check fails if
too few errors are below the request. CONTACT_PROGRAM names the program.
"""
import argparse
import math
import os
import random
import resource
import sys
import tempfile
from pathlib import Path

from error_cases import CHANGES, PROFILES, contact, some_wheels, text_of, wheel_text
from errors import last_cases, patch_of, run, scale_of

#: Kinds of contacts whose grid can be chosen
KINDS = (*(k for k in CHANGES if k != "transient"), "shifts")
#: Fixed grids for comparison: elements along each side
FIXED = (12, 14, 17, 20, 24, 28, 34, 40, 48, 56, 68, 80, 96, 112, 136, 160)
#: The same for wheels: factors of the number of elements of a case, which have 0.3 to 0.7 mm
FIXED_WHEELS = (0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0)
#: References of wheels of any profiles: elements smaller than the chosen ones by these factors
FINER = (2.2, 4.4)
#: Bounds of the test: fraction of the contacts whose true error is below the request, and largest error relative to the request
BOUNDS = (0.97, 3.0)
#: Totals that are compared, with the order of the extrapolation of the reference where the discretisation is of second order
COUNTED = {"fn": 2, "pen": 2, "fx": 2, "fy": 2, "mz": 2, "cksi": 2, "ceta": 2, "shift_x": 2, "shift_y": 2}


def timed(*what):
    """Records of a run, and its processor time [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    records = run(*what)
    return records, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def exact_totals(c, records):
    """Extrapolated totals of both reference grids, and largest relative difference of the finer one from them.

    Grids of different schemes have no common limit: a grid on which the second order fell back to the first is no reference.
    """
    middle, fine = (patch_of(r, 1) for r in ({1: records[0]}, {1: records[1]}))
    if None in (middle, fine) or middle["order"] != fine["order"]:
        return None
    exact, doubt = dict(fine["totals"]), 0.0
    for name in COUNTED:
        if name in exact:
            step = (fine["totals"][name] - middle["totals"][name]) / 3.0
            exact[name] += step
            doubt = max(doubt, abs(step) / (scale_of(name, fine["totals"], c) or 1.0))
    return exact, doubt


def error_of(c, totals, exact):
    """Largest relative error of the forces."""
    return max(abs(totals[name] - exact[name]) / scale_of(name, exact, c) for name in COUNTED
               if name in totals and scale_of(name, exact, c) > 0.0)


def contact_texts(contacts, source, n, eps, options=""):
    """All contacts on one grid."""
    return [text_of(c, n, (source.random(), source.random()), eps, options) for c in contacts]


def contact_errors(contacts, records, exact):
    """True error of each contact; infinite without a result."""
    patches = [patch_of(records, number) for number in last_cases(contacts)]
    return [math.inf if p is None or e is None else error_of(c, p["totals"], e[0]) for c, p, e in zip(contacts, patches, exact)]


def judge_contacts(program, asked, folder):
    """Rows (contact, accuracy, error, report, uncertainty of the reference), seconds by accuracy, grids (n, errors, seconds)."""
    source = random.Random(asked.seed)
    contacts = [contact(source, asked.kinds[k % len(asked.kinds)]) for k in range(asked.count)]
    reference = []
    for n in (asked.reference, 2 * asked.reference):
        records = run(program, folder, f"reference{n}", contact_texts(contacts, source, n, 1e-7), False, ("--order", "2"))
        reference.append([records.get(number, {}) for number in last_cases(contacts)])
    exact = [exact_totals(c, pair) for c, pair in zip(contacts, zip(*reference))]
    rows, seconds, fixed = [], {}, []
    for tolerance in asked.asked:
        records, seconds[tolerance] = timed(program, folder, "asked", contact_texts(contacts, source, 40, 1e-5), False,
                                            ("--accuracy", str(tolerance)))
        errors = contact_errors(contacts, records, exact)
        for c, number, error, fine in zip(contacts, last_cases(contacts), errors, exact):
            told = records.get(number, {}).get("patches", [{}])[0].get("accuracy", {})
            rows.append((c, tolerance, error, told, fine[1] if fine else math.inf))
    for n in FIXED if asked.fixed else ():
        records, time = timed(program, folder, "fixed", contact_texts(contacts, source, n, 1e-5), False, ("--order", "2"))
        fixed.append((n, contact_errors(contacts, records, exact), time))
    return rows, seconds, fixed


def wheel_of(records, number):
    """Totals of a solved wheel, with the required ones of its patches."""
    record = records.get(number)
    if not record or not record.get("converged") or not record["patches"]:
        return None
    totals = {name: record["totals"][name]["value"] for name in ("fx_tr", "fy_tr", "z_ws")}
    patches = [p["totals"] for p in record["patches"]]
    totals["bound"] = sum(p["fn"]["value"] for p in patches)
    totals["pen"] = max(p["pen"]["value"] for p in patches)
    totals["patches"] = len(patches)
    return totals


def wheel_error(c, totals, exact):
    """Largest relative error: forces relative to the friction bound, height relative to the approach."""
    forces = max(abs(totals[name] - exact[name]) for name in ("fx_tr", "fy_tr"))
    return max(forces / (c["mu"] * exact["bound"]), abs(totals["z_ws"] - exact["z_ws"]) / exact["pen"])


def judge_pairs(program, asked, folder):
    """The same for wheels of any profiles."""
    return judge_wheels(program, asked, folder, pairs=True)


def judge_wheels(program, asked, folder, pairs=False):
    """The same for wheels on rails, ordinary ones or those of any profiles."""
    source = random.Random(asked.seed)
    wheels = some_wheels(source, asked.pairs, folder) if pairs else some_wheels(source, asked.wheels)

    def solve(name, factor, options, sides=None):
        texts = [wheel_text(c, factor * (1.0 + 0.04 * source.random()), PROFILES, side)
                 for c, side in zip(wheels, sides or [None] * len(wheels))]
        return timed(program, folder, name, texts, False, options)

    found = {tolerance: solve("wheels", 1.0, ("--accuracy", str(tolerance))) for tolerance in asked.asked}
    if pairs:
        # elements of wheels of any profiles are up to six times as long as they are wide
        told = [found[min(found)][0].get(k, {}).get("accuracy") for k in range(1, len(wheels) + 1)]
        grids = [[t and tuple(value_of(t, n) / (f * (1.0 + 0.04 * source.random())) for n in ("dx", "dy")) for t in told]
                 for f in FINER]
        reference = [solve("wheel_reference", 1.0, ("--order", "2"), sides)[0] for sides in grids]
    else:
        size = asked.reference / 20.0
        reference = [solve("wheel_reference", f, ("--order", "2"))[0] for f in (size, 2.0 * size)]
    exact = []
    for k in range(1, len(wheels) + 1):
        middle, fine = (wheel_of(r, k) for r in reference)
        if None in (middle, fine) or middle["patches"] != fine["patches"]:
            exact.append(None)
            continue
        best = fine | {n: fine[n] + (fine[n] - middle[n]) / 3.0 for n in ("fx_tr", "fy_tr", "z_ws")}
        exact.append((best, wheel_error(wheels[k - 1], fine, best)))

    def errors_of(records):
        found = [wheel_of(records, k) for k in range(1, len(wheels) + 1)]
        return [math.inf if None in (t, e) else wheel_error(c, t, e[0]) for c, t, e in zip(wheels, found, exact)]

    rows, seconds, fixed = [], {}, []
    for tolerance, (records, time) in found.items():
        seconds[tolerance] = time
        for k, error in enumerate(errors_of(records), 1):
            rows.append((wheels[k - 1], tolerance, error, records.get(k, {}).get("accuracy", {}),
                         exact[k - 1][1] if exact[k - 1] else math.inf))
    for f in FIXED_WHEELS if asked.fixed else ():
        records, time = solve("wheels_fixed", f, ("--order", "2"))
        fixed.append((f, errors_of(records), time))
    return rows, seconds, fixed


def value_of(told, name, default=math.nan):
    """A value of a group of a record."""
    value = told.get(name, default)
    return value["value"] if isinstance(value, dict) else value


def table(rows, seconds, fixed):
    """Lines of the table of one module."""
    lines = []
    for tolerance in dict.fromkeys(row[1] for row in rows):
        part = list(enumerate(r for r in rows if r[1] == tolerance))
        for kind in ("all", *dict.fromkeys(row[0]["kind"] for _, row in part)):
            chosen = [(k, row) for k, row in part if kind in ("all", row[0]["kind"]) and math.isfinite(row[4])]
            said = [row for _, row in chosen if value_of(row[3], "reached", False)]
            errors = sorted(row[2] for row in said)
            if not errors:
                lines.append(f"| {tolerance:g} | {kind} | {len(chosen)} | 0 | - | - | - | - | - | - |")
                continue
            below = sum(e <= tolerance for e in errors)
            last, grids = (sum(value_of(row[3], name) for row in said) for name in ("seconds_of_last", "seconds_of_grids"))
            time, best = "-", "-"
            if kind == "all":
                time = f"{1e3 * seconds[tolerance] / len(part):.1f}"
                for n, results, fixed_time in fixed:
                    if sum(results[k] <= tolerance for k, _ in chosen) >= below:
                        best = f"{n}: {1e3 * fixed_time / len(part):.1f}"
                        break
            lines.append(f"| {tolerance:g} | {kind} | {len(chosen)} | {len(said)} | {100 * below / len(said):.1f} | "
                         f"{errors[len(errors) // 2]:.1e} | {errors[-1]:.1e} | {time} | {grids / last:.2f} | {best} |")
    return lines


HEADING = ("| requested | kind | contacts | reached by estimate | true error below [%] | median error | largest | ms | all grids "
           "over the last | best fixed grid: ms |\n|---|---|---|---|---|---|---|---|---|---|")


def misses(rows):
    """Failures: accuracies reported as reached whose true error is larger; "" for none."""
    complaints = []
    said = [row for row in rows if math.isfinite(row[4])]
    if any(not value_of(row[3], "reached", False) for row in said):
        complaints.append(f"not reached: {[(row[0]['kind'], row[3]) for row in said if not value_of(row[3], 'reached', False)]}")
    ratios = [row[2] / row[1] for row in said]
    below = sum(r <= 1.0 for r in ratios) / len(ratios)
    if below < BOUNDS[0] or max(ratios) > BOUNDS[1]:
        complaints.append(f"{100 * below:.1f} % of the true errors are as asked or below, the largest is {max(ratios):.2f} of it")
    return "\n".join(complaints)


def parser_of(description):
    """Options for the choice of contacts and the requested accuracies."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--count", type=int, default=0, help="number of contacts")
    parser.add_argument("--wheels", type=int, default=0, help="number of wheels on rails")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--asked", default="1e-2,1e-3", help="accuracies")
    parser.add_argument("--reference", type=int, default=60, help="elements along each side of the coarser reference grid")
    return parser


def main():
    """Study or test."""
    parser = parser_of(__doc__)
    parser.add_argument("--pairs", type=int, default=0, help="number of wheels of any profiles, on track and roller")
    parser.add_argument("--fixed", action="store_true", help="compare with fixed grids")
    parser.add_argument("--list", action="store_true", help="list the contacts that miss the request")
    parser.add_argument("--check", nargs="?", const="all", choices=("all", "pairs"), help="a small sample; fail if it misses")
    asked = parser.parse_args()
    if asked.check == "all":
        asked.count, asked.wheels, asked.seed, asked.asked, asked.reference = 20, 4, 5, "1e-2,2e-3", 40
    elif asked.check == "pairs":
        # two of these are in contact on flanks, where the height has a larger error than the approach
        asked.pairs, asked.seed, asked.asked = 9, 5101, "1e-3"
    asked.kinds = asked.kinds.split(",")
    asked.asked = [float(word) for word in asked.asked.split(",")]
    program = os.environ["CONTACT_PROGRAM"]
    failures = ""
    with tempfile.TemporaryDirectory() as name:
        for count, judge in ((asked.count, judge_contacts), (asked.wheels, judge_wheels), (asked.pairs, judge_pairs)):
            if not count:
                continue
            rows, seconds, fixed = judge(program, asked, Path(name))
            print("\n".join((HEADING, *table(rows, seconds, fixed))), flush=True)
            for c, tolerance, error, told, doubt in rows:
                if asked.list and (error > tolerance or not value_of(told, "reached", False)):
                    print(f"{c['kind']} requested {tolerance:g}: error {error:.1e}, reference {doubt:.0e}, "
                          + ", ".join(f"{key} {value_of(told, key)}" for key in told))
            failures += misses(rows)
    if asked.check:
        sys.exit(failures or 0)


if __name__ == "__main__":
    main()
