"""Tables of results: columns as arrays."""

from __future__ import annotations

import html
import importlib
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

Column = npt.NDArray[Any]

_SHOWN = 10
"""Most rows that are printed: half of them first, half of them last."""


class Table(Mapping[str, Column]):
    """A table: a mapping from a column's heading to its values.

    Numbers are float64, NaN where the table has none; words are strings. Printed, a table shows
    its first and last rows.

    Attributes
    ----------
    name : str
        In the result.
    caption : str
        What the rows are.
    """

    def __init__(self, name: str, caption: str, columns: Mapping[str, npt.ArrayLike]) -> None:
        self.name = name
        self.caption = caption
        self._columns = {heading: np.asarray(values) for heading, values in columns.items()}
        lengths = {values.shape for values in self._columns.values()}
        if len(lengths) > 1 or any(len(shape) != 1 for shape in lengths):
            shapes = ", ".join(f"{h}: {v.shape}" for h, v in self._columns.items())
            raise ValueError(f"table {name}: columns of one length expected, got {shapes}")

    @classmethod
    def of_rows(
        cls, name: str, caption: str, headings: Sequence[str], rows: Sequence[Sequence[Any]]
    ) -> Table:
        """From rows of numbers, words and None."""
        columns = {h: _column([row[k] for row in rows]) for k, h in enumerate(headings)}
        return cls(name, caption, columns)

    def __getitem__(self, heading: str) -> Column:
        try:
            return self._columns[heading]
        except KeyError:
            there = ", ".join(self._columns)
            raise KeyError(f"table {self.name} has no column '{heading}': {there}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    @property
    def rows(self) -> int:
        """How many rows there are."""
        return next((len(values) for values in self._columns.values()), 0)

    def to_pandas(self) -> Any:
        """Return the table as a ``pandas.DataFrame``.

        Raises
        ------
        ImportError
            If pandas is missing.
        """
        try:
            pandas = importlib.import_module("pandas")
        except ImportError as error:
            raise ImportError("to_pandas needs pandas: pip install pandas") from error
        return pandas.DataFrame(self._columns)

    def __repr__(self) -> str:
        head, *body = [list(self._columns), *self._cells()]
        widths = [max(len(row[k]) for row in [head, *body]) for k in range(len(head))]
        flush = [_aligned(self._columns[h]) for h in head]
        lines = [
            "  ".join(f"{cell:{a}{w}}" for cell, a, w in zip(row, flush, widths, strict=True))
            for row in [head, *body]
        ]
        rule = "-" * (sum(widths) + 2 * max(len(widths) - 1, 0))
        title = f"{self.name}: {self.caption} [{self.rows} rows]"
        return "\n".join([title, lines[0], rule, *lines[1:]])

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{html.escape(h)}</th>" for h in self._columns)
        body = "".join(
            "<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in row) + "</tr>"
            for row in self._cells()
        )
        caption = f"{html.escape(self.caption)} [{self.rows} rows]"
        return (
            f"<table><caption>{caption}</caption><thead><tr>{head}</tr></thead>"
            f"<tbody>{body}</tbody></table>"
        )

    def _cells(self) -> list[list[str]]:
        """The rows that are shown, as text."""
        half = _SHOWN // 2
        is_long = self.rows > _SHOWN
        shown = [*range(half), *range(self.rows - half, self.rows)] if is_long else range(self.rows)
        body = [[_text(values[i]) for values in self._columns.values()] for i in shown]
        if is_long:
            body.insert(half, ["..."] * len(self._columns))
        return body


def _column(values: Sequence[Any]) -> Column:
    """An array of float64, or of strings where one of the values is a word."""
    if any(isinstance(value, str) for value in values):
        return np.array(["" if value is None else str(value) for value in values], dtype=np.str_)
    return np.array([np.nan if v is None else v for v in values], dtype=np.float64)


def _aligned(values: Column) -> str:
    return "<" if values.dtype.kind == "U" else ">"


def _text(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, np.floating) else str(value)
