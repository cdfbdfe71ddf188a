#!/usr/bin/env python3
"""One number of a profile is wrong, or two rows are exchanged: reported or refused, without a large increase of the run time.

usage: profile_mutations.py [COUNT [SEED]]    COUNT random mutations (default 16, seed 5) beside those that were found once
The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.

Examples run with one row of one profile changed, with and without smoothing. A run passes if it takes less than ten times the
processor time of the correct profile and, if the point is more than 2 mm off the curve, ends in an error with the name of the file
and the line or in a warning with the name of the file. A point that is ten times as far out once took two hundred times the time.
"""
import math
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]
EXAMPLES = os.path.join(SOURCE, "examples")
#: Maximum processor time with a wrong number, relative to the correct profile, and time to start a program [s]
MOST_TIMES, START = 10.0, 0.3
#: Maximum processor time of a run [s]
PATIENCE = 30 * max(1, math.ceil(float(os.environ.get("CONTACT_SLOWER", "1"))))
#: Distance from the curve that must be reported [mm]
GROSS = 2.0
PROFILES = {"single_wheel": ("groove.txt", "roller.txt"), "manchester": ("60E1.prr", "S1002.prw"),
            "roller_rig": ("60E1.prr", "S1002.prw"), "wheel_flat": ("60E1.prr", "flat/slice_12.prw"),
            "rolling_steps": ("60E1.prr", "S1002.prw"), "conformal_wheel": ("60E1.prr", "S1002.prw"),
            "wheel_on_rail": ("60E1.prr", "S1002.prw")}
ROW = re.compile(r"^\s*(-?[\d.]+(?:[eE][-+]?\d+)?)\s+(-?[\d.]+(?:[eE][-+]?\d+)?)\s*$")
#: Smoothing: SMOOTH, and ISMOOTH unless it is 0
SMOOTHING = ((0.0, 0), (0.0, 0), (0.5, 0), (2.0, 0), (0.5, 1), (3.0, 1), (0.0, 2), (3.0, 2))
#: Found by random mutations: example, profile, line, column, factor, smoothing. They took 12 to 200 times the time
FOUND = (("single_wheel", "groove.txt", 208, 0, 10.0, (0.0, 0)), ("single_wheel", "groove.txt", 211, 0, 10.0, (0.0, 1)),
         ("single_wheel", "roller.txt", 36, 1, 90.0, (0.0, 1)), ("roller_rig", "60E1.prr", 242, 0, 10.0, (2.0, 1)),
         ("roller_rig", "60E1.prr", 64, 1, -1.0, (0.0, 0)), ("rolling_steps", "60E1.prr", 180, 1, 0.1, (0.0, 0)),
         ("rolling_steps", "60E1.prr", 225, 0, 2.0, (0.5, 0)), ("wheel_flat", "60E1.prr", 172, 0, 10.0, (0.5, 2)),
         ("manchester", "S1002.prw", 410, 1, 10.0, (0.0, 0)), ("conformal_wheel", "S1002.prw", 363, 0, -1.0, (0.0, 0)))


def rows_of(lines):
    return [k for k, line in enumerate(lines) if ROW.match(line)]


def values(line):
    return [float(text) for text in ROW.match(line).groups()]


def smoothed(text, profile, smoothing):
    """The input with the smoothing of a profile; that of slices is unchanged"""
    smooth, method = smoothing
    if smoothing == (0.0, 0) or "/" in profile:
        return text

    def profile_line(match):
        start, mirror_z, rest = match.groups()
        if method == 0:
            return f"{start} {smooth}{mirror_z or ''}{rest}"
        return f"{start} {smooth}{mirror_z or ' 0'} 1 {rest}\n {method} 150d 30d 6d 2.0"

    return re.sub(rf"('profiles/{re.escape(profile)}' 0 1.0) 0.0( -1)?([^\n]*)", profile_line, text)


