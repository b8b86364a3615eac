"""What a pencil makes of a construction: many drawings of it, and the error that they will have."""

from graphkin.accuracy.pencil.forecast import Forecast, forecast
from graphkin.accuracy.pencil.original import Original, original
from graphkin.accuracy.pencil.pencil import Pencil
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
