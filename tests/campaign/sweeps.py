#!/usr/bin/env python3
"""Sweeps in which contact patches appear, join and separate: every vertical force is found, and forces rise with the penetration.

    sweeps.py PROGRAM [--families flat split] [--number N] [--seed S] [--points P] [--verbose]

A family is drawn at random: wheels with flats of 20 to 110 mm and 0.1 to 3 mm, with sharp or rounded ends, that turn over the
flat; rails with a groove, or worn so that they touch in two or three places, under a wheel that moves sideways. Left and right,
track and roller. Along each sweep FZ is prescribed: it is met within EPS, or the program gives the reason why it cannot be met
(a jump, of which both sides are reported), and never in more than 30 trials. At some positions heights are prescribed instead: the
force must increase with each of them; over a step of a hundredth of the penetration it increases by at most a fraction of itself.
"""
import argparse
import json
import math
import os
import random
import subprocess
import sys
import tempfile

import numpy as np
import profiles

EPS, MAXNR = 1e-5, 30
#: Most growth of the force over a step of 3 % of the penetration, relative to it: 3/2 of 3 % by Hertz, more where a patch joins
MOST_GROWTH = 0.3

CASE = """ 1 MODULE
 %(config)d203%(by_force)d00 CPBTNFS
 00%(digits)s VLDCMZE
 0001201 HGIAOWR
 999 100 30 1 1e-5
"""
FIRST = """ 0.35 0.35
 0.28 0.28 82000 82000
 %(dx)g %(dx)g 1 90d 8 4
 %(track)s
%(rail)s
 0 0 0 0 0 0
%(wheelset)s
%(wheel)s
"""
PLACE = " 0 %(y).9g %(load).12g 0 %(yaw).9g %(pitch).12g\n %(speed)g 0 0 0 0 -43.5\n\n"


def flat(draw):
    """A wheel with a flat that is described by slices, and the pitch angles of a sweep"""
    length, rounded = draw.uniform(20, 110), draw.random() < 0.5
    radius = profiles.RADIUS
    half = 0.5*length/radius
    depth = radius*(1.0 - math.cos(half)) if not rounded else draw.uniform(0.1, 1.2)*length/60.0
    slices = []
    for angle in np.linspace(-2.2*half, 2.2*half, 25):
        if rounded:
            missing = depth*math.exp(-(1.5*angle/half)**2)
        else:
            missing = max(0.0, radius - radius*math.cos(half)/math.cos(angle))
        slices.append([float(angle), 0.0, -missing])
    rail = dict(body="rail", shape=["60E1"], format="simpack")
    wheel = dict(body="wheel", shape=["S1002"], format="table", slices=slices, interpol=1)
    side = draw.choice((0, 1))
    return dict(rail=rail, wheel=wheel, side=side, roller=draw.random() < 0.3, free=False, fz=math.exp(draw.uniform(7, 12)),
                dx=draw.choice((0.7, 1.0)), y=draw.choice((0.0, draw.uniform(-4, 5))),
                yaw=draw.choice((0.0, draw.uniform(-0.01, 0.01))), varied="pitch", range=[-1.6 * half, 1.6 * half],
                name=f"flat of {length:.0f} mm, {depth:.2f} mm deep, rounded {rounded}")


def split(draw):
    """A rail that is grooved or hollow under a barrel of about its own radius, and lateral positions of a sweep"""
    depth, width = draw.uniform(0.01, 0.12), draw.uniform(1.5, 6.0)
    rail = dict(body="rail", shape=["grooved", depth, width], format="table")
    if draw.random() < 0.5:
        rail["wear"] = [[draw.uniform(-0.03, 0.05), draw.uniform(-8, 8), draw.uniform(1.5, 5)]]
    wheel = dict(body="wheel", shape=["barrel", draw.choice((-400.0, 500.0, 2000.0)), 40.0], format="table")
    if wheel["shape"][1] < 0:
        wheel["shape"] = ["cylinder", 40.0]
    return dict(rail=rail, wheel=wheel, side=draw.choice((0, 1)), roller=draw.random() < 0.3, free=True,
                fz=math.exp(draw.uniform(5, 12)), dx=draw.choice((0.3, 0.5)), y=0.0,
                yaw=draw.choice((0.0, draw.uniform(-0.02, 0.02))), pitch=0.0, varied="y",
                range=[draw.uniform(-6, -1), draw.uniform(1, 6)],
                name=f"groove of {depth:.3f} mm, width {width:.1f} mm, {wheel['shape']}")


FAMILIES = {"flat": flat, "split": split}


