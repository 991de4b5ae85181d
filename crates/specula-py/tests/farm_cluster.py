"""A Ray cluster of two nodes for tests, in namespaces of its own.

Ray listens on every interface, so nothing of it is started anywhere else.
"""

from __future__ import annotations

import contextlib
import json
import os
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[1] / "python"
HEAD = "127.0.0.2:6399"
CLIENT = "ray://127.0.0.2:6401"
SIZE = ["--resolution", "96x64"]


def has_tools() -> bool:
    """Tell whether there is what makes namespaces."""
    return shutil.which("unshare") is not None and shutil.which("ip", path=_path()) is not None


def namespace() -> list[str] | None:
    """Return the command that runs another in namespaces of its own; ``None``: there is none."""
    if not has_tools():
        return None
    user = [] if os.getuid() == 0 else ["--user", "--map-root-user"]
    command = ["unshare", *user, "--net", "--pid", "--fork", "--kill-child", "--mount-proc"]
    works = subprocess.run([*command, "true"], capture_output=True)
    return command if works.returncode == 0 else None


def _path() -> str:
    return os.environ.get("PATH", "") + ":/usr/sbin:/sbin"


class Cluster:
    """Two nodes on loopback.

    Parameters
    ----------
    folder
        Where renders run; the home of Ray's token, too.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        home = folder / "home"
        home.mkdir(exist_ok=True)
        subprocess.run(["ip", "link", "set", "lo", "up"], check=True, env={"PATH": _path()})
        paths = [str(PACKAGE), *filter(None, [os.environ.get("PYTHONPATH")])]
        self.environment = {
            **os.environ,
            "HOME": str(home),
            "PYTHONPATH": os.pathsep.join(paths),
            "PYTHONDONTWRITEBYTECODE": "1",
            # Dead nodes are noticed in seconds.
            "RAY_health_check_period_ms": "500",
            "RAY_health_check_timeout_ms": "1000",
            "RAY_health_check_failure_threshold": "3",
        }
        program = os.environ.get("SPECULA_FARM_PROGRAM")
        self.own = [program] if program else [sys.executable, "-m", "specula_render"]
        self.program = ["--program", program] if program else []

    def start(self) -> str:
        """Start both nodes; return what the head says."""
        offer = ["--cpus", "1", "--gpus", "1"]
        ports = ["--port", "6399", "--client-port", "6401"]
        said = self.farm(["head", "--host", "127.0.0.2", *ports, *offer])
        self.join()
        return said.stdout

    def join(self) -> None:
        """Start the second node; again, where what is left of one that was killed is in its way."""
        words = ["join", HEAD, "--host", "127.0.0.3", "--cpus", "1"]
        for _ in range(3):
            if self.farm(words, code=None).returncode == 0:
                return
            time.sleep(2.0)
        self.farm(words)

    def farm(
        self, arguments: Sequence[str], *, code: int | None = 0, **more: str
    ) -> subprocess.CompletedProcess[str]:
        """Run ``specula farm``; fail where it ends with another code."""
        done = subprocess.run(
            [sys.executable, "-m", "specula_render.farm", *arguments],
            cwd=self.folder,
            env={**self.environment, **more},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=3600,
        )
        assert code is None or done.returncode == code, (done.returncode, done.stdout, done.stderr)
        return done

    def render(
        self, arguments: Sequence[str], *, address: str = HEAD, code: int = 0
    ) -> subprocess.CompletedProcess[str]:
        """Render on the cluster."""
        words = ["render", *self.program, "--address", address, *arguments]
        return self.farm(words, code=code)

    def begin(self, arguments: Sequence[str]) -> subprocess.Popen[str]:
        """Begin ``specula farm``, in a session of its own, with Ctrl-C as by default."""
        return subprocess.Popen(
            [sys.executable, "-m", "specula_render.farm", *arguments],
            cwd=self.folder,
            env=self.environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        )

    def alone(self, arguments: Sequence[str]) -> None:
        """Render with one process, without the farm."""
        is_adaptive = "--adaptive" in arguments or "--noise" in arguments
        even = [] if is_adaptive else ["--adaptive=off"]
        command = [*self.own, "render", *arguments, *even, "--quiet"]
        subprocess.run(command, cwd=self.folder, env=self.environment, check=True)

    def journal(self, job: str) -> list[dict[str, object]]:
        """Return a job's journal."""
        path = self.folder / job / "journal.jsonl"
        lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
        found = []
        for line in lines:
            with contextlib.suppress(ValueError):
                found.append(json.loads(line))
        return found

    def same(self, one: str, other: str) -> bool:
        """Whether two pictures have the same bits in every channel."""
        return pixels(self.folder / one) == pixels(self.folder / other)


