"""What fills the gaps of a sentence about a step: symbols, lengths, angles and figures."""

from __future__ import annotations

from collections.abc import Mapping

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.naming import names_in, way_of
from graphkin.drawing.symbol_markup import bar


def fields_of(drawing: Drawing, says: Mapping[str, str]) -> dict[str, str]:
    """The symbols that a sentence needs: its names, its bar, its guide."""
    fields = names_in(says)
    if "p" in says and "q" in says:
        fields["bar"] = bar(says["p"], says["q"])
    if "g" in says:
        fields["guide"] = way_of(drawing, says["g"])
    return fields
