"""Making a table of creep forces: nodes are added where the interpolation errs, until it does not."""
from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import numpy as np
from numpy.typing import NDArray

from ..errors import ContactError
from ._file import write
from ._look_up import Facts, Numbers, Table
from ._results import Results, arms, creepages

#: Axes of a table and of its points, in their order
AXES = ("shape", "offset", "x", "y", "z")
#: Points at which the table learns where it errs, at first and each time that it has passed; the worst of them that are looked at
_LEARN, _WORST = 1500, 150
#: Part of the tolerance that points of learning are held to, because others will err more
_AIM = 0.85
#: An interval is divided when it alone errs by more than this part of the tolerance
_SHARE = 0.5
#: Largest ratio of the lengths of neighbouring intervals, with room for rounding
_GRADE = 2.01
#: Points at which results are compared with those of three times as many elements
_COMPARED = 150
#: Elements a side for a tolerance of 1 %
_ELEMENTS = 21
#: Nodes along z at first, closer where strips leave adhesion
_FIRST_Z = (0.0, 0.15, 0.3, 0.4, 0.5, 0.6, 0.7, 0.85, 1.0)


@dataclass(frozen=True)
class Plan:
    """What is asked of a table.

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
        Elements a side of the contacts that are solved, where they are round and have little spin; more along the longer side, and
        with much spin. 0: as many as the tolerance needs.
    points
        Random points at which errors are looked for in the end.
    most_cases
        Solutions after which it is given up.
    seed
        Of random numbers.
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
    def most_z(self) -> float:
        """Largest z [-]."""
        return self.spin / (1.0 + self.spin) if np.isfinite(self.spin) else 1.0

    def check(self) -> None:
        """Refuse what cannot be. Raises ContactError."""
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
        Its path; replaced as a whole when the table is good.
    plan
        What is asked of it.
    workers
        Threads that compute; default the processors of this machine.
    tell
        Is told in words how it goes.

    Returns
    -------
    What the table is.

    Raises
    ------
    ContactError
        If the plan cannot be followed, a contact was not solved, or the tolerance was not met within the cases of the plan.
    """
    asked = plan or Plan()
    asked.check()
    return _Builder(asked, workers or os.cpu_count() or 1, tell).build(Path(file))


def enough_elements(tolerance: float) -> int:
    """Elements a side whose own error is small beside the tolerance: it falls a little faster than their size."""
    return int(np.clip(round(_ELEMENTS * (0.01 / tolerance)**(1.0 / 3.0)), 9, 99))


