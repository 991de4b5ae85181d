"""Runs the notebooks, and writes them as pages of the book, with their outputs.

    python crates/specula-py/tools/notebooks.py [NAME...]

Pages are `docs/notebooks/NAME.md`, with pictures beside them; formulas become MathML, which
browsers show without a script.
"""

from __future__ import annotations

import base64
import json
import os
import re
import sys
import tempfile
from pathlib import Path
from typing import Any

import llvm
import specula_render

FOLDER = Path(__file__).parents[3] / "docs" / "notebooks"
KERNEL = "specula"
SECONDS = 300
"""Most for one cell: some machines are slow and shared."""


def names() -> list[str]:
    """Return the names of the notebooks."""
    return sorted(path.stem for path in FOLDER.glob("*.ipynb"))


def read(name: str) -> Any:
    """Return a notebook."""
    import nbformat

    return nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)


def make_kernel(folder: Path) -> str:
    """Write a kernel of this interpreter, with this package; return its name.

    ``JUPYTER_PATH`` is to lead to `folder`.
    """
    kernel = folder / "kernels" / KERNEL
    kernel.mkdir(parents=True)
    spec = {
        "argv": [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"],
        "display_name": KERNEL,
        "language": "python",
        "env": {
            "PYTHONPATH": str(Path(specula_render.__file__).parents[1]),
            "IPYTHONDIR": str(folder / "ipython"),
        },
    }
    (kernel / "kernel.json").write_text(json.dumps(spec), encoding="utf-8")
    return KERNEL


def run(notebook: Any, kernel: str, folder: Path) -> None:
    """Run a notebook in a folder, and fill in its outputs."""
    import nbclient

    resources = {"metadata": {"path": str(folder)}}
    client = nbclient.NotebookClient(
        notebook, kernel_name=kernel, timeout=SECONDS, resources=resources
    )
    client.execute()


def with_mathml(text: str) -> str:
    """Replace formulas in dollars by MathML."""
    from latex2mathml.converter import convert

    def block(match: re.Match[str]) -> str:
        return str(convert(match[1].strip(), display="block"))

    def inline(match: re.Match[str]) -> str:
        return str(convert(match[1]))

    text = re.sub(r"\$\$(.+?)\$\$", block, text, flags=re.DOTALL)
    return re.sub(r"\$(.+?)\$", inline, text, flags=re.DOTALL)


def fenced(text: str, language: str) -> str:
    """Return a block of code."""
    return f"```{language}\n{text.rstrip()}\n```"


def page(notebook: Any, name: str) -> tuple[str, dict[str, bytes]]:
    """Return a notebook with its outputs as Markdown, and its pictures by file name."""
    parts: list[str] = []
    pictures: dict[str, bytes] = {}
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            parts.append(with_mathml(cell.source))
            continue
        parts.append(fenced(cell.source, "python"))
        for output in cell.outputs:
            data = output.get("data", {})
            if "image/png" in data:
                file = f"{name}-{len(pictures) + 1}.png"
                pictures[file] = base64.b64decode(data["image/png"])
                parts.append(f"![What the code above draws]({file})")
            elif output.output_type == "stream" or "text/plain" in data:
                parts.append(fenced(output.get("text") or data["text/plain"], "text"))
        if len(parts) == 2:
            parts.insert(
                1,
                f"<!-- `{name}.ipynb` and its outputs; written by "
                "`cargo xtask python --notebooks`. -->",
            )
    return "\n\n".join(parts) + "\n", pictures


def write(name: str, kernel: str) -> None:
    """Run a notebook, and write its page."""
    notebook = read(name)
    with tempfile.TemporaryDirectory() as folder:
        run(notebook, kernel, Path(folder))
    text, pictures = page(notebook, name)
    for old in FOLDER.glob(f"{name}-[0-9]*.png"):
        old.unlink()
    for file, content in pictures.items():
        (FOLDER / file).write_bytes(content)
    (FOLDER / f"{name}.md").write_text(text, encoding="utf-8")
    print(f"{name}.md, {len(pictures)} pictures")


def main() -> None:
    """Write the pages that are named, or all."""
    llvm.find()
    with tempfile.TemporaryDirectory() as folder:
        kernel = make_kernel(Path(folder))
        os.environ["JUPYTER_PATH"] = folder
        for name in sys.argv[1:] or names():
            write(name, kernel)


if __name__ == "__main__":
    main()
