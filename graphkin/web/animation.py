"""The animations of a cycle as files: a picture that moves, and a page for a browser."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphkin.documents.sheet_documents import language_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from graphkin.motion.cycle import Cycle


def animation_files(
    cycle: Cycle, stem: str, formats: Sequence[str], language: str | None = None
) -> dict[str, bytes]:
    """The animations of a cycle by file name, in those of the formats that are gif or html.

    ``language`` is the scene's own if None. Raises SceneError where nothing can be moved.
    """
    if not {"gif", "html"} & set(formats):
        return {}
    from graphkin.web.frames import motion

    words = language_of(cycle.mechanism, language)
    found, files = motion(cycle, words), dict[str, bytes]()
    if "gif" in formats:
        from graphkin.web.gif import gif

        files[f"{stem}-motion.gif"] = gif(found, words)
    if "html" in formats:
        from graphkin.web.player import player_page

        files[f"{stem}-motion.html"] = player_page(found, words).encode("utf-8")
    return files
