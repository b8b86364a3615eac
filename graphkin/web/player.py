"""The page of a cycle: mechanism and plans that turn round or go from end to end, in one file.

The animation of a cycle as files: a GIF picture and a page for a browser.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from html import escape
from math import inf
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.layout import Layout, spans
from graphkin.construction.core.program import plan_vector
from graphkin.construction.core.quantities import SHEETS
from graphkin.documents.scaling import natural_seconds, targets_of
from graphkin.documents.sheet import title_of
from graphkin.documents.sheet_documents import language_of
from graphkin.drawing.marks import CircleMark, LineMark, Mark, Text, style_class
from graphkin.drawing.scale import Scales
from graphkin.drawing.style import VECTORS
from graphkin.drawing.symbol_markup import escape as markup
from graphkin.mechanism import Mechanism
from graphkin.text import Words
from graphkin.text.errors import NO_WORDS, Problem, SceneError, message
from graphkin.web.animation_pictures import (
    AIR,
    MECHANISM,
    PICTURE,
    Stage,
    driver_marks,
    room_in,
    scale_bar,
    stage,
)
from graphkin.web.facts import asked_rows, blocks_asked, senses
from graphkin.web.frames import FrameSequence, made, place_in
from graphkin.web.moving import Moving, moving
from graphkin.web.moving_labels import ASIDE, GAP, LEFT, LETTER
from graphkin.web.offline_page import PLAYER, bundled, data_block, ink_sheet, offline_page, part
from graphkin.web.offline_page import placed as drawn
from graphkin.web.protocol import Timed
from graphkin.web.screen_sheets import ScreenSheet
from graphkin.writers.svg import number
from graphkin.writers.templates import from_template

if TYPE_CHECKING:
    from graphkin.motion.cycle import Cycle
    from graphkin.text.tables import Say

NAMES = 2.8
"""Height of the names of vectors, in mm."""
POINTS = ("pin", "fixed-pivot", "point", "pole")
"""The classes of the circles that show points."""
SPEEDS = (0.25, 0.5, 1.0, 2.0)
"""The playing speeds, relative to the usual one."""

TURN, WAY = 5.0, 3.5
"""Seconds for a full turn or a time, and for a range."""


def player_page(motion: FrameSequence, words: Words) -> str:
    """The page of a motion. Raises SceneError where a page cannot move the mechanism that way."""
    set_up = stage(motion, words, beside=True)
    sheets = screen_sheets(set_up)
    moved = moving(motion.cycle.mechanism, sheets, motion.cycle.sweep.number)
    if moved is None or moved.driven.driver is not motion.cycle.sweep.driver:
        raise SceneError(cannot())
    shown = list(set_up.captions)
    fixed = [list(scale_bar(field, unit, size, words)) for field, _, unit, size in shown]
    fixed[0] = [*set_up.ground, *fixed[0]]
    title = title_of(sheets[0].drawing)
    named = [list(vector_names(sheet, s)) for s, sheet in enumerate(sheets)]
    body = from_template(
        "web/templates/player.html",
        title=title,
        words=words,
        figures=list(figures(set_up, sheets, fixed, named)),
        driver=moved.driven.datum,
        speeds=SPEEDS,
        rows=[
            (row, *row_words(row, sheet.drawing))
            for sheet in sheets
            for row in sorted(asked_rows(sheet.drawing))
        ],
        shortened=shortened(motion, moved, words),
        anew=words("animation.anew") if goes_back(moved) else "",
        run=data_block("run", record(set_up, moved, sheets, named)),
    )
    marks = [mark for sheet in sheets for mark in (*sheet.left, *sheet.right)]
    marks += [name.text for names in named for name in names]
    marks += [mark for own in fixed for mark in own]
    looks = (
        ink_sheet(marks, "colour"),
        part("page.css"),
        part("player.css"),
        part("curves.css"),
        shape(set_up),
    )
    scripts = (moved.source, bundled(PLAYER))
    return offline_page(title, words.language, body, looks, scripts)


def goes_back(moved: Moving) -> bool:
    """Whether the mechanism would have to return from the end of the range that is shown."""
    return moved.driven.driver is not None and not moved.reach.whole


def cannot() -> Problem:
    """The problem of a page that cannot show this motion."""
    found = message(
        "a page moves one driver of a scene, or all of them by the time; not this motion"
    )
    hint = message("--format gif shows other motions")
    return Problem("--format html", found, NO_WORDS, hint)


def screen_sheets(set_up: Stage) -> list[ScreenSheet]:
    """The fields of a motion at the scene's position, with the mechanism on the first."""
    mechanism = set_up.motion.cycle.mechanism
    scales = Scales(1.0, natural_seconds(mechanism), triangles=False)
    kinds = [kind for kind in SHEETS if targets_of(mechanism, kind)]
    found = []
    for place, kind in enumerate(kinds or ["velocity"]):
        drawing = drawing_of(mechanism, kind, scales, set_up.words)
        mechanism_field = set_up.mechanism
        layout = Layout(mechanism_field, set_up.plans.get(kind, mechanism_field), {})
        layout = replace(layout, spans=spans(drawing, layout))
        left, right = list[Mark](), list[Mark]()
        if place == 0:
            left = [*set_up.mechanism_marks(drawing), *driver_marks(drawing, layout.mechanism)]
        if kinds:
            right = set_up.plan_marks(drawing, layout.plan)
        found.append(ScreenSheet(drawing, layout, tuple(left), tuple(right)))
    return found


