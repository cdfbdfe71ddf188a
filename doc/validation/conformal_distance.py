#!/usr/bin/env python3
"""First patch of mbench_conf by independent means: conformal_distance.py FOLDER

FOLDER holds the profiles MBench_UIC60_v3.prr and MBench_S1002_v3.prw of the published examples. The distance of the
undeformed bodies is found along the normals of the reference curve, with the surface of the wheel itself and with
straight pieces between points of it; conjugate gradients give the pressures of half-spaces. Needs numpy and scipy.
"""
import os
import sys

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

CANT, GAUGE, GAUGE_HEIGHT = 0.025, 1435.0, 14.0
RADIUS, Y_WS, Z_WS, YAW, Y_WHEEL = 460.0, 6.25, 0.1720, 0.024, 750.0
X_REF, Y_REF, ANGLE_REF = -12.2183, 724.9451, -0.4232  # as published
STEP, ROWS, COLUMNS = 0.2, np.arange(-11, 10), np.arange(-28, 28)
MODULUS, POISSON = 82000.0, 0.28


def profile(path):
    """Points between point.begin and point.end"""
    with open(path) as file:
        text = file.read().split("point.begin")[1].split("point.end")[0]
    lines = [line.split("!")[0].split() for line in text.splitlines()]
    return np.array([[float(w) for w in words[:2]] for words in lines if len(words) >= 2])


def spline(points):
    s = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))))
    return s, CubicSpline(s, points[:, 0], bc_type="natural"), CubicSpline(s, points[:, 1], bc_type="natural")


def axes(angle):
    """Columns x, s, n of axes that are rolled by an angle"""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


class Pair:
    """Rail and wheel in the track"""

    def __init__(self, folder):
        rail = profile(os.path.join(folder, "MBench_UIC60_v3.prr"))
        wheel = profile(os.path.join(folder, "MBench_S1002_v3.prw"))
        wheel[:, 0] *= -1.0
        rail = rail if rail[0, 0] < rail[-1, 0] else rail[::-1]
        wheel = wheel if wheel[0, 0] > wheel[-1, 0] else wheel[::-1]
        rail = rail @ axes(-CANT)[1:, 1:].T
        s, y, z = spline(rail)
        fine = np.linspace(s[0], s[-1], 400001)
        head = fine[z(fine) - z(fine).min() <= GAUGE_HEIGHT]
        rail += [0.5 * GAUGE - y(head).min(), -z(fine).min()]
        self.s_rail, self.y_rail, self.z_rail = spline(rail)
        self.s_wheel, self.y_wheel, self.z_wheel = spline(wheel)
        c, s = np.cos(YAW), np.sin(YAW)
        self.turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
        self.origin = np.array([0, Y_WS, Z_WS - RADIUS]) + self.turn @ [0, Y_WHEEL, RADIUS]
        self.s_ref = brentq(lambda t: self.y_rail(t) - Y_REF, head[0], self.s_rail[-1])
        self.reference = np.array([X_REF, Y_REF, float(self.z_rail(self.s_ref))])
        local = self.turn.T @ (self.reference - self.origin)
        near = self.place_on_wheel(local[1])
        self.w_ref = brentq(lambda t: self.y_wheel(t) - local[1], near - 2, near + 2)

    def place_on_wheel(self, y):
        """Estimate of the place on the wheel's profile from its lateral coordinate"""
        order = np.argsort(self.y_wheel(self.s_wheel))
        return np.interp(y, self.y_wheel(self.s_wheel)[order], self.s_wheel[order])

    def point_of_wheel(self, x, s):
        z = np.sqrt((RADIUS + self.z_wheel(s))**2 - x**2) - RADIUS
        return self.origin + self.turn @ np.array([x, self.y_wheel(s), z])

    def curve(self):
        """Points y, z and angles of the rows"""
        points, angles = [], []
        for shift in STEP * ROWS:
            a, b = self.s_ref + shift, self.w_ref - shift
            n_rail = np.array([self.z_rail(a, 1), -self.y_rail(a, 1)])
            n_wheel = np.array([self.z_wheel(b, 1), -self.y_wheel(b, 1)])
            n_rail, n_wheel = n_rail / np.hypot(*n_rail), n_wheel / np.hypot(*n_wheel)
            x = (X_REF - self.origin[0] - self.turn[0, 1] * self.y_wheel(b)) / self.turn[0, 0]
            r = RADIUS + self.z_wheel(b)
            out = self.turn @ [n_wheel[1] * x / r, n_wheel[0], n_wheel[1] * np.sqrt(1 - (x / r)**2)]
            points.append(0.5 * (np.array([self.y_rail(a), self.z_rail(a)]) + self.point_of_wheel(x, b)[1:]))
            normal = 0.5 * (n_rail - out[1:])
            angles.append(np.arctan2(normal[0], -normal[1]))
        return np.array(points), np.array(angles)

    def rail_along(self, point, normal):
        s, t = self.s_ref, 0.0
        for _ in range(50):
            miss = [point[0] + t * normal[0] - self.y_rail(s), point[1] + t * normal[1] - self.z_rail(s)]
            ds, dt = np.linalg.solve([[-self.y_rail(s, 1), normal[0]], [-self.z_rail(s, 1), normal[1]]], miss)
            s, t = s - ds, t - dt
            if abs(ds) + abs(dt) < 1e-13:
                break
        return t

    def wheel_along(self, points, normal):
        """Heights of the wheel over points (3, n) along a direction"""
        local, n = self.turn.T @ (points - self.origin[:, None]), self.turn.T @ normal
        s, t = self.place_on_wheel(local[1]), np.zeros(points.shape[1])
        for _ in range(50):
            q = local + n[:, None] * t
            r = RADIUS + self.z_wheel(s)
            root = np.sqrt(r**2 - q[0]**2)
            f1, f2 = q[1] - self.y_wheel(s), q[2] + RADIUS - root
            a, b = -self.y_wheel(s, 1), n[1]
            c, d = -r * self.z_wheel(s, 1) / root, n[2] + q[0] * n[0] / root
            ds, dt = (f1 * d - b * f2) / (a * d - b * c), (a * f2 - c * f1) / (a * d - b * c)
            s, t = s - np.clip(ds, -2, 2), t - dt
            if np.abs(ds).max() + np.abs(dt).max() < 1e-12:
                break
        return t

    def distance(self):
        """Along the normal of each row, both surfaces themselves; negative for overlap"""
        points, angles = self.curve()
        h = np.zeros((len(COLUMNS), len(ROWS)))
        for k, (point, angle) in enumerate(zip(points, angles)):
            n = axes(angle)[:, 2]
            line = np.array([X_REF + STEP * COLUMNS, np.full(len(COLUMNS), point[0]), np.full(len(COLUMNS), point[1])])
            h[:, k] = self.rail_along(point, n[1:]) - self.wheel_along(line, n)
        return h

    def distance_in_pieces(self, step):
        """Along the normal of the reference plane, times the cosine to the row; the wheel bilinear between points"""
        points, angles = self.curve()
        plane = axes(ANGLE_REF)
        local = self.turn.T @ (self.reference - self.origin)
        m = round(12.0 / step)
        s_net = self.w_ref + step * np.arange(-m, m + 1)
        x_net = local[0] + STEP * np.arange(-60, 61)
        net = np.array([[plane.T @ (self.point_of_wheel(x, s) - self.reference) for s in s_net] for x in x_net])
        h = np.zeros((len(COLUMNS), len(ROWS)))
        for k, (point, angle) in enumerate(zip(points, angles)):
            place = (point - self.reference[1:]) @ plane[1:, 1]
            n_rail = self.rail_along(self.reference[1:] + place * plane[1:, 1], plane[1:, 2])
            for i, x in enumerate(STEP * COLUMNS):
                h[i, k] = (n_rail - in_net(net, x, place)) * np.cos(angle - ANGLE_REF)
        return h


