"""Progress of a study, on a terminal or in a notebook."""
from __future__ import annotations

import sys
import time
from typing import Any, Callable, TextIO, Union

#: Values of the argument `progress`: on, off, automatic (None), or a function that receives the text
ShowProgress = Union[bool, None, Callable[[str], None]]


def duration(seconds: float) -> str:
    """A time in words: "40 s", "12 min", "3.5 h", "2.1 days"."""
    for limit, divisor, unit in ((99.5, 1.0, "s"), (5970.0, 60.0, "min"), (172800.0, 3600.0, "h")):
        if seconds < limit:
            value = seconds / divisor
            return f"{value:.1f} {unit}" if value < 9.95 else f"{value:.0f} {unit}"
    return f"{seconds / 86400.0:.1f} days"


class Progress:
    """Reports the progress, at most four times a second.

    Parameters
    ----------
    total
        Number of points to be computed.
    there
        Number of points that were computed before.
    requested
        Value of the argument `progress`.
    """

    def __init__(self, total: int, there: int, requested: ShowProgress, stream: TextIO | None = None) -> None:
        self._total, self._there = total, there
        self._stream = sys.stderr if stream is None else stream
        self._report: Callable[[str], None] | None = None
        if callable(requested):
            self._report = requested
        elif requested or (requested is None and (self._stream.isatty() or _in_notebook())):
            self._report = self._show
        self._begin = self._last = time.monotonic()
        self._done = self._failed = self._width = 0

    def add(self, points: int, failed: int) -> None:
        """Add computed points, some of them not solved."""
        self._done += points
        self._failed += failed
        now = time.monotonic()
        if self._report is not None and (now - self._last > 0.25 or self._done == self._total):
            self._last = now
            self._report(self.words())

    def words(self) -> str:
        """The current progress in words."""
        elapsed = time.monotonic() - self._begin
        text = f"{self._there + self._done} of {self._there + self._total} points"
        if self._failed:
            text += f", {self._failed} not solved"
        if self._done:
            left = elapsed / self._done * (self._total - self._done)
            text += f", {1e3 * elapsed / self._done:.3g} ms each, {duration(left)} left"
        return text

    def close(self) -> None:
        """End the line of the last report."""
        if self._width:
            print(file=self._stream)

    def _show(self, words: str) -> None:
        print("\r" + words.ljust(self._width), end="", file=self._stream, flush=True)
        self._width = len(words)


def _in_notebook() -> bool:
    """Is this process the kernel of a notebook?"""
    shell: Any = sys.modules.get("IPython")
    found = shell.get_ipython() if shell is not None and hasattr(shell, "get_ipython") else None
    return found is not None and "IPKernelApp" in getattr(found, "config", {})
