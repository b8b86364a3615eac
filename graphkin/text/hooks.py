"""What upper rooms do for lower ones: the package says who does it, lower rooms ask by name."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

DONE_BY: dict[str, str] = {}
"""By the name of each service the function that renders it, as module:function."""


def register(**services: str) -> None:
    """Say which functions render some services, each as module:function."""
    DONE_BY.update(services)


def service(name: str) -> Callable[..., Any]:
    """The function that renders a service, loaded where it is first used.

    Raises LookupError for one that nobody renders.
    """
    if name not in DONE_BY:
        raise LookupError(f"nobody renders {name!r}")
    module, _, function = DONE_BY[name].partition(":")
    found: Callable[..., Any] = getattr(import_module(module), function)
    return found