class _Builder:
    """Nodes and what is known at them"""

    def __init__(self, plan: Plan, workers: int, tell: Callable[[str], None]) -> None:
        self._plan, self._tell = plan, tell
        self._elements = plan.elements or enough_elements(plan.tolerance)
        self._results = Results(plan.poisson, self._elements, plan.offset > 0.0, workers)
        self._random = np.random.default_rng(plan.seed)
        count = max(4, round(1.0 + 1.5 * np.log(plan.ratio[1] / plan.ratio[0])))
        self._nodes: list[Numbers] = [
            np.linspace(np.log(plan.ratio[0]), np.log(plan.ratio[1]), count),
            np.linspace(-plan.offset, plan.offset, 5) if plan.offset > 0.0 else np.zeros(1),
            np.linspace(0.0, 1.0, 5), np.linspace(-1.0, 1.0, 9), np.linspace(0.0, plan.most_z, 5) if plan.most_z < _FIRST_Z[-2]
            else np.array([*_FIRST_Z[:-1], plan.most_z])]
        self._values = self._at_nodes(self._nodes)

    # ---- values at nodes

    def _at_nodes(self, nodes: list[Numbers]) -> Numbers:
        """Values at all nodes, shape (shape, offset, x, y, z, 3)"""
        if self._results.cases + np.prod([len(axis) for axis in nodes]) > self._plan.most_cases:
            raise ContactError(f"the tolerance of {self._plan.tolerance:g} needs more than {self._plan.most_cases} solutions; "
                               "allow a larger error or more solutions, or narrow a/b and the offset")
        mesh = np.meshgrid(*nodes, indexing="ij")
        points = np.column_stack([axis.ravel() for axis in mesh])
        return self._results.at(points).reshape(*mesh[0].shape, 3)

    def _insert(self, axis: int, new: Numbers) -> None:
        """More nodes along an axis"""
        added = self._at_nodes([new if k == axis else nodes for k, nodes in enumerate(self._nodes)])
        whole = np.concatenate([self._nodes[axis], new])
        order = np.argsort(whole)
        self._nodes[axis] = whole[order]
        self._values = np.take(np.concatenate([self._values, added], axis=axis), order, axis=axis)

    # ---- points

    def _points(self, count: int) -> Numbers:
        """Random points of the table: uniform in log(a/b), offset, x, y, z"""
        low = [np.log(self._plan.ratio[0]), -self._plan.offset, 0.0, -1.0, 0.0]
        high = [np.log(self._plan.ratio[1]), self._plan.offset, 1.0, 1.0, self._plan.most_z]
        found = np.zeros((0, len(AXES)))
        while len(found) < count:
            points = self._random.uniform(low, high, size=(count, len(AXES)))
            found = np.concatenate([found, points[np.hypot(points[:, 2]**2, points[:, 3]**2) < 1.0]])
        return found[:count]

    # ---- the search

    def build(self, path: Path) -> Facts:
        """Divide intervals until the table is good, and write it"""
        plan = self._plan
        known = np.zeros((0, len(AXES)))
        true = np.zeros((0, 3))
        with tempfile.TemporaryDirectory() as folder:
            trial = Path(folder) / "table"
            while True:
                points = self._points(_LEARN)
                known, true = np.concatenate([known, points]), np.concatenate([true, self._results.at(points)])
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
                    self._refine(trial, known, errors)
                if not is_first:
                    continue
                points = self._points(plan.points)
                values = self._results.at(points)
                force, moment = self._parts(trial, points, values)
                self._tell(f"checked at {len(points)} new points: forces {100 * force:.3g} %, moment {100 * moment:.3g} %")
                if max(force, moment) <= plan.tolerance:
                    break
                known, true = np.concatenate([known, points]), np.concatenate([true, values])
            points = self._points(_COMPARED)
            fine, usual = self._results.at(points, 3 * self._elements), self._results.at(points)
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
        """A table of what is known"""
        write(path, self._nodes, self._values, facts)

    def _look_up(self, trial: Path, points: Numbers) -> Numbers:
        """What the table gives, in the units of the results"""
        ratio = np.exp(points[:, 0])
        creepage = creepages(points, 1e-9)
        with Table(trial) as table:
            return table.force(1.0, 1.0, 1.0, np.sqrt(ratio), 1.0 / np.sqrt(ratio), creepage[:, 0], creepage[:, 1], creepage[:, 2],
                               points[:, 1], outside=True)

    def _errors(self, trial: Path, points: Numbers, true: Numbers) -> Numbers:
        """Error at each point: the larger one of the forces and of the moment"""
        gap = self._gap(trial, points, true)
        return np.asarray(np.maximum(np.hypot(gap[:, 0], gap[:, 1]), np.abs(gap[:, 2])))

    def _parts(self, trial: Path, points: Numbers, true: Numbers) -> tuple[float, float]:
        """Largest errors of forces and of the moment"""
        return _largest(self._gap(trial, points, true))

    def _gap(self, trial: Path, points: Numbers, true: Numbers) -> Numbers:
        """What the table gives, less what is true; the moment about the middle of both extents, as callers see it"""
        gap = self._look_up(trial, points) - true
        gap[:, 2] += arms(points) * true[:, 0]
        return gap

    def _refine(self, trial: Path, known: Numbers, errors: Numbers) -> None:
        """Divide the intervals that err most, found by moving along one axis only from nodes near the worst points"""
        order = np.argsort(errors)[::-1]
        bad = known[order[:_WORST]][errors[order[:_WORST]] > _AIM * self._plan.tolerance]
        scores: list[NDArray[np.float64]] = []
        for axis, nodes in enumerate(self._nodes):
            score = np.zeros(max(1, len(nodes) - 1))
            if len(nodes) > 1:
                points = bad.copy()
                for other, steps in enumerate(self._nodes):
                    if other != axis:
                        points[:, other] = steps[np.abs(points[:, other, None] - steps).argmin(axis=1)]
                points = points[np.hypot(points[:, 2]**2, points[:, 3]**2) < 1.0]
                if len(points):
                    found = self._errors(trial, points, self._results.at(points))
                    place = np.clip(np.searchsorted(nodes, points[:, axis], side="right") - 1, 0, len(score) - 1)
                    np.maximum.at(score, place, found)
            scores.append(score)
        largest = max(float(score.max()) for score in scores)
        limit = min(_SHARE * self._plan.tolerance, largest)
        for axis, (nodes, score) in enumerate(zip(list(self._nodes), scores)):
            # never far from the worst one at once: the next round may find less
            chosen = np.flatnonzero(score >= max(limit, 0.25 * largest)) if largest > 0.0 else np.arange(0)
            if len(nodes) < 2 or not len(chosen):
                continue
            is_even = AXES[axis] in ("offset", "y")
            self._insert(axis, _divided(nodes, chosen, is_even))
        if largest == 0.0:
            self._insert(4, 0.5 * (self._nodes[4][1:] + self._nodes[4][:-1]))


def _divided(nodes: Numbers, chosen: NDArray[np.intp], is_even: bool) -> Numbers:
    """Middles of intervals that are divided: the chosen ones, their mirror images on an axis that has them, and others beside which
    intervals would become too short: splines over nodes at such distances overshoot"""
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


def _largest(gap: Numbers) -> tuple[float, float]:
    """Largest errors of forces and of the moment"""
    return float(np.hypot(gap[:, 0], gap[:, 1]).max()), float(np.abs(gap[:, 2]).max())
