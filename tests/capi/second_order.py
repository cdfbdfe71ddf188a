#!/usr/bin/env python3
"""Steady rolling of second order: observed orders and jitter over positions of the grid, invariants, admissible tractions

With the argument "long" also finer grids, the limit of the first order, and thirty random contacts.
"""
import functools
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "conformance"))
from checks import SOURCE, check, close, finish
import contact
import numpy as np
from contact.study._batch import Batch

G, NU, MU = 82000.0, 0.28, 0.3
E_STAR = G / (1 - NU)
LONG = "long" in sys.argv
OFFSETS = np.vstack([[0.0, 0.0], np.random.default_rng(5).uniform(-0.5, 0.5, (9, 2))])


def constants():
    """The constants of the edge in the source are those of the factorised symbol (doc/theory/second_order.md)"""
    count, aliases = 4096, 1000
    theta = 2 * np.pi * (np.arange(count) + 0.5) / count
    shifted = theta[:, None] + 2 * np.pi * np.arange(-aliases, aliases + 1)
    even = 2 * np.abs(np.sin(theta / 2)) * np.sum(np.sinc(shifted / (2 * np.pi)) / np.abs(shifted), axis=1)
    log = [np.mean(np.log(even) * np.cos(n * theta)) for n in range(500)]
    with open(os.path.join(SOURCE, "src/tangential/second_order.f90"), encoding="utf-8") as file:
        text = file.read()
    for name, value in (("d0", 0.75 + sum(n * term for n, term in enumerate(log))), ("e0", np.exp(log[0])),
                        ("plain_ratio", 1.5 - log[1])):
        found = float(re.search(name + r" = ([0-9.]+)_wp", text).group(1))
        close(found, value, 2e-6, f"constant {name}")


def constants_of_layers():
    """Formulas for a layer between the bodies agree with the integrals of the factorisation"""
    place, weight = np.polynomial.legendre.leggauss(400)
    theta, weight = (place + 1) * np.pi / 2, weight * np.pi / 2
    shifted = theta[:, None] + 2 * np.pi * np.arange(-2000, 2001)
    even = 2 * np.sin(theta / 2) * np.sum(np.sinc(shifted / (2 * np.pi)) / np.abs(shifted), axis=1)
    with open(os.path.join(SOURCE, "src/tangential/second_order.f90"), encoding="utf-8") as file:
        text = file.read()
    d0, e0 = (float(re.search(name + r" = ([0-9.]+)_wp", text).group(1)) for name in ("d0", "e0"))
    c, b = ([float(value) for value in re.search(name + r"\(\d\) = \[([^]]*)\]", text).group(1).replace("_wp", "").split(",")]
            for name in ("layer_scale", "layer_place"))
    for ratio in np.logspace(-3, 3, 61):
        whole = even + 2 * ratio * np.sin(theta / 2)
        scale = np.exp(np.sum(weight * np.log(whole)) / np.pi)
        near = np.sum(weight * (np.log(whole) / (4 * np.sin(theta / 2)**2) - np.log1p(ratio * theta) / theta**2))
        far = np.log1p(ratio * np.pi) / np.pi + ratio * np.log1p(1 / (ratio * np.pi))
        fitted = e0 + ratio + np.log(1 + ratio * (c[0] + c[1] / (1 + c[2] * ratio**c[3]))) / np.pi
        close(fitted / scale, 1.0, 4e-3, f"layer of {ratio:.1e}: scale of the term")
        fitted = 1 - (1 - d0) / (1 + b[0] * ratio**b[1])
        close(fitted, 0.75 - (near - far) / np.pi, 4e-3, f"layer of {ratio:.1e}: position of the edge")


@functools.lru_cache
def curvatures(a, b, fn):
    """Coefficients of x2 and y2 of the distance of bodies that touch in an ellipse (Hertz)"""
    angle, weight = np.polynomial.legendre.leggauss(200)
    angle, weight = (angle + 1) * np.pi / 4, weight * np.pi / 4
    t = np.tan(angle)**2
    scale = 0.75 * fn / (np.pi * E_STAR)
    return [scale * np.sum(weight * 2 / np.cos(angle)**2 / ((s + t) * np.sqrt((a * a + t) * (b * b + t)))) for s in (a * a, b * b)]


