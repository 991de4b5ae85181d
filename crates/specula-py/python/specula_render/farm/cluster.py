"""Ray clusters: started with a token, checked for one, joined."""

from __future__ import annotations

import importlib
import importlib.util
import os
import re
import secrets
import socket
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

MISSING = 'rendering on many machines needs Ray: pip install "specula-render[farm]"'
_OLDEST = (2, 52)
"""The first Ray that has tokens."""
_TIMEOUT = 60.0

_PROBE = """
import sys
try:
    if sys.argv[1].startswith("ray://"):
        # Ray's own client asks for half a minute before it says that it was refused.
        import grpc
        channel = grpc.insecure_channel(sys.argv[1].removeprefix("ray://"))
        try:
            channel.unary_unary("/ray.rpc.RayletDriver/ClusterInfo")(b"", timeout=20.0)
        except grpc.RpcError as error:
            gone = grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.DEADLINE_EXCEEDED
            if error.code() is grpc.StatusCode.UNAUTHENTICATED or error.code() in gone:
                raise
    else:
        from ray._raylet import GcsClient
        GcsClient(address=sys.argv[1]).get_all_node_info()
except Exception as error:
    text = f"{type(error).__name__}: {error}"
    print(text)
    sys.exit(3 if "uthenti" in text or "token" in text.lower() else 4)
"""
"""Asks a cluster without a token. Code 0: it answers; 3: it wants one; 4: nobody is there."""


class ClusterError(Exception):
    """A cluster cannot be used; the message says why and what to do."""


def load_ray() -> Any:
    """Return the module ``ray``, set up for tokens.

    Raises
    ------
    ClusterError
        It is not installed, or older than tokens.
    """
    os.environ.update(environment())
    if importlib.util.find_spec("ray") is None:
        raise ClusterError(MISSING)
    ray = importlib.import_module("ray")
    version = tuple(int(n) for n in re.findall(r"\d+", ray.__version__)[:2])
    if version < _OLDEST:
        raise ClusterError(f"Ray {ray.__version__} has no tokens: {MISSING.split(': ')[1]}")
    return ray


def environment() -> dict[str, str]:
    """Return what Ray is told by its environment."""
    return {
        "RAY_AUTH_MODE": os.environ.get("RAY_AUTH_MODE", "token"),
        "RAY_USAGE_STATS_ENABLED": "0",
        # The engine tells of what it cannot do again.
        "RAY_IGNORE_UNHANDLED_ERRORS": "1",
        # Nobody outlives the worker that started it.
        "RAY_kill_child_processes_on_worker_exit_with_raylet_subreaper": "true",
        "RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO": "0",
        # gRPC tells of every child process.
        "GRPC_VERBOSITY": "ERROR",
    }


def token_file() -> Path:
    """Return where Ray looks for a token that the environment does not have."""
    path = os.environ.get("RAY_AUTH_TOKEN_PATH")
    return Path(path) if path else Path.home() / ".ray" / "auth_token"


def ensure_token() -> str:
    """Make a token where there is none; return where it is."""
    if os.environ.get("RAY_AUTH_TOKEN"):
        return "the variable RAY_AUTH_TOKEN"
    path = token_file()
    if not path.exists():
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(secrets.token_hex(32))
    return str(path)


def refuse_open(address: str, *, insecure: bool) -> str | None:
    """Make sure that a cluster answers nobody without a token.

    A client that has a token joins a cluster without one and is not told, so this asks without.

    Returns
    -------
    str or None
        A warning, where the cluster is open and ``insecure`` allows it.

    Raises
    ------
    ClusterError
        The cluster is open, or nobody is there.
    """
    host, _, port = address.removeprefix("ray://").rpartition(":")
    try:
        socket.create_connection((host, int(port)), timeout=10.0).close()
    except (OSError, ValueError) as error:
        raise ClusterError(f"no Ray cluster at {address} (expected HOST:PORT): {error}") from error
    answer = subprocess.run(
        [sys.executable, "-c", _PROBE, address],
        env={**os.environ, **environment(), "RAY_AUTH_MODE": "disabled"},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=_TIMEOUT * 2,
    )
    if answer.returncode == 3:
        return None
    if answer.returncode != 0:
        said = (answer.stdout.strip() or answer.stderr.strip()).splitlines()
        raise ClusterError(f"no Ray cluster at {address}: {said[-1] if said else 'no answer'}")
    text = (
        f"the cluster at {address} wants no token: whoever reaches it can run programs on its nodes"
    )
    if insecure:
        return text
    raise ClusterError(
        f"{text}. Start it by `specula farm head`, or with RAY_AUTH_MODE=token; "
        "--insecure uses it as it is"
    )


