"""Tasks of workers: some points of a study, solved by the library in threads, processes or on clusters."""
from __future__ import annotations

import io
import json
import os
import platform
import threading
import time
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._library import fingerprint
from .._signatures import VERSION
from ..errors import ContactError
from ._batch import Batch, Column, Numbers

#: Maximum number of patches of wheel and rail
MAX_PATCHES = 12

_own = threading.local()


def build() -> str:
    """Version of the package and hash of the library of this process."""
    return f"version {VERSION}, library {fingerprint()[:12]}"


@dataclass
class Task:
    """Points to be solved.

    Attributes
    ----------
    keys
        Keys of the points, see Study.
    texts
        Inputs: one for each point, or one for all, whose second case is solved with the numbers `given`.
    names, given
        Paths of the numbers that vary, and their values of shape (points, numbers).
    folder
        Folder of relative file names.
    steps
        Number of cases of each point.
    is_wheel_rail
        Whether it is a case of wheel and rail, with several rows for each point.
    fields
        Element fields to be kept.
    seconds
        Time limit of each case [s]; 0: none.
    build
        Build of the process that made the task; a worker with another one refuses it.
    """

    keys: NDArray[np.uint64]
    texts: list[str]
    names: list[str]
    given: Numbers
    folder: str
    steps: int
    is_wheel_rail: bool
    fields: tuple[str, ...] = ()
    seconds: float = 0.0
    build: str = field(default_factory=build)

    def __len__(self) -> int:
        return len(self.keys)

    def halves(self) -> tuple[Task, Task]:
        """The task, split into two."""
        middle = len(self) // 2
        return self.part(slice(0, middle)), self.part(slice(middle, None))

    def part(self, points: slice) -> Task:
        """A task with some of the points."""
        texts = self.texts if self.names else self.texts[points]
        given = self.given[points] if self.names else self.given
        return Task(self.keys[points], texts, self.names, given, self.folder, self.steps, self.is_wheel_rail, self.fields,
                    self.seconds, self.build)


@dataclass
class Done:
    """Results of a task.

    Attributes
    ----------
    keys
        Keys of the points, shape (points, 2).
    columns
        Description of each column of values.
    values, places
        Totals of shape (rows, columns), and point, step and patch of each row.
    states
        Status of each case and code of the missed condition, shape (points, steps, 2).
    reasons
        Why a case was not solved, by "point,step".
    frames, arrays
        Fields by "name,point,step,patch": first centre and sides of an element, and values of shape (my, mx); units of fields.
    worked
        Computing time [s].
    """

    keys: NDArray[np.uint64]
    columns: list[Column]
    values: Numbers
    places: NDArray[np.int32]
    states: NDArray[np.int8]
    reasons: dict[str, str]
    frames: dict[str, tuple[float, float, float, float]] = field(default_factory=dict)
    arrays: dict[str, Numbers] = field(default_factory=dict)
    units: dict[str, str] = field(default_factory=dict)
    worked: float = 0.0

    def to_bytes(self) -> bytes:
        """All data except the keys, in the format of numpy.savez."""
        head = {"columns": [vars(column) for column in self.columns], "reasons": self.reasons, "frames": self.frames,
                "units": self.units, "worked": self.worked}
        file = io.BytesIO()
        arrays: dict[str, Any] = {f"field {name}": values for name, values in self.arrays.items()}
        np.savez(file, head=np.frombuffer(json.dumps(head).encode(), dtype=np.uint8), values=self.values, places=self.places,
                 states=self.states, **arrays)
        return file.getvalue()

    @classmethod
    def from_bytes(cls, keys: bytes, data: bytes) -> Done:
        """The inverse of `to_bytes`."""
        with np.load(io.BytesIO(data), allow_pickle=False) as file:
            head = json.loads(file["head"].tobytes())
            arrays = {name[len("field "):]: file[name] for name in file.files if name.startswith("field ")}
            return cls(np.frombuffer(keys, dtype=np.uint64).reshape(-1, 2), [Column(**one) for one in head["columns"]],
                       file["values"], file["places"], file["states"], head["reasons"],
                       {name: tuple(frame) for name, frame in head["frames"].items()}, arrays, head["units"], head["worked"])


def refused(task: Task, reason: str) -> Done:
    """Results of a task whose cases are all refused."""
    states = np.zeros((len(task), task.steps, 2), dtype=np.int8)
    states[:, :, 0] = 2
    reasons = {f"{point},{step}": reason for point in range(len(task)) for step in range(task.steps)}
    return Done(task.keys, [], np.zeros((0, 0)), np.zeros((0, 3), dtype=np.int32), states, reasons)


def solve_task(task: Task) -> Done:
    """Execute a task. The library reuses data between the tasks of a thread."""
    if task.build != build():
        raise ContactError(f"the worker {platform.node()}, process {os.getpid()}, is of another build ({build()}) than the study "
                           f"({task.build}): install the same there")
    started = time.perf_counter()
    batches = _own.__dict__.setdefault("batches", {})
    if task.seconds not in batches:
        batches[task.seconds] = Batch(1, task.seconds)
    done = _solve(task, batches[task.seconds])
    done.worked = time.perf_counter() - started
    return done


def _solve(task: Task, batch: Batch) -> Done:
    """Execute a task with the batch of this thread"""
    rows_per_case = MAX_PATCHES + 1 if task.is_wheel_rail else 1
    if task.names and not task.fields:
        try:
            solved = batch.solve(task.texts[0], task.folder, task.names, task.given, patches=rows_per_case)
        except ContactError as error:
            return refused(task, str(error))
        places = np.insert(solved.places.astype(np.int32), 1, 0, axis=1)
        reasons = {f"{point},0": reason for point, reason in enumerate(solved.reasons) if reason}
        return Done(task.keys, solved.columns, solved.values, places, solved.states.astype(np.int8)[:, np.newaxis, :], reasons)
    done = Done(task.keys, [], np.zeros((0, 0)), np.zeros((0, 3), dtype=np.int32),
                np.zeros((len(task), task.steps, 2), dtype=np.int8), {})
    values, places_of = [], []
    for point in range(len(task)):
        try:
            if task.names:
                solved = batch.solve(task.texts[0], task.folder, task.names, task.given[point:point + 1], patches=rows_per_case)
            else:
                solved = batch.solve(task.texts[point], task.folder, cases=task.steps, patches=rows_per_case)
        except ContactError as error:
            done.states[point, :, 0] = 2
            done.reasons.update({f"{point},{step}": str(error) for step in range(task.steps)})
            continue
        done.columns = solved.columns
        done.states[point, :len(solved.states)] = solved.states
        done.reasons.update({f"{point},{step}": reason for step, reason in enumerate(solved.reasons) if reason})
        rows = np.empty((len(solved.places), 3), dtype=np.int32)
        rows[:, 0], rows[:, 1:] = point, solved.places
        places_of.append(rows)
        values.append(solved.values)
        for name in task.fields:
            for _, step, patch in rows:
                if step == task.steps - 1 and patch > 0:
                    _keep_field(batch, done, name, f"{name},{point},{step},{patch}", int(patch))
    if values:
        done.places = np.concatenate(places_of)
        done.values = np.full((len(done.places), len(done.columns)), np.nan)
        first = 0
        for one in values:
            done.values[first:first + len(one), :one.shape[1]] = one
            first += len(one)
    return done


def _keep_field(batch: Batch, done: Done, name: str, key: str, patch: int) -> None:
    """Store a field of the last solved case"""
    found = batch.field(name, patch)
    if found is not None:
        done.arrays[key], done.frames[key], done.units[name] = found
