#!/usr/bin/env python3
"""Run an example and compare it with its stored figures: example.py NAME

examples/NAME.inp is run into the current folder. NAME/figures.json beside this file says what shall
come out: case, quantity, value, absolute tolerance; and where the figures come from.
"""
import glob
import json
import os
import subprocess
import sys

import contract
import out_file

HERE = os.path.dirname(os.path.abspath(__file__))


def main(name):
    source, program = os.environ["CONTACT_SOURCE"], os.environ["CONTACT_PROGRAM"]
    with open(os.path.join(HERE, name, "figures.json")) as file:
        stored = json.load(file)
    for old in os.listdir("."):
        if old.startswith(name + "."):
            os.remove(old)
    run = subprocess.run([program, "--quiet", "--output-dir", ".", "2", os.path.join(source, "examples", name)],
                         stdin=subprocess.DEVNULL, capture_output=True, text=True)
    # debug builds report array temporaries on the error stream
    if run.returncode != 0 or run.stdout:
        print(run.stdout, run.stderr[-3000:], sep="")
        print("FAILED: exit status %d, or output in spite of --quiet" % run.returncode)
        return 1
    cases = out_file.read(name + ".out")
    failures = 0

    def check(condition, text):
        nonlocal failures
        if not condition:
            failures += 1
            print("FAILED: " + text)

    check(len(cases) == stored["cases"], "%d cases instead of %d" % (len(cases), stored["cases"]))
    for case, quantity, value, tolerance in stored["figures"]:
        found = cases.get(case, {}).get(quantity)
        if isinstance(value, str):
            check(found == value, "case %d, %s: %r instead of %r" % (case, quantity, found, value))
        else:
            check(found is not None and abs(found - value) <= tolerance,
                  "case %d, %s = %s instead of %s within %.2g" % (case, quantity, found, value, tolerance))
    for file in stored.get("files", []):
        check(os.path.isfile(file) and os.path.getsize(file) > 0, "there is no file " + file)
    complaints, files = contract.check_files(glob.escape(name) + ".*")
    check(files > 0 and not complaints, "\n".join(complaints[:20]))
    if name == "catt_to_cart":
        corresponding_cases(cases, check)
    print("%s: %d cases, %d figures, %d failures; figures from %s"
          % (name, len(cases), len(stored["figures"]), failures, stored["origin"]))
    return 1 if failures else 0


def corresponding_cases(cases, check):
    """Moving coordinates, a wide window and a moving window describe the same rolling.

    The first step may differ by 0.5 per cent, later ones by the digits that are printed: a shift is
    the creepage times the step of 0.25 mm, and the work of a step is the power times 0.25/1000 s.
    """
    for n in range(2, 58):
        rolling = cases[n]
        allowed = 5e-3 if n == 2 else 1e-3
        for other in (n + 57, n + 114):
            shift = cases[other]
            for quantity, factor in (("X", 0.25), ("POWER", 0.25 / 1000), ("ENERGY", 1.0), ("FX", 1.0)):
                expected = factor * rolling[quantity]
                check(abs(shift[quantity] - expected) <= allowed * abs(expected),
                      "case %d, %s = %s, but case %d makes it %s" % (other, quantity, shift[quantity], n, expected))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