def connect(address: str, *, insecure: bool) -> tuple[Any, str | None]:
    """Connect to a cluster; return Ray, and a warning.

    Raises
    ------
    ClusterError
        It cannot be used.
    """
    ray = load_ray()
    warning = refuse_open(address, insecure=insecure)
    if warning is not None:
        os.environ["RAY_AUTH_MODE"] = "disabled"
    elif not os.environ.get("RAY_AUTH_TOKEN") and not token_file().exists():
        raise ClusterError(
            f"the cluster at {address} wants its token: "
            f"put it into '{token_file()}' or RAY_AUTH_TOKEN"
        )
    # A busy head may take longer to start what serves a client than Ray waits for it.
    for attempts_left in (2, 1, 0) if address.startswith("ray://") else (0,):
        try:
            ray.init(address=address, log_to_driver=False, logging_level="error")
            break
        except Exception as error:
            if attempts_left == 0:
                text = str(error).strip().splitlines() or [type(error).__name__]
                raise ClusterError(f"cannot join the cluster at {address}: {text[0]}") from error
            ray.shutdown()
    return ray, warning


def start_local(cpus: int | None) -> Any:
    """Start a cluster of this machine alone, which ends with this process; return Ray."""
    os.environ["RAY_AUTH_MODE"] = "token"
    # Nobody else is to have it.
    os.environ["RAY_AUTH_TOKEN"] = secrets.token_hex(32)
    ray = load_ray()
    ray.init(
        address="local",
        num_cpus=cpus,
        include_dashboard=False,
        log_to_driver=False,
        logging_level="error",
        _node_ip_address="127.0.0.1",
    )
    return ray


def ray_command(*arguments: str) -> None:
    """Run Ray's own program.

    Raises
    ------
    ClusterError
        It fails.
    """
    load_ray()
    command = [sys.executable, "-m", "ray.scripts.scripts", *arguments]
    done = subprocess.run(
        command,
        env={**os.environ, **environment(), "RAY_AUTH_MODE": "token"},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
    )
    if done.returncode != 0:
        said = (done.stderr.strip() or done.stdout.strip()).splitlines()
        raise ClusterError(f"`ray {arguments[0]}` failed: {' '.join(said[-3:])}")


@dataclass(frozen=True)
class Offer:
    """What a node has, where that is not what Ray finds."""

    host: str | None = None
    """Its address in the cluster."""
    cpus: int | None = None
    gpus: int | None = None

    def options(self) -> list[str]:
        """Return Ray's options."""
        named = {"node-ip-address": self.host, "num-cpus": self.cpus, "num-gpus": self.gpus}
        told = [f"--{name}={value}" for name, value in named.items() if value is not None]
        return ["--disable-usage-stats", *told]


def start_head(offer: Offer, port: int, client_port: int | None) -> None:
    """Start a cluster's head on this machine, which goes on when this process ends."""
    ensure_token()
    with socket.socket() as probe:
        if probe.connect_ex((offer.host or "127.0.0.1", port)) == 0:
            raise ClusterError(
                f"port {port} is taken: is there a cluster already? --port names another"
            )
    extra = [f"--ray-client-server-port={client_port}"] if client_port else []
    head = ["start", "--head", f"--port={port}", "--include-dashboard=false"]
    ray_command(*head, *offer.options(), *extra)


def join(address: str, offer: Offer, *, insecure: bool) -> str | None:
    """Add this machine to a cluster; return a warning."""
    load_ray()
    warning = refuse_open(address, insecure=insecure)
    ray_command("start", f"--address={address}", *offer.options())
    return warning
