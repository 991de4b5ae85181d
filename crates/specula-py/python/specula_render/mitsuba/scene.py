"""Specula's metals in the place of Mitsuba's, in a scene that is still a dictionary."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

__all__ = ["ReplacedScene", "replace_roughconductors"]


class ReplacedScene(dict[str, Any]):
    """A scene dictionary for ``mitsuba.load_dict``.

    Attributes
    ----------
    replaced : int
        How many ``roughconductor`` became ``specula_conductor``.
    """

    replaced: int = 0


def replace_roughconductors(scene_dict: Mapping[str, Any], **options: Any) -> ReplacedScene:
    """A copy of a scene in which every ``roughconductor`` is a ``specula_conductor``.

    Parameters
    ----------
    scene_dict : mapping
        What ``mitsuba.load_dict`` takes, nested at will (``twosided``, ``bumpmap``, shapes, ...).
        Objects that are loaded already, and references to them, stay as they are.
    **options
        Further parameters of each metal: ``sampler``, ``masking``, ``energy``. ``sampler`` is left
        out where the distribution is Beckmann, which has Mitsuba's sampler only.

    Returns
    -------
    ReplacedScene
        With the count in ``replaced``.

    Examples
    --------
    >>> replace_roughconductors({"type": "roughconductor", "alpha": 0.3})
    {'type': 'specula_conductor', 'alpha': 0.3, 'distribution': 'beckmann'}

    Notes
    -----
    Parameters stay: ``material``, ``eta``, ``k``, alphas, ``distribution`` (Beckmann where it is
    not given, as Mitsuba's), ``specular_reflectance``. ``sample_visible`` goes: Specula samples
    visible normals always. The scene that is given does not change.
    """
    copy, count = _copy(scene_dict, options)
    scene = ReplacedScene(copy)
    scene.replaced = count
    return scene


def _copy(node: Mapping[str, Any], options: Mapping[str, Any]) -> tuple[dict[str, Any], int]:
    """The copy of a node and the number of metals in it."""
    copy: dict[str, Any] = {}
    count = 0
    for key, value in node.items():
        if isinstance(value, Mapping):
            value, inside = _copy(value, options)
            count += inside
        copy[key] = value
    if copy.get("type") == "roughconductor":
        count += 1
        copy["type"] = "specula_conductor"
        copy.setdefault("distribution", "beckmann")
        copy.pop("sample_visible", None)
        is_ggx = str(copy["distribution"]).lower() == "ggx"
        copy.update({k: v for k, v in options.items() if is_ggx or k != "sampler"})
    return copy, count
