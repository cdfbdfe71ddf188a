#!/usr/bin/env python3
"""Limits of combined effects: random cases with several effects, one of which is taken to where it vanishes or becomes another one.

    python3 tests/campaign/limits.py --exe build/release/bin/contact --cases 3000 --seed 1 --jobs 2

A viscoelastic body that relaxes at once is an elastic one with its relaxed modulus, a layer without thickness is none, a roller
without end is a track, friction with equal coefficients is that of Coulomb, prescribed forces that a case with creepages has give
these creepages: with every other effect that can be combined, by both orders, in shifts, transient and steady rolling, for two
bodies and for a wheel on a rail. Each case is solved twice, in the readable format, and the totals are compared with a tolerance
from EPS or from the order of what is left of the effect. Cases that disagree are kept in --store. One that only one of both forms
refuses is a disagreement, too. The exit status is 1 when there was a disagreement.
"""
import argparse
import collections
import json
import math
import multiprocessing
import os
import random
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import limit_relations
import limit_scenes

# Totals that are compared, by their scale: forces relative to friction, moments to that times a length, slips to the largest slip
FORCES, SLIPS = ("fx", "fy"), ("cksi", "ceta", "shift_x", "shift_y")
OTHERS = ("fn", "pen", "pmax", "elastic_energy")
# Allowed difference of two solutions that stop at residuals of EPS, in units of EPS
AMPLIFICATION = 200.0
# With falling friction or yielding layers iterations end at a thousandth of the slip
BY_SLIP = 2e-3


def text_of(value):
    """A value of the readable format"""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(text_of(item) for item in value) + "]"
    return json.dumps(value) if isinstance(value, str) else repr(value)


def readable(scene):
    """A scene as text of the readable format: the common groups belong to the first case"""
    lines = []
    for number, step in enumerate(scene["steps"]):
        case = {key: dict(group) if isinstance(group, dict) else group for key, group in scene["common"].items()}
        case = case if number == 0 else {}
        for key, value in step.items():
            case[key] = {**case.get(key, {}), **value} if isinstance(value, dict) else value
        lines.append("[[case]]")
        lines += [f"{key} = {text_of(value)}" for key, value in case.items() if not isinstance(value, dict)]
        for key, group in case.items():
            if isinstance(group, dict):
                lines.append(f"[case.{key}]")
                lines += [f"{name} = {text_of(value)}" for name, value in group.items() if name != "set"]
                for row in group.get("set", []):
                    lines.append(f"[[case.{key}.set]]")
                    lines += [f"{name} = {text_of(value)}" for name, value in row.items()]
    return "\n".join(lines) + "\n"


def solve(scene, exe, folder, name):
    """Run the program: records of the cases with plain totals, and the messages"""
    for file_name, text in scene.get("files", {}).items():
        with open(os.path.join(folder, file_name), "w", encoding="utf-8") as file:
            file.write(text)
    with open(os.path.join(folder, name + ".toml"), "w", encoding="utf-8") as file:
        file.write(readable(scene))
    done = subprocess.run([exe, "2", name, "--json", "--quiet", "--threads", "1"], cwd=folder, capture_output=True, text=True,
                          timeout=600, check=False)
    records = []
    try:
        with open(os.path.join(folder, name + ".jsonl"), encoding="utf-8") as file:
            for line in file:
                record = json.loads(line)
                if record["case"]:
                    records.append(record)
    except OSError:
        pass
    for record in records:
        record["patches"] = [plain(patch["totals"]) for patch in record["patches"]]
        record["totals"] = plain(record.get("totals", {}))
    return records, (done.stderr or done.stdout).strip()


def plain(totals):
    return {name: value["value"] if isinstance(value, dict) else value for name, value in totals.items()}


def tolerance_of(scene, limit):
    """Allowed difference of two solutions of equivalent problems, and what the limit leaves of the effect"""
    tolerance = AMPLIFICATION*scene["common"]["iteration"]["eps"]
    if scene["law"] != "coulomb" or scene["kind"] == "plastic":
        tolerance = max(tolerance, BY_SLIP)
    return tolerance + limit


