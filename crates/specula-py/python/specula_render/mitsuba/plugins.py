"""Mitsuba's plugins around Specula's lobes: one class each of the active variant."""

from __future__ import annotations

from typing import Any

from .conductor import Conductor
from .dielectric import Dielectric
from .multibounce import Multibounce
from .multibounce_dielectric import MultibounceDielectric
from .runtime import mi, require_variant

__all__ = ["LOBES", "register"]

#: Plugin names and the lobes behind them.
LOBES: dict[str, type[Any]] = {
    "specula_conductor": Conductor,
    "specula_dielectric": Dielectric,
    "specula_multibounce": Multibounce,
    "specula_multibounce_dielectric": MultibounceDielectric,
}


def register() -> list[str]:
    """Register all plugins for the active variant.

    Returns
    -------
    list of str
        Their names.

    Raises
    ------
    RuntimeError
        No variant is set, or a polarized one.
    """
    require_variant()
    for name, lobe in LOBES.items():
        mi.register_bsdf(name, _plugin(lobe))
    return list(LOBES)


def _plugin(lobe: type[Any]) -> type[Any]:
    """A BSDF of the active variant that hands all calls to a lobe.

    Mitsuba's classes exist once per variant, and allow no second base class.
    """

    class Plugin(mi.BSDF):  # type: ignore[misc]
        def __init__(self, props: Any) -> None:
            mi.BSDF.__init__(self, props)
            self.lobe = lobe(props)
            # Dr.Jit finds what a frozen function reads in dictionaries, not in other objects.
            self.state = _state(self.lobe)
            self.m_components = self.lobe.components()
            self.m_flags = 0
            for flags in self.m_components:
                self.m_flags |= flags

        def traverse(self, callback: Any) -> None:
            self.lobe.traverse(callback)

        def parameters_changed(self, keys: list[str]) -> None:
            self.lobe.parameters_changed(keys)

        def sample(
            self, ctx: Any, si: Any, sample1: Any, sample2: Any, active: Any = True
        ) -> tuple[Any, Any]:
            sampled: tuple[Any, Any] = self.lobe.sample(ctx, si, sample1, sample2, active)
            return sampled

        def eval(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
            return self.lobe.eval(ctx, si, wo, active)

        def pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
            return self.lobe.pdf(ctx, si, wo, active)

        def eval_pdf(
            self, ctx: Any, si: Any, wo: Any, active: Any = True
        ) -> tuple[Any, Any]:
            both: tuple[Any, Any] = self.lobe.eval_pdf(ctx, si, wo, active)
            return both

        def to_string(self) -> str:
            return str(self.lobe.to_string())

    Plugin.__name__ = Plugin.__qualname__ = f"Specula{lobe.__name__}"
    return Plugin


def _state(node: Any) -> dict[str, Any]:
    """Attributes of a lobe and of its parts, by name."""
    package = __name__.rpartition(".")[0]
    return {
        name: _state(value) if type(value).__module__.startswith(package) else value
        for name, value in vars(node).items()
    }
