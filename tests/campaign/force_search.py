#!/usr/bin/env python3
"""Random wheels on random rails under prescribed vertical forces: is the force found, and in how many trials?

    force_search.py PROGRAM [NUMBER] [--seed S] [--folder F] [--jobs J] [--only K] [--also K ...] [--keep] [--check] [--fresh]

Pairs 0 ... NUMBER-1 of seed S are run by PROGRAM. Every pair has its own random numbers, made of S and its own number, so that
`--only K` repeats it alone. Results are appended to F/results.jsonl; pairs that are listed there are not run again: a round that
was interrupted goes on where it ended. Inputs of pairs with a finding stay in F/pair_K, with --keep those of all.

What is judged, per pair:
  force     FZ(TR) against FZ, relative to EPS (1e-5) and to the small steps of the grids (1e-4)
  missed    the program says that the force is not reached. Then heights are prescribed (N = 0), by which another search,
            that of this script, looks for the force: when it is found within 1e-4, the miss is a finding ("missed, but there");
            when it jumps over the force within 1e-6 mm, or friction carries the wheel, the reason is physical
  silent    the force is not met although the case counts as converged: a finding
  trials    number of heights in one search, reported by the program ("force_trials"): never more than MAXNR = 30
  F = 1, 3  the longitudinal force is met, or friction cannot give it; the deflected rail is in balance

With --check the exit status is 1 when there is a finding; --fresh forgets the results of the folder. Needs nothing but Python
and numpy; profiles are those of profiles.py, half of them with grooves, ridges, ripples, facets or noise.
"""
import argparse
import collections
import concurrent.futures
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys

try:
    import numpy as np
except ImportError:
    print("SKIPPED: there is no numpy")
    sys.exit(77)
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import profiles

EPS, STEPS, MAXNR = 1e-5, 1e-4, 30
WITHIN_STEPS = "met within grid steps"
TIMEOUT = 120


def roughen(rng, recipe):
    """Causes of several patches: a narrow groove or ridge, ripples, sparse points, noise that is not smoothed away"""
    what = rng.choice(["groove", "groove", "ridge", "ripples", "facets", "noise", "worn"])
    size = recipe.get("scale", 1.0)
    if what in ("groove", "ridge"):
        depth = 10**rng.uniform(-2.0, 0.0)*(1 if what == "groove" else -0.3)
        recipe.setdefault("wear", []).append([depth*size, rng.uniform(-35, 25)*size, rng.uniform(0.7, 5)*size])
    elif what == "ripples":
        recipe["waves"] = [[10**rng.uniform(-3.0, -1.5), rng.uniform(4, 30), rng.uniform(0, 6.28)]]
    elif what == "facets":
        recipe["spacing"] = [rng.uniform(1, 3), rng.uniform(3, 6)]
    elif what == "noise":
        recipe.update(spacing=[0.2, rng.uniform(0.3, 0.8)], noise=10**rng.uniform(-3.3, -2.2))
    else:
        bells = [[rng.uniform(0, 3), rng.uniform(-8, 12), rng.uniform(6, 20)],
                 [rng.uniform(0, 2), rng.uniform(-38, -20), rng.uniform(4, 9)]]
        recipe.setdefault("wear", []).extend(bells)
    return what


