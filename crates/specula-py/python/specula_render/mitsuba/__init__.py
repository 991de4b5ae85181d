"""Specula's rough metals and glass as BSDF plugins of Mitsuba 3, in Dr.Jit.

>>> import mitsuba as mi
>>> mi.set_variant("llvm_ad_rgb")
>>> from specula_render import mitsuba as specula
>>> specula.register()
['specula_conductor', 'specula_dielectric', 'specula_multibounce', 'specula_multibounce_dielectric']

The plugins take the parameters of ``roughconductor`` and ``roughdielectric``; the distribution is
GGX unless another is named. They work in scalar and vectorized variants, RGB and spectral, and are
differentiable where Mitsuba's are, but for the walks of ``specula_multibounce`` and
``specula_multibounce_dielectric``.

Mitsuba's names apply: ``wi`` is the view, ``wo`` the direction that is sampled.
"""

from __future__ import annotations

from .scene import ReplacedScene, replace_roughconductors

__all__ = ["ReplacedScene", "register", "replace_roughconductors"]


def register() -> list[str]:
    """Register the plugins for the active variant; again after ``mitsuba.set_variant``.

    Returns
    -------
    list of str
        Names for a scene's ``type``.

    Raises
    ------
    ImportError
        Mitsuba is not installed.
    RuntimeError
        No variant is set, or a polarized one.
    """
    from . import plugins

    return plugins.register()
