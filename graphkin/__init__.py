"""Velocity and acceleration plans of planar mechanisms, constructed as by hand on paper."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from graphkin.mechanism import Mechanism, load

__all__ = ["Mechanism", "load"]
__version__ = "1.0.0"

SERVICES = {
    "does_not_close": "graphkin.diagnosis.assembly_failure:does_not_close",
    "refuse_touching": "graphkin.diagnosis.assembly_failure:refuse_touching",
    "wrong_with_structure": "graphkin.mechanism:wrong_with_structure",
    "settle": "graphkin.writers.commit:settle",
    "plot": "graphkin.documents.notebook:plot",
    "picture": "graphkin.documents.notebook:picture",
}
"""What a lower room needs of a higher one, as module:function."""


def service(name: str) -> Callable[..., Any]:
    """The function of a service, loaded on first use.

    Raises LookupError for a service that is not listed.
    """
    if name not in SERVICES:
        raise LookupError(f"nobody renders {name!r}")
    module, _, function = SERVICES[name].partition(":")
    found: Callable[..., Any] = getattr(import_module(module), function)
    return found


def __getattr__(name: str) -> Any:
    """Import the public names on first use, so that importing the package stays fast."""
    if name in __all__:
        from graphkin import mechanism

        return getattr(mechanism, name)
    raise AttributeError(f"module 'graphkin' has no attribute {name!r}")


def __dir__() -> list[str]:
    """The public names, also before they are imported."""
    return [*globals(), *__all__]
