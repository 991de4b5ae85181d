"""Renders: a picture of a scene, at once or step by step."""

from __future__ import annotations

import os
import sys
import time as clock
import warnings
from collections.abc import Iterator
from typing import Any, Literal, Union

from specula_render import _native
from specula_render.picture import Picture, read_exr
from specula_render.scene import PathLike, Scene, SceneWarning, builtin, load

__all__ = [
    "Picture",
    "Scene",
    "SceneWarning",
    "builtin",
    "load",
    "read_exr",
    "render",
    "render_iter",
    "render_live",
]

Progress = Union[bool, Literal["always"]]

# Seconds before the progress is shown: what is shorter needs none.
_QUIET = 2.0
_BAR = 32


def _short(seconds: float) -> str:
    """Return a duration in words: ``42 s``, ``3:05 min``, ``2:07 h``."""
    if seconds < 60.0:
        return f"{seconds:.0f} s"
    if seconds < 3600.0:
        return f"{int(seconds // 60)}:{int(seconds % 60):02} min"
    return f"{int(seconds // 3600)}:{int(seconds % 3600 // 60):02} h"


class _Bar:
    """A bar on standard error."""

    def __init__(self, progress: Progress) -> None:
        is_terminal = sys.stderr is not None and sys.stderr.isatty()
        self.is_asked_for = progress == "always" or (bool(progress) and is_terminal)
        self.start = clock.monotonic()
        self.length = 0

    def __call__(self, share: float, samples: float, noise: float, rays: int) -> None:
        """Show a state, as the native renderer tells it after every pass."""
        elapsed = clock.monotonic() - self.start
        if elapsed < _QUIET:
            return
        full = int(_BAR * share)
        left = f"  {_short(elapsed * (1.0 - share) / share)} left" if share > 0.0 else ""
        error = f"  noise {100.0 * noise:.1f} %" if noise < float("inf") else ""
        line = (
            f"[{'#' * full}{'.' * (_BAR - full)}] {100.0 * share:3.0f} %  {samples:.0f} spp  "
            f"{1e-6 * rays / elapsed:.2f} Mrays/s{error}{left}"
        )
        # Spaces over what is left of a longer line before.
        sys.stderr.write(f"\r{line:<{self.length}}")
        sys.stderr.flush()
        self.length = len(line)

    def finish(self) -> None:
        """Remove the bar."""
        if self.length > 0:
            sys.stderr.write(f"\r{'':<{self.length}}\r")
            sys.stderr.flush()


def _within(name: str, value: int | None, least: int, most: int) -> None:
    """Raise an error where a number is out of range."""
    if value is not None and not least <= value <= most:
        raise ValueError(f"{name}: expected a number in [{least}, {most}], got {value}")


def _check(
    scene: Scene,
    spp: int | None,
    threads: int,
    seed: int,
    max_depth: int | None,
    resolution: tuple[int, int] | None,
) -> None:
    """Raise an error where an option is out of range."""
    if not isinstance(scene, Scene):
        raise TypeError(f"scene: expected a Scene, as load() returns, got {type(scene).__name__}")
    _within("spp", spp, 1, 1 << 24)
    _within("threads", threads, 0, 1 << 12)
    _within("seed", seed, 0, (1 << 32) - 1)
    _within("max_depth", max_depth, 0, (1 << 31) - 1)
    for size in resolution or ():
        _within("resolution", size, 1, 1 << 16)


def _picture(job: _native.RenderJob) -> Picture:
    """Return the picture of a render as it is now."""
    data, samples, noise, not_finite, rays, seconds = job.picture()
    if not_finite > 0:
        message = f"{not_finite} samples were not finite and count as black"
        warnings.warn(message, RuntimeWarning, stacklevel=3)
    picture = Picture._of(data)
    picture.samples, picture.noise = samples, noise
    picture.rays, picture.seconds = rays, seconds
    return picture