def pixels(path: Path) -> bytes:
    """Return an OpenEXR file's bytes behind its header, which says how long the render took.

    The first block's place is the first number of the table that follows the header.
    """
    data = path.read_bytes()
    at = 8
    while data[at] != 0:
        name = data.index(b"\0", at)
        kind = data.index(b"\0", name + 1)
        (size,) = struct.unpack_from("<i", data, kind + 1)
        at = kind + 5 + size
    (first,) = struct.unpack_from("<Q", data, at + 1)
    return data[first:]


def processes(needle: str) -> list[int]:
    """Return the processes of this namespace whose command line has a text."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            if needle in (entry / "cmdline").read_bytes().decode(errors="replace"):
                found.append(int(entry.name))
    return [pid for pid in found if pid != os.getpid()]


def worker_of(pid: int) -> int | None:
    """Return the worker that a process descends from; ``None``: none, or the process has ended."""
    workers = {*processes("ray::_part"), *processes("ray::samples")}
    while pid > 1:
        try:
            stat = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8")
        except OSError:
            return None
        # The name, in brackets, may have spaces; the parent is the second word behind it.
        pid = int(stat.rpartition(")")[2].split()[1])
        if pid in workers:
            return pid
    return None


def kill(pid: int) -> None:
    """Kill a process that may have ended."""
    with contextlib.suppress(ProcessLookupError):
        os.kill(pid, signal.SIGKILL)


def kill_worker(chance: random.Random) -> bool:
    """Kill a worker that renders; whether there is one."""
    workers = processes("ray::_part") or processes("ray::samples")
    if workers:
        kill(chance.choice(sorted(workers)))
    return bool(workers)


def kill_second_node() -> bool:
    """Kill the node 127.0.0.3; whether it was there."""
    raylets = [
        p for p in processes("--node_ip_address=127.0.0.3") if p in processes("raylet/raylet")
    ]
    for pid in raylets:
        kill(pid)
    return bool(raylets)


def wait_for(what: Callable[[], object], seconds: float = 60.0) -> None:
    """Wait until something holds."""
    end = time.monotonic() + seconds
    while not what():
        assert time.monotonic() < end, "it never came"
        time.sleep(0.05)


def main(scenarios: dict[str, Callable[[Cluster], object]], folder: Path, names: list[str]) -> None:
    """Run scenarios one after the other; write what they return, or why they failed."""
    results: dict[str, object] = {}
    cluster = Cluster(folder)
    for name in names or list(scenarios):
        begun = time.monotonic()
        try:
            results[name] = {"found": scenarios[name](cluster)}
        except Exception as error:
            results[name] = {"error": f"{type(error).__name__}: {error}"[-4000:]}
        print(
            f"{name}: {time.monotonic() - begun:.1f} s {results[name]}", file=sys.stderr, flush=True
        )
        (folder / "results.json").write_text(json.dumps(results), encoding="utf-8")


def run(script: Path, *arguments: str, timeout: float) -> dict[str, dict[str, object]]:
    """Run a script's scenarios in namespaces of their own; return their results."""
    command = namespace()
    assert command is not None
    with tempfile.TemporaryDirectory(prefix="farm-") as name:
        # Short: Ray's sockets are below it.
        subprocess.run(
            [*command, sys.executable, str(script), name, *arguments],
            env={**os.environ, "RAY_TMPDIR": name, "TMPDIR": name},
            stdin=subprocess.DEVNULL,
            timeout=timeout,
            check=False,
        )
        found: dict[str, dict[str, object]] = json.loads(
            Path(name, "results.json").read_text("utf-8")
        )
        return found
