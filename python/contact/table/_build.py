"""Construction of a table of creep forces: nodes are added where the interpolation error exceeds the tolerance."""
from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any, Callable

import numpy as np
from numpy.typing import NDArray

from ..errors import ContactError
from ._file import bend, interpolated, write
from ._look_up import Facts, Numbers, Table
from ._results import Results, arms, creepages

# The numbers below are chosen unless stated otherwise. They affect the number of solutions that a table takes, not its accuracy,
# which is checked at independent points.

#: Names of the axes of a table and of its points, in their order
AXES = ("shape", "offset", "x", "y", "z")
#: Number of training points at first, and added each time the table passes; number of the worst ones that are refined
_LEARN, _WORST = 1500, 150
#: Number of these points through which lines are examined, and number of nodes of a line
_LINES, _ALONG = 50, 6
#: Fraction of the tolerance required at training points, because the errors at other points are larger
_AIM = 0.85
#: An interval is divided if its own error exceeds this fraction of the tolerance
_SHARE = 0.5
#: Every third new node along each axis is solved, and the nodes near those whose error exceeded this fraction of the tolerance
_STRIDE, _SPREAD = 3, 0.25
#: New nodes are solved where third differences of existing nodes exceed this fraction of the tolerance
_BEND = 0.8
#: Largest ratio of the lengths of neighbouring intervals, with a margin for round-off
_GRADE = 2.01
#: Number of points at which results are compared with those of three times as many elements along each side
_COMPARED = 150
#: Elements along each side for a tolerance of 1 %, which narrow contacts determine, and of 0.1 %
_ELEMENTS, _FINER = 21, 37
#: Initial nodes along z, closer where strips lose adhesion
_FIRST_Z = (0.0, 0.15, 0.3, 0.4, 0.5, 0.6, 0.7, 0.85, 1.0)


@dataclass(frozen=True)
class Plan:
    """Requirements on a table.

    Attributes
    ----------
    tolerance
        Largest error of forces relative to mu Fn, and of the moment relative to mu Fn sqrt(a b) [-].
    ratio
        Smallest and largest a/b [-], within 0.05 and 20.
    offset
        Of two half ellipses: the largest ``abs(bpos - bneg) / (bpos + bneg)`` [-]; 0 for ellipses.
    poisson
        Poisson ratio of both bodies [-].
    spin
        Largest spin, as ``G a b c KP abs(phi) / (mu Fn)`` with ``c = sqrt(a b)`` and KP of about Kalker's C23 [-]; infinite: all.
    elements
        Elements along each side of round contacts with little spin; there are more along the longer side, and with large
        spin. 0: by the tolerance.
    points
        Number of random points of the final check.
    most_cases
        Number of solutions at which to give up.
    seed
        Seed of the random numbers.
    """

    tolerance: float = 0.01
    ratio: tuple[float, float] = (0.2, 5.0)
    offset: float = 0.0
    poisson: float = 0.28
    spin: float = np.inf
    elements: int = 0
    points: int = 10000
    most_cases: int = 3_000_000
    seed: int = 1

    @property
    def max_z(self) -> float:
        """Largest z [-]."""
        return self.spin / (1.0 + self.spin) if np.isfinite(self.spin) else 1.0

    def check(self) -> None:
        """Check the values. Raises ContactError."""
        low, high = self.ratio
        for good, what in ((1e-4 <= self.tolerance <= 0.2, "the tolerance has to be between 0.0001 and 0.2"),
                           (0.05 <= low < high <= 20.0, "a/b has to go from 0.05 at least to 20 at most"),
                           (0.0 <= self.offset <= 0.9, "the offset has to be between 0 and 0.9"),
                           (0.0 <= self.poisson <= 0.5, "the Poisson ratio has to be between 0 and 0.5"),
                           (self.spin >= 0.01, "the spin has to be 0.01 at least"),
                           (self.elements == 0 or 7 <= self.elements <= 99, "there have to be 7 to 99 elements a side"),
                           (self.points >= 100, "there have to be 100 points of the check at least")):
            if not good:
                raise ContactError(what)


