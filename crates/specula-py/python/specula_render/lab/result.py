"""What an experiment measured, read back from its folder."""

from __future__ import annotations

import base64
import html
import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .table import Table

_OURS = {"reproduced": "holds", "not-reproduced": "does not hold"}
"""Outcomes by other names, where there is no paper to reproduce."""


@dataclass(frozen=True)
class Claim:
    """One statement that was put to the test."""

    statement: str
    """What is claimed."""
    stated: str
    """What the source says."""
    measured: str
    """What came out here."""
    holds: str
    """``yes``, ``no`` or ``undecided``."""


@dataclass(frozen=True)
class Figure:
    """A plot or a picture, shown in Jupyter; a path for ``open`` and ``Path``: that of the PNG."""

    name: str
    """In the result."""
    caption: str
    """What it shows."""
    png: Path
    """Pixels."""
    svg: Path | None = None
    """Vectors; None for a picture."""

    def __fspath__(self) -> str:
        return str(self.png)

    def _repr_png_(self) -> bytes:
        return self.png.read_bytes()


@dataclass(frozen=True)
class Result:
    """The result of `run`, `compare` or `material`; shown in Jupyter with tables and figures."""

    name: str
    """Of the experiment."""
    title: str
    """What it shows."""
    verdict: str
    """``reproduced``, ``partly``, ``not reproduced`` or ``undecided``; where there is no paper,
    ``holds``, ``partly``, ``does not hold`` or ``undecided``."""
    summary: str
    """One sentence with the numbers that matter."""
    caveat: str
    """Limits of the result, and differences from the source; may be empty."""
    claims: list[Claim] = field(repr=False)
    """One by one."""
    tables: dict[str, Table] = field(repr=False)
    """By name."""
    figures: dict[str, Figure] = field(repr=False)
    """Plots and pictures by name."""
    folder: Path
    """With ``result.json``, CSV, SVG, PNG and EXR."""
    seconds: float
    """That it took."""
    seed: int
    """Of all random numbers."""

    @classmethod
    def read(cls, folder: Path | str) -> Result:
        """Read a folder that holds a ``result.json``.

        Parameters
        ----------
        folder
            Such as ``lab/tokuyoshi24-fig5``.

        Raises
        ------
        FileNotFoundError
            If the folder has no result.
        """
        folder = Path(folder)
        found = json.loads((folder / "result.json").read_text(encoding="utf-8"))
        judged = found["verdict"]
        words = _OURS if found["source"] == "specula" else {}
        return cls(
            name=found["id"],
            title=found["title"],
            verdict=words.get(found["outcome"], found["outcome"].replace("-", " ")),
            summary=judged["summary"],
            caveat=judged["caveat"],
            claims=[
                Claim(c["statement"], c["stated"], c["measured"], c["holds"])
                for c in judged["claims"]
            ],
            tables={
                t["name"]: Table.of_rows(t["name"], t["caption"], t["columns"], t["rows"])
                for t in found["tables"]
            },
            figures=_figures(folder, found),
            folder=folder,
            seconds=found["seconds"],
            seed=found["seed"],
        )

    def __str__(self) -> str:
        lines = [f"{self.name}: {self.verdict}. {self.summary}"]
        lines += [f"  {c.holds:9} {c.statement}: {c.measured}" for c in self.claims]
        lines += [f"  {self.caveat}"] if self.caveat else []
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        text = html.escape
        claims = "".join(
            f"<tr><td>{text(c.holds)}</td><td>{text(c.statement)}</td>"
            f"<td>{text(c.stated)}</td><td>{text(c.measured)}</td></tr>"
            for c in self.claims
        )
        figures = "".join(_image(figure) for figure in self.figures.values())
        tables = "".join(
            f"<details><summary>{text(name)}</summary>{table._repr_html_()}</details>"
            for name, table in self.tables.items()
        )
        caveat = f"<p>{text(self.caveat)}</p>" if self.caveat else ""
        return (
            f"<h4>{text(self.name)}: {text(self.verdict)}</h4><p>{text(self.summary)}</p>{caveat}"
            "<table><thead><tr><th>holds</th><th>claim</th><th>stated</th><th>measured</th></tr>"
            f"</thead><tbody>{claims}</tbody></table>{figures}{tables}"
        )


def _figures(folder: Path, found: dict[str, Any]) -> dict[str, Figure]:
    """Plots, and the sheets of pictures side by side."""
    figures = {}
    for plot in found["plots"]:
        svg, png = folder / plot["svg"], folder / plot["png"]
        figures[plot["name"]] = Figure(plot["name"], plot["caption"], png, svg)
    for sheet in found["comparisons"]:
        name = sheet["name"]
        figures[name] = Figure(name, sheet["caption"], folder / sheet["sheet"])
    return figures


def _image(figure: Figure) -> str:
    data = base64.b64encode(figure._repr_png_()).decode("ascii")
    caption = html.escape(figure.caption)
    return (
        f'<figure><img alt="{html.escape(figure.name)}" style="max-width:100%" '
        f'src="data:image/png;base64,{data}"/><figcaption>{caption}</figcaption></figure>'
    )
