"""The program ``specula``: ``python -m specula_render`` does the same."""

from __future__ import annotations

import sys

from specula_render._native import command_line


def main() -> None:
    """Run the command line of this process, and end it with the program's exit code."""
    if sys.argv[1:2] == ["farm"]:
        # The program would look for an interpreter that has this package.
        from specula_render.farm.cli import main as farm

        sys.exit(farm(sys.argv[2:]))
    sys.exit(command_line(["specula", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
