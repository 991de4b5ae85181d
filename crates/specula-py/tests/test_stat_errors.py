"""Misuse is told in words: what was expected, and what came."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from specula_render import stat
from test_stat_lobes import Array, Lambert

VIEW = stat.views(cos_theta=(0.7,), azimuth_deg=(20.0,))


def lambert(**changed: Callable[..., Any]) -> stat.Subject:
    lobe = Lambert()

    def sample(wo: Array, u: Array) -> tuple[Array, Array, Array]:
        sampled = lobe.sample(wo, u)
        return sampled.wi, sampled.weight, sampled.pdf

    return stat.Subject(
        changed.get("eval", lobe.eval), changed.get("pdf", lobe.pdf), changed.get("sample", sample)
    )


@pytest.mark.parametrize(
    ("subject", "message"),
    [
        (lambert(eval=lambda wo, wi: np.zeros((len(wo), 4))), r"eval: shape .* 3\) or .* 4\) came"),
        (lambert(pdf=lambda wo, wi: np.zeros((len(wo), 3))), r"pdf: shape \(\d+,\) .* 3\) came"),
        (lambert(pdf=lambda wo, wi: 0.5), r"pdf: shape \(\d+,\) expected, \(\) came"),
        (lambert(pdf=lambda wo, wi: None), "pdf: an array of real numbers .* NoneType came"),
        (lambert(sample=lambda wo, u: (wo, wo)), r"sample: a tuple .* tuple of 2 came"),
        (lambert(sample=lambda wo, u: wo), "sample: a tuple .* ndarray came"),
        (lambert(sample=lambda wo, u: (wo[:-1], wo, wo[:, 0])), r"sample: wi: shape \(\d+, 3\)"),
        (lambert(sample=lambda wo, u: (wo, wo[:, :2], wo[:, 0])), r"sample: weight: .* 2\) came"),
    ],
)
def test_wrong_shapes_are_told(subject: stat.Subject, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        stat.prove("wrong", subject, VIEW)


def test_wrong_views_plans_and_subjects_are_told() -> None:
    lobe = Lambert()
    with pytest.raises(ValueError, match=r"views\[1\] = \(0, 0, 2\) has length 2: a unit vector"):
        stat.prove("views", lobe, [[0.0, 0.0, 1.0], [0.0, 0.0, 2.0]])
    with pytest.raises(ValueError, match=r"views: shape \(n, 3\) with n > 0 expected, \(2,\) came"):
        stat.prove("views", lobe, [0.0, 1.0])
    with pytest.raises(ValueError, match=r"wo: shape \(3,\) expected, \(1, 3\) came"):
        stat.chi_square(stat.Subject.of(lobe), VIEW)
    with pytest.raises(ValueError, match=r"cos_theta\[0\]: in \[-1, 1\] expected, 1.5 came"):
        stat.views(cos_theta=(1.5,))
    with pytest.raises(TypeError, match="float has no method eval, pdf, sample"):
        stat.prove("number", 0.5)
    with pytest.raises(TypeError, match="pdf: a callable expected, float came"):
        stat.Subject(lobe.eval, 0.5, lobe.sample)  # type: ignore[arg-type]
    wrong: list[tuple[dict[str, Any], str]] = [
        ({"samples": 0}, "samples: at least 100 expected, 0 came"),
        ({"eta": -1.0}, "eta: a positive number expected"),
        ({"significance": 1.0}, r"significance: in \(0, 1\)"),
        ({"reciprocity": "below"}, "reciprocity: one of nowhere, above, everywhere expected"),
        ({"tests": 0}, "tests: at least 1"),
    ]
    for options, message in wrong:
        with pytest.raises(ValueError, match=message):
            stat.Plan(**options)