# ---- Pairs -----------------------------------------------------------------------------------------
def make_pair(seed, number, folder):
    """Random data of a pair; its profiles are written to the folder"""
    rng = random.Random(f"force search {seed} {number}")
    os.makedirs(folder, exist_ok=True)
    pair = profiles.pair(rng)
    rough = []
    if pair["kind"] in ("flanged", "grooved", "crown", "flat", "varying") and rng.random() < 0.6:
        bodies = [body for body in ("rail", "wheel") if not pair[body].get("slices")]
        rough = [roughen(rng, pair[body]) for body in rng.sample(bodies, rng.randint(1, len(bodies)))]
    d = dict(number=number, kind_of_pair=pair["kind"], rough=rough, rail=pair["rail"], wheel=pair["wheel"], track=pair["track"],
             wheelset=pair.get("wheelset", [1360.0, -70.0, 460.0]))
    d["rail_line"], d["wheel_line"] = (profiles.write(pair[body], folder, body) for body in ("rail", "wheel"))
    free = d["kind_of_pair"] in ("crown", "grooved")
    size = d["rail"].get("scale", 1.0)
    varies = bool(d["rail"].get("slices") or d["wheel"].get("slices"))
    d["left"] = rng.random() < 0.5
    d["roller"] = (d["track"][0] <= 0.0 and not d["rail"].get("slices") and rng.random() < 0.5) \
        or (not varies and rng.random() < 0.2)
    if d["roller"]:
        if d["track"][0] > 0.0:
            d["track"] = [-1.0, 752.0*size, 0.0, 0.0]
        d["track"][3] = rng.choice([500.0, 10**rng.uniform(2.3, 3.2)])*size
    d["D"] = rng.choice([2, 2, 2, 3, 4, 5])
    d["T"] = rng.choice([3, 3, 3, 3, 0, 0, 1, 2])
    d["F"] = rng.choice([0, 0, 0, 0, 1, 3]) if d["T"] else 0
    d["fz"] = math.exp(rng.uniform(0.0, math.log(2e5)))
    if number % 25 == 0:
        d["fz"] = 1.0
    # about the size of a contact [mm]
    a = 6.0*(d["fz"]/1e5)**(1/3)*size**(1/3)
    d["dx"] = max(rng.choice([rng.choice([0.2, 0.5, 1.0])*size, a/rng.uniform(4, 10)]), a/12)
    d["ds"] = d["dx"]*rng.choice([1, 1, 0.5, 2])
    if free:
        d["y"] = rng.uniform(-3, 3)
    else:
        d["y"] = rng.choice([rng.uniform(-8, 8), rng.uniform(4, 14), rng.uniform(-3, 3)])*size
    if rng.random() < 0.04:
        d["y"] = rng.uniform(-90, 90)*size
    d["s"] = rng.uniform(-50, 50) if d["rail"].get("slices") else 0.0
    d["pitch"] = 0.0
    if d["wheel"].get("slices"):
        d["pitch"] = 1.2*rng.uniform(-1, 1)*d["wheel"]["slices"][-1][0]
    d["yaw"] = rng.choice([0.0, rng.uniform(-0.02, 0.02), rng.uniform(-0.06, 0.06)])
    d["roll"] = rng.choice([0.0, 0.0, rng.uniform(-0.02, 0.02)])
    d["mu"] = rng.uniform(0.05, 0.6)
    d["slip"] = rng.choice([0.0, rng.gauss(0, 0.002), rng.gauss(0, 0.02)])
    d["vy"] = rng.choice([0.0, rng.gauss(0, 0.002)])
    d["fx"] = rng.uniform(-1.2, 1.2)*d["mu"]*d["fz"]
    d["springs"] = [10**rng.uniform(3, 5), rng.uniform(-0.2, 0.2)*d["fz"], 10**rng.uniform(4, 6), 0.0]
    return d


