"""What a study has computed: one file that is complete after every batch, whatever happens to its process."""
from __future__ import annotations

import os
import sqlite3
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import ContactError
from ._task import Done

#: Name of the file, and number of its layout
FILE = "cases.sqlite"
_LAYOUT = 1

Keys = NDArray[np.uint64]


class Store:
    """Results by the keys of their points, in a file of SQLite: a batch is there as a whole or not at all.

    Parameters
    ----------
    folder
        Where the file is, made if need be; None keeps results in memory.

    Raises
    ------
    ContactError
        If another study writes into it, or if it is something else.
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
        # whoever holds the file writes within moments, unless it is another study
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
        """Keep results for good."""
        self._base.execute("INSERT INTO batches (keys, data) VALUES (?, ?)", (done.keys.tobytes(), done.to_bytes()))

    def keys(self) -> Keys:
        """Keys of all points that are there, shape (points, 2)."""
        parts = [np.frombuffer(row[0], dtype=np.uint64).reshape(-1, 2)
                 for row in self._base.execute("SELECT keys FROM batches ORDER BY number")]
        return np.concatenate(parts) if parts else np.zeros((0, 2), dtype=np.uint64)

    def numbers(self) -> list[int]:
        """Numbers of all batches."""
        return [row[0] for row in self._base.execute("SELECT number FROM batches ORDER BY number")]

    def batch(self, number: int) -> Done:
        """Results of a batch."""
        keys, data = self._base.execute("SELECT keys, data FROM batches WHERE number = ?", (number,)).fetchone()
        return Done.from_bytes(keys, data)

    def size(self) -> int:
        """Bytes that the results take."""
        return int(self._base.execute("SELECT total(length(data) + length(keys)) FROM batches").fetchone()[0])


def distinct(keys: Keys) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Where each different key stands first, in ascending order, and for each key its number among these."""
    order = np.lexsort((keys[:, 1], keys[:, 0]))
    ordered = keys[order]
    is_new = np.ones(len(keys), dtype=bool)
    is_new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    # equal keys keep their order when they are sorted
    leaders = order[is_new]
    first = np.sort(leaders)
    number = np.empty(len(keys), dtype=np.intp)
    number[first] = np.arange(len(first))
    inverse = np.empty(len(keys), dtype=np.intp)
    inverse[order] = number[leaders][np.cumsum(is_new) - 1]
    return first, inverse


class Places:
    """Places of points by their keys."""

    def __init__(self, keys: Keys) -> None:
        self._order = np.argsort(keys[:, 0], kind="stable")
        self._sorted = keys[self._order]

    def of(self, keys: Keys) -> NDArray[np.int64]:
        """Place of each key, -1 where there is none."""
        if len(self._order) == 0:
            return np.full(len(keys), -1, dtype=np.int64)
        found = np.searchsorted(self._sorted[:, 0], keys[:, 0])
        found = np.minimum(found, len(self._order) - 1)
        equal = (self._sorted[found] == keys).all(axis=1)
        return np.where(equal, self._order[found], -1)
