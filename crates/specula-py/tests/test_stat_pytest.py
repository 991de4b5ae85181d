"""The assertion, its figures, and the pytest plugin as a project uses it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
import specula_render.stat
from specula_render import stat
from test_stat import VIEW, RedWeight
from test_stat_lobes import Lambert

SUITE = """
from specula_render import stat
from test_stat import VIEW, Biased, NoMasking
from test_stat_lobes import Lambert

def test_right(assert_bsdf):
    assert assert_bsdf(Lambert(), name="Lambert", views=VIEW).is_pass

def test_wrong(assert_bsdf):
    assert_bsdf(NoMasking(0.3, 0.3), name="no masking / 0.3", views=VIEW)

def test_wrong_too(assert_bsdf):
    assert_bsdf(Biased(0.3, 0.3), views=VIEW, plan=stat.Plan(samples=20_000))
"""


def run(folder: Path, *arguments: str) -> str:
    """Runs the suite in a pytest of its own, with the plugin, and returns its output."""
    (folder / "test_lobes.py").write_text(SUITE)
    package = Path(next(iter(specula_render.stat.__path__))).parent.parent
    paths = [str(package), str(Path(__file__).parent), os.environ.get("PYTHONPATH", "")]
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(filter(None, paths)),
        # The plugin may be installed, too; named twice it would be refused.
        "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
    }
    command = [sys.executable, "-m", "pytest", "-p", "specula_render.pytest_plugin", *arguments]
    command += ["-q", "--noconftest", "--basetemp", str(folder / "temporary"), "test_lobes.py"]
    ended = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    return ended.stdout + ended.stderr


def test_plugin_reports_and_saves_figures(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib", reason="Matplotlib is not installed")
    output = run(tmp_path, "--specula-figures", "figures")
    assert "2 failed, 1 passed" in output
    assert "AssertionError: no masking / 0.3: " in output
    figures = sorted(path.name for path in (tmp_path / "figures").iterdir())
    assert figures == ["Biased.png", "no_masking_0.3.png"]


def test_plugin_saves_into_tmp_path_by_default(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib", reason="Matplotlib is not installed")
    output = run(tmp_path, "-k", "wrong_too")
    assert "1 failed" in output
    assert [p.name for p in tmp_path.rglob("*.png")] == ["Biased.png"]


def test_assertion_passes_and_fails() -> None:
    assert stat.assert_bsdf(Lambert(), views=VIEW).subject == "Lambert"
    with pytest.raises(AssertionError, match=r"RedWeight: 4 of 6 checks pass(.|\n)*FAIL  furnace"):
        stat.assert_bsdf(RedWeight(0.5, 0.5), views=VIEW)


def test_figure_shows_the_view_that_fits_worst() -> None:
    pytest.importorskip("matplotlib", reason="Matplotlib is not installed")
    report = stat.prove("Lambert", Lambert(), stat.views(cos_theta=(0.7, 0.3)))
    figure = report.figure()
    worst = min(report.fits, key=lambda fit: fit.p_value)
    assert "wo ({:.3f}, {:.3f}, {:.3f})".format(*worst.view) in figure.get_suptitle()
    maps = [axis for axis in figure.axes if axis.get_title()]
    assert len(maps) == 3
    assert all(len(axis.collections[0].get_paths()) == len(worst.expected) for axis in maps)


def test_figure_without_matplotlib_tells_how_to_install_it(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    report = stat.prove("Lambert", Lambert(), VIEW)
    with pytest.raises(ImportError, match="pip install matplotlib"):
        report.figure()
    with pytest.raises(AssertionError, match="no figure: figures need Matplotlib"):
        stat.assert_bsdf(RedWeight(0.5, 0.5), views=VIEW, figures=tmp_path)
