"""What the engine asks of a pool of nodes: Ray's, or one that is simulated."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from specula_render.farm.ranges import Range

Handle = object
"""A film in the pool's keeping."""


@dataclass(frozen=True)
class NodeInfo:
    """A node that can render."""

    node: str
    """Its name in the pool, which no other node ever has."""
    host: str
    slots: int
    """Parts that it renders at once."""
    device: str = "cpu"


@dataclass(frozen=True)
class PartDone:
    """A part was rendered."""

    task: int
    film: Handle
    size: int
    """Bytes of the film."""
    seconds: float
    """Time that its samples took."""
    wall: float
    """Time of all: with starting, reading the scene, writing."""


@dataclass(frozen=True)
class MergeDone:
    """Films were merged."""

    task: int
    film: Handle
    size: int
    seconds: float


@dataclass(frozen=True)
class Failed:
    """A task failed."""

    task: int
    message: str
    is_final: bool = False
    """Whether it would fail anywhere: the scene or an option is wrong."""
    was_killed: bool = False
    """Whether the worker or its renderer was killed, or its node is gone: no fault of the part."""


Event = PartDone | MergeDone | Failed


class Pool(Protocol):
    """Nodes that take tasks. Tasks have numbers that the engine chooses."""

    def now(self) -> float:
        """Return the time in seconds."""
        ...

    def nodes(self) -> Sequence[NodeInfo]:
        """Return the nodes that are alive."""
        ...

    def awaits_nodes(self) -> bool:
        """Tell whether nodes came that have not yet said what they are."""
        ...

    def render(self, task: int, node: NodeInfo, picture: int, samples: Range) -> None:
        """Begin to render a part on a node."""
        ...

    def merge(self, task: int, node: str | None, films: Sequence[Handle]) -> None:
        """Begin to merge films on a node, or on any."""
        ...

    def cancel(self, task: int) -> None:
        """End a task whose result nobody needs; no event follows."""
        ...

    def wait(self, seconds: float) -> list[Event]:
        """Return what has happened; wait for something at most so long."""
        ...


class Keeper(Protocol):
    """Where films are kept for good, and what becomes of them."""

    def kept(self, picture: int) -> Sequence[tuple[Handle, Sequence[Range]]]:
        """Return the films that earlier runs have kept."""
        ...

    def keep(self, picture: int, film: Handle, ranges: Sequence[Range]) -> Handle | None:
        """Keep a film; return how it is called from now on. ``None``: it is no more."""
        ...

    def drop(self, picture: int, films: Sequence[Handle]) -> None:
        """Forget films whose sum is kept."""
        ...

    def goal(self, picture: int, have: int, film: Handle | None) -> int:
        """Return the samples that a picture is to have, by what its ``have`` samples show."""
        ...

    def finish(self, picture: int, film: Handle) -> None:
        """Write a picture that has all its samples."""
        ...

    def note(self, event: str, **facts: object) -> None:
        """Write down what happened."""
        ...
