#!/usr/bin/env python3
"""Every number of the examples replaced by an invalid or extreme one: no NaN in a result, no hang, no crash.

usage: mutations.py [COUNT [SEED]]    COUNT random mutations (default 250, seed 13); "all" for every one, which takes minutes
The environment gives CONTACT_PROGRAM and CONTACT_SOURCE; CONTACT_JOBS is the number of processes.

A mutation takes one number of an example, of its first case or cases, or of a profile, and replaces it. It passes if the run ends
in time, either with an error message or with results that are all finite numbers.
"""
import concurrent.futures
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]
EXAMPLES = os.path.join(SOURCE, "examples")
#: Replacements of a number
NONSENSE = ("nan", "inf", "-inf", "1e300", "-1e300", "1e20", "-1e20", "1e9", "0", "-1", "1e-300", "1e-9", "word", "180",
            "99999999999")
#: Maximum time of a run [s]
PATIENCE = 5.0 * float(os.environ.get("CONTACT_SLOWER", "1"))
#: Examples whose first case is small
SMALL = ("approximate", "bentall", "carter2d", "catt_to_cart", "cattaneo", "falling_friction", "layer_element", "layer_traction",
         "manchester", "roller_rig", "simplified", "single_wheel", "sliding_temperature", "spence35", "subsurface", "visc_rollers",
         "wheel_on_rail", "conformal_wheel")
NUMBER = re.compile(r"(?<![\w.'/])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?(?=[\s,dr]|$)")
#: A row of the picture of the contact area, in which a star denotes adhesion
PICTURE = re.compile(r"\s*\d+\s+[.*a-zA-Z|]+\s*$")
BAD = re.compile(r"(?<![\w'\"/.-])[-+]?(?:nan|infinity|inf)(?![\w'\"])|\*{5,}", re.IGNORECASE)


def first_cases(text):
    """The text up to the second module line that follows a case, with coarser grids; examples begin with small cases"""
    lines, modules = text.split("\n"), 0
    for k, line in enumerate(lines):
        if re.match(r"\s*[13](\s+\d+)*\s+MODULE", line) or re.match(r"\s*[13]\s+%", line):
            modules += 1
            if modules == 3:
                return "\n".join(lines[:k] + ["0 MODULE", ""])
    return text


def numbers(text):
    """Positions of the numbers that are read: the leading ones of each line, outside of comments"""
    found, start = [], 0
    for line in text.split("\n"):
        body = line.split("%")[0]
        for match in NUMBER.finditer(body):
            if re.search(r"[A-Za-z]", re.sub(r"'[^']*'|[\d.][dDeErR](?=[-+\d\s,]|$)", "", body[:match.start()])):
                break
            found.append((start + match.start(), start + match.end()))
        start += len(line) + 1
    return found


def mutations():
    """All mutations: example, file that is changed, position, replacement"""
    every = []
    for example in SMALL:
        with open(os.path.join(EXAMPLES, example + ".inp")) as file:
            text = first_cases(file.read())
        every += [(example, None, text, place, value) for place in numbers(text) for value in NONSENSE]
    for profile in ("60E1.prr", "S1002.prw"):
        with open(os.path.join(EXAMPLES, "profiles", profile)) as file:
            text = file.read()
        every += [("wheel_on_rail", profile, text, place, value) for place in numbers(text)[::9] for value in NONSENSE]
    return every


def run(mutation):
    """Failure of one mutation, "" if there is none"""
    example, profile, text, (first, last), value = mutation
    changed = text[:first] + value + text[last:]
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(os.path.join(EXAMPLES, "profiles"), os.path.join(folder, "profiles"))
        if profile is None:
            source = changed
        else:
            with open(os.path.join(folder, "profiles", profile), "w") as file:
                file.write(changed)
            with open(os.path.join(EXAMPLES, example + ".inp")) as file:
                source = first_cases(file.read())
        with open(os.path.join(folder, "x.inp"), "w") as file:
            file.write(source)
        try:
            done = subprocess.run([PROGRAM, "--quiet", "--json", "--threads", "1", "2", "x"], cwd=folder, timeout=PATIENCE,
                                  capture_output=True, text=True, errors="replace", stdin=subprocess.DEVNULL)
        except subprocess.TimeoutExpired:
            return "does not end in time"
        if done.returncode not in (0, 1) or "Backtrace" in done.stderr or "Fortran runtime" in done.stderr:
            return f"ends with {done.returncode}: {done.stderr[-300:]}"
        if done.returncode == 1 and not done.stderr.strip():
            return "fails without a word"
        for name in sorted(os.listdir(folder)):
            if name == "x.inp" or os.path.isdir(os.path.join(folder, name)):
                continue
            with open(os.path.join(folder, name), errors="replace") as file:
                for line in file:
                    if any(word in line for word in ("ERROR", "Warning", "WARNING", '"failure"',
                                                     '"end of run"')) or PICTURE.match(line):
                        continue
                    if BAD.search(line):
                        return f"status {done.returncode}, {name}: {line.strip()[:160]}"
    return ""


def main():
    every = mutations()
    count = sys.argv[1] if len(sys.argv) > 1 else "250"
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 13
    chosen = every if count == "all" else random.Random(seed).sample(every, int(count))
    print(f"{len(chosen)} of {len(every)} mutations, seed {seed}")
    failures = 0
    with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("CONTACT_JOBS", "2"))) as pool:
        for mutation, wrong in zip(chosen, pool.map(run, chosen)):
            if wrong:
                failures += 1
                example, profile, text, (first, last), value = mutation
                line = text.count("\n", 0, first) + 1
                print(f"FAILED {profile or example} line {line}: {text[first:last]} -> {value}: {wrong}")
    print(f"{len(chosen) - failures} right, {failures} wrong")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
