#!/usr/bin/env python3
"""One request for memory is refused, or all from one on, in small runs of each kind: an error, or success with correct files.

usage: test_memory.py LIBRARY_TO_PRELOAD [all | SAMPLES] [NAMES OF EXPERIMENTS]

A sample of the places with a fixed seed by default; `all` takes every place, which takes hours. A table of what happened
is printed at the end.
"""
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys

PROGRAM = os.environ["CONTACT_PROGRAM"]
EXAMPLES = pathlib.Path(os.environ["CONTACT_SOURCE"], "examples")
#: Experiments and options: both modules, each kind of file, a check, a wrong input
RUNS = {
    "cattaneo": ["2"],
    "subsurface": ["--json", "2"],
    "cattaneo_vtk": ["--vtk", "2"],
    "cattaneo_hdf5": ["--hdf5", "2"],
    "wheel_on_rail": ["--json", "2"],
    "wheel_on_rail_check": ["3"],
    "missing": ["2"],
}
#: Default number of samples per run and mode
SAMPLES = 6
SEED = 20261122


def first_case(text, name):
    """The input, or its first case if the example is long"""
    if not name.startswith("wheel"):
        return text
    lines = text.splitlines()
    heads = [k for k, line in enumerate(lines) if re.search(r"\bMODULE\b", line)]
    return "\n".join(lines[:heads[1]] + [" 0  MODULE", ""]) if len(heads) > 2 else text


def run(folder, name, preload, at, for_ever=False, count=None):
    """Exit status and messages of a run into an empty folder"""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    example = re.sub(r"_(vtk|hdf5|check)$", "", name)
    if name != "missing":
        text = (EXAMPLES / f"{example}.inp").read_text(encoding="utf-8")
        (folder / f"{example}.inp").write_text(first_case(text, name), encoding="utf-8")
    (folder / "profiles").symlink_to(EXAMPLES / "profiles")
    settings = {"LD_PRELOAD": preload, "INJECT_CALL": "memory", "INJECT_AT": str(at), "OMP_NUM_THREADS": "1",
                "OPENBLAS_NUM_THREADS": "1"}
    if for_ever:
        settings["INJECT_FOR_EVER"] = "1"
    if count:
        settings["INJECT_COUNT"] = str(count)
    try:
        ended = subprocess.run([PROGRAM, "--quiet", *RUNS[name], example], cwd=folder, env=dict(os.environ, **settings),
                               stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120)
    except subprocess.TimeoutExpired:
        return "hang", ""
    return ended.returncode, ended.stdout + ended.stderr


def contents(folder):
    """Contents of all files, without times; HDF5 files by their presence only, as test_files compares them"""
    found = {}
    for file in sorted(folder.iterdir()):
        if file.suffix == ".h5":
            found[file.name] = b""
        elif file.is_file():
            text = re.sub(rb"(?m)^\|.*$", b"", file.read_bytes())
            found[file.name] = re.sub(rb'"seconds": *[^,}]*', b"", text)
    return found


def complaints(code, text, good, folder, expected):
    """Complaint about the end of a run"""
    if code == "hang" or code < 0 or code > 2:
        return [f"ended with {code}: {text.strip()[-300:]}"]
    left = [f"{name.name} is left" for name in folder.iterdir() if name.suffix in (".tmp", ".part")]
    if code == expected == 0:
        now = contents(folder)
        return left + [f"{name} differs in spite of success" for name in sorted(set(good) | set(now))
                       if good.get(name) != now.get(name)]
    return left + ([] if "ERROR" in text or "rror" in text else [f"no message with exit status {code}"])


def main():
    """Sample of the requests, or all"""
    preload, *rest = sys.argv[1:]
    samples = rest[0] if rest else str(SAMPLES)
    names = rest[1:] or list(RUNS)
    here = pathlib.Path.cwd()
    failed = 0
    chance = random.Random(SEED)
    print("run                   requests  refused  right files      errors  complaints")
    for name in names:
        good_folder, folder, count_file = here / f"good_{name}", here / f"bad_{name}", here / "count"
        expected, text = run(good_folder, name, preload, 0, count=count_file)
        if expected not in ((1,) if name == "missing" else (0,)):
            print(f"FAILED {name} without any fault: {expected} {text[-500:]}")
            return 1
        good, count = contents(good_folder), int(count_file.read_text(encoding="utf-8"))
        places = range(1, count + 1) if samples == "all" else sorted(chance.sample(range(1, count + 1), min(count, int(samples))))
        right = errors = bad = 0
        for place in places:
            for for_ever in (False, True):
                code, text = run(folder, name, preload, place, for_ever)
                found = complaints(code, text, good, folder, expected)
                for complaint in found:
                    print(f"FAILED {name}, request {place} of {count}{' and all later ones' if for_ever else ''}: {complaint}",
                          flush=True)
                bad += bool(found)
                right += not found and code == 0
                errors += not found and code != 0
        failed += bad
        print(f"{name:20} {count:9} {right + errors + bad:8} {right:12} {errors:11} {bad:11}", flush=True)
        shutil.rmtree(folder, ignore_errors=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
