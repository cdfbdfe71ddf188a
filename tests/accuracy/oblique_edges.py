#!/usr/bin/env python3
"""Terms behind oblique edges in rolling of second order, from the kernel: oblique_edges.py [--check]

The scheme is exact for tractions in proportion to pressures but for the part of the kernel that contains Poisson's ratio
(doc/theory/second_order.md). Here this part is applied to pressures of ellipses on grids, independently of the program. What it
leaves behind the leading edge, weighted by the adjoint of adhesion and divided by the effect of a unit term in the second element
of a row, is the term that cancels it. Samples of all rows are averaged by slope of the edge and ratio of the sides of the elements.
Written are the averages, the formulas of src/tangential/second_order.f90 with the constants of the source and fitted to the
averages, and the effects of terms in the second and third elements. --check fails if the constants of the source no longer
describe the averages. CONTACT_SOURCE names the folder of the sources, by default this one.
"""
import os
import pathlib
import re
import sys

import numpy as np

#: Ratios of the sides of the elements, along to across; elements along the axes of the ellipses; positions of each grid
RATIOS = (0.4, 0.63, 1.0, 1.6, 2.5)
SIZES = ((40, 20), (40, 40), (40, 80), (80, 40))
POSITIONS = 8
#: Elements per row by which the edge goes forward: limits of the classes
SLOPES = (0, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 1, 1.3, 1.6, 2, 2.5, 3.2, 4, 6)
#: Rows whose slope changes by more than this part of sqrt(1 + slope^2)^2 to the next one do not resolve the edge
BEND = 0.15
#: Rows of fewer elements, and so near the ends of the ellipse, are left out
SHORTEST, END = 16, 0.97
#: Averages are weighted by their scatter, this part of their value, and this value
PART, LEAST = 0.1, 0.002
#: Constants by the names of the source: of the terms xy, and of xx, which are the opposite of yy
NAMES_XY, NAMES_XX = ("of_direction", "of_steps", "few_steps", "narrow"), ("of_diagonal", "few_rows", "of_ratio")
#: Largest deviation of the formulas with the constants of the source, relative to the root mean square of the averages: xy, xx.
#: Measured: 0.074 and 0.327; best fits of the same formulas 0.063 and 0.275
LARGEST = (0.09, 0.36)
#: Classes of the part of the step by which the edge is ahead of the leading element, see `share`
SHARES = (0, 0.2, 0.4, 0.6, 0.8, 1.01)
#: exp(l0), see second_order.f90
E0 = 0.862164


def terms_xy(c, q, r):
    """Term xy relative to nu 2/G h, for an edge that goes forward by q elements per row of elements with the ratio r"""
    return c[0] * q * r / (1 + (q * r)**2) + c[1] * q**2 / (r * (q**2 + c[2]) + c[3] * q**2 * r**2)


def terms_xx(c, q, r):
    """Term xx, in the same unit"""
    return c[0] * q**3 / ((q**2 + c[1]) * r**c[2])


class Kernel:
    """Products with the parts of the kernel, 1/|k| and its multiples by kx^2/k^2 and kx ky/k^2, for constant tractions in elements;
    "moved" ones are the changes over a step of one element along x
    """

    def __init__(self, mx, my, dx, dy):
        self.size, self.window = (my, mx), (2 * my, 2 * mx)
        x, y = np.meshgrid(((np.arange(2 * mx) + mx) % (2 * mx) - mx) * dx, ((np.arange(2 * my) + my) % (2 * my) - my) * dy)
        self.spectra = {}
        for name in ("n", "xx", "xy"):
            here = self.integral(name, x, y, dx, dy)
            self.spectra[name] = np.fft.rfft2(here)
            self.spectra[name + " moved"] = np.fft.rfft2(here - self.integral(name, x + dx, y, dx, dy))
        self.diagonal = self.integral("n", 0.0, 0.0, dx, dy)

    @staticmethod
    def integral(name, x, y, dx, dy):
        """Over an element, by the antiderivatives of 1/r, y^2/r^3 and -x y/r^3 at its corners"""
        total = 0.0
        for x_side, y_side in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
            u, v = x + x_side * dx / 2, y + y_side * dy / 2
            r = np.hypot(u, v)
            if name == "xy":
                value = r
            else:
                value = u * np.log(v + r) + (v * np.log(u + r) if name == "n" else 0.0)
            total = total + x_side * y_side * value
        return total / (2 * np.pi)

    def product(self, spectrum, p):
        """Of a field in the window"""
        full = np.zeros(self.window)
        full[:self.size[0], :self.size[1]] = p
        return np.fft.irfft2(np.fft.rfft2(full) * spectrum, self.window)[:self.size[0], :self.size[1]]


