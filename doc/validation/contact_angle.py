#!/usr/bin/env python3
"""Contact angles on rails that vary along the track, from the wheel alone: contact_angle.py FOLDER [PROGRAM]

FOLDER holds the published inputs and outputs (its neighbour `tools` compare_out.py). Where two bodies touch they have one
tangent plane, so that the inclination of the wheel at the published place of the contact on it is that of the contact,
whatever the rail looks like. It is compared with the published angle, and with that of PROGRAM when it is given.
The wheel is a cubic spline through its points; the wheelsets of these inputs neither roll nor yaw. Needs numpy and scipy.
"""
import os
import shutil
import subprocess
import sys
import tempfile

import numpy as np
from conformal_distance import profile, spline

RADIUS = 460.0
NAMES = ["cross_locus", "wing_locus", "mbench_intrup", "mbench_locus", "mbench_brute"]


def inclination(folder):
    """Inclination of the wheel across the track [rad] at a place (x, y) of its own axes [mm]"""
    points = profile(os.path.join(folder, "testbank/profiles/MBench_S1002_v3.prw"))
    points[:, 0] *= -1.0
    s, y, z = spline(points[::-1] if points[0, 0] < points[-1, 0] else points)
    fine = np.linspace(s[0], s[-1], 400001)

    def angle(place):
        at = fine[np.argmin(abs(y(fine) - place[1]))]
        r = RADIUS + z(at)
        return np.arctan(z(at, 1) / y(at, 1) * r / np.sqrt(r**2 - place[0] ** 2))

    return angle


def run(program, path):
    """Result file of the program for an input"""
    folder = tempfile.mkdtemp()
    shutil.copytree(os.path.dirname(os.path.dirname(path)), folder, dirs_exist_ok=True)
    here = os.path.join(folder, os.path.basename(os.path.dirname(path)))
    name = os.path.basename(path)
    subprocess.run([os.path.abspath(program), "--contact-angle", "contact", "2", name], cwd=here, stdout=subprocess.DEVNULL,
                   check=False)
    return os.path.join(here, name + ".out")


def main():
    folder = sys.argv[1]
    sys.path.insert(0, os.path.join(folder, "../tools"))
    import compare_out

    angle = inclination(folder)
    print("input            patches   largest difference from the wheel: published    here")
    for name in NAMES:
        path = os.path.join(folder, "testbank/examples_s+c", name)
        files = [path + ".ref_out"] + ([run(sys.argv[2], path)] if len(sys.argv) > 2 else [])
        worst = []
        for file in files:
            patches = [p for case in compare_out.read(file).values() for k, p in case.items() if k and "XCP(W)" in p]
            worst.append(max(abs(angle((p["XCP(W)"], p["YCP(W)"])) - p["DELTCP(TR)"]) for p in patches))
        print(f"{name:17}{len(patches):7}   " + "".join(f"{w:42.4f}" if i == 0 else f"{w:8.4f}" for i, w in enumerate(worst)))


if __name__ == "__main__":
    main()
