"""The engine: gives parts to nodes, merges their films, and does again what was lost."""

from __future__ import annotations

import math
from collections import Counter, deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from specula_render.farm import ranges
from specula_render.farm.pictures import Film, Picture, Waiting
from specula_render.farm.policy import FAN_IN, Policy
from specula_render.farm.pool import Failed, Keeper, MergeDone, NodeInfo, PartDone, Pool
from specula_render.farm.speeds import Speeds

_LOOK_AFTER = 2.0
"""Seconds between two looks for nodes that came or went."""
_LOOK_SOON = 0.1
"""The same while nodes are about to say what they are."""
_LATE_AFTER = 1.0
"""Seconds between two looks for parts that are late."""
_SOMEWHERE = "?"
"""The node of a film that a node of the pool's choice has."""
_BASE = 1000
"""Level of films that hold all samples from the first on: they are merged once, in the end."""
_AT_ONCE = 30.0
"""Seconds of films that the driver takes one after the other."""
_REST = 1.0
"""Seconds that a node gets nothing after a worker was killed there."""
_DEATHS = 12
"""Workers that may die over a part, which is halved each time."""
_FAILURES_OF_NODE = 3
"""Parts that a node may fail one after the other before it gets no more."""


class RenderFailed(Exception):
    """The render cannot be done; the message says why."""

    def __init__(self, message: str, *, is_input: bool = False) -> None:
        super().__init__(message)
        self.is_input = is_input
        """Whether the scene or the options are wrong."""


@dataclass(eq=False)
class Part:
    """A part that is being rendered."""

    task: int
    picture: Picture
    work: Waiting
    node: NodeInfo
    begun: float
    expected: float
    twin: Part | None = None
    """The same part on another node."""


@dataclass(eq=False)
class Merge:
    """Films that are being merged."""

    picture: Picture
    films: list[Film]
    node: str | None


@dataclass(frozen=True)
class Status:
    """How far a render is."""

    done: int
    """Samples in films, over all pictures."""
    of: int
    pictures: int
    pictures_done: int
    slots: int
    eta: float | None
    """Seconds that are left, where that is known."""


