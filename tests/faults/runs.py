"""Runs of each kind for the tests of faults, and comparison of their files."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import xml.etree.ElementTree

import h5py
import numpy as np

PROGRAM = os.environ["CONTACT_PROGRAM"]
EXAMPLES = pathlib.Path(os.environ["CONTACT_SOURCE"], "examples")
ALL_FILES = ("--json", "--hdf5", "--vtk")

def example(folder, name):
    """The input of an example with its profiles; returns its name"""
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copy(EXAMPLES / (name + ".inp"), folder)
    if not (folder / "profiles").exists():
        shutil.copytree(EXAMPLES / "profiles", folder / "profiles")
    return name


def run(folder, name, *options, environment=None, timeout=300):
    """Exit status and messages"""
    settings = dict(os.environ, OMP_NUM_THREADS="1", **(environment or {}))
    done = subprocess.run([PROGRAM, "--quiet", *options, "2", name], cwd=folder, env=settings, stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, errors="replace", timeout=timeout)
    return done.returncode, done.stdout + done.stderr


def without_times(text):
    """A report or JSON lines without times, and without the warning of a missing lock"""
    text = re.sub(rb"(?m)^\|.*\n", b"", text)
    text, unlocked = re.subn(rb"(?m)^ *Warning: the experiment could not be locked .*\n", b"", text)
    if unlocked:
        text = re.sub(rb", warnings: *(\d+)",
                      lambda count: b", warnings: %3d" % (int(count[1]) - 1) if int(count[1]) > 1 else b".", text)
    return re.sub(rb'"seconds": *[^,}]*', b"", text)


def hdf5_difference(good, file):
    """Differences of an HDF5 file, apart from times"""
    known = {}

    def address(item):
        return h5py.h5o.get_info(item.id).addr

    def differs(one, other, path):
        # objects have several names
        key = address(one), address(other), path.endswith("/seconds")
        if key not in known:
            known[key] = ""
            known[key] = look(one, other, path)
        return known[key]

    def look(one, other, path):
        if type(one) is not type(other) or str(sorted(one.attrs.items())) != str(sorted(other.attrs.items())):
            return f"{path}: kind or attributes"
        if isinstance(one, h5py.Dataset):
            return "" if path.endswith("/seconds") or same(one[()], other[()]) else path
        if list(one) != list(other):
            return f"{path}: {sorted(set(one) ^ set(other))[:5]}"
        return next(filter(None, (differs(one[name], other[name], f"{path}/{name}") for name in one)), "")

    with h5py.File(good) as old, h5py.File(file) as new:
        return look(old, new, "")


def read_all(file):
    """Read every object of an HDF5 file once"""
    with h5py.File(file) as data:
        seen = {}
        data.visititems(lambda name, item: seen.update({name: item[()] if isinstance(item, h5py.Dataset) else None}))


def same(a, b):
    """Equal data of HDF5"""
    if type(a) is not type(b):
        return False
    if isinstance(a, np.ndarray):
        return a.shape == b.shape and np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
    return bool(a == b or (a != a and b != b))


def difference(good, file):
    """Differences of a file from the expected one; empty if there are none"""
    if file.suffix == ".h5":
        return hdf5_difference(good, file)
    old, new = without_times(good.read_bytes()), without_times(file.read_bytes())
    if old == new:
        return ""
    for k, (a, b) in enumerate(zip(old.split(b"\n"), new.split(b"\n"))):
        if a != b:
            return f"line {k + 1}: {a[:150]!r} became {b[:150]!r}"
    return f"{len(old)} bytes became {len(new)}"


def differences(good, folder):
    """All differences of two folders of results"""
    names = {file.name for file in good.iterdir() if file.is_file()}, {file.name for file in folder.iterdir() if file.is_file()}
    found = [f"{name} is missing" for name in sorted(names[0] - names[1])] + [f"{name} is left"
                                                                              for name in sorted(names[1] - names[0])]
    for name in sorted(names[0] & names[1]):
        what = difference(good / name, folder / name)
        if what:
            found.append(f"{name}: {what}")
    return found


def check_whole(file):
    """Is this a file that exists only if it is complete?"""
    content = file.read_bytes()
    if file.suffix == ".vts":
        assert content.rstrip().endswith(b"</VTKFile>"), file.name
        return
    columns = {len(line.split()) for line in content.decode().splitlines() if not line.lstrip().startswith("%")}
    assert content.endswith(b"\n") and len(columns) == 1, f"{file.name}: {columns}"


def finished_cases(folder):
    """Cases in each file after a run was killed; an exception if a file cannot be read"""
    counts = {}
    for file in folder.iterdir():
        if file.suffix == ".jsonl":
            text = file.read_text(encoding="utf-8")
            lines = [json.loads(line) for line in text[:text.rfind("\n") + 1].splitlines()]
            counts["jsonl"] = sum(1 for line in lines if line["case"])
        elif file.suffix == ".h5":
            with h5py.File(file) as data:
                rows = data.get("cases/case", [])
                counts["h5"] = len(rows)
                assert "complete" in data.attrs and "cases_planned" in data.attrs, sorted(data.attrs)
            read_all(file)
        elif file.suffix == ".pvd":
            # an interrupted write leaves a list with an incomplete last line
            listed = [line for line in file.read_text(encoding="utf-8").split("\n")[3:] if "DataSet" in line]
            for line in listed[:-1]:
                xml.etree.ElementTree.fromstring(line)
        elif file.suffix in (".vts", ".mat", ".subs"):
            check_whole(file)
    return counts
