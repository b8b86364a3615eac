"""Which format a text has, told by how it begins, and the mechanism that it holds."""

from __future__ import annotations

import re

from graphkin.importing.record import Imported, damaged, refused
from graphkin.scene.file_limits import LARGEST, file_bytes
from graphkin.text.errors import message

LINK = re.compile(r"https?://[^?\s]*\?", re.IGNORECASE)
MECH = re.compile(r"(^|&)mech=")
PMKS = re.compile(r"[\w-]{2}\.[\w,-]*\.[\w,-]*\.[\w-]*\.")


def content(given: str) -> str:
    """The text of a file, or of a link after its question mark. A link is never opened.

    Raises SceneError where there is no such file, or it is too large.
    """
    if found := LINK.match(given):
        text = given[found.end() :]
        if len(text) <= LARGEST:
            return text
        raise refused(message("more than {most} bytes", most=LARGEST))
    try:
        data = file_bytes(given, LARGEST + 1)
    except (OSError, ValueError):
        raise refused(
            message("no file {name} can be read", name=given), message("a file, or a link with ?")
        ) from None
    if len(data) > LARGEST:
        raise refused(message("more than {most} bytes", most=LARGEST))
    return data.decode("utf-8-sig", "replace")


def imported(text: str) -> Imported:
    """The mechanism in a text of any format. Raises SceneError with what is wrong."""
    text = text.strip()
    try:
        if text.startswith("<") and "<linkage2" in text:
            from graphkin.importing.linkage import linkage_text

            return linkage_text(text)
        if text.startswith("M["):
            from graphkin.importing.pyslvs import pyslvs_text

            return pyslvs_text(text)
        if text.startswith("{"):
            from graphkin.importing.pylinkage import pylinkage_text

            return pylinkage_text(text)
        if MECH.search(text):
            from graphkin.importing.old_pmks import mech_text

            return mech_text(text)
        from graphkin.importing.pmks import new_text, old_text

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
            " or M[J[…], …] of Pyslvs"
        ),
    )
