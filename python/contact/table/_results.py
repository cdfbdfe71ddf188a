"""Results for tables: creep forces of contacts by the full theory, in scaled creepages."""
from __future__ import annotations

from concurrent.futures import Future, ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from ..errors import ContactError
from ..study._batch import Batch
from ..study._scene import Scene

Numbers = NDArray[np.float64]

#: Size of the contact, force and material of the computed cases. Scaled forces do not depend on them; chosen for small creepages
_SIZE, _FORCE, _MU, _RIGIDITY = 5.0, 10.0, 0.3, 82000.0
#: Number of cases of a task
_PORTION = 1000
#: Size of the grid relative to the contact
_WINDOW = 1.05
#: Minimum distances from infinite creepage and spin, 1 - (x**4 + y**4)**(1/4) and 1 - z
_NEAREST = 1e-4
#: Above this z the number of elements along each side is increased by this factor; chosen by comparison with finer grids
_MUCH_SPIN, _MORE = 0.85, 1.5
#: Where most of the contact slides, fewer elements suffice: above this (x**4 + y**4)**(1/4) the number along each side decreases
#: to this fraction in full sliding, but not below this minimum; chosen by comparison with finer grids
_MUCH_SLIP, _FEWER, _FEW = 0.4, 0.35, 9
#: KX, KY, KP by powers of a/b, as in src/tables/creep_table.f90
_SCALES = ([1.0964, 0.325, -0.004], [0.8005, 0.4393, -0.0067], [0.4147, 1.0184, 0.0565, -0.0013])


def scales(ratio: Numbers) -> Numbers:
    """KX, KY, KP for a/b, shape (n, 3)."""
    return np.column_stack([np.polynomial.polynomial.polyval(ratio, factors) for factors in _SCALES])


def arms(points: Numbers) -> Numbers:
    """Distance along y from the middle of both extents to that of the pressures, relative to sqrt(a b)."""
    return np.asarray(-0.25 * points[:, 1] * np.exp(-0.5 * points[:, 0]))


def creepages(points: Numbers, nearest: float = _NEAREST) -> Numbers:
    """Creepages of points (log(a/b), offset, x, y, z), in units of mu Fn / (G a b), spin times sqrt(a b).

    Points refer to the middle of the pressures, creepages to that of both extents. Infinite creepage and spin are replaced by large
    finite values.
    """
    ratio = np.exp(points[:, 0])
    scale = scales(ratio)
    turn = scale[:, :2] / scale[:, 2:] * np.column_stack([1.0 / np.sqrt(ratio), np.sqrt(ratio)])
    z = np.minimum(points[:, 4], 1.0 - nearest)
    spin = z / (1.0 - z)
    radius = np.sqrt(np.hypot(points[:, 2]**2, points[:, 3]**2))
    kept = np.minimum(radius, 1.0 - nearest)
    planar = points[:, 2:4] * np.where(radius > 0.0, kept / np.maximum(radius, nearest**2) / (1.0 - kept), 0.0)[:, None]
    planar = planar * np.sqrt(1.0 + (turn * spin[:, None])**2)
    found = np.column_stack([planar, spin]) / scale
    found[:, 0] += arms(points) * found[:, 2]
    return found


def sides(points: Numbers, elements: int) -> NDArray[np.int_]:
    """Elements along and across for points, shape (n, 2).

    There are more along the longer side of a contact, more with large spin, where the direction of slip changes within a few
    elements, and fewer where most of the contact slides.
    """
    wide = np.exp(0.5 * np.abs(points[:, 0]))
    radius = np.sqrt(np.hypot(points[:, 2]**2, points[:, 3]**2))
    part = np.interp(radius, [_MUCH_SLIP, 1.0], [1.0, _FEWER])
    more = np.maximum(elements * part, min(elements, _FEW)) * np.where(points[:, 4] > _MUCH_SPIN, _MORE, 1.0)
    both = np.column_stack([np.where(points[:, 0] > 0.0, wide, 1.0), np.where(points[:, 0] < 0.0, wide, 1.0)]) * more[:, None]
    return np.asarray(np.rint(both), dtype=np.int_)


