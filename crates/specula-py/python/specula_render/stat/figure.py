"""The figure of a chi-square test: observed and expected density and their difference."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

import numpy as np

from .arrays import BoolArray, FloatArray
from .report import view_text
from .sphere import solid_angles

if TYPE_CHECKING:
    from .checks.chi_square import ChiSquare

_DECADES = 5.0
"""Shown of the density, black to white."""
_FULL = 5.0
"""Standard deviations of the darkest red and blue."""


def chi_square_figure(fit: ChiSquare, title: str = "") -> Any:
    """Three maps, azimuth across and polar angle down, with the cells of the test.

    Parameters
    ----------
    fit
        The test.
    title
        What was tested.

    Returns
    -------
    matplotlib.figure.Figure
        Free of pyplot: nothing has to be closed. `figure.savefig(path)` writes it.

    Raises
    ------
    ImportError
        If Matplotlib is missing.
    """
    figure_class = _module("matplotlib.figure").Figure
    solid_angle = np.maximum(solid_angles(fit.patches), 1e-300) * fit.samples
    observed, expected = fit.observed / solid_angle, fit.expected / solid_angle
    brightest = float(np.nanmax(np.maximum(observed, expected), initial=0.0)) or 1.0
    is_lower_empty = not np.any((fit.observed + fit.expected)[_is_lower(fit)] > 0.0)
    figure = figure_class(figsize=(7.5, 6.4 if is_lower_empty else 9.6), layout="constrained")
    axes = figure.subplots(3, 1, sharex=True, sharey=True)
    figure.suptitle(_heading(fit, title), fontsize="medium")
    log_scale = _module("matplotlib.colors").LogNorm(brightest * 10.0**-_DECADES, brightest)
    even_scale = _module("matplotlib.colors").Normalize(-_FULL, _FULL)
    panels = (
        ("observed: samples", observed, log_scale, "gray", "1/sr"),
        ("expected: integrated pdf", expected, log_scale, "gray", "1/sr"),
        ("difference", fit.residual, even_scale, "RdBu_r", "standard deviations"),
    )
    for axis, (caption, values, scale, colours, unit) in zip(axes, panels, strict=True):
        cells = _cells(fit, values, scale, colours)
        axis.add_collection(cells)
        axis.set(
            title=caption,
            ylabel="theta, degrees",
            xlim=(0.0, 360.0),
            ylim=(90.0 if is_lower_empty else 180.0, 0.0),
            facecolor="0.5" if scale is even_scale else "black",
        )
        axis.title.set_fontsize("small")
        axis.set_xticks(np.arange(0.0, 361.0, 45.0))
        axis.set_yticks(np.arange(0.0, 91.0 if is_lower_empty else 181.0, 30.0))
        bar = figure.colorbar(cells, ax=axis, extend="both" if scale is even_scale else "min")
        bar.set_label(unit, fontsize="small")
    axes[-1].set_xlabel("phi, degrees")
    return figure


def _heading(fit: ChiSquare, title: str) -> str:
    verdict = "passes" if fit.passed else "FAILS"
    heading = f"{title}, {view_text(fit.view)}" if title else view_text(fit.view)
    missing = 1.0 - fit.integral
    return (
        f"{heading}\nchi-square {verdict}: p = {fit.p_value:.2g}; rejected "
        f"{fit.rejected / fit.samples:.4f}, the pdf lacks {missing:.4f}"
    )


def _is_lower(fit: ChiSquare) -> BoolArray:
    return np.asarray(fit.patches[:, 0] > 0.5 * np.pi - 1e-9)


def _cells(fit: ChiSquare, values: FloatArray, scale: Any, colours: str) -> Any:
    """The cells as coloured rectangles."""
    theta_0, theta_1, phi_0, phi_1 = np.degrees(fit.patches).T
    corners = np.stack(
        [
            np.stack([phi_0, theta_0], axis=1),
            np.stack([phi_1, theta_0], axis=1),
            np.stack([phi_1, theta_1], axis=1),
            np.stack([phi_0, theta_1], axis=1),
        ],
        axis=1,
    )
    collection = _module("matplotlib.collections").PolyCollection(
        corners, norm=scale, cmap=colours, linewidths=0.0, antialiaseds=False
    )
    collection.set_array(np.ma.masked_invalid(values))
    return collection


def _module(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise ImportError("figures need Matplotlib: pip install matplotlib") from error
