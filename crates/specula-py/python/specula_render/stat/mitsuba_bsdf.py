"""BSDFs of Mitsuba 3 as callables over arrays.

Mitsuba's `wi` is the direction given and its `wo` the one sampled: the reverse of our names.
"""

from __future__ import annotations

import importlib
from typing import Any

import numpy as np

from .arrays import FloatArray, Function


def is_mitsuba(bsdf: Any) -> bool:
    """Whether it is a BSDF of Mitsuba, without importing that."""
    return any(c.__name__ == "BSDF" and _is_of_mitsuba(c) for c in type(bsdf).__mro__)


def _is_of_mitsuba(base: type) -> bool:
    return base.__module__.partition(".")[0] == "mitsuba"


def callables(bsdf: Any) -> tuple[Function, Function, Function]:
    """`eval`, `pdf` and `sample` of a BSDF of the active variant.

    Raises
    ------
    ImportError
        If Mitsuba is missing.
    ValueError
        If the variant is not vectorised, or neither RGB nor monochrome, or polarised.
    """
    mi, dr = _modules()
    variant = mi.variant()
    if variant is None or variant.startswith("scalar"):
        raise ValueError(
            f"Mitsuba's variant is {variant}: a vectorised one expected, as by "
            "mitsuba.set_variant('llvm_ad_rgb')"
        )
    if mi.is_polarized or mi.is_spectral:
        raise ValueError(f"Mitsuba's variant is {variant}: an RGB or monochrome one expected")
    context = mi.BSDFContext()

    def vector(w: FloatArray) -> Any:
        return mi.Vector3f(np.ascontiguousarray(w.T, dtype=np.float32))

    def interaction(wo: FloatArray) -> Any:
        si = dr.zeros(mi.SurfaceInteraction3f, len(wo))
        si.wi = vector(wo)
        return si

    def colour(value: Any, n: int) -> FloatArray:
        # Constants come as one value for all.
        array = np.asarray(value, dtype=np.float64).reshape(-1, np.shape(value)[-1])
        return np.broadcast_to(array.T, (n, array.shape[0]))[:, : 3 if len(array) > 1 else 1]

    def evaluate(wo: FloatArray, wi: FloatArray) -> FloatArray:
        value = colour(bsdf.eval(context, interaction(wo), vector(wi)), len(wi))
        return np.broadcast_to(value, (len(wi), 3))

    def density(wo: FloatArray, wi: FloatArray) -> FloatArray:
        value = np.asarray(bsdf.pdf(context, interaction(wo), vector(wi)), dtype=np.float64)
        return np.broadcast_to(value.reshape(-1), (len(wi),))

    def sample(wo: FloatArray, u: FloatArray) -> tuple[Any, ...]:
        n = len(wo)
        # The nearest single to a number just below 1 would be 1.
        u = np.minimum(u.astype(np.float32), np.nextafter(np.float32(1), np.float32(0)))
        square = mi.Point2f(np.ascontiguousarray(u[:, 1:].T))
        sampled, weight = bsdf.sample(
            context, interaction(wo), mi.Float(np.ascontiguousarray(u[:, 0])), square
        )
        wi = np.broadcast_to(np.asarray(sampled.wo, dtype=np.float64).T, (n, 3))
        pdf = np.broadcast_to(np.asarray(sampled.pdf, dtype=np.float64).reshape(-1), (n,))
        is_delta = mi.has_flag(sampled.sampled_type, mi.BSDFFlags.Delta)
        is_delta = np.broadcast_to(np.asarray(is_delta, dtype=np.bool_).reshape(-1), (n,))
        weight = np.broadcast_to(colour(weight, n), (n, 3))
        # A weight of 0 is Mitsuba's sign of a failed sample, whatever the pdf.
        is_lost = np.all(weight == 0.0, axis=1)
        return wi, weight, np.where(is_lost, 0.0, pdf), is_delta

    return evaluate, density, sample


def _modules() -> tuple[Any, Any]:
    try:
        return importlib.import_module("mitsuba"), importlib.import_module("drjit")
    except ImportError as error:
        raise ImportError("Mitsuba 3 is missing: pip install mitsuba") from error