class Engine:
    """Renders pictures on a pool of nodes.

    Parameters
    ----------
    by
        ``"frames"``: a part is all that waits of a picture; ``"samples"``: every picture is cut for
        all slots; ``"auto"``: parts take as long as the policy says.
    retries
        How often a part may fail; where its worker dies, it may at least `_DEATHS` times.
    """

    def __init__(
        self,
        pool: Pool,
        keeper: Keeper,
        pictures: int,
        *,
        policy: Policy | None = None,
        by: str = "auto",
        retries: int = 5,
        report: Callable[[Status], None] = lambda _: None,
    ) -> None:
        self.pool, self.keeper = pool, keeper
        self.policy = policy or Policy()
        self.by, self.retries, self.report = by, retries, report
        self.pictures = [Picture(i) for i in range(pictures)]
        self.speeds = Speeds()
        self.nodes: dict[str, NodeInfo] = {}
        self.idle: deque[NodeInfo] = deque()
        self.later: deque[tuple[Picture, Film]] = deque()
        self.resting: deque[tuple[float, NodeInfo]] = deque()
        self.parts: dict[int, Part] = {}
        self.merges: dict[int, Merge] = {}
        self.slots = 0
        self.attempts = self.doubled = 0
        self._tasks = self._first = self._pictures_done = 0
        self._ends = 0.0
        """Sum of the times at which the running parts are expected to end."""
        self._failures: Counter[str] = Counter()
        self._room_at, self._room = pool.now(), 0.0
        self._looked = self._late = -math.inf

    def run(self) -> None:
        """Render all pictures.

        Raises
        ------
        RenderFailed
            Where a part fails time and again, or would anywhere.
        """
        for picture in self.pictures:
            for handle, samples in self.keeper.kept(picture.index):
                self._collect(picture, Film(handle, list(samples), _level(samples), None))
            picture.open(self.keeper.goal(picture.index, 0, None))
            self._settle(picture)
        while self._pictures_done < len(self.pictures):
            self._wake()
            self._keep_later()
            self._see_nodes()
            self._assign()
            for event in self.pool.wait(_LOOK_SOON if self.pool.awaits_nodes() else 0.5):
                self._handle(event)
            self.report(self.status())

    def status(self) -> Status:
        """Return how far the render is."""
        done = sum(p.have for p in self.pictures)
        goal = sum(p.goal for p in self.pictures)
        left, speed = goal - done, self.speeds.total(self.slots)
        return Status(
            done=done,
            of=goal,
            pictures=len(self.pictures),
            pictures_done=self._pictures_done,
            slots=self.slots,
            eta=left / speed if speed > 0.0 else None,
        )

    # Nodes.

    def _see_nodes(self) -> None:
        now = self.pool.now()
        if now - self._looked < (_LOOK_SOON if self.pool.awaits_nodes() else _LOOK_AFTER):
            return
        self._looked = now
        alive = {node.node: node for node in self.pool.nodes()}
        for name in [name for name in self.nodes if name not in alive]:
            self._lose(self.nodes.pop(name))
        for name, node in alive.items():
            if name not in self.nodes and self._failures[name] < _FAILURES_OF_NODE:
                self.nodes[name] = node
                self.slots += node.slots
                self.idle.extend([node] * node.slots)
                self.keeper.note("node", node=name, host=node.host, slots=node.slots)

    def _lose(self, node: NodeInfo) -> None:
        """Give up a node, with the films that only it has."""
        self.slots -= node.slots
        self.speeds.forget(node)
        self.idle = deque(n for n in self.idle if n.node != node.node)
        self.keeper.note("lost", node=node.node, host=node.host)
        for picture in self.pictures:
            if picture.is_done:
                continue
            for film in picture.lose(node.node):
                self._restore(picture, film)

    def _restore(self, picture: Picture, film: Film) -> None:
        """Make up for a film that is lost: by what is kept of it, and by rendering the rest."""
        kept = [samples for back in film.backing for samples in back.samples]
        for samples in film.samples:
            for gap in ranges.missing(kept, *samples):
                self._again(picture, [gap])
        for back in film.backing:
            self._collect(picture, back)

    def _free(self, node: NodeInfo) -> None:
        if node.node in self.nodes:
            self.idle.append(node)

    def _rest(self, node: NodeInfo) -> None:
        """Leave a node alone for a while, on which something was killed: it may be dead itself."""
        self.resting.append((self.pool.now() + _REST, node))

    def _wake(self) -> None:
        while self.resting and self.resting[0][0] <= self.pool.now():
            self._free(self.resting.popleft()[1])

    # Parts.

    def _assign(self) -> None:
        while self.idle:
            picture = self._next_picture()
            if picture is None:
                self._double()
                return
            node = self.idle.popleft()
            self._begin(picture, picture.take(self._size(picture, node)), node)

    def _next_picture(self) -> Picture | None:
        for i in range(self._first, len(self.pictures)):
            if self.pictures[i].waiting:
                self._first = i
                return self.pictures[i]
        self._first = len(self.pictures)
        return None

    def _size(self, picture: Picture, node: NodeInfo) -> int:
        left = picture.left()
        if self.by == "frames":
            return left
        speed = self.speeds.of(node)
        if speed is None:
            return 1
        overhead = self.speeds.overhead
        seconds = self.policy.seconds_of_part(self.slots, overhead, self.speeds.merging)
        # Other pictures wait, too: there is enough for all.
        all_left = left if picture is self.pictures[-1] else sum(p.left() for p in self.pictures)
        speeds = self.speeds.total(self.slots)
        # Ends that have passed unseen count as they were expected.
        ahead = max(0.0, self._ends - len(self.parts) * self.pool.now()) / max(self.slots, 1)
        count = self.policy.samples_of_part(all_left, speed, speeds, seconds, overhead, ahead)
        if self.by == "samples":
            count = min(count, max(1, math.ceil(picture.goal / self.slots)))
        # What was measured in a moment says little about an hour.
        most = self.speeds.longest + speed * self.speeds.longest_wall
        return min(count, math.ceil(self.policy.growth * most))

    def _begin(
        self, picture: Picture, work: Waiting, node: NodeInfo, of: Part | None = None
    ) -> None:
        self._tasks += 1
        count = work.samples[1] - work.samples[0]
        expected = self._duration(node, count)
        part = Part(self._tasks, picture, work, node, self.pool.now(), expected, of)
        self.parts[part.task] = part
        self._ends += part.begun + part.expected
        picture.running += 1
        self.attempts += 1
        if of is not None:
            of.twin = part
            self.doubled += 1
        self.keeper.note(
            "begin",
            task=part.task,
            picture=picture.index,
            samples=work.samples,
            node=node.node,
            twin=of is not None,
        )
        self.pool.render(part.task, node, picture.index, work.samples)

    def _end(self, task: int) -> Part | None:
        part = self.parts.pop(task, None)
        if part is not None:
            self._ends -= part.begun + part.expected
        return part

    def _duration(self, node: NodeInfo, count: int) -> float:
        speed = self.speeds.of(node)
        if speed is None:
            return self.policy.part_seconds
        return count / speed + self.speeds.overhead

    def _double(self) -> None:
        """Render again, on idle slots, what would be done there before."""
        now = self.pool.now()
        if now - self._late < _LATE_AFTER:
            return
        self._late = now
        single = [p for p in self.parts.values() if p.twin is None]
        single.sort(key=lambda p: p.begun + p.expected, reverse=True)
        for part in single:
            if not self.idle:
                return
            node = self.idle[0]
            count = part.work.samples[1] - part.work.samples[0]
            here = self._duration(node, count)
            if node.node == part.node.node and node.slots == 1:
                continue
            if self.policy.pays_twice(now - part.begun, part.expected, here):
                self.idle.popleft()
                self._begin(part.picture, part.work, node, of=part)

    # What has happened.

    def _handle(self, event: PartDone | MergeDone | Failed) -> None:
        if isinstance(event, PartDone):
            if (part := self._end(event.task)) is not None:
                self._part_done(part, event)
        elif isinstance(event, MergeDone):
            if (merge := self.merges.pop(event.task, None)) is not None:
                self._merge_done(merge, event)
        elif (part := self._end(event.task)) is not None:
            self._part_failed(part, event)
        elif (merge := self.merges.pop(event.task, None)) is not None:
            self._merge_failed(merge, event)

    def _part_done(self, part: Part, done: PartDone) -> None:
        picture, samples = part.picture, part.work.samples
        count = samples[1] - samples[0]
        self.speeds.learn(part.node, count, done.seconds, done.wall, done.size)
        self._failures[part.node.node] = 0
        picture.running -= 1
        self._free(part.node)
        self.keeper.note("done", task=part.task, seconds=done.seconds, wall=done.wall)
        if (twin := part.twin) is not None and self._end(twin.task) is not None:
            self.pool.cancel(twin.task)
            picture.running -= 1
            self._free(twin.node)
        picture.have += count
        self._add(picture, Film(done.film, [samples], 0, part.node.node, done.size))

    def _part_failed(self, part: Part, failed: Failed) -> None:
        part.picture.running -= 1
        name = part.node.node
        self.keeper.note("failed", task=part.task, node=name, message=failed.message)
        if failed.is_final:
            raise RenderFailed(failed.message, is_input=True)
        self._failures[name] += not failed.was_killed
        if self._failures[name] >= _FAILURES_OF_NODE and name in self.nodes:
            self._lose(self.nodes.pop(name))
            if not self.nodes:
                raise RenderFailed(f"the last node fails every part: {failed.message}")
        (self._rest if failed.was_killed else self._free)(part.node)
        if (twin := part.twin) is not None:
            twin.twin = None
            return
        attempts = part.work.attempts + 1
        allowed = max(self.retries, _DEATHS) if failed.was_killed else self.retries
        if attempts > allowed:
            text = ranges.text([part.work.samples])
            text = f"samples {text} failed {attempts} times; the last time: {failed.message}"
            raise RenderFailed(text)
        first, end = part.work.samples
        # Where workers die often, short parts are done before the next one does.
        middle = (first + end) // 2 if failed.was_killed else first
        for samples in ((middle, end), (first, middle)):
            if samples[0] < samples[1]:
                part.picture.retry(Waiting(samples, attempts))
        self._first = min(self._first, part.picture.index)

    def _merge_done(self, merge: Merge, done: MergeDone) -> None:
        self.speeds.learn_merge(done.seconds / len(merge.films))
        picture = merge.picture
        picture.merging -= 1
        samples = ranges.union(r for film in merge.films for r in film.samples)
        level = max(film.level for film in merge.films) + 1
        film = Film(done.film, samples, level, merge.node or _SOMEWHERE, done.size)
        for source in merge.films:
            film.backing += [source] if source.node is None else source.backing
        self._add(picture, film)

    def _merge_failed(self, merge: Merge, failed: Failed) -> None:
        self.keeper.note("merge failed", message=failed.message)
        if failed.is_final:
            raise RenderFailed(failed.message)
        merge.picture.merging -= 1
        for film in merge.films:
            # What the driver keeps is merged anew; of the others nobody knows which are no more.
            if film.node is None:
                self._collect(merge.picture, film)
            else:
                self._restore(merge.picture, film)
        self._settle(merge.picture)

    def _again(self, picture: Picture, samples: Sequence[ranges.Range]) -> None:
        for r in samples:
            picture.retry(Waiting(r, 0))
        picture.have -= ranges.count(samples)
        self._first = min(self._first, picture.index)

    # Films.

    def stop(self) -> None:
        """End all that runs."""
        for task in [*self.parts, *self.merges]:
            self.pool.cancel(task)

    def _keep_level(self) -> int:
        part = self.policy.seconds_of_part(self.slots, self.speeds.overhead, self.speeds.merging)
        return self.policy.keep_level(self.slots, part, self.speeds.film_bytes)

    def _add(self, picture: Picture, film: Film, must_keep: bool = False) -> None:
        """Add a film, which the driver keeps or its node has."""
        is_last = not picture.waiting and picture.running + picture.merging == 0
        is_last = is_last and not picture.films()
        if must_keep or is_last or self._can_keep(picture, film):
            if not self._keep_now(picture, film):
                self._restore(picture, film)
                self._settle(picture)
                return
        elif film.level >= self._keep_level():
            self.later.append((picture, film))
        self._collect(picture, film)
        self._settle(picture)

    def _keep_later(self) -> None:
        """Keep films for which there was no time when they came."""
        while self.later:
            picture, film = self.later[0]
            is_there = film in picture.groups.get(film.level, []) and film.node is not None
            if is_there and picture.waiting and not self._has_room(film):
                return
            self.later.popleft()
            if is_there and picture.waiting:
                self._keep_now(picture, film)

    def _keep_now(self, picture: Picture, film: Film) -> bool:
        kept = self.keeper.keep(picture.index, film.handle, film.samples)
        if kept is None:
            return False
        film.handle, film.node = kept, None
        self.keeper.drop(picture.index, [back.handle for back in film.backing])
        film.backing = []
        return True

    def _can_keep(self, picture: Picture, film: Film) -> bool:
        """Whether the driver has time for a film."""
        if not picture.waiting and not self.policy.can_keep_last(self.slots, film.size):
            return False
        if film.level < self._keep_level():
            return False
        return self._has_room(film)

    def _has_room(self, film: Film) -> bool:
        now, rate = self.pool.now(), self.policy.driver_bytes
        room = self._room + rate * (now - self._room_at)
        # At the start and after a quiet time a few films are taken at once.
        self._room_at, self._room = now, min(room, rate * _AT_ONCE)
        if film.size > max(self._room, rate):
            return False
        self._room -= film.size
        return True

    def _collect(self, picture: Picture, film: Film) -> None:
        size = FAN_IN if picture.waiting else self._last_fan_in()
        if (group := picture.add(film, size)) is not None:
            self._merge(picture, group)

    def _last_fan_in(self) -> int:
        return self.policy.last_fan_in(self.speeds.merging)

    def _settle(self, picture: Picture) -> None:
        """Once no more parts come, merge what there is; finish a picture that is one film."""
        if picture.is_done or picture.waiting or picture.running or picture.merging:
            return
        for group in picture.last_groups(self._last_fan_in()):
            self._merge(picture, group)
        films = picture.films()
        if picture.merging or len(films) != 1:
            return
        last = films[0]
        if last.node is not None:
            picture.groups.clear()
            self._add(picture, last, must_keep=True)
            return
        goal = self.keeper.goal(picture.index, picture.have, last.handle)
        if goal > picture.have:
            picture.groups.clear()
            last.level = _BASE
            picture.add(last)
            picture.open(goal)
            self._first = min(self._first, picture.index)
            return
        picture.is_done = True
        self._pictures_done += 1
        self.keeper.finish(picture.index, last.handle)

    def _merge(self, picture: Picture, films: list[Film]) -> None:
        self._tasks += 1
        places = Counter(film.node for film in films if film.node in self.nodes)
        node = places.most_common(1)[0][0] if places else None
        self.merges[self._tasks] = Merge(picture, films, node)
        picture.merging += 1
        self.pool.merge(self._tasks, node, [film.handle for film in films])


def _level(samples: Sequence[ranges.Range]) -> int:
    return _BASE if samples[0][0] == 0 else 1
