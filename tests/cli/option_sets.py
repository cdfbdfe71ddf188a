#!/usr/bin/env python3
"""The first cases of the examples with every option that changes what is computed: an orderly end, and finite results.

In a debug build each run has all checks of the compiler, and traps for invalid operations, overflow and division by zero.
The environment gives CONTACT_PROGRAM and CONTACT_SOURCE; CONTACT_JOBS is the number of processes.

    option_sets.py [EXAMPLE...]
"""
import concurrent.futures
import os
import re
import subprocess
import sys
import tempfile

import mutations

PROGRAM = os.environ["CONTACT_PROGRAM"]
#: Options of a run; all of them write JSON lines
SETS = ((), ("--errors",), ("--order", "2"), ("--errors", "--order", "2"), ("--accuracy", "1e-2"),
        ("--accuracy", "1e-2", "--allow", "approximate", "--order", "2"), ("--classical", "--errors"),
        ("--heat", "moving-source", "--contact-angle", "contact", "--errors"), ("--hdf5", "--vtk", "--errors"))
#: What --accuracy may report, and warnings of contact convert
KNOWN = re.compile("the grid cannot be chosen|the time limit of|WARNING")
#: Maximum time of a run [s]
PATIENCE = 20.0 * float(os.environ.get("CONTACT_SLOWER", "1"))


def program(folder, *arguments):
    return subprocess.run([PROGRAM, *arguments], cwd=folder, timeout=PATIENCE, capture_output=True, text=True, errors="replace",
                          stdin=subprocess.DEVNULL)


def complaint(done, folder):
    """What is wrong with a run; "" if nothing"""
    known = all(KNOWN.search(line) for line in done.stderr.splitlines() if line)
    if done.returncode not in (0, 1) or not known:
        places = re.findall(r"in (\S+)\n\s+at (\S+)", done.stderr)
        return f"ends with {done.returncode}: " + (" < ".join(" ".join(place) for place in places[:6]) or done.stderr[:300])
    for name in ("x.out", "x.jsonl"):
        path = os.path.join(folder, name)
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                for line in file:
                    if mutations.BAD.search(line) and not mutations.PICTURE.match(line):
                        return f"{name}: {line.strip()[:160]}"
    return ""


def run(example):
    """Complaints about an example, in both formats"""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(os.path.join(mutations.EXAMPLES, "profiles"), os.path.join(folder, "profiles"))
        with open(os.path.join(mutations.EXAMPLES, example + ".inp"), encoding="utf-8") as file:
            text = mutations.first_cases(file.read())
        with open(os.path.join(folder, "x.inp"), "w", encoding="utf-8") as file:
            file.write(text)
        commands = [("convert", "x.inp"), ("explain", "x.toml"), ("explain", "--accuracy", "1e-2", "x.inp"), ("3", "x.toml")]
        commands += [("--quiet", "--json", "--limit-time", "0.5", *options, "2", name)
                     for options in SETS for name in ("x.inp", "x.toml")]
        for command in commands:
            try:
                wrong = complaint(program(folder, *command), folder)
            except subprocess.TimeoutExpired:
                wrong = "does not end in time"
            if wrong:
                found.append(f"{example}, {' '.join(command)}: {wrong}")
    return found


def main():
    failures = 0
    with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("CONTACT_JOBS", "2"))) as pool:
        for found in pool.map(run, sys.argv[1:] or mutations.SMALL):
            failures += len(found)
            for complaint_text in found:
                print("FAILED", complaint_text, flush=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
