"""Reader of a study in a file, for `contact study FILE.toml`."""
from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..errors import ContactError
from ._space import Axis, log_span, sample, span, table
from ._study import Study

#: Keys of the tables of a study
_TABLES = ("study", "vary", "sample", "table", "derive")
_STUDY = ("base", "case", "where", "totals", "fields", "folder", "seconds", "results")
_RANGE = ("from", "to", "count", "scale")
_SAMPLE = ("inputs", "count", "method", "seed", "name")
_TABLE = ("file", "columns", "name")


class StudyFile:
    """A study and the files of its results.

    Parameters
    ----------
    file
        Path of the study, in TOML; file names in it are relative to its folder.
    folder
        Folder of computed cases, instead of that of the file.
    """

    def __init__(self, file: str | os.PathLike[str], folder: str | os.PathLike[str] | None = None) -> None:
        path = Path(file)
        content = _read(path)
        _known(content, _TABLES, str(path))
        head = content.get("study", {})
        _known(head, _STUDY, f"{path}, [study]")
        if "base" not in head:
            raise ContactError(f"{path}: [study] needs base, the experiment whose case is varied")
        home = path.resolve().parent
        where = head.get("where", [])
        self.results = [home / name for name in ([head["results"]] if isinstance(head.get("results"), str)
                                                 else head.get("results", []))]
        chosen = Path(folder) if folder is not None else home / head.get("folder", path.stem + ".study")
        self.study = Study(home / head["base"], _vary(content, path, home), case=head.get("case"),
                           where=[where] if isinstance(where, str) else where, derive=content.get("derive"),
                           totals=head.get("totals"), fields=head.get("fields", ()), folder=chosen,
                           seconds=float(head.get("seconds", 0.0)))


def _read(path: Path) -> dict[str, Any]:
    """The content of the file"""
    try:
        import tomllib
    except ImportError as reason:
        raise ContactError("studies in files need Python 3.11 or later, which can read TOML") from reason
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as reason:
        raise ContactError(f"{path} cannot be read: {reason.strerror}") from reason
    except ValueError as reason:
        raise ContactError(f"{path} is no TOML: {reason}") from reason


def _known(found: Mapping[str, Any], keys: tuple[str, ...], where: str) -> None:
    """Refuse unknown keys"""
    for key in found:
        if key not in keys:
            raise ContactError(f"{where}: unknown key '{key}'; accepted: {', '.join(keys)}")


def _vary(content: Mapping[str, Any], path: Path, home: Path) -> list[Any]:
    """The varied inputs, in the order of the file: lists and ranges, samples, tables"""
    parts: list[Any] = []
    for key, value in content.get("vary", {}).items():
        if isinstance(value, Mapping):
            _known(value, _RANGE, f"{path}, {key}")
            missing = [word for word in _RANGE[:3] if word not in value]
            if missing:
                raise ContactError(f"{path}, {key}: a range needs {', '.join(missing)}")
            scale = value.get("scale", "linear")
            if scale not in ("linear", "log"):
                raise ContactError(f"{path}, {key}: scale is \"linear\" or \"log\"")
            made = (log_span if scale == "log" else span)(float(value["from"]), float(value["to"]), int(value["count"]))
            parts.append({key: made})
        else:
            parts.append({key: value})
    for kind in ("sample", "table"):
        parts.extend(_axis(kind, block, path, home) for block in content.get(kind, []))
    return parts


def _axis(kind: str, block: Mapping[str, Any], path: Path, home: Path) -> Axis:
    """A table [[sample]] or [[table]]"""
    where = f"{path}, [[{kind}]]"
    _known(block, _SAMPLE if kind == "sample" else _TABLE, where)
    needed = ("inputs", "count") if kind == "sample" else ("file",)
    for key in needed:
        if key not in block:
            raise ContactError(f"{where} needs {key}")
    try:
        if kind == "sample":
            return sample(block["inputs"], int(block["count"]), block.get("method", "latin_hypercube"), int(block.get("seed", 1)),
                          block.get("name", "sample"))
        return table(home / block["file"], block.get("columns"), block.get("name", "row"))
    except (ValueError, OSError) as reason:
        raise ContactError(f"{where}: {reason}") from reason
