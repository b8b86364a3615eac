"""Services of upper packages for lower ones: registered by the package, requested by name."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

DONE_BY: dict[str, str] = {}
"""The function of each service, as module:function."""


def register(**services: str) -> None:
    """Register the functions of some services, each as module:function."""
    DONE_BY.update(services)


def service(name: str) -> Callable[..., Any]:
    """The function of a service, loaded on first use.

    Raises LookupError for an unregistered service.
    """
    if name not in DONE_BY:
        raise LookupError(f"nobody renders {name!r}")
    module, _, function = DONE_BY[name].partition(":")
    found: Callable[..., Any] = getattr(import_module(module), function)
    return found
