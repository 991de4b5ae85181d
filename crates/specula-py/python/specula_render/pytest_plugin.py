"""The pytest plugin: the fixture `assert_bsdf` and the option `--specula-figures`.

::

    def test_my_lobe(assert_bsdf):
        assert_bsdf(MyLobe(alpha=0.3), name="my lobe, alpha 0.3")
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from .stat import Report


def pytest_addoption(parser: pytest.Parser) -> None:
    """Adds `--specula-figures DIR`."""
    parser.getgroup("specula").addoption(
        "--specula-figures",
        metavar="DIR",
        default=None,
        help="write the figures of BSDFs that fail into DIR, not into each test's tmp_path",
    )


@pytest.fixture
def assert_bsdf(request: pytest.FixtureRequest, tmp_path: Path) -> Callable[..., Report]:
    """`specula_render.stat.assert_bsdf`, which saves the figure of a failure.

    It goes into the folder of `--specula-figures`, or else into `tmp_path`; none is made where
    Matplotlib is missing.
    """
    # Here, not above: pytest imports the plugin in every run, whether it is needed or not.
    from . import stat

    folder = request.config.getoption("--specula-figures") or tmp_path
    return partial(stat.assert_bsdf, figures=folder)
