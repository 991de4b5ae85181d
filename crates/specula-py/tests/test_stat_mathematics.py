"""Special functions against tabulated values, and quadrature against integrals in closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest
from specula_render.stat import gamma_lower, gamma_upper, sidak
from specula_render.stat.arrays import FloatArray
from specula_render.stat.checks.normalisation import acceptance_p
from specula_render.stat.kronrod import GAUSS, KRONROD, NODES
from specula_render.stat.significance import chi_square_survival, poisson_tail, two_sided_p
from specula_render.stat.sphere import Peak, angles, direction
from specula_render.stat.tree import Accuracy, Forest

# a, x, P(a, x), Q(a, x) by scipy.special.gammainc and gammaincc 1.17.1.
GAMMA = [
    (0.5, 0.001, 0.035670591729679894, 0.9643294082703201),
    (0.5, 1.92072941034706, 0.9499999999999997, 0.05000000000000028),
    (1.0, 1.0, 0.6321205588285577, 0.36787944117144245),
    (1.0, 30.0, 0.9999999999999064, 9.357622968840163e-14),
    (5.0, 2.0, 0.052653017343711125, 0.9473469826562889),
    (5.0, 5.0, 0.5595067149347879, 0.44049328506521257),
    (10.0, 9.1535, 0.4328074995899646, 0.5671925004100353),
    (50.0, 70.0, 0.994859497541494, 0.0051405024585059085),
    (50.0, 30.0, 0.0005188914625480344, 0.999481108537452),
    (200.0, 200.0, 0.5094034180072367, 0.4905965819927636),
    (300.0, 350.0, 0.9971042274681777, 0.0028957725318222776),
    (300.0, 420.0, 0.9999999997039923, 2.960076670956555e-10),
    (2500.0, 2400.0, 0.021659687865363323, 0.9783403121346367),
    (2500.0, 2700.0, 0.999952823644053, 4.717635594693638e-05),
    (1e5, 1e5, 0.5004205221103651, 0.4995794778896348),
    (1e5, 99000.0, 0.0007574199211747684, 0.9992425800788253),
    (3.7, 0.01, 2.559623384291717e-09, 0.9999999974404366),
    (0.01, 0.5, 0.9943732438060326, 0.005626756193967183),
    (0.01, 5.0, 0.9999882464805873, 1.1753519412750834e-05),
]


@pytest.mark.parametrize(("a", "x", "lower", "upper"), GAMMA)
def test_incomplete_gamma(a: float, x: float, lower: float, upper: float) -> None:
    # lgamma of 1e5 is 1e6, so the last digits of the prefactor are lost.
    relative = 1e-12 if a < 1e3 else 1e-9
    assert gamma_lower(a, x) == pytest.approx(lower, rel=relative, abs=1e-15)
    assert gamma_upper(a, x) == pytest.approx(upper, rel=relative, abs=1e-15)


def test_incomplete_gamma_over_a_grid_against_scipy() -> None:
    special = pytest.importorskip("scipy.special", reason="SciPy is not installed")
    for a in np.geomspace(0.05, 3e4, 40):
        for ratio in (0.01, 0.5, 0.9, 1.0, 1.1, 2.0, 10.0):
            x = float(a * ratio)
            upper, lower = float(special.gammaincc(a, x)), float(special.gammainc(a, x))
            assert gamma_upper(float(a), x) == pytest.approx(upper, rel=1e-9, abs=1e-13)
            assert gamma_lower(float(a), x) == pytest.approx(lower, rel=1e-9, abs=1e-13)


def test_incomplete_gamma_at_the_ends() -> None:
    assert gamma_lower(2.0, 0.0) == 0.0
    assert gamma_upper(2.0, 0.0) == 1.0
    assert gamma_upper(2.0, math.inf) == 0.0
    assert gamma_lower(2.0, math.inf) == 1.0
    assert gamma_upper(10.0, 1e6) == 0.0
    for a, x in ((0.0, 1.0), (1.0, -1.0), (1.0, math.nan), (math.inf, 1.0)):
        with pytest.raises(ValueError, match="a > 0 and x >= 0 expected"):
            gamma_upper(a, x)


def test_chi_square_has_the_tabulated_quantiles() -> None:
    # Upper 5 % points (Abramowitz and Stegun, table 26.8).
    for degrees, point in ((1, 3.84146), (10, 18.3070), (100, 124.342)):
        assert chi_square_survival(point, degrees) == pytest.approx(0.05, abs=1e-6)
    assert chi_square_survival(math.nan, 3) == 0.0
    assert chi_square_survival(0.0, 0) == 1.0


def test_normal_and_poisson_tails() -> None:
    # Abramowitz and Stegun, table 26.1.
    for z, p in ((0.0, 1.0), (1.0, 0.3173105079), (1.959964, 0.05), (5.0, 5.733e-7)):
        assert two_sided_p(z) == pytest.approx(p, rel=1e-4)
    assert two_sided_p(math.nan) == 0.0
    assert poisson_tail(1.0, 0.1, 0.0) == pytest.approx(1.0 - math.exp(-0.1))
    assert poisson_tail(0.0, 3.0, 0.0) == pytest.approx(math.exp(-3.0))
    assert poisson_tail(1.0, 0.0, 0.0) == 0.0
    assert poisson_tail(0.0, 0.0, 0.0) == 1.0


def test_sidak_undoes_the_family() -> None:
    each = sidak(0.01, 1000)
    assert 1.0 - (1.0 - each) ** 1000 == pytest.approx(0.01, rel=1e-10)
    assert sidak(0.01, 1) == pytest.approx(0.01)


def test_acceptance_near_and_far_from_the_integral() -> None:
    likely = [(50_100.0, 0.5), (100_000.0, 1.0), (99_999.0, 0.99999), (0.0, 0.0)]
    assert all(acceptance_p(count, 1e5, rate, 1e-8) > 0.1 for count, rate in likely)
    unlikely = [(51_000.0, 0.5), (99_990.0, 1.0), (1e5, 1.01), (1e5, math.nan)]
    assert all(acceptance_p(count, 1e5, rate, 1e-8) < 1e-8 for count, rate in unlikely)


def test_kronrod_is_exact_to_degree_22_and_gauss_to_13() -> None:
    for degree in range(0, 23, 2):
        expected = 2.0 / (degree + 1.0)
        assert float(KRONROD @ NODES**degree) == pytest.approx(expected, abs=2e-15)
        if degree <= 13:
            assert float(GAUSS @ NODES**degree) == pytest.approx(expected, abs=2e-15)


@pytest.mark.parametrize(("cos_theta", "kappa"), [(1.0, 1e3), (0.3, 1e4), (0.0, 1e5), (-1.0, 50.0)])
def test_narrow_von_mises_fisher_lobe_integrates_to_one(cos_theta: float, kappa: float) -> None:
    mean = direction(np.array([cos_theta]), np.array([2.1]))[0]
    x, y, z = (float(c) for c in mean)

    def density(w: FloatArray) -> FloatArray:
        norm = kappa / (2.0 * np.pi * (1.0 - np.exp(-2.0 * kappa)))
        return np.asarray(norm * np.exp(-0.5 * kappa * np.sum((w - mean) ** 2, axis=1)))[:, None]

    forest = Forest()
    forest.refine_about([Peak((x, y, z), 3.0 / math.sqrt(kappa))], np.zeros((0, 3)), 1.0)
    forest.integrate(density, Accuracy(relative=1e-7))
    value, error = forest.totals()
    assert forest.is_converged
    assert abs(value[0] - 1.0) < min(1e-7, error + 1e-12)


def test_pilot_samples_find_a_lobe_that_the_start_would_miss() -> None:
    mean = direction(np.array([0.61]), np.array([4.0]))[0]
    kappa = 1e8

    def density(w: FloatArray) -> FloatArray:
        square = np.sum((w - mean) ** 2, axis=1)
        return np.asarray(kappa / (2.0 * np.pi) * np.exp(-0.5 * kappa * square))[:, None]

    pilot = mean + np.random.default_rng(1).normal(size=(2000, 3)) / math.sqrt(kappa)
    pilot /= np.linalg.norm(pilot, axis=1, keepdims=True)
    blind, guided = Forest(), Forest()
    blind.integrate(density, Accuracy())
    guided.refine_about([], pilot, 1.0 / 200.0)
    guided.integrate(density, Accuracy())
    assert blind.totals()[0][0] < 1e-3
    assert guided.totals()[0][0] == pytest.approx(1.0, abs=1e-6)


def test_a_step_is_found_and_its_error_admitted() -> None:
    axis = direction(np.array([0.4]), np.array([1.0]))[0]
    forest = Forest()
    forest.integrate(lambda w: ((w @ axis) > 0.8)[:, None].astype(np.float64), Accuracy(1e-3))
    value, error = forest.totals()
    assert abs(value[0] - 0.4 * np.pi) < min(error, 1e-3 * 0.4 * np.pi)


def test_cells_partition_the_forest() -> None:
    forest = Forest([0.3])
    forest.integrate(lambda w: np.maximum(w[:, 2:], 0.0) ** 20 * 21.0 / (2.0 * np.pi), Accuracy())
    cells, cell_of = forest.cells(1.0 / 400.0)
    assert forest.value[cells, 0].sum() == pytest.approx(1.0, abs=1e-6)
    assert forest.value[cells, 0].max() <= 1.0 / 400.0
    w = np.random.default_rng(2).normal(size=(5000, 3))
    w /= np.linalg.norm(w, axis=1, keepdims=True)
    theta, phi = angles(w)
    patches = forest.patches[cells][cell_of[forest.locate(w)]]
    assert np.all((patches[:, 0] <= theta) & (theta <= patches[:, 1]))
    assert np.all((patches[:, 2] <= phi) & (phi <= patches[:, 3]))


def test_not_a_number_is_reported() -> None:
    forest = Forest()
    forest.integrate(lambda w: np.where(w[:, 2:] > 0.99, np.nan, 1.0), Accuracy())
    assert not forest.is_converged
    assert math.isinf(forest.totals()[1])
