"""The results of checks: one line for each, and whether all hold."""

from __future__ import annotations

import html
import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .checks.chi_square import ChiSquare


@dataclass(frozen=True)
class Check:
    """The outcome of one check."""

    name: str
    """The check."""
    value: float
    """What was measured: a p-value, or the worst difference."""
    bound: float
    """What it is compared with: a significance, or a tolerance."""
    passed: bool
    """Whether the check holds."""
    detail: str
    """What was measured, in words."""
    view: tuple[float, float, float] | None = None
    """`wo`; None where the check is over many."""
    is_p_value: bool = False
    """Whether `value` is the chance of a result at least this bad if the subject is right."""

    def __str__(self) -> str:
        return "  ".join(_row(self))


@dataclass
class Report:
    """The checks of one subject.

    Printed, it is one line for each check. A report without checks proves nothing, so it does
    not pass.
    """

    subject: str
    """What was tested."""
    checks: list[Check] = field(default_factory=list)
    """In the order made."""
    fits: list[ChiSquare] = field(default_factory=list, repr=False)
    """Chi-square tests, one for each view, for figures."""

    @property
    def is_pass(self) -> bool:
        """Whether every check holds."""
        return bool(self.checks) and all(c.passed for c in self.checks)

    def failures(self) -> Iterator[Check]:
        """The checks that do not hold."""
        return (c for c in self.checks if not c.passed)

    def figure(self) -> Any:
        """Observed and expected counts and their difference, of the view that fits worst.

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        ImportError
            If Matplotlib is missing.
        ValueError
            If the report has no chi-square test.
        """
        if not self.fits:
            raise ValueError(f"{self.subject}: no chi-square test to draw")
        worst = min(self.fits, key=lambda fit: (fit.passed, fit.p_value, -fit.worst_residual))
        return worst.figure(self.subject)

    def __str__(self) -> str:
        rows = [("", "check", "view", "value", "bound", "detail"), *map(_row, self.checks)]
        widths = [max(len(row[k]) for row in rows) for k in range(5)]
        lines = [self._summary()]
        for row in rows:
            cells = [cell.ljust(width) for cell, width in zip(row[:5], widths, strict=True)]
            lines.append("  " + "  ".join([*cells, row[5]]).rstrip())
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{t}</th>" for t in ("", "check", "view", "value", "bound", "detail"))
        body = []
        for check in self.checks:
            style = "" if check.passed else ' style="background:#fdd;color:#000"'
            cells = "".join(
                f'<td style="text-align:left">{html.escape(cell)}</td>' for cell in _row(check)
            )
            body.append(f"<tr{style}>{cells}</tr>")
        return (
            f"<p><b>{html.escape(self._summary())}</b></p>"
            f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(body)}</tbody></table>"
        )

    def _summary(self) -> str:
        passed = sum(c.passed for c in self.checks)
        return f"{self.subject}: {passed} of {len(self.checks)} checks pass"


def _row(check: Check) -> tuple[str, str, str, str, str, str]:
    view = "" if check.view is None else view_text(check.view)
    sign, symbol = (">=", "p ") if check.is_p_value else ("<=", "")
    return (
        "pass" if check.passed else "FAIL",
        check.name,
        view,
        f"{symbol}{_number(check.value)}",
        f"{sign} {_number(check.bound)}",
        check.detail,
    )


def view_text(view: tuple[float, float, float]) -> str:
    """A view as reports write it."""
    return "wo ({:.3f}, {:.3f}, {:.3f})".format(*view)


def digits(values: Iterable[float]) -> str:
    """A direction or a colour with all the digits that single precision has."""
    return "(" + ", ".join(f"{x:.9g}" for x in values) + ")"


def _number(x: float) -> str:
    if not math.isfinite(x) or x == int(x):
        return f"{x:g}"
    return f"{x:.3f}" if 0.01 <= abs(x) < 1000.0 else f"{x:.1e}"
