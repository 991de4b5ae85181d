"""The command line in a process of its own: its progress, its errors, its end by Ctrl-C."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import IO, Any

_PATIENCE = 10.0
"""Seconds that a process has to save what is finished, after it was told to stop."""
_PROGRESS = re.compile(r"\s*\d+ %")
_LOCATION = re.compile(r"\S.*:\d+:\d+$")
_INTERRUPTED = 130
_WRONG_ARGUMENTS = 2


def call(arguments: Sequence[str], *, progress: bool) -> str:
    """Run ``specula lab`` with arguments and return what it prints.

    Parameters
    ----------
    arguments
        After ``specula lab``.
    progress
        Whether its progress and warnings go to standard error.

    Raises
    ------
    ValueError
        The arguments or the scene are wrong (exit code 2); the message is the program's.
    RuntimeError
        It failed.
    KeyboardInterrupt
        Ctrl-C, here or there; the process has ended.
    """
    with tempfile.TemporaryFile("w+", encoding="utf-8") as output:
        process = _start(["lab", *arguments], output)
        try:
            said = _listen(process, progress)
            code = process.wait()
        except KeyboardInterrupt:
            _stop(process)
            raise
        except BaseException:
            process.kill()
            process.wait()
            raise
        if code == 0:
            output.seek(0)
            return output.read()
    if code == _INTERRUPTED:
        raise KeyboardInterrupt
    message = _message(said)
    if code == _WRONG_ARGUMENTS:
        raise ValueError(message)
    raise RuntimeError(message or f"specula lab ended with code {code}")


def _start(arguments: Sequence[str], output: IO[str]) -> subprocess.Popen[str]:
    # A group of its own: a terminal's Ctrl-C would reach the process besides our signal, and a
    # second one ends it before it has saved anything.
    alone: dict[str, Any] = {"start_new_session": True}
    if sys.platform == "win32":
        alone = {"creationflags": subprocess.CREATE_NEW_PROCESS_GROUP}
    # The package is found where this one was, even where a script put its folder on sys.path.
    package = Path(__file__).resolve().parents[2]
    paths = [str(package), *filter(None, [os.environ.get("PYTHONPATH")])]
    return subprocess.Popen(
        [sys.executable, "-m", "specula_render", *arguments],
        stdin=subprocess.DEVNULL,
        stdout=output,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        errors="replace",
        env={**os.environ, "PYTHONPATH": os.pathsep.join(paths), "PYTHONUTF8": "1"},
        **alone,
    )


def _listen(process: subprocess.Popen[str], progress: bool) -> list[str]:
    """Show progress and warnings as they come; return the rest."""
    said = []
    shown = 0
    for line in process.stderr or ():
        line = line.rstrip()
        if _PROGRESS.match(line):
            if progress:
                # One line that changes, with spaces over what is left of a longer one before.
                sys.stderr.write(f"\r{line:<{shown}}")
                sys.stderr.flush()
                shown = len(line)
        elif line.startswith("warning:"):
            if progress:
                sys.stderr.write(f"\r{'':<{shown}}\r{line}\n" if shown else f"{line}\n")
                shown = 0
        else:
            said.append(line)
    if shown:
        sys.stderr.write(f"\r{'':<{shown}}\r")
        sys.stderr.flush()
    return said


def _stop(process: subprocess.Popen[str]) -> None:
    """Ask the process to stop and wait; a second Ctrl-C, or too long a wait, ends it at once."""
    try:
        if sys.platform == "win32":
            process.send_signal(signal.CTRL_BREAK_EVENT)
        else:
            process.send_signal(signal.SIGINT)
        process.communicate(timeout=_PATIENCE)
    except (KeyboardInterrupt, subprocess.TimeoutExpired):
        process.kill()
        process.communicate()


def _message(lines: Sequence[str]) -> str:
    """The error in one line, as the program wraps it for a screen."""
    text = [line.strip() for line in lines if line.strip()]
    start = next((k for k, line in enumerate(text) if line.startswith("×")), None)
    if start is None:
        text = [line for line in text if not line.startswith("For more information")]
        return "\n".join(text).removeprefix("error: ")
    message = " ".join(line.lstrip("×│ ") for line in text[start:])
    if start > 0 and _LOCATION.match(text[start - 1]):
        return f"{text[start - 1]}: {message}"
    return message
