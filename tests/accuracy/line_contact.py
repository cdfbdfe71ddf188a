"""Estimated errors of line contacts in rolling against Carter's solution: python3 line_contact.py [--check]

A steel cylinder of 500 mm radius on a half-space, half-width 1 mm, friction 0.3, on grids of 17 to 101 elements. The force of
creepage xi is f = 1 - (1 - xi/xi_s)^2 times the friction bound, xi_s = mu a/R. Near full sliding the area of adhesion is smaller
than an element, on both levels of the estimate. The output is the effectivity, the estimated over the true error of FX, by order.
--check fails if one is below the bound of the test. CONTACT_PROGRAM names the program.
"""
import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

#: Forces relative to the friction bound, and numbers of elements along the potential contact, 1.1 times as long as the contact
FORCES = (0.2, 0.5, 0.64, 0.8, 0.9, 0.97, 0.99, 0.995)
ELEMENTS = (17, 19, 21, 23, 25, 27, 33, 43, 61, 101)
#: Creepage of full sliding, friction and offset of the grid in elements
FULL, MU, OFFSET = 6e-4, 0.3, 0.13
#: Smallest effectivity of the test; 0.04 and 0.13 by orders 1 and 2 without a bound for line contacts
LEAST = 0.25


def case_of(force, n):
    """A case of the input file."""
    dx = 2.2 / n
    creepage = -FULL * (1.0 - math.sqrt(1.0 - force))
    return (f"3 MODULE\n203100 PBTNFS\n022020 LDCMZE\n0001541 HGIAOWR\n999 100 30 1 1e-6\n35780 {creepage!r} 0 0\n"
            f"{MU} {MU}\n0 {dx!r} 30000\n0.28 0.28 82000 82000\n3\n"
            f"{n} 1 {-1.1 + (0.5 + OFFSET) * dx!r} 0 {dx!r} 200\n1 1\n0.001 0 0 0 0 0\n\n")


def effectivities(program, order, folder):
    """Estimated over true error of FX, by force and number of elements."""
    cases = [(force, n) for force in FORCES for n in ELEMENTS]
    (folder / "carter.inp").write_text("".join(case_of(*case) for case in cases) + "0 MODULE\n")
    subprocess.run([program, "--order", order, "--errors", "--quiet", "--json", "2", "carter"], cwd=folder, check=True)
    records = [json.loads(line) for line in (folder / "carter.jsonl").read_text().splitlines()]
    patches = [record["patches"][0] for record in records if record.get("case", 0) > 0]
    values = {}
    for case, patch in zip(cases, patches, strict=True):
        bound = MU * patch["totals"]["fn"]["value"]
        true = abs(patch["totals"]["fx"]["value"] - case[0] * bound)
        values[case] = patch["errors"]["fx_error"]["value"] / max(true, 1e-12 * bound)
    return values


def main():
    """Tables, or test."""
    program = os.environ["CONTACT_PROGRAM"]
    failures = []
    for order in "12":
        with tempfile.TemporaryDirectory() as name:
            values = effectivities(program, order, Path(name))
        print(f"order {order}\n| force | " + " | ".join(map(str, ELEMENTS)) + " |\n" + "|---" * (1 + len(ELEMENTS)) + "|")
        for force in FORCES:
            print(f"| {force} | " + " | ".join(f"{values[force, n]:.2f}" for n in ELEMENTS) + " |")
        failures += [f"order {order}, force {f}, {n} elements: {v:.2f}" for (f, n), v in values.items() if v < LEAST]
    if "--check" in sys.argv[1:] and failures:
        sys.exit(f"effectivities below {LEAST}: " + "; ".join(failures))


if __name__ == "__main__":
    main()
