"""What is asked for: pictures, how they are rendered, where they go."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from specula_render.farm import bundle, worker
from specula_render.farm.store import key_of
from specula_render.farm.worker import PartTask, ProgramFailed

SHARES = 256
"""Shares of a round of adaptive sampling."""
_PADDING = re.compile("#+")
_BUILT_IN = "orbs"


class BadRequest(Exception):
    """What is asked for is wrong; the message says how."""


@dataclass(frozen=True)
class Request:
    """A render on many machines.

    All of it goes into ``job.json``.
    """

    scene: str | None
    spp: int
    outputs: tuple[str, ...]
    frames: tuple[int, int] | None = None
    options: tuple[str, ...] = ()
    """Options of ``specula render`` that change samples."""
    loading: tuple[str, ...] = ()
    """Options that say how the scene is read."""
    folders: tuple[str, ...] = ()
    """Folders to search."""
    display: tuple[str, ...] = ()
    """How PNG files look."""
    noise: float | None = None
    adaptive: bool = False
    by: str = "auto"
    part_seconds: float | None = None
    threads: int | None = None
    device: str = "cpu"
    ship: str = "auto"
    program: tuple[str, ...] | None = None

    @property
    def in_rounds(self) -> bool:
        """Whether samples are spread by their error."""
        return self.adaptive or self.noise is not None

    def to_json(self) -> dict[str, Any]:
        """Return what JSON can hold."""
        return {name: getattr(self, name) for name in self.__dataclass_fields__}

    @staticmethod
    def from_json(found: dict[str, Any]) -> Request:
        """Return what `to_json` gave."""
        names = Request.__dataclass_fields__
        values = {k: tuple(v) if isinstance(v, list) else v for k, v in found.items() if k in names}
        return Request(**values)  # type: ignore[arg-type]

    def numbers(self) -> list[int | None]:
        """Return the frames, or one ``None``."""
        return [None] if self.frames is None else list(range(*self.frames))

    def aim(self) -> tuple[str, ...]:
        """Return the options that say what adaptive sampling aims at."""
        if self.noise is not None:
            return ("--noise", repr(self.noise), "--spp", str(self.spp))
        return ("--adaptive", "--spp", str(self.spp)) if self.adaptive else ()


@dataclass(frozen=True)
class PictureRequest:
    """One picture of a request."""

    name: str
    key: str
    """Of all that its samples depend on."""
    outputs: tuple[Path, ...]
    task: PartTask


@dataclass
class Plan:
    """A request, checked: its pictures, and the files to send."""

    request: Request
    pictures: list[PictureRequest]
    files: bundle.Bundle
    version: str
    shipped: bool = field(default=False)


def with_frame(text: str, frame: int | None) -> str:
    """Put a frame's number in place of ``###``, with as many digits."""
    if frame is None:
        return text
    return _PADDING.sub(lambda found: f"{frame:0{len(found.group())}d}", text)


def default_outputs(scene: str | None, frames: tuple[int, int] | None) -> tuple[str, ...]:
    """Return an EXR and a PNG in this folder, named after the scene."""
    stem = Path(scene).name.split(".")[0].rstrip("#_-") if scene else _BUILT_IN
    number = ".####" if frames is not None else ""
    return (f"{stem}{number}.exr", f"{stem}{number}.png")


def plan(request: Request) -> Plan:
    """Check a request, list the scenes' files and give every picture its key.

    Raises
    ------
    BadRequest
        The scene, the frames or an output is wrong.
    """
    _check(request)
    numbers = request.numbers()
    try:
        version = worker.run([*worker.program(request.program), "--version"]).strip()
    except (OSError, ProgramFailed) as error:
        raise BadRequest(f"cannot run the program: {error}") from error
    with ThreadPoolExecutor(8) as pool:
        lists = list(pool.map(lambda number: _files(request, number), numbers))
    own = [bundle.of_files(files) for files in lists]
    every = {file for files in lists for file in files}
    folders = [Path(folder) for folder in request.folders]
    together = bundle.of_files(sorted(every), folders)
    return Plan(
        request,
        [_picture(request, n, files, version) for n, files in zip(numbers, own)],
        together,
        version,
    )


