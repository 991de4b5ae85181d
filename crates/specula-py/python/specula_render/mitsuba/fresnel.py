"""Reflectance of facets: of conductors for all channels of a spectrum at once; averages."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .runtime import dr, mi

__all__ = ["cosine_average", "dielectric_average", "fresnel_conductor"]

#: Gauss and Jacobi's nodes and weights for ``2 int_0^1 f(mu) mu dmu``, exact up to degree 9.
_RULE = (
    (0.098535085798826, 0.031495829043385),
    (0.304535726646364, 0.147817740145233),
    (0.562025189752614, 0.292773974169339),
    (0.801986582126392, 0.334349276188739),
    (0.960190142948531, 0.193563180453303),
)


def fresnel_conductor(cos_theta: Any, eta: Any, k: Any) -> Any:
    """Unpolarized reflectance of a conductor.

    Mitsuba's ``fresnel_conductor`` (after Moeller, *Optics*, 1988), which its Python interface has
    for a single channel only.

    Parameters
    ----------
    cos_theta : Float
        Cosine of incidence on the facet, in [0, 1].
    eta, k : Spectrum
        Real and imaginary part of the index, relative to the outside.
    """
    cos2 = dr.square(cos_theta)
    sin2 = 1 - cos2
    eta2, k2 = dr.square(eta), dr.square(k)
    difference = eta2 - k2 - sin2
    a2_b2 = dr.safe_sqrt(dr.square(difference) + 4 * k2 * eta2)
    a = dr.safe_sqrt(0.5 * (a2_b2 + difference))
    term_1, term_2 = a2_b2 + cos2, 2 * cos_theta * a
    r_s = (term_1 - term_2) / (term_1 + term_2)
    term_3, term_4 = a2_b2 * cos2 + dr.square(sin2), term_2 * sin2
    r_p = r_s * (term_3 - term_4) / (term_3 + term_4)
    return 0.5 * (r_s + r_p)


def cosine_average(reflectance: Callable[[Any], Any]) -> Any:
    """``2 int_0^1 F(mu) mu dmu``, to 1e-3 for measured metals."""
    total = mi.Spectrum(0)
    for mu, weight in _RULE:
        total += weight * reflectance(mi.Float(mu))
    return total


def dielectric_average(eta: Any) -> Any:
    """``2 int_0^1 F(mu) mu dmu`` of a smooth interface, to 2e-4 for indices in [1/3, 3].

    Light from inside: ``1 - (1 - F_avg(eta)) / eta^2`` by reciprocity.
    """
    n = dr.maximum(eta, dr.rcp(eta))
    entering = sum(weight * mi.fresnel(mi.Float(mu), n)[0] for mu, weight in _RULE)
    return dr.select(eta >= 1, entering, 1 - (1 - entering) / dr.square(n))
