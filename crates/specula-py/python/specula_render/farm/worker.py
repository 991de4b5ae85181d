"""What runs on the nodes: renders a part, merges films, says what the node is.

Each starts the program as a child that ends with this process.
"""

from __future__ import annotations

import ctypes
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from specula_render.farm import bundle
from specula_render.farm.ranges import Range

_WRONG_INPUT = 2
_DEATH_SIGNAL = 1
"""``PR_SET_PDEATHSIG`` of Linux."""


@dataclass(frozen=True)
class PartTask:
    """How to render parts of a picture."""

    program: tuple[str, ...] | None
    """The program and its first arguments; ``None``: that of this package."""
    scene: str
    """The scene's file, below the bundle's folder where there is one. Empty: the built-in one."""
    bundle: str | None
    """Fingerprint of the files that are sent along."""
    options: tuple[str, ...]
    folders: tuple[str, ...] = ()
    """Folders to search; below the bundle's folder where there is one."""
    rounds: int | None = None
    """Shares of a round of adaptive sampling, where samples are counted in these."""


@dataclass(frozen=True)
class Found:
    """What a node is."""

    version: str
    machine: str
    """Kind of processor: pictures of two kinds differ by rounding."""
    sees_files: bool = field(default=False)
    """Whether it has the scene's files at the same paths."""


class ProgramFailed(Exception):
    """The program ended with a code other than 0. Arguments: the code, and what it said."""

    @property
    def is_input(self) -> bool:
        """Whether the scene or an option is wrong."""
        return bool(self.args[0] == _WRONG_INPUT)

    @property
    def was_killed(self) -> bool:
        """Whether a signal ended it: that of a system without memory, say."""
        return bool(self.args[0] < 0)

    def __str__(self) -> str:
        code, said = self.args
        return said.strip() or f"the program ended with code {code}"


def program(command: Sequence[str] | None) -> list[str]:
    """Return the program and its first arguments."""
    return list(command or [sys.executable, "-m", "specula_render"])


def run(command: Sequence[str], *, quiet: bool = True) -> str:
    """Run a program that ends with this process; return what it prints.

    Raises
    ------
    ProgramFailed
        It ended with another code than 0.
    """
    if threading.current_thread() is threading.main_thread():
        # Ray's workers ignore it, and then nobody learns how a child ended.
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    child = subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE if quiet else None,
        encoding="utf-8",
        errors="replace",
        env=_environment(),
        # A terminal's Ctrl-C is for the driver, which decides what becomes of a part.
        start_new_session=True,
        preexec_fn=_end_with(os.getpid()) if sys.platform == "linux" else None,
    )
    try:
        printed, said = child.communicate()
    except BaseException:
        child.kill()
        child.wait()
        raise
    if child.returncode != 0:
        raise ProgramFailed(child.returncode, said or "")
    return printed


def _end_with(parent: int) -> Callable[[], None]:
    library = ctypes.CDLL(None)

    def prepare() -> None:
        library.prctl(_DEATH_SIGNAL, signal.SIGKILL)
        if os.getppid() != parent:
            os._exit(1)

    return prepare


def _environment() -> dict[str, str]:
    # The package is found where this one was.
    package = str(Path(__file__).resolve().parents[2])
    paths = [package, *filter(None, [os.environ.get("PYTHONPATH")])]
    # Of the farm's network, the renderer knows nothing.
    kept = {k: v for k, v in os.environ.items() if not k.startswith("RAY_AUTH_TOKEN")}
    return {**kept, "PYTHONPATH": os.pathsep.join(paths), "PYTHONUTF8": "1"}


def render_part(
    task: PartTask,
    samples: Range,
    threads: int,
    device: str,
    fetch: Callable[[], bytes],
    base: Callable[[], bytes] | None = None,
) -> tuple[dict[str, Any], bytes]:
    """Render samples of every pixel; return what it took, and the film.

    Parameters
    ----------
    fetch
        Gives the bundle's bytes, where this node does not have it yet.
    base
        Gives the film that a round of adaptive sampling goes on with.
    """
    from specula_render.farm.film import parse_head

    begun = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="specula-farm-") as folder:
        film = Path(folder) / "part.film"
        command = [*program(task.program), "render", *_scene(task, fetch), *task.options]
        if task.rounds is None:
            command += ["--samples", f"{samples[0]}..{samples[1]}"]
        else:
            first = samples[0] // task.rounds * task.rounds
            share = f"{samples[0] - first}..{samples[1] - first}/{task.rounds}"
            command += ["--round-share", share]
            if base is not None:
                before = Path(folder) / "before.film"
                before.write_bytes(base())
                command += [f"--resume={before}"]
        command += ["--threads", str(threads), "--device", device, "--checkpoint", "off"]
        run([*command, "--quiet", "-o", str(film)])
        data = film.read_bytes()
    seconds = parse_head(data).seconds
    wall = time.monotonic() - begun
    return {"seconds": min(seconds, wall), "wall": wall, "size": len(data)}, data


def _scene(task: PartTask, fetch: Callable[[], bytes]) -> list[str]:
    if not task.scene:
        return []
    root = "" if task.bundle is None else str(bundle.unpacked(task.bundle, fetch))
    searched = [f for folder in task.folders for f in ("--search", os.path.join(root, folder))]
    return [os.path.join(root, task.scene), *searched]


def merge_films(
    command: tuple[str, ...] | None, films: Sequence[bytes]
) -> tuple[dict[str, Any], bytes]:
    """Merge films; return what it took, and their sum."""
    begun = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="specula-farm-") as folder:
        names = []
        for i, film in enumerate(films):
            names.append(os.path.join(folder, f"{i}.film"))
            Path(names[-1]).write_bytes(film)
        out = os.path.join(folder, "sum.film")
        run([*program(command), "merge", *names, "--quiet", "-o", out])
        data = Path(out).read_bytes()
    return {"seconds": time.monotonic() - begun, "size": len(data)}, data


def look(command: tuple[str, ...] | None, files: Sequence[tuple[str, int, int]]) -> Found:
    """Say what this node is.

    Parameters
    ----------
    files
        Paths, sizes and times of change (in ns) of the scene's files.
    """
    version = run([*program(command), "--version"]).strip()
    return Found(version, machine(), all(_is_same(*file) for file in files))


def _is_same(path: str, size: int, changed: int) -> bool:
    try:
        found = os.stat(path)
    except OSError:
        return False
    return (found.st_size, found.st_mtime_ns) == (size, changed)


def machine() -> str:
    """Return the kind of this processor, as far as pictures depend on it."""
    import platform

    kind = platform.machine()
    try:
        flags = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return kind
    return f"{kind} avx2" if " avx2" in flags else kind
