"""``specula lab list``, ``run``, ``compare`` and ``material``."""

from __future__ import annotations

import atexit
import os
import shutil
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Literal, Union

from .experiment import Experiment
from .process import call
from .result import Result

AnyPath = Union[str, "os.PathLike[str]"]
Quality = Literal["draft", "paper"]
Sampler = Literal["heitz", "cap", "bounded", "exact"]


def experiments() -> list[Experiment]:
    """Return all experiments, in the order of the papers."""
    lines = call(["list", "--json"], progress=False).splitlines()
    return [Experiment.of_json(line) for line in lines if line]


def run(
    name: str,
    *,
    quality: Quality = "draft",
    output: AnyPath | None = None,
    seed: int = 1,
    threads: int | None = None,
    progress: bool = True,
) -> Result:
    """Run one experiment.

    Parameters
    ----------
    name
        As `experiments` names it.
    quality
        ``draft``: the direction of every claim, in seconds; ``paper``: fit for print, in minutes.
    output
        Folder for the result's folder and ``report.html``, made where there is none. None: a
        temporary one, deleted when Python ends.
    seed
        Of all random numbers: the same seed measures the same.
    threads
        How many; below 0 the cores that are left free; None: all cores.
    progress
        Whether to show progress and warnings on standard error.

    Raises
    ------
    ValueError
        If an argument is wrong. Of a name that is unknown, the message has the nearest ones.
    RuntimeError
        If the experiment failed.
    KeyboardInterrupt
        On Ctrl-C, once the experiment has ended; its folder is as it was before.
    """
    if "*" in name or not name:
        raise ValueError(f"name: one experiment expected, got '{name}'")
    arguments = ["run", "--quality", quality, *_shared(seed, threads, progress)]
    return _result(lambda folder: [*arguments, "-o", folder, "--", name], output, progress)


def compare(
    scene: AnyPath | None = None,
    *,
    samplers: Sequence[Sampler] = ("heitz", "cap", "bounded", "exact"),
    energy: Sequence[str] = ("none",),
    time: float | str = 30.0,
    reference: AnyPath | None = None,
    material: str | None = None,
    max_depth: int | None = None,
    resolution: tuple[int, int] | None = None,
    crop: tuple[int, int, int, int] | None = None,
    exposure: float = 0.0,
    values: Mapping[str, object] | None = None,
    search: Sequence[AnyPath] = (),
    output: AnyPath | None = None,
    seed: int = 1,
    threads: int | None = None,
    progress: bool = True,
) -> Result:
    """Compare samplers and treatments of energy on a scene, and recommend one.

    Parameters
    ----------
    scene
        File: pbrt-v4, Mitsuba 3, glTF, or a mesh. None: the scene that is built in.
    samplers, energy
        Names, as ``specula render`` has them.
    time
        Of each combination: seconds, or text such as ``"2m"``. References take four times as long.
    reference
        EXR that all converge to, with one treatment of energy. None: rendered.
    material
        Text of a material for every surface.
    max_depth
        Longest path in scattering events. None: as the scene says.
    resolution
        Width and height of the whole picture. None: as the scene says.
    crop
        ``(x0, x1, y0, y1)``: columns x0 to x1 - 1, rows y0 to y1 - 1 only.
    exposure
        Of pictures for screens, in stops.
    values
        Values of a Mitsuba scene's ``$name``, over its defaults.
    search
        Folders for files that are not beside the scene.
    output, seed, threads, progress
        As for `run`.

    Raises
    ------
    ValueError
        If an argument or the scene is wrong.
    RuntimeError, KeyboardInterrupt
        As for `run`.
    """
    span = time if isinstance(time, str) else f"{time:.9f}s"
    arguments = ["compare", "--samplers", ",".join(samplers), "--energy", ",".join(energy)]
    arguments += ["--time", span, f"--exposure={exposure}"]
    arguments += [] if reference is None else ["--reference", os.fspath(reference)]
    arguments += [] if material is None else ["--material", material]
    arguments += [] if max_depth is None else [f"--max-depth={max_depth}"]
    arguments += [] if resolution is None else ["--resolution", "x".join(map(str, resolution))]
    arguments += [] if crop is None else ["--crop", ",".join(map(str, crop))]
    for key, value in (values or {}).items():
        arguments += ["-D", f"{key}={value}"]
    for folder in search:
        arguments += ["--search", os.fspath(folder)]
    arguments += _shared(seed, threads, progress)
    file = [] if scene is None else ["--", os.fspath(scene)]
    return _result(lambda folder: [*arguments, "-o", folder, *file], output, progress)