def drawing_of(mechanism: Mechanism, kind: str, scales: Scales, words: Words) -> Drawing:
    """The drawing of one plan; for a scene that asks for no plan, the drawing of its positions."""
    positions = [target for target in mechanism.program.targets if target[0] == "position"]
    return made(mechanism, kind, targets_of(mechanism, kind) or positions, scales, words)


class Figure(Struct, frozen=True):
    """A field: its caption, its window, its fixed marks, and its moving marks.

    The script moves the window at each position of the driver, and the fixed marks ``back`` in it.
    ``beyond`` is shown where a plan leaves the field.
    """

    caption: str
    beyond: str
    box: str
    back: str
    fixed: Sequence[str]
    moves: Sequence[str]


class VectorName(Struct, frozen=True):
    """The name of a plan's vector: its id, the id of its line, its text, and if it is asked for."""

    id: str
    line: str
    text: Text
    asked: bool


def vector_names(sheet: ScreenSheet, s: int) -> Iterator[VectorName]:
    """The names of a plan's vectors: those asked for, then whole vectors, then components.

    They start at the pole; the script moves each next to its vector.
    """
    drawing = sheet.drawing
    steps, asked = drawing.trace.program.steps, asked_rows(drawing)
    found = []
    for k, mark in enumerate(sheet.right, len(sheet.left)):
        if isinstance(mark, LineMark) and style_class(mark) in VECTORS and mark.step is not None:
            vector = plan_vector(steps[mark.step])
            if vector is not None:
                rank = (vector.symbol not in asked, bool(vector.p or vector.sign), k)
                found.append((rank, mark, vector.symbol))
    for rank, mark, name in sorted(found, key=lambda each: each[0]):
        x, y = sheet.layout.plan.at
        text = Text(x, y, drawing.symbol(name), f"label {style_class(mark)}", NAMES, "middle", name)
        yield VectorName(f"v{s}-{rank[-1]}", f"m{s}-{rank[-1]}", text, not rank[0])


def placed_label(name: VectorName) -> list[object]:
    """The ids of a name and its vector, the middle and size of its ink, if it is asked for."""
    (left, top), _, (right, bottom), _ = name.text.corners()
    middle = (left + right) / 2, (top + bottom) / 2
    return [name.id, name.line, *middle, right - left, bottom - top, name.asked]


