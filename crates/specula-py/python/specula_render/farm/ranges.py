"""Sets of sample indices, as sorted half-open ranges."""

from __future__ import annotations

from collections.abc import Iterable

Range = tuple[int, int]


def union(ranges: Iterable[Range]) -> list[Range]:
    """Return the same samples as sorted ranges of which no two touch."""
    merged: list[Range] = []
    for first, end in sorted(ranges):
        if merged and first <= merged[-1][1]:
            merged[-1] = (merged[-1][0], max(end, merged[-1][1]))
        elif first < end:
            merged.append((first, end))
    return merged


def missing(have: Iterable[Range], first: int, end: int) -> list[Range]:
    """Return what ``have`` lacks of ``first..end``."""
    gaps = []
    for a, b in union(have):
        if a > first:
            gaps.append((first, min(a, end)))
        first = max(first, b)
        if first >= end:
            break
    if first < end:
        gaps.append((first, end))
    return [(a, b) for a, b in gaps if a < b]


def overlap(one: Iterable[Range], other: Iterable[Range]) -> bool:
    """Whether the sets have a sample in common."""
    together = sorted([*one, *other])
    return any(before[1] > after[0] for before, after in zip(together, together[1:]))


def count(ranges: Iterable[Range]) -> int:
    """Return the number of samples, of ranges that do not overlap."""
    return sum(end - first for first, end in ranges)


def text(ranges: Iterable[Range]) -> str:
    """Return ``0-64+128-192``."""
    return "+".join(f"{first}-{end}" for first, end in ranges)
