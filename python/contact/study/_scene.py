"""The base of a study: cases in either format, and their text with varied inputs."""
from __future__ import annotations

import copy
import hashlib
import json
import os
import re
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from .._experiment import read
from ..errors import ContactError

#: Inputs that are short for several keys
_TOGETHER = {"friction.coefficient": ("friction.fstat", "friction.fkin")}
#: Keys of a case that are not used in a study
_DROPPED = ("title", "renew")
#: Groups with file names
_FILES = ("rail_profile", "wheel_profile", "influence")


class Scene:
    """Base of a study.

    Parameters
    ----------
    base
        Path of an experiment, in either format, or its cases as returned by :func:`contact.read`.
    case
        Number of the case that is varied, from 1; it includes all input of the cases before it, and starts a new sequence.
        Without it all cases of the experiment are computed in order for each point, with the dimension ``step``.
    folder
        Folder of relative file names, if cases are given.
    """

    def __init__(self, base: str | os.PathLike[str] | Sequence[Mapping[str, Any]] | Mapping[str, Any], case: int | None = None,
                 folder: str | os.PathLike[str] | None = None) -> None:
        if isinstance(base, (str, os.PathLike)):
            given = _with_suffix(Path(base))
            cases = read(given)
            self.folder = given.resolve().parent
        elif not isinstance(base, (Mapping, list, tuple)):
            raise ContactError(f"the base of a study is a file or its cases, not {base!r}")
        else:
            cases = [dict(base)] if isinstance(base, Mapping) else [dict(one) for one in base]
            self.folder = Path(folder or ".").resolve()
        self.cases: list[dict[str, Any]] = copy.deepcopy(cases)
        if not cases:
            raise ContactError("the base of a study has no case")
        if case is not None:
            if not 1 <= case <= len(cases):
                raise ContactError(f"case = {case}: the base has {len(cases)} cases")
            self.cases = [_complete(self.cases[:case])]
        if len(self.cases) == 1:
            # the input of a case must not depend on the previous case
            self.cases[0].update(sequence="initiate", estimate="fresh")
        for one in self.cases:
            for key in _DROPPED[:1]:
                one.pop(key, None)
            one.update(output_level=0, flow_level=0, mat_file=0)
        self.is_wheel_rail = any(one.get("module") in (1, "wheel_rail") for one in self.cases)

    @property
    def steps(self) -> int:
        """Number of cases for each point."""
        return len(self.cases)

    def digest(self) -> bytes:
        """All inputs of the results: the cases, and the contents of the files that they name."""
        found = hashlib.blake2b(json.dumps(self.cases, sort_keys=True).encode(), digest_size=16)
        for one in self.cases:
            for group in _FILES:
                name = one.get(group, {}).get("file")
                if name is not None:
                    found.update(self._contents(name))
        return found.digest()

    def digest_of_files(self, path: str, values: Iterable[Any]) -> list[bytes] | None:
        """Digests of the contents of files that an input names; None if it names none"""
        group, _, key = path.partition(":")[2 if ":" in path else 0].rpartition(".")
        if group not in _FILES or key != "file":
            return None
        listed = list(values)
        made = {value: hashlib.blake2b(self._contents(value), digest_size=8).digest()
                for value in {value for value in listed if isinstance(value, (str, os.PathLike))}}
        return [made[value] if isinstance(value, (str, os.PathLike)) else bytes(8) for value in listed]

    def _contents(self, name: str | os.PathLike[str]) -> bytes:
        """Contents of a file, and of the slices that it names"""
        return b"".join(file.read_bytes() if file.is_file() else b"missing" for file in _with_slices(self.folder / name))

    def refuse_overlaps(self, paths: Sequence[str]) -> None:
        """Refuse inputs that set the same number, such as friction.coefficient and friction.fstat"""
        for path in paths:
            both = [part for part in _TOGETHER.get(path, ()) if part in paths]
            if both:
                raise ContactError(f"{path} and {both[0]} set the same number: only one of them can vary")

    def keys_of(self, path: str) -> tuple[str, ...]:
        """The keys of an input: both for two bodies, or for both coefficients of friction"""
        if path in _TOGETHER:
            return _TOGETHER[path]
        group, _, key = path.rpartition(".")
        table = self.cases[0].get(group) if group else self.cases[0]
        if isinstance(table, dict) and isinstance(table.get(key), list) and len(table[key]) == 2:
            return f"{path}1", f"{path}2"
        return (path,)

    def text(self, words: Mapping[str, Any]) -> str:
        """The cases with varied inputs, in the readable format."""
        return "".join(write_case(one) for one in self._with(words))

    def varied_text(self, words: Mapping[str, Any], numbers: Mapping[str, float]) -> tuple[str, list[str]]:
        """The case with varied inputs, followed by one with some numbers only; and the keys of these numbers in their order."""
        keys = [key for path in numbers for key in self.keys_of(path)]
        second: dict[str, Any] = {}
        for path, value in numbers.items():
            for key in self.keys_of(path):
                _put(second, key, value)
        return self.text({**words, **numbers}) + write_case(second), keys

    def _with(self, words: Mapping[str, Any]) -> list[dict[str, Any]]:
        """A copy of the cases with varied inputs"""
        cases = copy.deepcopy(self.cases)
        for path, value in words.items():
            step, colon, rest = path.partition(":")
            if colon:
                if not step.isdigit() or not 1 <= int(step) <= len(cases):
                    raise ContactError(f"{path}: the base has cases 1 to {len(cases)}")
                for key in self.keys_of(rest):
                    _put(cases[int(step) - 1], key, value)
                continue
            for key in self.keys_of(path):
                _put(cases[0], key, value)
                for later in cases[1:]:
                    if _gives(later, key):
                        _put(later, key, value)
        return cases


