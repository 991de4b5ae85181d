"""How work is cut, kept and repeated: the decisions that the engine and its simulation share."""

from __future__ import annotations

from dataclasses import dataclass

FAN_IN = 8
"""Films that one task merges."""


@dataclass(frozen=True)
class Policy:
    """Figures that decide. Times are in seconds, rates in bytes per second."""

    part_seconds: float = 60.0
    """What a part takes: what is lost when its worker dies."""
    most_part_seconds: float = 900.0
    """What a part takes at most, however dear all around it is."""
    least_part_seconds: float = 1.0
    least_overheads: float = 6.0
    """A part that is not among the last takes at least so many times what it costs beside."""
    overhead_share: float = 0.02
    """Share of a part's time that starting, reading the scene and merging its film may take."""
    task_seconds: float = 0.004
    """What the driver spends on a task."""
    driver_share: float = 0.25
    """Share of its time that the driver may spend on tasks."""
    driver_bytes: float = 50e6
    """What the driver takes of films: half of a network of 1 Gbit/s."""
    merge_start: float = 0.5
    """What a task that merges takes beside merging."""
    growth: float = 8.0
    """A part takes at most so many times as long as the longest before it."""
    lateness: float = 1.5
    """A part that takes so many times what was expected is late."""
    duplicates: bool = True
    """Whether a part is rendered twice at the end, where an idle node is likely to be faster."""
    subtotals: bool = True
    """Whether films are merged on the workers before they come to the driver."""

    def seconds_of_part(self, slots: int, overhead: float, merging: float) -> float:
        """Return how long a part should take.

        Parameters
        ----------
        slots
            Parts that are rendered at once.
        overhead
            What a part takes beside its samples.
        merging
            What it takes to add a film to another.
        """
        by_overhead = (overhead + merging) / self.overhead_share
        by_driver = slots * self.task_seconds / self.driver_share
        most = max(self.part_seconds, by_overhead, by_driver)
        return min(most, self.most_part_seconds)

    def keep_level(self, slots: int, part_seconds: float, film_bytes: float) -> int:
        """Return how often films are merged on the workers before they come to the driver.

        A film of level L is the sum of `FAN_IN` to the L parts. A node that dies takes with it what
        it has not yet handed over: on average the parts of all nodes that were not, over the nodes.
        """
        if not self.subtotals:
            return 0
        rate = slots / part_seconds * film_bytes
        level = 0
        while rate > self.driver_bytes and level < 8:
            rate /= FAN_IN
            level += 1
        return level

    def can_keep_last(self, slots: int, film_bytes: float) -> bool:
        """Whether the driver can take a film of every slot at the end, when all wait for it."""
        return slots * film_bytes <= 2.0 * self.driver_bytes

    def last_fan_in(self, merging: float) -> int:
        """Return how many films a task merges at the end, when nodes are idle and time counts.

        A tree of pairs is done first; but starting a task takes time, too.
        """
        return min(FAN_IN, 2 + int(self.merge_start / max(merging, 1e-3)))

    def samples_of_part(
        self,
        left: int,
        speed: float,
        speeds: float,
        seconds: float,
        overhead: float,
        ahead: float,
    ) -> int:
        """Return the samples of the next part of a slot.

        Parts are as long as they should be, and shorter near the end (guided self-scheduling,
        Polychronopoulos and Kuck 1987): half of what is left for every slot. Where that would be
        little more than what a part costs beside its samples, the slot takes what it can do until
        all are done.

        Parameters
        ----------
        left
            Samples that are not in any part.
        speed, speeds
            Samples per second, of this slot and of all together.
        seconds
            How long a part should take.
        overhead
            What a part takes beside its samples.
        ahead
            In how many seconds a slot is free, in the mean over all slots.
        """
        least = max(self.least_part_seconds, min(self.least_overheads * overhead, seconds))
        share = left / speeds / 2.0
        if share < least:
            # All that is left is shared out: the slots that are free later take less.
            # Among many, one is always late: then short parts cost less than they save.
            most = least * (1.0 + 4.0 * speed / speeds)
            share = min(max(left / speeds + ahead, self.least_part_seconds, overhead), most)
        samples = max(1, round(speed * min(share, seconds)))
        return left if left - samples < speed * overhead / 2 else min(samples, left)

    def pays_twice(self, elapsed: float, expected: float, here: float) -> bool:
        """Whether to render a running part again.

        Parameters
        ----------
        elapsed, expected
            How long it has been running, and how long it was to take.
        here
            How long it would take on the idle slot.
        """
        if not self.duplicates:
            return False
        # What is late will take as long again as it has, by all that is known of it.
        late = elapsed > expected * self.lateness
        return here < (elapsed if late else expected - elapsed) * 0.8
