#!/usr/bin/env python3
"""Error against processor time over random contacts of both modules: python3 study.py [--contacts N] [--offsets K] [--write FOLDER]

Contacts of each kind are solved on several grids, each at random offsets by fractions of an element, with both orders of steady
rolling and two tolerances. Errors are taken against finer grids, extrapolated; times are those of the program including input and
output. The output is medians and 95 % quantiles; --write makes the page accuracy_study.md and its picture in a folder
(doc/validation). --check tests a small sample, as ctest does. CONTACT_PROGRAM names the program.
"""
import argparse
import json
import math
import os
import random
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import error_cases
import study_page
from error_cases import PROFILES, contact, curvatures, text_of, wheel, wheel_text

#: Elements along each side of the potential contact, and those of the references
GRIDS, REFERENCE = (10, 14, 20, 28, 40, 56, 80), (80, 160)
#: Length of the contact of a wheel on a rail [mm] along which the elements are counted
WHEEL_WINDOW = 12.0
TOLERANCES = (1e-3, 1e-5)
#: Orders of the totals of the references where the second order of steady rolling does not apply
FIRST, SECOND = 1, 2


def elliptic(source, c, b1, b3, full):
    """Ratios of the semi-axes of 0.1 to 10, with the area unchanged."""
    ratio = math.exp(source.uniform(math.log(0.1), math.log(10.0)))
    side, p0 = math.sqrt(c["a"] * c["b"]), c["fn"] / c["a"] / c["b"]
    old = max(c["a"], 0.5 * c["b"])
    c["a"], c["b"] = side * math.sqrt(ratio), side / math.sqrt(ratio)
    c["fn"] = p0 * c["a"] * c["b"]
    slower = old / max(c["a"], 0.5 * c["b"])
    c["creep"] = tuple(slower * x for x in c["creep"])
    c["spin"] *= slower
    b1, b3 = curvatures(c["a"], c["b"], c["gg"][0] / (1.0 - c["poiss"][0]), c["fn"])
    c["geometry"] = f'form = "quadratic"\nplanform = "unrestricted"\nb = [{b1!r}, 0.0, {b3!r}, 0.0, 0.0, 0.0]\n'


def two_patches(source, c, b1, b3, full):
    """Two ridges side by side, the second one slightly lower."""
    b, n, lower = c["b"], 2001, source.uniform(0.0, 0.1)
    y1, dy = -4.0 * b, 8.0 * b / (n - 1)
    heights = [b3 * (abs(y1 + k * dy) - 1.1 * b) ** 2 + (lower * b3 * b * b if y1 + k * dy > 0.0 else 0.0) for k in range(n)]
    c["geometry"] = (f'form = "profile"\nplanform = "unrestricted"\nxm = 0.0\nrm = {1 / (2 * b1)!r}\ny1 = {y1!r}\ndy1 = {dy!r}\n'
                     "b = [" + ", ".join(f"{v:.12g}" for v in heights) + "]\n")
    c["margin"] = 2.0


#: Kinds of the study: title, and function that makes a contact
KINDS = {"elliptic": elliptic, "profile": None, "two patches": two_patches, "falling": None, "viscoelastic": None, "layer": None,
         "heat": None, "dissimilar": None, "forces": None, "reverse": None, "transient": None, "shift": None, "normal": None,
         "wheel on rail": None}


def texts_of(contacts, n, eps, offsets):
    """Cases of all contacts of a kind at all offsets."""
    texts = []
    for c in contacts:
        for offset in offsets:
            if c["kind"] == "wheel on rail":
                size = WHEEL_WINDOW / n * (1.0 + 0.04 * offset[0])
                texts.append(wheel_text(dict(c, dx=size), 1, PROFILES).replace("eps = 1e-6", f"eps = {eps!r}"))
            else:
                texts.append(text_of(c, n, offset, eps))
    return texts


