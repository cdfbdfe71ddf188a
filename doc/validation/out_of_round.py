#!/usr/bin/env python3
"""Largest pressure, approach and contact reference of wheels with flats, independent of the program (numpy, scipy).

Usage: out_of_round.py REFERENCE wheelflat|rounded [LINES [STEP]]

REFERENCE is the folder of the published inputs and outputs; its neighbour `tools` holds compare_out.py. The frame of the
contact, the height of the wheelset and the normal force are the published ones. LINES is the number of intervals
across the profile, by default as many as 0.5 mm ask for; STEP the size of the elements. See wheel_rail.md.
"""
import os
import sys

import numpy as np
from scipy.interpolate import BSpline, CubicHermiteSpline, CubicSpline, RectBivariateSpline, make_smoothing_spline

REFERENCE = os.path.join(os.path.normpath(sys.argv[1]), '') if len(sys.argv) > 1 else ''


def surface(folder, name, smooth, lines):
    """Coordinates y and z of all lines across the profile as functions of the angle: slices are control points"""
    angles, files = [], []
    with open(folder + name + ".slcw") as file:
        lines = file.readlines()
    for text in lines:
        words = text.split()
        if len(words) == 2 and name in words[1]:
            angles.append(float(words[0]))
            files.append(words[1].strip("'"))
    profiles = []
    for file in files:
        y, z = np.loadtxt(folder + file).T[:2]
        if y[0] < y[-1]:
            y, z = y[::-1], z[::-1]
        s = np.r_[0, np.cumsum(np.hypot(np.diff(y), np.diff(z)))]
        if smooth > 0:
            profiles.append((s[-1], make_smoothing_spline(s, y, lam=smooth), make_smoothing_spline(s, z, lam=smooth)))
        else:
            profiles.append((s[-1], CubicSpline(s, y, bc_type="natural"), CubicSpline(s, z, bc_type="natural")))
    lines = lines or 1 + int(max(p[0] for p in profiles)/0.5)
    y = np.array([p[1](np.linspace(0, p[0], lines + 1)) for p in profiles])
    z = np.array([p[2](np.linspace(0, p[0], lines + 1)) for p in profiles])
    u, k = np.array(angles), np.array([3, 2, 1])
    knots = np.r_[u[0] - (u[1] - u[0])*k, u, u[-1] + (u[-1] - u[-2])*k[::-1]]

    def longer(points):
        return np.vstack([2*points[0] - points[1], points, 2*points[-1] - points[-2]])
    return BSpline(knots, longer(y), 3), BSpline(knots, longer(z), 3)


def local_cubic(number, values):
    """Between the lines: slopes from both neighbours, as the reference does it (with a spline here its pressures are missed)"""
    return CubicHermiteSpline(number, values, np.gradient(values))


def heights(lines, pitch, radius, half_length, y_range):
    """Deviation of the radius over the angle from the bottom and y"""
    angle = np.arange(-half_length/radius, half_length/radius, 0.2/radius)
    across = np.arange(*y_range, 0.05)
    table = np.empty((len(angle), len(across)))
    for i, a in enumerate(angle):
        y, z = lines[0](a - pitch), lines[1](a - pitch)
        near = slice(max(np.searchsorted(-y, -y_range[1] - 3), 0), min(np.searchsorted(-y, -y_range[0] + 3), len(y)))
        number = np.arange(len(y))[near]
        fine = np.linspace(number[0], number[-1], 20*len(number))
        table[i] = CubicSpline(-local_cubic(number, y[near])(fine), local_cubic(number, z[near])(fine))(-across)
    return RectBivariateSpline(angle, across, table)


def influence(step, nx, ny, compliance):
    """Love's rectangle, on the doubled grid of a linear convolution"""
    x = (np.arange(2*nx) - (np.arange(2*nx) >= nx)*2*nx)*step
    y = (np.arange(2*ny) - (np.arange(2*ny) >= ny)*2*ny)*step
    x, y = np.meshgrid(x, y, indexing="ij")
    sums = 0
    for i in (1, -1):
        for j in (1, -1):
            a, b = x + i*step/2, y + j*step/2
            sums = sums + i*j*(a*np.arcsinh(b/np.abs(a)) + b*np.arcsinh(a/np.abs(b)))
    return sums*compliance


