"""Many cases in one call of the library: include/contact.h, contact_batch_*."""
from __future__ import annotations

import ctypes
import os
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .._handle import Handle
from .._library import library
from ..errors import ContactError

Numbers = NDArray[np.float64]

#: Sizes of the buffers of a reason and of a text of a column [bytes]
_REASON, _TEXT = 400, 120
#: Maximum number of columns
_COLUMNS = 128

#: The library after its argument types have been declared
_ready: ctypes.CDLL | None = None


class _Job(ctypes.Structure):
    """contact_batch_job"""
    _fields_ = [("text", ctypes.c_char_p), ("folder", ctypes.c_char_p), ("names", ctypes.c_char_p),
                ("numbers", ctypes.c_int), ("sets", ctypes.c_int), ("given", ctypes.c_void_p),
                ("room_rows", ctypes.c_int), ("room_columns", ctypes.c_int), ("room_cases", ctypes.c_int),
                ("values", ctypes.c_void_p), ("places", ctypes.c_void_p), ("states", ctypes.c_void_p),
                ("reasons", ctypes.c_void_p), ("reason_length", ctypes.c_int),
                ("rows", ctypes.c_int), ("cases", ctypes.c_int), ("columns", ctypes.c_int)]


@dataclass(frozen=True)
class Column:
    """Description of a total.

    Attributes
    ----------
    name, unit, meaning
        As in the tables of doc/user/results.md.
    of_pair
        Whether it belongs to wheel and rail together, not to a patch.
    is_count
        Whether it is an integer.
    """

    name: str
    unit: str
    meaning: str
    of_pair: bool
    is_count: bool


@dataclass
class Solved:
    """Results of a call.

    Attributes
    ----------
    columns
        Description of each column of values.
    values
        Totals, shape (rows, columns); NaN where a total does not exist.
    places
        Index of the case, from 0, and number of the patch of each row, shape (rows, 2); patch 0: wheel and rail together.
    states
        Status of each case, 0 solved, 1 not converged, 2 refused, and code of the missed condition, shape (cases, 2).
    reasons
        Why a case was not solved, "" for one that was.
    """

    columns: list[Column]
    values: Numbers
    places: NDArray[np.intc]
    states: NDArray[np.intc]
    reasons: list[str]


def _prototypes() -> ctypes.CDLL:
    """The library with declared argument types"""
    global _ready
    loaded = library()
    if loaded is _ready:
        return loaded
    if not hasattr(loaded, "contact_batch_open"):
        raise ContactError("The library is older than studies; rebuild it, or set CONTACT_LIBRARY to a newer one")
    loaded.contact_batch_open.argtypes = [ctypes.c_int, ctypes.c_double]
    loaded.contact_batch_open.restype = ctypes.c_void_p
    loaded.contact_batch_close.argtypes = [ctypes.c_void_p]
    loaded.contact_batch_close.restype = None
    loaded.contact_batch_solve.argtypes = [ctypes.c_void_p, ctypes.POINTER(_Job), ctypes.c_char_p, ctypes.c_int]
    loaded.contact_batch_column.argtypes = [ctypes.c_void_p, ctypes.c_int, *3 * [ctypes.c_char_p], ctypes.c_int]
    whole = ctypes.POINTER(ctypes.c_int)
    loaded.contact_batch_field.argtypes = [ctypes.c_void_p, ctypes.c_int, ctypes.c_char_p, whole, whole,
                                           ctypes.POINTER(ctypes.c_double), ctypes.c_char_p, ctypes.c_int]
    loaded.contact_batch_field_values.argtypes = [ctypes.c_void_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_int, ctypes.c_void_p]
    _ready = loaded
    return loaded


