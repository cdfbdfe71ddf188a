#!/usr/bin/env python3
"""Share of the force that each of two patches takes, mbench_a22_varfric case 3, by independent means: two_patches.py FOLDER

FOLDER holds the published inputs and outputs (its neighbour `tools` compare_out.py). Planes of the patches are the published
ones; the wheelset is moved vertically until both normal forces together are the published sum. With the surface of the
wheel itself, and with a wheel of straight pieces of the published DS, which begin at any of four places, as the
reference has it. Needs numpy and scipy, and measured_profiles.py and conformal_distance.py beside it.
"""
import os
import sys

import conformal_distance
import measured_profiles
import numpy as np
from conformal_distance import axes, pressures, profile, spline
from scipy.optimize import brentq

CASE, STEP, GAUGE_HEIGHT, GAUGE = 3, 0.2, 14.0, 1435.0


class Pair(measured_profiles.Pair):
    """The benchmark's rail and wheel in the track"""

    def __init__(self, folder):
        rail = profile(os.path.join(folder, "examples/MBench_UIC60_v3.prr"))
        wheel = profile(os.path.join(folder, "examples/MBench_S1002_v3.prw")) * [-1.0, 1.0]
        rail = rail if rail[0, 0] < rail[-1, 0] else rail[::-1]
        wheel = wheel if wheel[0, 0] > wheel[-1, 0] else wheel[::-1]
        self.s_rail, y, z = spline(rail)
        self.fine = np.linspace(self.s_rail[0], self.s_rail[-1], 400001)
        zs, ys = z(self.fine), y(self.fine)
        head = (zs - zs.min() <= GAUGE_HEIGHT) & (self.fine <= self.fine[zs.argmin()])
        dy, dz = 0.5 * GAUGE - ys[head].min(), -zs.min()
        self.y_rail = lambda s, k=0: y(s, k) + (dy if k == 0 else 0)
        self.z_rail = lambda s, k=0: z(s, k) + (dz if k == 0 else 0)
        self.s_wheel, self.y_wheel, self.z_wheel = spline(wheel)
        c, s = np.cos(measured_profiles.YAW), np.sin(measured_profiles.YAW)
        self.turn = axes(measured_profiles.ROLL) @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def main(folder):
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.normpath(folder)), "tools"))
    import compare_out
    conformal_distance.STEP = STEP
    for name, value in dict(STEP=STEP, RADIUS=460.0, Y_WS=5.0, ROLL=-0.0003554, YAW=0.012, Y_WHEEL=750.0,
                            PIECES=[(STEP, 0.25 * k) for k in range(4)]).items():
        setattr(measured_profiles, name, value)
    pair = Pair(folder)
    # steady: the reference is the centre of an element
    published = compare_out.read(os.path.join(folder, "examples/mbench_a22_varfric.ref_out"))[CASE]
    first, second = published[1], published[2]
    between = (first["YCP(TR)"] * second["FN"] + second["YCP(TR)"] * first["FN"]) / (first["FN"] + second["FN"])
    gaps = [pair.patch(first, published[0]["Z_WS"], None, between, 1e3),
            pair.patch(second, published[0]["Z_WS"], None, 0.0, between)]
    cosines = [np.cos(first["DELTCP(TR)"]), np.cos(second["DELTCP(TR)"])]
    total = first["FN"] + second["FN"]
    print("published: FN %.1f and %.1f N, approach %.6f and %.6f mm, largest pressure %.1f and %.1f N/mm2" % tuple(
        p[q] for q in ("FN", "APPROACH", "PMAX") for p in (first, second)))
    for name in gaps[0]:
        def solve(down):
            return [pressures(h[name] - down * c) for h, c in zip(gaps, cosines)]
        down = brentq(lambda d: sum(p.sum() for p in solve(d)) * STEP**2 - total, -1e-3, 1e-3, xtol=1e-8)
        p = solve(down)
        print(
            "%-24s FN %.1f and %.1f N, approach %.6f and %.6f mm, largest pressure %.1f and %.1f N/mm2"
            % (
                name,
                *(q.sum() * STEP**2 for q in p),
                *(down * c - h[name].min() for h, c in zip(gaps, cosines)),
                *(q.max() for q in p),
            ),
            flush=True,
        )


if __name__ == "__main__":
    main(sys.argv[1])
