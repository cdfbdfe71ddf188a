"""Experiments of a folder and of the folders below it, as the server shows them."""
from __future__ import annotations

import os
import stat
from typing import Any

from .read import MissingResults, run_of

#: Formats of an input, in the order in which the program looks for them
FORMATS = ("inp", "toml")
#: Endings of profiles that a new experiment can name
PROFILES = (".prr", ".prw", ".rail", ".wheel", ".whl", ".ban", ".slcs")
#: Longest input that is shown [bytes], entries of a folder that are looked at, and levels of folders
MOST_BYTES, MOST_ENTRIES, MOST_LEVELS = 1_000_000, 20_000, 12


class Folder:
    """The inputs of one folder, by names like `run7` and `study/run7`"""

    def __init__(self, path: str) -> None:
        if not os.path.isdir(path):
            raise MissingResults("%s is no folder" % path)
        self.path = os.path.realpath(path)
        self._told: dict[str, tuple[tuple[float, int], dict[str, Any] | None]] = {}

    def place(self, folder: str) -> str | None:
        """Path of a folder below this one; None for hidden ones, links, and what is none"""
        parts = folder.split("/") if folder else []
        if len(parts) > MOST_LEVELS or any(not part or part.startswith(".") or "\0" in part or os.sep in part for part in parts):
            return None
        path = os.path.join(self.path, *parts)
        return path if os.path.isdir(path) and os.path.realpath(path) == path else None

    def folders(self, folder: str = "") -> list[str]:
        """Names of the folders in a folder"""
        path = self.place(folder)
        return [] if path is None else sorted(entry.name for entry in self._entries(path)
                                              if entry.is_dir(follow_symlinks=False) and not entry.name.startswith("."))

    def names(self, folder: str = "") -> list[str]:
        """Names of experiments in a folder: ordinary files of this folder, no links that lead out of it"""
        return sorted(self._inputs(folder))

    def _inputs(self, folder: str) -> dict[str, list[str]]:
        """Formats in which the experiments of a folder are there"""
        path = self.place(folder)
        found: dict[str, list[str]] = {}
        for entry in self._entries(path) if path is not None else []:
            base, _, suffix = entry.name.rpartition(".")
            if base and suffix in FORMATS and entry.is_file() and os.path.dirname(os.path.realpath(entry.path)) == path:
                found.setdefault((folder + "/" if folder else "") + base, []).append(suffix)
        return {name: sorted(formats, key=FORMATS.index) for name, formats in found.items()}

    @staticmethod
    def _entries(path: str) -> list[os.DirEntry[str]]:
        found: list[os.DirEntry[str]] = []
        with os.scandir(path) as entries:
            for entry in entries:
                found.append(entry)
                if len(found) == MOST_ENTRIES:
                    break
        return found

    def input(self, name: str) -> str | None:
        """Path of the input of an experiment with its suffix, the one that the program takes; None if there is none"""
        formats = self._inputs(name.rpartition("/")[0]).get(name)
        return os.path.join(self.path, *name.split("/")) + "." + formats[0] if formats else None

    def text(self, name: str, form: str) -> str | None:
        """What stands in an input"""
        if form not in self._inputs(name.rpartition("/")[0]).get(name, []):
            return None
        with open(os.path.join(self.path, *name.split("/")) + "." + form, "rb") as file:
            data = file.read(MOST_BYTES + 1)
        return data[:MOST_BYTES].decode("utf-8", "replace") + ("\n... the file is longer\n" if len(data) > MOST_BYTES else "")

    def profiles(self, folder: str = "") -> list[str]:
        """Profiles in a folder and in those directly below it, relative to the folder"""
        found: list[str] = []
        for below in ["", *self.folders(folder)]:
            path = self.place("/".join(part for part in (folder, below) if part))
            found.extend((below + "/" if below else "") + entry.name for entry in (self._entries(path) if path is not None else [])
                         if entry.name.lower().endswith(PROFILES) and entry.is_file(follow_symlinks=False))
        return sorted(found)

    def result(self, name: str) -> tuple[str, float | None]:
        """The .h5 file of an experiment and when it was changed; None unless it is an ordinary file, and no link to one"""
        path = os.path.join(self.path, *name.split("/")) + ".h5"
        try:
            status = os.lstat(path)
        except OSError:
            return path, None
        return path, status.st_mtime if stat.S_ISREG(status.st_mode) else None

    def told_of(self, path: str) -> dict[str, Any] | None:
        """How far the run came that wrote a result; the file is opened once for each of its versions"""
        status = os.lstat(path)
        version = status.st_mtime, status.st_size
        if path not in self._told or self._told[path][0] != version:
            self._told[path] = version, run_of(path)
        return self._told[path][1]

    def list(self, folder: str = "") -> list[dict[str, Any]]:
        """The experiments of a folder: name, formats, size and time of the input, and what there is of results"""
        files = []
        for name, formats in sorted(self._inputs(folder).items()):
            status = os.stat(os.path.join(self.path, *name.split("/")) + "." + formats[0])
            path, changed = self.result(name)
            about = {"name": name, "formats": formats, "size": status.st_size, "changed": status.st_mtime,
                     "result": "none" if changed is None else "fresh" if changed >= status.st_mtime else "old"}
            files.append({**about, "run": None if changed is None else self.told_of(path)})
        return files
