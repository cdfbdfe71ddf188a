"""Contact positions and motions of wheel and rail of module 1, by points on both surfaces.

Everything is for the right-hand picture: x along the track, y to the right, z down, in mm and rad. The surfaces are sampled;
nothing is taken from a formula for the contact locus.
"""
import math

import numpy as np
import profiles

SAMPLE = 0.005  # distance of points of the rail [mm]
# Surfaces through slices have lines at distances of 0.5 mm across the profile. Where the curvature jumps, spline and profile are
# apart by this [mm], and shallow contacts move by this along the profile. With lines at 0.05 mm both are gone
SLICED, SLICED_PLACE = 2e-4, 0.02


def turn(axis, angle):
    """Rotation matrix about one axis, 0, 1, 2 for x, y, z"""
    c, s = math.cos(angle), math.sin(angle)
    a, b = [(1, 2), (2, 0), (0, 1)][axis]
    matrix = np.eye(3)
    matrix[a, a] = matrix[b, b] = c
    matrix[a, b], matrix[b, a] = -s, s
    return matrix


def turn_about(vector, angle):
    """Rotation matrix about a unit vector"""
    k = np.array([[0.0, -vector[2], vector[1]], [vector[2], 0.0, -vector[0]], [-vector[1], vector[0], 0.0]])
    return np.eye(3) + math.sin(angle) * k + (1.0 - math.cos(angle)) * k @ k


def along(places, values, s_of_points):
    """Cubic spline through slices, no corner at the second and the last but one; constant beyond the ends"""
    places, values = np.asarray(places, float), np.asarray(values, float)
    n = len(places)
    s_of_points = np.clip(s_of_points, places[0], places[-1])
    if not values.any():
        return np.zeros_like(s_of_points)
    if n < 4:
        return np.interp(s_of_points, places, values)
    # second derivatives m: continuous slopes inside, continuous third derivatives at the second and the last but one place
    h = np.diff(places)
    matrix, right = np.zeros((n, n)), np.zeros(n)
    for i in range(1, n - 1):
        matrix[i, i - 1:i + 2] = h[i - 1] / 6.0, (h[i - 1] + h[i]) / 3.0, h[i] / 6.0
        right[i] = (values[i + 1] - values[i]) / h[i] - (values[i] - values[i - 1]) / h[i - 1]
    matrix[0, :3] = -h[1], h[0] + h[1], -h[0]
    matrix[-1, -3:] = -h[-1], h[-2] + h[-1], -h[-2]
    m = np.linalg.solve(matrix, right)
    k = np.clip(np.searchsorted(places, s_of_points, side="right") - 1, 0, n - 2)
    t, u = s_of_points - places[k], places[k + 1] - s_of_points
    return ((m[k] * u**3 + m[k + 1] * t**3) / (6.0 * h[k]) + (values[k] / h[k] - m[k] * h[k] / 6.0) * u
            + (values[k + 1] / h[k] - m[k + 1] * h[k] / 6.0) * t)


class Curve:
    """A finely sampled profile: coordinates y, z over the arc length, plus the deviation of the slices along the rail"""

    def __init__(self, recipe, step):
        self.y_of, self.z_of = profiles.prepared(recipe)
        self.length = self.y_of.s[-1]
        s = np.linspace(0.0, self.length, int(self.length / step) + 2)
        self.s, self.y, self.z = s, self.y_of(s), self.z_of(s)
        self.slices = recipe.get("slices")

    def between(self, first, last, count):
        s = np.linspace(max(first, 0.0), min(last, self.length), count)
        return s, self.y_of(s), self.z_of(s)

    def added(self, place):
        """Displacements dy, dz of the slices at these positions"""
        if not self.slices:
            return np.zeros_like(place), np.zeros_like(place)
        table = np.array(self.slices)
        return along(table[:, 0], table[:, 1], place), along(table[:, 0], table[:, 2], place)


