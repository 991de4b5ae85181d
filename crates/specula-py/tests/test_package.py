"""The package as a whole: names, documentation, the command line."""

from __future__ import annotations

import doctest
import importlib
import inspect
import subprocess
import sys

import numpy as np
import pytest

import specula_render as sr
from conftest import LOBES, directions


def test_every_class_has_an_example_lobe() -> None:
    classes = {type(lobe) for lobe in LOBES.values()}
    exported = (getattr(sr, name) for name in sr.__all__)
    for item in exported:
        if inspect.isclass(item) and issubclass(item, sr.Bsdf) and item is not sr.Bsdf:
            assert item in classes, f"no example of {item.__name__} in conftest.LOBES"


def test_everything_is_documented() -> None:
    for name in sr.__all__:
        item = getattr(sr, name)
        if callable(item):
            assert inspect.getdoc(item), name
    for name in ("eval", "pdf", "eval_pdf", "sample"):
        text = inspect.getdoc(getattr(sr.Bsdf, name)) or ""
        assert "Returns" in text and "ndarray" in text or name == "sample", name


@pytest.mark.parametrize("name", ["specula_render", "specula_render.albedo"])
def test_examples_of_the_documentation(name: str) -> None:
    result = doctest.testmod(importlib.import_module(name))
    assert result.attempted > 0 and result.failed == 0


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "specula_render", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_the_command_line() -> None:
    version = run("--version")
    assert version.returncode == 0 and version.stdout == f"specula {sr.__version__}\n"
    assert "render" in run("--help").stdout
    wrong = run("render", "there-is-no-such-file.pbrt")
    assert wrong.returncode == 2 and "there-is-no-such-file.pbrt" in wrong.stderr
    assert run("rendr").returncode == 2


def test_threads_of_the_caller_may_share_a_lobe() -> None:
    from concurrent.futures import ThreadPoolExecutor

    lobe, wo, wi = LOBES["glass"], directions(20_000), directions(20_000, seed=3)
    expected = lobe.eval(wo, wi)
    with ThreadPoolExecutor(4) as pool:
        results = list(pool.map(lambda _: lobe.eval(wo, wi), range(8)))
    assert all(np.array_equal(expected, result) for result in results)
