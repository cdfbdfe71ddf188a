"""One run of the program for the server, and its messages."""
from __future__ import annotations

import os
import re
import shutil
import subprocess
import threading
import time
from typing import Any

from .read import MissingResults

#: Maximum number of stored messages of a run
MAX_MESSAGES = 20000
#: Time limits: of the current case of a run that is to end [s], and of counting the cases of an input [s]
LAST_CASE, COUNT_TIME = 2.0, 600.0
#: Patterns of the first line of a case, and of the line with the number of cases of an input
CASE, COUNT = re.compile(rb" Case +\d+"), re.compile(r": (\d+) cases? checked")


def program_path() -> str:
    """The program: named by CONTACT_PROGRAM, or on the search path"""
    named = os.environ.get("CONTACT_PROGRAM")
    found = shutil.which(named or "contact")
    if not found:
        raise MissingResults("the program contact is not found; name it by the environment variable CONTACT_PROGRAM")
    return os.path.abspath(found)


def count_of(path: str) -> int | None:
    """Number of cases of an input, as reported by a check of the program; None without a report"""
    try:
        run = subprocess.run([program_path(), "--confine", "--", "3", path], cwd=os.path.dirname(path), stdin=subprocess.DEVNULL,
                             capture_output=True, text=True, errors="replace", timeout=COUNT_TIME, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return None
    found = COUNT.search(run.stdout)
    return int(found[1]) if found else None


class Job:
    """One run of the program; its messages are stored, so that every listener receives all of them"""

    def __init__(self, name: str, path: str, mode: str) -> None:
        self.name, self.mode, self.path = name, mode, path
        self.messages: list[tuple[str, Any]] = []
        self.done, self.stopping = False, False
        self.status: int | None = None
        self.started = time.time()
        self.ended: float | None = None
        self.begun = 0
        self.planned: int | None = None
        self.news = threading.Condition()
        # the path is that of an existing input; after -- it cannot be read as an option
        command = [program_path(), "--confine", *(["--hdf5"] if mode == "run" else []), "--", "2" if mode == "run" else "3", path]
        self.process = subprocess.Popen(command, cwd=os.path.dirname(path), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT, start_new_session=True)
        threading.Thread(target=self._listen, daemon=True).start()
        if mode == "run":
            threading.Thread(target=self._count, daemon=True).start()

    def state(self) -> dict[str, Any]:
        """State of the job, for a page that is opened later"""
        with self.news:
            return {"name": self.name, "mode": self.mode, "done": self.done, "status": self.status, "stopping": self.stopping,
                    "seconds": (self.ended or time.time()) - self.started, **self._progress()}

    def _progress(self) -> dict[str, Any]:
        return {"begun": self.begun, "planned": self.planned}

    def _publish(self, kind: str, value: Any) -> None:
        with self.news:
            self.messages.append((kind, value))
            if kind == "end":
                self.done, self.status, self.ended = True, value, time.time()
            self.news.notify_all()

    def _count(self) -> None:
        planned = count_of(self.path)
        with self.news:
            self.planned = planned
            self.news.notify_all()

    def _listen(self) -> None:
        assert self.process.stdout is not None
        with self.process.stdout as lines:
            for number, line in enumerate(lines):
                if CASE.match(line):
                    with self.news:
                        self.begun += 1
                if number < MAX_MESSAGES:
                    self._publish("line", line[:1000].decode("utf-8", "replace").rstrip("\r\n"))
                elif number == MAX_MESSAGES:
                    self._publish("line", "There are more messages; the .out file has them.")
        self._publish("end", self.process.wait())

    def follow(self, sent: int, patience: float) -> tuple[list[tuple[str, Any]], dict[str, Any], bool]:
        """Waits for messages beyond the first `sent` ones, at most `patience` seconds; returns them, the progress of the run, and
        whether it has ended"""
        with self.news:
            before = self._progress()
            if sent == len(self.messages) and not self.done:
                self.news.wait_for(lambda: sent < len(self.messages) or self.done or self._progress() != before, patience)
            return self.messages[sent:], self._progress(), self.done

    def stop(self) -> None:
        """Stop the run: the first call ends it after the current case, the second one at once"""
        if not self.done:
            self.stopping = True
            self.process.terminate()

    def end(self) -> None:
        """End the run; its files are closed if the current case ends in time"""
        self.stop()
        try:
            self.process.wait(LAST_CASE)
        except subprocess.TimeoutExpired:
            self.process.kill()
