"""Elastic half-spaces in numpy, written from the literature: displacements of the surface by loaded rectangles.

Love (1929) for pressures, Cerruti's solution integrated over a rectangle (Johnson 1985, section 3.6) for shear. Fields are
arrays (my, mx); displacements are differences upper minus lower body, tractions act on the upper body (body 1), z and
pressures point into it.
"""
import numpy as np


def combined(scene_g, scene_nu):
    """G, nu, K of two bodies: compliances add up"""
    (g1, g2), (nu1, nu2) = scene_g, scene_nu
    inverse = 0.5*(1/g1 + 1/g2)
    g = 1/inverse
    return g, g*0.5*(nu1/g1 + nu2/g2), g*0.25*((1 - 2*nu1)/g1 - (1 - 2*nu2)/g2)


def _safe(first, second):
    """first*second, 0 where first is 0"""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(first == 0, 0, first*second)


def _log_of_sum(y, r, x):
    """log(y + r) with r = hypot(x, y), without cancellation for y < 0"""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(y >= 0, np.log(y + r), 2*np.log(np.abs(x)) - np.log(r - y))


def _rectangle_kernels():
    """Antiderivatives in x and y of 1/r, x2/r3, y2/r3, xy/r3, x/r2, y/r2"""
    def parts(x, y):
        r = np.hypot(x, y)
        return _safe(x, _log_of_sum(y, r, x)), _safe(y, _log_of_sum(x, r, y)), r

    def half_log(x, y):
        return np.log(np.hypot(x, y))

    def angle(x, y):
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(x == 0, 0, x*np.arctan(y/x))

    return {"1": lambda x, y: parts(x, y)[0] + parts(x, y)[1], "xx": lambda x, y: parts(x, y)[1],
            "yy": lambda x, y: parts(x, y)[0], "xy": lambda x, y: -parts(x, y)[2],
            "x": lambda x, y: _safe(y, half_log(x, y)) + angle(x, y), "y": lambda x, y: _safe(x, half_log(x, y)) + angle(y, x)}


def _hat_kernels():
    """Fourth antiderivatives, twice in x and twice in y, of the same"""
    def log1(x, y):
        return _log_of_sum(y, np.hypot(x, y), x)

    def one(x, y):
        r = np.hypot(x, y)
        return 0.5*(_safe(x*x*y, log1(x, y)) + _safe(x*y*y, log1(y, x))) - r**3/6

    def xx(x, y):
        r = np.hypot(x, y)
        return 0.5*_safe(x*y*y, log1(y, x)) + x*x*r/6 - y*y*r/3

    def xy(x, y):
        r = np.hypot(x, y)
        return -x*y*r/3 - (_safe(x**3, log1(x, y)) + _safe(y**3, log1(y, x)))/6

    def odd(x, y):
        with np.errstate(divide="ignore", invalid="ignore"):
            log_r = np.log(np.hypot(x, y))
            a = np.where(x == 0, 0, x*x*y*np.arctan(y/x))
            b = np.where(y == 0, 0, y**3*np.arctan(x/y))
        return _safe(x*(3*y*y - x*x), log_r)/6 + a/2 + b/6

    return {"1": one, "xx": xx, "yy": lambda x, y: xx(y, x), "xy": xy, "x": odd, "y": lambda x, y: odd(y, x)}


