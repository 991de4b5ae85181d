"""Keeps films in the job's folder, writes pictures, and says when adaptive sampling is done."""

from __future__ import annotations

import json
import struct
import subprocess
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from specula_render.farm import film, ranges, worker
from specula_render.farm.engine import RenderFailed
from specula_render.farm.pool import Handle
from specula_render.farm.ranges import Range
from specula_render.farm.ray_pool import RayFilm
from specula_render.farm.request import SHARES, PictureRequest, Request
from specula_render.farm.store import Store

_LIVE_SHARE = 20.0
"""Live pictures take at most one in so many seconds."""
_LIVE_EVERY = 15.0


class JobKeeper:
    """Where the films of a job are, and what becomes of them.

    Parameters
    ----------
    fetch
        Gives the bytes of a film in the cluster; ``None``: it is no more.
    """

    def __init__(
        self,
        store: Store,
        request: Request,
        pictures: Sequence[PictureRequest],
        fetch: Callable[[RayFilm], bytes | None],
    ) -> None:
        self.store, self.request, self.pictures = store, request, pictures
        self.fetch = fetch
        self.bases: dict[int, tuple[int, RayFilm]] = {}
        """Of adaptive pictures, the film that a round goes on with, and its samples."""
        self._changed: dict[int, float] = {}
        self._work: dict[str, float] = {}
        """Of adaptive pictures, by key, the work that the last round came to."""
        self._live: tuple[subprocess.Popen[bytes], float] | None = None
        self._next_live = time.monotonic() + _LIVE_EVERY

    def kept(self, picture: int) -> list[tuple[Handle, list[Range]]]:
        """Return the films that earlier runs have kept."""
        most = None if self.request.in_rounds else self.request.spp
        return [
            (RayFilm(None, path), samples)
            for path, samples in self.store.films(self.pictures[picture].key)
            # A film of more samples than are asked for is no part of this picture.
            if most is None or samples[-1][1] <= most
        ]

    def keep(self, picture: int, film: Handle, ranges: Sequence[Range]) -> Handle | None:
        """Write a film into the job's folder."""
        assert isinstance(film, RayFilm)
        if film.path is not None:
            return film
        data = self.fetch(film)
        if data is None:
            return None
        film.path = self.store.keep(self.pictures[picture].key, ranges, data)
        self._changed[picture] = time.monotonic()
        return film

    def drop(self, picture: int, films: Sequence[Handle]) -> None:
        """Remove films whose sum is kept."""
        self.store.drop([f.path for f in films if isinstance(f, RayFilm) and f.path is not None])

    def goal(self, picture: int, have: int, film: Handle | None) -> int:
        """Return the samples that a picture is to have; of adaptive ones, the shares of rounds."""
        if not self.request.in_rounds:
            return self.request.spp
        if film is None:
            return self._first_goal(picture)
        assert isinstance(film, RayFilm) and film.path is not None
        self.bases[picture] = (have, film)
        return have if self._is_done(film.path) else have + SHARES

    def _first_goal(self, picture: int) -> int:
        """Return the end of the round that was begun: its films go on with the one before it."""
        films = self.kept(picture)
        end = max((samples[-1][1] for _, samples in films), default=1)
        first = (end - 1) // SHARES * SHARES
        for handle, samples in films:
            if ranges.count(samples) == samples[-1][1] == first and isinstance(handle, RayFilm):
                self.bases[picture] = (first, handle)
        if first > 0 and picture not in self.bases:
            # All rounds so far are one film.
            return end
        return first + SHARES

    def _is_done(self, path: Path) -> bool:
        head = film.read_head(path)
        before, self._work[path.parent.name] = self._work.get(path.parent.name), head.work
        if head.work >= self.request.spp or head.work == before:
            return True
        if self.request.noise is None:
            return False
        printed = worker.run([*worker.program(self.request.program), "info", "--film", str(path)])
        # The program compares in single precision.
        noise = json.loads(printed)["noise"]
        return noise is not None and _single(noise) <= _single(self.request.noise)

    def finish(self, picture: int, film: Handle) -> None:
        """Write the picture's files."""
        self._end_live()
        assert isinstance(film, RayFilm) and film.path is not None
        outputs = self.pictures[picture].outputs
        try:
            worker.run(self._merge([film.path], outputs))
        except worker.ProgramFailed as error:
            raise RenderFailed(f"{error} (all samples are in '{film.path}')") from error
        self._changed.pop(picture, None)
        self.note("finished", picture=picture, outputs=[str(o) for o in outputs])

    def note(self, event: str, **facts: object) -> None:
        """Write a line of the journal."""
        self.store.note(event, **facts)

    # Live pictures.

    def _merge(self, films: Sequence[Path], outputs: Sequence[Path]) -> list[str]:
        out = [word for output in outputs for word in ("-o", str(output))]
        command = [*worker.program(self.request.program), "merge", *map(str, films)]
        return [*command, "--quiet", *self.request.display, *out]

    def live(self) -> None:
        """Write, in the background, the picture that changed last as it is now."""
        now = time.monotonic()
        if self._live is not None:
            process, begun = self._live
            if process.poll() is None:
                return
            self._live = None
            self._next_live = now + max(_LIVE_EVERY, _LIVE_SHARE * (now - begun))
        if now < self._next_live or not self._changed:
            return
        picture = max(self._changed, key=self._changed.__getitem__)
        del self._changed[picture]
        films, outputs = self._films(picture), self._pictures(picture)
        if films and outputs:
            command = self._merge(films, outputs)
            quiet = subprocess.DEVNULL
            alone = subprocess.Popen(command, stdin=quiet, stderr=quiet, start_new_session=True)
            self._live = (alone, now)

    def _films(self, picture: int) -> list[Path]:
        films = self.store.films(self.pictures[picture].key)
        if self.request.in_rounds:
            return [path for path, _ in films]
        return [path for path, samples in films if samples[-1][1] <= self.request.spp]

    def _pictures(self, picture: int) -> list[Path]:
        # A film among the outputs is written once, in the end.
        return [o for o in self.pictures[picture].outputs if o.suffix != ".film"]

    def _end_live(self) -> None:
        if self._live is not None:
            self._live[0].kill()
            self._live[0].wait()
            self._live = None

    def write_partial(self) -> list[Path]:
        """Write the unfinished pictures as they are; return the files."""
        self._end_live()
        written = []
        for picture in sorted(self._changed):
            films, outputs = self._films(picture), self._pictures(picture)
            if films and outputs:
                worker.run(self._merge(films, outputs))
                written += outputs
        return written


def _single(value: float) -> float:
    """Round to single precision."""
    rounded: float = struct.unpack("f", struct.pack("f", value))[0]
    return rounded
