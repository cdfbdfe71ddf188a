#!/usr/bin/env python3
"""One status of a case: .out, .mat, JSON, HDF5, the page, the library and its Python package give the same.

A table of cases for both modules with all kinds of status; the program computes all of them, the library and the Python
objects those of module 1 from the same input file, and those of module 3 with the same numbers. Also --strict, the
counts at the end, and totals as sums of tractions where a force is missed.
"""
import ctypes
import glob
import json
import os
import re
import subprocess
import sys
import tempfile
import warnings

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "conformance"))
from checks import SOURCE, check, close, finish, same
import contact
import numpy as np
from contact import cntc
from contact._library import library

PROGRAM = os.environ["CONTACT_PROGRAM"]
WORDS = {0: "solved", 1: "not converged", 2: "refused"}
ITERATIONS = {"none": 0, "normal": 1, "tangential": 2, "outer": 3, "force": 4}


def module3(digits="203100", laws="0022020", output="0001201", limits="999 100 30 1 1e-5", motion="100 0.001 0 0",
            friction="0.3 0.3", rolling="0 0.1 1000", material="0.28 0.28 82000 82000", curvature="0.01"):
    return f"""3
{digits}
{laws}
{output}
{limits}
{motion}
{friction}
{rolling}
{material}
1
20 20 -1 -1 0.1 0.1
1 1
{curvature} 0 {curvature} 0 0 0
"""


def module1(digits="1203100", output="0001201", limits="999 100 30 1 1e-5", friction="0.35 0.35",
            material="0.28 0.28 82000 82000", position="0.0 0.0 60000. 0.0 0.0 0.0",
            velocity="20000. 0.0 0.0 0.0 0.0 -43.5", wheel="S1002.prw"):
    return f"""1
{digits}
0022033
{output}
{limits}
{friction}
{material}
0.5 0.5 1.0 90d 8.0 4.0
14.0 0 1435.0 0.025
'profiles/60E1.prr' 0 1.0 0.0
0.0 0.0 0.0 0.0 0.0 0.0
1360.0 -70.0 460.0
'profiles/{wheel}' 0 1.0 0.0
{position}
{velocity}
"""


GS = "{} 100 30 1 1e-7\n0.9 1.0 0 0.5"
FALLING = "0.1 0.2 1 0 1\n0 1"
SOFT = dict(motion="60 .01 0 0", friction="10 10", material="0 .5 1e3 1e5", curvature="0.001")
# module, name, input, state, what was missed, code of the library
TABLE = [
    (3, "solved", module3(), 0, "none", 0),
    (3, "normal", module3(limits="2 100 30 1 1e-9"), 1, "normal", -27),
    (3, "tangential", module3(output="0201201", limits=GS.format(9)), 1, "tangential", -28),
    (3, "outer", module3(digits="203100", limits="999 100 30 20 1e-5", **SOFT), 1, "outer", -28),
    (
        3,
        "friction law",
        module3(laws="0222020", limits="999 1 30 1 1e-5", motion="100 0.01 0 0", friction=FALLING),
        1,
        "outer",
        -28,
    ),
    (
        3,
        "force",
        module3(digits="203110", laws="0222020", motion="100 0.9 0 0", friction=FALLING, rolling="0 0.1 1e7"),
        1,
        "force",
        -28,
    ),
    (3, "refused", module3(digits="203110", motion="100 1.5 0 0"), 2, "none", None),
    (1, "solved", module1(), 0, "none", 0),
    (1, "normal", module1(limits="1 100 30 1 1e-9"), 1, "normal", 0),
    (1, "tangential", module1(output="0201201", limits=GS.format(14)), 1, "tangential", 0),
    # a given approach: no search for the force starts the second pass, the last one, from the result of another
    (
        1,
        "outer",
        module1(
            digits="1203000",
            limits="999 100 30 2 1e-8",
            material="0 .5 1e4 1e6",
            friction="0.9 0.9",
            position="0.0 0.0 0.5 0.0 0.0 0.0",
        ),
        1,
        "outer",
        0,
    ),
    (1, "force", module1(digits="1203110", velocity="20000. 0.0 0.0 0.0 0.0 40000"), 1, "force", -29),
    (1, "away", module1(position="0.0 700.0 60000. 0.0 0.0 0.0"), 1, "force", 0),
    (1, "refused", module1(digits="1203000", position="0.0 0.0 600. 0.0 0.0 0.0"), 2, "none", -99),
]


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120)