def in_net(net, x, y):
    """Height of a net of points (i, j, 3) over a place, bilinear in the quadrilateral that holds it"""
    u = int(np.argmin(np.abs(net[:, net.shape[1] // 2, 0] - x)))
    v = int(np.argmin(np.abs(net[u, :, 1] - y)))
    for i in (u - 1, u, u - 2, u + 1):
        for j in (v - 1, v, v - 2, v + 1):
            a, b, c, d = net[i, j], net[i + 1, j], net[i, j + 1], net[i + 1, j + 1]
            w = np.array([0.5, 0.5])
            for _ in range(10):
                q = a * (1 - w[0]) * (1 - w[1]) + b * w[0] * (1 - w[1]) + c * (1 - w[0]) * w[1] + d * w[0] * w[1]
                slopes = np.column_stack(((b - a) * (1 - w[1]) + (d - c) * w[1], (c - a) * (1 - w[0]) + (d - b) * w[0]))
                w = w - np.linalg.solve(slopes[:2], q[:2] - [x, y])
            if (w > -1e-7).all() and (w < 1 + 1e-7).all():
                return q[2]
    raise ValueError("the net does not reach (%g, %g)" % (x, y))


def pressures(h):
    """Pressures between half-spaces with undeformed distance h: conjugate gradients with the contact conditions"""
    mx, my = h.shape
    x, y = np.meshgrid(np.arange(1 - mx, mx) * STEP, np.arange(1 - my, my) * STEP, indexing="ij")

    def corner(x, y):
        return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))

    a = 0.5 * STEP
    load = corner(x + a, y + a) - corner(x - a, y + a) - corner(x + a, y - a) + corner(x - a, y - a)
    kernel = np.zeros((2 * mx, 2 * my))
    kernel[np.ix_(np.arange(1 - mx, mx) % (2 * mx), np.arange(1 - my, my) % (2 * my))] = (1 - POISSON) / (np.pi * MODULUS) * load
    spectrum = np.fft.rfft2(kernel)

    def displacement(p):
        wide = np.zeros((2 * mx, 2 * my))
        wide[:mx, :my] = p
        return np.fft.irfft2(spectrum * np.fft.rfft2(wide), s=wide.shape)[:mx, :my]

    p = np.where(h < 0, -1000.0 * h, 0.0)
    direction, restart, last = np.zeros_like(p), True, 1.0
    for _ in range(1000):
        gap, contact = displacement(p) + h, p > 0
        norm = (gap[contact]**2).sum()
        direction = np.where(contact, gap + (0.0 if restart else norm / last) * direction, 0.0)
        last, change = norm, displacement(direction)
        length = (gap[contact] * direction[contact]).sum() / (change[contact] * direction[contact]).sum()
        before = p
        p = np.maximum(p - length * direction, 0.0)
        opened = (p <= 0) & (gap < 0)
        restart = opened.any()
        p[opened] -= length * gap[opened]
        if np.abs(p - before).max() < 1e-8 * p.max() and not restart:
            break
    return p


def main(folder):
    pair = Pair(folder)
    for name, h in [("surface itself", pair.distance())] + \
            [("pieces of %g mm" % step, pair.distance_in_pieces(step)) for step in (0.2, 0.1, 0.05)]:
        p = pressures(h)
        print("%-18s approach %.5f mm, TILDE_FN %.0f N, largest pressure %.1f N/mm2, %d elements"
              % (name, -h.min(), p.sum() * STEP**2, p.max(), (p > 0).sum()))


if __name__ == "__main__":
    main(sys.argv[1])