def gauge_point(curve, cant, height):
    """Innermost y of a canted rail within this height below its top, and the height of the top"""
    c, s = math.cos(cant), math.sin(cant)

    def canted(places):
        y, z = curve.y_of(places), curve.z_of(places)
        return y * c + z * s, z * c - y * s

    def around(index):
        """Positions on both sides of a point of the sampled curve"""
        return np.linspace(curve.s[max(index - 1, 0)], curve.s[min(index + 1, len(curve.s) - 1)], 2001)

    y, z = canted(curve.s)
    last = int(np.argmin(z))
    top = canted(around(last))[1].min()
    inside = z[:last + 1] - top <= height
    first = int(np.argmax(inside))
    index = int(np.argmin(np.where(inside, y[:last + 1], np.inf)))
    near_y, near_z = canted(np.concatenate([around(index), around(first)]))
    return near_y[near_z - top <= height].min(), top


def curves_of(pair):
    """Rail and wheel of a pair, sampled; the rail is taken to be straight between its points"""
    # small bodies are as round as large ones: straight lines between points miss them by the square of the distance over the radius
    size = min(1.0, pair["wheelset"][2] / profiles.RADIUS)
    return Curve(pair["rail"], size * SAMPLE), Curve(pair["wheel"], size * 0.05)