def _check(request: Request) -> None:
    scene, frames = request.scene, request.frames
    has_number = scene is not None and "#" in Path(scene).name
    if frames is None and has_number and not Path(scene or "").exists():
        raise BadRequest(f"'{scene}' is a sequence of files: --frames A..B says which")
    if frames is not None and scene is None:
        raise BadRequest("--frames needs a scene: the built-in one does not move")
    if request.in_rounds and request.by == "samples":
        raise BadRequest("--by samples is for even sampling: adaptive rounds are cut by tiles")
    for output in request.outputs:
        if frames is not None and "#" not in Path(output).name:
            raise BadRequest(f"'{output}' would be every frame: put #### where its number goes")
        if not output.endswith((".exr", ".png", ".film")):
            raise BadRequest(f"'{output}': expected a name that ends in .exr, .png or .film")
        if not Path(output).absolute().parent.is_dir():
            raise BadRequest(f"'{output}': there is no such folder")


def _files(request: Request, frame: int | None) -> list[Path]:
    if request.scene is None:
        return []
    scene, more = scene_of(request, frame)
    searched = [word for folder in request.folders for word in ("--search", folder)]
    command = [*worker.program(request.program), "info", "--files", scene]
    try:
        printed = worker.run([*command, *more, *request.loading, *searched])
    except ProgramFailed as error:
        raise BadRequest(str(error)) from error
    return [Path(line) for line in printed.splitlines()]


def scene_of(request: Request, frame: int | None) -> tuple[str, tuple[str, ...]]:
    """Return a frame's scene, and the options that make it that frame."""
    scene = request.scene or ""
    if frame is None or "#" in Path(scene).name:
        return with_frame(scene, frame), ()
    return scene, frame_words(scene, str(frame))


def frame_words(scene: str, frame: str) -> tuple[str, str]:
    """Return the option that makes a file its frame: of glTF's animations, or as ``$frame``."""
    if Path(scene).suffix.lower() in (".glb", ".gltf"):
        return "--frame", frame
    return "-D", f"frame={frame}"


def _picture(
    request: Request, frame: int | None, files: bundle.Bundle, version: str
) -> PictureRequest:
    scene, more = scene_of(request, frame)
    options = (*more, *request.loading, *request.options, *request.aim())
    inside = files.inside(Path(scene)) if scene else ""
    shares = SHARES if request.in_rounds else None
    how = (request.device, list(options), shares)
    key = key_of(version, files.fingerprint, inside, *how)
    outputs = tuple(Path(with_frame(o, frame)).absolute() for o in request.outputs)
    task = PartTask(
        request.program,
        os.path.abspath(scene) if scene else "",
        None,
        options,
        tuple(os.path.abspath(folder) for folder in request.folders),
        shares,
    )
    name = (Path(scene).name if scene else _BUILT_IN) + ("" if frame is None else f" frame {frame}")
    return PictureRequest(name, key, outputs, task)


def ship(plan: Plan) -> list[PartTask]:
    """Return the tasks for nodes that get the files sent.

    Raises
    ------
    BadRequest
        The scene does not load from a copy, as it names files by absolute paths.
    """
    files = plan.files
    fingerprint = files.fingerprint
    root = bundle.unpacked(fingerprint, files.pack)
    tasks = []
    for picture in plan.pictures:
        task = picture.task
        scene = files.inside(Path(task.scene)) if task.scene else ""
        folders = tuple(files.inside(Path(folder)) for folder in task.folders)
        tasks.append(PartTask(task.program, scene, fingerprint, task.options, folders, task.rounds))
    _load_copy(plan.request, tasks[0], root)
    return tasks


def _load_copy(request: Request, task: PartTask, root: Path) -> None:
    if not task.scene:
        return
    searched = [w for folder in task.folders for w in ("--search", str(root / folder))]
    more = scene_of(request, request.numbers()[0])[1]
    command = [*worker.program(task.program), "info", "--files", str(root / task.scene)]
    outside: Sequence[str]
    try:
        printed = worker.run([*command, *more, *request.loading, *searched])
        outside = [f for f in printed.splitlines() if root not in Path(os.path.abspath(f)).parents]
    except ProgramFailed as error:
        outside = [str(error)]
    if outside:
        raise BadRequest(
            "the scene cannot be sent to other machines, as it names files by absolute paths: "
            f"{outside[0]}. Use a folder that all see at the same path"
        )