def figures(
    set_up: Stage,
    sheets: Sequence[ScreenSheet],
    fixed: Sequence[Sequence[Mark]],
    named: Sequence[Sequence[VectorName]],
) -> Iterator[Figure]:
    """The fields as pictures; where a plan is moved aside, its window moves the opposite way."""
    fields = [(0, 0, sheets[0].left)]
    fields += [(s, len(sheet.left), sheet.right) for s, sheet in enumerate(sheets) if sheet.right]
    for place, ((field, name, _, _), (s, first, marks), below) in enumerate(
        zip(set_up.captions, fields, fixed, strict=True)
    ):
        u, v = 0.0, 0.0
        if place:
            at = set_up.seated(sheets[s].drawing).at
            u, v = at[0] - field.at[0], at[1] - field.at[1]
        left, top, right, bottom = field.rect
        yield Figure(
            name,
            set_up.beyond if place else "",
            " ".join(map(number, (left - u, top - v, right - left, bottom - top))),
            f"{number(-u)} {number(-v)}",
            [drawn("", Timed(mark, 0, None)) for mark in below],
            [
                *(drawn(f"m{s}-{first + k}", Timed(mark, 0, None)) for k, mark in enumerate(marks)),
                *(drawn(name.id, Timed(name.text, 0, None)) for name in named[s] if place),
            ],
        )


def shortened(motion: FrameSequence, moved: Moving, words: Words) -> str:
    """The words that say where and why the motion ends before its dead points."""
    if not motion.shortened:
        return ""
    driven = moved.driven
    ends = dict(zip(("low", "high"), (motion.low, motion.high), strict=True))
    ends |= dict(zip(("first", "last"), motion.reached, strict=True))
    fields = {
        name: words.significant(at / driven.metres, 4) + driven.unit_in(words)
        for name, at in ends.items()
    }
    return words("animation.shortened", **fields)


def row_words(row: str, drawing: Drawing) -> tuple[str, str]:
    """The symbol and the unit of a quantity that is asked for."""
    words, unit = drawing.words, drawing.words(f"table.{drawing.kind}")
    if row[0] == drawing.rate.letter:
        return drawing.symbol(row), words(f"table.{drawing.rate.target}")
    if block := blocks_asked(drawing).get(row):
        on = drawing.scene.links[block].slides[0].on
        return f"*{drawing.sliding.letter}*_{{{markup(block)}/{markup(on)}}}", unit
    return drawing.symbol(row), unit


def record(
    set_up: Stage,
    moved: Moving,
    sheets: Sequence[ScreenSheet],
    named: Sequence[Sequence[VectorName]],
) -> dict[str, object]:
    """The data for the script: the range that is shown, and the words for it."""
    motion, words = set_up.motion, set_up.words
    driven, sweep = moved.driven, motion.cycle.sweep
    low, high = moved.reach.low, moved.reach.high
    if not moved.reach.whole:
        shift = shift_of(motion, moved)
        low = max(low, motion.low / driven.metres + shift)
        high = min(high, motion.high / driven.metres + shift)
    return {
        "low": low,
        "high": high,
        "start": min(max(driven.start, low), high),
        "seconds": WAY if sweep.driver is not None and not moved.reach.whole else TURN,
        "sense": driven.sense,
        "back": goes_back(moved),
        "degrees": driven.unit == "deg",
        "unit": driven.unit_in(words),
        "mark": words("decimal_mark"),
        "letters": [own for s, sheet in enumerate(sheets) for own in letters(set_up, sheet, s)],
        "letter": [LETTER, GAP, ASIDE, *LEFT],
        "vectors": [[*map(placed_label, names)] for names in named],
        "panes": [panes(sheet, s) for s, sheet in enumerate(sheets) if sheet.right],
        "senses": worded(sheets, words),
        "notable": [*notable(motion, moved, words)],
    }


