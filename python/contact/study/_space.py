"""Varied inputs of a study: lists, ranges, samples, tables, and inputs computed from them."""
from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Callable, Union

import numpy as np
from numpy.typing import NDArray

from ..errors import ContactError
from ._expression import evaluate

#: Values of one input along an axis, or at all points: numbers, or objects such as strings
Values = NDArray[Any]
#: Function of a mapping from names to values of all points, which returns the values of another input or of a constraint
Rule = Union[str, Callable[[Mapping[str, Values]], Any]]


@dataclass(frozen=True)
class Axis:
    """Inputs that vary together along one dimension of the results.

    Attributes
    ----------
    name
        Name of the dimension.
    columns
        Values by the path of the input, ``"group.key"`` of the readable format; all of one length.
    """

    name: str
    columns: dict[str, Values]

    def __post_init__(self) -> None:
        lengths = {len(values) for values in self.columns.values()}
        if len(lengths) != 1 or 0 in lengths:
            raise ValueError(f"the inputs of '{self.name}' need the same number of values, one at least")

    def __len__(self) -> int:
        return len(next(iter(self.columns.values())))


def span(first: float, last: float, count: int) -> Values:
    """Equidistant numbers, both ends included."""
    return np.linspace(first, last, count)


def log_span(first: float, last: float, count: int) -> Values:
    """Numbers with equal ratios, both ends included."""
    return np.geomspace(first, last, count)


def sample(ranges: Mapping[str, Sequence[float | str]], count: int, method: str = "latin_hypercube", seed: int = 1,
           name: str = "sample") -> Axis:
    """Points spread over ranges, by scipy.stats.qmc.

    Parameters
    ----------
    ranges
        Lowest and highest value of each input; a third entry ``"log"`` spreads the logarithm.
    count
        Number of points. Sobol sequences are balanced for powers of 2.
    method
        ``"latin_hypercube"`` or ``"sobol"``.
    seed
        The same seed gives the same points. More points of a Sobol sequence begin with those of a shorter one, so that a
        study can be extended; those of a Latin hypercube do not.
    name
        Of the dimension.
    """
    from scipy.stats import qmc
    if method not in ("latin_hypercube", "sobol"):
        raise ValueError(f"method = {method!r} is none of latin_hypercube, sobol")
    if method == "sobol":
        engine = qmc.Sobol(len(ranges), seed=seed)
        import warnings
        with warnings.catch_warnings():
            # balance is the caller's choice
            warnings.simplefilter("ignore", UserWarning)
            unit = engine.random(count)
    else:
        unit = qmc.LatinHypercube(len(ranges), seed=seed).random(count)
    columns: dict[str, Values] = {}
    for place, (path, limits) in enumerate(ranges.items()):
        low, high = float(limits[0]), float(limits[1])
        if len(limits) > 2 and limits[2] == "log":
            if not 0.0 < low < high:
                raise ValueError(f"{path}: a logarithm needs 0 < {low} < {high}")
            columns[path] = low * (high / low) ** unit[:, place]
        elif len(limits) == 2:
            columns[path] = low + (high - low) * unit[:, place]
        else:
            raise ValueError(f"{path}: {list(limits)} is not [lowest, highest] or [lowest, highest, \"log\"]")
    return Axis(name, columns)


def table(source: str | os.PathLike[str] | Mapping[str, Sequence[Any]], columns: Mapping[str, str] | None = None,
          name: str = "row") -> Axis:
    """Points from a table.

    Parameters
    ----------
    source
        A file ``.csv`` or ``.parquet``, or a mapping from names to values, such as a data frame.
    columns
        Names of columns by paths of inputs. Without it the names of the columns are paths.
    name
        Of the dimension.
    """
    found: Mapping[str, Any]
    if isinstance(source, (str, os.PathLike)):
        import pandas
        file = Path(source)
        if file.suffix == ".csv":
            found = pandas.read_csv(file)
        elif file.suffix in (".parquet", ".pq"):
            found = pandas.read_parquet(file)
        else:
            raise ValueError(f"{file}: a table is .csv or .parquet")
    else:
        found = source
    chosen = dict(columns) if columns is not None else {str(key): str(key) for key in found}
    missing = [column for column in chosen.values() if column not in found]
    if missing:
        raise ValueError(f"the table has no column {', '.join(missing)}; it has {', '.join(map(str, found))}")
    return Axis(name, {path: as_values(found[column]) for path, column in chosen.items()})


def as_values(values: Any) -> Values:
    """Values of an input as an array: of numbers if all values are numbers, otherwise of objects"""
    if np.ma.is_masked(values):
        raise ValueError("masked values cannot be inputs: they have no value")
    listed = np.asarray(values).tolist() if isinstance(values, np.ndarray) else list(values)
    if all(isinstance(value, (int, float, np.integer, np.floating)) and not isinstance(value, bool) for value in listed):
        return np.asarray(listed, dtype=np.float64)
    objects = np.empty(len(listed), dtype=object)
    for k, value in enumerate(listed):
        objects[k] = value
    return objects