def hdf5_status(name):
    """State, unconverged iteration and reason in the HDF5 file, and the data of the page; None without h5py"""
    try:
        import h5py
    except ImportError:
        return None
    from contact.report.read import read_experiment
    with h5py.File(name + ".h5") as file:
        case = file["case_0001"]
        reason = case["status/reason"][()].decode() if "status" in case else ""
        columns = file["cases"]
        row = [float(columns[key][0]) for key in ("status_code", "missed", "solved", "converged")]
    page = read_experiment(name + ".h5")[0]["cases"][0]
    return row, reason, page["status"], page.get("reason", "")


def by_program(name, text, state, missed):
    """Messages of the program about a case; returns the reason"""
    with open(name + ".inp", "w") as file:
        file.write(text + "0\n")
    # the default solver converges if the pressures do, a slow one selected by name does not
    solver = ["--classical"] if missed == "tangential" else []
    done = run("2", name, "--json", "--hdf5", *solver)
    same(done.returncode, 1 if state == 2 else 0, f"{name}: exit status, {done.stderr[-300:]}")
    with open(name + ".jsonl") as file:
        line = json.loads(file.readline())
    same(line["status"], WORDS[state], f"{name}: status in JSON")
    same((line["status_code"], line["missed"]), (state, ITERATIONS[missed]), f"{name}: status as numbers, {line}"[:400])
    same((line["solved"], line["converged"]), (state != 2, state == 0), f"{name}: the older keys")
    same(line.get("iteration"), missed if state else None, f"{name}: the missed condition")
    reason = line.get("reason", "")
    check((state == 0) == (reason == ""), f"{name}: a reason where one is needed: '{reason}'")
    with open(name + ".out") as file:
        out = file.read()
    if state == 1:
        check("NOT CONVERGED: " + reason in out, f"{name}: the reason in .out")
    else:
        check("NOT CONVERGED" not in out, f"{name}: no missed condition in .out")
    counts = [1 if k == state else 0 for k in range(3)]
    messages = f" 1 case: {counts[0]} solved, {counts[1]} not converged, {counts[2]} refused"
    check(messages in out and messages in done.stdout, f"{name}: the count at the end")
    kept = hdf5_status(name)
    if kept is not None:
        row, in_file, word, on_page = kept
        same(row, [state, ITERATIONS[missed], float(state != 2), float(state == 0)], f"{name}: columns of the HDF5 file")
        same((in_file, on_page), (reason, reason), f"{name}: the reason in the HDF5 file and for the page")
        same(word, WORDS[state], f"{name}: status for the page")
    tables = sorted(glob.glob(glob.escape(name) + ".0001*.mat"))
    check(bool(tables) == (state == 0 or (state == 1 and "away" not in name)), f"{name}: .mat files {tables}")
    expected = WORDS[state] + (f" ({missed}): {reason}" if state else "")
    for table in tables:
        with open(table) as file:
            same(file.readline().rstrip("\n").partition("STATUS: ")[2], expected, f"{table}: the status in the first line")
        rows = np.loadtxt(table, comments="%")
        check(rows.shape[1] == 11 and rows[0, -1] == 2410 and np.isfinite(rows).all(), f"{table}: still a table")
        same(np.loadtxt(table, skiprows=13).shape[0], rows.shape[0] - 6, f"{table}: elements begin in line 14")
    strict = run("2", name, "--strict", "--quiet", *solver)
    same(strict.returncode, {0: 0, 1: 2, 2: 1}[state], f"{name}: exit status with --strict")
    return reason


def library_status(ire, icp):
    iteration, room = ctypes.c_int(-7), ctypes.create_string_buffer(2000)
    state = library().contact_case_status(ire, icp, ctypes.byref(iteration), room, len(room))
    return state, iteration.value, room.value.decode()