def pressures(h, force, step, compliance):
    """Conjugate gradients with pressures that are not negative (Polonsky and Keer, 1999)"""
    nx, ny = h.shape
    kernel = np.fft.rfft2(influence(step, nx, ny, compliance))

    def settle(p):
        wide = np.zeros((2*nx, 2*ny))
        wide[:nx, :ny] = p
        return np.fft.irfft2(np.fft.rfft2(wide)*kernel, s=(2*nx, 2*ny))[:nx, :ny]
    total = force/step**2
    p = np.where(h < np.sort(h.ravel())[h.size//3], 1.0, 0.0)
    p *= total/p.sum()
    t, old_norm, share = np.zeros_like(p), 1.0, 0.0
    for _ in range(3000):
        gap, inside, before = settle(p) + h, p > 0, p
        gap -= gap[inside].mean()
        norm = (gap[inside]**2).sum()
        t = np.where(inside, gap + share*norm/old_norm*t, 0)
        old_norm = norm
        r = settle(t)
        r -= r[inside].mean()
        tau = (gap[inside]*t[inside]).sum()/(r[inside]*t[inside]).sum()
        p = np.maximum(p - tau*t, 0)
        new = (p == 0) & (gap < 0)
        share = 0.0 if new.any() else 1.0
        p[new] -= tau*gap[new]
        p *= total/p.sum()
        if np.abs(p - before).sum() < 1e-9*p.sum():
            break
    return p


def compute(job, lines, step):
    """One row for each case"""
    published = compare_out.read(REFERENCE + job["output"])
    wheel, radius, cant, rail = surface(REFERENCE + job["folder"], job["slices"], job["smooth"], lines), job["radius"], \
        job["cant"], job["rail"]
    for case in job["cases"]:
        patch, z_ws = published[case][1], published[case][0]["Z_WS"]
        half = job["half"]
        table = heights(wheel, np.radians(job["pitch"](case)), radius, half[0] + 60,
                        (patch["YCP(W)"] - half[1] - 4, patch["YCP(W)"] + half[1] + 4))
        nx, ns = int(half[0]/step), int(half[1]/step)
        x, s = np.meshgrid(np.arange(-nx, nx + 1)*step, np.arange(-ns, ns + 1)*step, indexing="ij")

        def distance(angle):
            """Rail minus wheel along the normal of a plane through the reference with this inclination"""
            cos, sin = np.cos(angle), np.sin(angle)
            above, below = np.zeros_like(x), np.zeros_like(x)
            for _ in range(40):
                y = patch["YCP(R)"] + np.cos(angle + cant)*s - np.sin(angle + cant)*below
                z = patch["ZCP(R)"] + np.sin(angle + cant)*s + np.cos(angle + cant)*below
                below = below + rail(y) - z
                y = patch["YCP(TR)"] + cos*s - sin*above - job["y_wheel"]
                z = patch["ZCP(TR)"] + sin*s + cos*above - z_ws + radius
                along = patch["XCP(TR)"] + x
                above = above + radius + table.ev(np.arctan2(along, z), y) - np.hypot(along, z)
            return below - above
        h = distance(patch["DELTCP(TR)"])
        p = pressures(h - h.min(), patch["FN"], step, (1 - 0.28)/82000/np.pi)
        weight = np.minimum(distance(0.0), 0)**2
        place = [(weight*a).sum()/weight.sum() for a in (patch["XCP(TR)"] + x, patch["YCP(TR)"] + s)]
        print("case %2d  PMAX %7.1f, published %7.1f  approach %.6f, published %.6f  XCP, YCP %8.4f %9.4f, published %8.4f "
              "%9.4f" % (case, p.max(), patch["PMAX"], -h.min(), patch["APPROACH"], *place, patch["XCP(TR)"],
                         patch["YCP(TR)"]), flush=True)


def wide_rail():
    """The rail of wheelflat, z down"""
    points = []
    with open(REFERENCE + "examples/r300_wide.prr") as file:
        lines = file.readlines()
    for text in lines:
        try:
            points.append([float(word) for word in text.split()[:2]])
        except ValueError:
            pass
    y, z = np.array([point for point in points if len(point) == 2]).T
    if y[0] > y[-1]:
        y, z = y[::-1], z[::-1]
    y, z = y[abs(y) < 38], z[abs(y) < 38]
    if z[len(z)//2] > z[0]:
        z = -z
    return CubicSpline(y, z - z.min())


if __name__ == "__main__":
    if len(sys.argv) < 3 or sys.argv[2] not in ("wheelflat", "rounded"):
        sys.exit(__doc__)
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.normpath(REFERENCE)), "tools"))
    import compare_out
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 0
    if sys.argv[2] == "rounded":
        task = dict(output="testbank/examples_oor/rounded_flat_d09.ref_out", folder="testbank/profiles/", slices="flat_d09",
                    smooth=0.0, radius=450.0, y_wheel=0.0, pitch=lambda k: k - 8, cases=range(2, 9), half=(20, 26), cant=0.0,
                    rail=lambda y: 300 - np.sqrt(300**2 - y**2))
    else:
        task = dict(output="examples/wheelflat.ref_out", folder="examples/", slices="S1002_flat", smooth=5.0, radius=490.0,
                    y_wheel=750.0, pitch=lambda k: -24 - k, cases=[5, 6, 10, 11, 15, 17, 19, 20, 22], half=(24, 20), cant=0.02,
                    rail=wide_rail())
    compute(task, count, float(sys.argv[4]) if len(sys.argv) > 4 else 0.2 if sys.argv[2] == "rounded" else 0.4)
