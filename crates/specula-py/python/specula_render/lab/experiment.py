"""What can be run."""

from __future__ import annotations

import json
from dataclasses import dataclass


@dataclass(frozen=True)
class Experiment:
    """A table or a figure of a paper that `run` measures again."""

    name: str
    """For `run`."""
    figure: str
    """In the paper: ``fig. 5``, ``table 2``."""
    paper: str
    """Authors and year."""
    title: str
    """What it shows."""
    statement: str
    """What the paper says of it, and `run` puts to the test."""

    @classmethod
    def of_json(cls, line: str) -> Experiment:
        """From a line of ``specula lab list --json``."""
        entry = json.loads(line)
        return cls(
            name=entry["id"],
            figure=entry["item"],
            paper=entry["source"],
            title=entry["title"],
            statement=entry["statement"],
        )

    def __str__(self) -> str:
        return f"{self.name}: {self.title} ({self.paper}, {self.figure})"