def pressures(kernel, h):
    """Pressures, contact and gap for the overlap h, by active sets and conjugate gradients"""
    contact, p = h > 0.5 * h.max(), np.zeros_like(h)
    for _ in range(60):
        p = p * contact
        residual = (h - kernel.product(kernel.spectra["n"], p)) * contact
        step, square = residual.copy(), (residual**2).sum()
        for _ in range(400):
            if square <= 1e-20 * (h**2).sum():
                break
            image = kernel.product(kernel.spectra["n"], step) * contact
            length = square / (step * image).sum()
            p, residual = p + length * step, residual - length * image
            square, old = (residual**2).sum(), square
            step = residual + square / old * step
        gap = kernel.product(kernel.spectra["n"], p) - h
        now = (contact & (p > 0)) | (~contact & (gap < -1e-12 * h.max()))
        if np.array_equal(now, contact):
            return p, contact, gap
        contact = now
    raise ValueError("active sets do not converge")


def solved(operator, right, tolerance=1e-5, most=200):
    """Solution of a linear system by GMRES"""
    size = np.linalg.norm(right)
    basis, matrix = [right / size], np.zeros((most + 1, most))
    for j in range(most):
        v = operator(basis[j])
        for i in range(j + 1):
            matrix[i, j] = basis[i] @ v
            v = v - matrix[i, j] * basis[i]
        matrix[j + 1, j] = np.linalg.norm(v)
        basis.append(v / matrix[j + 1, j])
        goal = np.zeros(j + 2)
        goal[0] = size
        y = np.linalg.lstsq(matrix[:j + 2, :j + 1], goal, rcond=None)[0]
        if np.linalg.norm(matrix[:j + 2, :j + 1] @ y - goal) < tolerance * size:
            return sum(a * b for a, b in zip(y, basis))
    raise ValueError("GMRES does not converge")


def adjoint(kernel, contact, leading):
    """Weights of residuals in a sum of tractions in adhesion, without Poisson's ratio, with the terms of the leading elements"""
    inside = np.flatnonzero(contact)
    backwards = np.conj(kernel.spectra["n moved"])
    inverse = np.conj(backwards) / (np.abs(backwards)**2 + (0.01 * np.abs(backwards).max())**2)
    stiffness = (leading / kernel.diagonal).flat[inside]

    def field(v):
        full = np.zeros(contact.shape)
        full.flat[inside] = v
        return full

    def preconditioned(v):
        return np.where(stiffness > 0.5, v / kernel.diagonal, kernel.product(inverse, field(v)).flat[inside])

    def operator(v):
        full = field(preconditioned(v))
        return (kernel.product(backwards, full) + leading * full).flat[inside] / (1 + stiffness)

    return field(preconditioned(solved(operator, 1 / (1 + stiffness))))


