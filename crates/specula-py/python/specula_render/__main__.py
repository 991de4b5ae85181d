"""The program ``specula``: ``python -m specula_render`` does the same."""

from __future__ import annotations

import sys

from specula_render._native import command_line


def main() -> None:
    """Run the command line of this process, and end it with the program's exit code."""
    sys.exit(command_line(["specula", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
