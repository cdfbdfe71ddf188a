"""Summary of the cases that were not solved, by causes."""
from __future__ import annotations

import re
from typing import Any

import numpy as np
import xarray


def kind_of(reason: str) -> str:
    """A reason without its numbers, so that equal causes have equal texts."""
    return re.sub(r"[-+]?\d+(\.\d*)?([eE][-+]?\d+)?", "#", reason)


class Tally:
    """Counts cases by their status, part by part.

    Parameters
    ----------
    shape, names
        Lengths and names of the dimensions of all cases.
    """

    def __init__(self, shape: tuple[int, ...], names: list[str]) -> None:
        self._shape, self._names = shape, names
        self.counts: dict[int, int] = {}
        #: Number of cases of each kind, position of the first one, and its reason
        self._kinds: dict[tuple[int, str], list[Any]] = {}

    def add(self, results: xarray.Dataset, first: int) -> None:
        """Count the cases of a part; first is the number of its first case."""
        status = results["status"].values.ravel()
        reasons = results["reason"].values.ravel()
        sentences = [str(text) for text in results["reasons"].values]
        for state, count in zip(*np.unique(status, return_counts=True)):
            self.counts[int(state)] = self.counts.get(int(state), 0) + int(count)
        for place in np.flatnonzero((status == 1) | (status == 2)):
            sentence = sentences[reasons[place]]
            kind = self._kinds.setdefault((int(status[place]), kind_of(sentence)), [0, first + int(place), sentence])
            kind[0] += 1

    def __str__(self) -> str:
        count = self.counts.get
        return (f"{sum(self.counts.values())} cases: {count(0, 0)} solved, {count(1, 0)} not converged, {count(2, 0)} refused, "
                f"{count(-1, 0)} left out")

    def table(self) -> str:
        """Kinds of cases that were not solved: number, status, reason, and the first of them; "" if all were solved."""
        if not self._kinds:
            return ""
        words = {1: "not converged", 2: "refused"}
        lines = [f"{'cases':>9}  {'ended':13}  why"]
        for (state, kind), (count, place, sentence) in sorted(self._kinds.items(), key=lambda item: -item[1][0]):
            lines.append(f"{count:9d}  {words[state]:13}  {kind}")
            where = ", ".join(f"{name} {number}" for name, number in zip(self._names, np.unravel_index(place, self._shape)))
            lines.append(f"{'':9}  {'':13}  first at {where}: {sentence}")
        return "\n".join(lines)


def table(results: xarray.Dataset) -> str:
    """The table of a whole dataset."""
    tally = Tally(results["status"].shape, [str(name) for name in results["status"].dims])
    tally.add(results, 0)
    return tally.table()
