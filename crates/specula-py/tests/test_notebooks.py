"""The notebooks run, and the numbers that they assert hold."""

from __future__ import annotations

import importlib
import json
import re
import sys
from pathlib import Path
from typing import Any

import pytest

import specula_render

nbformat: Any = pytest.importorskip("nbformat", reason="nbformat is not installed")
nbclient: Any = pytest.importorskip("nbclient", reason="nbclient is not installed")
pytest.importorskip("ipykernel", reason="ipykernel is not installed")
pytest.importorskip("matplotlib", reason="Matplotlib is not installed")

FOLDER = Path(__file__).parents[3] / "docs" / "notebooks"
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
KERNEL = "specula-test"
SECONDS = 300
"""Most for one cell: some machines that run tests are slow and shared."""


@pytest.fixture
def kernel(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A kernel of the interpreter that runs the tests, with the package that they test."""
    folder = tmp_path / "jupyter" / "kernels" / KERNEL
    folder.mkdir(parents=True)
    spec = {
        "argv": [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"],
        "display_name": KERNEL,
        "language": "python",
        "env": {
            "PYTHONPATH": str(Path(specula_render.__file__).parents[1]),
            "IPYTHONDIR": str(tmp_path / "ipython"),
        },
    }
    (folder / "kernel.json").write_text(json.dumps(spec), encoding="utf-8")
    monkeypatch.setenv("JUPYTER_PATH", str(tmp_path / "jupyter"))
    return KERNEL


def read(name: str) -> Any:
    return nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)


def test_all_notebooks_are_tested() -> None:
    assert {path.stem for path in FOLDER.glob("*.ipynb")} == set(NOTEBOOKS)


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_a_notebook_has_no_outputs(name: str) -> None:
    notebook = read(name)
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
    notebook = read(name)
    resources = {"metadata": {"path": str(tmp_path)}}
    client = nbclient.NotebookClient(
        notebook, kernel_name=kernel, timeout=SECONDS, resources=resources
    )
    client.execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    assert not [output for output in outputs if output.output_type == "error"]
    assert any("image/png" in output.get("data", {}) for output in outputs)
    result = notebook.cells[-1].outputs[-1].data["text/plain"]
    assert re.search(NOTEBOOKS[name], result), result
