#!/usr/bin/env python3
"""Normal contact of t1_zws, measured profiles, by independent means: measured_profiles.py FOLDER

FOLDER holds the published inputs and outputs (its neighbour `tools` compare_out.py). The planes of the patches and the
heights of the wheelset are the published ones. The distance of the undeformed bodies is that of the splines through the
points of the profiles, or that of a wheel of straight pieces across the profile; pieces of 0.4 mm, the published DS,
begin at any of four places. Needs numpy and scipy, and conformal_distance.py beside it.
"""
import os
import sys

import conformal_distance
import numpy as np
from conformal_distance import axes, pressures, profile, spline
from scipy.optimize import brentq

STEP, RADIUS, Y_WS, ROLL, YAW, Y_WHEEL = 0.4, 444.0, 14.74, -0.0013, 0.0050, 673.7
GAUGE_HEIGHT, GAUGE = 15.875, 1435.1
PIECES = [(0.4, 0.0), (0.4, 0.25), (0.4, 0.5), (0.4, 0.75), (0.1, 0.0)]


class Pair:
    def __init__(self, folder):
        points = profile(os.path.join(folder, "testbank/profiles/site_b_hr.prr"))
        self.s_rail, y, z = spline(points)
        self.fine = np.linspace(self.s_rail[0], self.s_rail[-1], 400001)
        zs, ys = z(self.fine), y(self.fine)
        head = (zs - zs.min() <= GAUGE_HEIGHT) & (self.fine <= self.fine[zs.argmin()])
        dy, dz = 0.5 * GAUGE - ys[head].min(), -zs.min()
        self.y_rail = lambda s, k=0: y(s, k) + (dy if k == 0 else 0)
        self.z_rail = lambda s, k=0: z(s, k) + (dz if k == 0 else 0)
        self.zero = self.s_rail[np.argmin((points**2).sum(axis=1))]
        self.s_wheel, self.y_wheel, self.z_wheel = spline(profile(os.path.join(folder, "testbank/profiles/worn_high_mileage.prw")))
        c, s = np.cos(YAW), np.sin(YAW)
        self.turn = axes(ROLL) @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])

    def patch(self, published, z_ws, s_ws, low, high):
        """Distances of the elements between two lateral positions: name -> h; nothing outside

        Elements stand on the lattice of the rail, for s_ws = None one has its centre in the reference.
        """
        x0, y0, z0, angle = (published[n] for n in ("XCP(TR)", "YCP(TR)", "ZCP(TR)", "DELTCP(TR)"))
        plane, place = axes(angle), np.array([x0, y0, z0])
        origin = np.array([0, Y_WS, z_ws - RADIUS]) + self.turn @ [0, Y_WHEEL, RADIUS]
        s_ref = self.fine[np.argmin(np.hypot(self.y_rail(self.fine) - y0, self.z_rail(self.fine) - z0))]
        large = published["FN"] > 4e4
        across, along = (36.0, 22.0) if large else (10.0, 13.0)
        shift = np.zeros(2) if s_ws is None else np.array([s_ws + x0, s_ref - self.zero])
        x = np.arange(round((shift[0] - along) / STEP), round((shift[0] + along) / STEP)) * STEP - shift[0]
        s = np.arange(round((shift[1] - across) / STEP), round((shift[1] + across) / STEP)) * STEP - shift[1]
        n_rail = np.array([self.rail_height(place[1:], plane[1:, 1:], s_ref, t) for t in s])
        y = y0 + plane[1, 1] * s + plane[1, 2] * n_rail
        n_rail[(y < low) | (y > high)] = 999.0
        local = self.turn.T @ (place - origin)
        points = plane @ np.array([a.ravel() for a in np.meshgrid(x, s, [0.0], indexing="ij")])
        n_wheel, where = self.wheel_height(self.turn.T @ (points + (place - origin)[:, None]), self.turn.T @ plane[:, 2])
        n_wheel, where = n_wheel.reshape(len(x), -1), where.reshape(len(x), -1)
        result = {"surface itself": n_rail - n_wheel}
        near = where[np.abs(x).argmin(), np.abs(s).argmin()]
        w_ref = brentq(lambda t: self.y_wheel(t) - local[1], near - 1, near + 1)
        for length, phase in PIECES:
            m = int((across + 6) / length)
            nodes = w_ref + length * (np.arange(-m, m + 1) + phase)
            nodes = nodes[(nodes > self.s_wheel[0]) & (nodes < self.s_wheel[-1])]
            h = np.empty((len(x), len(s)))
            x_wheel, net = local[0] + np.arange(x[0] - 3, x[-1] + 3, STEP), []
            for t in nodes:
                drop = np.sqrt((RADIUS + self.z_wheel(t))**2 - x_wheel**2) - RADIUS
                line = np.array([x_wheel, np.full_like(x_wheel, self.y_wheel(t)), drop])
                line = plane.T @ (self.turn @ line + (origin - place)[:, None])
                net.append([np.interp(x, line[0], line[1]), np.interp(x, line[0], line[2])])
            net = np.array(net)
            for i in range(len(x)):
                order = np.argsort(net[:, 0, i])
                h[i] = n_rail - np.interp(s, net[order, 0, i], net[order, 1, i], left=-999, right=-999)
            result["pieces of %g mm from %g" % (length, phase * length)] = h
        return result

    def rail_height(self, place, plane, s, across):
        """Height over a point of the plane, columns of which are s and n"""
        q, n, t = place + across * plane[:, 0], plane[:, 1], 0.0
        s = s + across
        for _ in range(60):
            miss = q + t * n - [self.y_rail(s), self.z_rail(s)]
            ds, dt = np.linalg.solve([[-self.y_rail(s, 1), n[0]], [-self.z_rail(s, 1), n[1]]], miss)
            s, t = s - np.clip(ds, -1, 1), t - dt
            if abs(ds) + abs(dt) < 1e-12:
                return t
        return 999.0

    def wheel_height(self, points, n):
        """Heights over points in wheel coordinates, and places on the profile"""
        order = np.argsort(self.y_wheel(self.s_wheel))
        s = np.interp(points[1], self.y_wheel(self.s_wheel)[order], self.s_wheel[order])
        t = np.zeros_like(s)
        for _ in range(80):
            q, r = points + n[:, None] * t, RADIUS + self.z_wheel(s)
            root = np.sqrt(r**2 - q[0]**2)
            f, g = q[1] - self.y_wheel(s), q[2] + RADIUS - root
            a, b, c, d = -self.y_wheel(s, 1), n[1], -r * self.z_wheel(s, 1) / root, n[2] + q[0] * n[0] / root
            ds, dt = (f * d - b * g) / (a * d - b * c), (a * g - c * f) / (a * d - b * c)
            s, t = s - np.clip(ds, -1, 1), t - np.clip(dt, -2, 2)
        return np.where(np.abs(ds) + np.abs(dt) < 1e-9, t, -999.0), s