def seconds_of(command, folder):
    """Processor seconds of a process."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    one_thread = dict(os.environ, OMP_NUM_THREADS="1")
    done = subprocess.run(command, cwd=folder, env=one_thread, capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime, done


def solve(folder, contacts, n, order, eps, offsets):
    """Totals of each contact at each offset, None without a result, and processor seconds per contact."""
    (folder / "a.toml").write_text("\n".join(texts_of(contacts, n, eps, offsets)))
    program = os.environ["CONTACT_PROGRAM"]
    seconds, done = seconds_of([program, "--quiet", "--json", "--order", str(order), "2", "a"], folder)
    seconds = max(seconds - seconds_of([program, "--version"], folder)[0], 0.1 * seconds)
    records = [json.loads(line) for line in (folder / "a.jsonl").read_text().splitlines()]
    records = {r["case"]: r for r in records if "patches" in r and "case" in r}
    if not records:
        sys.exit(done.stdout + done.stderr)
    found, number = [], 0
    for c in contacts:
        for _ in offsets:
            number += c["steps"]
            record = records.get(number)
            found.append(values_of(record, c) if record and record.get("converged") and record["patches"] else None)
    return found, seconds / (len(contacts) * len(offsets))


def values_of(record, c):
    """Totals divided by the scales of their errors, by groups; for wheels on rails the forces in track coordinates."""
    totals = {name: v["value"] if isinstance(v, dict) else v for name, v in record["patches"][0]["totals"].items()}
    bound = c["mu"] * totals["fn"]
    if c["kind"] == "wheel on rail":
        patches = [{name: v["value"] if isinstance(v, dict) else v for name, v in p["totals"].items()} for p in record["patches"]]
        bound = c["mu"] * sum(p["fn"] for p in patches)
        whole = {name: v["value"] for name, v in record["totals"].items() if isinstance(v, dict)}
        groups = {"forces": [whole["fx_tr"] / bound, whole["fy_tr"] / bound]}
        if len(patches) == 1:
            groups |= {"peak": [math.log(totals["pmax"])], "power": [math.log(abs(totals["friction_power"]) + 1e-30)]}
        return groups
    groups = {"peak": [math.log(totals["pmax"])],
              "normal": [math.log(totals["fn"] if c["normal"] == "approach" else totals["pen"])]}
    if c["motion"] == "none":
        return groups
    # not the area of the elements in contact, which has an error of first order
    size = bound * math.sqrt(c["a"] * c["b"])
    groups["forces"] = [totals["fx"] / bound, totals["fy"] / bound, totals["mz"] / size]
    if c["tangential"] == "fx_and_fy":
        # relative to full sliding, so that they are comparable with forces
        groups["forces"] = [totals["cksi"] / c["full"], totals["ceta"] / c["full"], totals["mz"] / size]
    power = abs(totals.get("friction_power", totals.get("friction_work", 0.0)))
    groups["power"] = [math.log(power + 1e-30)]
    if "max_temp2" in totals:
        groups["temperature"] = [math.log(totals["max_temp2"])]
    return groups


def reference_of(folder, contacts, order, p, offsets):
    """Limits of the totals: means over offsets of two fine grids, extrapolated by the order p of the tangential problem."""
    levels = [solve(folder, contacts, n, order, 1e-6, offsets)[0] for n in REFERENCE]
    limits = []
    for k in range(len(contacts)):
        own = [level[k * len(offsets):(k + 1) * len(offsets)] for level in levels]
        if any(v is None for part in own for v in part):
            limits.append(None)
            continue
        limit = {}
        for group in own[0][0]:
            if any(group not in v for part in own for v in part):
                continue
            ratio = (REFERENCE[1] / REFERENCE[0]) ** (SECOND if group in ("normal", "peak", "temperature") else p)
            coarse, fine = ([sum(v[group][i] for v in part) / len(part) for i in range(len(part[0][group]))] for part in own)
            limit[group] = [f + (f - c) / (ratio - 1.0) for c, f in zip(coarse, fine)]
        limits.append(limit)
    return limits


def creepage_of_sliding(c):
    """Creepage of about full sliding."""
    p0 = 1.5 * c["fn"] / (math.pi * c["a"] * c["b"])
    return c["mu"] * p0 / c["gg"][0] * math.sqrt(c["a"] * c["b"]) * 4.0 * (1.0 - c["poiss"][0]) / max(c["a"], 0.5 * c["b"])


def measure(kind, count, source, offsets, grids, folder):
    """Rows of one kind: order, tolerance, grid, seconds, errors by group, and number without result."""
    make = KINDS[kind]
    if make:
        error_cases.CHANGES[kind] = make
    contacts = [wheel(source) if kind == "wheel on rail" else contact(source, kind) for _ in range(count)]
    for c in contacts:
        c["full"] = creepage_of_sliding(c) if "gg" in c else 1.0
    shifts = [(source.random(), source.random()) for _ in range(offsets)]
    orders = (FIRST,) if kind in ("transient", "shift", "normal") else (FIRST, SECOND)
    p = FIRST if kind == "transient" else SECOND
    limits = reference_of(folder, contacts, orders[-1], p, shifts[:2])
    rows = []
    for order in orders:
        for eps in TOLERANCES:
            for n in grids:
                found, seconds = solve(folder, contacts, n, order, eps, shifts)
                errors, missing = {}, 0
                for k, values in enumerate(found):
                    limit = limits[k // offsets]
                    if values is None or limit is None:
                        missing += 1
                        continue
                    for group in values.keys() & limit.keys():
                        error = max(abs(v - x) for v, x in zip(values[group], limit[group]))
                        errors.setdefault(group, []).append(error)
                rows.append({"kind": kind, "order": order, "eps": eps, "n": n, "seconds": seconds, "errors": errors,
                             "missing": missing, "contacts": count, "offsets": offsets})
    return rows


def complaints(rows):
    """Failures of a small sample: errors must decrease with refinement, and be smaller with the second order."""
    def median(kind, order, n, group="forces"):
        row = next(r for r in rows if (r["kind"], r["order"], r["n"], r["eps"]) == (kind, order, n, TOLERANCES[1]))
        return sorted(row["errors"][group])[len(row["errors"][group]) // 2]

    told = [f"{r['kind']}, {r['n']} elements, order {r['order']}: {r['missing']} without a result" for r in rows if r["missing"]]
    for kind in {r["kind"] for r in rows}:
        first, second = median(kind, FIRST, 28), median(kind, SECOND, 28)
        if second > 0.4 * first or second > 0.6 * median(kind, SECOND, 10):
            told.append(f"{kind}: {first:.1e} with order 1 on 28 elements, {second:.1e} with order 2")
    return told


def main():
    """Study, page, or test."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--contacts", type=int, default=16, help="number of contacts of each kind")
    parser.add_argument("--offsets", type=int, default=3, help="offsets of each grid")
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--check", action="store_true", help="test a small sample")
    parser.add_argument("--rows", help="file of the measured rows; if it exists, the page is made from it")
    parser.add_argument("--write", help="folder for the page and its picture")
    asked = parser.parse_args()
    grids = GRIDS
    if asked.check:
        asked.contacts, asked.offsets, asked.kinds, grids = 3, 2, "elliptic,two patches", (10, 28)
    rows = []
    if asked.rows and Path(asked.rows).exists():
        rows, asked.kinds = json.loads(Path(asked.rows).read_text()), ""
    with tempfile.TemporaryDirectory() as name:
        for number, kind in enumerate(asked.kinds.split(",") if asked.kinds else []):
            rows += measure(kind, asked.contacts, random.Random(asked.seed + number), asked.offsets, grids, Path(name))
            if not asked.check:
                print(kind, file=sys.stderr, flush=True)
    if asked.check:
        sys.exit("\n".join(complaints(rows)) or 0)
    if asked.rows:
        Path(asked.rows).write_text(json.dumps(rows))
    page, picture = study_page.make(rows, f"python3 tests/accuracy/study.py --contacts {rows[0]['contacts']}", TOLERANCES)
    print(page)
    if asked.write:
        Path(asked.write, "accuracy_study.md").write_text(page)
        Path(asked.write, "accuracy_study.svg").write_text(picture)


if __name__ == "__main__":
    main()
