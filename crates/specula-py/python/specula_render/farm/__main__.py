"""``python -m specula_render.farm``: what ``specula farm`` hands over to."""

from __future__ import annotations

import sys

from specula_render.farm.cli import main

if __name__ == "__main__":
    sys.exit(main())