def random_change(draw, lines):
    """Lines with one number changed or two rows exchanged, description of the change, and distance of the point from the curve"""
    rows = rows_of(lines)
    changed, k = list(lines), draw.choice(rows)
    if draw.random() < 0.2:
        j = draw.choice(rows)
        changed[j], changed[k] = lines[k], lines[j]
        return changed, f"lines {j + 1} and {k + 1} exchanged", 0.0
    column = draw.choice((0, 0, 1, 1))
    factor = draw.choice((10.0, 0.1, -1.0, 100.0, 2.0, 0.0, None))
    return change(lines, k, column, factor, draw.choice((-1, 1)) * 10 ** draw.uniform(-2, 2))


def change(lines, k, column, factor, shift=0.0):
    """One number multiplied, or shifted if there is no factor"""
    changed, point = list(lines), values(lines[k])
    point[column] = point[column] * factor if factor is not None else point[column] + shift
    changed[k] = f" {point[0]:.9g} {point[1]:.9g}"
    others = [values(lines[j]) for j in rows_of(lines)]
    return changed, f"line {k + 1}: {lines[k].strip()} -> {changed[k].strip()}", min(math.dist(point, other) for other in others)


def run(text, profile=None, lines=None):
    """Processor time [s], exit status and messages"""
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(os.path.join(EXAMPLES, "profiles"), os.path.join(folder, "profiles"))
        if profile:
            with open(os.path.join(folder, "profiles", profile), "w") as file:
                file.write("\n".join(lines))
        with open(os.path.join(folder, "x.inp"), "w") as file:
            file.write(text)
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        done = subprocess.run([PROGRAM, "--quiet", "--threads", "1", "2", "x"], cwd=folder, capture_output=True, text=True,
                              errors="replace", stdin=subprocess.DEVNULL,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (PATIENCE, PATIENCE)))
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        said = done.stdout + done.stderr
        if os.path.exists(os.path.join(folder, "x.out")):
            with open(os.path.join(folder, "x.out")) as file:
                said += "".join(line for line in file if "Warning" in line)
    return seconds, done.returncode, said


def judge(sound, text, profile, changed, distance):
    """Description of the failure, "" if there is none"""
    seconds, status, said = run(text, profile, changed)
    if status not in (0, 1):
        return f"ends with {status} after {seconds:.1f} s: {said[-200:]}"
    if seconds > MOST_TIMES*sound + START:
        return f"takes {seconds:.2f} s, the sound profile {sound:.2f} s"
    if status == 1 and not re.search(rf"ERROR.*{re.escape(profile)}", said):
        return f"fails without the name of the profile: {said[-200:]}"
    if distance > GROSS and os.path.basename(profile) not in said:
        return f"{distance:.1f} mm from the curve, without a word"
    return ""


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 16
    draw = random.Random(int(sys.argv[2]) if len(sys.argv) > 2 else 5)
    tasks = []
    for example, profile, line, column, factor, smoothing in FOUND:
        tasks.append((example, profile, smoothing, lambda lines, n=line, c=column, f=factor:
                      change(lines, n - 1, c, f, 90.0)))
    for _ in range(count):
        example = draw.choice(sorted(PROFILES))
        tasks.append((example, draw.choice(PROFILES[example]), draw.choice(SMOOTHING),
                      lambda lines: random_change(draw, lines)))
    sound, failures = {}, 0
    for example, profile, smoothing, mutate in tasks:
        with open(os.path.join(EXAMPLES, example + ".inp")) as file:
            text = smoothed(file.read(), profile, smoothing)
        with open(os.path.join(EXAMPLES, "profiles", profile)) as file:
            lines = file.read().split("\n")
        key = (example, profile, smoothing)
        if key not in sound:
            sound[key], status, said = run(text)
            assert status == 0, f"{key}: the sound example fails: {said}"
        changed, what, distance = mutate(lines)
        wrong = judge(sound[key], text, profile, changed, distance)
        if wrong:
            failures += 1
            print(f"FAILED {example}, {profile}, smoothing {smoothing}, {what}: {wrong}")
    print(f"{len(tasks) - failures} right, {failures} wrong")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