def compare(one, two, view):
    """Differences of the totals of two runs: texts; None if a case is not solved"""
    (records, message), (others, other_message) = one, two
    found = []
    for i, j in view.get("cases") or [(k, k) for k in range(max(len(records), len(others)))]:
        states = [items[k]["status"] if k < len(items) else "refused" for items, k in ((records, i), (others, j))]
        if states != ["solved", "solved"]:
            if "refused" in states and states[0] != states[1]:
                return [f"case {i + 1}: {states[0]} and {states[1]}: {message or other_message}"]
            return None
        mine, theirs = records[i], others[j]
        if len(mine["patches"]) != len(theirs["patches"]):
            return [f"case {i + 1}: {len(mine['patches'])} and {len(theirs['patches'])} patches"]
        for p, q in zip(mine["patches"], theirs["patches"]):
            found += [f"case {i + 1}: {text}" for text in compare_totals(p, q, view)]
    return found


def compare_totals(p, q, view):
    """Differences of the totals of one patch, by the scales of what they are"""
    factor, found = view.get("factor", {}), []
    size = math.sqrt(max(p["contact_area"], 1e-300))
    force = max(abs(p["fn"])*min(p.get("mu_scal") or 1.0, 1.0), math.hypot(p["fx"], p["fy"]), 1e-300)
    slip = max([abs(p.get(name) or 0.0) for name in SLIPS] + [abs(p.get("cphi") or p.get("rotation") or 0.0)*size, view["slip"]])
    for name in FORCES + SLIPS + OTHERS + ("mz",):
        if name in view.get("skip", ()) or p.get(name) is None or (name == "mz" and "bar_fn" in p):
            continue
        if q.get(name) is None:
            found.append(f"{name} is missing in one")
            continue
        other = q[name]*factor.get(name, 1.0)
        scale = force if name in FORCES else force*size if name == "mz" else slip if name in SLIPS else abs(p[name])
        if not abs(p[name] - other) <= view["tolerance"]*scale + 1e-14:
            found.append(f"{name} {p[name]:.7g} and {other:.7g}, {abs(p[name] - other)/max(scale, 1e-300):.1e} of its scale")
    return found


def judged(seed, number, exe, folder):
    """One case: name of the relation, description, differences (None: not solved)"""
    rng = random.Random(f"{seed}:{number}")
    name = rng.choice(sorted(limit_relations.RELATIONS))
    while True:
        scene = limit_scenes.scene(rng)
        try:
            view = limit_relations.RELATIONS[name](scene, rng)
            break
        except limit_relations.DoesNotApply:
            continue
    view["tolerance"] = tolerance_of(scene, view.get("limit", 0.0))
    view["slip"] = 1e-3*scene["slip"]
    one = solve(view["one"], exe, folder, "one")
    if callable(view["two"]):
        # made from the results of the first one
        if not one[0] or any(record["status"] != "solved" for record in one[0]):
            return name, limit_scenes.described(scene), None
        view["two"] = view["two"](one[0])
        if view["two"] is None:
            return name, limit_scenes.described(scene), None
    return name, limit_scenes.described(scene), compare(one, solve(view["two"], exe, folder, "two"), view)


def work(task):
    seed, number, exe, store = task
    with tempfile.TemporaryDirectory() as folder:
        name, what, found = judged(seed, number, exe, folder)
        if found and store:
            place = os.path.join(store, f"limits-{seed}-{number:06d}")
            shutil.rmtree(place, ignore_errors=True)
            shutil.copytree(folder, place)
    return number, name, what, found


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--exe", default=os.environ.get("CONTACT_PROGRAM", "build/release/bin/contact"))
    parser.add_argument("--cases", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--store", default="", help="folder for the input and the results of cases that disagree")
    parser.add_argument("--only", type=int, default=None, help="one case by its number")
    return parser.parse_args()


def main():
    options = arguments()
    exe, store = os.path.abspath(options.exe), os.path.abspath(options.store) if options.store else ""
    os.environ["OMP_NUM_THREADS"] = "1"
    numbers = range(options.cases) if options.only is None else [options.only]
    rows = collections.defaultdict(collections.Counter)
    with multiprocessing.Pool(options.jobs) as pool:
        for number, name, what, found in pool.imap(work, [(options.seed, number, exe, store) for number in numbers]):
            rows[name]["cases"] += 1
            rows[name]["agreed" if found == [] else "not solved" if found is None else "disagreed"] += 1
            if found:
                print(f"case {number}, {name}: {what}")
                print("\n".join("   " + text for text in found[:6]), flush=True)
    print("| limit | cases | agreed | not solved | disagreed |\n|---|---|---|---|---|")
    for name in sorted(rows):
        print("| " + " | ".join([name] + [str(rows[name][key]) for key in ("cases", "agreed", "not solved", "disagreed")]) + " |")
    return 1 if any(row["disagreed"] for row in rows.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
