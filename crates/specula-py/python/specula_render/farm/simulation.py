"""A farm that is simulated: the engine itself, on nodes that only take time.

A discrete-event simulation. What a task takes was measured with the engine on Ray; nodes fail at
random (exponential), parts take longer than they should at random, and everything that passes
through the driver waits for it.
"""

from __future__ import annotations

import argparse
import heapq
import math
import random
from collections.abc import Sequence
from dataclasses import dataclass, field

from specula_render.farm.engine import Engine
from specula_render.farm.policy import Policy
from specula_render.farm.pool import Event, Failed, Handle, MergeDone, NodeInfo, PartDone
from specula_render.farm.ranges import Range

_DAY = 86400.0


@dataclass(frozen=True)
class Farm:
    """What is simulated. Times in seconds, sizes in bytes, rates in bytes per second."""

    hours: float = 1.0
    """What the render takes on all nodes, if nothing but rendering took time."""
    sample: float = 0.5
    """A sample of every pixel on one node."""
    film: float = 400e6
    """A film: 3840 x 2160 pixels, deflated."""
    load: float = 10.0
    """To read and prepare the scene."""
    scene: float = 1e9
    failures: float = 1.0
    """Per node and day."""
    seed: int = 1
    start: float = 0.5
    """To start the program and write the film."""
    task: float = 0.004
    """Of the driver, for each task."""
    merging: float = 2.0
    """To add a film to another."""
    link: float = 125e6
    """Of every node, and of the driver: 1 Gbit/s."""
    spread: float = 0.1
    """Standard deviation of the logarithm of the nodes' speeds."""
    stragglers: float = 0.01
    """Share of parts that take three times as long."""
    repair: float = 600.0
    """Until a node that failed is back."""

    @staticmethod
    def of(given: argparse.Namespace) -> Farm:
        """Return the farm that options of the command line describe."""
        return Farm(
            hours=given.hours,
            film=given.film * 1e6,
            load=given.load,
            scene=given.scene_size * 1e6,
            failures=given.failures,
            seed=given.seed,
        )


PLAIN = Policy(
    most_part_seconds=60.0,
    driver_bytes=1e18,
    growth=1e9,
    duplicates=False,
    subtotals=False,
)
"""What a simple script does: parts of a minute, all films to the driver, nothing twice."""


@dataclass(eq=False)
class _Film:
    size: float
    node: str | None


@dataclass(eq=False)
class _Node:
    info: NodeInfo
    speed: float
    fails: float
    has_scene: bool = False
    tasks: set[int] = field(default_factory=set)
    late: float = 0.0
    """What merging takes from the part that is being rendered."""