def hertz(n, offset, creep, order, a=3.0, b=5.0, fn=30e3, mu=MU, eps=1e-7, direction=0.0, nu=NU, law=None, layer=None):
    """An ellipse on about n by n elements, the grid shifted by parts of an element"""
    first, second = (value * (1 - nu) / (1 - NU) for value in curvatures(a, b, fn))
    dx, dy = 2.2 * a / n, 2.2 * b / n
    with contact.Problem() as problem:
        problem.set_material(g=G, nu=nu, model=4 if layer else 0, parameters=layer or ())
        if law:
            problem.set_friction_law(*law)
        else:
            problem.set_friction(mu)
        problem.set_grid(n + 2, n + 2, dx, dy, -(n / 2 + 1 + offset[0]) * dx, -(n / 2 + 1 + offset[1]) * dy)
        problem.set_distance(lambda x, y: first * x**2 + second * y**2)
        problem.set_normal_force(fn)
        problem.set_creepages(*creep)
        problem.set_rolling(30e3, dx, direction)
        problem.set_solver(eps=eps, order=order)
        result = problem.solve()
    check(result.status == "solved", f"{n} elements, order {order}: solved")
    return result


def forces(result, a=3.0, b=5.0, mu=MU):
    """FX, FY relative to the friction bound, MZ to the bound times the mean semi-axis"""
    return np.array([result.fx, result.fy, result.mz / np.sqrt(a * b)]) / (mu * result.fn)


def errors(n, creep, order, limit):
    """Root mean squares over positions of the grid of errors and of their deviations from the mean"""
    found = np.array([forces(hertz(n, offset, creep, order)) for offset in OFFSETS]) - limit
    return np.sqrt((found**2).mean(axis=0)), found.std(axis=0)


def carter_force(n, place, order, ratio, direction):
    """Relative force of two cylinders, long elements in one row; the offset of the grid is a fraction of an element"""
    a, p0, length = 1.0, 500.0, 1e4
    radius = a * E_STAR / (2 * p0)
    dx = 2.2 * a / n
    with contact.Problem() as problem:
        problem.set_material(g=G, nu=NU)
        problem.set_friction(MU)
        problem.set_grid(n + 2, 1, dx, length, -(n / 2 + 1 + place) * dx, -length / 2)
        problem.set_distance(lambda x, y: x**2 / (2 * radius) + 0 * y)
        problem.set_normal_force(np.pi * a * p0 / 2 * length)
        problem.set_creepages(-MU * a * (1 - ratio) / radius)
        problem.set_rolling(30e3, dx, direction)
        problem.set_solver(eps=1e-8, order=order)
        result = problem.solve()
    return result.fx / (MU * result.fn)


def carter():
    """Carter (1926): F/(mu N) = 1 - (a'/a)**2 for an adhesion area of half width a'"""
    for direction in (0.0, np.pi):
        for ratio in (0.5, 0.8) if direction == 0 else (0.5,):
            exact = 1 - ratio**2
            rms, spread = {}, {}
            for order in (1, 2):
                for n in (20, 40, 80):
                    found = np.array([abs(carter_force(n, k / 10, order, ratio, direction)) for k in range(10)]) - exact
                    rms[order, n], spread[order, n] = np.sqrt((found**2).mean()), found.std()
            what = f"Carter, adhesion {ratio}, direction {direction:.0f}"
            check(np.log2(rms[2, 20] / rms[2, 80]) / 2 > 1.7, f"{what}: order {np.log2(rms[2, 20] / rms[2, 80]) / 2:.2f}")
            check(rms[2, 20] < 6e-4 and rms[2, 80] < 5e-5, f"{what}: errors {rms[2, 20]:.1e} {rms[2, 80]:.1e}")
            for n in (20, 40, 80):
                check(spread[1, n] > 5 * spread[2, n], f"{what}: jitter {spread[1, n]:.1e} to {spread[2, n]:.1e} at {n}")


