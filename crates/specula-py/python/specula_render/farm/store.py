"""The job's folder: what was asked for, films, a journal, a lock."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from specula_render.farm import ranges
from specula_render.farm.ranges import Range

_VERSION = 1


class JobError(Exception):
    """A job's folder cannot be used; the message says why."""


class Store:
    """A job's folder.

    ``job.json`` has what was asked for, ``journal.jsonl`` what happened, a line each, and
    ``films/KEY/FIRST-END.film`` the samples of what has this key: scene, options, program.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def begin(self, request: dict[str, Any]) -> None:
        """Make the folder and write down what was asked for."""
        self.folder.mkdir(parents=True, exist_ok=True)
        strangers = any(entry.name != "lock" for entry in self.folder.iterdir())
        if strangers and not (self.folder / "job.json").exists():
            raise JobError(
                f"'{self.folder}' is there already and no job's folder: --job names another"
            )
        text = json.dumps({"version": _VERSION, **request}, indent=2, ensure_ascii=False)
        replace(self.folder / "job.json", text.encode())

    def request(self) -> dict[str, Any]:
        """Return what was asked for.

        Raises
        ------
        JobError
            There is no job.
        """
        path = self.folder / "job.json"
        try:
            found = json.loads(path.read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise JobError(
                f"'{self.folder}' has no job that can be gone on with: {error}"
            ) from error
        if not isinstance(found, dict) or found.get("version") != _VERSION:
            raise JobError(f"'{path}' is of another version of the program")
        return found

    @contextlib.contextmanager
    def lock(self) -> Iterator[None]:
        """Hold the folder, so that no other process works in it."""
        self.folder.mkdir(parents=True, exist_ok=True)
        with (self.folder / "lock").open("w", encoding="utf-8") as file:
            try:
                import fcntl

                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except ImportError:
                pass
            except OSError as error:
                raise JobError(f"another process works in '{self.folder}'") from error
            yield

    def note(self, event: str, **facts: object) -> None:
        """Append a line to the journal."""
        line = json.dumps({"at": round(time.time(), 3), "event": event, **facts})
        with (self.folder / "journal.jsonl").open("a", encoding="utf-8") as file:
            file.write(line + "\n")

    def journal(self) -> list[dict[str, Any]]:
        """Return the journal; a line that was cut off is left out."""
        try:
            lines = (self.folder / "journal.jsonl").read_text(encoding="utf-8").splitlines()
        except FileNotFoundError:
            return []
        found = []
        for line in lines:
            with contextlib.suppress(ValueError):
                found.append(json.loads(line))
        return found

    # Films.

    def keep(self, key: str, samples: Sequence[Range], data: bytes) -> Path:
        """Write a film; return where."""
        folder = self.folder / "films" / key
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / _name(samples)
        if len(samples) > 1:
            replace(path.with_suffix(".ranges"), ranges.text(samples).encode())
        replace(path, data)
        return path

    def films(self, key: str) -> list[tuple[Path, list[Range]]]:
        """Return films of a key that have no sample in common, those with most samples first.

        Others are the leftovers of a merge that was broken off; they are removed.
        """
        folder = self.folder / "films" / key
        found = []
        for path in sorted(folder.glob("*.film")):
            with contextlib.suppress(ValueError, OSError):
                found.append((path, _samples(path)))
        found.sort(key=lambda f: -ranges.count(f[1]))
        chosen: list[tuple[Path, list[Range]]] = []
        for path, samples in found:
            if any(ranges.overlap(samples, other) for _, other in chosen):
                self.drop([path])
            else:
                chosen.append((path, samples))
        return chosen

    def drop(self, paths: Sequence[Path]) -> None:
        """Remove films whose sum is kept."""
        for path in paths:
            path.unlink(missing_ok=True)
            path.with_suffix(".ranges").unlink(missing_ok=True)


def _name(samples: Sequence[Range]) -> str:
    first, end = samples[0][0], samples[-1][1]
    if len(samples) == 1:
        return f"{first}-{end}.film"
    digest = hashlib.sha256(ranges.text(samples).encode()).hexdigest()[:12]
    return f"{first}-{end}-{digest}.film"


def _samples(path: Path) -> list[Range]:
    """Return the samples of a film: those of its name, or of the file beside it."""
    words = path.stem.split("-")
    text = path.stem if len(words) == 2 else path.with_suffix(".ranges").read_text("ascii")
    pairs = [part.split("-") for part in text.split("+")]
    return [(int(a), int(b)) for a, b in pairs]


def replace(path: Path, data: bytes) -> None:
    """Write a file in place of another, whole or not at all."""
    handle, partial = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name[:40]}-")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.replace(partial, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(partial)
        raise


def key_of(*facts: object) -> str:
    """Return the key of what samples depend on."""
    return hashlib.sha256(json.dumps(facts).encode()).hexdigest()[:32]