class HalfSpaces:
    """Influence of each element on each point of a lattice; hats: tractions bilinear between centres (C = 3)"""

    def __init__(self, g, nu, mx, my, dx, dy, hats=False):
        self.g, self.nu, self.k = combined(g, nu)
        self.mx, self.my, self.dx, self.dy, self.hats = mx, my, dx, dy, hats
        self._tables = {}
        if type(self).__name__ in ("HalfSpaces", "ViscoelasticHalfSpaces"):
            self.coupled = abs(self.k) >= 1e-6

    def centre(self, name):
        """Displacement of an element by its own unit traction"""
        return self.table(name)[self.my - 1, self.mx - 1]

    def table(self, name, ahead=(0.0, 0.0)):
        """Coefficient of displacement i by traction j (name ij of x, y, n) for all offsets, times 1: array
        (2 my - 1, 2 mx - 1), offset zero in the middle; the point is shifted by a vector"""
        key = (name, tuple(ahead))
        if key not in self._tables:
            # rectangles: antiderivatives at the corners; hats: fourth antiderivatives at the centres and their neighbours
            number, more = (np.longdouble, 1) if self.hats else (np.float64, 0.5)
            x = (np.arange(-(self.mx - 1) - more, self.mx + more)*number(self.dx) + number(ahead[0]))[np.newaxis, :]
            y = (np.arange(-(self.my - 1) - more, self.my + more)*number(self.dy) + number(ahead[1]))[:, np.newaxis]
            x, y = np.broadcast_arrays(x, y)
            # weights of the point kernels 1/r, x2/r3, ...
            shares = {"xx": {"1": 1 - self.nu, "xx": self.nu}, "yy": {"1": 1 - self.nu, "yy": self.nu},
                      "xy": {"xy": self.nu}, "yx": {"xy": self.nu}, "nn": {"1": 1 - self.nu},
                      "xn": {"x": -self.k}, "nx": {"x": self.k}, "yn": {"y": -self.k}, "ny": {"y": self.k}}[name]
            kernels, order = (_hat_kernels(), 2) if self.hats else (_rectangle_kernels(), 1)
            value = sum(share*kernels[kernel](x, y) for kernel, share in shares.items())
            value = np.diff(np.diff(value, order, axis=0), order, axis=1)
            if self.hats:
                value = value/(number(self.dx)*number(self.dy))
            self._tables[key] = np.asarray(value/(np.pi*self.g), dtype=float)
        return self._tables[key]

    def sum(self, name, field, ahead=(0.0, 0.0)):
        """Displacement at all points due to one component of traction, a plain sum over the loaded elements"""
        table = self.table(name, ahead)
        total = np.zeros((self.my, self.mx))
        for jy, jx in zip(*np.nonzero(field)):
            total += field[jy, jx]*table[self.my - 1 - jy:2*self.my - 1 - jy, self.mx - 1 - jx:2*self.mx - 1 - jx]
        return total

    def displacement(self, component, px, py, pn, ahead=(0.0, 0.0), coupled=True):
        """Displacement difference in one direction by all tractions; without coupling of pressure and shear on request"""
        fields = {"x": px, "y": py, "n": pn}
        total = np.zeros((self.my, self.mx))
        for other, field in fields.items():
            if field is None or ((component == "n") != (other == "n") and (not coupled or not self.coupled)):
                continue
            total += self.sum(component + other, field, ahead)
        return total


def shifted(field, kx, ky):
    """field(ix + kx, iy + ky) at (ix, iy), zero beyond its borders"""
    my, mx = field.shape
    result = np.zeros_like(field)
    if abs(kx) < mx and abs(ky) < my:
        result[max(0, -ky) : my - max(0, ky), max(0, -kx) : mx - max(0, kx)] = field[max(0, ky) : my + min(0, ky), max(0, kx) : mx
                                                                                     + min(0, kx)]
    return result


def elliptic_integrals(k2):
    """Complete elliptic integrals K, E of the modulus squared, by the arithmetic-geometric mean"""
    a, b, c2, power = 1.0, (1.0 - k2)**0.5, k2, 0.5
    total = power*c2
    while abs(a - b) > 1e-15*a:
        a, b, c = 0.5*(a + b), (a*b)**0.5, 0.5*(a - b)
        power *= 2
        total += power*c*c
    k = np.pi/(2*a)
    return k, k*(1 - total)


def hertz_from_axes(a, b, modulus):
    """Hertz's ellipse with semi-axes a, b along x, y, per unit of largest pressure p0, modulus = G/(1 - nu) of the pair
    (the compliance of both together): curvatures A, B of h = A x2 + B y2, approach, force.

    From the potential of the ellipsoidal pressure (Johnson 1985, 3.6): the surface moves by
    u = p0/(2 modulus) * int_0^inf (1 - x2/(a2 + w) - y2/(b2 + w)) a b dw / sqrt((a2 + w)(b2 + w) w).
    """
    big, small = max(a, b), min(a, b)
    m = 1 - (small/big)**2
    k, e = elliptic_integrals(m)
    first = 2*k/big
    if m < 1e-12:
        along_big = along_small = np.pi/(2*big**3)
    else:
        along_big = 2*(k - e)/(m*big**3)
        along_small = 2*(e/(small/big)**2 - k)/(m*big**3)
    factor = a*b/(2*modulus)
    curvature = {big: factor*along_big, small: factor*along_small}
    if big == small:
        ax = by = factor*along_big
    else:
        ax, by = curvature[a], curvature[b]
    return ax, by, factor*first, 2*np.pi*a*b/3


