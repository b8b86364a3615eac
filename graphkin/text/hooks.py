"""Services of upper packages for lower ones: listed in the package, requested by name."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

from graphkin import SERVICES


def service(name: str) -> Callable[..., Any]:
    """The function of a service, loaded on first use.

    Raises LookupError for a service that the package does not list.
    """
    if name not in SERVICES:
        raise LookupError(f"nobody renders {name!r}")
    module, _, function = SERVICES[name].partition(":")
    found: Callable[..., Any] = getattr(import_module(module), function)
    return found