def _with_suffix(path: Path) -> Path:
    """Path of an experiment that may be given without suffix"""
    if path.suffix in (".inp", ".toml"):
        return path
    for suffix in (".inp", ".toml"):
        file = path.with_name(path.name + suffix)
        if file.is_file():
            return file
    raise ContactError(f"{path}: there is neither {path.name}.inp nor {path.name}.toml")


def _with_slices(file: Path) -> list[Path]:
    """Paths of a profile: the file itself, and for a file of slices also the slices, whose names are in quotes"""
    if file.suffix.lower() not in (".slcs", ".slcw") or not file.is_file():
        return [file]
    names = re.findall("'([^']+)'", file.read_text(encoding="utf-8", errors="replace"))
    return [file] + [file.parent / name.replace("\\", "/") for name in dict.fromkeys(names)]


def _complete(cases: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """The last of some cases, with all that it keeps from earlier ones"""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "cases.toml")
        path.write_text("".join(write_case(one) for one in cases), encoding="utf-8")
        last = read(path, complete=True)[-1]
    for key in (*_DROPPED, "solve"):
        last.pop(key, None)
    return last


def _gives(case: Mapping[str, Any], key: str) -> bool:
    """Does a case contain an input itself?"""
    group, _, name = key.rpartition(".")
    table = case.get(group) if group else case
    return isinstance(table, dict) and (name in table or (name[-1:] in "12" and name[:-1] in table))


def _put(case: dict[str, Any], key: str, value: Any) -> None:
    """Set an input of a case"""
    group, _, name = key.rpartition(".")
    table = case.setdefault(group, {}) if group else case
    if not isinstance(table, dict):
        raise ContactError(f"{key}: {group} is no table of the base")
    stem = name[:-1]
    if name[-1:] in ("1", "2") and isinstance(table.get(stem), list) and len(table[stem]) == 2:
        table[stem][int(name[-1]) - 1] = value
    else:
        table[name] = value


def write_case(case: Mapping[str, Any]) -> str:
    """A case in the readable format."""
    lines = ["[[case]]"]
    groups = []
    for key, value in case.items():
        if isinstance(value, Mapping):
            groups.append((key, value))
        else:
            lines.append(f"{key} = {_value(value)}")
    for key, group in groups:
        lines.append(f"[case.{key}]")
        lines.extend(f"{name} = {_value(value)}" for name, value in group.items())
    return "\n".join(lines) + "\n"


def _value(value: Any) -> str:
    """A value in TOML"""
    if hasattr(value, "item"):
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        if value != value or value in (float("inf"), float("-inf")):
            # the readable format has no such value; its reader refuses the case
            return '"not a finite number"'
        return repr(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{name} = {_value(one)}" for name, one in value.items()) + "}"
    if isinstance(value, Sequence):
        return "[" + ", ".join(_value(one) for one in value) + "]"
    raise ContactError(f"{value!r} cannot be an input: numbers, words and lists can")