def material(
    text: str,
    *,
    quality: Quality = "draft",
    output: AnyPath | None = None,
    seed: int = 1,
    threads: int | None = None,
    progress: bool = True,
) -> Result:
    """Measure a material: lobes, densities, albedo, furnace, chi-square, what samplers waste.

    Parameters
    ----------
    text
        Such as ``"conductor Au alpha 0.3"``: that of ``specula render --material``.
    quality, output, seed, threads, progress
        As for `run`.

    Raises
    ------
    ValueError
        If the text or another argument is wrong.
    RuntimeError, KeyboardInterrupt
        As for `run`.
    """
    arguments = ["material", "--quality", quality, *_shared(seed, threads, progress)]
    return _result(lambda folder: [*arguments, "-o", folder, "--", text], output, progress)


def fit(
    file: AnyPath,
    *,
    distributions: Sequence[Literal["ggx", "beckmann"]] = ("ggx", "beckmann"),
    bounces: Sequence[Literal["single", "compensated", "all"]] = ("single", "compensated", "all"),
    fresnel: Sequence[Literal["index", "f82"]] = ("index",),
    quality: Quality = "draft",
    output: AnyPath | None = None,
    seed: int = 1,
    threads: int | None = None,
    progress: bool = True,
) -> Result:
    """Fit rough metals to a measured material.

    The table ``"fits"`` has the lobes as texts with their alphas and how near they are, the table
    ``"text"`` the chosen one for renderers.

    Parameters
    ----------
    file
        A ``.bsdf`` file of the RGL database, or a ``.binary`` file of MERL's.
    distributions
        Of the facets' normals.
    bounces
        What becomes of light that facets reflect onto facets: it is lost, made up for (Kulla and
        Conty), or followed.
    fresnel
        An index of refraction per channel, or the reflectance along the normal and the tint at 82
        degrees.
    quality, output, seed, threads, progress
        As for `run`.

    Raises
    ------
    ValueError
        If the file is no measured material, or another argument is wrong.
    RuntimeError, KeyboardInterrupt
        As for `run`.
    """
    arguments = ["fit", "--quality", quality, *_shared(seed, threads, progress)]
    arguments += [f"--distributions={','.join(distributions)}"]
    arguments += [f"--bounces={','.join(bounces)}", f"--fresnel={','.join(fresnel)}"]
    file = os.fspath(file)
    return _result(lambda folder: [*arguments, "-o", folder, "--", file], output, progress)


def _shared(seed: int, threads: int | None, progress: bool) -> list[str]:
    """Options of all."""
    count = [] if threads is None else [f"--threads={threads}"]
    return [f"--seed={seed}", *count, *([] if progress else ["-q"])]


def _result(
    arguments: Callable[[str], list[str]], output: AnyPath | None, progress: bool
) -> Result:
    """Call with the folder, and read what was written there."""
    if output is None:
        folder = Path(tempfile.mkdtemp(prefix="specula-lab-"))
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
    else:
        folder = Path(output)
        # The command line takes such a name for that of one page.
        if folder.suffix == ".html":
            raise ValueError(f"output: a folder expected, got '{folder}'")
    printed = call(arguments(str(folder)), progress=progress)
    return Result.read(folder / printed.partition(":")[0].strip())