def text(d, rail, wheel, places, by_force):
    """Input of all positions of a sweep; each is (varied value, load or height)"""
    sign = 1 if d["side"] else -1
    if d["roller"]:
        track = f"-1 {0.0 if d['free'] else sign*752.0} 0 500"
    else:
        track = "-1 0 0 0" if d["free"] else "14 0 1435 0.025"
    values = dict(config=d["side"] + (4 if d["roller"] else 0), by_force=by_force, dx=d["dx"], track=track, rail=rail, wheel=wheel,
                  wheelset=" 0 0 460" if d["free"] else " 1360 -70 460", speed=20000/500 if d["roller"] else 20000)
    pieces = []
    for k, (value, load) in enumerate(places):
        here = dict(d, load=load, **{d["varied"]: value}) if d["varied"] == "pitch" else dict(d, load=load, y=value)
        values["digits"] = "22033" if k == 0 else "11002"
        pieces.append(CASE % values)
        if k == 0:
            pieces.append(FIRST % values)
        pieces.append(PLACE % dict(y=sign * here["y"], load=load, yaw=sign * d["yaw"], pitch=here.get("pitch", 0.0),
                                   speed=values["speed"]))
    return "".join(pieces).replace(" 0011002 VLDCMZE", " 0111002 VLDCMZE") + " 0 MODULE\n"


def run(program, folder, name, source):
    with open(os.path.join(folder, name + ".inp"), "w") as file:
        file.write(source)
    done = subprocess.run([program, "2", name, "--json", "--quiet", "--threads", "1"], cwd=folder, capture_output=True, text=True,
                          timeout=600, stdin=subprocess.DEVNULL)
    with open(os.path.join(folder, name + ".jsonl")) as file:
        cases = [case for case in map(json.loads, file) if case["case"] > 0]
    return cases, done


def total(case, name):
    value = case["totals"][name]
    return value["value"] if isinstance(value, dict) else value


def judge(program, d, points, verbose):
    """Complaints about a sweep"""
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        lines = [" " + profiles.write(d[body], folder, body) for body in ("rail", "wheel")]
        places = [(float(value), d["fz"]) for value in np.linspace(*d["range"], points)]
        cases, done = run(program, folder, "force", text(d, *lines, places, 1))
        if len(cases) < points or done.returncode:
            return [f"exit status {done.returncode}: {(done.stdout + done.stderr)[-200:]}"]
        patches, most, reported = set(), 0, 0
        for (value, _), case in zip(places, cases):
            if not case["solved"]:
                wrong.append(f"at {value:.5g} no result: {case.get('reason')}")
                continue
            missed = abs(total(case, "fz_tr") - d["fz"])/d["fz"]
            trials = case.get("force_trials", case["totals"].get("force_trials", 0))
            most = max(most, trials)
            patches.add(len(case["patches"]))
            if missed > 1.01*EPS:
                if "jumps from" in case.get("reason", ""):
                    reported += 1
                else:
                    wrong.append(f"at {value:.5g} the force is missed by {missed:.1e}: {case['status']}, {case.get('reason')}")
            if trials > MAXNR:
                wrong.append(f"at {value:.5g} {trials} trials")
        for k in (0, points//2, points//3):
            if not cases[k]["solved"] or not cases[k]["patches"]:
                continue
            touch = total(cases[k], "z_ws") + total(cases[k], "smallest_gap")
            depth = max(total(cases[k], "z_ws") - touch, 1e-3)
            pens = depth*1.03**np.arange(-40, 20)
            swept, _ = run(program, folder, "heights", text(d, *lines, [(places[k][0], touch + pen) for pen in pens], 0))
            force = np.array([total(case, "fz_tr") for case in swept])
            fall, growth = np.diff(force), np.diff(force)/np.maximum(force[1:], 1e-9)
            if (fall < -1e-4*force[1:]).any():
                i = int(np.argmin(fall))
                wrong.append(
                    f"at {places[k][0]:.5g} the force falls from {force[i]:.1f} to {force[i + 1]:.1f} N between penetrations of "
                    f"{pens[i]:.6f} and {pens[i + 1]:.6f} mm, patches {len(swept[i]['patches'])}, {len(swept[i + 1]['patches'])}"
                )
            if (growth[20:] > MOST_GROWTH).any():
                i = 20 + int(np.argmax(growth[20:]))
                wrong.append(
                    f"at {places[k][0]:.5g} the force jumps from {force[i]:.1f} to {force[i + 1]:.1f} N between penetrations of "
                    f"{pens[i]:.6f} and {pens[i + 1]:.6f} mm, patches {len(swept[i]['patches'])}, {len(swept[i + 1]['patches'])}"
                )
    if verbose:
        print(f"  {d['name']}, FZ {d['fz']:.0f} N, roller {d['roller']}: patches {sorted(patches)}, most trials {most}, "
              f"jumps reported {reported}", flush=True)
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--families", nargs="*", default=sorted(FAMILIES), choices=sorted(FAMILIES))
    parser.add_argument("--number", type=int, default=2, help="sweeps of each family")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--points", type=int, default=13)
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    program, failures, count = os.path.abspath(options.program), 0, 0
    for family in options.families:
        for k in range(options.first, options.first + options.number):
            count += 1
            d = FAMILIES[family](random.Random(f"sweep {family} {options.seed} {k}"))
            for wrong in judge(program, d, options.points, options.verbose):
                failures += 1
                print(f"FAILED {family} {k} of seed {options.seed}, {d['name']}, FZ {d['fz']:.1f} N: {wrong}", flush=True)
    print(f"{count} sweeps, seed {options.seed}, {failures} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
