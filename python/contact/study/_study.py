"""Studies: many cases from one description."""
from __future__ import annotations

import contextlib
import hashlib
import json
import os
import random
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Union

import numpy as np
import xarray
from numpy.typing import NDArray

from .._library import fingerprint
from .._signatures import FIELDS, VERSION
from ..errors import ContactError
from . import _dataset, _failures, _parts
from ._engine import Engine
from ._expression import evaluate
from ._progress import Progress, ShowProgress, duration
from ._scene import Scene
from ._space import Axis, Rule, Values, make_space
from ._store import Keys, Places, Store, distinct
from ._task import Task, solve_task

#: A derived quantity of a dataset: a formula, or a function
Derived = Union[str, Callable[[xarray.Dataset], Any]]

#: Intended time of a task [s], and maximum number of points of one
_TASK_SECONDS, _MAX_POINTS = 0.5, 4096
#: Number of points that are solved to measure the cost of a case
_TRIALS = 4
#: Memory of a part of the results [bytes]
_PART_BYTES = 1 << 27
#: Number of points whose inputs are hashed at a time
_PORTION = 1 << 16


@dataclass(frozen=True)
class Plan:
    """Size and expected cost of a study.

    Attributes
    ----------
    points, left_out, there
        Points of the axes; those omitted by constraints; those already in the folder.
    cases
        Number of cases to be computed.
    seconds_per_case
        Measured on a few points, on one thread; NaN if nothing is left to compute.
    seconds
        Expected time with the workers.
    bytes
        Expected increase in size of the folder.
    memory
        Expected memory of the results as a dataset [bytes].
    workers
        Number of simultaneous workers.
    """

    points: int
    left_out: int
    there: int
    cases: int
    seconds_per_case: float
    seconds: float
    bytes: int
    memory: int
    workers: int

    def __str__(self) -> str:
        lines = [f"{self.points} points, {self.left_out} left out by constraints, {self.there} computed before"]
        if self.cases:
            lines.append(f"{self.cases} cases to compute, {1e3 * self.seconds_per_case:.3g} ms each on one thread (measured): "
                         f"about {duration(self.seconds)} with {self.workers} worker{'s' * (self.workers > 1)}")
            lines.append(f"about {self.bytes / 1e6:.3g} MB of results, {self.memory / 1e6:.3g} MB of memory as a dataset")
        else:
            lines.append("nothing is left to compute")
        return "\n".join(lines)


