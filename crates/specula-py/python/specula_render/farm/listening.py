"""Which of Ray's processes listen where, as Linux tells."""

from __future__ import annotations

import ipaddress
import os
from collections.abc import Iterator
from pathlib import Path

_LISTEN = "0A"
_NAMES = ("raylet", "gcs_server", "ray::", "ray.", "ray/", "default_worker")


def sockets(below: int | None = None) -> list[tuple[str, str]]:
    """Return processes of Ray's and the address and port that each listens on.

    Empty where the system does not tell.

    Parameters
    ----------
    below
        Only those that this process started.
    """
    listeners = {}
    for table in ("tcp", "tcp6"):
        listeners.update(_listeners(Path("/proc/net") / table))
    found = set()
    for pid, name in _processes():
        if below is not None and below not in _ancestors(int(pid)):
            continue
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


def _ancestors(pid: int) -> list[int]:
    found = []
    while pid > 1:
        try:
            stat = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8", errors="replace")
        except OSError:
            break
        pid = int(stat.rpartition(")")[2].split()[1])
        found.append(pid)
    return found


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
    address: ipaddress.IPv4Address | ipaddress.IPv6Address
    address = ipaddress.ip_address(b"".join(words))
    if isinstance(address, ipaddress.IPv6Address):
        address = address.ipv4_mapped or address
    shown = "all interfaces" if address.is_unspecified else str(address)
    return f"{shown}, port {int(port, 16)}"