def input_text(d, heights=None, vpitch=None):
    """The input of a pair; of cases with prescribed heights when these are given"""
    sign = -1 if d["left"] else 1
    side = (0 if d["left"] else 1) + (4 if d["roller"] else 0)
    force = 0 if heights is not None else d["F"]
    radius = d["wheelset"][2]
    cases = []
    for k, height in enumerate(heights if heights is not None else [None]):
        case = [" 1 MODULE", " %d20%d%d%d0 CPBTNFS" % (side, d["T"], 1 if height is None else 0, force)]
        case.append(" 00%d2033 VLDCMZE" % d["D"] if k == 0 else " 0111002 VLDCMZE")
        case.append(" 0001201 HGIAOWR" if k == 0 else " 0101201 HGIAOWR")
        if k == 0:
            case += [" 999 100 %d 1 %g" % (MAXNR, EPS), " %.6f %.6f" % (d["mu"], d["mu"]), " 0.28 0.28 82000 82000",
                     " %.6g %.6g 1 90d 8 4" % (d["dx"], d["ds"])]
            track = list(d["track"])
            if track[0] <= 0.0:
                track[1] *= sign
            case.append(" " + " ".join("%.9g" % value for value in track))
            case += [d["rail_line"], " 0 0 0 0 0 0"]
            if force == 3:
                case.append(" %.6g %.6g %.6g %.6g" % tuple(d["springs"]))
            case += [" " + " ".join("%.9g" % value for value in d["wheelset"]), d["wheel_line"]]
        case.append(" %.9g %.9g %.12g %.9g %.9g %.9g" % (d["s"], sign*d["y"], d["fz"] if height is None else height,
                                                      sign*d["roll"], sign*d["yaw"], d["pitch"]))
        if d["T"] == 1:
            # displacements in the order of those that make a contact slide
            forward, across, rate = 0.0, d["vy"], -d["slip"]/radius
        else:
            forward, across, rate = 20000.0, 20000.0*d["vy"], -20000.0/radius*(1.0 + d["slip"])
        if d["roller"]:
            forward /= d["track"][3]
        if vpitch is not None:
            rate = vpitch
        case.append(" %.9g %.9g 0 0 0 %.12g" % (forward, sign*across, d["fx"] if force == 1 else rate))
        cases.append("\n".join(case))
    return "\n\n".join(cases) + "\n\n 0 MODULE\n"


class Run:
    """One run of the program: exit status, cases, messages"""

    def __init__(self, program, folder, name, text):
        with open(os.path.join(folder, name + ".inp"), "w") as file:
            file.write(text)
        self.cases, self.out, self.error, self.status = [], "", "", None
        results = os.path.join(folder, name + ".jsonl")
        if os.path.exists(results):
            os.remove(results)
        try:
            run = subprocess.run([program, "2", name, "--json", "--quiet"], cwd=folder, capture_output=True, text=True,
                                 timeout=TIMEOUT, stdin=subprocess.DEVNULL, env=dict(os.environ, OMP_NUM_THREADS="1"))
        except subprocess.TimeoutExpired:
            self.error = "time limit"
            return
        self.status, self.error = run.returncode, run.stderr
        try:
            with open(results) as file:
                self.cases = [case for case in map(json.loads, file) if case["case"]]
            with open(os.path.join(folder, name + ".out")) as file:
                self.out = file.read()
        except OSError:
            pass


def totals(case):
    return {key: value["value"] if isinstance(value, dict) else value for key, value in case.get("totals", {}).items()}


def find_force(program, folder, d, found):
    """Another search for the force, with prescribed heights: its outcome and height"""
    touch = found["z_ws"] + found["smallest_gap"]
    vpitch = found["vpitch_ws"] if d["F"] == 1 else None

    def forces(heights):
        run = Run(program, folder, "heights", input_text(d, heights, vpitch))
        answer = [totals(case).get("fz_tr", math.nan) if case["solved"] else math.nan for case in run.cases]
        for k, case in enumerate(run.cases):
            normal[heights[k]] = sum(totals(patch)["fn"] for patch in case["patches"]) if case["solved"] else math.nan
        return np.array(answer + [math.nan]*(len(heights) - len(answer)))

    normal, carried = {}, None  # normal forces by height; a height at which friction carries the wheel
    pens = np.geomspace(1e-6, 8.0, 48)
    z = touch + pens
    f = forces(z) - d["fz"]
    best = np.nanmin(np.abs(f)) if np.isfinite(f).any() else math.nan
    jump = None
    for i in range(len(z) - 1):
        if not (np.isfinite(f[i:i + 2]).all() and f[i]*f[i + 1] <= 0):
            continue
        low, high, fl, fh = z[i], z[i + 1], f[i], f[i + 1]
        wedged = False
        for _ in range(8):
            inner = np.linspace(low, high, 12)
            g = np.concatenate(([fl], forces(inner[1:-1]) - d["fz"], [fh]))
            if not np.isfinite(g).all():
                break
            best = np.nanmin([best, np.abs(g).min()])
            if best <= STEPS*d["fz"]:
                here = inner[np.abs(g).argmin()]
                if STEPS*normal[here] <= d["fz"]:
                    return "there", here, best
                # wedged between flanks: the sum of the normal forces is smaller than the resolution of their steps
                carried, best, wedged = here, math.nan, True
                break
            k = next(j for j in range(11) if g[j]*g[j + 1] <= 0)
            low, high, fl, fh = inner[k], inner[k + 1], g[k], g[k + 1]
            if high - low < 1e-9:
                break
        if not wedged:
            jump = (low, fl + d["fz"], fh + d["fz"])
    if jump:
        return "jump", jump[0], jump[1:]
    if carried:
        return "friction carries", carried, math.nan
    return "not there", None, best