def ellipses():
    """Errors on 20 by 20 and 40 by 40 elements, against the limit of both orders"""
    finest = 160
    # bounds of the errors of the forces on 20 x 20 and 40 x 40: a fifth above what was measured when the scheme was derived
    for creep, bounds in (((5e-4, 0, 3e-4), (4.8e-4, 1.5e-4)), ((1e-3, 0, 1e-3), (5.2e-4, 1.2e-4)),
                          ((2e-4, -8e-4, 4e-4), (4.8e-4, 1.8e-4))):
        what = f"ellipse, creepages {creep}"
        count = 5 if LONG else 2
        fine, half = (np.mean([forces(hertz(n, offset, creep, 2)) for offset in OFFSETS[:count]], axis=0)
                      for n in (finest, finest // 2))
        limit = fine + (fine - half) / 3
        rms, jitter = {}, {}
        for n in (20, 40, 80) if LONG else (20, 40):
            for order in (1, 2):
                rms[order, n], jitter[order, n] = errors(n, creep, order, limit)
            size = np.hypot(*rms[2, n][:2])
            if n < 80:
                check(size < bounds[n // 40], f"{what}: error {size:.1e} on {n}")
            check(np.hypot(*rms[1, n][:2]) > 5 * size, f"{what}: {np.hypot(*rms[1, n][:2]):.1e} to {size:.1e} on {n}")
            check(np.linalg.norm(jitter[1, n]) > 5 * np.linalg.norm(jitter[2, n]),
                  f"{what}: jitter {jitter[1, n]} to {jitter[2, n]} on {n}")
        if LONG:
            observed = np.log2(np.hypot(*rms[2, 20][:2]) / np.hypot(*rms[2, 80][:2])) / 2
            check(observed >= 1.7, f"{what}: order of the forces {observed:.2f}")
            # the extrapolated mean over positions of the first order has the same limit; jitter causes an error of 2e-4 of
            # it to ten positions, and 3e-4 to four
            first = [np.mean([forces(hertz(n, offset, creep, 1)) for offset in OFFSETS], axis=0) for n in (80, 160)]
            close(2 * first[1] - first[0], limit, 4e-4, f"{what}: limit of the first order")


def oblique_edges():
    """With a large Poisson's ratio: edges that are oblique to the grid have different terms"""
    creep, nu = (5e-4, 2e-4, 3e-4), 0.48
    found = {n: np.array([forces(hertz(n, offset, creep, 2, nu=nu)) for offset in OFFSETS[:count]])
             for n, count in ((20, 6), (40, 6), (80, 3), (160, 2))}
    limit = found[160].mean(axis=0) * 4 / 3 - found[80].mean(axis=0) / 3
    size = {n: np.sqrt(((found[n] - limit)**2).mean(axis=0).sum()) for n in (20, 40, 80)}
    # without those terms 8.7e-4, 2.5e-4 and 9.0e-5, order 1.64
    check(size[20] < 1e-3 and size[40] < 1.5e-4 and size[80] < 5e-5, f"Poisson's ratio 0.48: errors {size}")
    check(np.log2(size[20] / size[80]) / 2 >= 1.8, f"Poisson's ratio 0.48: order {np.log2(size[20] / size[80]) / 2:.2f}")


def jumps(creep, nu, direction, layer):
    """Where an element enters or leaves the contact on a path of the grid: position, numbers of elements, jump of the forces"""
    path = np.array([0.5, 0.37])

    def solved(place):
        result = hertz(8, place * path, creep, 2, eps=1e-11, direction=direction, nu=nu, layer=layer)
        return result.state > 0, forces(result)

    following = solved(0.0)
    for end in np.arange(1, 6) / 8:
        low, high, before = end - 1 / 8, end, following
        following = after = solved(end)
        if np.array_equal(before[0], after[0]):
            continue
        while high - low > 1e-6:
            middle = (low + high) / 2
            found = solved(middle)
            if np.array_equal(found[0], before[0]):
                low, before = middle, found
            else:
                high, after = middle, found
        yield high, before[0].sum(), after[0].sum(), np.abs(after[1] - before[1]).max()


def entering_elements():
    """Forces do not jump where an element enters or leaves the contact, at the leading or trailing edge or in a row of its own

    The grid moves; where the contact has changed the position is bisected.
    """
    for creep, nu, direction, layer in (((5e-4, 2e-4, 3e-4), 0.48, 0.0, None), ((1e-4, -8e-4, 1e-3), NU, np.pi, None),
                                        ((1e-3, 4e-4, 6e-4), NU, 0.0, [820.0, 2e-3, 0.0, 0.0])):
        count = 0
        for place, before, after, jump in jumps(creep, nu, direction, layer):
            count += 1
            # forces change by less than 0.1 from one to the other end of the path
            check(jump < 0.1 * 1e-6, f"creepages {creep}, nu {nu}, position {place:.7f}: {before} to {after} elements, forces "
                  f"jump by {jump:.1e}")
        check(count >= 3, f"creepages {creep}, nu {nu}: {count} elements enter or leave")


def falling_friction():
    """Friction that falls with slip, with a memory: FX of three grids converges with the second order"""
    kinetic, exponential = 0.12, 4
    for memory in (0.001, 0.005):
        law = (exponential, [kinetic, 0.08, 30.0, 0.0, 1.0, memory, 10.0])
        fx = [np.mean([forces(hertz(n, offset, (1e-3, 0, 3e-4), 2, mu=0.2, law=law))[0] for offset in OFFSETS[:5]])
              for n in (20, 40, 80)]
        change = np.abs(np.diff(fx))
        # the mean of five positions of the grid has an error of about 2e-5
        check(change[1] < max(change[0] / 2.5, 5e-5), f"memory of {memory} mm: FX {fx}, changes {change}")


def elastic_layers():
    """A layer that is much softer than the elements, about as soft, and much stiffer"""
    creep = (1e-3, 4e-4, 6e-4)
    for thickness, bounds in ((2e-4, (7e-4, 2.5e-4)), (2e-3, (1.5e-3, 4e-4)), (2e-2, (2e-3, 6e-4))):
        found = {n: np.array([forces(hertz(n, offset, creep, 2, layer=[820.0, thickness, 0.0, 0.0])) for offset in OFFSETS[:4]])
                 for n in (20, 40, 80)}
        limit = (4 * found[80].mean(axis=0) - found[40].mean(axis=0)) / 3
        rms = [np.linalg.norm(np.sqrt(((found[n] - limit)**2).mean(axis=0))) for n in (20, 40)]
        check(rms[0] < bounds[0] and rms[1] < bounds[1], f"layer of {thickness} mm: errors {rms}")
        first = np.linalg.norm(forces(hertz(40, OFFSETS[0], creep, 1, layer=[820.0, thickness, 0.0, 0.0])) - limit)
        check(first > 10 * rms[1], f"layer of {thickness} mm: {first:.1e} by order 1, {rms[1]:.1e} by order 2")


def random_contacts():
    """Thirty contacts, from adhesion to full sliding: orders of the median and of the largest error"""
    rng = np.random.default_rng(2024)
    rms = {n: [] for n in (20, 40, 80)}
    for _ in range(30):
        a, b = np.exp(rng.uniform(0, np.log(8), 2))
        b = np.clip(b, a / 5, 5 * a)
        fn, mu = np.exp(rng.uniform(np.log(5e3), np.log(1e5))), rng.uniform(0.1, 0.6)
        unit = 0.75 * mu * fn / (G * a * b)
        size, angle = unit * 10**rng.uniform(-1.5, 0.5), rng.uniform(0, 2 * np.pi)
        spin = rng.choice([-1, 1]) * 10**rng.uniform(-1.5, 0.3) * unit / np.sqrt(a * b)
        creep = (size * np.cos(angle), size * np.sin(angle), spin)
        found = {n: np.array([forces(hertz(n, offset, creep, 2, a, b, fn, mu, 1e-6), a, b, mu)
                              for offset in OFFSETS[:3 if n < 160 else 1]]) for n in (20, 40, 80, 160)}
        limit = found[160].mean(axis=0) * 4 / 3 - found[80].mean(axis=0) / 3
        for n, errors_of in rms.items():
            errors_of.append(np.sqrt(((found[n] - limit)**2).mean(axis=0)).max())
    median = {n: np.median(errors_of) for n, errors_of in rms.items()}
    check(median[20] < 1.4e-3 and median[40] < 3.9e-4 and median[80] < 9.6e-5, f"medians of random contacts {median}")
    square = {n: np.sqrt(np.mean(np.square(errors_of))) for n, errors_of in rms.items()}
    check(square[20] < 1.4e-3 and square[40] < 3.9e-4 and square[80] < 9.6e-5, f"rms of random contacts {square}")
    check(np.log2(square[20] / square[80]) / 2 >= 1.7, f"its order {np.log2(square[20] / square[80]) / 2:.2f}")
    check(np.log2(median[20] / median[80]) / 2 > 1.6, f"their order {np.log2(median[20] / median[80]) / 2:.2f}")


def mirrored():
    """Rolling in the opposite direction is the mirror image; at almost no slip, the direction of an element depends on the
    iteration"""
    creep = (4e-4, -3e-4, 5e-4)
    one = hertz(24, (0.3, 0.2), creep, 2, eps=1e-10)
    other = hertz(24, (-0.3, 0.2), (-creep[0], creep[1], -creep[2]), 2, eps=1e-10, direction=np.pi)
    for name, sign in (("pn", 1), ("px", -1), ("py", 1), ("sx", -1), ("sy", 1)):
        field, image = getattr(one, name), sign * getattr(other, name)[:, ::-1]
        away = np.abs(image - field).max() / np.abs(field).max()
        check(away < 1e-4, f"mirror image of {name}: {away:.1e} deviation")


def unrest(result):
    """Second differences along x that change their sign from element to element, relative to the tractions

    A border of adhesion has some, a checkerboard many.
    """
    contact_area = result.state > 0
    inside = contact_area[:, :-3] & contact_area[:, 1:-2] & contact_area[:, 2:-1] & contact_area[:, 3:]
    bends = [np.diff(field, 2, axis=1) for field in (result.px, result.py)]
    turning = sum(np.minimum(bend[:, 1:] * bend[:, :-1], 0)[inside].sum() for bend in bends)
    return -turning / (result.px**2 + result.py**2).sum()


def admissible():
    """Tractions within their bounds, against the slip, without checkerboards"""
    for creep in ((5e-4, 0, 3e-4), (0, 0, 2e-3), (2e-3, 1e-3, 0), (1e-6, 0, 0)):
        result = hertz(40, (0.2, 0.4), creep, 2)
        size = np.hypot(result.px, result.py)
        check(np.all(size <= MU * result.pn * (1 + 1e-12)), f"{creep}: tractions within bounds")
        slips = (result.state == 2) & (result.pn > 0)
        slip = np.hypot(result.sx, result.sy)
        cosine = (result.px * result.sx + result.py * result.sy)[slips] / (size * slip)[slips]
        check(np.all(np.abs(np.abs(cosine) - 1) < 1e-4), f"{creep}: slip is along the tractions")
        check(len(set(np.sign(cosine))) <= 1, f"{creep}: with one sign")
        first, second = (unrest(hertz(40, (0.2, 0.4), creep, order)) for order in (1, 2))
        check(second < 1.5 * first + 1e-3, f"{creep}: no checkerboard, {first:.1e} to {second:.1e}")


def turning_round():
    """Rollers of aluminium and steel close to full sliding: slip reverses between two elements, tractions remain along x"""
    for n in (38, 75, 150):
        for place in (0.0, 0.3, 0.6):
            dx = 0.2016 / n
            with contact.Problem() as problem:
                problem.set_material(g=23000, nu=0.31, g2=82000, nu2=0.28)
                problem.set_friction(1e-4)
                problem.set_grid(n + 2, 1, dx, 1000, -(n / 2 + 1 - place) * dx, -500)
                problem.set_distance(lambda x, y: 0.02 * x**2 + 0 * y)
                problem.set_normal_force(16201.9)
                problem.set_creepages(5.2e-4)
                problem.set_rolling(1000, dx, np.pi)
                problem.set_solver(eps=1e-6, order=2)
                result = problem.solve()
            check(abs(result.fy) < 1e-9 * 1e-4 * result.fn,
                  f"{n} elements, position {place}: FY = {result.fy:.1e} along a cylinder")


FORMULA = """[[case]]
module = "contact"
motion = "steady_rolling"
normal = "force"
pressure = "{pressure}"
[case.kinematics]
fn = 30e3
cksi = {creep[0]}
ceta = {creep[1]}
cphi = {creep[2]}
[case.friction]
fstat = 0.3
fkin = 0.3
[case.material]
poiss = [0.28, 0.28]
gg = [82000.0, 82000.0]
[case.rolling]
veloc = 30e3
dq = 1.0
[case.iteration]
order = {order}
eps = 1e-7
maxgs = 999
maxin = 100
maxnr = 30
[case.grid]
form = "{form}"
mx = {n}
my = {n}
aa = 3.0
{extents}
scale = {scale}
"""


def by_formula():
    """Pressures that are semi-ellipses by formula: the limit is that of pressures that are solved for, and so is the order"""
    scales = np.linspace(1.05, 1.25, 5)
    for pressure, form, extents, low, high in (("elliptical", "hertz_axes", "bb = 5.0", 5.0, 5.0),
                                               ("sdec", "half_ellipses", "bneg = 5.0\nbpos = 5.0", 5.0, 5.0),
                                               ("sdec", "half_ellipses", "bneg = 7.0\nbpos = 3.0", 7.0, 3.0)):
        for creep in ((5e-4, 0, 3e-4), (2e-4, -8e-4, 4e-4)):
            def solved(n, order, pressure=pressure, form=form, extents=extents, creep=creep):
                with Batch() as batch:
                    found = [batch.solve(FORMULA.format(pressure=pressure, form=form, extents=extents, creep=creep, order=order,
                                                        n=n, scale=scale)) for scale in scales]
                place = [column.name for column in found[0].columns].index
                check(all(one.states[0, 0] == 0 for one in found), f"{pressure}, {n} elements, order {order}: solved")
                values = np.array([one.values[0] for one in found])
                return np.column_stack([values[:, place("fx")], values[:, place("fy")], values[:, place("mz")] / np.sqrt(15)]) \
                    / (0.3 * 30e3)

            what = f"{pressure}, extents {low} and {high}, creepages {creep}"
            fine = solved(120, 2).mean(axis=0)
            if low == high:
                limit = np.mean([forces(hertz(120, offset, creep, 2)) for offset in OFFSETS[:3]], axis=0)
                close(fine, limit, 1.5e-4, f"{what}: pressures that are solved for")
            rms = {(n, order): np.sqrt(((solved(n, order) - fine)**2).mean(axis=0)).max() for n in (20, 40) for order in (1, 2)}
            # a fifth above what was measured when this was made
            check(rms[20, 2] < 2.9e-3 and rms[40, 2] < 7e-4, f"{what}: errors {rms[20, 2]:.1e} {rms[40, 2]:.1e}")
            check(rms[40, 1] > 5 * rms[40, 2], f"{what}: {rms[40, 1]:.1e} to {rms[40, 2]:.1e} on 40")


constants()
constants_of_layers()
carter()
ellipses()
oblique_edges()
entering_elements()
falling_friction()
elastic_layers()
by_formula()
mirrored()
turning_round()
admissible()
if LONG:
    random_contacts()
finish()
