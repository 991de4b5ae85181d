"""What the engine has measured: speeds of nodes, and what parts cost beside their samples."""

from __future__ import annotations

from specula_render.farm.pool import NodeInfo

_NEWEST = 0.5
"""Weight of the newest figure in a mean."""


class Speeds:
    """Running means of what was measured."""

    def __init__(self) -> None:
        self.overhead = 0.0
        """Seconds that a part takes beside its samples."""
        self.merging = 0.0
        """Seconds that it takes to add a film to others."""
        self.film_bytes = 0.0
        self.longest = 0
        """Samples of the longest part so far."""
        self.longest_wall = 0.0
        """What it took, in seconds."""
        self._slots: dict[str, float] = {}
        self._sum = 0.0

    def learn(self, node: NodeInfo, samples: int, seconds: float, wall: float, size: int) -> None:
        """Take in a part that was rendered."""
        speed = samples / max(seconds, 1e-3)
        before = self._slots.get(node.node)
        if before is not None:
            # A long part says more than a short one, which measures how a render begins.
            weight = _NEWEST if samples * 2 >= self.longest else 0.1
            speed = before + weight * (speed - before)
        self._sum += speed - (before or 0.0)
        self._slots[node.node] = speed
        self.overhead = _mean(self.overhead, max(wall - seconds, 0.0))
        self.film_bytes = _mean(self.film_bytes, float(size))
        if samples >= self.longest:
            self.longest, self.longest_wall = samples, wall

    def learn_merge(self, seconds: float) -> None:
        """Take in what it took to add a film to others."""
        self.merging = _mean(self.merging, seconds)

    def forget(self, node: NodeInfo) -> None:
        """Forget a node that is no more."""
        self._sum -= self._slots.pop(node.node, 0.0)

    def of(self, node: NodeInfo) -> float | None:
        """Return the samples per second of one of a node's slots: the mean before it was measured.

        ``None``: nothing was measured yet.
        """
        if not self._slots:
            return None
        return self._slots.get(node.node) or self.total(1)

    def total(self, slots: int) -> float:
        """Return the samples per second of so many slots; the mean for those not measured."""
        if not self._slots:
            return 0.0
        return max(self._sum, 1e-9) / len(self._slots) * slots


def _mean(before: float, new: float) -> float:
    return new if before == 0.0 else before + _NEWEST * (new - before)