def judge(program, seed, number, root, keep):
    folder = os.path.join(root, "pair_%d" % number)
    d = make_pair(seed, number, folder)
    run = Run(program, folder, "pair", input_text(d))
    result = dict(d, kind="", note="", trials=None, error=None)
    warnings = " ".join(re.findall(r"(?i)warning:?(.*)", run.out + "\n" + run.error))
    if not run.cases:
        message = (run.error.strip().splitlines() or ["none"])[0]
        result.update(kind="refused" if run.status == 1 else "failed", note=message[:300])
    else:
        case = run.cases[0]
        t = totals(case)
        result["trials"] = case.get("force_trials", t.get("force_trials"))
        patches = len(case.get("patches", []))
        result["patches"], result["converged"] = patches, case["converged"]
        if not case["solved"]:
            result.update(kind="refused", note=str(case.get("failure"))[:300])
        elif patches == 0:
            result.update(kind="no contact", note=warnings[:300])
        else:
            error = abs(t["fz_tr"] - d["fz"])/d["fz"]
            result.update(error=error, z=t["z_ws"], note=warnings[:400])
            patch_missed = any(p["solver"]["normal_ended"] != "converged" or
                               p["solver"].get("tangential_ended", "converged") != "converged" for p in case["patches"])
            if error <= 1.01*EPS:
                result["kind"] = "met"
            elif error <= 1.01*STEPS:
                result["kind"] = WITHIN_STEPS
            elif case["converged"]:
                result["kind"] = "SILENT"
            elif d["F"] == 3:
                result["kind"] = "missed on springs"
            else:
                how, where, rest = find_force(program, folder, d, t)
                normal = sum(totals(patch)["fn"] for patch in case["patches"])
                if normal > 20.0*d["fz"] and abs(t["fz_tr"] - d["fz"]) < STEPS*normal and "friction carries" in warnings:
                    # a small difference of large forces, which are known to EPS themselves
                    how = "friction carries"
                result["other"] = [how, where, rest if how != "jump" else list(rest)]
                result["kind"] = {"there": "MISSED, BUT THERE", "jump": "jump", "not there": "out of reach",
                                  "friction carries": "friction carries the wheel"}[how]
            if error <= 1.01*STEPS and not case["converged"]:
                if patch_missed:
                    result["kind"] += ", patch not converged"
                elif d["F"] == 1:
                    # friction must be used up in the direction of the force that is missing
                    missing = d["fx"] - t["fx_ws"]
                    limit = d["mu"]*sum(totals(p).get("fn", 0.0) for p in case["patches"])
                    if "friction cannot" in warnings and abs(t["fx_ws"]) >= 0.98*limit*0.9 and missing*t["fx_ws"] > 0:
                        result["kind"] += ", FX beyond friction"
                    else:
                        result["kind"] += ", FX MISSED"
                elif d["F"] == 3:
                    result["kind"] += ", springs not in balance"
                else:
                    result["kind"] += ", not converged"
            # FX is met within EPS of the whole force on the wheel, of which a flank may carry far more than FZ
            elif d["F"] == 1 and error <= 1.01*STEPS and abs(d["fx"] - t["fx_ws"]) > max(
                    3e-4*math.hypot(d["fx"], d["fz"]), 1.1*EPS*math.hypot(t["fx_tr"], t["fy_tr"], t["fz_tr"])):
                result["kind"] += ", FX SILENT"
            if result["trials"] is not None and result["trials"] > MAXNR:
                result["kind"] += ", TOO MANY TRIALS"
    finding = any(word.isupper() and len(word) > 2 for word in re.split(r"[ ,]+", result["kind"])) or result["kind"] == "failed"
    result["finding"] = finding
    if not (keep or finding):
        shutil.rmtree(folder)
    return result


