#!/usr/bin/env python3
"""A wheelset that hunts on a straight track, by an implicit integrator, with and without the derivatives of the contact forces.

usage: hunting.py [--seconds 10] [--tolerance 1e-2] [--figure FILE.svg]

Lateral position y and yaw of a wheelset on soft springs at 50 m/s, S1002 on 60E1, elements of 1 mm. Each wheel is a problem of the
library with a prescribed vertical force. Creep forces make the equations stiff: a lateral velocity decays within milliseconds,
while the wheelset oscillates with a period of about a second. The integrator is the Rosenbrock method of order 2 with an error
estimate (L.F. Shampine, M.W. Reichelt, The MATLAB ODE Suite, SIAM J. Sci. Comput. 18, 1997, ode23s), which evaluates the Jacobian
at the beginning of every step: from the library, or by finite differences of four more calls per wheel.
"""
import argparse
import os
import sys
import time

import numpy as np

top = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(top, "python"))
from contact import WheelRail, cntc

# mm, s, t, N
SPEED, RADIUS, LOAD = 50000.0, 460.0, 60e3
MASS, INERTIA = 1.5, 8e5
SPRING, YAW_SPRING = 100.0, 3e8
MARKER = 750.0
ROWS, COLUMNS = ["fy_tr", "fx_ws", "mz_w_ws"], ["y", "yaw", "vy", "vyaw"]
STEPS = np.array([1e-4, 1e-7, 1e-1, 1e-4])


class Wheelset:
    """Right-hand side of the equations of motion for y, yaw and their velocities, and its derivatives"""

    def __init__(self):
        self.calls = 0
        self.wheels = []
        for side, lever in (("right", MARKER), ("left", -MARKER)):
            pair = WheelRail(side)
            pair.set_solver(order=1)
            pair.set_material(82000.0, 0.28)
            pair.set_friction(0.3)
            pair.set_grid(1.0, 1.0)
            pair.set_track(14.0, 1435.0, 0.025)
            pair.set_wheelset(1360.0, -70.0, RADIUS)
            pair.set_rail(os.path.join(top, "examples/profiles/60E1.prr"))
            pair.set_wheel(os.path.join(top, "examples/profiles/S1002.prw"))
            pair.set_vertical_force(LOAD)
            self.wheels.append((pair, lever))

    def solve(self, pair, state):
        """Lateral force, longitudinal force and yaw moment on the rail"""
        y, yaw, vy, vyaw = state
        cntc.setwheelsetposition(pair.number, 2, [0.0, y, 0.0, 0.0, yaw, 0.0])
        cntc.setwheelsetvelocity(pair.number, 2, [SPEED, vy, 0.0, 0.0, vyaw, -SPEED / RADIUS])
        cntc.calculate(pair.number, -1)
        self.calls += 1
        forces = cntc.getglobalforces(pair.number, -1)
        return np.array([forces[1], forces[6], forces[11]])

    def accelerations(self, forces, lever):
        """Forces of one wheel on the wheelset, opposite to those on the rail"""
        return np.array([-forces[0] / MASS, -(forces[2] - lever * forces[1]) / INERTIA])

    def rates(self, state):
        y, yaw, vy, vyaw = state
        rates = np.array([vy, vyaw, -SPRING * y / MASS, -YAW_SPRING * yaw / INERTIA])
        for pair, lever in self.wheels:
            rates[2:] += self.accelerations(self.solve(pair, state), lever)
        return rates

    def jacobian(self, state, rates, exact):
        """Derivatives of the rates. Those of the library are at its last calculation, which was that of this state"""
        matrix = np.zeros((4, 4))
        matrix[0, 2] = matrix[1, 3] = 1.0
        if exact:
            matrix[2, 0], matrix[3, 1] = -SPRING / MASS, -YAW_SPRING / INERTIA
            for pair, lever in self.wheels:
                matrix[2:] += self.accelerations(pair.jacobian()[ROWS, COLUMNS], lever)
            return matrix
        for k, step in enumerate(STEPS):
            moved = np.array(state)
            moved[k] += step
            matrix[:, k] = (self.rates(moved) - rates) / step
        return matrix

    def close(self):
        for pair, _ in self.wheels:
            pair.close()