def samples(nx, ny, r, offset):
    """Rows of an ellipse of about nx by ny elements: slope, residuals xy and xx, effects of unit terms in the second and third
    elements, all with weights, and share"""
    dx, dy = 1.0, 1.0 / r
    a, b, mx, my = nx / 2 * dx, ny / 2 * dy, nx + 4, ny + 4
    x, y = (np.arange(mx) - mx / 2 + 0.5 + offset[0]) * dx, (np.arange(my) - my / 2 + 0.5 + offset[1]) * dy
    # Hertz: overlap of the bodies, by integrals over t = tan(angle)^2
    angle, weight = np.polynomial.legendre.leggauss(200)
    t, weight = np.tan((angle + 1) * np.pi / 4)**2, weight * np.pi / 4
    weight = 2 * weight * (1 + t) / np.sqrt((a * a + t) * (b * b + t))
    h = weight.sum() - np.sum(weight / (a * a + t)) * x**2 - np.sum(weight / (b * b + t)) * y[:, None]**2
    kernel = Kernel(mx, my, dx, dy)
    p, contact, gap = pressures(kernel, h)
    leading = np.zeros(contact.shape)
    leading[:, :-1] = np.where(contact[:, :-1] & ~contact[:, 1:], gap[:, 1:] / np.maximum(p[:, :-1], 1e-30), 0.0)
    weights = adjoint(kernel, contact, leading)
    # the exact change of displacement over a step is linear: fitted inside
    xx, yy = np.meshgrid(x, y)
    inside = contact & ((xx / a)**2 + (yy / b)**2 < 0.6)
    linear = np.stack([np.ones_like(xx), xx, yy], axis=-1)
    residual = {}
    for name in ("xx", "xy"):
        found = kernel.product(kernel.spectra[name + " moved"], p)
        residual[name] = found - linear @ np.linalg.lstsq(linear[inside], found[inside], rcond=None)[0]
    rows = []
    for iy in range(my):
        columns, place = np.flatnonzero(contact[iy]), y[iy] / b
        if len(columns) < SHORTEST or abs(place) > END:
            continue
        lead = columns[-1]
        slope = -a / b * place / np.sqrt(1 - place**2)
        q = slope * dy / dx
        if a / b**2 / (1 - place**2)**1.5 * dy**2 / dx > BEND * (1 + q**2):
            continue
        normal = np.array([1.0, -slope]) / np.hypot(1, slope)
        # the term of the leading element leaves the trace exact
        left = {name: residual[name][iy].copy() for name in residual}
        left["xx"][lead] += gap[iy, lead + 1] * normal[0]**2
        left["xy"][lead] += gap[iy, lead + 1] * normal[0] * normal[1]
        near = slice(lead - min(int(6 + 2 * abs(q)), len(columns) // 2), lead + 1)
        share = 1 / (1 + leading[iy, lead] / (normal[0] * dx * E0))
        rows.append((r, q, np.sign(q) * (weights[iy, near] @ left["xy"][near]), weights[iy, near] @ left["xx"][near],
                     dx * weights[iy, lead - 1] * p[iy, lead - 1], dx * weights[iy, lead - 2] * p[iy, lead - 2], share))
    return np.array(rows)


def averages():
    """Ratio, slope, terms xy and xx with their standard errors, for all classes; effects of the second element over those of the
    third by classes of shares
    """
    source, rows = np.random.default_rng(1), []
    for r in RATIOS:
        for nx, ny in SIZES:
            rows += [samples(nx, ny, r, source.uniform(-0.5, 0.5, 2)) for _ in range(POSITIONS)]
    rows = np.vstack([part for part in rows if len(part)])
    found = []
    for r in RATIOS:
        for low, high in zip(SLOPES, SLOPES[1:]):
            _, q, xy, xx, effect, _, _ = rows[(rows[:, 0] == r) & (abs(rows[:, 1]) >= low) & (abs(rows[:, 1]) < high)].T
            if len(q) < 12:
                continue
            line, total = [r, (abs(q) * effect).sum() / effect.sum()], effect.sum()
            for value in (xy, xx):
                mean = value.sum() / total
                line += [mean, np.sqrt(((value - mean * effect)**2).sum()) / total]
            found.append(line)
    effects = []
    for low, high in zip(SHARES, SHARES[1:]):
        inside = rows[(rows[:, 6] >= low) & (rows[:, 6] < high)]
        effects.append((inside[:, 6].mean(), inside[:, 4].sum() / inside[:, 5].sum()))
    return np.array(found), effects


def fitted(terms, start, r, q, value, error):
    """Constants of a formula by weighted least squares (Levenberg and Marquardt)"""
    weight = 1 / np.sqrt(error**2 + (PART * value)**2 + LEAST**2)
    x, damping = np.array(start), 1e-2
    now = (terms(x, q, r) - value) * weight
    for _ in range(300):
        columns = []
        for k, size in enumerate(np.maximum(abs(x), 1e-3) * 1e-6):
            moved = x.copy()
            moved[k] += size
            columns.append(((terms(moved, q, r) - value) * weight - now) / size)
        jacobian = np.array(columns)
        normal = jacobian @ jacobian.T
        trial = x - np.linalg.solve(normal + damping * np.diag(np.diag(normal)), jacobian @ now)
        then = (terms(trial, q, r) - value) * weight
        better = np.all(trial > 0) and then @ then < now @ now
        damping *= 0.2 if better else 5.0
        if better:
            x, now = trial, then
        if damping > 1e12:
            break
    return x


def constant(text, name):
    """Value of a constant of the source, a number or a quotient"""
    found = re.search(rf"\b{name} = ([0-9.]+)_wp(?:/([0-9.]+)_wp)?", text)
    return float(found.group(1)) / float(found.group(2) or 1)


def main():
    """Averages, fits and constants, or test"""
    folder = os.environ.get("CONTACT_SOURCE", pathlib.Path(__file__).resolve().parents[2])
    text = pathlib.Path(folder, "src/tangential/second_order.f90").read_text(encoding="utf-8")
    table, effects = averages()
    r, q = table[:, 0], table[:, 1]
    if "--check" not in sys.argv:
        print("ratio slope | xy +- | xx +-")
        for line in table:
            print("%5.2f %5.2f | %7.4f %.4f | %7.4f %.4f" % tuple(line))
        print("effect in the second element over that in the third: "
              + ", ".join(f"{effect:.2f} at share {share:.2f}" for share, effect in effects))
    wrong = []
    formulas = (("xy", terms_xy, NAMES_XY, 2), ("xx", terms_xx, NAMES_XX, 4))
    for (what, terms, names, column), largest in zip(formulas, LARGEST):
        value, error = table[:, column], table[:, column + 1]
        inside = [constant(text, name) for name in names]
        best = fitted(terms, inside, r, q, value, error)
        size = np.sqrt((value**2).mean())
        off, least = (np.sqrt(((terms(c, q, r) - value)**2).mean()) / size for c in (inside, best))
        print(f"{what}: " + ", ".join(f"{name} {a:.4g} (fitted {b:.4g})" for name, a, b in zip(names, inside, best)))
        print(f"   deviation of the averages, relative to their root mean square: {off:.3f}, from the fit {least:.3f}")
        if off > largest:
            wrong.append(f"terms {what} of the source deviate by {off:.3f} from those of the kernel")
    sys.exit("\n".join(wrong) or 0)


if __name__ == "__main__":
    main()