def settle(problem, name):
    """The numbers of a case of module 3 as settings of the library"""
    limits = dict(maxgs=999, maxin=100, maxnr=30, maxout=1, eps=1e-5)
    material = (82000.0, 0.28, 82000.0, 0.28)
    friction, motion, fn, rolling, curvature = None, (0.001, 0.0), 100.0, 1000.0, 0.01
    if name == "normal":
        limits.update(maxgs=2, eps=1e-9)
    elif name == "outer":
        limits.update(maxout=20)
        material, friction, motion, fn, curvature = (1e3, 0.0, 1e5, 0.5), 10.0, (0.01, 0.0), 60.0, 0.001
    elif name == "friction law":
        limits.update(maxin=1)
        motion = (0.01, 0.0)
    elif name == "force":
        rolling = 1e7
    problem.set_material(material[0], material[1], material[2], material[3])
    if name in ("friction law", "force"):
        problem.set_friction_law(2, [0.1, 0.2, 1.0, 0.0, 1.0, 0.0, 1.0])
    else:
        problem.set_friction(friction or 0.3)
    problem.set_grid(20, 20, 0.1, 0.1, -1.0, -1.0)
    problem.set_distance(lambda x, y: curvature * (x**2 + y**2))
    problem.set_normal_force(fn)
    problem.set_rolling(rolling, 0.1)
    problem.set_creepages(*motion)
    # of order 1, as the program solves an .inp file
    problem.set_solver(**limits, order=1)
    if name == "tangential":
        problem.set_flags(own_classical=1)
        problem._do(cntc.setsolverflags, problem.number, 1, 2, [9, 100, 30, 1, 0], [1e-7, 0.9, 1.0, 0.5])
    if name == "force":
        problem.set_tangential_force(0.9)
    elif name == "refused":
        problem.set_friction_law(6, [0.3, 20.0, -0.1, 300.0, 0.0, 1.0])  # without thermal constants


def by_library3(name, state, missed, code, reason):
    with contact.Problem() as problem:
        settle(problem, name)
        same(library_status(problem.number, 1)[0], -1, f"3 {name}: nothing calculated yet")
        ended, text, result = "solved", "", None
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always")
            try:
                result = problem.solve()
                ended, text, got = result.status, result.reason, problem._code
            except contact.ContactError as error:
                ended, text, got = error.status, str(error), error.code
        if code is not None:
            same(got, code, f"3 {name}: code of the library, {text}")
        same(ended, WORDS[state], f"3 {name}: status in Python, {text}")
        same(result is None, state == 2, f"3 {name}: a result unless it is refused")
        messages = [str(w.message) for w in heard if issubclass(w.category, contact.NotConvergedWarning)]
        same(len(messages), 1 if state == 1 else 0, f"3 {name}: warnings of Python")
        status = library_status(problem.number, 1)
        same(status[:2], (state, ITERATIONS[missed]), f"3 {name}: status of the library, {status}")
        if state == 1:
            # numbers may differ in their last figure: the grid of the caller is not read from text
            same(re.sub(r"[0-9]", "", status[2])[:40], re.sub(r"[0-9]", "", reason)[:40], f"3 {name}: reason of the library")
        if result is not None:
            same(result.reason, status[2] if state == 1 else "", f"3 {name}: reason of the result")
            same(np.isfinite([result.fn, result.fx, result.fy]).all(), True, f"3 {name}: forces of the result")
            if name != "force":
                problem.set_friction(0.3)
        if name == "force":
            forces = cntc.getcontactforces(problem.number, 1)
            px = cntc.gettractions(problem.number, 1)[1]
            close(forces[1], np.prod(cntc.getgriddiscretization(problem.number, 1)) * np.sum(px), 1e-9 * abs(forces[0]),
                  "a missed force is the sum of its tractions")
            close(abs(forces[1]), 10.0, 1e-3, "full sliding")
            # prescribed values are still prescribed
            for _ in range(2):
                again = cntc.calculate(problem.number, 1, idebug=0)
                same(again, -28, "the request stays as it was given")


