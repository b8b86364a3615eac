"""numpy, loaded where something of it is used first: what runs on one scene does without."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

__all__ = ["np"]

if TYPE_CHECKING:
    import numpy as np
else:

    class LateNumpy(ModuleType):
        """Stands for numpy, and keeps what has been taken from it."""

        def __getattr__(self, name: str) -> Any:
            """Load numpy, and take one thing from it."""
            import numpy

            value = getattr(numpy, name)
            setattr(self, name, value)
            return value

    np = LateNumpy("numpy")
