"""Hair and measured materials over arrays: densities, samples, furnaces, known values, errors."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import specula_render as sr
from conftest import directions
from specula_render import stat
from specula_render.lab.process import call


@pytest.fixture(scope="module")
def gold(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file of GGX gold, alpha 0.3, as a measurement would have it."""
    file = tmp_path_factory.mktemp("measured") / "gold.bsdf"
    command = ["tabulate", "conductor Au alpha 0.3", "--views", "16", "--colours", "32"]
    call([*command, "-o", str(file)], progress=False)
    return file


@pytest.mark.parametrize("h", [None, -0.6, 0.0, 0.9])
@pytest.mark.parametrize("beta", [0.15, 0.6])
def test_hair_that_absorbs_nothing_loses_nothing(h: float | None, beta: float) -> None:
    hair = sr.Hair(0.0, beta_m=beta, beta_n=beta, h=h)
    wo = directions(4, both_sides=True)
    for view in wo:
        samples = hair.sample(np.tile(view, (20_000, 1)), seed=3)
        assert (samples.outcome > 0).all()
        mean = samples.weight.mean(axis=0)
        error = samples.weight.std(axis=0) / np.sqrt(20_000)
        assert (np.abs(mean - 1.0) < 5.0 * error + 1e-3).all(), (view, mean)


def test_hair_has_the_density_of_its_samples() -> None:
    hair = sr.Hair(colour=(0.5, 0.3, 0.15), beta_m=0.4, beta_n=0.5)
    views = stat.views(cos_theta=(0.9, 0.3))
    # Its attenuations are those of one of the two directions.
    plan = stat.Plan(reciprocity="nowhere")
    stat.assert_bsdf(hair, "hair", views, plan)


def test_hair_is_given_its_absorption_in_one_way() -> None:
    brown = sr.Hair()
    assert repr(brown) == repr(sr.Hair(eumelanin=1.3))
    assert brown.colour == pytest.approx(sr.Hair(colour=brown.colour).colour)
    assert "h=0.5" in repr(sr.Hair(1.0, h=0.5))
    with pytest.raises(ValueError, match="given twice"):
        sr.Hair(1.0, colour=0.5)
    with pytest.raises(ValueError, match="beta_m: expected a number in"):
        sr.Hair(beta_m=0.0)
    with pytest.raises(ValueError, match="h: expected a number in"):
        sr.Hair(h=2.0)


def test_a_measured_material_is_what_was_measured(gold: Path) -> None:
    measured, known = sr.MeasuredBrdf(gold), sr.RoughConductor(0.3, "Au")
    assert measured.is_isotropic
    assert not measured.is_stochastic
    assert str(gold) in repr(measured)
    wo, wi = directions(2000, least=0.4), directions(2000, seed=2, least=0.4)
    expected, found = known.eval(wo, wi), measured.eval(wo, wi)
    scale = expected.max()
    assert np.abs(found - expected).max() < 0.05 * scale
    assert np.abs(found.mean(axis=0) / expected.mean(axis=0) - 1.0).max() < 0.02
    single = measured.eval(wo.astype(np.float32), wi.astype(np.float32))
    assert single.dtype == np.float32
    np.testing.assert_allclose(single, found, rtol=2e-3, atol=1e-4 * scale)


def test_a_measured_material_has_the_density_of_its_samples(gold: Path) -> None:
    measured = sr.MeasuredBrdf(str(gold))
    views = stat.views(cos_theta=(0.9, 0.5))
    # It is as reciprocal as the tables are.
    plan = stat.Plan(reciprocity="nowhere")
    stat.assert_bsdf(measured, "gold", views, plan)
    wo = np.tile([0.6, 0.0, 0.8], (1000, 1))
    samples = measured.sample(wo, seed=1)
    f_cos, pdf = measured.eval_pdf(wo, samples.wi)
    hit = samples.outcome == 1
    assert hit.mean() > 0.95
    np.testing.assert_allclose(samples.pdf[hit], pdf[hit], rtol=1e-5)
    np.testing.assert_allclose(samples.weight[hit] * pdf[hit, None], f_cos[hit], rtol=1e-5)


def test_files_that_are_no_measurements_are_errors(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"none\.bsdf"):
        sr.MeasuredBrdf(tmp_path / "none.bsdf")
    wrong = tmp_path / "wrong.bsdf"
    wrong.write_bytes(b"tensor_fileX" + bytes(100))
    with pytest.raises(ValueError, match=r"wrong\.bsdf: "):
        sr.MeasuredBrdf(wrong)
    with pytest.raises(ValueError, match="is a folder; expected a file"):
        sr.MeasuredBrdf(tmp_path)
