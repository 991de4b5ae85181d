"""The notebooks run, and the numbers that they assert hold."""

from __future__ import annotations

import importlib
import re
from pathlib import Path
from typing import Any

import pytest

import notebooks

nbformat: Any = pytest.importorskip("nbformat", reason="nbformat is not installed")
pytest.importorskip("nbclient", reason="nbclient is not installed")
pytest.importorskip("ipykernel", reason="ipykernel is not installed")
pytest.importorskip("matplotlib", reason="Matplotlib is not installed")

NOTEBOOKS = {
    "samplers": r"'cap': 0\.677, 'bounded': 0\.513, 'exact': 0\.498",
    "energy": r"'Kulla-Conty': 0\.55\d,\s+'simulated': 0\.(59|60)",
    "prove-your-bsdf": r"^\['chi-square', 'furnace', 'integral of pdf'\]$",
    "mitsuba": r"^1\.[2-9]\d?$",
    "fit-alpha": r"^0\.3[3-6]\d?$",
}
"""Notebooks, and what the output of the last cell is like: `N` of each sampler, green over red of
gold, failed checks, the gain in variance, alpha."""
NEEDS_MITSUBA = {"mitsuba", "fit-alpha"}


@pytest.fixture
def kernel(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A kernel of the interpreter that runs the tests, with the package that they test."""
    folder = tmp_path / "jupyter"
    monkeypatch.setenv("JUPYTER_PATH", str(folder))
    return notebooks.make_kernel(folder)


def test_all_notebooks_are_tested() -> None:
    assert set(notebooks.names()) == set(NOTEBOOKS)


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_a_notebook_has_no_outputs(name: str) -> None:
    notebook = notebooks.read(name)
    nbformat.validate(notebook)
    for cell in notebook.cells:
        if cell.cell_type == "code":
            assert cell.outputs == []
            assert cell.execution_count is None
    assert "assert " in notebook.cells[-1].source


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_a_notebook_runs(name: str, kernel: str, tmp_path: Path) -> None:
    if name in NEEDS_MITSUBA:
        # Finds LLVM for the kernel too, and skips where there is none.
        importlib.import_module("test_mitsuba_tools").use("llvm_ad_rgb")
    notebook = notebooks.read(name)
    notebooks.run(notebook, kernel, tmp_path)
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    assert not [output for output in outputs if output.output_type == "error"]
    assert any("image/png" in output.get("data", {}) for output in outputs)
    result = notebook.cells[-1].outputs[-1].data["text/plain"]
    assert re.search(NOTEBOOKS[name], result), result


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_the_book_has_the_notebook_as_it_is(name: str) -> None:
    pytest.importorskip("latex2mathml", reason="latex2mathml is not installed")
    page = (notebooks.FOLDER / f"{name}.md").read_text(encoding="utf-8")
    at = 0
    for cell in notebooks.read(name).cells:
        text = cell.source if cell.cell_type == "code" else notebooks.with_mathml(cell.source)
        at = page.find(text.rstrip(), at)
        assert at >= 0, f"run `cargo xtask python --notebooks`: the page differs from {text[:200]}"
    pictures = re.findall(r"\]\((\S+\.png)\)", page)
    assert pictures and all((notebooks.FOLDER / file).exists() for file in pictures)
    assert "Traceback" not in page and "$" not in re.sub("```.*?```", "", page, flags=re.DOTALL)
