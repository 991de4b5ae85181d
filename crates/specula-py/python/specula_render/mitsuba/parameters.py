"""Parameters that the plugins share, read as Mitsuba's own plugins read them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from .beckmann import Beckmann
from .ggx import LEAST_ALPHA, SAMPLERS, Ggx
from .runtime import dr, mi

__all__ = ["ConductorIndex", "Roughness", "choice", "differentiable", "optional_texture"]


def choice(props: Any, name: str, allowed: Iterable[str]) -> str:
    """A string parameter out of `allowed`, whose first entry is the default.

    Raises
    ------
    ValueError
        The scene names another value.
    """
    names = tuple(allowed)
    value = str(props.get(name, names[0])).lower()
    if value not in names:
        raise ValueError(
            f"{props.plugin_name()}: no such {name}: '{value}' (expected {', '.join(names)})"
        )
    return value


def optional_texture(props: Any, name: str) -> Any:
    """A texture in [0, 1], or None where the scene gives none."""
    return props.get_texture(name, 1.0) if name in props else None


def differentiable(discontinuous: bool = True) -> Any:
    """Flags for `traverse`, Mitsuba's for the same parameters."""
    flags = mi.ParamFlags.Differentiable
    return flags | mi.ParamFlags.Discontinuous if discontinuous else flags


class Roughness:
    """``alpha`` or ``alpha_u`` and ``alpha_v``, numbers or textures, and ``distribution``.

    Parameters
    ----------
    props : mitsuba.Properties
        The plugin's.
    samplers : iterable of str
        Samplers of GGX that the plugin offers, the default first.

    Raises
    ------
    ValueError
        Alphas are given twice or by half, or a sampler that the distribution does not have.
    """

    def __init__(self, props: Any, samplers: Iterable[str] = SAMPLERS) -> None:
        self.distribution = choice(props, "distribution", ("ggx", "beckmann"))
        if self.distribution == "ggx":
            self.sampler = choice(props, "sampler", samplers)
        else:
            self.sampler = str(props.get("sampler", "visible"))
            if self.sampler != "visible":
                raise ValueError(
                    f"{props.plugin_name()}: sampler '{self.sampler}' is for GGX; Beckmann has"
                    " Mitsuba's sampler of visible normals only: leave 'sampler' out"
                )
        split = "alpha_u" in props, "alpha_v" in props
        if split[0] != split[1]:
            raise ValueError(f"{props.plugin_name()}: give both 'alpha_u' and 'alpha_v'")
        if split[0] and "alpha" in props:
            raise ValueError(f"{props.plugin_name()}: give 'alpha', or 'alpha_u' and 'alpha_v'")
        self.isotropic = not split[0]
        if self.isotropic:
            self.alpha_u = self.alpha_v = props.get_unbounded_texture("alpha", 0.1)
        else:
            self.alpha_u = props.get_unbounded_texture("alpha_u")
            self.alpha_v = props.get_unbounded_texture("alpha_v")

    @property
    def extra_flags(self) -> int:
        """Flags of an anisotropic lobe."""
        return 0 if self.isotropic else int(mi.BSDFFlags.Anisotropic)

    def traverse(self, callback: Any) -> None:
        """Report the alphas under Mitsuba's names."""
        if self.isotropic:
            callback.put("alpha", self.alpha_u, differentiable())
        else:
            callback.put("alpha_u", self.alpha_u, differentiable())
            callback.put("alpha_v", self.alpha_v, differentiable())

    def at(self, si: Any, active: Any) -> Any:
        """The distribution of normals at a point of the surface: `Ggx` or `Beckmann`."""
        alpha_u = dr.maximum(self.alpha_u.eval_1(si, active), LEAST_ALPHA)
        alpha_v = alpha_u
        if not self.isotropic:
            alpha_v = dr.maximum(self.alpha_v.eval_1(si, active), LEAST_ALPHA)
        if self.distribution == "beckmann":
            return Beckmann(alpha_u, alpha_v)
        return Ggx(alpha_u, alpha_v, self.isotropic, self.sampler)

    def __repr__(self) -> str:
        return f"{self.distribution}, sampler={self.sampler}, alpha_u={self.alpha_u}"


class ConductorIndex:
    """``eta`` and ``k``, or a ``material`` by name; a perfect mirror where neither is given.

    Raises
    ------
    ValueError
        Both are given.
    """

    def __init__(self, props: Any) -> None:
        material = str(props.get("material", "none"))
        if material == "none":
            self.eta = props.get_unbounded_texture("eta", 0.0)
            self.k = props.get_unbounded_texture("k", 1.0)
        elif "eta" in props or "k" in props:
            raise ValueError(f"{props.plugin_name()}: give 'material', or 'eta' and 'k', not both")
        else:
            found = _textures_of({"type": "roughconductor", "material": material})
            self.eta, self.k = found["eta"], found["k"]

    def traverse(self, callback: Any) -> None:
        """Report the index under Mitsuba's names."""
        callback.put("eta", self.eta, differentiable())
        callback.put("k", self.k, differentiable())

    def at(self, si: Any, active: Any) -> tuple[Any, Any]:
        """``(eta, k)`` at a point of the surface, spectra."""
        return self.eta.eval(si, active), self.k.eval(si, active)


def _textures_of(description: dict[str, Any]) -> dict[str, Any]:
    """The textures of one of Mitsuba's plugins by name: its own reading of measured indices."""
    found: dict[str, Any] = {}

    class Collector(mi.TraversalCallback):  # type: ignore[misc]
        def put(self, name: str, value: Any, *_: Any) -> None:
            found[name] = value

    mi.load_dict(description).traverse(Collector())
    return found