def build(file: str | os.PathLike[str], plan: Plan | None = None, *, workers: int | None = None,
          tell: Callable[[str], None] = lambda text: None) -> Facts:
    """Make a table.

    Parameters
    ----------
    file
        Path of the table; written only when the table passes the check.
    plan
        Requirements on the table.
    workers
        Number of threads; default: the number of processors of this machine.
    tell
        Function that receives messages on the progress.

    Returns
    -------
    Properties of the table.

    Raises
    ------
    ContactError
        If the plan is invalid, a contact was not solved, or the tolerance was not reached within the cases of the plan.
    """
    requirements = plan or Plan()
    requirements.check()
    return _Builder(requirements, workers or os.cpu_count() or 1, tell).build(Path(file))


def enough_elements(tolerance: float) -> int:
    """Elements along each side with a discretisation error within the tolerance; it is proportional to the square of their size."""
    return int(np.clip(round(max(_ELEMENTS * (0.01 / tolerance)**0.25, _FINER * (0.001 / tolerance)**0.5)), 9, 99))


class _Builder:
    """Nodes and the values at them"""

    def __init__(self, plan: Plan, workers: int, tell: Callable[[str], None]) -> None:
        self._plan, self._tell = plan, tell
        self._elements = plan.elements or enough_elements(plan.tolerance)
        self._results = Results(plan.poisson, self._elements, plan.offset > 0.0, workers)
        self._random = np.random.default_rng(plan.seed)
        count = max(4, round(1.0 + 1.5 * np.log(plan.ratio[1] / plan.ratio[0])))
        self._nodes: list[Numbers] = [
            np.linspace(np.log(plan.ratio[0]), np.log(plan.ratio[1]), count),
            np.linspace(-plan.offset, plan.offset, 5) if plan.offset > 0.0 else np.zeros(1),
            np.linspace(0.0, 1.0, 5), np.linspace(-1.0, 1.0, 9), np.linspace(0.0, plan.max_z, 5) if plan.max_z < _FIRST_Z[-2]
            else np.array([*_FIRST_Z[:-1], plan.max_z])]
        #: Values at all nodes, shape (shape, offset, x, y, z, 3), and which of them are computed results
        self._values = np.zeros((*(len(nodes) for nodes in self._nodes), 3))
        self._is_solved = np.zeros(self._values.shape[:-1], dtype=bool)
        self._solve(~self._is_solved)

    # ---- values at nodes

    def _at(self, points: Numbers) -> Numbers:
        """Results at points; raises ContactError beyond the allowed number of solutions"""
        if self._results.cases + len(points) > self._plan.most_cases:
            raise ContactError(f"the tolerance of {self._plan.tolerance:g} needs more than {self._plan.most_cases} solutions; "
                               "allow a larger error or more solutions, or narrow a/b and the offset")
        return self._results.at(points)

    def _insert(self, axis: int, new: Numbers) -> None:
        """Add nodes along an axis, with values of the current spline, or solved where its error is large"""
        whole = np.concatenate([self._nodes[axis], new])
        order = np.argsort(whole)
        added = interpolated(self._nodes[axis], self._values, axis, new)
        # nodes where forces may have a bend, and some everywhere; large errors there lead to further nodes
        chosen = _sizes(bend(self._nodes[axis], self._values, axis, new)) > _BEND * self._plan.tolerance
        chosen[tuple(slice(None) if k == axis else slice(None, None, _STRIDE) for k in range(len(AXES)))] = True
        before = np.zeros_like(self._is_solved)

        def merged(old: NDArray[Any], more: NDArray[Any]) -> NDArray[Any]:
            return np.take(np.concatenate([old, more], axis=axis), order, axis=axis)

        self._values = merged(self._values, added)
        self._is_solved = merged(self._is_solved, np.zeros_like(chosen))
        self._nodes[axis] = whole[order]
        self._solve(merged(before, chosen))

    def _solve(self, chosen: NDArray[np.bool_]) -> int:
        """Solve the chosen nodes, and others around those with large errors; returns their number"""
        begun = self._results.cases
        while True:
            chosen = chosen & ~self._is_solved
            if not chosen.any():
                return self._results.cases - begun
            places = np.nonzero(chosen)
            found = self._at(np.column_stack([nodes[place] for nodes, place in zip(self._nodes, places)]))
            gap = found - self._values[places]
            self._values[places] = found
            self._is_solved |= chosen
            was_wrong = _sizes(gap) > _SPREAD * self._plan.tolerance
            chosen = np.zeros_like(chosen)
            chosen[tuple(place[was_wrong] for place in places)] = True
            chosen = _widened(chosen)

    def _around(self, points: Numbers, wider: int) -> NDArray[np.bool_]:
        """Nodes at the corners of the cells with these points, and the given number of further ones along each axis"""
        chosen = np.zeros(self._is_solved.shape, dtype=bool)
        first = [np.searchsorted(nodes[1:-1], points[:, axis], side="right") for axis, nodes in enumerate(self._nodes)]
        for steps in product(*(range(-wider, 2 + wider) if len(nodes) > 1 else (0,) for nodes in self._nodes)):
            chosen[tuple(np.clip(place + step, 0, len(nodes) - 1) for place, step, nodes in zip(first, steps, self._nodes))] = True
        return chosen

    # ---- points

    def _points(self, count: int) -> Numbers:
        """Random points of the table: uniform in log(a/b), offset, x, y, z"""
        low = [np.log(self._plan.ratio[0]), -self._plan.offset, 0.0, -1.0, 0.0]
        high = [np.log(self._plan.ratio[1]), self._plan.offset, 1.0, 1.0, self._plan.max_z]
        found = np.zeros((0, len(AXES)))
        while len(found) < count:
            points = self._random.uniform(low, high, size=(count, len(AXES)))
            found = np.concatenate([found, points[np.hypot(points[:, 2]**2, points[:, 3]**2) < 1.0]])
        return found[:count]

    # ---- the search

    def build(self, path: Path) -> Facts:
        """Divide intervals until the table has the required accuracy, and write it"""
        plan = self._plan
        known = np.zeros((0, len(AXES)))
        true = np.zeros((0, 3))
        with tempfile.TemporaryDirectory() as folder:
            trial = Path(folder) / "table"
            while True:
                points = self._points(_LEARN)
                known, true = np.concatenate([known, points]), np.concatenate([true, self._at(points)])
                is_first = True
                while True:
                    self._write(trial, Facts(plan.offset > 0.0, self._elements, 2, plan.poisson, plan.ratio, plan.offset,
                                             plan.spin, plan.tolerance, (0.0, 0.0), 0, (0.0, 0.0), 0))
                    errors = self._errors(trial, known, true)
                    worst = float(errors.max())
                    where = ", ".join(f"{value:.3f}" for value in known[errors.argmax()])
                    self._tell(f"{self._results.cases} solutions, {' x '.join(str(len(nodes)) for nodes in self._nodes)} nodes, "
                               f"largest error {100 * worst:.3g} % at {', '.join(AXES)} = {where}")
                    if worst <= _AIM * plan.tolerance:
                        break
                    is_first = False
                    self._improve(known, true, errors)
                if not is_first:
                    continue
                points = self._points(plan.points)
                values = self._at(points)
                force, moment = self._parts(trial, points, values)
                self._tell(f"checked at {len(points)} new points: forces {100 * force:.3g} %, moment {100 * moment:.3g} %")
                if max(force, moment) <= plan.tolerance:
                    break
                known, true = np.concatenate([known, points]), np.concatenate([true, values])
            points = self._points(_COMPARED)
            fine, usual = self._results.at(points, 3 * self._elements), self._at(points)
            self._write(trial, Facts(plan.offset > 0.0, self._elements, 2, plan.poisson, plan.ratio,
                                     plan.offset, plan.spin, plan.tolerance, (force, moment), plan.points,
                                     _largest(fine - usual), 0))
            whole = trial.read_bytes()
        place = path.with_name(path.name + ".new")
        place.write_bytes(whole)
        os.replace(place, path)
        with Table(path) as table:
            return table.facts

    def _write(self, path: Path, facts: Facts) -> None:
        """A table of the current values"""
        write(path, self._nodes, self._values, facts)

    def _look_up(self, trial: Path, points: Numbers) -> Numbers:
        """Interpolated values, in the units of the results"""
        ratio = np.exp(points[:, 0])
        creepage = creepages(points, 1e-9)
        with Table(trial) as table:
            return table.force(1.0, 1.0, 1.0, np.sqrt(ratio), 1.0 / np.sqrt(ratio), creepage[:, 0], creepage[:, 1], creepage[:, 2],
                               points[:, 1], outside=True)

    def _errors(self, trial: Path, points: Numbers, true: Numbers) -> Numbers:
        """Error at each point: the larger one of the forces and of the moment"""
        return _sizes(self._gap(trial, points, true))

    def _parts(self, trial: Path, points: Numbers, true: Numbers) -> tuple[float, float]:
        """Largest errors of forces and of the moment"""
        return _largest(self._gap(trial, points, true))

    def _gap(self, trial: Path, points: Numbers, true: Numbers) -> Numbers:
        """Interpolated minus computed values; the moment is about the middle of both extents, as for callers"""
        gap = self._look_up(trial, points) - true
        gap[:, 2] += arms(points) * true[:, 0]
        return gap

    def _improve(self, known: Numbers, true: Numbers, errors: Numbers) -> None:
        """Solve nodes around the points with the largest errors; if all of them are computed, divide intervals"""
        worst = np.argsort(errors)[:-_WORST - 1:-1]
        worst = worst[errors[worst] > _AIM * self._plan.tolerance]
        if not any(self._solve(self._around(known[worst], wider)) for wider in (0, 1)):
            self._refine(known[worst[:_LINES]], true[worst[:_LINES]])

    def _refine(self, bad: Numbers, true: Numbers) -> None:
        """Divide the intervals with the largest errors of one-dimensional splines on lines through the worst points"""
        scores: list[Numbers] = []
        for axis, nodes in enumerate(self._nodes):
            score = np.zeros(max(1, len(nodes) - 1))
            if len(nodes) > 1:
                place = np.searchsorted(nodes[1:-1], bad[:, axis], side="right")
                count = min(_ALONG, len(nodes))
                near = np.clip(place - count // 2 + 1, 0, len(nodes) - count)[:, None] + np.arange(count)
                lines = np.repeat(bad, count, axis=0)
                lines[:, axis] = nodes[near].ravel()
                found = self._at(lines).reshape(len(bad), count, 3)
                gap = np.array([interpolated(nodes[at], values, 0, point[axis:axis + 1])[0]
                                for at, values, point in zip(near, found, bad)]) - true
                np.maximum.at(score, place, _sizes(gap))
            scores.append(score)
        # only those with errors near the largest one: others may become smaller in the next iteration
        largest = max(float(score.max()) for score in scores)
        limit = max(min(_SHARE * self._plan.tolerance, largest), 0.25 * largest)
        for axis, (nodes, score) in enumerate(zip(list(self._nodes), scores)):
            chosen = np.flatnonzero(score >= limit)
            if len(nodes) > 1 and len(chosen):
                self._insert(axis, _divided(nodes, chosen, AXES[axis] in ("offset", "y")))


def _widened(chosen: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Neighbours of the chosen nodes, up to the second one along each axis"""
    found = chosen.copy()
    for axis in range(chosen.ndim):
        here, there = np.moveaxis(chosen, axis, 0), np.moveaxis(found, axis, 0)
        for step in (1, 2):
            there[step:] |= here[:-step]
            there[:-step] |= here[step:]
    return found


def _divided(nodes: Numbers, chosen: NDArray[np.intp], is_even: bool) -> Numbers:
    """Midpoints of the intervals to be divided: the chosen ones, their mirror images on a symmetric axis, and neighbours that would
    otherwise be too long beside the divided ones, as splines over such nodes overshoot"""
    whole = nodes
    new: Numbers = np.zeros(0)
    while len(chosen):
        if is_even:
            chosen = np.union1d(chosen, len(whole) - 2 - chosen)
        middles = 0.5 * (whole[chosen] + whole[chosen + 1])
        new = np.concatenate([new, middles])
        whole = np.sort(np.concatenate([whole, middles]))
        widths = np.diff(whole)
        least = np.minimum(np.append(np.inf, widths[:-1]), np.append(widths[1:], np.inf))
        chosen = np.flatnonzero(widths > _GRADE * least)
    return np.sort(new)


def _sizes(gap: Numbers) -> Numbers:
    """The larger one of the forces and of the moment, for each point"""
    return np.asarray(np.maximum(np.hypot(gap[..., 0], gap[..., 1]), np.abs(gap[..., 2])))


def _largest(gap: Numbers) -> tuple[float, float]:
    """Largest errors of forces and of the moment"""
    return float(np.hypot(gap[:, 0], gap[:, 1]).max()), float(np.abs(gap[:, 2]).max())
