"""Storage of the computed cases of a study: one file that is consistent after every batch, even if the process crashes."""
from __future__ import annotations

import os
import sqlite3
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import ContactError
from ._task import Done

#: Name of the file, and version of its layout
FILE = "cases.sqlite"
_LAYOUT = 1

Keys = NDArray[np.uint64]


class Store:
    """Results by the keys of their points, in an SQLite file: a batch is stored completely or not at all.

    Parameters
    ----------
    folder
        Folder of the file, created if necessary; None keeps results in memory.

    Raises
    ------
    ContactError
        If another study writes to it, or if it is not such a file.
    """

    def __init__(self, folder: str | os.PathLike[str] | None) -> None:
        if folder is None:
            self.path = ":memory:"
        else:
            try:
                os.makedirs(folder, exist_ok=True)
            except OSError as reason:
                raise ContactError(f"{folder} cannot be the folder of a study: {reason.strerror}") from reason
            self.path = str(Path(folder) / FILE)
        # a lock is held for moments only, unless it is that of another study
        self._base = sqlite3.connect(self.path, timeout=1.0, isolation_level=None)
        try:
            self._base.execute("PRAGMA locking_mode = EXCLUSIVE")
            self._base.execute("PRAGMA journal_mode = TRUNCATE")
            self._base.execute("PRAGMA synchronous = NORMAL")
            self._base.execute("BEGIN EXCLUSIVE")
            self._base.execute("CREATE TABLE IF NOT EXISTS batches (number INTEGER PRIMARY KEY, keys BLOB, data BLOB)")
            self._base.execute(f"PRAGMA user_version = {_LAYOUT}")
            self._base.execute("COMMIT")
        except sqlite3.OperationalError as error:
            self._base.close()
            raise ContactError(f"{self.path}: another study is writing here ({error})") from error
        except sqlite3.DatabaseError as error:
            self._base.close()
            raise ContactError(f"{self.path} is no file of a study ({error})") from error

    def close(self) -> None:
        """Close the file."""
        self._base.close()

    def add(self, done: Done) -> None:
        """Store results permanently."""
        self._base.execute("INSERT INTO batches (keys, data) VALUES (?, ?)", (done.keys.tobytes(), done.to_bytes()))

    def keys(self) -> Keys:
        """Keys of all stored points, shape (points, 2)."""
        parts = [np.frombuffer(row[0], dtype=np.uint64).reshape(-1, 2)
                 for row in self._base.execute("SELECT keys FROM batches ORDER BY number")]
        return np.concatenate(parts) if parts else np.zeros((0, 2), dtype=np.uint64)

    def numbers(self) -> list[int]:
        """Indices of all batches."""
        return [row[0] for row in self._base.execute("SELECT number FROM batches ORDER BY number")]

    def batch(self, number: int) -> Done:
        """Results of a batch."""
        keys, data = self._base.execute("SELECT keys, data FROM batches WHERE number = ?", (number,)).fetchone()
        return Done.from_bytes(keys, data)

    def size(self) -> int:
        """Size of the results [bytes]."""
        return int(self._base.execute("SELECT total(length(data) + length(keys)) FROM batches").fetchone()[0])


def distinct(keys: Keys) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Indices of the first occurrence of each distinct key, in the order of the keys, and for each key its index among these."""
    order = np.lexsort((keys[:, 1], keys[:, 0]))
    ordered = keys[order]
    is_new = np.ones(len(keys), dtype=bool)
    is_new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    # the sort is stable, so the first of equal keys is the first occurrence
    leaders = order[is_new]
    first = np.sort(leaders)
    number = np.empty(len(keys), dtype=np.intp)
    number[first] = np.arange(len(first))
    inverse = np.empty(len(keys), dtype=np.intp)
    inverse[order] = number[leaders][np.cumsum(is_new) - 1]
    return first, inverse


class Places:
    """Index of points by their keys."""

    def __init__(self, keys: Keys) -> None:
        self._order = np.argsort(keys[:, 0], kind="stable")
        self._sorted = keys[self._order]

    def of(self, keys: Keys) -> NDArray[np.int64]:
        """Index of each key, -1 for unknown keys."""
        if len(self._order) == 0:
            return np.full(len(keys), -1, dtype=np.int64)
        found = np.searchsorted(self._sorted[:, 0], keys[:, 0])
        found = np.minimum(found, len(self._order) - 1)
        equal = (self._sorted[found] == keys).all(axis=1)
        return np.where(equal, self._order[found], -1)
