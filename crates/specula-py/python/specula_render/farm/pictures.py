"""A picture in the making: samples that wait, films that are there."""

from __future__ import annotations

from dataclasses import dataclass, field

from specula_render.farm import ranges
from specula_render.farm.policy import FAN_IN
from specula_render.farm.pool import Handle
from specula_render.farm.ranges import Range


@dataclass(eq=False)
class Film:
    """A film, and where it is."""

    handle: Handle
    samples: list[Range]
    level: int
    """How often films were merged into it."""
    node: str | None
    """The node that has it; ``None``: the driver keeps it."""
    size: int = 0
    """Bytes."""
    backing: list[Film] = field(default_factory=list)
    """Films that the driver keeps and that are in this one, for the case that it is lost."""


@dataclass(frozen=True)
class Waiting:
    """Samples that nobody renders."""

    samples: Range
    attempts: int = 0
    """How often they were tried."""


@dataclass(eq=False)
class Picture:
    """A picture in the making."""

    index: int
    goal: int = 0
    """Samples that it is to have by now."""
    waiting: list[Waiting] = field(default_factory=list)
    running: int = 0
    """Parts that are being rendered."""
    merging: int = 0
    """Groups of films that are being merged."""
    groups: dict[int, list[Film]] = field(default_factory=dict)
    """All films that are in no merge, by level."""
    is_done: bool = False
    have: int = 0
    """Samples in films."""

    def open(self, goal: int) -> None:
        """Have all samples up to a goal wait that are in no film."""
        self.goal = goal
        covered = [r for film in self.films() for r in film.samples]
        self.waiting = [Waiting(gap) for gap in ranges.missing(covered, 0, goal)]
        self.have = ranges.count(ranges.union(covered))

    def left(self) -> int:
        """Return the samples that wait."""
        return sum(w.samples[1] - w.samples[0] for w in self.waiting)

    def take(self, count: int) -> Waiting:
        """Take samples off those that wait: what was tried before first."""
        first = self.waiting.pop(0)
        a, b = first.samples
        if a + count < b:
            self.waiting.insert(0, Waiting((a + count, b), first.attempts))
            first = Waiting((a, a + count), first.attempts)
        return first

    def retry(self, again: Waiting) -> None:
        """Have samples wait again."""
        self.waiting.insert(0, again)

    def films(self) -> list[Film]:
        """Return all films that are in no merge."""
        return [film for group in self.groups.values() for film in group]

    def add(self, film: Film, size: int = FAN_IN) -> list[Film] | None:
        """Add a film; take the group that it makes large enough to merge.

        Parameters
        ----------
        size
            Films of such a group.
        """
        group = self.groups.setdefault(film.level, [])
        group.append(film)
        return self.groups.pop(film.level) if len(group) >= size else None

    def lose(self, node: str) -> list[Film]:
        """Take out the films that only a node has."""
        lost = [film for film in self.films() if film.node == node]
        for key, group in list(self.groups.items()):
            self.groups[key] = [film for film in group if film.node != node]
        return lost

    def last_groups(self, size: int) -> list[list[Film]]:
        """Take all films in groups, once no more will come; one that stays alone is left."""
        films = sorted(self.films(), key=lambda f: (f.level, f.node or "", f.samples))
        groups = [films[i : i + size] for i in range(0, len(films), size)]
        self.groups.clear()
        for group in groups:
            if len(group) == 1:
                self.add(group[0])
        return [group for group in groups if len(group) > 1]
