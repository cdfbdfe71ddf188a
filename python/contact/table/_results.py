"""What tables are made of: creep forces of contacts by the full theory, in scaled creepages."""
from __future__ import annotations

from concurrent.futures import Future, ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from ..errors import ContactError
from ..study._batch import Batch
from ..study._scene import Scene

Numbers = NDArray[np.float64]

#: Size of the contact, force and material that results are computed for. Forces depend on ratios only; creepages stay small
_SIZE, _FORCE, _MU, _RIGIDITY = 5.0, 10.0, 0.3, 82000.0
#: Cases of a task
_PORTION = 1000
#: Size of the grid relative to the contact
_WINDOW = 1.05
#: r + s and u3 that stand for infinite ones: 1 - sqrt(x**4 + y**4)**(1/2) and 1 - z are not less
_NEAREST = 1e-4
#: KX, KY, KP by powers of a/b, as in src/tables/creep_table.f90
_SCALES = ([1.0964, 0.325, -0.004], [0.8005, 0.4393, -0.0067], [0.4147, 1.0184, 0.0565, -0.0013])


def scales(ratio: Numbers) -> Numbers:
    """KX, KY, KP for a/b, shape (n, 3)."""
    return np.column_stack([np.polynomial.polynomial.polyval(ratio, factors) for factors in _SCALES])


def creepages(points: Numbers) -> Numbers:
    """Creepages of points (log(a/b), offset, x, y, z), in units of mu Fn / (G a b), spin times sqrt(a b).

    The sides at infinity are replaced by what is near them.
    """
    ratio = np.exp(points[:, 0])
    radius = np.sqrt(np.hypot(points[:, 2]**2, points[:, 3]**2))
    z = np.minimum(points[:, 4], 1.0 - _NEAREST)
    spin = z / (1.0 - z)
    kept = np.minimum(radius, 1.0 - _NEAREST)
    planar = points[:, 2:4] * np.where(radius > 0.0, kept / np.maximum(radius, _NEAREST**2), 0.0)[:, None]
    planar = planar / (1.0 - kept)[:, None] * np.sqrt(1.0 + spin**2)[:, None]
    return np.column_stack([planar, spin]) / scales(ratio)


class Results:
    """Computes forces at points.

    Parameters
    ----------
    poisson
        Poisson ratio of both bodies [-].
    elements
        Elements a side of ellipses; half ellipses have those of the solution and half as many, and the difference is added.
    has_offset
        Two half ellipses with elliptical pressures, and not ellipses, whose pressures are solved for?
    workers
        Threads.
    """

    def __init__(self, poisson: float, elements: int, has_offset: bool, workers: int) -> None:
        self.poisson, self.elements, self.has_offset, self.workers = poisson, elements, has_offset, workers
        self.cases = 0

    def at(self, points: Numbers, elements: int | None = None) -> Numbers:
        """Fx, Fy relative to mu Fn and Mz to mu Fn sqrt(a b) at points (log(a/b), offset, x, y, z), shape (n, 3).

        Points beyond x**4 + y**4 = 1 have values that continue those within it: there sliding is of one direction, forces are even
        functions of the distance to it, and the moment an odd one.
        """
        radius = np.sqrt(np.hypot(points[:, 2]**2, points[:, 3]**2))
        beyond = radius > 1.0
        mirrored = points.copy()
        mirrored[beyond, 2:4] *= ((2.0 - radius[beyond]) / radius[beyond])[:, None]
        values = self._solve(mirrored, elements or self.elements)
        values[beyond, 2] *= -1.0
        return values

    def _solve(self, points: Numbers, elements: int) -> Numbers:
        """Solve, one shape after the other"""
        order = np.lexsort((points[:, 3], points[:, 2], points[:, 4], points[:, 1], points[:, 0]))
        ratio, offset = np.exp(points[:, 0]), points[:, 1]
        given = creepages(points) * (_MU * _FORCE / (_RIGIDITY * _SIZE**2)) * [1.0, 1.0, 1.0 / _SIZE]
        bb = _SIZE / np.sqrt(ratio)
        sizes = [_SIZE * np.sqrt(ratio), bb * (1.0 - offset), bb * (1.0 + offset)] if self.has_offset else \
            [_SIZE * np.sqrt(ratio), bb]
        given = np.column_stack([given, *sizes])[order]
        self.cases += len(given)
        solved = np.empty((len(points), 3))
        solved[order] = self._all(given, elements)
        if self.has_offset:
            # the error of the first order falls with the size of elements
            coarse = np.empty((len(points), 3))
            coarse[order] = self._all(given, elements // 2 + 1)
            share = elements / (elements - elements // 2 - 1)
            solved = coarse + share * (solved - coarse)
        return solved

    def _all(self, given: Numbers, elements: int) -> Numbers:
        """All cases, in threads"""
        keys = ["aa", "bneg", "bpos"] if self.has_offset else ["aa", "bb"]
        case = {"module": "contact", "motion": "steady_rolling", "normal": "force",
                "kinematics": {"fn": _FORCE, "cksi": 0.0, "ceta": 0.0, "cphi": 0.0}, "friction": {"fstat": _MU, "fkin": _MU},
                "material": {"poiss": [self.poisson] * 2, "gg": [_RIGIDITY] * 2}, "rolling": {"veloc": 1000.0, "dq": 1.0},
                "grid": {"form": "half_ellipses" if self.has_offset else "hertz_axes", "mx": elements, "my": elements,
                         **dict.fromkeys(keys, _SIZE), "scale": _WINDOW}}
        if self.has_offset:
            case["pressure"] = "sdec"
        else:
            case["iteration"] = {"order": 2}
        names = {f"kinematics.{key}": 0.0 for key in ("cksi", "ceta", "cphi")} | {f"grid.{key}": _SIZE for key in keys}
        text, paths = Scene(case).varied_text({}, names)
        parts = [given[first:first + _PORTION] for first in range(0, len(given), _PORTION)]
        with ThreadPoolExecutor(self.workers) as pool:
            waiting: list[Future[Numbers]] = [pool.submit(_portion, text, paths, part) for part in parts]
            return np.concatenate([one.result() for one in waiting]) if parts else np.zeros((0, 3))


def _portion(text: str, names: list[str], given: Numbers) -> Numbers:
    """Some cases, one after the other"""
    with Batch() as batch:
        solved = batch.solve(text, "", names, given)
    failed = np.flatnonzero(solved.states[:, 0] != 0)
    if len(failed):
        raise ContactError(f"a contact of the table was not solved: {solved.reasons[failed[0]]} "
                           f"({', '.join(names)} = {', '.join(f'{value:.6g}' for value in given[failed[0]])})")
    place = {column.name: number for number, column in enumerate(solved.columns)}
    forces = solved.values[:, [place["fx"], place["fy"], place["mz"]]]
    return np.asarray(forces / (_MU * _FORCE) / [1.0, 1.0, _SIZE])
