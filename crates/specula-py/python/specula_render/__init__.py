"""Microfacet BSDFs whose pdfs can be trusted, and a path tracer that uses them.

Lobes work on arrays of directions: unit, in the local frame of the surface, whose z is the
normal. ``wo`` leads to the viewer and is given; ``wi`` leads to the light and is sampled.
``eval`` returns ``f |cos theta_i|``, ``pdf`` is per steradian, and the weight of a sample is
``f |cos theta_i| / pdf``.

>>> import numpy as np
>>> import specula_render as sr
>>> gold = sr.RoughConductor(alpha=0.3, reflectance="Au")
>>> wo = np.array([0.6, 0.0, 0.8])
>>> samples = gold.sample(np.tile(wo, (1000, 1)), seed=1)
>>> bool(np.allclose(samples.pdf, gold.pdf(wo, samples.wi)))
True
"""

from specula_render._native import (
    Beckmann,
    Bsdf,
    CoatedDiffuse,
    DiffuseTransmission,
    Eon,
    Ggx,
    Gltf,
    Hair,
    Lambert,
    Layered,
    MeasuredBrdf,
    MultibounceConductor,
    MultibounceDielectric,
    Plastic,
    Principled,
    Reflectance,
    RoughConductor,
    RoughDielectric,
    Samples,
    SmoothConductor,
    SmoothDielectric,
    ThinDielectric,
    __version__,
    dielectric,
    level,
    metals,
)
from specula_render.albedo import albedo
from specula_render.picture import Comparison, Picture, read_exr
from specula_render.rendering import render, render_iter, render_live
from specula_render.scene import Material, Scene, SceneWarning, builtin, load

__all__ = [
    "Beckmann",
    "Bsdf",
    "CoatedDiffuse",
    "Comparison",
    "DiffuseTransmission",
    "Eon",
    "Ggx",
    "Gltf",
    "Hair",
    "Lambert",
    "Layered",
    "Material",
    "MeasuredBrdf",
    "MultibounceConductor",
    "MultibounceDielectric",
    "Picture",
    "Plastic",
    "Principled",
    "Reflectance",
    "RoughConductor",
    "RoughDielectric",
    "Samples",
    "Scene",
    "SceneWarning",
    "SmoothConductor",
    "SmoothDielectric",
    "ThinDielectric",
    "__version__",
    "albedo",
    "builtin",
    "dielectric",
    "level",
    "load",
    "metals",
    "read_exr",
    "render",
    "render_iter",
    "render_live",
]
