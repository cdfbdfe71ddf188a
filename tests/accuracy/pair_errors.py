"""Estimated errors of elastic energy and frictional power of wheels on rails, half-spaces and springs: python3 pair_errors.py

Both totals need displacements or slip, which wheel and rail compute after the height is found. Wheels of a single patch are solved
on elements of a size and of a fourth of it. A few estimates may be large, as an error is small by chance; the test fails if one is
much too small, or if fewer than half of a total are of the right size. CONTACT_PROGRAM names the program.
"""
import os
import random
import sys
import tempfile
from pathlib import Path

from error_cases import PROFILES, some_wheels, wheel_text
from errors import run

#: Seed and number of wheels; elements of the reference are smaller by this factor
SEED, COUNT, FINER = 91001, 6, 4
#: Lines of a case for each model of the bodies
MODELS = {"half-spaces": "", "springs": 'material_model = "fastsim"\n'}
TOTALS = ("elastic_energy", "friction_power")
#: Smallest ratio of estimated and true error, largest one of the right size, fraction of these
LEAST, MOST, PART = 0.3, 5.0, 0.5


def ratios(program, folder, wheels, model):
    """Estimated over true errors of the totals."""

    def solve(factor):
        texts = [wheel_text(c, factor, PROFILES).replace("[case.iteration]", model + "[case.iteration]", 1) for c in wheels]
        return run(program, folder, f"elements{factor}", texts, factor == 1)

    coarse, fine = solve(1), solve(FINER)
    found = {name: [] for name in TOTALS}
    for number in coarse:
        levels = [r[number].get("patches", []) for r in (coarse, fine)]
        if not all(len(patches) == 1 for patches in levels):
            continue
        for name, values in found.items():
            first, second = (patches[0]["totals"][name]["value"] for patches in levels)
            values.append(levels[0][0]["errors"][f"{name}_error"]["value"] / abs(first - second))
    return found


def main():
    """Compare, and report what is wrong."""
    source = random.Random(SEED)
    wheels = some_wheels(source, COUNT)
    failed = False
    with tempfile.TemporaryDirectory() as name:
        for title, model in MODELS.items():
            for total, values in ratios(os.environ["CONTACT_PROGRAM"], Path(name), wheels, model).items():
                part = sum(LEAST <= v <= MOST for v in values) / max(1, len(values))
                wrong = len(values) < COUNT // 2 or min(values) < LEAST or part < PART
                failed |= wrong
                print(f"{title}, {total}: {' '.join(f'{v:.2f}' for v in values)}{': wrong' if wrong else ''}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
