"""A scene's files as one archive, which a node unpacks once."""

from __future__ import annotations

import hashlib
import io
import os
import shutil
import stat
import tempfile
import time
import zipfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

_OLD = 7 * 86400.0
"""Seconds after which a bundle that nobody used is removed from a node."""


@dataclass(frozen=True)
class Bundle:
    """Files to send."""

    root: Path
    """The folder that all are in."""
    files: tuple[Path, ...]
    fingerprint: str
    """Of names and contents."""

    def inside(self, path: Path) -> str:
        """Return how a file or folder is called in the bundle."""
        return PurePosixPath(os.path.relpath(path.absolute(), self.root)).as_posix()

    def pack(self) -> bytes:
        """Return the archive."""
        out = io.BytesIO()
        with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
            for path in self.files:
                archive.write(path, self.inside(path))
        return out.getvalue()


def of_files(files: Sequence[Path], folders: Sequence[Path] = ()) -> Bundle:
    """Return the bundle of files, in which folders to search have a place, too.

    Raises
    ------
    OSError
        A file cannot be read.
    """
    paths = sorted({Path(os.path.abspath(path)) for path in files})
    around = [str(path.parent) for path in paths] + [os.path.abspath(f) for f in folders]
    root = Path(os.path.commonpath(around)) if around else Path.cwd()
    digest = hashlib.sha256()
    for path in paths:
        digest.update(os.path.relpath(path, root).encode() + b"\0")
        digest.update(_digest(path))
    return Bundle(root, tuple(paths), digest.hexdigest()[:32])


def _digest(path: Path) -> bytes:
    digest = hashlib.sha256()
    with path.open("rb") as file:
        while block := file.read(1 << 20):
            digest.update(block)
    return digest.digest()


def unpacked(fingerprint: str, fetch: Callable[[], bytes]) -> Path:
    """Return the folder that has a bundle's files; unpack it where this node does not have it."""
    home = _home()
    folder = home / fingerprint
    if not folder.exists():
        _sweep(home)
        partial = Path(tempfile.mkdtemp(prefix="partial-", dir=home))
        try:
            with zipfile.ZipFile(io.BytesIO(fetch())) as archive:
                archive.extractall(partial)
            partial.rename(folder)
        except OSError:
            # Another worker was first.
            if not folder.exists():
                raise
        finally:
            shutil.rmtree(partial, ignore_errors=True)
    os.utime(folder)
    return folder


def _home() -> Path:
    """Return a folder for bundles that belongs to this user alone."""
    user = os.getuid() if hasattr(os, "getuid") else os.environ.get("USERNAME", "user")
    home = Path(tempfile.gettempdir()) / f"specula-farm-{user}"
    home.mkdir(mode=0o700, exist_ok=True)
    found = home.lstat()
    is_own = not hasattr(os, "getuid") or found.st_uid == os.getuid()
    if not (stat.S_ISDIR(found.st_mode) and is_own and found.st_mode & 0o077 == 0):
        raise PermissionError(f"'{home}' is not a folder of this user's alone: remove it")
    return home


def _sweep(home: Path) -> None:
    """Remove bundles that nobody has used for long."""
    for folder in home.iterdir():
        if time.time() - folder.lstat().st_mtime > _OLD:
            shutil.rmtree(folder, ignore_errors=True)