@dataclass
class Space:
    """All points of a study: the product of its axes.

    Attributes
    ----------
    axes
        Dimensions, the last one running fastest.
    rules
        Inputs computed from others, by path.
    where
        Constraints, which points must satisfy.
    """

    axes: list[Axis]
    rules: dict[str, Rule] = field(default_factory=dict)
    where: list[Rule] = field(default_factory=list)

    def __post_init__(self) -> None:
        names = [axis.name for axis in self.axes]
        paths = [path for axis in self.axes for path in axis.columns] + list(self.rules)
        for kind, listed in (("dimension", names), ("input", paths)):
            twice = sorted({name for name in listed if listed.count(name) > 1})
            if twice:
                raise ValueError(f"the {kind} {', '.join(twice)} varies twice")
        self.short = short_names(paths)

    @property
    def shape(self) -> tuple[int, ...]:
        """Lengths of the axes."""
        return tuple(len(axis) for axis in self.axes)

    @property
    def count(self) -> int:
        """Number of points, including those excluded by constraints."""
        return int(np.prod(self.shape, dtype=np.int64))

    def columns(self) -> dict[str, Values]:
        """Values of all inputs at all points, by path."""
        found: dict[str, Values] = {}
        index = np.indices(self.shape).reshape(len(self.axes), -1) if self.axes else np.zeros((0, 1), dtype=int)
        for axis, places in zip(self.axes, index):
            for path, values in axis.columns.items():
                found[path] = values[places]
        for path, rule in self.rules.items():
            values = self._apply(rule, found)
            values = np.broadcast_to(np.asarray(values), (self.count,))
            found[path] = values if values.dtype == np.float64 else as_values(values)
        return found

    def chosen(self, columns: Mapping[str, Values]) -> NDArray[np.bool_]:
        """Which points satisfy the constraints."""
        result = np.ones(self.count, dtype=bool)
        for rule in self.where:
            result &= np.broadcast_to(np.asarray(self._apply(rule, columns), dtype=bool), (self.count,))
        return result

    def _apply(self, rule: Rule, columns: Mapping[str, Values]) -> Any:
        names = {self.short[path]: values for path, values in columns.items()}
        if callable(rule):
            try:
                return rule(names)
            except KeyError as missing:
                raise ValueError(f"a function of the inputs asks for {missing}, which is not there; there are "
                                 f"{', '.join(sorted(names))}") from missing
        return evaluate(rule, names)


def short_names(paths: Sequence[str]) -> dict[str, str]:
    """Names of variables for paths: the key, or group and key if two paths have the same key"""
    last = [path.rpartition(".")[2].replace(":", "_") for path in paths]
    return {path: word if last.count(word) == 1 else path.replace(".", "_").replace(":", "_")
            for path, word in zip(paths, last)}


def make_space(vary: Mapping[str, Any] | Sequence[Any] | None, where: Sequence[Rule] | Rule | None) -> Space:
    """Axes and rules from the argument `vary`: a mapping from paths to values or functions, axes, or a list of both"""
    axes: list[Axis] = []
    rules: dict[str, Rule] = {}
    if vary is not None and not isinstance(vary, (Mapping, Axis, list, tuple)):
        raise ContactError(f"what varies is a mapping from inputs to values, a sample, a table, or a list of these, not {vary!r}")
    parts: Sequence[Any] = [vary] if isinstance(vary, (Mapping, Axis)) else list(vary or [])
    loose: dict[str, Values] = {}
    for part in parts:
        if isinstance(part, Axis):
            axes.append(part)
            continue
        if not isinstance(part, Mapping):
            raise ContactError(f"what varies is a mapping from inputs to values, or a sample or table, not {part!r}")
        for path, values in part.items():
            if callable(values) or (isinstance(values, str) and values.startswith("=")):
                rules[path] = values[1:] if isinstance(values, str) else values
            elif isinstance(values, (str, int, float)):
                loose[path] = as_values([values])
                axes.append(Axis(path, {path: loose[path]}))
            else:
                loose[path] = as_values(values)
                axes.append(Axis(path, {path: loose[path]}))
    short = short_names([path for axis in axes for path in axis.columns] + list(rules))
    axes = [Axis(short[axis.name], axis.columns) if axis.name in loose else axis for axis in axes]
    if where is None:
        conditions: list[Rule] = []
    elif isinstance(where, str) or callable(where):
        conditions = [where]
    elif isinstance(where, Sequence) and all(isinstance(rule, str) or callable(rule) for rule in where):
        conditions = list(where)
    else:
        raise ContactError(f"a constraint is a formula or a function, or a list of these, not {where!r}")
    return Space(axes, rules, conditions)
