#!/usr/bin/env python3
"""contact_run_with does what the program does: moving heat sources, angles at the contact, classical solvers, confined
runs, one run at a time.

The environment gives CONTACT_PROGRAM, CONTACT_LIBRARY and CONTACT_SOURCE.
"""
import ctypes
import fcntl
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "conformance"), os.path.join(HERE, "..", "cli")]
from checks import SOURCE, check, finish, same
import small_case

PROGRAM = os.environ["CONTACT_PROGRAM"]
JSON, HDF5, VTK, MOVING_HEAT, ANGLE_AT_CONTACT, CONFINE, CLASSICAL, ORDER, NOTHING = 1, 2, 4, 8, 16, 32, 64, 128, 256
#: Returned values: 10 and the kind of the error
FILE_FAILED, BEYOND_LIMIT, LOCKED = 12, 17, 19
SLICES = """0.0 1.0   OFFSET SCALE
4   NSLC
0 0 0   NFEAT NKINK NACCEL
1   INTPOL
-30. 'slice_1.prr'
-10. 'slice_2.prr'
10. 'slice_3.prr'
30. 'slice_4.prr'
"""
YAWED = """1
1203100
0022033
0001201
999 100 30 1 1e-5
0.35 0.35
0.28 0.28 82000 82000
0.5 0.5 1.0 90d 8.0 4.0
0 752 0 0.025
'rail.slcs' 0 1.0 0.0
0 0 0 0 0 0
1360 -70 460
'S1002.prw' 0 1.0 0.0
0 3 60000 0 0.03 0
20000 0 0 0 0 -43.5
0
"""


def prepare():
    """A warm wheel, a yawed one on a rail that turns by 0.12 rad within 60 mm, and a ball for SteadyGS"""
    with open(os.path.join(SOURCE, "examples", "sliding_temperature.inp")) as file:
        first = file.read().split("\n3  ", 2)
    with open("warm.inp", "w") as file:
        file.write(first[0] + "\n3  " + first[1] + "\n0\n")
    profiles = os.path.join(SOURCE, "examples", "profiles")
    with open(os.path.join(profiles, "60E1.prr")) as file:
        text = file.read()
    head, _, rest = text.partition("point.begin\n")
    points, _, tail = rest.partition("  point.end")
    for k, tilt in enumerate((-0.06, -0.02, 0.02, 0.06)):
        turned = "".join(f"{y} {float(z) + tilt*float(y)}\n" for y, z in (line.split() for line in points.splitlines()))
        with open(f"slice_{k + 1}.prr", "w") as file:
            file.write(head + "point.begin\n" + turned + "  point.end" + tail)
    with open(os.path.join(profiles, "S1002.prw")) as source, open("S1002.prw", "w") as file:
        file.write(source.read())
    with open("rail.slcs", "w") as file:
        file.write(SLICES)
    with open("yawed.inp", "w") as file:
        file.write(YAWED)
    with open("swept.inp", "w") as file:
        file.write("3\n203100\n022020\n0301201\n999 100 30 1 1e-5\n0.9 1 0 0.5\n100 0.001 0 0\n0.3 0.3\n0 0.1 1000\n"
                   "0.28 0.28 82000 82000\n1\n20 20 -1 -1 0.1 0.1\n1 1\n0.01 0 0.01 0 0 0\n0\n")


def total(name, quantity):
    with open(name + ".jsonl") as file:
        patch = json.loads(file.readline())["patches"][0]
    # missing options have their default effect
    return patch["solver"].get(quantity) if quantity.startswith("tangential_") else patch["totals"][quantity]["value"]


def confined(run):
    """Ordinary files below the folder of the experiment, and the limits of --confine"""
    os.mkdir("inside")
    shutil.copy("S1002.prw", "inside")
    shutil.copy("slice_2.prr", "inside/rail.prr")
    text = YAWED.replace("'rail.slcs'", "'{rail}'")
    for rail, expected in (("rail.prr", 0), ("../slice_2.prr", FILE_FAILED), (os.path.abspath("slice_2.prr"), FILE_FAILED),
                           ("link.prr", FILE_FAILED)):
        if rail == "link.prr":
            os.symlink("../slice_2.prr", "inside/link.prr")
        with open("inside/a.inp", "w") as file:
            file.write(text.format(rail=rail))
        for mode in (2, 3):
            status, said = run("inside/a", CONFINE, mode)
            same(status, expected, f"a confined run, mode {mode}, with {rail}: {said}")
            check(not expected or "not below the folder" in said or "symbolic link in its name" in said, f"the reason: {said}")
            status, said = run("inside/a", 0, mode)
            same(status, 0, f"an ordinary run, mode {mode}, with {rail}: {said}")
    with open("secret", "w") as file:
        file.write("keep me\n")
    for suffix, outputs in (("out", 0), ("jsonl", JSON), ("pvd", VTK)):
        with open("inside/b.inp", "w") as file:
            file.write(small_case.case())
        os.symlink("../secret", f"inside/b.{suffix}")
        status, said = run("inside/b", CONFINE + outputs)
        same(status, FILE_FAILED, f"results behind a link, .{suffix}: {said}")
        with open("secret") as file:
            same(file.read(), "keep me\n", f"what a link .{suffix} leads to")
        os.remove(f"inside/b.{suffix}")
    with open("inside/large.inp", "w") as file:
        file.write(small_case.case(1001))
    status, said = run("inside/large", CONFINE)
    same(status, BEYOND_LIMIT, f"more elements than a confined run has: {said}")
    check("1002001 elements" in said and "1000000" in said, f"the limit: {said}")