def main(folder):
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.normpath(folder)), "tools"))
    import compare_out
    conformal_distance.STEP = STEP
    pair = Pair(folder)
    for case, patches in sorted(compare_out.read(os.path.join(folder, "testbank/examples_trans/t1_zws.ref_out")).items()):
        numbers = sorted(k for k in patches if k > 0)
        y, force = [patches[k]["YCP(TR)"] for k in numbers], [patches[k]["FN"] for k in numbers]
        # bounds between neighbours, nearer to the one with the smaller force
        between = [(y[i] * force[i + 1] + y[i + 1] * force[i]) / (force[i] + force[i + 1]) for i in range(len(y) - 1)]
        for i, k in enumerate(numbers):
            high, low = ([1e3] + between + [0.0])[i:i + 2]
            print("case %d, patch %d: published %s" % (case, k, figures(patches[k]["APPROACH"], patches[k]["FN"],
                                                                        patches[k]["PMAX"], patches[k]["NCON"])))
            for name, h in pair.patch(patches[k], patches[0]["Z_WS"], 0.4 * (case > 1), low, high).items():
                p = pressures(h)
                print("   %-26s %s" % (name, figures(-h.min(), p.sum() * STEP**2, p.max(), (p > 0).sum())), flush=True)


def figures(approach, force, largest, number):
    return "approach %.6f mm, FN %.5g N, largest pressure %.1f N/mm2, %d elements" % (approach, force, largest, number)


if __name__ == "__main__":
    main(sys.argv[1])
