"""Mitsuba and Dr.Jit, untyped: their types are those of the variant that is active at the call."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any, TypeVar

try:
    mi: Any = importlib.import_module("mitsuba")
    dr: Any = importlib.import_module("drjit")
except ImportError as missing:
    raise ImportError(
        "specula_render.mitsuba needs Mitsuba 3: pip install mitsuba"
    ) from missing

__all__ = ["dr", "is_jit", "mi", "require_variant", "syntax"]

F = TypeVar("F", bound=Callable[..., Any])
#: ``drjit.syntax``: loops and conditions over arrays in Python's own words.
syntax: Callable[[F], F] = dr.syntax


def require_variant() -> str:
    """The active variant.

    Returns
    -------
    str
        Its name, for example ``llvm_ad_rgb``.

    Raises
    ------
    RuntimeError
        No variant is set, or the variant is polarized: the lobes are not.
    """
    variant = mi.variant()
    if variant is None:
        raise RuntimeError(
            "no Mitsuba variant is set: call mitsuba.set_variant('llvm_ad_rgb'), or another, first"
        )
    if "polarized" in variant:
        raise RuntimeError(
            f"Specula's plugins know no polarization: variant '{variant}' is not supported"
        )
    return str(variant)


def is_jit() -> bool:
    """Whether the active variant works on arrays (``llvm_*``, ``cuda_*``)."""
    return bool(dr.is_jit_v(mi.Float))
