"""The heads of film files: whose samples they hold, and what taking them cost."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from pathlib import Path

from specula_render.farm.ranges import Range

_MAGIC = b"SPECFILM"
_FORMAT = 4
_LONGEST_HEAD = 1 << 19


@dataclass(frozen=True)
class FilmHead:
    """What a film's file says before its sums."""

    settings: str
    fingerprint: int
    seconds: float
    """Time that its samples took, without reading the scene."""
    resolution: tuple[int, int]
    parts: tuple[Range, ...] | None
    """The samples of every pixel. ``None``: only the sums say, from ``first_sample`` on."""
    first_sample: int
    work: float
    """Samples per pixel that adaptive sampling has allotted; 0 in other films."""


class NotAFilm(ValueError):
    """A file is no film, or of another format."""


def parse_head(data: bytes) -> FilmHead:
    """Return the head of a film's bytes, of which the first half a mebibyte is enough.

    Raises
    ------
    NotAFilm
        It is something else, of another format, or cut off.
    """
    if data[:8] != _MAGIC:
        raise NotAFilm("no film of Specula's")
    try:
        return _parse(data)
    except (struct.error, UnicodeDecodeError) as error:
        raise NotAFilm("damaged or cut off") from error


def _parse(data: bytes) -> FilmHead:
    at = 8

    def take(form: str) -> tuple[float, ...]:
        nonlocal at
        values = struct.unpack_from("<" + form, data, at)
        at += struct.calcsize("<" + form)
        return values

    def number() -> int:
        return int(take("I")[0])

    def label() -> str:
        nonlocal at
        length = number()
        if at + length > len(data):
            raise NotAFilm("damaged or cut off")
        found = data[at : at + length].decode()
        at += length
        return found

    if (version := number()) != _FORMAT:
        raise NotAFilm(f"a film in version {version} of the format, not {_FORMAT}")
    label()
    label()
    settings = label()
    fingerprint, seconds = int(take("Q")[0]), take("d")[0]
    width, height, *_crop, first = (number() for _ in range(7))
    parts = tuple((number(), number()) for _ in range(number()))
    return FilmHead(
        settings, fingerprint, seconds, (width, height), parts or None, first, take("d")[0]
    )


def read_head(path: Path) -> FilmHead:
    """Return the head of a film's file.

    Raises
    ------
    NotAFilm
        As of `parse_head`.
    OSError
        It cannot be read.
    """
    with path.open("rb") as file:
        return parse_head(file.read(_LONGEST_HEAD))
