#!/usr/bin/env python3
"""Time and memory of a study of small cases, against the bare loop in loop.c.

usage: measure.py CASES [--workers N] [--engine threads|processes] [--points N] [--elements N] [--folder DIR]
"""
import argparse
import os
import resource
import sys
import time

sys.path.insert(0, os.path.join(os.environ["CONTACT_SOURCE"], "python"))
import contact
from bases import rolling
from contact.study import span


def main():
    """One run, told in a line"""
    parser = argparse.ArgumentParser()
    parser.add_argument("cases", type=int)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--engine", default="threads")
    parser.add_argument("--points", type=int)
    parser.add_argument("--elements", type=int, default=19)
    parser.add_argument("--folder")
    asked = parser.parse_args()
    spins = max(1, asked.cases // 10000)
    study = contact.Study(rolling(asked.elements), {
        "kinematics.cphi": span(-0.001, 0.001, spins) if spins > 1 else [0.0],
        "kinematics.ceta": span(-0.01, 0.01, 100), "kinematics.cksi": span(-0.01, 0.01, 100)}, folder=asked.folder)
    wall, used = time.perf_counter(), sum(os.times()[:4])
    found = study.run(asked.workers, engine=asked.engine, points_per_task=asked.points)
    wall, used = time.perf_counter() - wall, sum(os.times()[:4]) - used
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    count = found.status.size
    print(f"study: {count} cases, {asked.workers} {asked.engine}, {asked.points or 'own'} points a task: "
          f"{1e6 * used / count:.2f} us of processor time a case, {wall:.1f} s, {peak:.0f} MB, "
          f"sum {float((found.fx**2 + found.fy**2).sum()):.17g}, {int((found.status == 0).sum())} solved")


if __name__ == "__main__":
    main()