class SimulatedPool:
    """Nodes that only take time, and a keeper that only counts."""

    def __init__(self, count: int, farm: Farm) -> None:
        self.farm = farm
        self.random = random.Random(farm.seed)
        self.time = self.driver_free = 0.0
        self.busy = 0.0
        """What the driver has been busy."""
        self.failed = 0
        self._events: list[tuple[float, int, Event | _Node | None]] = []
        self._gone: set[int] = set()
        self._count = self._scenes = 0
        self._alive: dict[str, _Node] = {}
        for _ in range(count):
            self._add()
        self.samples = round(sum(n.speed for n in self._alive.values()) * farm.hours * 3600.0)
        self.ideal = self.samples / sum(n.speed for n in self._alive.values())

    def _add(self) -> None:
        farm = self.farm
        name = f"{len(self._alive)}-{self._count}"
        speed = math.exp(self.random.gauss(0.0, farm.spread)) / farm.sample
        fails = self.time + self.random.expovariate(max(farm.failures, 1e-9) / _DAY)
        node = _Node(NodeInfo(name, name, 1), speed, fails)
        self._alive[name] = node
        self._push(fails, node)

    def _push(self, time: float, event: Event | _Node | None) -> None:
        self._count += 1
        heapq.heappush(self._events, (time, self._count, event))

    def _drive(self, seconds: float) -> float:
        """Have the driver do something; return when it is done."""
        self.driver_free = max(self.driver_free, self.time) + seconds
        self.busy += seconds
        return self.driver_free

    # The pool.

    def now(self) -> float:
        """Return the simulated time."""
        return self.time

    def nodes(self) -> list[NodeInfo]:
        """Return the nodes that are alive."""
        return [node.info for node in self._alive.values()]

    def awaits_nodes(self) -> bool:
        """Nodes say at once what they are."""
        return False

    def render(self, task: int, node: NodeInfo, picture: int, samples: Range) -> None:
        """Begin a part."""
        farm, at = self.farm, self._alive.get(node.node)
        begins = self._drive(farm.task)
        if at is None:
            self._push(begins, Failed(task, "no such node", was_killed=True))
            return
        if not at.has_scene:
            # Nodes that have it give it to others: twice as many after every transfer.
            at.has_scene = True
            self._scenes += 1
            begins += farm.scene / farm.link * math.ceil(math.log2(self._scenes + 1))
        seconds = (samples[1] - samples[0]) / at.speed
        if self.random.random() < farm.stragglers:
            seconds *= 3.0
        at.tasks.add(task)
        wall = farm.start + farm.load + seconds + at.late
        at.late = 0.0
        film = _Film(farm.film, node.node)
        self._push(begins + wall, PartDone(task, film, int(farm.film), seconds, wall))

    def merge(self, task: int, node: str | None, films: Sequence[Handle]) -> None:
        """Begin to merge."""
        farm = self.farm
        begins = self._drive(farm.task)
        at = self._alive.get(node) if node is not None else self._any()
        given = [film for film in films if isinstance(film, _Film)]
        if at is None or any(f.node is not None and f.node not in self._alive for f in given):
            self._push(begins, Failed(task, "a film is no more", was_killed=True))
            return
        away = sum(f.size for f in given if f.node != at.info.node)
        seconds = away / farm.link + len(given) * farm.merging
        at.late += len(given) * farm.merging
        at.tasks.add(task)
        film = _Film(farm.film, at.info.node)
        self._push(begins + seconds, MergeDone(task, film, int(farm.film), seconds))

    def _any(self) -> _Node | None:
        # Of the order in which nodes came, which is not that of their speeds.
        names = list(self._alive) if len(self._alive) < 64 else None
        if names is None:
            self._names = getattr(self, "_names", list(self._alive))
            for _ in range(64):
                node = self._alive.get(self.random.choice(self._names))
                if node is not None:
                    return node
            return None
        return self._alive[self.random.choice(names)] if names else None

    def cancel(self, task: int) -> None:
        """Forget a task."""
        self._gone.add(task)

    def wait(self, seconds: float) -> list[Event]:
        """Go on in time to what happens next."""
        end = self.time + seconds
        found: list[Event] = []
        while self._events and not found:
            time, _, event = self._events[0]
            if time > end:
                break
            heapq.heappop(self._events)
            self.time = max(self.time, time)
            if isinstance(event, _Node):
                found += self._fail(event)
            elif event is None:
                self._add()
            elif event.task not in self._gone:
                self._gone.add(event.task)
                found.append(event)
        # What the driver is told waits until it listens.
        self.time = max(self.time, self.driver_free) if found else max(self.time, end)
        return found

    def _fail(self, node: _Node) -> list[Event]:
        self.failed += 1
        self._alive.pop(node.info.node, None)
        self._push(self.time + self.farm.repair, None)
        lost = [task for task in node.tasks if task not in self._gone]
        self._gone.update(lost)
        return [Failed(task, "the node failed", was_killed=True) for task in lost]

    # The keeper.

    def kept(self, picture: int) -> list[tuple[Handle, list[Range]]]:
        """Nothing was kept."""
        return []

    def keep(self, picture: int, film: Handle, ranges: Sequence[Range]) -> Handle | None:
        """Take a film to the driver, which does nothing else meanwhile."""
        assert isinstance(film, _Film)
        if film.node is not None and film.node not in self._alive:
            return None
        self._drive(film.size / self.farm.link)
        return _Film(film.size, None)

    def drop(self, picture: int, films: Sequence[Handle]) -> None:
        """Forget films."""

    def goal(self, picture: int, have: int, film: Handle | None) -> int:
        """Return the samples of the picture."""
        return self.samples

    def finish(self, picture: int, film: Handle) -> None:
        """Nothing is written."""

    def note(self, event: str, **facts: object) -> None:
        """Nothing is noted."""


@dataclass(frozen=True)
class Outcome:
    """What a simulated render came to."""

    efficiency: float
    """Time of rendering alone, with nodes that never fail, over the time that it took."""
    driver: float
    """Share of the time that the driver was busy."""
    parts: int
    doubled: int
    failed: int
    """Nodes that failed."""


def simulate(count: int, farm: Farm, policy: Policy | None = None) -> Outcome:
    """Render one picture on so many nodes."""
    pool = SimulatedPool(count, farm)
    engine = Engine(pool, pool, 1, policy=policy, retries=1000)
    engine.run()
    took = max(pool.time, pool.driver_free)
    return Outcome(
        pool.ideal / took, pool.busy / took, engine.attempts, engine.doubled, pool.failed
    )


def table(counts: Sequence[int], farm: Farm) -> str:
    """Return a table in Markdown: this engine, and what a simple script does."""
    lines = [
        "| nodes | efficiency | driver busy | parts | twice | failed nodes | a simple script |",
        "|---|---|---|---|---|---|---|",
    ]
    for count in counts:
        found = simulate(count, farm)
        # Of more nodes it takes hours to see that the driver does nothing but take films.
        plain = f"{simulate(count, farm, PLAIN).efficiency:.2f}" if count <= 1000 else "-"
        lines.append(
            f"| {count:,} | {found.efficiency:.2f} | {found.driver:.0%} | {found.parts:,} "
            f"| {found.doubled:,} | {found.failed:,} | {plain} |"
        )
    return "\n".join(lines)
