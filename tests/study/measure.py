#!/usr/bin/env python3
"""Time and memory of a study of small cases, a creep table, against the bare loop of the library in loop.c.

usage: measure.py run CASES [--workers N] [--engine threads|processes] [--points N] [--elements N] [--folder DIR]
       measure.py table CASES [--turns N] [--elements N] [--tasks CASES] [--loop PROGRAM]

`run` computes one study and prints a line of JSON. `table` compares studies with one and two workers with as many processes of the
bare loop, in turns, and studies with tasks of 1 to 1000 points with one that chooses the size; medians, in Markdown.
Processor time is that of all processes, without the start of Python; wall time is meaningful on an idle machine only.
"""
import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SOURCE = Path(os.environ["CONTACT_SOURCE"])
sys.path[:0] = [str(SOURCE / "python"), str(SOURCE / "tests/study")]


def used():
    """Processor time of this process and its finished children [s]"""
    return sum(os.times()[:4])


def run(options):
    """One study"""
    import contact
    import xarray
    from bases import rolling
    from contact.study import span
    # read once by each process
    xarray.Dataset({"a": ("b", [0.0])})
    spins = max(1, options.cases // 10000)
    study = contact.Study(rolling(options.elements), {
        "kinematics.cphi": span(-0.001, 0.001, spins) if spins > 1 else [0.0],
        "kinematics.ceta": span(-0.01, 0.01, 100), "kinematics.cksi": span(-0.01, 0.01, 100)}, folder=options.folder)
    wall, processor = time.perf_counter(), used()
    found = study.run(options.workers, engine=options.engine, points_per_task=options.points, progress=False)
    count = found.status.size
    print(json.dumps({
        "cases": count, "wall": time.perf_counter() - wall, "processor": used() - processor,
        "memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024, "solved": int((found.status == 0).sum()),
        "sum": float((found.fx**2 + found.fy**2).sum())}))


def one_study(cases, elements, workers=1, points=None):
    """A study in a separate process and folder"""
    with tempfile.TemporaryDirectory() as folder:
        words = [sys.executable, __file__, "run", str(cases), "--workers", str(workers), "--elements", str(elements),
                 "--folder", folder, *(["--points", str(points)] if points else [])]
        found = json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)
        size = sum(file.stat().st_size for file in Path(folder).iterdir())
    if found["solved"] != cases:
        sys.exit(f"{found['solved']} of {cases} cases were solved")
    return {**found, "disk": size / 2**20}


def one_loop(program, cases, elements, workers):
    """The bare loop in several processes, each with its part of the cases"""
    borders = [cases * k // workers for k in range(workers + 1)]
    wall, processor = time.perf_counter(), used()
    parts = [subprocess.Popen([program, str(cases), str(elements), str(first), str(last - 1)], stdout=subprocess.PIPE, text=True)
             for first, last in zip(borders, borders[1:])]
    total = sum(float(part.communicate()[0].split()[-1]) for part in parts)
    if any(part.returncode for part in parts):
        sys.exit("the loop failed")
    return {"wall": time.perf_counter() - wall, "processor": used() - processor, "sum": total}


def middle(runs, what):
    """Median of several runs"""
    return statistics.median(one[what] for one in runs)


def table(options):
    """Table of the acceptance criteria"""
    program = options.loop or SOURCE / "build/release/tests/study_loop"
    print(f"{options.cases} cases of {options.elements} x {options.elements}, medians of {options.turns}\n\n"
          "| workers | loop: wall | processor time a case | study: wall | processor time a case | over the loop: wall "
          "| processor time | memory | folder |\n|---|---|---|---|---|---|---|---|---|", flush=True)
    walls = {}
    for workers in (1, 2):
        loops, studies = [], []
        for _ in range(options.turns):
            loops.append(one_loop(program, options.cases, options.elements, workers))
            studies.append(one_study(options.cases, options.elements, workers))
            if abs(studies[-1]["sum"] / loops[-1]["sum"] - 1) > 1e-12:
                sys.exit("the study has other forces than the loop")
        walls[workers] = middle(studies, "wall")
        pairs = list(zip(studies, loops))
        ratios = [statistics.median(one[what] / other[what] for one, other in pairs) for what in ("wall", "processor")]
        print(f"| {workers} | {middle(loops, 'wall'):.1f} s | {1e6 * middle(loops, 'processor') / options.cases:.1f} us "
              f"| {walls[workers]:.1f} s | {1e6 * middle(studies, 'processor') / options.cases:.1f} us "
              f"| {ratios[0]:.3f} | {ratios[1]:.3f} "
              f"| {max(one['memory'] for one in studies):.0f} MB | {middle(studies, 'disk'):.0f} MB |", flush=True)
    print(f"\nTwo workers are {walls[1] / walls[2]:.2f} times as fast as one.\n")
    print(f"{options.tasks} cases, one worker\n\n| points a task | processor time a case | over the loop |\n|---|---|---|",
          flush=True)
    for points in (1, 10, 100, 1000, None):
        loops, studies = [], []
        for _ in range(options.turns):
            loops.append(one_loop(program, options.tasks, options.elements, 1))
            studies.append(one_study(options.tasks, options.elements, 1, points))
        ratio = statistics.median(one["processor"] / other["processor"] for one, other in zip(studies, loops))
        print(f"| {points or 'its own'} | {1e6 * middle(studies, 'processor') / options.tasks:.0f} us | {ratio:.3f} |", flush=True)


def main():
    """Run the command line"""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    kinds = parser.add_subparsers(dest="kind", required=True)
    single, whole = kinds.add_parser("run"), kinds.add_parser("table")
    for one in (single, whole):
        one.add_argument("cases", type=int, help="a multiple of 10000")
        one.add_argument("--elements", type=int, default=19)
    single.add_argument("--workers", type=int, default=1)
    single.add_argument("--engine", default="threads")
    single.add_argument("--points", type=int)
    single.add_argument("--folder")
    whole.add_argument("--turns", type=int, default=3)
    whole.add_argument("--tasks", type=int, default=10000, help="cases of the table of tasks, a multiple of 10000")
    whole.add_argument("--loop", help="the program of loop.c; default build/release/tests/study_loop")
    options = parser.parse_args()
    (run if options.kind == "run" else table)(options)


if __name__ == "__main__":
    main()
