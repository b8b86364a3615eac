"""The format of a text, known from its first characters, and the mechanism that it holds."""

from __future__ import annotations

import re

from graphkin.importing.record import Completion, Imported, damaged, refused
from graphkin.scene.file_limits import LARGEST, file_bytes
from graphkin.text.errors import message

LINK = re.compile(r"https?://[^?\s]*\?", re.IGNORECASE)
EXPRESSION = re.compile(r"(?=\s*M\[)")
MECH = re.compile(r"(^|&)mech=")
DXF = re.compile(r"\s*(0\s*\n\s*SECTION|999\s*\n)|AutoCAD Binary DXF")
ARCHIVE = b"PK\x03\x04"
LARGEST_DRAWING = 2 << 20
"""The most bytes of a GeoGebra or DXF file."""
PROJECT = "pyslvs_ver:"
"""A key of every project of Pyslvs, which may also hold long paths."""
UNTRACED = Completion()
PMKS = re.compile(r"[\w-]{2}\.[\w,-]*\.[\w,-]*\.[\w-]*\.")


def content(given: str) -> str:
    """The text of a file, or of a link after its question mark. A link is never opened.

    An expression of Pyslvs is its own text. Raises SceneError where there is no such file, or it is
    too large.
    """
    if found := LINK.match(given) or EXPRESSION.match(given):
        text = given[found.end() :]
        if len(text) <= LARGEST:
            return text
        raise refused(message("more than {most} bytes", most=LARGEST))
    try:
        data = file_bytes(given, LARGEST_DRAWING + 1)
    except (OSError, ValueError):
        raise refused(
            message("no file {name} can be read", name=given), message("a file, or a link with ?")
        ) from None
    return text_of(data)


def text_of(data: bytes) -> str:
    """The text of a file, or inside a file of GeoGebra. Raises SceneError where it is too large."""
    if data.startswith(ARCHIVE) and len(data) <= LARGEST_DRAWING:
        from graphkin.importing.geogebra import unpacked

        return unpacked(data)
    text = data.decode("utf-8-sig", "replace")
    most = LARGEST_DRAWING if DXF.match(text) or PROJECT in text else LARGEST
    if len(data) > most:
        raise refused(message("more than {most} bytes", most=most))
    return text


def is_drawing(text: str) -> bool:
    """Whether a text is a drawing of GeoGebra or DXF, which does not say what is fixed."""
    return bool(DXF.match(text)) or (text.lstrip().startswith("<") and "<geogebra" in text)


def imported(text: str, tracing: Completion = UNTRACED) -> Imported:
    """The mechanism in a text of any format. Raises SceneError with what is wrong.

    ``tracing`` says of a drawing which points are fixed; other formats say it themselves.
    """
    text = text.strip()
    try:
        if text.startswith("<") and "<geogebra" in text:
            from graphkin.importing.geogebra import geogebra_figure
            from graphkin.importing.record import traced

            return traced(geogebra_figure(text), tracing)
        if DXF.match(text):
            from graphkin.importing.dxf_drawing import dxf_figure
            from graphkin.importing.record import traced

            return traced(dxf_figure(text), tracing)
        if text.startswith("<") and "<linkage" in text:
            from graphkin.importing.linkage import linkage_text

            return linkage_text(text)
        if text.startswith("M["):
            from graphkin.importing.pyslvs import pyslvs_text

            return pyslvs_text(text)
        if "mechanism:" in text and "M[" in text:
            from graphkin.importing.pyslvs import project_text

            return project_text(text)
        if text.startswith("{") and '"jointIds"' in text:
            from graphkin.importing.motiongen import motiongen_text

            return motiongen_text(text)
        if text.startswith("{") and '"joints"' in text:
            from graphkin.importing.pylinkage import pylinkage_text

            return pylinkage_text(text)
        if MECH.search(text):
            from graphkin.importing.pmks import mech_text

            return mech_text(text)
        from graphkin.importing.pmks import csv_text, new_text, old_text

        if text.partition("\n")[0].strip() == "joints":
            return csv_text(text)
        if text.startswith("j="):
            return old_text(text)
        if PMKS.match(text):
            return new_text(text)
    except (ValueError, KeyError, IndexError):
        raise damaged() from None
    raise refused(
        message("the text has no format that is imported"),
        message(
            "a link or a file of PMKS+, a file .linkage2 of Linkage, JSON of pylinkage,"
            " a file of MotionGen, M[J[…], …] of Pyslvs, a .ggb file of GeoGebra, or a DXF file"
        ),
    )