def shift_of(motion: FrameSequence, moved: Moving) -> float:
    """The offset of the driver's position on the page from its position in the cycle."""
    place = place_in(motion.cycle, motion.low, motion.high)
    return moved.driven.start - place / moved.driven.metres


def notable(motion: FrameSequence, moved: Moving, words: Words) -> Iterator[tuple[float, str]]:
    """The driver's positions at dead and change points, and where a follower reverses.

    Dead points at the ends are included; followers are limited to the range shown. A driver that
    turns endlessly passes each point once per turn. Where the wheels need several turns, the points
    of the turn shown on the page are listed.
    """
    from graphkin.motion.follower_limits import followers

    cycle, metres, shift = motion.cycle, moved.driven.metres, shift_of(motion, moved)
    low, high = (-inf, inf) if cycle.path.whole else (motion.low, motion.high)
    events = [(each.at, words(f"animation.{each.kind}")) for each in cycle.singulars]
    for each in followers(cycle):
        back = words("animation.turns_back", name=each.name)
        events += [(limit.at, back) for limit in each.limits if low <= limit.at <= high]
    if cycle.path.whole and cycle.path.turns > 1:
        first, last = ((end - shift) * metres for end in (moved.reach.low, moved.reach.high))
        every = [(cycle.path.found_at(at, first, last), said) for at, said in events]
        events = [(at, said) for at, said in every if first <= at <= last]
    for at, said in sorted(events):
        yield round(at / metres + shift, 6), said


def worded(sheets: Sequence[ScreenSheet], words: Words) -> dict[str, Sequence[str]]:
    """The words for both senses of each row that has a sense, the positive sense first."""
    turns = [escape(words(f"page.{key}")) for key in ("anticlockwise", "clockwise")]
    rows = {row for sheet in sheets for row in asked_rows(sheet.drawing) if row[0] in "ωε"}
    return {**dict.fromkeys(sorted(rows), turns), **senses(sheets[0].drawing)}


def panes(sheet: ScreenSheet, s: int) -> dict[str, object]:
    """The pane of a plan: its figure, its edges, the room for the plan, and its pole's circle."""
    rect, pole = sheet.layout.plan.rect, sheet.drawing.pole
    places = [k for k, m in enumerate(sheet.right) if isinstance(m, CircleMark) and m.name == pole]
    return {
        "figure": f"field-{s + 1}",
        "rect": rect,
        "room": room_in(rect, AIR),
        "pole": f"m{s}-{len(sheet.left) + places[0]}",
    }


def letters(set_up: Stage, sheet: ScreenSheet, s: int) -> Iterator[list[list[object]]]:
    """The letters of each field with their rules, as moving_labels.lettering places them.

    Each has the ids of its text and of its point's circle. It has the middle and width of its ink
    as drawn, its distance, its turn, and the ids of the circles that guide it.
    """
    first, kind = 0, sheet.drawing.kind
    for rules, marks in (
        (set_up.rules[MECHANISM], sheet.left),
        (set_up.rules.get(kind), sheet.right),
    ):
        circles = {
            mark.name: f"m{s}-{first + k}"
            for k, mark in enumerate(marks)
            if isinstance(mark, CircleMark) and style_class(mark) in POINTS
        }
        found: list[list[object]] = []
        for k, mark in enumerate(marks):
            if rules and isinstance(mark, Text) and mark.name in circles:
                rule, box = rules[mark.name], mark.corners()
                middle = [(box[0][i] + box[2][i]) / 2 for i in (0, 1)]
                near = [circles[name] for name in rule.others if name in circles]
                own = [f"m{s}-{first + k}", circles[mark.name], *middle, box[1][0] - box[0][0]]
                found.append([*own, rule.far, *rule.turn, near])
        yield found
        first += len(marks)


