"""Planted faults, each of which must turn its check red; single checks; reports."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from specula_render import stat
from test_stat_lobes import Array, Ggx, Lambert, Sampled

VIEW = stat.views(cos_theta=(0.7,), azimuth_deg=(20.0,))
ALPHA = (0.1, 0.6)


class NoJacobian(Ggx):
    """Density of the normal given for that of the direction."""

    def pdf(self, wo: Array, wi: Array) -> Array:
        return super().pdf(wo, wi) * 4.0 * np.abs(self.terms(wo, wi)[1])


class NoMasking(Ggx):
    """pdf without G1."""

    def pdf(self, wo: Array, wi: Array) -> Array:
        return super().pdf(wo, wi) * (1.0 + self.lambda_(wo))


class Biased(Ggx):
    """One sample in a hundred goes elsewhere, with the numbers of where it should have gone."""

    def sample(self, wo: Array, u: Array) -> Sampled:
        right = super().sample(wo, u)
        wi = right.wi.copy()
        wi[u[:, 2] < 0.01, :2] *= -1.0
        return Sampled(wi, right.weight, right.pdf)


class RedWeight(Ggx):
    """Weights 2 % too large in red."""

    def sample(self, wo: Array, u: Array) -> Sampled:
        right = super().sample(wo, u)
        return Sampled(right.wi, right.weight * [1.02, 1.0, 1.0], right.pdf)


class NotReciprocal(Ggx):
    """f is multiplied by what depends on one direction only."""

    def eval(self, wo: Array, wi: Array) -> Array:
        return super().eval(wo, wi) * (1.0 - 0.1 * wi[:, 2:])


class NotANumber(Ggx):
    """One value in about a thousand is not a number."""

    def eval(self, wo: Array, wi: Array) -> Array:
        value = super().eval(wo, wi)
        value[np.mod(wi[:, 0] * 1e6, 1.0) < 1e-3] = np.nan
        return value


class NotANumberAtHorizon(Ggx):
    """A value at the horizon itself is not a number: no sample, no node of quadrature meets it."""

    def eval(self, wo: Array, wi: Array) -> Array:
        value = super().eval(wo, wi)
        value[np.abs(wi[:, 2]) < 1e-9] = np.nan
        return value


class Negative(Ggx):
    """The pdf is negative below the horizon."""

    def pdf(self, wo: Array, wi: Array) -> Array:
        return super().pdf(wo, wi) - np.where(wi[:, 2] < 0.0, 1e-6, 0.0)


class TooMuch(Ggx):
    """The pdf integrates to 1.02 times its share, and the weights agree with it."""

    def pdf(self, wo: Array, wi: Array) -> Array:
        return 1.02 * super().pdf(wo, wi)


class Mirrored(Ggx):
    """The azimuth of the anisotropy is reversed in the sampler."""

    def sample(self, wo: Array, u: Array) -> Sampled:
        flip = np.array([1.0, -1.0, 1.0])
        right = super().sample(wo * flip, u)
        return Sampled(right.wi, right.weight, right.pdf)


class Unnormalised(Ggx):
    """Directions are 1 % too long."""

    def sample(self, wo: Array, u: Array) -> Sampled:
        right = super().sample(wo, u)
        return Sampled(right.wi * 1.01, right.weight, right.pdf)


class Unreported(Lambert):
    """One sample in a hundred is lost, which the pdf does not tell."""

    def sample(self, wo: Array, u: Array) -> Sampled:
        right = super().sample(wo, u)
        return Sampled(right.wi, right.weight, np.where(u[:, 2] < 0.01, 0.0, right.pdf))


CHI, MASS, WEIGHT, SANE = "chi-square", "integral of pdf", "weight = f cos / pdf", "finite and"
FURNACE, RECIPROCITY = "furnace", "reciprocity"


@pytest.mark.parametrize(
    ("faulty", "checks"),
    [
        (NoJacobian(*ALPHA), {CHI, MASS}),
        (NoMasking(*ALPHA), {CHI, MASS}),
        (Biased(*ALPHA), {CHI, WEIGHT}),
        (RedWeight(*ALPHA), {WEIGHT, FURNACE}),
        (NotReciprocal(*ALPHA), {RECIPROCITY}),
        (NotANumber(*ALPHA), {WEIGHT, SANE, FURNACE}),
        (NotANumberAtHorizon(*ALPHA), {SANE}),
        (Negative(*ALPHA), {SANE}),
        (TooMuch(*ALPHA), {CHI, MASS}),
        (Mirrored(*ALPHA), {CHI, WEIGHT}),
        (Unnormalised(*ALPHA), {CHI, WEIGHT}),
        (Unreported(), {CHI, MASS, FURNACE}),
    ],
    ids=lambda value: type(value).__name__ if not isinstance(value, set) else "",
)
def test_planted_faults_are_noticed(faulty: Any, checks: set[str]) -> None:
    report = stat.prove(type(faulty).__name__, faulty, VIEW)
    failed = {c.name for c in report.failures()}
    assert not report.is_pass
    for check in checks:
        assert any(name.startswith(check) for name in failed), f"{check}\n{report}"


def test_faults_that_one_check_alone_notices() -> None:
    for faulty in (NotReciprocal(*ALPHA), NotANumberAtHorizon(*ALPHA)):
        report = stat.prove(type(faulty).__name__, faulty, VIEW)
        assert sum(not c.passed for c in report.checks) == 1, str(report)


def test_single_checks_agree_with_the_report() -> None:
    plan = stat.Plan(tests=3, seed=5)
    subject = stat.Subject.of(Ggx(0.5, 0.5))
    report = stat.prove("GGX", subject, VIEW, plan)
    fit = stat.chi_square(subject, VIEW[0], plan, name="GGX")
    singles = [
        fit.check(),
        stat.normalisation(subject, VIEW[0], plan, name="GGX"),
        *stat.consistency(subject, VIEW[0], plan, name="GGX"),
        stat.furnace(subject, VIEW[0], plan, name="GGX"),
        stat.reciprocity(subject, plan, name="GGX"),
    ]
    assert singles == report.checks
    assert fit.observed.sum() + fit.rejected == plan.samples
    assert fit.expected.sum() == pytest.approx(fit.integral * plan.samples)
    other = stat.prove("GGX", subject, VIEW, stat.Plan(tests=3, seed=6))
    assert [c.value for c in other.checks] != [c.value for c in report.checks]


def test_chance_of_false_alarm_is_kept() -> None:
    plan = [stat.Plan(samples=5_000, cells=50, seed=seed) for seed in range(60)]
    subject = stat.Subject.of(Lambert())
    p_values = [stat.chi_square(subject, VIEW[0], p).p_value for p in plan]
    # Bonferroni's p-values are no smaller than uniform ones, and not much larger.
    assert 2 <= sum(p < 0.25 for p in p_values) <= 24
    assert min(p_values) > 1e-4


class Upper(Lambert):
    """Is defined above the surface only."""

    def pdf(self, wo: Array, wi: Array) -> Array:
        assert np.all(wi[:, 2] >= 0.0)
        return super().pdf(wo, wi)


def test_upper_hemisphere_only() -> None:
    plan = stat.Plan(hemispheres="upper")
    # Half the samples of the second are below: they count as rejected.
    for lobe in (Upper(), Lambert(is_translucent=True)):
        report = stat.prove("upper", lobe, VIEW, plan)
        assert report.is_pass, str(report)
        assert report.fits[0].patches[:, :2].max() == pytest.approx(0.5 * np.pi)
    assert report.fits[0].integral == pytest.approx(0.5)


def test_specular_samples_are_left_out_of_the_density() -> None:
    def half(wo: Array, wi: Array) -> Array:
        return 0.5 * Lambert().pdf(wo, wi)

    def sample(wo: Array, u: Array) -> tuple[Any, ...]:
        diffuse = Lambert().sample(wo, u)
        is_mirror = u[:, 2] < 0.5
        wi = np.where(is_mirror[:, None], wo * [-1.0, -1.0, 1.0], diffuse.wi)
        return wi, np.ones(len(wo)), np.where(is_mirror, 1.0, half(wo, wi)), is_mirror

    report = stat.prove("coated", stat.Subject(half, half, sample), VIEW)
    assert report.is_pass, str(report)


def test_outcomes_tell_specular_samples_and_stochastic_lobes_are_refused() -> None:
    class Mirror:
        is_stochastic = False

        def eval(self, wo: Array, wi: Array) -> Array:
            return np.zeros((len(wo), 3))

        def pdf(self, wo: Array, wi: Array) -> Array:
            return np.zeros(len(wo))

        def sample(self, wo: Array, u: Array) -> SimpleNamespace:
            ones = np.ones(len(wo))
            wi, outcome = wo * [-1.0, -1.0, 1.0], np.full(len(wo), 3, dtype=np.uint8)
            return SimpleNamespace(wi=wi, weight=ones, pdf=ones, outcome=outcome)

    mirror = Mirror()
    report = stat.prove("mirror", mirror, VIEW, stat.Plan(reciprocity="nowhere"))
    assert report.is_pass, str(report)
    assert report.fits[0].rejected == report.fits[0].samples
    mirror.is_stochastic = True
    with pytest.raises(ValueError, match="Mirror is stochastic: its eval is an estimate"):
        stat.prove("mirror", mirror, VIEW)


def test_report_is_readable() -> None:
    report = stat.prove("a < b", RedWeight(0.5, 0.5), VIEW)
    lines = str(report).splitlines()
    assert lines[0] == "a < b: 4 of 6 checks pass"
    assert len(lines) == 2 + len(report.checks)
    assert sum(line.lstrip().startswith("FAIL") for line in lines) == 2
    page = report._repr_html_()
    assert page.count("<tr") == 1 + len(report.checks)
    assert "a &lt; b" in page
    assert not stat.Report("nothing").is_pass
    with pytest.raises(ValueError, match="no chi-square test"):
        stat.Report("nothing").figure()
