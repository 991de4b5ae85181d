"""The pool of a Ray cluster."""

from __future__ import annotations

import queue
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from specula_render.farm import worker
from specula_render.farm.pool import Event, Failed, Handle, MergeDone, NodeInfo, PartDone
from specula_render.farm.ranges import Range
from specula_render.farm.worker import Found, PartTask

_PATIENCE = 60.0
"""Seconds that a node has to say what it is."""


@dataclass(eq=False)
class RayFilm:
    """A film: in the cluster's memory, in a file, or both."""

    reference: Any
    path: Path | None = None


@dataclass(frozen=True)
class Limits:
    """What a pool may take of its nodes."""

    threads: int | None = None
    """Threads of a part; ``None``: all of a node's."""
    device: str = "cpu"
    """``"cpu"``, ``"gpu"`` (nodes with GPUs only), or ``"mixed"``."""


class NodeRefused(Exception):
    """No node can be used; the message says why."""


class RayPool:
    """Nodes of a Ray cluster.

    Parameters
    ----------
    ray
        The module, connected.
    tasks
        How to render each picture.
    files
        The scenes' files with sizes and times of change, which nodes are asked for.
    pack
        Packs the files of a fingerprint.
    tell
        Is given what people should know.
    """

    def __init__(
        self,
        ray: Any,
        tasks: Sequence[PartTask],
        limits: Limits,
        *,
        pack: Callable[[str], bytes],
        tell: Callable[[str], None],
    ) -> None:
        self.ray, self.tasks, self.limits = ray, tasks, limits
        self.pack, self.tell = pack, tell
        self.bases: dict[int, tuple[int, RayFilm]] = {}
        """For adaptive pictures, the film that a round goes on with, and its samples."""
        self._program = tasks[0].program if tasks else None
        self._version: str | None = None
        self._events: queue.Queue[Event] = queue.Queue()
        self._references: dict[int, list[Any]] = {}
        self._bundles: dict[str, Any] = {}
        self._known: dict[str, NodeInfo | None] = {}
        self._asked: dict[str, tuple[Any, float]] = {}
        self._cpus: dict[str, int] = {}
        self._machines: set[str] = set()
        self._part = ray.remote(max_retries=0, num_returns=2)(_part)
        self._merge = ray.remote(max_retries=0, num_returns=2, num_cpus=0)(_merge)
        self._look = ray.remote(max_retries=0, num_cpus=0)(worker.look)

    def now(self) -> float:
        """Return the time in seconds."""
        return time.monotonic()

    # Nodes.

    def ask(self, files: Sequence[tuple[str, int, int]] = ()) -> list[Found]:
        """Wait for the nodes that are there now to say what they are; return what they say."""
        alive = [n for n in self.ray.nodes() if n["Alive"]]
        asked = [self._look_at(n["NodeID"], files) for n in alive]
        done, _ = self.ray.wait(asked, num_returns=len(asked), timeout=_PATIENCE)
        found = []
        for reference in done:
            try:
                found.append(self.ray.get(reference))
            except self.ray.exceptions.RayError as error:
                self.tell(f"a node cannot be used: {_reason(error)}")
        return found

    def nodes(self) -> list[NodeInfo]:
        """Return the nodes that are alive and have this program."""
        alive = {n["NodeID"]: n for n in self.ray.nodes() if n["Alive"]}
        for name, node in alive.items():
            if name not in self._known and name not in self._asked:
                self._asked[name] = (self._look_at(name), self.now())
        for name, (reference, since) in list(self._asked.items()):
            done, _ = self.ray.wait([reference], timeout=0)
            if done:
                del self._asked[name]
                self._known[name] = self._judge(reference, alive.get(name))
            elif self.now() - since > _PATIENCE:
                del self._asked[name]
                self._known[name] = None
                self.tell(f"node {_host(alive.get(name))} does not answer: it is not used")
        if not self._asked and alive and not any(self._known.get(name) for name in alive):
            raise NodeRefused("no node of the cluster can be used")
        found = (self._known.get(name) for name in alive)
        return [node for node in found if node is not None]

    def awaits_nodes(self) -> bool:
        """Tell whether nodes came that have not yet said what they are."""
        return bool(self._asked)

    def _look_at(self, name: str, files: Sequence[tuple[str, int, int]] = ()) -> Any:
        return self._look.options(**self._on(name)).remote(self._program, tuple(files))

    def _judge(self, reference: Any, node: dict[str, Any] | None) -> NodeInfo | None:
        if node is None:
            return None
        host = _host(node)
        try:
            found: Found = self.ray.get(reference)
        except self.ray.exceptions.RayError as error:
            self.tell(f"node {host} is not used: {_reason(error)}")
            return None
        if self._version is None:
            self._version = worker.look(self._program, ()).version
        if found.version != self._version:
            versions = f"it has {found.version}, this machine {self._version}"
            self.tell(f"node {host} is not used: {versions}")
            return None
        self._machines.add(found.machine)
        if len(self._machines) == 2:
            kinds = " and ".join(sorted(self._machines))
            self.tell(
                f"nodes differ ({kinds}): the picture depends on who rendered what, by rounding"
            )
        return self._capacity(node, host)

    def _capacity(self, node: dict[str, Any], host: str) -> NodeInfo | None:
        cpus = int(node["Resources"].get("CPU", 0))
        gpus = int(node["Resources"].get("GPU", 0))
        self._cpus[node["NodeID"]] = cpus
        if self.limits.device != "cpu" and gpus > 0:
            return NodeInfo(node["NodeID"], host, gpus, "gpu")
        if self.limits.device == "gpu" or cpus == 0:
            return None
        threads = min(self.limits.threads or cpus, cpus)
        return NodeInfo(node["NodeID"], host, cpus // threads)

    def _on(self, node: str) -> dict[str, Any]:
        strategies = self.ray.util.scheduling_strategies
        return {"scheduling_strategy": strategies.NodeAffinitySchedulingStrategy(node, soft=False)}

    # Tasks.

    def render(self, task: int, node: NodeInfo, picture: int, samples: Range) -> None:
        """Begin to render a part on a node."""
        how = self.tasks[picture]
        cpus = self._cpus[node.node]
        if node.device == "gpu":
            threads, options = max(1, cpus // node.slots), {"num_cpus": 0, "num_gpus": 1}
        else:
            threads = min(self.limits.threads or cpus, cpus)
            options = {"num_cpus": threads}
        begin = self._part.options(**options, **self._on(node.node), name=f"samples {samples}")
        base = self._base(picture, how, samples)
        references = begin.remote(how, samples, threads, node.device, self._bundle(how), base)
        self._references[task] = references

        def done(meta: dict[str, Any]) -> Event:
            return PartDone(
                task, RayFilm(references[1]), meta["size"], meta["seconds"], meta["wall"]
            )

        self._when_done(task, references, done)

    def _base(self, picture: int, how: PartTask, samples: Range) -> list[Any]:
        if how.rounds is None or samples[0] < how.rounds:
            return []
        _, film = self.bases[picture]
        return [self._in_cluster(film)]

    def _bundle(self, how: PartTask) -> list[Any]:
        if how.bundle is None:
            return []
        if how.bundle not in self._bundles:
            self._bundles[how.bundle] = self.ray.put(self.pack(how.bundle))
        # In a list it is no argument that every task fetches.
        return [self._bundles[how.bundle]]

    def merge(self, task: int, node: str | None, films: Sequence[Handle]) -> None:
        """Begin to merge films on a node, or on any."""
        where = self._on(node) if node is not None else {"scheduling_strategy": "SPREAD"}
        given = [self._in_cluster(film) for film in films if isinstance(film, RayFilm)]
        references = self._merge.options(**where).remote(self._program, *given)
        self._references[task] = [*references, *given]

        def done(meta: dict[str, Any]) -> Event:
            return MergeDone(task, RayFilm(references[1]), meta["size"], meta["seconds"])

        self._when_done(task, references, done)

    def _in_cluster(self, film: RayFilm) -> Any:
        if film.path is not None and film.reference is None:
            film.reference = self.ray.put(film.path.read_bytes())
        return film.reference

    def _when_done(
        self, task: int, references: list[Any], done: Callable[[dict[str, Any]], Event]
    ) -> None:
        def call(future: Any) -> None:
            error = future.exception()
            event = done(future.result()) if error is None else self._failure(task, error)
            self._events.put(event)

        references[0].future().add_done_callback(call)

    def _failure(self, task: int, error: BaseException) -> Failed:
        cause = getattr(error, "cause", None) or error
        if isinstance(cause, worker.ProgramFailed):
            killed = cause.was_killed
            return Failed(task, str(cause), is_final=cause.is_input, was_killed=killed)
        is_task = isinstance(error, self.ray.exceptions.RayTaskError)
        return Failed(task, _reason(cause), was_killed=not is_task)

    def cancel(self, task: int) -> None:
        """End a task whose result nobody needs."""
        references = self._references.pop(task, None)
        if references is not None:
            self.ray.cancel(references[0], force=True)

    def wait(self, seconds: float) -> list[Event]:
        """Return what has happened; wait for something at most so long."""
        events = []
        try:
            events.append(self._events.get(timeout=seconds))
            while True:
                events.append(self._events.get_nowait())
        except queue.Empty:
            pass
        for event in events:
            self._references.pop(event.task, None)
        return events

    def fetch(self, film: RayFilm) -> bytes | None:
        """Return a film's bytes; ``None``: it is no more."""
        try:
            return bytes(self.ray.get(film.reference, timeout=600.0))
        except self.ray.exceptions.RayError:
            return None


def _part(
    task: PartTask, samples: Range, threads: int, device: str, bundle: list[Any], base: list[Any]
) -> tuple[dict[str, Any], bytes]:
    def fetch() -> bytes:
        import ray

        return bytes(ray.get(bundle[0]))

    def before() -> bytes:
        import ray

        return bytes(ray.get(base[0]))

    if device == "gpu":
        import ray

        # Ray says which of the node's GPUs are free for this task.
        device = f"gpu:{ray.get_gpu_ids()[0]}"
    return worker.render_part(task, samples, threads, device, fetch, before if base else None)


def _merge(command: tuple[str, ...] | None, *films: bytes) -> tuple[dict[str, Any], bytes]:
    return worker.merge_films(command, films)


def _host(node: dict[str, Any] | None) -> str:
    return str(node["NodeManagerAddress"]) if node is not None else "?"


def _reason(error: BaseException) -> str:
    lines = [line for line in str(error).strip().splitlines() if line.strip()]
    return f"{type(error).__name__}: {lines[-1] if lines else ''}".strip(": ")
