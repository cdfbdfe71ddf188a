#!/usr/bin/env python3
"""Where contact patches join or separate, normal forces are continuous, and every vertical force has a height.

Profiles with two and three contacts, on a track and on rollers, elements of 1 and 2 mm. The height at which the number of patches
changes is found by bisection: the normal forces on both sides of it agree. With a prescribed vertical force the wheel then moves
past lateral positions at which the patches separate: no call misses the force. Between the distances at which patches turn
towards each other and are joined, derivatives agree with differences. With the slip of each element, tangential forces are
continuous, too.
"""
import os
import sys
import warnings

import numpy as np

top = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(top, "python"))
import contact

warnings.simplefilter("ignore")
SPEED, RADIUS = 25000.0, 460.0
#: Largest difference of the normal forces where patches join or separate, relative to the vertical force: pressures are solved to
#: 1e-8, and elements in planes through other references are shifted by up to some hundredths of a millimetre
SAME = 1e-5
#: The same if a third patch is near: the lattice of elements approaches that of the nearest neighbour only
THIRD = 5e-4
#: The same for the vertical force: creepages in the common plane are those of a rolling cone, and friction changes with them
WITH_FRICTION = 5e-4
#: Wheel, rail, radius of the roller [mm], cant, element, d_sep, d_comb [mm], yaw, roll [rad], force [N], lateral position [mm];
#: largest difference of normal forces
CASES = [("S1002", "60E1_worn", 500.0, 0.025, 1.0, 1.0, 0.5, 3e-3, 0.0, 60e3, 1.13, SAME),
         ("S1002", "60E1_worn", 900.0, 0.025, 2.0, 1.0, 0.25, 5.38379e-3, -4.6004e-5, 48709.9, 0.6225, THIRD),
         ("S1002", "60E1_worn", 900.0, 0.025, 2.0, 1.0, 0.25, 5.38379e-3, -4.6004e-5, 48709.9, 0.9575, SAME),
         ("S1002", "60E1", 900.0, 0.05, 1.0, 8.0, 2.0, 4.94722e-4, -2.03609e-4, 46613.5, 5.3085, SAME),
         ("S1002", "60E1", 0.0, 0.05, 2.0, 4.0, 1.0, -9.83969e-3, 1.53777e-5, 76126.3, 6.216, SAME)]
failures = 0


def check(condition, text):
    global failures
    print("ok    " if condition else "FAILED", text)
    failures += not condition


class Wheel:
    """A wheel of one case, at a height or with its vertical force"""

    def __init__(self, wheel, rail, roller, cant, element, d_sep, d_comb, yaw, roll, load, y, eps=1e-8, order=2):
        self.pair = contact.WheelRail("right", roller=roller > 0.0)
        self.yaw, self.roll, self.load, self.y, self.roller = yaw, roll, load, y, roller
        self.pair.set_material(82000.0, 0.28)
        self.pair.set_friction(0.3)
        self.pair.set_grid(element, element, d_sep=d_sep, d_comb=d_comb)
        self.pair.set_track(14.0, 1435.0, cant, roller_radius=roller)
        self.pair.set_wheelset(1360.0, -70.0, RADIUS)
        self.pair.set_rail(f"{top}/examples/profiles/{rail}.prr")
        self.pair.set_wheel(f"{top}/examples/profiles/{wheel}.prw")
        self.pair.set_solver(eps=eps, order=order)

    def solve(self, y=None, z=None):
        """Result at a lateral position, for the vertical force unless a height is given"""
        self.pair.set_flags(ic_norm=1 if z is None else 0)
        self.pair.set_position(y=self.y if y is None else y, z=z, roll=self.roll, yaw=self.yaw)
        # a roller rotates against the wheel
        self.pair.set_velocity(SPEED / self.roller if self.roller else SPEED, pitch=-1.0003 * SPEED / RADIUS)
        if z is None:
            self.pair.set_vertical_force(self.load)
        return self.pair.solve()


def force(result):
    return np.array(result.forces.track.force)