class Study:
    """Many cases from one description.

    Parameters
    ----------
    base
        Path of an experiment in either format, or its cases as returned by :func:`contact.read`.
    vary
        Varied inputs: a mapping from inputs, ``"group.key"`` of the readable format, to values, to ``"= formula"`` or to a function
        of the others; a :func:`sample` or :func:`table`; or a list of these. Each list, sample and table is a dimension.
    case
        Number of the case of the base that is varied, from 1. Without it all cases are computed for each point, one after the
        other, with the dimension ``step``.
    where
        Constraints: formulae or functions of the inputs; points that do not satisfy them are omitted.
    derive
        Derived quantities: formulae or functions of the dataset, by name.
    totals
        Names of the totals that are kept in the dataset; default all.
    fields
        Element fields that are kept, such as ``"pn"``; default none. Of several cases of a point, those of the last.
    folder
        Folder of the study, in which computed cases are stored and reused. None: nothing is stored.
    seconds
        Time limit of each case [s]; 0: none. With a limit, results depend on the machine.
    base_folder
        Folder of relative file names if the base is given as cases.

    Examples
    --------
    >>> study = contact.Study("creep.toml", {"kinematics.cksi": contact.study.span(0, 0.01, 11)})
    >>> print(study.explain())
    >>> results = study.run()
    >>> results.fx.plot()
    """

    def __init__(self, base: str | os.PathLike[str] | Sequence[Mapping[str, Any]] | Mapping[str, Any],
                 vary: Mapping[str, Any] | Axis | Sequence[Any] | None = None, *, case: int | None = None,
                 where: Sequence[Rule] | Rule | None = None, derive: Mapping[str, Derived] | None = None,
                 totals: Sequence[str] | None = None, fields: Sequence[str] = (), folder: str | os.PathLike[str] | None = None,
                 seconds: float = 0.0, base_folder: str | os.PathLike[str] | None = None) -> None:
        self._scene = Scene(base, case, base_folder)
        self._space = make_space([vary] if isinstance(vary, Axis) else vary, where)
        self._derive = dict(derive or {})
        self._totals = [totals] if isinstance(totals, str) else list(totals) if totals is not None else None
        self._fields = (fields,) if isinstance(fields, str) else tuple(fields)
        if not seconds >= 0.0:
            raise ContactError(f"seconds = {seconds}: a limit of time is not negative; 0 is none")
        self._seconds = seconds
        self.folder = Path(folder) if folder is not None else None
        try:
            self._columns: dict[str, Values] = self._space.columns()
        except MemoryError as reason:
            raise ContactError(f"{self._space.count} points do not fit into memory: divide the study") from reason
        self._scene.refuse_overlaps(list(self._columns))
        self._chosen = self._space.chosen(self._columns)
        numeric = {path: values for path, values in self._columns.items() if values.dtype == np.float64}
        # words are written into the text of a case, as are all inputs of a base with several cases; numbers are passed as arrays
        self._numbers = numeric if self._scene.steps == 1 else {}
        self._numbers = {path: values for path, values in self._numbers.items() if ":" not in path}
        self._words = {path: values for path, values in self._columns.items() if path not in self._numbers}
        self._made: Keys | None = None

    # ---- planning

    def keys(self) -> Keys:
        """A key for each point, shape (points, 2): hashes of inputs, base with its files, version and library."""
        if self._made is not None:
            return self._made
        paths = sorted(self._columns)
        start = hashlib.blake2b(self._scene.digest(), digest_size=16)
        start.update(json.dumps([VERSION, fingerprint(), paths, sorted(self._fields), self._seconds]).encode())
        made = np.empty((self._space.count, 2), dtype=np.uint64)
        for first in range(0, len(made), _PORTION):
            portion = slice(first, min(first + _PORTION, len(made)))
            parts = [_as_bytes(self._columns[path][portion]) for path in paths]
            for path in paths:
                contents = self._scene.digest_of_files(path, self._columns[path][portion])
                if contents is not None:
                    parts.append(np.frombuffer(b"".join(contents), dtype=np.uint8).reshape(-1, 8))
            rows = np.concatenate(parts, axis=1) if parts else np.zeros((portion.stop - first, 0), dtype=np.uint8)
            data, width = rows.tobytes(), rows.shape[1]
            digests = b"".join(_digest(start, data[k * width:(k + 1) * width]) for k in range(len(rows)))
            made[portion] = np.frombuffer(digests, dtype=np.uint64).reshape(-1, 2)
        self._made = made
        return made

    def explain(self, workers: int | None = None, scheduler: Any = None) -> Plan:
        """Number of cases, time and size of a study, estimated by solving a few of its points; nothing is stored.

        Parameters
        ----------
        workers, scheduler
            As for :meth:`run`.
        """
        engine = Engine(workers, scheduler=scheduler)
        try:
            keys = self.keys()
            there = self._there(keys)
            todo = np.flatnonzero(self._chosen & ~there)
            left_out = int((~self._chosen).sum())
            if len(todo) == 0:
                return Plan(len(keys), left_out, int((there & self._chosen).sum()), 0, float("nan"), 0.0, 0, 0, engine.workers)
            trials = np.array(sorted(random.Random(1).sample(range(len(todo)), min(_TRIALS, len(todo)))))
            solve_task(self._task(todo[trials[:1]], keys))
            times, sizes, rows, columns = [], [], 0, 1
            for trial in trials:
                begun = time.perf_counter()
                done = solve_task(self._task(todo[trial:trial + 1], keys))
                times.append(time.perf_counter() - begun)
                # a batch of many points has one header
                sizes.append(done.values.nbytes + done.places.nbytes + 2 * self._scene.steps + 16
                             + sum(values.nbytes for values in done.arrays.values()))
                rows, columns = max(rows, len(done.places)), max(columns, len(done.columns))
            per_point = float(np.mean(times))
            cases = len(todo) * self._scene.steps
            return Plan(len(keys), left_out, int((there & self._chosen).sum()), cases, per_point / self._scene.steps,
                        per_point * len(todo) / engine.workers, int(np.mean(sizes) * len(todo)),
                        len(keys) * max(1, rows) * columns * 8, engine.workers)
        finally:
            engine.close()

    def _there(self, keys: Keys) -> NDArray[np.bool_]:
        """Which points were computed before"""
        if self.folder is None or not self.folder.is_dir():
            return np.zeros(len(keys), dtype=bool)
        store = Store(self.folder)
        try:
            return Places(store.keys()).of(keys) >= 0
        finally:
            store.close()

    # ---- computation

    def run(self, workers: int | None = None, *, engine: str = "threads", scheduler: Any = None, progress: ShowProgress = None,
            points_per_task: int | None = None, stop: Callable[[], bool] = lambda: False) -> xarray.Dataset:
        """Compute the missing cases.

        Parameters
        ----------
        workers
            Number of simultaneous cases; default: the number of processors of this machine.
        engine
            ``"threads"``, or ``"processes"``, with which the crash of one does not end the study.
        scheduler
            Address of a scheduler of Dask, or a ``distributed.Client``: its workers compute. They need the package, the
            library, and files of profiles under the same names.
        progress
            True; False; None: if it can be displayed; or a function that receives it in words.
        points_per_task
            Number of points of a task; by default chosen for tasks of half a second.
        stop
            Called between tasks; True ends the study. Computed cases are kept.

        Returns
        -------
        The results, see doc/user/studies.md. A case that was refused or did not converge is part of them, with its reason.
        """
        with self._computed(workers, engine, scheduler, progress, points_per_task, stop) as store:
            return self._results(store, self.keys())

    def compute(self, workers: int | None = None, *, engine: str = "threads", scheduler: Any = None, progress: ShowProgress = None,
                points_per_task: int | None = None, stop: Callable[[], bool] = lambda: False) -> None:
        """As :meth:`run`, without results in memory: they stay in the folder, for :meth:`write` and :meth:`results`."""
        if self.folder is None:
            raise ContactError("a study that is computed without results in memory needs a folder")
        with self._computed(workers, engine, scheduler, progress, points_per_task, stop):
            pass

    @contextlib.contextmanager
    def _computed(self, workers: int | None, engine: str, scheduler: Any, progress: ShowProgress, points_per_task: int | None,
                  stop: Callable[[], bool]) -> Iterator[Store]:
        """Compute the missing points into the store"""
        keys = self.keys()
        store = Store(self.folder)
        doers = Engine(workers, engine, scheduler)
        try:
            there = Places(store.keys()).of(keys) >= 0
            todo = np.flatnonzero(self._chosen & ~there)
            # points with equal inputs are one case
            todo = todo[distinct(keys[todo])[0]]
            self._check(todo)
            shown = Progress(len(todo), int((there & self._chosen).sum()), progress)
            pace = _Pace(points_per_task, len(todo), doers.workers)
            tasks = self._tasks(todo, keys, pace)
            try:
                for done in doers.run(lambda: next(tasks, None), stop):
                    store.add(done)
                    pace.learn(len(done.keys), done.worked)
                    shown.add(len(done.keys), int((done.states[:, :, 0] != 0).any(axis=1).sum()))
            finally:
                shown.close()
            yield store
        finally:
            doers.close()
            store.close()

    def results(self) -> xarray.Dataset:
        """The stored results, without computing anything."""
        store = Store(self.folder)
        try:
            return self._results(store, self.keys())
        finally:
            store.close()

    def write(self, *files: str | os.PathLike[str], memory: int = _PART_BYTES) -> _failures.Tally:
        """Write the stored results to files in parts, without computing anything and without all results in memory.

        Parameters
        ----------
        files
            ``.nc`` for netCDF, ``.zarr`` for Zarr, both in chunks, ``.parquet`` for the totals as a table; none: cases are counted
            only. Derived quantities have to be formulae: a function would see a part of the results.
        memory
            Approximate memory of a part of the results [bytes].

        Returns
        -------
        Summary of the cases: in words by ``str``; ``table()`` lists the causes of those that were not solved.
        """
        if self.folder is None:
            raise ContactError("a study whose results are written by parts needs a folder")
        functions = [name for name, rule in self._derive.items() if callable(rule)]
        if functions and files:
            raise ContactError(f"{', '.join(functions)} is derived by a function, which needs all results at once: "
                               "give a formula, or save what results() gives")
        store = Store(self.folder)
        try:
            return _parts.write_parts(list(files), store, self.keys(), self._chosen, self._space, self._columns, self._request(),
                                      self._derived if files else lambda part: part, memory)
        finally:
            store.close()

    def _request(self) -> _dataset.Request:
        """Requested contents of the results"""
        return _dataset.Request(self._scene, self._totals, self._fields)

    def _results(self, store: Store, keys: Keys) -> xarray.Dataset:
        """The dataset of the stored results"""
        return self._derived(_dataset.assemble(store, keys, self._chosen, self._space, self._columns, self._request()))

    def _derived(self, data: xarray.Dataset) -> xarray.Dataset:
        """Results with derived quantities"""
        for name, rule in self._derive.items():
            if name in data.variables:
                raise ContactError(f"the derived quantity {name} has the name of a result or an input; give it another one")
            names: dict[str, Any] = {str(key): data[key] for key in list(data.variables)}
            values = rule(data) if callable(rule) else evaluate(rule, names)
            if isinstance(values, xarray.Dataset):
                data = data.merge(values)
            else:
                data[name] = values
                if isinstance(rule, str):
                    data[name].attrs["long_name"] = rule
        return data

    def _check(self, todo: NDArray[np.intp]) -> None:
        """Solve one point first, so that a wrong name of an input is reported at once and not as the refusal of every case"""
        if len(todo) == 0:
            return
        done = solve_task(self._task(todo[:1], self.keys()))
        reason = done.reasons.get("0,0", "")
        mistakes = ("unknown ", "has no meaning", "gives no number", "is outside of a case")
        if done.states[0, 0, 0] == 2 and any(words in reason for words in mistakes):
            raise ContactError(f"the inputs of the study do not fit its base: {reason}")
        if done.columns and self._totals is not None:
            known = [column.name for column in done.columns]
            missing = [name for name in self._totals if name not in known]
            if missing:
                raise ContactError(f"there is no total {', '.join(missing)}; there are {', '.join(known)}")
        # a refused case, and a wheel without contact, have no fields
        if done.states[0, -1, 0] == 0 and (not self._scene.is_wheel_rail or (done.places[:, 2] > 0).any()):
            known = [name.partition(",")[0] for name in done.arrays]
            # fields of temperatures, wear and yield exist only in cases with such results
            missing = [name for name in self._fields if name not in known and name not in FIELDS]
            if missing:
                raise ContactError(f"there is no element field {', '.join(missing)}; doc/user/results.md has their names")

    def _tasks(self, todo: NDArray[np.intp], keys: Keys, pace: _Pace) -> Iterator[Task]:
        """Tasks for points; the points of a task have the same non-numeric inputs"""
        if not self._numbers:
            for first in _portions(len(todo), pace):
                yield self._task(todo[first], keys)
            return
        groups = np.zeros(len(todo), dtype=np.int64)
        for values in self._words.values():
            found: dict[bytes, int] = {}
            marks = np.array([found.setdefault(row.tobytes(), len(found)) for row in _as_bytes(values[todo])])
            groups = groups * (len(found) + 1) + marks
        order = np.argsort(groups, kind="stable")
        starts = np.flatnonzero(np.diff(groups[order])) + 1
        for group in np.split(todo[order], starts):
            for part in _portions(len(group), pace):
                yield self._task(group[part], keys)

    def _task(self, points: NDArray[np.intp], keys: Keys) -> Task:
        """A task for points with the same non-numeric inputs, or without numbers"""
        first = points[0]
        folder = str(self._scene.folder)
        if self._numbers:
            words = {path: values[first] for path, values in self._words.items()}
            numbers = {path: float(values[first]) for path, values in self._numbers.items()}
            finite = {path: value if np.isfinite(value) else 0.0 for path, value in numbers.items()}
            text, names = self._scene.varied_text(words, finite)
            given = np.column_stack([values[points] for path, values in self._numbers.items()
                                     for _ in self._scene.keys_of(path)])
            texts = [text]
        else:
            texts = [self._scene.text({path: values[point] for path, values in self._words.items()}) for point in points]
            names, given = [], np.zeros((0, 0))
        return Task(keys[points], texts, names, given, folder, self._scene.steps, self._scene.is_wheel_rail, self._fields,
                    self._seconds)

    @staticmethod
    def failures(results: xarray.Dataset) -> str:
        """A table of the causes of cases that were not solved, in words; "" if all were solved."""
        return _failures.table(results)


