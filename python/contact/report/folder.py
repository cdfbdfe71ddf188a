"""Experiments of a folder and its subfolders, as shown by the server."""
from __future__ import annotations

import os
import stat
from typing import Any

from .read import MissingResults, run_of

#: Formats of an input, in the order in which the program searches them
FORMATS = ("inp", "toml")
#: Suffixes of profiles that are offered for a new experiment
PROFILES = (".prr", ".prw", ".rail", ".wheel", ".whl", ".ban", ".slcs")
#: Maximum size of a displayed input [bytes], number of entries read of a folder, and depth of subfolders
MAX_BYTES, MAX_ENTRIES, MAX_LEVELS = 1_000_000, 20_000, 12


class Folder:
    """The inputs of one folder, by names like `run7` and `study/run7`"""

    def __init__(self, path: str) -> None:
        if not os.path.isdir(path):
            raise MissingResults("%s is not a folder" % path)
        self.path = os.path.realpath(path)
        self._runs: dict[str, tuple[tuple[float, int], dict[str, Any] | None]] = {}

    def place(self, folder: str) -> str | None:
        """Path of a subfolder; None if it is hidden, a link, or not a folder"""
        parts = folder.split("/") if folder else []
        if len(parts) > MAX_LEVELS or any(not part or part.startswith(".") or "\0" in part or os.sep in part for part in parts):
            return None
        path = os.path.join(self.path, *parts)
        return path if os.path.isdir(path) and os.path.realpath(path) == path else None

    def folders(self, folder: str = "") -> list[str]:
        """Names of the folders in a folder"""
        path = self.place(folder)
        return [] if path is None else sorted(entry.name for entry in self._entries(path)
                                              if entry.is_dir(follow_symlinks=False) and not entry.name.startswith("."))

    def names(self, folder: str = "") -> list[str]:
        """Names of experiments in a folder: regular files of this folder, without links to other folders"""
        return sorted(self._inputs(folder))

    def _inputs(self, folder: str) -> dict[str, list[str]]:
        """Existing formats of each experiment of a folder"""
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
                if len(found) == MAX_ENTRIES:
                    break
        return found

    def input(self, name: str) -> str | None:
        """Path with suffix of the input that the program would use for an experiment; None if there is none"""
        formats = self._inputs(name.rpartition("/")[0]).get(name)
        return os.path.join(self.path, *name.split("/")) + "." + formats[0] if formats else None

    def text(self, name: str, form: str) -> str | None:
        """Text of an input"""
        if form not in self._inputs(name.rpartition("/")[0]).get(name, []):
            return None
        with open(os.path.join(self.path, *name.split("/")) + "." + form, "rb") as file:
            data = file.read(MAX_BYTES + 1)
        return data[:MAX_BYTES].decode("utf-8", "replace") + ("\n... the file is longer\n" if len(data) > MAX_BYTES else "")

    def profiles(self, folder: str = "") -> list[str]:
        """Profiles in a folder and its direct subfolders, relative to the folder"""
        found: list[str] = []
        for below in ["", *self.folders(folder)]:
            path = self.place("/".join(part for part in (folder, below) if part))
            found.extend((below + "/" if below else "") + entry.name for entry in (self._entries(path) if path is not None else [])
                         if entry.name.lower().endswith(PROFILES) and entry.is_file(follow_symlinks=False))
        return sorted(found)

    def result(self, name: str) -> tuple[str, float | None]:
        """Path of the .h5 file of an experiment, and its modification time; None instead of a time unless it is a regular file"""
        path = os.path.join(self.path, *name.split("/")) + ".h5"
        try:
            status = os.lstat(path)
        except OSError:
            return path, None
        return path, status.st_mtime if stat.S_ISREG(status.st_mode) else None

    def run_of_result(self, path: str) -> dict[str, Any] | None:
        """Progress of the run that wrote a result; the file is opened once for each of its versions"""
        status = os.lstat(path)
        version = status.st_mtime, status.st_size
        if path not in self._runs or self._runs[path][0] != version:
            self._runs[path] = version, run_of(path)
        return self._runs[path][1]

    def list(self, folder: str = "") -> list[dict[str, Any]]:
        """The experiments of a folder: name, formats, size and time of the input, state of the results"""
        files = []
        for name, formats in sorted(self._inputs(folder).items()):
            status = os.stat(os.path.join(self.path, *name.split("/")) + "." + formats[0])
            path, changed = self.result(name)
            about = {"name": name, "formats": formats, "size": status.st_size, "changed": status.st_mtime,
                     "result": "none" if changed is None else "fresh" if changed >= status.st_mtime else "old"}
            files.append({**about, "run": None if changed is None else self.run_of_result(path)})
        return files
