"""Find and load the shared library, and call its routines with Python values."""
from __future__ import annotations

import ctypes
import ctypes.util
import functools
import hashlib
import os
import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ._signatures import SIGNATURES
from .errors import ContactError

_KINDS = {"i": ctypes.c_int, "d": ctypes.c_double}
_ARRAYS = {"I": np.intc, "D": np.float64}

_library: ctypes.CDLL | None = None
_parsed: dict[str, list[tuple[str, bool, str]]] = {}


def _names() -> tuple[str, ...]:
    """File names of the library on this system"""
    if sys.platform == "win32":
        return "contact.dll", "libcontact.dll", "contact_addon_win64.dll"
    if sys.platform == "darwin":
        return "libcontact.dylib", "contact_addon_maci64.dylib"
    return "libcontact.so", "contact_addon_linux64.so"


def candidates() -> list[str]:
    """Paths at which the library is searched, in this order; see doc/user/python.md."""
    chosen = os.environ.get("CONTACT_LIBRARY")
    if chosen:
        return [chosen]
    here = Path(__file__).resolve().parent
    top = here.parent.parent
    # the last one is bin of an installation that has the package in share/contact/python
    folders = [here, top / "build/release/lib", top / "build/release/bin", top / "bin", top / "lib", top.parent.parent / "bin"]
    found = [str(folder / name) for folder in folders for name in _names() if (folder / name).is_file()]
    system = ctypes.util.find_library("contact")
    return found + ([system] if system else []) + list(_names())


def library() -> ctypes.CDLL:
    """The shared library, loaded at the first call.

    Raises
    ------
    ContactError
        If it is not found, cannot be loaded, or is another library.
    """
    global _library
    if _library is not None:
        return _library
    reasons = []
    for name in candidates():
        try:
            loaded = ctypes.CDLL(name)
            for routine in ("cntc_initialize", "contact_last_error"):
                getattr(loaded, routine)
        except (OSError, AttributeError) as error:
            reasons.append(f"  {name}: {error}")
            continue
        _library = loaded
        return loaded
    raise ContactError("The library of CONTACT is not found; build it, or set CONTACT_LIBRARY to its path. Tried:\n"
                       + "\n".join(reasons))


@functools.lru_cache(maxsize=4)
def _digest(path: str, size: int, time: int) -> str:
    """Hash of a file, computed once for each of its versions"""
    found = hashlib.blake2b(digest_size=16)
    with open(path, "rb") as file:
        for portion in iter(lambda: file.read(1 << 20), b""):
            found.update(portion)
    return found.hexdigest()


def fingerprint() -> str:
    """Hash of the file of the loaded library; its name if the system found it on its search path."""
    name = str(library()._name)
    try:
        about = os.stat(name)
    except OSError:
        return name
    return _digest(name, about.st_size, about.st_mtime_ns)


def _arguments(name: str) -> list[tuple[str, bool, str]]:
    """Name, whether it is a result, and kind of each argument"""
    if name not in _parsed:
        parts = (part.partition(":") for part in SIGNATURES[name].split())
        _parsed[name] = [(left, right.startswith(">"), right[-1]) for left, _, right in parts]
    return _parsed[name]


def call(name: str, *values: Any) -> Any:
    """Call a routine; single results are returned, arrays of results are filled.

    Parameters
    ----------
    name
        Name of the routine, for instance ``cntc_setflags``.
    values
        The arguments in the order of the header without the single results: numbers, text, sequences of
        numbers for arrays, and for an array of results a contiguous numpy array of the right type.

    Returns
    -------
    The single results, a number or a tuple of numbers, None if there are none. A refused call leaves them 0.
    """
    given = iter(values)
    passed: list[Any] = []
    results: list[Any] = []
    keep: list[Any] = []
    for argument, is_result, kind in _arguments(name):
        if is_result and kind in _KINDS:
            results.append(_KINDS[kind](0))
            passed.append(ctypes.byref(results[-1]))
            continue
        value = next(given)
        if kind in _KINDS:
            number = ctypes.c_int(int(value)) if kind == "i" else ctypes.c_double(float(value))
            passed.append(ctypes.byref(number))
        elif kind == "s":
            passed.append(ctypes.c_char_p(value))
        elif is_result:
            if value.dtype != _ARRAYS[kind] or not value.flags.c_contiguous or not value.flags.writeable:
                raise TypeError(f"{name}: {argument} has to be a contiguous array of {_ARRAYS[kind].__name__}")
            passed.append(ctypes.c_void_p(value.ctypes.data))
        else:
            keep.append(np.ascontiguousarray(value, dtype=_ARRAYS[kind]))
            passed.append(ctypes.c_void_p(keep[-1].ctypes.data))
    remaining = sum(1 for _ in given)
    if remaining:
        raise TypeError(f"{name}: {remaining} values too many")
    routine = getattr(library(), name)
    routine.restype = None
    routine(*passed)
    if len(results) == 1:
        return results[0].value
    return tuple(result.value for result in results) or None


def text(value: str | os.PathLike[str] | None) -> tuple[bytes, int]:
    """A text as passed to the library: bytes and their number; None and blank mean not given"""
    encoded = os.fspath(value).encode("utf-8") if value is not None else b""
    return encoded, len(encoded)


def unmasked(values: ArrayLike) -> ArrayLike:
    """Values as they are; those of a masked array only if no element is masked, and no complex numbers"""
    if np.ma.is_masked(values):
        raise ValueError("a masked array with masked elements cannot be used: masked elements have no value")
    if np.iscomplexobj(values):
        raise ValueError("complex numbers cannot be used: real numbers are needed")
    return values


def last_error(ire: int = 0, icp: int = -1) -> tuple[int, str]:
    """Code and text of the last error of a problem, or with ire = 0 of the library, since the last call of this function;
    (0, "") if there was none. Code 0 with a text is a warning."""
    room = ctypes.create_string_buffer(2000)
    code = library().contact_last_error(ire, icp, room, len(room))
    return code, room.value.decode("utf-8", errors="replace")


def case_status(ire: int = 1, icp: int = -1) -> tuple[str, str]:
    """Status of the last calculation of a problem, "solved", "not converged" or "refused", and the reason in one sentence;
    "checked" if only the input was checked; ("", "") before the first calculation."""
    room = ctypes.create_string_buffer(2000)
    state = library().contact_case_status(ire, icp, None, room, len(room))
    reason = room.value.decode("utf-8", errors="replace")
    words = {-1: "checked" if reason else "", 0: "solved", 1: "not converged", 2: "refused"}
    return words.get(state, ""), reason
