#!/usr/bin/env python3
"""Orders of steady rolling on other contacts than ellipses of like bodies: the second table of doc/validation/second_order.md

second_order_study.py [name ...]; about a minute for each. CONTACT_PROGRAM names the program.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

PROGRAM = os.environ["CONTACT_PROGRAM"]
OFFSETS = np.vstack([[0.0, 0.0], np.random.default_rng(5).uniform(-0.5, 0.5, (9, 2))])
STEEL = "0.28 0.28 82000 82000"
# coefficients of x2 and y2 for an ellipse of 3 x 5 mm under 30 kN
ELLIPSE = ["1 1", "0.002436996253160624 0 0.001130294718810031 0 0 0"]


def profile(values, step):
    """A circle of 460 mm along x, heights across"""
    first = -step * (len(values) - 1) / 2
    return ["2 1", f"{len(values)}", f"0 460 {first} {step}"] + [f"{value:.12g}" for value in values]


def fourth_degree():
    """Curvature that grows to one side"""
    y = np.linspace(-12, 12, 241)
    return profile(y**2 / 160 + np.where(y > 0, y**3 / 3000, 0) + y**4 / 2e5, 0.1)


def two_ridges():
    """Two contact areas side by side"""
    y = np.linspace(-14, 14, 281)
    return profile(0.02 * (1 + np.cos(np.pi * y / 4.5)) + y**2 / 600, 0.1)


def case(n, offset, eps, *, fn=30e3, creep="0.0005 0.0002 0.0003", force=0, chi=0, law=0, friction=("0.3 0.3",),
         bodies=STEEL, model=0, memory=(), half=(3.3, 5.5), geometry=tuple(ELLIPSE), rolled=0.0):
    """A case of an input file on about n by n elements; those of all steps where a contact has rolled over a distance [mm]"""
    dx, dy = 2 * half[0] / n, 2 * half[1] / n
    motion = 2 if rolled else 3
    rows = ["3", f"20{motion}1{force}0", f"{law}22{model}20", "0000111", f"999 200 60 1 {eps:.3e}", f"{fn} {creep}", *friction,
            f"{chi}d {dx:.15g} 30000", bodies, *memory, "1",
            f"{n + 2} {n + 2} {-half[0] - (1 - offset[0]) * dx:.15g} {-half[1] - (1 - offset[1]) * dy:.15g} {dx:.15g} {dy:.15g}",
            *geometry]
    again = ["3", f"00{motion}1{force}0", "111010", "0101111", f"{fn} {creep}"]
    return "\n".join(rows + (round(rolled / dx) - 1) * again) + "\n"


FALLING = ("0.2 0.12 30 0 1", "0.001 10")
CONTACTS = {
    "chi": {"chi": 180},
    "fx": {"force": 1, "creep": "-0.4 0.0002 0.0003"},
    "fxfy": {"force": 2, "creep": "-0.4 0.3 0.0003"},
    "saturated": {"force": 2, "creep": "-0.9 0.2 0.0003"},
    "falling": {"law": 2, "friction": FALLING, "creep": "0.001 0 0.0003"},
    "layer_soft": {"model": 4, "memory": ("820 0.02 0 0",), "creep": "0.002 0.0008 0.0012"},
    "layer_as_soft": {"model": 4, "memory": ("820 0.002 0 0",), "creep": "0.001 0.0004 0.0006"},
    "layer_stiff": {"model": 4, "memory": ("820 0.0002 0 0",), "creep": "0.001 0.0004 0.0006"},
    "unlike_steel": {"bodies": "0.28 0.3 82000 70000"},
    "unlike": {"bodies": "0.28 0.3 82000 8200"},
    "viscoelastic_30mm": {"model": 1, "memory": ("1 1 0.001 0.001",)},
    "viscoelastic_3mm": {"model": 1, "memory": ("1 1 0.0001 0.0001",)},
    "viscoelastic_0.3mm": {"model": 1, "memory": ("1 1 0.00001 0.00001",)},
    "transient": {"rolled": 3.3},
    "transient_longer": {"rolled": 13.2},
    "transient_spin": {"rolled": 3.3, "creep": "0.001 0 0.001"},
    "profile": {"fn": 40e3, "half": (6.5, 5.0), "geometry": tuple(fourth_degree())},
    "two_areas": {"fn": 15e3, "half": (5.0, 7.5), "geometry": tuple(two_ridges())},
}


def solve(cases, order):
    """Relative FX and FY, or creepages where these are given, and MZ, of all cases, behind their last steps"""
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "a.inp").write_text("".join(cases) + "0\n", encoding="utf-8")
        subprocess.run([PROGRAM, "--threads", "1", "--quiet", "--json", "--order", str(order), "2", "a.inp"], cwd=folder,
                       check=True)
        lines = pathlib.Path(folder, "a.jsonl").read_text(encoding="utf-8").splitlines()
    patches = [record["patches"][0] for record in map(json.loads, lines) if record.get("patches")]
    left = [patch["solver"] for patch in patches if order == 2 and patch["solver"].get("tangential_order") != 2]
    if left:
        print(f"  {len(left)} cases at order 1: {left[0]}")
    patches = patches[len(patches) // len(cases) - 1::len(patches) // len(cases)]
    force = cases[0].split("\n")[1][4]
    names = ("cksi" if force in "12" else "fx_rel", "ceta" if force == "2" else "fy_rel")
    totals = [patch["totals"] for patch in patches]
    return np.array([[*(total[name]["value"] for name in names),
                      total["mz"]["value"] / (0.3 * 30e3 * np.sqrt(15))] for total in totals])


def study(name):
    """Errors on three grids by both orders, against the extrapolated second one"""
    what = CONTACTS[name]
    fine, half = (solve([case(n, offset, 1e-8, **what) for offset in OFFSETS[:3]], 2).mean(axis=0) for n in (160, 80))
    limit = fine + (fine - half) / 3
    print(name, "limit", limit)
    for order in (1, 2):
        sizes, jitter = [], []
        for n in (20, 40, 80):
            found = solve([case(n, offset, 1e-7, **what) for offset in OFFSETS[:6]], order)
            sizes.append(np.linalg.norm(np.sqrt(((found - limit)**2).mean(axis=0))))
            jitter.append(np.linalg.norm(found.std(axis=0)))
        print(f"  order {order}:", *(f"{size:.1e}" for size in sizes), f"order {np.log2(sizes[0] / sizes[-1]) / 2:.2f} jitter",
              *(f"{size:.1e}" for size in jitter), flush=True)


for chosen in sys.argv[1:] or CONTACTS:
    study(chosen)
