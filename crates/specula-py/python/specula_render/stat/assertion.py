"""A proof as an assertion, for test suites."""

from __future__ import annotations

import re
from os import PathLike
from pathlib import Path
from typing import Any

import numpy.typing as npt

from .plan import Plan
from .proof import prove
from .report import Report


def assert_bsdf(
    subject: Any,
    name: str | None = None,
    views: npt.ArrayLike | None = None,
    plan: Plan | None = None,
    *,
    figures: str | PathLike[str] | None = None,
) -> Report:
    """Runs every check of `prove`, and raises where one does not hold.

    Parameters
    ----------
    subject, views, plan
        As for `prove`.
    name
        What the report calls it; the name of the type of `subject` where left out.
    figures
        Folder, made where missing, for the figure of a failure; none is made where left out, or
        where Matplotlib is missing.

    Returns
    -------
    Report
        Of checks that all hold.

    Raises
    ------
    AssertionError
        If a check does not hold: with the report's text, and where the figure is.
    ValueError, TypeError
        As `prove`.
    """
    __tracebackhide__ = True
    called = type(subject).__name__ if name is None else name
    report = prove(called, subject, views, plan)
    if report.is_pass:
        return report
    text = str(report)
    if figures is not None:
        text += f"\n{_save(report, Path(figures))}"
    raise AssertionError(text)


def _save(report: Report, folder: Path) -> str:
    """Writes the figure; what to tell about it."""
    path = folder / (re.sub(r"[^A-Za-z0-9.-]+", "_", report.subject) + ".png")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        report.figure().savefig(path, dpi=120)
    except (ImportError, OSError) as error:
        return f"no figure: {error}"
    return f"figure: {path}"