def locked(run):
    """Two runs of one experiment at once, of this process or of others"""
    with open("twice.inp", "w") as file:
        file.write(small_case.case(11) * 3 + "0\n")
    with open("twice.lock", "w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        status, said = run("twice", JSON + HDF5)
        same(status, LOCKED, f"while the lock is held: {said}")
        check("another run is writing the results" in said, f"the reason: {said}")
        same(sorted(name for name in os.listdir() if name.startswith("twice")), ["twice.inp", "twice.lock"], "nothing was written")
    status, said = run("twice", JSON + HDF5)
    same(status, 0, f"after its release: {said}")
    check(not os.path.exists("twice.lock"), "the lock goes with the run")

    with open("long.inp", "w") as file:
        file.write(small_case.case(40) * 300 + "0\n")
    first = []
    thread = threading.Thread(target=lambda: first.append(run("long", JSON)))
    thread.start()
    deadline = time.time() + 30
    while not os.path.exists("long.jsonl") and time.time() < deadline:
        time.sleep(0.001)
    second, said = run("long", JSON)
    same(run("twice", JSON)[0], 0, "another experiment at the same time")
    thread.join()
    same(first[0], (0, ""), "the first of two threads with one experiment")
    same(second, LOCKED, f"the second: {said}")
    check(f"process {os.getpid()} on" in said, f"holder of the lock: {said}")
    with open("long.jsonl") as file:
        lines = file.read().splitlines()
    check(len(lines) == 301 and json.loads(lines[-1])["run"]["complete"], "the results of the first are complete")
    same(run("long", JSON)[0], 0, "afterwards")


def limited(library):
    """Each limit of contact_run_limited acts alone, and 0 is none: a case of 20 x 20 elements"""
    with open("small.inp", "w") as file:
        file.write("3\n203100\n022020\n0001201\n999 100 30 1 1e-5\n100 0.001 0 0\n0.3 0.3\n0 0.1 1000\n0.28 0.28 82000 82000\n1\n"
                   "20 20 -1 -1 0.1 0.1\n1 1\n0.01 0 0.01 0 0 0\n0\n")
    message = ctypes.create_string_buffer(2000)
    for limits, expected in (((0, 0, 0), 0), ((100, 1000, 400), 0), ((0, 0, 399), "elements"), ((0, 0, 1), "elements"),
                             ((0, 0.01, 0), "memory"), ((0, 0, 0.5), 0)):
        library.contact_run_limited.argtypes = [ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, *3*[ctypes.c_int],
                                                *3*[ctypes.c_double], ctypes.c_char_p, ctypes.c_int]
        status = library.contact_run_limited(b"small", 2, b"", 1, 0, 0, *limits, message, len(message))
        with open("small.out") as file:
            out = file.read()
        if expected:
            check(status != 0, f"limits {limits}: {status}")
            check(expected in out and "1 refused" in out, f"limits {limits}: {out[-300:]}")
        elif limits != (0, 0, 0.5):
            same(status, 0, f"limits {limits}")
    os.remove("small.out")
    for place, name in enumerate(("seconds", "megabytes", "elements")):
        for number in (math.nan, math.inf, -math.inf, -1.0, -1e-300, 1e300, 1e12):
            limits = [0.0]*3
            limits[place] = number
            status = library.contact_run_limited(b"small", 2, b"", 1, 0, 0, *limits, message, len(message))
            same(status, 1, f"{name} = {number} is a wrong call")
            said = message.value.decode()
            check(f": {name} is " in said and "from 0 to below 1e12" in said, f"{name} = {number}: {said}")
            check(not os.path.exists("small.out"), f"{name} = {number}: nothing is written")


def main():
    os.chdir(tempfile.mkdtemp())
    prepare()
    library = ctypes.CDLL(os.environ["CONTACT_LIBRARY"])

    def run(name, outputs, mode=2):
        message = ctypes.create_string_buffer(2000)
        return library.contact_run_with(name.encode(), mode, b"", 1, outputs, message, len(message)), message.value.decode()

    for name, quantity, bit, option in (("warm", "max_temp1", MOVING_HEAT, "--heat=moving-source"),
                                        ("yawed", "deltcp_tr", ANGLE_AT_CONTACT, "--contact-angle=contact"),
                                        ("swept", "tangential_method", CLASSICAL, "--classical"),
                                        ("swept", "tangential_order", ORDER, "--order=2")):
        values = {}
        for outputs, options in ((0, []), (bit, [option])):
            done = subprocess.run([PROGRAM, "--quiet", "--json", *options, "2", name], stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True, timeout=120)
            same(done.returncode, 0, f"{name} {options}: {done.stderr[-300:]}")
            values[outputs] = total(name, quantity)
            os.remove(name + ".jsonl")
            status, said = run(name, JSON + outputs)
            same(status, 0, f"{name}, outputs {outputs}: {said}")
            same(total(name, quantity), values[outputs], f"{name}: {quantity} of the library and of the program")
        acts = values[bit] != values[0] if bit in (CLASSICAL, ORDER) else abs(values[bit]/values[0] - 1.0) > 0.01
        check(acts, f"{name}: the choice acts, {values}")
    limited(library)
    status, said = run("warm", NOTHING)
    same(status, 1, "an undefined bit")
    check("CONTACT_MOVING_HEAT" in said, "the accepted values")
    confined(run)
    locked(run)
    finish()


main()
