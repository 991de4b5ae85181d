"""The package's own lobes through the proofs, as users call them."""

from __future__ import annotations

import pytest
import specula_render as sr
from specula_render import stat

GOLD = sr.RoughConductor((0.1, 0.6), "Au")


@pytest.mark.parametrize(
    ("lobe", "plan"),
    [
        (GOLD, stat.Plan()),
        (sr.SmoothConductor("Ag"), stat.Plan(reciprocity="nowhere")),
        (sr.Plastic(0.2, 1.49, (0.2, 0.5, 0.8)), stat.Plan()),
    ],
    ids=["gold", "mirror", "plastic"],
)
def test_lobes_pass(lobe: sr.Bsdf, plan: stat.Plan) -> None:
    stat.assert_bsdf(lobe, views=stat.views(azimuth_deg=(20.0,)), plan=plan)


def test_glass_passes_from_both_sides() -> None:
    plan = stat.Plan(eta=1.5, reciprocity="everywhere")
    views = stat.views(cos_theta=(0.7, 0.05), azimuth_deg=(20.0,), below=True)
    stat.assert_bsdf(sr.RoughDielectric(0.3, 1.5), views=views, plan=plan)


def test_a_wrong_sampler_of_a_right_lobe_fails() -> None:
    other = sr.RoughConductor((0.11, 0.6), "Au")

    def sample(wo: stat.FloatArray, u: stat.FloatArray) -> tuple[stat.FloatArray, ...]:
        sampled = other.sample(wo, u)
        return sampled.wi, sampled.weight, sampled.pdf

    report = stat.prove("alpha off by 10 %", stat.Subject(GOLD.eval, GOLD.pdf, sample))
    assert not report.is_pass
    assert not report.fits[0].passed


def test_stochastic_lobes_are_refused() -> None:
    with pytest.raises(ValueError, match="MultibounceConductor is stochastic"):
        stat.prove("multibounce", sr.MultibounceConductor(0.7, "Cu"))