def _job(
    scene: Scene,
    spp: int | None,
    seed: int,
    threads: int,
    max_depth: int | None,
    energy: str | None,
    sampler: str | None,
    texture_filter: str,
    filter_normal_maps: bool,
    resolution: tuple[int, int] | None,
    clamp: float | None,
    regularize: bool,
    *,
    is_bounded: bool = False,
    noise: float | None = None,
    checkpoint: PathLike | None = None,
    max_memory: int | None = None,
) -> _native.RenderJob:
    """Prepare a render, once its options are checked."""
    _check(scene, spp, threads, seed, max_depth, resolution)
    with scene._lock:
        return _native.RenderJob(
            scene._data,
            spp=spp,
            is_bounded=is_bounded,
            seed=seed,
            threads=threads,
            max_depth=max_depth,
            energy=energy,
            sampler=sampler,
            texture_filter=texture_filter,
            filter_normal_maps=filter_normal_maps,
            noise=noise,
            resolution=resolution,
            clamp=clamp,
            regularize=regularize,
            checkpoint=None if checkpoint is None else os.fspath(checkpoint),
            max_memory=max_memory,
        )


def render(
    scene: Scene,
    spp: int | None = None,
    *,
    time: float | None = None,
    noise: float | None = None,
    adaptive: bool = False,
    progress: Progress = True,
    threads: int = 0,
    seed: int = 0,
    max_depth: int | None = None,
    energy: str | None = None,
    sampler: str | None = None,
    texture_filter: str = "scene",
    filter_normal_maps: bool = False,
    resolution: tuple[int, int] | None = None,
    clamp: float | None = None,
    regularize: bool = False,
    checkpoint: PathLike | None = None,
    max_memory: int | None = None,
) -> Picture:
    """Render a scene: the very picture, bit for bit, that the program ``specula`` writes.

    Ctrl-C ends a render within a fraction of a second; other threads of Python run meanwhile.

    Parameters
    ----------
    scene
        What is rendered.
    spp
        Samples per pixel. By default what the scene asks for (64 for one built in Python), or,
        with ``time`` or ``noise``, as many as they take.
    time
        Seconds after which the render ends; one sample of each pixel is taken in any case.
    noise
        Estimated relative error at which the picture is done, such as 0.02. Samples are spread by
        their error and cost.
    adaptive
        Whether ``spp`` samples per pixel are spread by their error and cost.
    progress
        Whether a render of more than two seconds shows its progress on standard error, where that
        is a terminal; ``"always"``: elsewhere, too.
    threads
        Threads; 0 for all cores. The picture does not depend on it.
    seed
        Renders with different seeds are independent.
    max_depth
        Longest path in scattering events, as pbrt counts them; by default as the scene says.
    energy
        What is done about light that microfacets scatter more than once: ``"none"``,
        ``"turquin"``, ``"turquin-series"``, ``"kulla-conty"``, ``"multibounce"`` or
        ``"multibounce=MODEL"``; by default as the scene says.
    sampler
        Sampler of visible normals: ``"heitz"``, ``"cap"``, ``"bounded"`` or ``"exact"``.
    texture_filter
        ``"scene"``: as the scene says; ``"bilinear"``: not over footprints; ``"trilinear"`` or
        ``"ewa"``: over footprints, with less noise where pictures are seen from afar, and a bias
        that falls with the samples.
    filter_normal_maps
        Whether normal maps are filtered into roughness, by LEAN mapping: seen from afar, metal
        reflects as its normals do, not as their mean does.
    resolution
        Width and height of the picture; by default those of the scene.
    clamp
        Bias: the largest contribution of indirect light in any channel.
    regularize
        Bias: whether surfaces behind rough surfaces are made rougher.
    checkpoint
        File that the samples are saved in, every half minute and when the render ends or is
        interrupted. Where it is there already, the render goes on with it. It stays; ``specula
        merge`` and ``specula render --resume`` read it.
    max_memory
        Bytes that the process may take; by default what is available.

    Returns
    -------
    Picture

    Raises
    ------
    ValueError
        If an argument is out of range, there is nothing to render, or the checkpoint is of another
        render.
    MemoryError
        If the render would take more memory than there is, before it begins.
    OSError
        If the checkpoint cannot be read or written.
    KeyboardInterrupt
        After Ctrl-C. The scene can be rendered again.

    Examples
    --------
    >>> import specula_render as sr
    >>> scene = sr.builtin()
    >>> picture = sr.render(scene, spp=1, resolution=(24, 10))
    >>> picture.rgb.shape
    (10, 24, 3)
    """
    if adaptive and noise is None:
        noise = 0.0
    if time is not None and not time > 0.0:
        raise ValueError(f"time: expected seconds above 0, got {time}")
    options = (
        seed, threads, max_depth, energy, sampler, texture_filter, filter_normal_maps,
        resolution, clamp, regularize
    )
    job = _job(
        scene,
        spp,
        *options,
        is_bounded=time is not None or (noise is not None and noise > 0.0),
        noise=noise,
        checkpoint=checkpoint,
        max_memory=max_memory,
    )
    bar = _Bar(progress)
    try:
        job.advance(None, time, bar if bar.is_asked_for else None)
    finally:
        bar.finish()
    return _picture(job)


