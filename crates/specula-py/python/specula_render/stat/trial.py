"""What the checks of one view share: its samples, and its integrals over the sphere."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .arrays import BoolArray, FloatArray, is_unit, one_direction
from .randomness import generator, triples
from .kronrod import Integrand
from .plan import Plan
from .report import view_text
from .sphere import Peak
from .subject import Samples, Subject, repeated
from .tree import Accuracy, Forest


@dataclass(frozen=True)
class Trial:
    """One view of a subject, sampled and integrated."""

    subject: Subject
    plan: Plan
    wo: FloatArray
    """The view, (3,)."""
    u: FloatArray
    """The random numbers of the samples, (n, 3)."""
    samples: Samples
    is_accepted: BoolArray
    """Samples of the density that count: in the hemispheres tested, (n,)."""
    forest: Forest
    """Integrals of pdf and of red, green, blue of `f |cos theta_i|`."""
    seed_name: str
    """Names the random numbers."""

    @classmethod
    def of(cls, subject: Subject, wo: npt.ArrayLike, plan: Plan, name: str = "") -> Trial:
        """Samples and integrates.

        Raises
        ------
        ValueError
            If `wo` is not a unit vector of shape (3,), or a callable returns a wrong shape.
        """
        view = one_direction(wo, "wo")
        seed_name = f"{name} {view_text(_triple(view))}"
        rng = generator(plan.seed, seed_name)
        u = triples(subject, plan.samples, rng)
        samples = subject.sample(repeated(view, plan.samples), u)
        is_accepted = samples.is_accepted
        is_upper = plan.hemispheres == "upper"
        if is_upper:
            with np.errstate(invalid="ignore"):
                is_accepted = is_accepted & ~(samples.wi[:, 2] < 0.0)
        forest = Forest(_edges(view, plan), upper=is_upper)
        pilot = _pilot(subject, view, plan, seed_name)
        forest.refine_about(_peaks(view, plan), pilot, 2.0 / plan.cells)
        forest.integrate(_integrand(subject, view), _accuracy(subject, plan))
        return cls(subject, plan, view, u, samples, is_accepted, forest, seed_name)

    @property
    def view(self) -> tuple[float, float, float]:
        """The view, for a report."""
        return _triple(self.wo)

    @property
    def tolerance(self) -> float:
        """Largest relative difference of values that should be equal."""
        own = self.plan.relative_tolerance
        return self.subject.relative_tolerance if own is None else own

    @property
    def rounding(self) -> float:
        """How far rounding may take an integral of the pdf from its true value."""
        return max(1e-9, 1e-2 * self.tolerance)


def _triple(w: FloatArray) -> tuple[float, float, float]:
    return float(w[0]), float(w[1]), float(w[2])


def _integrand(subject: Subject, wo: FloatArray) -> Integrand:
    def integrand(wi: FloatArray) -> FloatArray:
        many = repeated(wo, len(wi))
        return np.concatenate([subject.pdf(many, wi)[:, None], subject.eval(many, wi)], axis=1)

    return integrand


def _accuracy(subject: Subject, plan: Plan) -> Accuracy:
    # Singles are noise below the tenth of their tolerance, which no refinement removes.
    return Accuracy(
        relative=1e-4 if subject.is_single else 1e-5,
        absolute=1e-6 if subject.is_single else 1e-7,
        max_patches=plan.max_patches,
        cell_share=1.0 / plan.cells,
        samples=plan.samples,
    )


def _pilot(subject: Subject, wo: FloatArray, plan: Plan, name: str) -> FloatArray:
    """A few samples that show quadrature where lobes are; independent of those tested."""
    n = min(plan.samples, 10_000)
    u = triples(subject, n, generator(plan.seed, f"{name} pilot"))
    samples = subject.sample(repeated(wo, n), u)
    return samples.wi[samples.is_accepted & is_unit(samples.wi)]


def _edges(wo: FloatArray, plan: Plan) -> list[float]:
    """Where the half vectors of reflection and refraction cross the horizon, and the plan's."""
    crossings = [float(wo[2]) * e for e in (1.0, plan.eta, 1.0 / plan.eta)]
    return [*plan.cos_theta_edges, *crossings, *(-c for c in crossings)]


def _peaks(wo: FloatArray, plan: Plan) -> list[Peak]:
    """Where microfacet lobes are sharp: about the directions of reflection and transmission."""
    x, y, z = _triple(wo)
    peaks = [Peak((-x, -y, z), plan.sharpness)]
    if plan.eta != 1.0:
        eta = 1.0 / plan.eta if z < 0.0 else plan.eta
        # A lobe of refracted rays is narrower, by the bend, than one of reflected rays.
        width = plan.sharpness * min(abs(eta - 1.0), 1.0)
        squared = 1.0 - (x * x + y * y) / (eta * eta)
        if squared > 0.0:
            down = np.copysign(np.sqrt(squared), -z)
            peaks.append(Peak((-x / eta, -y / eta, float(down)), width))
        peaks.append(Peak((-x, -y, -z), width))
    return peaks