def table(results):
    kinds = collections.Counter(r["kind"] for r in results)
    print("%d pairs" % len(results))
    for kind, n in kinds.most_common():
        print("  %5d  %5.2f %%  %s" % (n, 100.0*n/len(results), kind))
    trials = [r["trials"] for r in results if r["trials"] is not None]
    if trials:
        print("trials of one search: median %d, 99 %% %d, most %d" % (np.median(trials), np.percentile(trials, 99), max(trials)))
        counts = collections.Counter(trials)
        print("  " + " ".join("%d:%d" % item for item in sorted(counts.items())))
    for label in ("D", "T", "F", "kind_of_pair"):
        rows = collections.defaultdict(lambda: [0, 0, 0])
        for r in results:
            rows[r[label]][0] += 1
            rows[r[label]][1] += r["kind"] not in ("met", WITHIN_STEPS)
            rows[r[label]][2] += r["finding"]
        print("by %s (pairs, not met, findings): " % label + "; ".join("%s %d %d %d" % (k, *rows[k]) for k in sorted(rows)))
    notes = collections.Counter(re.sub(r"[-+]?\d[\d.eE+-]*", "#", r["note"])[:150] for r in results
                                if r["kind"] in ("refused", "failed", "no contact"))
    for note, n in notes.most_common(12):
        print("  %d x %s" % (n, note))
    for r in results:
        if r["finding"]:
            print("  finding: pair %d, %s: %s" % (r["number"], r["kind"], r["note"][:160]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("number", nargs="?", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", default="force_search")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--only", type=int)
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--fresh", action="store_true")
    parser.add_argument("--within-eps", action="store_true", help="a force that is met within grid steps is a finding, too")
    parser.add_argument("--also", type=int, nargs="*", default=[], help="further pairs")
    a = parser.parse_args()
    program, root = os.path.abspath(a.program), os.path.abspath(a.folder)
    if a.fresh:
        shutil.rmtree(root, ignore_errors=True)
    os.makedirs(root, exist_ok=True)
    if a.only is not None:
        result = judge(program, a.seed, a.only, root, True)
        print(json.dumps(result, indent=1, default=float))
        return 1 if result["finding"] and a.check else 0
    name, known = os.path.join(root, "results.jsonl"), {}
    if os.path.exists(name):
        with open(name) as file:
            known = {r["number"]: r for r in map(json.loads, file) if r["seed"] == a.seed}
    numbers = sorted(set(range(a.number)) | set(a.also))
    if a.within_eps:
        global WITHIN_STEPS
        WITHIN_STEPS = "met within GRID STEPS"
    todo = [k for k in numbers if k not in known]
    with open(name, "a") as file, concurrent.futures.ThreadPoolExecutor(a.jobs) as pool:
        for result in pool.map(lambda k: judge(program, a.seed, k, root, a.keep), todo):
            result["seed"] = a.seed
            file.write(json.dumps(result, default=float) + "\n")
            file.flush()
            known[result["number"]] = result
    results = [known[k] for k in numbers]
    print("seed %d, %s" % (a.seed, program))
    table(results)
    return 1 if a.check and any(r["finding"] for r in results) else 0


if __name__ == "__main__":
    sys.exit(main())