class Batch(Handle):
    """Data that the library keeps from call to call; not to be used by several threads at the same time.

    Parameters
    ----------
    threads
        Number of threads of each calculation.
    seconds
        Time limit of each case [s]; 0: none.
    """

    _closer = "contact_batch_close"

    def __init__(self, threads: int = 1, seconds: float = 0.0) -> None:
        self._library = _prototypes()
        self._handle = self._library.contact_batch_open(threads, seconds)
        if not self._handle:
            raise ContactError("there is no memory for a batch")
        self._columns: list[Column] = []

    def solve(self, text: str, folder: str | os.PathLike[str] = "", names: Sequence[str] = (), given: Numbers | None = None,
              *, cases: int = 1, patches: int = 1) -> Solved:
        """Solve cases.

        Parameters
        ----------
        text
            Cases in the readable format.
        folder
            Folder of relative file names.
        names, given
            Paths "group.key" of the numbers that vary, and their values of shape (sets, numbers): the second case of the text is
            solved for each set. Without names the cases of the text are solved one after the other.
        cases
            Number of cases of the text, without names.
        patches
            Maximum number of rows of a case: 1 for basic contact, 1 + maximum number of patches for wheel and rail.

        Raises
        ------
        ContactError
            If the text cannot be read.
        """
        sets = np.ascontiguousarray(np.empty((0, 0)) if given is None else given, dtype=np.float64)
        if names:
            cases = len(sets)
        values = np.full((cases * patches, _COLUMNS), np.nan)
        places = np.zeros((cases * patches, 2), dtype=np.intc)
        states = np.zeros((cases, 2), dtype=np.intc)
        reasons = np.zeros((cases, _REASON), dtype=np.uint8)
        job = _Job(text.encode(), os.fsencode(folder), "\n".join(names).encode(), len(names), len(sets), sets.ctypes.data,
                   len(values), _COLUMNS, cases, values.ctypes.data, places.ctypes.data, states.ctypes.data,
                   reasons.ctypes.data, _REASON)
        message = ctypes.create_string_buffer(2000)
        status = self._library.contact_batch_solve(self._handle, ctypes.byref(job), message, len(message))
        if status != 0:
            raise ContactError(message.value.decode("utf-8", errors="replace"), status)
        self._describe_columns(job.columns)
        rows = job.rows
        places = places[:rows]
        places[:, 0] -= 1
        sentences = [""] * job.cases
        for k in np.flatnonzero(states[:job.cases, 0]):
            sentences[k] = bytes(reasons[k]).split(b"\0", 1)[0].decode("utf-8", errors="replace")
        return Solved(self._columns[:job.columns], values[:rows, :job.columns], places, states[:job.cases], sentences)

    def _describe_columns(self, count: int) -> None:
        """Get the descriptions of new columns from the library"""
        for number in range(len(self._columns) + 1, count + 1):
            name, unit, meaning = (ctypes.create_string_buffer(_TEXT) for _ in range(3))
            kind = self._library.contact_batch_column(self._handle, number, name, unit, meaning, _TEXT)
            words = [text.value.decode() for text in (name, unit, meaning)]
            self._columns.append(Column(words[0], words[1], words[2], kind >= 2, kind % 2 == 1))

    def field(self, name: str, patch: int = 1) -> tuple[Numbers, tuple[float, float, float, float], str] | None:
        """An element field of the last solved case.

        Returns
        -------
        Values of shape (my, mx); x and y of the first centre and sides of an element [mm]; unit. None if there is no such field.
        """
        mx, my = ctypes.c_int(), ctypes.c_int()
        frame = (ctypes.c_double * 4)()
        unit = ctypes.create_string_buffer(_TEXT)
        if self._library.contact_batch_field(self._handle, patch, name.encode(), ctypes.byref(mx), ctypes.byref(my), frame, unit,
                                             _TEXT) != 0:
            return None
        values = np.empty((my.value, mx.value))
        if self._library.contact_batch_field_values(self._handle, patch, name.encode(), values.size, values.ctypes.data) != 0:
            return None
        x, y, dx, dy = frame
        return values, (x, y, dx, dy), unit.value.decode()