def integrate(wheelset, state, seconds, tolerance, exact):
    """Times and states; numbers of steps, of rejected steps, and of calls of the library"""
    d, e = 1.0 / (2.0 + np.sqrt(2.0)), 6.0 + np.sqrt(2.0)
    scale = np.array([1.0, 1e-3, 30.0, 0.03])
    t, h, refused = 0.0, 1e-3, 0
    times, states = [t], [state]
    rates = wheelset.rates(state)
    while t < seconds:
        matrix = wheelset.jacobian(state, rates, exact)
        while True:
            h = min(h, seconds - t + 1e-12)
            system = np.eye(4) - h * d * matrix
            k1 = np.linalg.solve(system, rates)
            middle = wheelset.rates(state + 0.5 * h * k1)
            k2 = np.linalg.solve(system, middle - k1) + k1
            new = state + h * k2
            ahead = wheelset.rates(new)
            k3 = np.linalg.solve(system, ahead - e * (k2 - middle) - 2.0 * (k1 - rates))
            error = np.abs(h / 6.0 * (k1 - 2.0 * k2 + k3) / np.maximum(scale, np.abs(new))).max() / tolerance
            factor = min(4.0, max(0.2, 0.8 * error ** (-1.0 / 3.0)))
            if error <= 1.0:
                break
            refused += 1
            h *= factor
        t, state, rates = t + h, new, ahead
        h *= factor
        times.append(t)
        states.append(state)
    return np.array(times), np.array(states), refused


def run(seconds, tolerance, exact):
    wheelset = Wheelset()
    before = time.process_time()
    times, states, refused = integrate(wheelset, np.array([3.0, 0.0, 0.0, 0.0]), seconds, tolerance, exact)
    spent = time.process_time() - before
    wheelset.close()
    way = "derivatives of the library" if exact else "differences of calls"
    print(f"{way:28s} {len(times) - 1:6d} steps, {refused:4d} refused, {wheelset.calls:6d} calls, {spent:6.2f} s")
    return times, states, wheelset.calls, spent


def draw(name, curves):
    """Lateral position over time, with the cost of both ways, as an SVG"""
    width, height, left, low = 860, 330, 60, 280
    last = curves[0][0][-1]
    text = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="13">',
            f'<rect width="{width}" height="{height}" fill="white"/>']
    top_value = 8.0

    def at(t, y):
        return left + (width - left - 20) * t / last, 150 - 125 * y / top_value

    for y in (-8, -4, 0, 4, 8):
        (x0, v), (x1, _) = at(0.0, y), at(last, y)
        text += [f'<line x1="{x0:.1f}" x2="{x1:.1f}" y1="{v:.1f}" y2="{v:.1f}" stroke="#ddd"/>',
                 f'<text x="{left - 8}" y="{v + 4:.1f}" text-anchor="end">{y}</text>']
    for k in range(6):
        t = last * k / 5
        text.append(f'<text x="{at(t, 0)[0]:.1f}" y="{low + 15}" text-anchor="middle">{t:g}</text>')
    text += [f'<text x="{left}" y="16">lateral position of the wheelset, mm</text>',
             f'<text x="{width - 20}" y="{low + 38}" text-anchor="end">time, s</text>']
    for (times, states, *_), colour, dash in zip(curves, ("#1f6fb4", "#d1495b"), ("", ' stroke-dasharray="5 4"')):
        points = " ".join("{:.1f},{:.1f}".format(*at(t, y)) for t, y in zip(times, states[:, 0]))
        text.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.5"{dash}/>')
    for row, ((times, _, calls, spent), colour, label) in enumerate(zip(
            curves, ("#1f6fb4", "#d1495b"), ("derivatives of the library", "differences of calls"))):
        text.append(f'<text x="{left}" y="{low + 30 + 15 * row}" fill="{colour}">{label}: {len(times) - 1} steps, {calls} calls, '
                    f'{spent:.1f} s</text>')
    text.append("</svg>")
    with open(name, "w", encoding="utf-8") as file:
        file.write("\n".join(text) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--tolerance", type=float, default=1e-2)
    parser.add_argument("--figure")
    parser.add_argument("--check", action="store_true", help="fail if both ways disagree, or if derivatives do not save calls")
    asked = parser.parse_args()
    curves = [run(asked.seconds, asked.tolerance, exact) for exact in (True, False)]
    (times, states, *_), (other_times, other_states, *_) = curves
    apart = np.abs(np.interp(times, other_times, other_states[:, 0]) - states[:, 0]).max()
    print(f"largest lateral position {np.abs(states[:, 0]).max():.2f} mm; both ways differ by {apart:.3f} mm at most")
    if asked.check and not (apart < 0.2 and curves[0][2] < 0.6 * curves[1][2]):
        sys.exit("FAILED: the two ways disagree, or derivatives do not save calls")
    if asked.figure:
        draw(asked.figure, curves)


if __name__ == "__main__":
    main()
