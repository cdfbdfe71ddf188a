"""What estimated errors cost: python3 estimate_cost.py [--count N] [--wheels N] [--pairs N] [--seed S] [--across 20,40,64]

Random contacts of all kinds, each on grids with the given numbers of elements across it, and wheels on rails with the elements of
their cases, are run without and with --errors. Counted are the instructions of the whole process by callgrind, which do not depend
on other processes. The output is, by order and number of elements, the part that the estimates add: median, 90 % and largest, as
part of the whole run and of the run without the start of a process that solves nothing; then the contacts that exceed the limit.
--stresses has points below the surface in the contacts. --check fails if one exceeds the limit. CONTACT_PROGRAM names the program.
--asked TOL instead solves the wheels of any profiles with --accuracy TOL, and with the elements chosen last alone: counted are the
instructions of the solution of wheel and rail, without profiles, input and output, of all grids over the last one alone.
"""
import argparse
import json
import os
import random
import re
import statistics
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from error_cases import CHANGES, FURTHER, PROFILES, contact, some_wheels, text_of, wheel_text

#: Largest part that estimates may add to the instructions of a run
LIMIT = 0.15
#: The solution of a wheel on a rail, as gfortran names it
SOLUTION = "__contact_wheelrail_solve_MOD_solve_wheel_rail"


def instructions(program, folder, name, options=(), within=()):
    """Instructions of a run of an existing file, or of a procedure in it."""
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *(f"--toggle-collect={f}" for f in within),
               program, *options, "--quiet", "--json", "2", name]
    done = subprocess.run(command, cwd=folder, env=dict(os.environ, OMP_NUM_THREADS="1"), capture_output=True, text=True)
    return int(re.search(r"refs: +([0-9,]+)", done.stderr).group(1).replace(",", ""))


def texts_of(asked, folder):
    """Group (elements across, or wheels), name and text of each run; the files of profiles are written."""
    source, kinds = random.Random(asked.seed), asked.kinds.split(",")
    for k in range(asked.count):
        c = dict(contact(source, kinds[k % len(kinds)]), stresses=asked.stresses)
        offset = (source.random(), source.random())
        for n in map(int, asked.across.split(",")):
            yield n, f"{k} {c['kind']}", text_of(c, round(n * c["margin"]), offset)
    for k, c in enumerate(some_wheels(source, asked.wheels)):
        yield "wheels", f"{k} wheel", wheel_text(c, 1.0, PROFILES)
    for k, c in enumerate(some_wheels(source, asked.pairs, folder)):
        yield "pairs", f"{k} pair", wheel_text(c, 1.0, PROFILES)


def compare(program, folder, number, text, order):
    """Instructions without and with estimates."""
    name = f"x{number}o{order}"
    (folder / f"{name}.toml").write_text(text)
    return [instructions(program, folder, name, ("--order", order, *more)) for more in ((), ("--errors",))]


def all_grids(program, folder, number, text, asked):
    """Grids of a wheel with an accuracy, instructions of all of them and of the last one alone; none if it is not reached."""
    name = f"x{number}"
    (folder / f"{name}.toml").write_text(text)
    together = instructions(program, folder, name, ("--accuracy", asked), (SOLUTION,))
    told = next((r["accuracy"] for r in map(json.loads, (folder / f"{name}.jsonl").open()) if r.get("accuracy")), {})
    if not told.get("reached"):
        return None
    for key, value in (("dx", "dx"), ("ds", "dy"), ("eps", "eps")):
        text = re.sub(rf"(?m)^{key} = .*$", f"{key} = {told[value]['value']!r}", text, count=1)
    (folder / f"{name}a.toml").write_text(text)
    return told["grids"], together, instructions(program, folder, f"{name}a", ("--errors", "--order", "2"), (SOLUTION,))


def compare_grids(asked, program, folder, pool):
    """Print what all grids of the wheels cost, over the last one alone."""
    texts = [text for group, _, text in texts_of(asked, folder) if group == "pairs"]
    found = [run.result() for run in [pool.submit(all_grids, program, folder, k, t, asked.asked) for k, t in enumerate(texts)]]
    if asked.list:
        for number, run in enumerate(found):
            print(number, *(run or ("not reached",)))
    found = [run for run in found if run]
    ratios = sorted(both / last for _, both, last in found)
    print(f"{len(found)} of {len(texts)} wheels, {sum(run[0] for run in found)} grids; all grids over the last one alone: "
          f"{sum(run[1] for run in found) / sum(run[2] for run in found):.2f} in the sum, median {statistics.median(ratios):.2f}, "
          f"largest {ratios[-1]:.2f}; {sum(run[1] for run in found) / 1e6:.1f} million instructions")


def main():
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=24, help="number of contacts")
    parser.add_argument("--wheels", type=int, default=8, help="number of wheels on rails")
    parser.add_argument("--pairs", type=int, default=0, help="number of wheels of any profiles")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", default=",".join(CHANGES), help=f"of {', '.join(CHANGES | FURTHER)}")
    parser.add_argument("--orders", default="1,2", help="orders of the scheme")
    parser.add_argument("--across", default="20,40,64", help="elements across the contact")
    parser.add_argument("--stresses", action="store_true", help="with points below the surface")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time")
    parser.add_argument("--list", action="store_true", help="print each run when it ends")
    parser.add_argument("--asked", help="accuracy for which all grids of wheels of any profiles are compared with the last one")
    parser.add_argument("--check", action="store_true", help="fail if a contact exceeds the limit")
    asked = parser.parse_args()
    program, rows = os.environ["CONTACT_PROGRAM"], {}
    with tempfile.TemporaryDirectory() as name, ThreadPoolExecutor(asked.jobs) as pool:
        folder = Path(name)
        if asked.asked:
            compare_grids(asked, program, folder, pool)
            return
        (folder / "empty.inp").write_text(" 0 MODULE\n")
        start = instructions(program, folder, "empty")
        runs = [(order, group, label, pool.submit(compare, program, folder, number, text, order))
                for order in asked.orders.split(",") for number, (group, label, text) in enumerate(texts_of(asked, folder))]
        for order, group, label, run in runs:
            without, with_them = run.result()
            rows.setdefault((order, group), []).append((with_them / without - 1, (with_them - without) / (without - start),
                                                        label, without / 1e6))
            if asked.list:
                print(order, group, label, *(f"{value:.4g}" for value in (without / 1e6, with_them / 1e6)), flush=True)
    print(f"Start: {start / 1e6:.1f} million instructions\n")
    print("| order | across | runs | added: median [%] | 90 % | largest | without the start: median [%] | 90 % | largest | above |")
    print("|---" * 10 + "|")
    for (order, group), found in rows.items():
        parts = [sorted(100 * row[k] for row in found) for k in (0, 1)]
        print(f"| {order} | {group} | {len(found)} | " + " | ".join(
            f"{statistics.median(p):.1f} | {p[-1 - len(p) // 10]:.1f} | {p[-1]:.1f}" for p in parts)
            + f" | {sum(row[0] > LIMIT for row in found)} |")
    above = [(part, bare, order, group, label, size) for (order, group), found in rows.items()
             for part, bare, label, size in found if part > LIMIT]
    for part, bare, order, group, label, size in sorted(above, reverse=True):
        print(f"order {order}, {group}, {label}: {100 * part:.1f} %, without the start {100 * bare:.1f} % of {size:.1f} million")
    sys.exit(asked.check and bool(above))


if __name__ == "__main__":
    main()