def shape(set_up: Stage) -> str:
    """The style rule for the widths of the mechanism and the plans side by side."""
    left, _, right, _ = set_up.mechanism.rect
    plans = list(set_up.plans.values())
    if not plans:
        return "#stage{--left:1fr;--right:0fr}"
    across = plans[0].rect[2] - plans[0].rect[0]
    return f"#stage{{--left:{right - left:g}fr;--right:{across:g}fr;--rows:{len(plans)}}}"


def animation_files(
    cycle: Cycle,
    stem: str,
    formats: Sequence[str],
    language: str | None = None,
    say: Say = lambda words: None,
) -> dict[str, bytes]:
    """The animation files of a cycle by name, for the formats ``gif`` and ``html``.

    ``language`` None means the scene's own language; ``say`` receives the progress. Raises
    SceneError where nothing can move.
    """
    if not {"gif", "html"} & set(formats):
        return {}
    from graphkin.web.frames import motion

    say("moving the mechanism")
    words = language_of(cycle.mechanism, language)
    found, files = motion(cycle, words), dict[str, bytes]()
    if "gif" in formats:
        files[f"{stem}-motion.gif"] = gif(found, words, say)
    if "html" in formats:
        say("writing the page that moves")
        files[f"{stem}-motion.html"] = player_page(found, words).encode("utf-8")
    return files


# --- an animation as a GIF file -------------------------------------------------------------------


DOTS = 4.0
"""Dots per millimetre."""
PAUSE = 50
"""Milliseconds for which each picture is shown."""
COLOURS = 64
TASTED = 6
"""Number of pictures from which the colours are chosen."""


def gif(motion: FrameSequence, words: Words, say: Say = lambda words: None) -> bytes:
    """The GIF file of a motion, which repeats without end."""
    few = in_few_colours(in_full_colour(stage(motion, words), say))
    first, *rest = (few[number] for number in motion.order)
    out = io.BytesIO()
    first.save(
        out, format="GIF", save_all=True, append_images=rest, duration=PAUSE, loop=0, optimize=False
    )
    return out.getvalue()


def in_full_colour(set_up: Stage, say: Say) -> list[Any]:
    """The pictures of all moments in full colour. Marks that do not move are painted once."""
    from PIL import Image

    under = painted(set_up.still)
    ground = Image.alpha_composite(Image.new("RGBA", under.size, "white"), under)
    pictures, moments = list[Any](), set_up.motion.moments
    for nth, moment in enumerate(moments, 1):
        say(f"drawing picture {nth} of {len(moments)}")
        pictures.append(
            Image.alpha_composite(ground, painted(set_up.moving(moment))).convert("RGB")
        )
    return pictures


def painted(marks: Sequence[Mark]) -> Any:
    """A Pillow picture of some marks, transparent where nothing is in_full_colour."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from PIL import Image

    from graphkin.writers.axes import put_marks

    width, height = PICTURE
    figure = Figure(figsize=(width / 25.4, height / 25.4), dpi=DOTS * 25.4, facecolor="none")
    canvas: Any = FigureCanvasAgg(figure)
    axes = figure.add_axes((0, 0, 1, 1))
    put_marks(axes, marks, (0.0, 0.0))
    axes.set_axis_off()
    axes.set_xlim(0, width)
    axes.set_ylim(-height, 0)
    dots, size = canvas.print_to_buffer()
    return Image.frombytes("RGBA", size, bytes(dots))


def in_few_colours(pictures: Sequence[Any]) -> list[Any]:
    """The pictures reduced to one shared palette, which is chosen from a few of them."""
    from PIL import Image

    step = max(len(pictures) // TASTED, 1)
    some = pictures[::step][:TASTED]
    width, height = some[0].size
    tasted = Image.new("RGB", (width, height * len(some)))
    for i, one in enumerate(some):
        tasted.paste(one, (0, i * height))
    colours = tasted.quantize(COLOURS, method=Image.Quantize.MEDIANCUT)
    return [one.quantize(palette=colours, dither=Image.Dither.NONE) for one in pictures]