class ViscoelasticHalfSpaces(HalfSpaces):
    """Standard linear solids in steady rolling (M = 1): each body adds f times the mean of its displacements at the previous
    positions of the particle, weighted with exp(-s) over s relaxation times"""

    def __init__(self, g, nu, mx, my, dx, dy, memory, veloc, sign):
        super().__init__(g, nu, mx, my, dx, dy)
        fg1, fg2, tc1, tc2 = memory
        rigid = 1e30
        self.bodies = [(fg1, sign*veloc*tc1, HalfSpaces((g[0], rigid), (nu[0], 0.0), mx, my, dx, dy)),
                       (fg2, sign*veloc*tc2, HalfSpaces((rigid, g[1]), (0.0, nu[1]), mx, my, dx, dy))]
        # the coupling of both bodies cancels only if all properties are equal
        self.coupled = abs(self.k) >= 1e-6 or abs(fg1 - fg2) + abs(tc1 - tc2) > 0

    def table(self, name, ahead=(0.0, 0.0)):
        key = (name, tuple(ahead))
        if key not in self._tables:
            value = np.array(super().table(name, ahead))
            for factor, length, body in self.bodies:
                if factor > 0:
                    value += factor*self._memory(name, ahead, length, body)
            self._tables[key] = value
        return self._tables[key]

    def _memory(self, name, ahead, length, body):
        if length == 0:
            return body.table(name, ahead)
        # ends of panels: where the point crosses the side of an element, and steps of the decay
        step = abs(self.dx/length)
        ends = np.concatenate([np.arange(0, min(30, 2 * self.mx * step), step / 2), np.linspace(0, 30, 31),
                               np.geomspace(0.1 * min(step, 1.0), 30, 40)])
        ends = np.unique(np.round(ends, 12))
        place, weight = np.polynomial.legendre.leggauss(4)
        total = 0.0
        for low, high in zip(ends[:-1], ends[1:]):
            if high - low < 1e-9:
                continue
            for x, w in zip(place, weight):
                s = 0.5*(low + high) + 0.5*(high - low)*x
                # not stored: each point is needed once
                body._tables.clear()
                total = total + 0.5*(high - low)*w*np.exp(-s)*body.table(name, (ahead[0] + length*s, ahead[1]))
        return total


class Tabulated(HalfSpaces):
    """Coefficients given for all offsets (C = 9), displacement per traction"""
    coupled = True

    def __init__(self, g, nu, mx, my, dx, dy, tables):
        super().__init__(g, nu, mx, my, dx, dy)
        self._tables = {(name, (0.0, 0.0)): table for name, table in tables.items()}

    def table(self, name, ahead=(0.0, 0.0)):
        if ahead != (0.0, 0.0) and (name, tuple(ahead)) not in self._tables:
            # steps of one element; the column beyond the table continues the last one like 1/distance
            steps = round(ahead[0]/self.dx)
            table = self._tables[name, (0.0, 0.0)]
            moved = np.empty_like(table)
            if steps > 0:
                moved[:, :-1] = table[:, 1:]
                moved[:, -1] = table[:, -1]*(self.mx - 1)/self.mx
            else:
                moved[:, 1:] = table[:, :-1]
                moved[:, 0] = table[:, 0]*(self.mx - 1)/self.mx
            self._tables[name, tuple(ahead)] = moved
        return self._tables[name, tuple(ahead)]


class ConformalHalfSpaces(HalfSpaces):
    """Half-spaces whose surface turns across the rolling direction (C = 4)"""
    coupled = True

    def __init__(self, g, nu, mx, my, dx, dy, y, angles):
        super().__init__(g, nu, mx, my, dx, dy)
        method, self.variant, points = angles
        place, angle = np.array(points).T
        if method == 0 or len(points) == 2:
            slope, level = np.polyfit(place, angle, 1)
            self.angle = slope*y + level
        else:
            i = np.clip(np.searchsorted(place, y) - 1, 0, len(place) - 2)
            share = (y - place[i])/(place[i + 1] - place[i])
            self.angle = angle[i]*(1 - share) + angle[i + 1]*share

    def displacement(self, component, px, py, pn, ahead=(0.0, 0.0), coupled=True):
        tractions = [np.zeros((self.my, self.mx)) if field is None else field for field in (px, py, pn)]
        if not coupled:
            # effects of the components of traction without coupling
            tractions = [0*field if (component == "n") != (name == "n") else field for name, field in zip("xyn", tractions)]
        total = np.zeros((self.my, self.mx))
        row = "xyn".index(component)
        for jy, jx in zip(*np.nonzero(abs(tractions[0]) + abs(tractions[1]) + abs(tractions[2]))):
            turn = (self.angle[jy] - self.angle)[:, np.newaxis]
            part = slice(self.my - 1 - jy, 2*self.my - 1 - jy), slice(self.mx - 1 - jx, 2*self.mx - 1 - jx)
            before, after = {1: (turn, 0*turn), 2: (turn, 0*turn), 3: (0*turn, turn), 4: (turn/2, turn/2)}[self.variant]
            x, s, n = (field[jy, jx] for field in tractions)
            q = (x + 0*turn, np.cos(before)*s - np.sin(before)*n, np.sin(before)*s + np.cos(before)*n)

            def apply(i, q=q, part=part):
                return sum(self.table("xyn"[i] + "xyn"[j], ahead)[part]*q[j] for j in range(3))

            if row == 0:
                total += apply(0)
                if self.variant == 2:
                    # the coefficient of u_x by p_n stays that of the plane
                    total += self.table("xn", ahead)[part]*n - self.table("xy", ahead)[part]*(-np.sin(before)*n) \
                        - self.table("xn", ahead)[part]*np.cos(before)*n
            elif row == 1:
                total += np.cos(after)*apply(1) - np.sin(after)*apply(2)
            else:
                total += np.sin(after)*apply(1) + np.cos(after)*apply(2)
        return total
