"""The effect of a pencil on a construction: simulated drawings, and their expected errors."""

from graphkin.accuracy.pencil.forecast import Drawn, Forecast, forecast, pencil_drawings, simulated
from graphkin.accuracy.pencil.pencil import Original, Pencil, original

__all__ = [
    "Drawn",
    "Forecast",
    "Original",
    "Pencil",
    "forecast",
    "original",
    "pencil_drawings",
    "simulated",
]
