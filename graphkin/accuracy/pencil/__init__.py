"""The effect of a pencil on a construction: simulated drawings, and their expected errors."""

from graphkin.accuracy.pencil.forecast import Forecast, forecast
from graphkin.accuracy.pencil.pencil import Original, Pencil, original
from graphkin.accuracy.pencil.redrawing import Drawn, pencil_drawings, simulated

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