def by_library1(name, path, state, missed, code, reason):
    with contact.WheelRail() as pair:
        same(cntc.readinpfile(pair.number, 1988, path), 0, f"1 {name}: the input is read")
        if name == "tangential":
            pair.set_flags(own_classical=1)
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always")
            got, ended, text = 0, "", ""
            try:
                result = pair.solve()
                got, ended, text = pair._code, result.status, result.reason
                check(np.isfinite(result.forces.track.force).all(), f"1 {name}: forces of the result")
                pair.set_solver(eps=1e-5)
            except contact.ContactError as error:
                got, ended, text = error.code, error.status, str(error)
        same((got, ended), (code, WORDS[state]), f"1 {name}: code and status in Python, {text}")
        messages = [str(w.message) for w in heard if issubclass(w.category, contact.NotConvergedWarning)]
        same(len(messages), 1 if state == 1 else 0, f"1 {name}: warnings of Python")
        status = library_status(pair.number, -1)
        same(status[:2], (state, ITERATIONS[missed]), f"1 {name}: status of the library, {status}")
        if state == 1:
            same(re.sub(r"[0-9]", "", status[2])[:40], re.sub(r"[0-9]", "", reason)[:40], f"1 {name}: reason of the library")


def several():
    """Counts of several cases, and warnings that are given once"""
    names = ["solved", "force", "outer"]
    with open("several.inp", "w") as file:
        file.write("".join(text for module, name, text, *_ in TABLE if module == 3 and name in names) + "0\n")
    done = run("2", "several")
    check(" 3 cases: 1 solved, 2 not converged, 0 refused" in done.stdout, "counts of a run")
    lines = [line for line in done.stdout.splitlines() if line.startswith(" Warning")]
    same(len(lines), len(set(lines)), "no warning twice")
    check(len(lines) <= 6, f"few warnings: {lines}")
    same(run("3", "several", "--strict").returncode, 0, "a check has no cases that did not converge")


def buried_end():
    """An end of the wheel's profile within a guard rail, away from all patches: the library and Python report it as the program
    does"""
    corners = [(-80.0, 40.0), (-79.0, -20.0), (-51.0, -20.0), (-50.0, 30.0), (-38.0, 30.0), (-36.0, 10.0)]
    rail = [(1 - t) * np.array(a) + t * np.array(b) for a, b in zip(corners, corners[1:]) for t in np.linspace(0, 0.95, 20)]
    y = np.arange(-35.0, 35.1, 0.5)
    rail += list(np.column_stack((y, y**2 / 600.0)))
    y = np.arange(-48.0, 60.1, 0.5)
    for yaw, ends, bits in ((0.03, ("inner",), 512), (0.0, (), 0)):
        with contact.WheelRail() as pair:
            pair.set_flags(ic_tang=0, ic_norm=0)
            pair.set_grid(0.5, 0.5)
            pair.set_rail(np.array(rail))
            pair.set_wheel(np.column_stack((y, -y**2 / 20000.0)))
            pair.set_rail_position(750.0, 0.0)
            pair.set_wheelset(1500.0, 0.0, 460.0)
            pair.set_position(z=0.05, yaw=yaw)
            with warnings.catch_warnings(record=True) as heard:
                warnings.simplefilter("always")
                result = pair.solve()
            messages = [str(w.message) for w in heard if "inner end of the wheel profile: wheel and rail overlap" in str(w.message)]
            same(result.buried, ends, f"yaw {yaw}: ends within the rail in Python")
            same(len(messages), len(ends), f"yaw {yaw}: warnings of them")
            same(int(cntc.getflags(pair.number, -1, [cntc.CNTC["own_border"]])[0]), bits, f"yaw {yaw}: bits of the library")


os.chdir(tempfile.mkdtemp())
os.symlink(os.path.join(SOURCE, "examples", "profiles"), "profiles")
for module, name, text, state, missed, code in TABLE:
    path = f"case{module}{name.replace(' ', '')}"
    reason = by_program(path, text, state, missed)
    if module == 3:
        by_library3(name, state, missed, code, reason)
    else:
        by_library1(name, path + ".inp", state, missed, code, reason)
several()
buried_end()
finish()