class Results:
    """Computes forces at points.

    Parameters
    ----------
    poisson
        Poisson ratio of both bodies [-].
    elements
        Elements along each side of a round contact with little spin, see :func:`sides`.
    has_offset
        Whether contacts are two half ellipses with elliptical pressures, instead of ellipses with computed pressures.
    workers
        Number of threads.
    """

    def __init__(self, poisson: float, elements: int, has_offset: bool, workers: int) -> None:
        self.poisson, self.elements, self.has_offset, self.workers = poisson, elements, has_offset, workers
        self.cases = 0

    def at(self, points: Numbers, elements: int | None = None) -> Numbers:
        """Fx, Fy relative to mu Fn and Mz to mu Fn sqrt(a b) at points (log(a/b), offset, x, y, z), shape (n, 3).

        The moment is about the middle of the pressures.

        Values beyond x**4 + y**4 = 1 continue those within it: near it sliding has a single direction, so that forces are even
        functions of the distance to it, and the moment is an odd one.
        """
        radius = np.sqrt(np.hypot(points[:, 2]**2, points[:, 3]**2))
        beyond = radius > 1.0
        mirrored = points.copy()
        mirrored[beyond, 2:4] *= ((2.0 - radius[beyond]) / radius[beyond])[:, None]
        values = self._solve(mirrored, elements or self.elements)
        values[beyond, 2] *= -1.0
        return values

    def _solve(self, points: Numbers, elements: int) -> Numbers:
        """Solve the points, one shape after the other"""
        order = np.lexsort((points[:, 3], points[:, 2], points[:, 4], points[:, 1], points[:, 0]))
        ratio, offset = np.exp(points[:, 0]), points[:, 1]
        given = creepages(points) * (_MU * _FORCE / (_RIGIDITY * _SIZE**2)) * [1.0, 1.0, 1.0 / _SIZE]
        bb = _SIZE / np.sqrt(ratio)
        sizes = [_SIZE * np.sqrt(ratio), bb * (1.0 - offset), bb * (1.0 + offset)] if self.has_offset else \
            [_SIZE * np.sqrt(ratio), bb]
        given = np.column_stack([given, *sizes])
        self.cases += len(given)
        solved = np.empty((len(points), 3))
        grids, which = np.unique(sides(points, elements)[order], axis=0, return_inverse=True)
        parts = [order[which.ravel() == k] for k in range(len(grids))]
        tasks = [(grid, part[first:first + _PORTION]) for grid, part in zip(grids, parts)
                 for first in range(0, len(part), _PORTION)]
        # the longest tasks first, so that all threads are busy until the end
        tasks.sort(key=lambda one: -float(np.prod(one[0])) * len(one[1]))
        with ThreadPoolExecutor(self.workers) as pool:
            waiting: list[Future[Numbers]] = [pool.submit(_portion, *self._text(grid), given[part]) for grid, part in tasks]
            for (_, part), one in zip(tasks, waiting):
                solved[part] = one.result()
        solved[:, 2] += arms(points) * solved[:, 0]
        return solved

    def _text(self, grid: NDArray[np.int_]) -> tuple[str, list[str]]:
        """The base case, and the inputs that vary"""
        keys = ["aa", "bneg", "bpos"] if self.has_offset else ["aa", "bb"]
        case = {"module": "contact", "motion": "steady_rolling", "normal": "force",
                "kinematics": {"fn": _FORCE, "cksi": 0.0, "ceta": 0.0, "cphi": 0.0}, "friction": {"fstat": _MU, "fkin": _MU},
                "material": {"poiss": [self.poisson] * 2, "gg": [_RIGIDITY] * 2}, "rolling": {"veloc": 1000.0, "dq": 1.0},
                "grid": {"form": "half_ellipses" if self.has_offset else "hertz_axes", "mx": int(grid[0]), "my": int(grid[1]),
                         **dict.fromkeys(keys, _SIZE), "scale": _WINDOW}, "iteration": {"order": 2}}
        if self.has_offset:
            case["pressure"] = "sdec"
        names = {f"kinematics.{key}": 0.0 for key in ("cksi", "ceta", "cphi")} | {f"grid.{key}": _SIZE for key in keys}
        return Scene(case).varied_text({}, names)


def _portion(text: str, names: list[str], given: Numbers) -> Numbers:
    """Solve some cases, one after the other"""
    with Batch() as batch:
        solved = batch.solve(text, "", names, given)
    failed = np.flatnonzero(solved.states[:, 0] != 0)
    if len(failed):
        raise ContactError(f"a contact of the table was not solved: {solved.reasons[failed[0]]} "
                           f"({', '.join(names)} = {', '.join(f'{value:.6g}' for value in given[failed[0]])})")
    place = {column.name: number for number, column in enumerate(solved.columns)}
    forces = solved.values[:, [place["fx"], place["fy"], place["mz"]]]
    return np.asarray(forces / (_MU * _FORCE) / [1.0, 1.0, _SIZE])
