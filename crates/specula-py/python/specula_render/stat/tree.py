"""Adaptive integrals over the sphere: a forest of patches, each halved where that is needed.

One forest serves three ends. Its leaves carry the quadrature. Its highest nodes that expect few
enough samples are the cells of a chi-square test. And it finds the cell of a direction.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from . import kronrod
from .arrays import BoolArray, FloatArray, IntArray
from .sphere import Peak, angles, are_near, bisect, extents, longer_axis

COLUMNS = 16
"""Roots in each row."""
_NARROWEST = 1e-3
"""Smallest extent of the patches of the start, radians."""
_DEEPEST = 48
"""Most cuts of a root."""


@dataclass(frozen=True)
class Accuracy:
    """When the refinement of the leaves stops."""

    relative: float = 1e-5
    """At this error, over the largest component of the integral."""
    absolute: float = 1e-7
    """Or at this one."""
    max_patches: int = 20_000
    """Or at this many leaves."""
    cell_share: float = 1.0 / 400.0
    """Leaves with more than this of the first component are halved, whatever their error."""
    samples: int = 100_000
    """Cells are to be known to a tenth of the standard deviation of their count of these."""

    def goal(self, value: FloatArray) -> float:
        """The error to reach of an integral (components,)."""
        return max(self.absolute, self.relative * float(np.abs(value).max()))


def cell_error_bound(expected: FloatArray) -> FloatArray:
    """Largest error of expected counts that leaves a chi-square test unharmed.

    Errors add to the statistic about ``(error / sqrt(expected))^2`` for each cell.
    """
    return np.asarray(0.1 * np.sqrt(np.fmax(expected, 5.0)))


class Forest:
    """Patches over the sphere, or its upper half, with the integrals of an integrand.

    Parameters
    ----------
    cos_theta_edges
        Where the integrand has steps, besides the horizon: cosines of polar angles.
    upper
        Whether to leave out the lower hemisphere.
    """

    def __init__(self, cos_theta_edges: Sequence[float] = (), *, upper: bool = False) -> None:
        rows = _rows(cos_theta_edges, upper)
        phi = np.linspace(0.0, 2.0 * np.pi, COLUMNS + 1)
        roots = [(a, b, c, d) for a, b in pairwise(rows) for c, d in pairwise(phi.tolist())]
        n = len(roots)
        self._rows: FloatArray = np.array(rows)
        self.patches: FloatArray = np.array(roots)
        self._parent: IntArray = np.full(n, -1)
        self._first: IntArray = np.full(n, -1)
        self._axis: IntArray = np.zeros(n, dtype=np.int64)
        self._at: FloatArray = np.zeros(n)
        self._depth: IntArray = np.zeros(n, dtype=np.int64)
        # The order of a walk depth first, so that neighbours in it are neighbours on the sphere.
        self._order: FloatArray = np.arange(n, dtype=np.float64)
        self.value: FloatArray = np.zeros((n, 0))
        self.error: FloatArray = np.zeros(n)
        self._worse: IntArray = np.zeros(n, dtype=np.int64)
        self.is_converged = False

    def leaves(self) -> IntArray:
        """Indices of the nodes without children."""
        return np.flatnonzero(self._first < 0)

    def locate(self, w: FloatArray) -> IntArray:
        """The leaf of each of the directions (n, 3); -1 outside the forest."""
        theta, phi = angles(w)
        row = np.searchsorted(self._rows, theta, side="right") - 1
        is_outside = theta > self._rows[-1]
        row = np.clip(row, 0, len(self._rows) - 2)
        column = np.minimum((phi / (2.0 * np.pi) * COLUMNS).astype(np.int64), COLUMNS - 1)
        node = np.asarray(row * COLUMNS + column, dtype=np.int64)
        moving = np.flatnonzero(self._first[node] >= 0)
        while moving.size:
            at = node[moving]
            place = np.where(self._axis[at] == 0, theta[moving], phi[moving])
            node[moving] = self._first[at] + (place >= self._at[at])
            moving = moving[self._first[node[moving]] >= 0]
        return np.where(is_outside, -1, node)

    def refine_about(self, peaks: Sequence[Peak], pilot: FloatArray, share: float) -> None:
        """Halves leaves near peaks, and those with more than `share` of the pilot samples (n, 3).

        To be called before `integrate`: it chooses where that starts.
        """
        most = max(share * len(pilot), 8.0)
        while True:
            leaves = self.leaves()
            extent = np.maximum(*extents(self.patches[leaves]))
            located = self.locate(pilot)
            counts = np.bincount(located[located >= 0], minlength=len(self.patches))[leaves]
            is_large = (counts > most) & (extent > _NARROWEST)
            for peak in peaks:
                width = max(peak.width, _NARROWEST)
                is_large |= (extent > 1.001 * width) & are_near(self.patches[leaves], peak)
            is_large &= self._depth[leaves] < _DEEPEST
            if not is_large.any():
                return
            split = leaves[is_large]
            self._split(split, longer_axis(self.patches[split]))

    def integrate(self, f: kronrod.Integrand, accuracy: Accuracy) -> None:
        """Integrates `f` over every leaf, and halves leaves until the accuracy is reached.

        Sets `value` (nodes, components), `error` (nodes,) and `is_converged`; inner nodes hold
        the sums of their leaves.
        """
        new = self.leaves()
        while True:
            self._measure(new, f)
            leaves = self.leaves()
            is_full, by_error = self._due(leaves, accuracy)
            if not (is_full | by_error).any():
                self._sum_up()
                by_error = self._due_in_cells(leaves, accuracy)
            is_due = (is_full | by_error) & (self._depth[leaves] < _DEEPEST)
            if not is_due.any() or len(leaves) >= accuracy.max_patches:
                break
            split = leaves[is_due]
            axis = np.where(by_error[is_due], self._worse[split], longer_axis(self.patches[split]))
            new = self._split(split, axis)
        value, error = self.totals()
        self.is_converged = error <= 1.001 * accuracy.goal(value)
        self._sum_up()

    def totals(self) -> tuple[FloatArray, float]:
        """The integral over the whole, (components,), and its estimated error."""
        leaves = self.leaves()
        return self.value[leaves].sum(axis=0), float(self.error[leaves].sum())

    def cells(self, share: float) -> tuple[IntArray, IntArray]:
        """The highest nodes with at most `share` of the first component, or leaves.

        Returns
        -------
        cells
            Their indices, neighbours next to each other.
        cell_of
            For each node of the forest, the position in `cells` of the cell that it is in; -1
            for nodes above cells.
        """
        is_cell = (self.value[:, 0] <= share) | (self._first < 0)
        top = np.full(len(self.patches), -1)
        for depth in range(int(self._depth.max()) + 1):
            here = np.flatnonzero(self._depth == depth)
            above = np.where(self._parent[here] >= 0, top[self._parent[here]], -1)
            top[here] = np.where(above >= 0, above, np.where(is_cell[here], here, -1))
        cells = np.flatnonzero(top == np.arange(len(top)))
        cells = cells[np.argsort(self._order[cells], kind="stable")]
        position = np.full(len(self.patches) + 1, -1)
        position[cells] = np.arange(len(cells))
        return cells, position[top]

    def _due(self, leaves: IntArray, accuracy: Accuracy) -> tuple[BoolArray, BoolArray]:
        """Which leaves to halve because they hold too much, and which for the total error."""
        error = self.error[leaves]
        value, total = self.totals()
        by_error = np.zeros(len(leaves), dtype=np.bool_)
        # Where the integrand is not finite no refinement helps.
        if np.isfinite(total) and total > accuracy.goal(value):
            # At least these: the error of the others is half the goal.
            worst = np.argsort(-error, kind="stable")
            rest = total - np.cumsum(error[worst])
            count = int(np.count_nonzero(rest > 0.5 * accuracy.goal(value))) + 1
            by_error[worst[:count]] = True
        with np.errstate(invalid="ignore"):
            is_full = self.value[leaves, 0] > accuracy.cell_share
        return is_full & np.isfinite(error), by_error

    def _due_in_cells(self, leaves: IntArray, accuracy: Accuracy) -> BoolArray:
        """Which leaves cause too large an error of their cell."""
        cells, cell_of = self.cells(accuracy.cell_share)
        n, error = accuracy.samples, self.error[leaves]
        bound = cell_error_bound(self.value[cells, 0] * n) / n
        is_bad = np.isfinite(self.error[cells]) & (self.error[cells] > bound)
        mine = cell_of[leaves]
        largest = np.zeros(len(cells))
        np.maximum.at(largest, mine, error)
        return np.asarray(is_bad[mine] & (error >= 0.2 * largest[mine]))

    def _measure(self, nodes: IntArray, f: kronrod.Integrand) -> None:
        value, error, worse = kronrod.integrate(self.patches[nodes], f)
        if self.value.shape[1] != value.shape[1]:
            self.value = np.zeros((len(self.patches), value.shape[1]))
        self.value[nodes], self.error[nodes], self._worse[nodes] = value, error, worse

    def _split(self, nodes: IntArray, axis: IntArray) -> IntArray:
        """Halves leaves; the new nodes' indices."""
        halves, at = bisect(self.patches[nodes], axis)
        start, added = len(self.patches), 2 * len(nodes)
        self._first[nodes] = start + 2 * np.arange(len(nodes))
        self._axis[nodes], self._at[nodes] = axis, at
        depth = np.repeat(self._depth[nodes] + 1, 2)
        second = np.tile([0.0, 1.0], len(nodes))
        order = np.repeat(self._order[nodes], 2) + second * 0.5**depth
        self.patches = np.concatenate([self.patches, halves.reshape(-1, 4)])
        self._parent = np.concatenate([self._parent, np.repeat(nodes, 2)])
        self._first = np.concatenate([self._first, np.full(added, -1)])
        self._axis = np.concatenate([self._axis, np.zeros(added, dtype=np.int64)])
        self._worse = np.concatenate([self._worse, np.zeros(added, dtype=np.int64)])
        self._at = np.concatenate([self._at, np.zeros(added)])
        self._depth = np.concatenate([self._depth, depth])
        self._order = np.concatenate([self._order, order])
        self.value = np.concatenate([self.value, np.zeros((added, self.value.shape[1]))])
        self.error = np.concatenate([self.error, np.zeros(added)])
        return np.arange(start, start + added)

    def _sum_up(self) -> None:
        """Gives inner nodes the sums of their children."""
        inner = self._first >= 0
        for depth in range(int(self._depth.max()) - 1, -1, -1):
            here = np.flatnonzero(inner & (self._depth == depth))
            first = self._first[here]
            self.value[here] = self.value[first] + self.value[first + 1]
            self.error[here] = self.error[first] + self.error[first + 1]


def _rows(cos_theta_edges: Sequence[float], upper: bool) -> list[float]:
    """Edges in theta: the poles, the horizon, the caller's, and eight about equal steps."""
    fixed = [0.0, 0.5 * np.pi, np.pi]
    fixed += [float(np.arccos(c)) for c in cos_theta_edges if abs(c) < 1.0]
    fixed = sorted(fixed)
    rows = [t for k, t in enumerate(fixed) if k == 0 or t - fixed[k - 1] > 1e-12]
    for k in range(9):
        step = np.pi * k / 8.0
        # No slivers: what is close to a fixed edge is left out.
        if min(abs(step - t) for t in rows) > np.pi / 40.0:
            rows.append(step)
    return sorted(t for t in rows if t <= 0.5 * np.pi + 1e-12 or not upper)
