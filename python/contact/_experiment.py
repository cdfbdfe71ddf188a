"""Experiments in files: reading, converting and explaining both formats of input."""
from __future__ import annotations

import ctypes
import os
import tempfile
from pathlib import Path
from typing import Any

from ._library import library
from .errors import ContactError

_SUFFIXES = (".inp", ".toml")


def explain(path: str | os.PathLike[str]) -> str:
    """Describe in words for every case of an experiment what is simulated and what is not, the methods, and the expected cost.

    Parameters
    ----------
    path
        The input, in either format; without suffix the existing file, ``.inp`` before ``.toml``.

    Raises
    ------
    ContactError
        If the input is invalid. The message has the reason and its position.
    """
    return _text_of("contact_explain_experiment", path)


def convert(path: str | os.PathLike[str], output_dir: str | os.PathLike[str] | None = None, *, overwrite: bool = False) -> Path:
    """Write an experiment in the other format: ``.toml`` for ``.inp``, ``.inp`` for ``.toml``.

    Parameters
    ----------
    path
        The input with its suffix.
    output_dir
        Folder of the new file; that of the input if not given.
    overwrite
        Whether to replace an existing file.

    Returns
    -------
    The new file.
    """
    given = Path(path)
    if given.suffix not in _SUFFIXES:
        raise ContactError(f"{given}: the suffix .inp or .toml is missing")
    message = ctypes.create_string_buffer(65536)
    folder = os.fsencode(output_dir) if output_dir is not None else None
    status = library().contact_convert_experiment(os.fsencode(given), folder, int(overwrite), message, len(message))
    if status != 0:
        raise ContactError(message.value.decode("utf-8", errors="replace").strip())
    new = given.with_suffix(_SUFFIXES[1 - _SUFFIXES.index(given.suffix)])
    return Path(output_dir) / new.name if output_dir is not None else new


def read(path: str | os.PathLike[str], *, complete: bool = False) -> list[dict[str, Any]]:
    """Read the cases of an experiment, in either format.

    Parameters
    ----------
    path
        The input with its suffix.
    complete
        Whether each case has all input that it keeps from earlier cases, without numbers that have preset values.

    Returns
    -------
    One dictionary for each case, with the keys and tables of the readable format. Unless ``complete``, a case has only what
    differs from the previous one, as in the file.

    Raises
    ------
    ContactError
        If the input is invalid. The message has the reason and its position.

    Examples
    --------
    >>> cases = contact.read("cattaneo.inp")
    >>> cases[0]["friction"]["fstat"]
    0.4
    """
    try:
        import tomllib
    except ImportError as reason:
        raise ContactError("contact.read needs Python 3.11 or later, which can read TOML") from reason
    if complete:
        return list(tomllib.loads(_text_of("contact_complete_cases", path))["case"])
    explain(path)
    given = Path(path)
    if given.suffix == ".toml":
        return list(tomllib.loads(given.read_text(encoding="utf-8"))["case"])
    with tempfile.TemporaryDirectory() as folder:
        return list(tomllib.loads(convert(given, folder).read_text(encoding="utf-8"))["case"])


def _text_of(routine: str, path: str | os.PathLike[str]) -> str:
    """Text that a routine of the library writes about an experiment"""
    room = 65536
    while True:
        text = ctypes.create_string_buffer(room)
        needed = ctypes.c_int(0)
        status = getattr(library(), routine)(os.fsencode(path), text, room, ctypes.byref(needed))
        if needed.value <= room:
            break
        room = needed.value
    words = text.value.decode("utf-8", errors="replace")
    if status != 0:
        raise ContactError(words.strip())
    return words