def render_iter(
    scene: Scene,
    spp: int | None = None,
    *,
    threads: int = 0,
    seed: int = 0,
    max_depth: int | None = None,
    energy: str | None = None,
    sampler: str | None = None,
    texture_filter: str = "scene",
    filter_normal_maps: bool = False,
    resolution: tuple[int, int] | None = None,
    clamp: float | None = None,
    regularize: bool = False,
) -> Iterator[Picture]:
    """Render step by step: yield pictures at 1, 2, 4, 8, ... samples per pixel, and at ``spp``.

    The last is that of `render`, bit for bit. The scene may be changed meanwhile: the pictures are
    of what it was at the call.

    Parameters
    ----------
    scene, spp, threads, seed, max_depth, energy, sampler, texture_filter,
    filter_normal_maps, resolution
        As for `render`.
    clamp, regularize
        As for `render`.

    Yields
    ------
    Picture

    Raises
    ------
    ValueError
        If an argument is out of range, or there is nothing to render.

    Examples
    --------
    >>> import specula_render as sr
    >>> steps = sr.render_iter(sr.builtin(), spp=5, resolution=(24, 10))
    >>> [picture.samples for picture in steps]
    [1.0, 2.0, 4.0, 5.0]
    """
    options = (
        seed, threads, max_depth, energy, sampler, texture_filter, filter_normal_maps,
        resolution, clamp, regularize
    )
    return _steps(_job(scene, spp, *options))


def render_live(
    scene: Scene,
    spp: int | None = None,
    *,
    every: float = 1.0,
    threads: int = 0,
    seed: int = 0,
    max_depth: int | None = None,
    energy: str | None = None,
    sampler: str | None = None,
    texture_filter: str = "scene",
    filter_normal_maps: bool = False,
    resolution: tuple[int, int] | None = None,
    clamp: float | None = None,
    regularize: bool = False,
) -> Picture:
    """Render in a cell of Jupyter that shows the picture as it grows.

    To interrupt the kernel ends the render: the picture so far is shown and returned.

    Parameters
    ----------
    scene, spp, threads, seed, max_depth, energy, sampler, texture_filter,
    filter_normal_maps, resolution
        As for `render`.
    clamp, regularize
        As for `render`.
    every
        Seconds between two pictures.

    Returns
    -------
    Picture
        That of `render`, bit for bit, where nothing interrupts it.

    Raises
    ------
    ImportError
        Where there is no IPython.
    ValueError
        If an argument is out of range, or there is nothing to render.
    """
    try:
        from IPython.display import display
    except ImportError as error:
        raise ImportError("render_live needs Jupyter: pip install ipykernel") from error
    if not every > 0.0:
        raise ValueError(f"every: expected seconds above 0, got {every}")
    options = (
        seed, threads, max_depth, energy, sampler, texture_filter, filter_normal_maps,
        resolution, clamp, regularize
    )
    job = _job(scene, spp, *options)
    job.advance(1, None, None)
    picture = _picture(job)
    show: Any = display
    cell = show(picture, display_id=True)
    try:
        while picture.samples < job.samples:
            job.advance(None, every, None)
            picture = _picture(job)
            cell.update(picture)
    except KeyboardInterrupt:
        picture = _picture(job)
        cell.update(picture)
    return picture


def _steps(job: _native.RenderJob) -> Iterator[Picture]:
    """Yield pictures at powers of two, and at the end."""
    samples, most = 1, job.samples
    while True:
        job.advance(min(samples, most), None, None)
        yield _picture(job)
        if samples >= most:
            return
        samples *= 2
