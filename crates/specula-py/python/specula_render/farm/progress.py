"""One line that says how far a render is."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

from specula_render.farm.engine import Status

_EVERY = 0.5
_EVERY_IN_A_FILE = 30.0


def duration(seconds: float) -> str:
    """Return ``8 s``, ``3 min 20 s``, ``5 h 10 min``."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60} s"
    return f"{whole // 3600} h {whole % 3600 // 60} min"


def line(status: Status, elapsed: float) -> str:
    """Return a render's progress as a line."""
    share = status.done / status.of if status.of else 1.0
    parts = [f"{int(100.0 * share):3d} %"]
    if status.pictures > 1:
        parts.append(f"{status.pictures_done} of {status.pictures} pictures")
    parts.append(f"{status.slots} parts at once" if status.slots != 1 else "one part at a time")
    parts.append(duration(elapsed))
    if status.eta is not None:
        parts.append(f"{duration(status.eta)} left")
    return ", ".join(parts)


class Progress:
    """Shows the progress on standard error; on a terminal in one line that changes.

    Parameters
    ----------
    quiet
        Whether nothing but warnings is shown.
    also
        Is called as often.
    """

    def __init__(self, *, quiet: bool, also: Callable[[], None]) -> None:
        self.quiet, self.also = quiet, also
        self._begun = self._shown = time.monotonic()
        self._width = 0
        self._is_terminal = sys.stderr.isatty()

    def __call__(self, status: Status) -> None:
        """Show how far the render is, where it is time to."""
        self.also()
        now = time.monotonic()
        every = _EVERY if self._is_terminal else _EVERY_IN_A_FILE
        if self.quiet or now - self._shown < every:
            return
        self._shown = now
        text = line(status, now - self._begun)
        if self._is_terminal:
            sys.stderr.write(f"\r{text:<{self._width}}")
            self._width = len(text)
        else:
            sys.stderr.write(text + "\n")
        sys.stderr.flush()

    def clear(self) -> None:
        """Take the line away."""
        if self._width:
            sys.stderr.write(f"\r{'':<{self._width}}\r")
            self._width = 0

    def say(self, text: str) -> None:
        """Print a message of its own."""
        self.clear()
        if not self.quiet or text.startswith("warning"):
            print(text, file=sys.stderr, flush=True)
