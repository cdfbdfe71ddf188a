"""Cost of an accuracy as predicted by `contact explain`, and measured: python3 cost.py [--count N] [--wheels N] [--pairs N]

Each random contact is solved in a separate process. Its processor time, without that of a process that solves nothing, is compared
with the predicted seconds, and its elements with the predicted ones. Output by kind and by accuracy: median of predicted over
measured time, its deciles, and the fraction within a factor of two. CONTACT_PROGRAM names the program.
"""
import argparse
import json
import math
import os
import random
import re
import resource
import statistics
import subprocess
import tempfile
from pathlib import Path

from asked import KINDS
from error_cases import PROFILES, contact, some_wheels, text_of, wheel_text

#: Number of runs, of which the fastest counts: other processes only add time
RUNS = 3
#: A run that takes longer is not repeated [s]
LONG = 0.5


def processor_time(command, folder):
    """Processor time of a process [s], and its output."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=dict(os.environ, OMP_NUM_THREADS="1"))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


def quickest(command, folder):
    """The shortest of several runs [s]."""
    times = []
    while len(times) < RUNS and (not times or times[-1] < LONG):
        times.append(processor_time(command, folder)[0])
    return min(times)


def compare(program, folder, text, accuracy, start):
    """Seconds predicted and measured, elements predicted and used by the last case."""
    (folder / "x.toml").write_text(text)
    asked = ("--accuracy", str(accuracy))
    words = processor_time([program, "explain", *asked, "x.toml"], folder)[1]
    # a line for each case of a series
    costs = re.findall(r"(\d+) elements, \d+ MB, ([-+.0-9E]+) s", words)
    taken = quickest([program, *asked, "--json", "2", "x"], folder) - start
    records = [json.loads(line) for line in (folder / "x.jsonl").read_text().splitlines()]
    told = [r["patches"][0].get("accuracy", {}) for r in records if r.get("patches")][-1]
    elements = told["mx"] * told["my"] if "mx" in told else math.nan
    return sum(float(seconds) for _, seconds in costs), max(taken, 1e-4), int(costs[-1][0]), elements


def line(name, rows):
    """A line of the table."""
    ratios = sorted(r[0] / r[1] for r in rows)
    sizes = [r[2] / r[3] for r in rows if r[3] > 0]
    deciles = ratios[len(ratios) // 10], ratios[-1 - len(ratios) // 10]
    within = sum(0.5 <= r <= 2.0 for r in ratios) / len(ratios)
    few = f"{100 * sum(0.5 <= s <= 2.0 for s in sizes) / len(sizes):.0f}" if sizes else "-"
    return (f"| {name} | {len(rows)} | {1e3 * statistics.median(r[1] for r in rows):.2g} | {statistics.median(ratios):.2f} | "
            f"{deciles[0]:.2f} to {deciles[1]:.2f} | {100 * within:.0f} | {few} |")


def main():
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=54, help="number of contacts")
    parser.add_argument("--wheels", type=int, default=6, help="number of wheels on rails")
    parser.add_argument("--pairs", type=int, default=0, help="number of wheels of any profiles")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", default=",".join(k for k in KINDS if k not in ("layer", "shifts")))
    parser.add_argument("--asked", default="1e-2,1e-3,2e-4", help="accuracies")
    parser.add_argument("--raw", action="store_true", help="print each contact")
    asked = parser.parse_args()
    program, source, kinds = os.environ["CONTACT_PROGRAM"], random.Random(asked.seed), asked.kinds.split(",")
    cases = [(kinds[k % len(kinds)], text_of(contact(source, kinds[k % len(kinds)]), 40, (source.random(), source.random()), 1e-5))
             for k in range(asked.count)]
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        cases += [("wheel", wheel_text(c, 1.0, PROFILES)) for c in some_wheels(source, asked.wheels)]
        cases += [("pair", wheel_text(c, 1.0, PROFILES)) for c in some_wheels(source, asked.pairs, folder)]
        (folder / "empty.inp").write_text(" 0 MODULE\n")
        start = min(processor_time([program, "--json", "2", "empty"], folder)[0] for _ in range(10))
        for word in asked.asked.split(","):
            for kind, text in cases:
                rows.append((kind, word, compare(program, folder, text, word, start)))
                if asked.raw:
                    print(kind, word, *rows[-1][2], flush=True)
    print(f"A process that solves nothing takes {1e3 * start:.1f} ms.\n")
    print("| | cases | measured, median [ms] | predicted over measured | deciles | within a factor of 2 [%] | elements [%] |")
    print("|---" * 7 + "|")
    for k in (0, 1):
        for value in dict.fromkeys(r[k] for r in rows):
            print(line(value, [r[2] for r in rows if r[k] == value]))
    print(line("all", [r[2] for r in rows]))


if __name__ == "__main__":
    main()