class _Pace:
    """Number of points of a task: a compromise between overhead per task and frequent storage of results"""

    def __init__(self, given: int | None, points: int, workers: int) -> None:
        if given is not None and given < 1:
            raise ValueError(f"points_per_task = {given} is less than 1")
        self._given = given
        # small enough to keep all workers busy at the end
        self._fair = max(1, points // (4 * workers))
        self.size = given or 1

    def learn(self, points: int, seconds: float) -> None:
        """Adapt the size to the time that a task took"""
        if self._given is None and points and seconds > 0.0:
            fitting = int(_TASK_SECONDS * points / seconds)
            self.size = max(1, min(fitting, 4 * self.size, self._fair, _MAX_POINTS))


def _portions(count: int, pace: _Pace) -> Iterator[slice]:
    """Consecutive slices with the current number of points"""
    first = 0
    while first < count:
        last = min(count, first + pace.size)
        yield slice(first, last)
        first = last


def _digest(start: hashlib.blake2b, data: bytes) -> bytes:
    """Digest of the bytes hashed so far and some more"""
    one = start.copy()
    one.update(data)
    return one.digest()


def _as_bytes(values: Values) -> NDArray[np.uint8]:
    """Eight bytes for each value: a number itself, a digest of anything else"""
    if values.dtype == np.float64:
        # -0.0 equals 0.0
        return np.ascontiguousarray(values + 0.0).view(np.uint8).reshape(-1, 8)
    try:
        rows = [hashlib.blake2b(json.dumps(_plain(value), sort_keys=True).encode(), digest_size=8).digest() for value in values]
    except TypeError as reason:
        raise ContactError(f"inputs are numbers, words and lists of them: {reason}") from reason
    return np.frombuffer(b"".join(rows), dtype=np.uint8).reshape(-1, 8)


def _plain(value: Any) -> Any:
    """A value that JSON can represent"""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return value
