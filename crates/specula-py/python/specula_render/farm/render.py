"""Renders what was asked for: on a cluster, from a job's folder, to pictures."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import Any

from specula_render.farm import cluster, listening, ranges
from specula_render.farm.cluster import ClusterError
from specula_render.farm.engine import Engine, Status
from specula_render.farm.keeper import JobKeeper
from specula_render.farm.policy import Policy
from specula_render.farm.pool import Event, Handle, NodeInfo
from specula_render.farm.progress import Progress, duration
from specula_render.farm.ray_pool import Limits, RayFilm, RayPool
from specula_render.farm.request import Plan, Request, plan, ship
from specula_render.farm.store import Store
from specula_render.farm.worker import PartTask

_SIGNALS = {signal.SIGINT: 130, signal.SIGTERM: 143}


@dataclass(frozen=True)
class Where:
    """Which cluster renders."""

    address: str | None
    """``None``: one of this machine alone."""
    insecure: bool = False
    cpus: int | None = None
    """CPUs of a cluster of this machine alone; ``None``: all."""


class Stopped(BaseException):
    """A signal asks to stop. Argument: the exit code."""


class _Signals:
    """Turns the first signal that asks to stop into `Stopped`; the second one ends the program.

    It is raised where the program is, or, while the engine runs, between two of its steps: code of
    Ray's that is interrupted elsewhere takes it for an error of its own.
    """

    def __init__(self) -> None:
        self._code: int | None = None
        self._waits = False

    @contextmanager
    def caught(self) -> Iterator[None]:
        """Catch signals."""
        before = {number: signal.signal(number, self._arrive) for number in _SIGNALS}
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)

    @contextmanager
    def between_steps(self) -> Iterator[None]:
        """Raise `Stopped` in `check` only."""
        self._waits = True
        try:
            yield
        finally:
            self._waits = False

    def check(self) -> None:
        """Raise `Stopped` where a signal has arrived."""
        if self._code is not None:
            raise Stopped(self._code)

    def _arrive(self, number: int, frame: FrameType | None) -> None:
        signal.signal(number, signal.SIG_DFL)
        self._code = _SIGNALS[signal.Signals(number)]
        if not self._waits:
            raise Stopped(self._code)


class _NoPool:
    """No node, for jobs that are done."""

    bases: dict[int, tuple[int, RayFilm]] = {}

    def now(self) -> float:
        return time.monotonic()

    def nodes(self) -> list[NodeInfo]:
        return []

    def render(self, task: int, node: NodeInfo, picture: int, samples: ranges.Range) -> None:
        raise AssertionError("nothing is left to render")

    def merge(self, task: int, node: str | None, films: Sequence[Handle]) -> None:
        raise AssertionError("nothing is left to merge")

    def cancel(self, task: int) -> None:
        pass

    def wait(self, seconds: float) -> list[Event]:
        return []

    def fetch(self, film: RayFilm) -> bytes | None:
        return None


def render(request: Request, job: Path, where: Where, *, quiet: bool) -> int:
    """Render, or go on with what the job's folder has; return the exit code.

    Raises
    ------
    BadRequest, JobError, ClusterError, RenderFailed, NodeRefused
        It cannot be done.
    """
    signals = _Signals()
    store = Store(job)
    try:
        with signals.caught(), store.lock():
            planned = plan(request)
            store.begin(request.to_json())
            return _render(planned, store, where, quiet, signals)
    except Stopped as stopped:
        # Before the render began, or after its end.
        return int(stopped.args[0])


def _render(planned: Plan, store: Store, where: Where, quiet: bool, signals: _Signals) -> int:
    begun = time.monotonic()
    request = planned.request
    progress = Progress(quiet=quiet, also=lambda: keeper.live())
    pool: Any = _NoPool()
    keeper = JobKeeper(store, request, planned.pictures, lambda film: pool.fetch(film))
    engine: Engine | None = None
    ray: Any = None

    def report(status: Status) -> None:
        progress(status)
        signals.check()

    try:
        if not _is_complete(planned, keeper):
            ray = _connect(where, progress)
            pool = _pool(ray, planned, progress)
            pool.bases = keeper.bases
        engine = Engine(
            pool,
            keeper,
            len(planned.pictures),
            policy=_policy(request),
            by=request.by,
            report=report,
        )
        with signals.between_steps():
            engine.run()
    except Stopped as stopped:
        progress.clear()
        if engine is not None:
            engine.stop()
        written = keeper.write_partial()
        names = ", ".join(map(str, written))
        there = f"wrote what there is to {names}" if written else "there is no picture yet"
        progress.say(
            f"warning: stopped; {there}; `specula farm resume {store.folder}` goes on"
        )
        return int(stopped.args[0])
    except Exception as error:
        if type(error).__module__.partition(".")[0] != "ray":
            raise
        text = (str(error).strip() or type(error).__name__).splitlines()[0]
        raise ClusterError(f"the cluster is gone: {text}; `specula farm resume` goes on") from error
    finally:
        progress.clear()
        if ray is not None:
            ray.shutdown()
    names = ", ".join(str(o) for p in planned.pictures for o in p.outputs)
    took = duration(time.monotonic() - begun)
    progress.say(f"wrote {names}: {engine.attempts} parts, {engine.doubled} of them twice, {took}")
    return 0


def _policy(request: Request) -> Policy:
    seconds = request.part_seconds
    if seconds is None:
        return Policy()
    return Policy(part_seconds=seconds, most_part_seconds=seconds)


def _is_complete(planned: Plan, keeper: JobKeeper) -> bool:
    if planned.request.in_rounds:
        return False
    whole = [(0, planned.request.spp)]
    kept = [keeper.kept(i) for i in range(len(planned.pictures))]
    return all(len(films) == 1 and films[0][1] == whole for films in kept)


def _connect(where: Where, progress: Progress) -> Any:
    if where.address is None:
        ray = cluster.start_local(where.cpus)
        progress.say("started Ray on this machine, with a token of its own:")
        for name, address in listening.sockets(os.getpid()):
            progress.say(f"  {name} listens on {address}")
        return ray
    ray, warning = cluster.connect(where.address, insecure=where.insecure)
    if warning is not None:
        progress.say(f"warning: {warning}")
    return ray


def _pool(ray: Any, planned: Plan, progress: Progress) -> RayPool:
    request = planned.request
    limits = Limits(request.threads, request.device)

    def make(tasks: Sequence[PartTask]) -> RayPool:
        return RayPool(
            ray,
            tasks,
            limits,
            pack=lambda _: planned.files.pack(),
            tell=lambda t: progress.say(f"warning: {t}"),
        )

    pool = make([picture.task for picture in planned.pictures])
    if not planned.files.files or request.ship == "never":
        return pool
    if request.ship == "auto":
        stats = [(str(f), f.stat()) for f in planned.files.files]
        found = pool.ask([(name, s.st_size, s.st_mtime_ns) for name, s in stats])
        if found and all(f.sees_files for f in found):
            return pool
    return make(ship(planned))
