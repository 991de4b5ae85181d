"""Proofs of BSDFs: chi-square, integral of the pdf, white furnace, reciprocity, consistency.

Any BSDF can be tested: three callables over arrays, an object with such methods, or a BSDF of
Mitsuba 3.

| name | is |
|---|---|
| `Subject` | a BSDF under test |
| `prove`, `assert_bsdf` | all checks over a list of views: a report, or an error |
| `views`, `Plan` | what to test and how strictly |
| `chi_square` | samples against the pdf |
| `normalisation` | the pdf's integral against the share of samples accepted |
| `furnace` | the mean weight against the quadrature of `f cos` |
| `consistency` | weight = f cos / pdf, finite, non-negative |
| `reciprocity` | `f(wo, wi) = f(wi, wo)`, with eta^2 for refraction |

The mathematics and the thresholds are those of the Rust crate `specula-stat`. Figures need
Matplotlib; nothing else needs more than NumPy.

Examples
--------
>>> import numpy as np
>>> from specula_render import stat
>>> def cosine(wo, wi):
...     return np.maximum(wi[:, 2], 0.0) * (wo[:, 2] > 0.0) / np.pi
>>> def sample(wo, u):
...     r, phi = np.sqrt(u[:, 0]), 2.0 * np.pi * u[:, 1]
...     wi = np.stack([r * np.cos(phi), r * np.sin(phi), np.sqrt(1.0 - u[:, 0])], axis=1)
...     return wi, np.ones(len(wi)), cosine(wo, wi)
>>> lambert = stat.Subject(eval=cosine, pdf=cosine, sample=sample)
>>> report = stat.prove("Lambert", lambert, stat.views(cos_theta=(0.7,)))
>>> report.is_pass
True
"""

from .arrays import FloatArray
from .assertion import assert_bsdf
from .checks.chi_square import ChiSquare, chi_square
from .checks.consistency import consistency
from .checks.furnace import furnace
from .checks.normalisation import normalisation
from .checks.reciprocity import reciprocity
from .gamma import gamma_lower, gamma_upper
from .plan import Plan, views
from .proof import prove
from .report import Check, Report
from .significance import sidak
from .subject import Samples, Subject

__all__ = [
    "Check",
    "ChiSquare",
    "FloatArray",
    "Plan",
    "Report",
    "Samples",
    "Subject",
    "assert_bsdf",
    "chi_square",
    "consistency",
    "furnace",
    "gamma_lower",
    "gamma_upper",
    "normalisation",
    "prove",
    "reciprocity",
    "sidak",
    "views",
]
