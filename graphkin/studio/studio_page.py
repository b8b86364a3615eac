"""The page of the studio: its frame in the words of a language, and the text it begins with."""

from __future__ import annotations

import json
import re
from functools import lru_cache

from graphkin import __version__
from graphkin.studio.look import spoken_in
from graphkin.studio.session import Opened
from graphkin.text import LANGUAGES, Words
from graphkin.writers.templates import filled

SPOKEN = (
    "studio.language",
    "studio.sheet_language",
    "studio.text",
    "studio.problems",
    "studio.none_wrong",
    "studio.one_wrong",
    "studio.some_wrong",
    "studio.line",
    "studio.expected",
    "studio.column",
    "studio.file_name",
    "studio.new",
    "studio.open",
    "studio.save",
    "studio.save_sheets",
    "studio.here",
    "studio.no_scenes",
    "studio.labs",
    "studio.examples",
    "studio.like",
    "studio.close",
    "studio.cancel",
    "studio.replace",
    "studio.exist",
    "studio.changed",
    "studio.leave",
    "studio.go_on",
    "studio.moved",
    "studio.write_save",
    "studio.save_text",
    "studio.with_values",
    "studio.as_text",
    "studio.not_drawable",
    "studio.mend_first",
    "studio.drawn_for",
    "studio.saved",
    "studio.unsaved",
    "studio.drawing_sheets",
    "studio.files",
    "studio.no_files",
    "studio.view",
    "studio.parameters",
    "studio.no_parameters",
    "studio.value_of",
    "studio.write",
    "studio.reset",
    "studio.larger",
    "studio.take",
    "studio.on_mechanism",
    "studio.on_velocity",
    "studio.on_acceleration",
    "studio.old",
    "studio.checked_before",
    "studio.gone",
    "studio.failed",
    "studio.drawings",
    "studio.numbers",
    "studio.in_mechanism",
    "studio.key",
    "studio.build",
    "studio.field",
    "studio.tool_move",
    "studio.tool_pivot",
    "studio.tool_bar",
    "studio.tool_plate",
    "studio.tool_block",
    "studio.tool_wheel",
    "studio.tool_driver",
    "studio.tool_delete",
    "studio.gone_from_disk",
    "studio.write_instead",
    "studio.write_too",
    "studio.leave_out",
    "studio.offered",
    "studio.motion",
    "studio.with_curves",
    "studio.step_by_step",
    "studio.drawing_motion",
    "studio.moved_driver",
    "studio.all_drivers",
    "studio.picture",
    "studio.tool_scale",
    "studio.tool_shift",
    "studio.no_picture",
    "studio.span",
    "studio.how_scale",
    "studio.how_shift",
    "studio.no_image",
    "studio.undo",
    "studio.redo",
    "studio.speed",
    "studio.empty",
    "studio.how_begin",
    "studio.how_move",
    "studio.how_pivot",
    "studio.how_bar",
    "studio.how_plate",
    "studio.how_block",
    "studio.how_wheel",
    "studio.how_driver",
    "studio.how_delete",
    "studio.rules",
    "studio.class",
    "studio.find_ranges",
    "studio.neighbours",
    "studio.students",
    "studio.student",
    "studio.data",
    "studio.unfair",
    "studio.flattest",
    "studio.shortest",
    "studio.key_earns",
    "studio.trying",
    "studio.searching",
    "studio.fair_of",
    "studio.scene_first",
    "studio.earns_of",
    "studio.begin_rules",
    "studio.put_ranges",
    "studio.mend_scene",
    "studio.decides",
    "studio.sheet_of",
    "studio.task",
    "studio.steps",
    "studio.overlay",
    "sheet.velocity",
    "sheet.acceleration",
)
"""The sentences of the page, those that stand in it and those that it says later."""


def page(opened: Opened, words: Words) -> str:
    """The whole page, to begin with a text; the words of all languages go with it."""
    spoken = {language: spoken_in(language) for language in LANGUAGES}
    said = {language: said_in(language) for language in LANGUAGES}
    start = {"language": words.language, "words": said}
    page = filled(
        "studio/web/page.html",
        said=said[words.language],
        spoken=spoken,
        language=words.language,
        version=__version__,
        name=opened.name,
        mark=opened.mark,
        text=opened.text.removeprefix("\ufeff"),
        rules=opened.rules.removeprefix("\ufeff"),
        rules_mark=opened.rules_mark,
        start=json.dumps(start, ensure_ascii=False),
    )
    return f"{page}\n"


@lru_cache(maxsize=8)
def said_in(language: str) -> dict[str, str]:
    """The sentences of the page in one language."""
    words = spoken_in(language)
    return {key: words(key, **gaps(words, key)) for key in SPOKEN}


def gaps(words: Words, key: str) -> dict[str, str]:
    """The gaps of a sentence, left as they are for the page to fill."""
    return {name: f"{{{name}}}" for name in re.findall(r"\{(\w+)\}", words.sentences[key])}
