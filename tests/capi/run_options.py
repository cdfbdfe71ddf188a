#!/usr/bin/env python3
"""contact_run_with computes by moving heat sources and with the angles at the contact when it is asked to, as the program does.

The environment tells CONTACT_PROGRAM, CONTACT_LIBRARY and CONTACT_SOURCE.
"""
import ctypes
import json
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "conformance"))
from checks import SOURCE, check, finish, same

PROGRAM = os.environ["CONTACT_PROGRAM"]
JSON, MOVING_HEAT, ANGLE_AT_CONTACT, NOTHING = 1, 8, 16, 64
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
    """A warm wheel, and a yawed one on a rail that turns by 0.12 rad within 60 mm"""
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


def total(name, quantity):
    with open(name + ".jsonl") as file:
        return json.loads(file.readline())["patches"][0]["totals"][quantity]["value"]


def main():
    os.chdir(tempfile.mkdtemp())
    prepare()
    library = ctypes.CDLL(os.environ["CONTACT_LIBRARY"])
    message = ctypes.create_string_buffer(2000)

    def run(name, outputs):
        return library.contact_run_with(name.encode(), 2, b"", 1, outputs, message, len(message))

    for name, quantity, bit, option in (("warm", "max_temp1", MOVING_HEAT, "--heat=moving-source"),
                                        ("yawed", "deltcp_tr", ANGLE_AT_CONTACT, "--contact-angle=contact")):
        values = {}
        for outputs, options in ((0, []), (bit, [option])):
            done = subprocess.run([PROGRAM, "--quiet", "--json", *options, "2", name], stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True, timeout=120)
            same(done.returncode, 0, f"{name} {options}: {done.stderr[-300:]}")
            values[outputs] = total(name, quantity)
            os.remove(name + ".jsonl")
            same(run(name, JSON + outputs), 0, f"{name}, outputs {outputs}: {message.value.decode()}")
            same(total(name, quantity), values[outputs], f"{name}: {quantity} of the library and of the program")
        check(abs(values[bit]/values[0] - 1.0) > 0.01, f"{name}: the choice acts, {values}")
    same(run("warm", NOTHING), 1, "a bit that means nothing")
    check("CONTACT_MOVING_HEAT" in message.value.decode(), "what would have been accepted")
    finish()


main()