def joins(wheel, low, high, points=81):
    """Heights between which the number of patches changes, narrowed to round-off"""
    heights = np.linspace(low, high, points)
    counts = [len(wheel.solve(z=z).patches) for z in heights]
    for a, b, before, after in zip(heights[:-1], heights[1:], counts[:-1], counts[1:]):
        if after == before:
            continue
        while np.nextafter(a, b) < b:
            middle = 0.5 * (a + b)
            if len(wheel.solve(z=middle).patches) == before:
                a = middle
            else:
                b = middle
        yield a, b


def slip_of_elements(order):
    """With the slip of each element (D = 3) no force changes where two patches join; with D = 2 FX and FY do by 1.6 % FZ"""
    wheel = Wheel("S1002", "60E1", 0.0, 0.05, 0.5, 8.0, 4.0, 1.5e-3, 0.0, 39200.0, 5.85, order=order)
    wheel.pair.set_flags(ic_discns=3)
    low, high = 5.8, 5.9
    check([len(wheel.solve(y=y).patches) for y in (low, high)] == [2, 1], "D = 3: two patches, and one")
    while high - low > 1e-9:
        middle = 0.5 * (low + high)
        if len(wheel.solve(y=middle).patches) == 2:
            low = middle
        else:
            high = middle
    jump = np.abs(force(wheel.solve(y=low)) - force(wheel.solve(y=high))).max() / wheel.load
    check(jump <= 1e-6, f"D = 3, order {order}: forces differ by {jump:.1e} at {low:.6f} mm")
    wheel.pair.close()


def derivatives(wheel, z, name):
    """Derivatives by y and z at a height against differences of the fourth order"""
    step = 2e-7
    wheel.solve(z=z)
    exact = wheel.pair.jacobian()
    for column, direction in (("y", np.array([1.0, 0.0])), ("z", np.array([0.0, 1.0]))):
        places = [np.array([wheel.y, z]) + k * step * direction for k in (-2, -1, 1, 2)]
        low, below, above, high = (force(wheel.solve(*place)) for place in places)
        slope = (8.0 * (above - below) - (high - low)) / (12.0 * step)
        found = np.array([exact[row, column] for row in ("fx_tr", "fy_tr", "fz_tr")])
        away = np.abs(found - slope).max() / np.abs(slope).max()
        check(away <= 1e-3, f"{name}: derivatives by {column} and differences: {away:.1e}")


for both in (1, 2):
    slip_of_elements(both)
for *case, same in CASES:
    name = " ".join(str(word) for word in case)
    wheel = Wheel(*case)
    z = wheel.solve().wheelset_position[2]
    found = 0
    for below, above in joins(wheel, z - 4e-3, z + 4e-3):
        found += 1
        first, second = wheel.solve(z=below), wheel.solve(z=above)
        jump = np.abs(force(first) - force(second)) / wheel.load
        normal = abs(sum(p.fn for p in first.patches) - sum(p.fn for p in second.patches)) / wheel.load
        where = f"{name}: {len(first.patches)} and {len(second.patches)} patches at {below:.6f} mm"
        check(normal <= same, f"{where}: normal forces differ by {normal:.1e}")
        check(jump[2] <= WITH_FRICTION, f"{where}: FX, FY, FZ differ by {' '.join(f'{value:.1e}' for value in jump)}")
        if len(second.patches) < len(first.patches):
            derivatives(wheel, below - 5e-5, name)
    check(found > 0, f"{name}: {found} heights where the number of patches changes")
    wheel.pair.close()
    wheel = Wheel(*case, eps=1e-5)
    results = [wheel.solve(y=wheel.y + 1e-3 * k) for k in range(-20, 21)]
    missed = sum(result.status != "solved" for result in results)
    check(missed == 0, f"{name}: {missed} of {len(results)} calls miss the force; numbers of patches "
                       f"{sorted({len(result.patches) for result in results})}")
    wheel.pair.close()

sys.exit(failures > 0)
