"""Which of Ray's processes listen where, as Linux tells."""

from __future__ import annotations

import ipaddress
import os
from collections.abc import Iterator
from pathlib import Path

_LISTEN = "0A"
_NAMES = ("raylet", "gcs_server", "ray::", "ray.", "ray/", "default_worker")


def sockets() -> list[tuple[str, str]]:
    """Return processes of Ray's and the address and port that each listens on.

    Empty where the system does not tell.
    """
    listeners = {}
    for table in ("tcp", "tcp6"):
        listeners.update(_listeners(Path("/proc/net") / table))
    found = set()
    for pid, name in _processes():
        try:
            handles = list(os.scandir(f"/proc/{pid}/fd"))
        except OSError:
            continue
        for handle in handles:
            try:
                target = os.readlink(handle.path)
            except OSError:
                continue
            if target.startswith("socket:[") and (inode := target[8:-1]) in listeners:
                found.add((name, listeners[inode]))
    return sorted(found)


def _processes() -> Iterator[tuple[str, str]]:
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            words = (entry / "cmdline").read_bytes().decode(errors="replace").split("\0")
        except OSError:
            continue
        if any(name in word for word in words[:3] for name in _NAMES):
            scripts = [w for w in words[:3] if w.endswith(".py")]
            yield entry.name, Path((scripts or words)[0]).name


def _listeners(table: Path) -> dict[str, str]:
    try:
        lines = table.read_text(encoding="ascii").splitlines()[1:]
    except OSError:
        return {}
    rows = [line.split() for line in lines]
    return {row[9]: _address(row[1]) for row in rows if row[3] == _LISTEN}


def _address(text: str) -> str:
    host, port = text.split(":")
    words = [bytes.fromhex(host[i : i + 8])[::-1] for i in range(0, len(host), 8)]
    address = ipaddress.ip_address(b"".join(words))
    shown = "all interfaces" if address.is_unspecified else str(address)
    return f"{shown}, port {int(port, 16)}"