class Placed:
    """Rail and wheel of a case, placed in the track

    scene      of module1
    case       one of its cases
    z          height of the wheelset
    sink       dy, dz of a rail on springs
    """

    def __init__(self, scene, case, z, sink=(0.0, 0.0), curves=None):
        pair = scene["pair"]
        self.rail, self.wheel = curves or curves_of(pair)
        self.roller = scene.get("roller") or 0.0
        height, first, second, cant = pair["track"]
        if self.roller:
            cant = 0.0
        dy, dz, roll = case.get("deviation", [0.0] * 6)[:3]
        if height > 0.0:
            innermost, top = gauge_point(self.rail, cant, height)
            y_rail, z_rail = second / 2.0 - innermost, 0.0 if self.roller else -top
        else:
            y_rail, z_rail = first, second
        self.rail_origin = np.array([0.0, y_rail + dy + sink[0], z_rail + dz + sink[1]])
        self.rail_axes = turn(0, -cant + roll)
        self.place = 0.0 if self.roller else case["s"]
        self.radius = pair["wheelset"][2]
        ahead = case["s"] if self.roller else 0.0
        self.set_origin = np.array([ahead, case["y"], z - self.radius])
        self.set_axes = turn(0, case["roll"]) @ turn(2, case["yaw"])
        flex = case.get("flexible") or [0.0] * 12
        self.in_set = np.array([flex[0], pair["wheelset"][0] / 2.0 - pair["wheelset"][1] + flex[1], self.radius + flex[2]])
        self.wheel_axes = self.set_axes @ turn(0, flex[3]) @ turn(2, flex[4])
        self.wheel_origin = self.set_origin + self.set_axes @ self.in_set
        self.pitch = case["pitch"]
        top = self.rail_axes @ np.vstack([np.zeros_like(self.rail.y), self.rail.y, self.rail.z])
        self.rail_y, self.rail_z = top[1], top[2]
        self._upper()

    def _upper(self):
        """The part of the rail that is visible from above, as a function of y"""
        order = np.argsort(self.rail_y)
        y, z = self.rail_y[order], self.rail_z[order]
        steps = np.diff(self.rail_y)
        if not (steps > 0.0).all():
            # at each y the topmost of all pieces
            grid = np.arange(y[0], y[-1], SAMPLE * min(1.0, self.radius / profiles.RADIUS))
            top = np.full(len(grid), np.inf)
            ends = np.flatnonzero(np.diff(np.sign(steps))) + 1
            for a, b in zip(np.concatenate([[0], ends]), np.concatenate([ends, [len(self.rail_y) - 1]])):
                part = slice(a, b + 1)
                ys, zs = self.rail_y[part], self.rail_z[part]
                if ys[0] > ys[-1]:
                    ys, zs = ys[::-1], zs[::-1]
                if len(ys) > 1:
                    there = (grid >= ys[0]) & (grid <= ys[-1])
                    top[there] = np.minimum(top[there], np.interp(grid[there], ys, zs))
            y, z = grid[np.isfinite(top)], top[np.isfinite(top)]
        self.seen_y, self.seen_z = y, z

    def rail_height(self, x, y):
        """z of the rail seen from above at these positions in the track; infinite outside of it"""
        u = self.place + x
        dy, dz = self.rail.added(u)
        shift = self.rail_axes @ np.vstack([np.zeros(np.size(dy)), dy.ravel(), dz.ravel()])
        y_in = y - self.rail_origin[1] - shift[1].reshape(np.shape(y))
        z = np.interp(y_in, self.seen_y, self.seen_z, left=np.inf, right=np.inf)
        z = z + shift[2].reshape(np.shape(y)) + self.rail_origin[2]
        if self.roller:
            rho = self.roller - z
            with np.errstate(invalid="ignore"):
                z = np.where(np.isfinite(z) & (np.abs(x) < rho), self.roller - np.sqrt(np.maximum(rho**2 - x**2, 0.0)), np.inf)
        return z

    def wheel_points(self, s, angles):
        """Points (3, angles, s) of the wheel in the track; angles from the lowest point of the wheel"""
        y, z = self.wheel.y_of(s), self.wheel.z_of(s)
        dy, dz = self.wheel.added(_wrapped(angles - self.pitch))
        radius = self.radius + z[None, :] + dz[:, None]
        local = np.stack([radius * np.sin(angles)[:, None], y[None, :] + dy[:, None],
                          radius * np.cos(angles)[:, None] - self.radius])
        return self.wheel_origin[:, None, None] + np.tensordot(self.wheel_axes, local, 1)

    def gaps(self, s, angles):
        """Points of the wheel and their vertical gaps, arrays (angles, s)"""
        points = self.wheel_points(s, angles)
        return points, self.rail_height(points[0], points[1]) - points[2]

    def smallest(self):
        """The smallest vertical gap: its size, s on the wheel, angle; None where the bodies do not meet"""
        s, angles = self.wheel.s[::6], np.linspace(-0.3, 0.3, 121)
        _, gap = self.gaps(s, angles)
        gap = np.where(np.isfinite(gap), gap, np.inf)
        low = np.concatenate([[np.inf], gap.min(axis=0), [np.inf]])
        places = np.flatnonzero((low[1:-1] <= low[:-2]) & (low[1:-1] <= low[2:]) & np.isfinite(low[1:-1]))
        if not len(places):
            return None
        places = places[np.argsort(low[1:-1][places])][:4]
        return min((self._around(s[m], angles[np.argmin(gap[:, m])], s[1] - s[0], angles[1] - angles[0]) for m in places),
                   key=lambda found: found[0])

    def _around(self, place, angle, ds, da):
        """The smallest gap near a position, by successively smaller windows

        The valley of gaps below a steep flank runs obliquely: a window shrinks by less than it has points, and not
        where the smallest gap is at its edge.
        """
        best = np.inf, place, angle
        for _ in range(24):
            s = np.linspace(max(best[1] - 2 * ds, 0.0), min(best[1] + 2 * ds, self.wheel.length), 41)
            angles = np.linspace(best[2] - 2 * da, best[2] + 2 * da, 41)
            _, gap = self.gaps(s, angles)
            gap = np.where(np.isfinite(gap), gap, np.inf)
            k, m = np.unravel_index(np.argmin(gap), gap.shape)
            best = gap[k, m], s[m], angles[k]
            if 0 < k < len(angles) - 1 and (0 < m < len(s) - 1 or best[1] in (0.0, self.wheel.length)):
                ds, da = 0.35 * ds, 0.35 * da
            if ds < 1e-7 * self.wheel.length:
                break
        return best

    def regions(self, depth, by_rows=True):
        """Regions with a gap below zero: mean position and angle with the weights of the contact reference, bounds

        depth     -smallest gap, which determines the sampling
        by_rows   weights by the smallest gap of each row, the overlap of a round wheel; else the square of all gaps
        """
        s = self.wheel.s[::2]
        kappa = 1.0 / (2.0 * self.radius) + (1.0 / (2.0 * self.roller) if self.roller else 0.0)
        half = math.sqrt(max(depth, 1e-9) / kappa)
        angles = np.linspace(-0.3, 0.3, 241)
        _points, gap = self.gaps(s, angles)
        # between these points the gap may be smaller, due to the curvatures over half a step
        below = np.isfinite(gap) & (gap < 0.25 * depth + 1.5 * kappa * (0.5 * (angles[1] - angles[0]) * self.radius)**2 + 2e-4)
        if not below.any():
            return []
        found = np.flatnonzero(below.any(axis=0))
        around = np.flatnonzero(below.any(axis=1))
        step = angles[1] - angles[0]
        angles = np.linspace(angles[around[0]] - step, angles[around[-1]] + step,
                             int(min(801, max(101, 30 * (around[-1] - around[0] + 2) * step * self.radius / half))))
        parts = np.split(found, np.flatnonzero(np.diff(found) > 6) + 1)
        result = []
        for part in parts:
            a, b = s[max(part[0] - 1, 0)], s[min(part[-1] + 1, len(s) - 1)]
            result += self._rows(a, b, angles, kappa, by_rows)
        return sorted(result, key=lambda region: region["y"])

    def _rows(self, first, last, angles, kappa, by_rows):
        s = np.linspace(first, last, 501)
        points, _gap = self.gaps(s, angles)
        y_rows = np.linspace(points[1].min(), points[1].max(), 601)
        width = y_rows[1] - y_rows[0]
        rows, places = np.full((len(angles), len(y_rows)), np.inf), np.zeros((len(angles), len(y_rows)))
        for k in range(len(angles)):
            y, z, x = points[1, k], points[2, k], points[0, k]
            order = np.argsort(y)
            rows[k] = np.interp(y_rows, y[order], z[order], left=-np.inf, right=-np.inf)
            places[k] = np.interp(y_rows, y[order], x[order])
        rows = np.where(np.isfinite(rows), self.rail_height(places, np.broadcast_to(y_rows, rows.shape)) - rows, np.inf)
        best = np.argmin(rows, axis=0)
        inner = np.clip(best, 1, len(angles) - 2)
        j = np.arange(len(y_rows))
        left, middle, right = rows[inner - 1, j], rows[inner, j], rows[inner + 1, j]
        with np.errstate(invalid="ignore", divide="ignore"):
            curve = left - 2 * middle + right
            t = np.where((curve > 0) & np.isfinite(curve), 0.5 * (left - right) / curve, 0.0)
            low = middle - 0.125 * np.where(curve > 0, (left - right)**2 / curve, 0.0)
        t = np.clip(np.nan_to_num(t), -1.0, 1.0)
        low = np.where(np.isfinite(low), low, rows[best, j])
        x_low = places[inner, j] + np.where(t >= 0, t * (places[inner + 1, j] - places[inner, j]),
                                           -t * (places[inner - 1, j] - places[inner, j]))
        step = max(width, 2.0 * SAMPLE)  # across the rail where it is, not along the line of smallest gaps
        with np.errstate(invalid="ignore"):
            angle = np.arctan((self.rail_height(x_low, y_rows + step) - self.rail_height(x_low, y_rows - step)) / (2.0 * step))
        depth = np.where(np.isfinite(low), np.maximum(-low, 0.0), 0.0)
        result = []
        inside = np.flatnonzero(depth > 0.0)
        for part in np.split(inside, np.flatnonzero(np.diff(inside) > 1) + 1) if len(inside) else []:
            if by_rows:
                weight, x_mean = depth[part]**2.5, x_low[part]
            else:
                over = np.maximum(-rows[:, part], 0.0)**2
                step = np.gradient(places[:, part], axis=0)
                weight = (over * step).sum(axis=0)
                x_mean = (over * step * places[:, part]).sum(axis=0) / np.maximum(weight, 1e-300)
            total = weight.sum()
            if total <= 0.0:
                continue
            reach = np.sqrt(depth[part] / kappa)
            result.append({"x": (weight * x_mean).sum() / total, "y": (weight * y_rows[part]).sum() / total,
                           "angle": (weight * angle[part]).sum() / total, "depth": depth[part].max(),
                           "weight": total * width, "low": y_rows[part[np.argmax(depth[part])]],
                           "x_low": x_low[part[np.argmax(depth[part])]],
                           "bounds": (y_rows[part[0]], y_rows[part[-1]]), "bend": np.ptp(angle[part]),
                           "lean": np.ptp(x_low[part]),
                           "x_bounds": ((x_low[part] - reach).min(), (x_low[part] + reach).max()),
                           "edge": bool(part[0] <= 1 or part[-1] >= len(y_rows) - 2)})
        return result

    # ---- Distance along a normal -------------------------------------------------------------------------

    def distances(self, where, angle, x, s):
        """Distance of the bodies along the normal of a plane at the positions x, s in it, array (s, x); infinite without a surface

        where      origin of the plane in the track, on the rail
        angle      its roll
        x, s       evenly spaced coordinates in the plane

        The surfaces are followed from the origin of the plane to both sides, as long as they run one way along s.
        """
        axes = turn(0, angle)
        where = np.asarray(where, float)
        inside = self.wheel_axes.T @ (where - self.wheel_origin)
        near = int(np.argmin(np.hypot(self.wheel.y - inside[1],
                                      self.wheel.z - (math.hypot(inside[0], inside[2] + self.radius) - self.radius))))
        reach = np.ptp(s) + 2.0 * (s[1] - s[0]) + 1.0
        part, _, _ = self.wheel.between(self.wheel.s[near] - reach, self.wheel.s[near] + reach, 1201)
        middle = math.atan2(inside[0], inside[2] + self.radius)
        span = (np.ptp(x) + 2.0 * (x[1] - x[0]) + 0.05 * reach) / self.radius
        points = self.wheel_points(part, np.linspace(middle - span, middle + span, 401))
        local = np.tensordot(axes.T, points - where[:, None, None], 1)
        wheel = np.full((len(s), len(x)), -np.inf)
        at_s = np.full((2, local.shape[1], len(s)), np.nan)  # x and n of each circle where it has s
        start = int(np.argmin(np.abs(part - self.wheel.s[near])))
        for k in range(local.shape[1]):
            one = _run(local[1, k], start)
            line = slice(one[0], one[1])
            y_line = local[1, k, line]
            order = slice(None, None, 1 if y_line[-1] > y_line[0] else -1)
            for row, values in enumerate((local[0, k, line], local[2, k, line])):
                at_s[row, k] = np.interp(s, y_line[order], values[order], left=np.nan, right=np.nan)
        for j in range(len(s)):
            good = np.isfinite(at_s[0, :, j])
            if good.sum() > 2:
                order = np.argsort(at_s[0, good, j])
                wheel[j] = np.interp(x, at_s[0, good, j][order], at_s[1, good, j][order], left=-np.inf, right=-np.inf)
        rail_y, rail_z = self.rail_y + self.rail_origin[1] - where[1], self.rail_z + self.rail_origin[2] - where[2]
        c, t = math.cos(angle), math.sin(angle)
        along_s, along_n = rail_y * c + rail_z * t, rail_z * c - rail_y * t
        one = _run(along_s, int(np.argmin(np.hypot(along_s, along_n))))
        rail = np.interp(s, along_s[one[0]:one[1]], along_n[one[0]:one[1]], left=np.inf, right=np.inf)
        return rail[:, None] - wheel

    # ---- Motion ------------------------------------------------------------------------------------------

    def velocities(self, case, at_rail, at_wheel, curvature=0.0):
        """Velocities of the material points of rail and wheel that are now at these positions, and their angular velocity

        The bodies are moved to where they are a little earlier and later. Along the track the wheelset moves past the
        rail; a roller turns about its axle. In a curve both yaw about the centre of the track.
        """
        speed = case["speed"]  # VS or RPITCH, VY, VZ, VROLL, VYAW, VPITCH
        flex = (case.get("flexible") or [0.0] * 12)[6:]
        deviation = case.get("deviation", [0.0] * 6)[3:]
        yaw_rate = -curvature * speed[0] * (self.roller or 1.0)
        rates = np.abs(np.array([1e-9, *speed[3:], flex[3], flex[4], flex[5], deviation[2], speed[0] if self.roller else 0.0,
                                 yaw_rate]))
        dt = 1e-4 / rates.max()
        inverse = self.wheel_axes.T @ (at_wheel - self.wheel_origin)
        result = []
        for t in (-dt, dt):
            # wheelset: it rotates about its own axes, VROLL, VPITCH, VYAW being the components in them
            rate = self.set_axes @ np.array([speed[3], speed[5], speed[4]])
            size = np.linalg.norm(rate)
            turned = turn_about(rate / size, size * t) if size > 0.0 else np.eye(3)
            set_axes = turned @ self.set_axes
            moved = self.set_origin + t * np.array([0.0 if self.roller else speed[0], speed[1], speed[2]])
            own = np.array([flex[3], flex[5], flex[4]])
            size = np.linalg.norm(own)
            bent = turn_about(own / size, size * t) if size > 0.0 else np.eye(3)
            wheel_axes = set_axes @ bent @ self.set_axes.T @ self.wheel_axes
            wheel = moved + set_axes @ (self.in_set + t * np.array(flex[:3])) + wheel_axes @ inverse
            if self.roller:
                axle = np.array([0.0, 0.0, self.roller])
                rail_turn = turn(1, speed[0] * t)
                rail = axle + rail_turn @ (at_rail - axle)
            else:
                rail, rail_turn = at_rail.copy(), np.eye(3)
            own_turn = turn(0, deviation[2] * t)
            origin = self.rail_origin
            rail = rail + (own_turn - np.eye(3)) @ (at_rail - origin) + t * np.array([0.0, deviation[0], deviation[1]])
            curve_turn = turn(2, yaw_rate * t)
            rail = rail + (curve_turn - np.eye(3)) @ at_rail
            result.append((rail, wheel, curve_turn @ own_turn @ rail_turn, wheel_axes @ self.wheel_axes.T))
        (ra, wa, rta, wta), (rb, wb, rtb, wtb) = result
        return (rb - ra) / (2 * dt), (wb - wa) / (2 * dt), _turning(rta, rtb, dt), _turning(wta, wtb, dt)


def _run(values, start):
    """First and last but one index of the monotonic interval of values around a position"""
    steps = np.diff(values)
    sign = np.sign(steps[min(start, len(steps) - 1)])
    turns = np.flatnonzero(np.sign(steps) != sign)
    before, after = turns[turns < start], turns[turns >= start]
    return (before[-1] + 1 if len(before) else 0), (after[0] + 1 if len(after) else len(values))


def _turning(before, after, dt):
    """Angular velocity from two rotated axes"""
    skew = (after @ before.T - before @ after.T) / (4.0 * dt)
    return np.array([skew[2, 1], skew[0, 2], skew[1, 0]])


def _wrapped(angle):
    """Angle reduced to the interval around 0"""
    return (angle + math.pi) % (2.0 * math.pi) - math.pi
