#!/usr/bin/env python3
"""One write, close or rename fails, at every place of a small run: success with right files, or an error and nothing half-written.

usage: test_files.py LIBRARY_TO_PRELOAD
"""
import errno
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree

try:
    import h5py
    import numpy as np
except ImportError as reason:
    print(f"SKIPPED: {reason}")
    sys.exit(77)

PROGRAM = os.environ["CONTACT_PROGRAM"]

def experiment(folder):
    """Two cases with a .mat file and stresses"""
    text = pathlib.Path(os.environ["CONTACT_SOURCE"], "examples", "cattaneo.inp").read_text(encoding="utf-8")
    pathlib.Path(folder, "small.inp").write_text(text, encoding="utf-8")


def run(folder, preload, **inject):
    """Exit status and messages of a run into an empty folder"""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    experiment(folder)
    settings = {name: str(value) for name, value in inject.items() if value is not None}
    environment = dict(os.environ, LD_PRELOAD=preload, INJECT_FOLDER=str(folder) + "/", OMP_NUM_THREADS="1", **settings)
    ended = subprocess.run([PROGRAM, "--quiet", "--json", "--hdf5", "--vtk", "--output-dir", str(folder), "2", "small"], cwd=folder, env=environment,
                           stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60)
    return ended.returncode, ended.stdout + ended.stderr


def without_times(text):
    """A report without its times"""
    text = re.sub(rb"(?m)^\|.*$", b"", text)
    return re.sub(rb'"seconds": *[^,}]*', b"", text)


def values(file):
    """All data of an HDF5 file but times"""
    found = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset) and not name.endswith("seconds"):
            found[name] = item[()]
    with h5py.File(file) as data:
        data.visititems(visit)
    return found


def wrong_file(good, file):
    """What is wrong with a file that claims to be whole, or nothing"""
    if file.suffix == ".h5":
        old, new = values(good), values(file)
        if old.keys() != new.keys():
            return f"{len(new)} of {len(old)} data"
        return next((name for name in old if not np.array_equal(old[name], new[name], equal_nan=old[name].dtype.kind == "f")), "")
    return "" if without_times(good.read_bytes()) == without_times(file.read_bytes()) else "contents"


def half_written(file):
    """Is this file, which stands there after an error, unreadable?"""
    try:
        if file.suffix == ".h5":
            values(file)
        elif file.suffix == ".jsonl":
            for line in file.read_text(encoding="utf-8").splitlines():
                json.loads(line)
        elif file.suffix == ".pvd":
            xml.etree.ElementTree.parse(file)
    except (OSError, ValueError, xml.etree.ElementTree.ParseError) as reason:
        return str(reason)
    return ""


def check_place(good, folder, preload, call, place, number, for_ever):
    """Complaints about one place"""
    code, text = run(folder, preload, INJECT_CALL=call, INJECT_AT=place, INJECT_ERROR=number, INJECT_FOR_EVER=for_ever)
    if code < 0 or code > 2:
        return [f"ended with {code}: {text[-300:]}"]
    names = {file.name for file in folder.iterdir()}
    if code == 0:
        whole = {file.name for file in good.iterdir()}
        bad = [f"{name} is missing" for name in sorted(whole - names)] + [f"{name} is left" for name in sorted(names - whole)]
        for name in sorted(whole & names):
            what = wrong_file(good / name, folder / name)
            if what:
                bad.append(f"{name}, {what}, in spite of success")
        return bad
    bad = [] if "ERROR" in text else [f"no message with exit status {code}"]
    bad += [f"{name} is left" for name in sorted(names) if name.endswith((".tmp", ".part"))]
    for name in sorted(names):
        # files that grow from case to case end somewhere; the message names them
        growing = name.endswith((".jsonl", ".pvd")) and f"{name}: the file is not complete" in text
        what = half_written(folder / name)
        if what and not growing:
            bad.append(f"{name}: {what}")
    return bad


def main():
    """All places once, some of them for ever"""
    preload = sys.argv[1]
    here = pathlib.Path.cwd()
    good, folder, count_file = here / "good", here / "bad", here / "count"
    failed = checks = 0
    for call in ("write", "close", "rename"):
        code, text = run(good, preload, INJECT_CALL=call, INJECT_COUNT=count_file)
        assert code == 0, text
        count = int(count_file.read_text(encoding="utf-8"))
        assert count > 2, f"{count} calls of {call} are too few to be true"
        code, text = run(folder, preload, INJECT_CALL=call)
        again = [wrong_file(file, folder / file.name) for file in good.iterdir()]
        assert code == 0 and not any(again), f"two runs differ: {again}"
        for place in range(1, count + 1):
            kinds = [(errno.EIO, None)] + ([(errno.ENOSPC, 1)] if call == "write" and place % 4 == 1 else [])
            for number, for_ever in kinds:
                checks += 1
                for complaint in check_place(good, folder, preload, call, place, number, for_ever):
                    failed += 1
                    print(f"FAILED {call} {place} of {count}{' and all later ones' if for_ever else ''}: {complaint}")
    print(f"{checks} faults, {failed} complaints")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
