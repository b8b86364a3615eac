"""The part of a page that moves: the construction as JavaScript, and how each mark follows it.

The program is traced with the driver's place as its input, by the same tracer that serves numpy and
compiled source elsewhere. Scales and fields stay those of the drawn position.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from math import pi
from string import digits
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from graphkin.construction.core.crossings import is_drawn
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import data
from graphkin.construction.core.program import plan_vector
from graphkin.construction.core.quantities import unit_words
from graphkin.construction.tape.emitted import MATH, script_source
from graphkin.construction.tape.traced import UntraceableError, traced_kind
from graphkin.drawing.field import Rect
from graphkin.drawing.marks import CircleMark, Text, style_class
from graphkin.mechanism import Mechanism
from graphkin.motion.driving import TURN, reach_of
from graphkin.numbers.plane import Vector
from graphkin.text import Words
from graphkin.text.errors import GraphkinError, SceneError
from graphkin.web.field_binder import FieldBinder, Record, box_of, half
from graphkin.web.follow import MarkBindings
from graphkin.web.moving_sheet import MovingSheet
from graphkin.web.offline_page import MOVING, MOVING_CLOSED, bundled
from graphkin.web.page_driver import PageDriver, Reach, driven_by, figures
from graphkin.web.tracing import Tracing, TrackedBranch
from graphkin.writers.templates import marked_up

if TYPE_CHECKING:
    from graphkin.web.screen_sheets import ScreenSheet

NO_DRIVER, NO_RANGE, NO_LINE = "moving.no_driver", "moving.no_range", "moving.no_line"
NO_END = "moving.no_end"
"""The keys of the sentences that say why a page does not move.

The reasons: the scene has no driver; the mechanism cannot move from its position; the construction
cannot be traced; or the scene does not say for how long to show a law of time.
"""


class Moving(Struct, frozen=True):
    """JavaScript that moves the marks of a page.

    ``source`` defines ``graphkinMotion``, an object with the driver's name, unit, low, high, start,
    whole, step and sense, the grips, and the functions below. ``data`` is what the script knows of
    the marks; ``tracing`` is the traced construction that it evaluates.

    - ``grips``: the pins of each sheet by which it can be dragged.
    - ``set(x, element, times, sheet, lettering)`` writes the coordinates of all marks, or of the
      marks of one sheet, and returns {ok: false} where the mechanism does not close. ``element``
      finds a mark by its id. ``lettering`` gives the record of each label that leaves its place,
      null for a hidden label. ``times`` magnifies what keeps its size on the screen, for each field
      of each sheet or for one field; it is 1 by default.
    - ``extent(x, sheet, field, times)`` returns the box (x, y, width, height) of a field that must
      be in sight; field 0 is the mechanism, field 1 the plan.
    - ``labels(sheet, field)`` returns the labels of a field with the sides on which they may lie.
    - ``place(id, x)`` returns the position of a circle.
    - ``values(x)`` are in SI by the names of the rows of the tables.
    - ``margins(x)`` are the sines of crossings by step.
    """

    source: str
    driven: PageDriver
    reach: Reach
    data: dict[str, Any]
    tracing: Tracing


def moving(
    mechanism: Mechanism, sheets: Sequence[ScreenSheet], number: int | None = None
) -> Moving | None:
    """The script with which the marks of some sheets follow driver ``number`` of several.

    None where ``still`` says why they cannot move.
    """
    try:
        driven = driven_by(mechanism.scene, figures(mechanism), number)
        return None if driven is None else put_together(Tracing(mechanism, driven), sheets)
    except (GraphkinError, UntraceableError):
        return None


def still(mechanism: Mechanism) -> str | None:
    """The key of the sentence that says why a mechanism cannot move; None if it moves."""
    targets = [target for target in mechanism.program.targets if target[0] == "position"]
    try:
        driven = driven_by(mechanism.scene)
        if driven is None:
            return NO_DRIVER
        tracing = Tracing(mechanism, driven)
        trace = tracing.traced(mechanism.trace(targets))
        closed = tracing.closed(trace, reach_of(mechanism.scene))
        return None if tracing.reached(closed) else NO_RANGE
    except UntraceableError:
        return NO_LINE
    except SceneError:
        return NO_END
    except GraphkinError:
        return NO_RANGE


def put_together(tracing: Tracing, sheets: Sequence[ScreenSheet]) -> Moving | None:
    """The moving part of some sheets; None where the mechanism has only a position, not a range."""
    places = [
        MovingSheet(sheet.drawing, tracing.traced(sheet.drawing.trace), tracing.tape)
        for sheet in sheets
    ]
    size = sheets[0].drawing.reach
    closed = tracing.closed(places[0].trace, size)
    found = tracing.reached(closed)
    if found is None:
        return None
    driven, (reach, course) = tracing.driven, found
    rects: list[Rect] = []
    more: dict[str, tuple[str, str, str]] = {}
    led: dict[int, list[int]] = {}
    marks: list[Record] = []
    fields = [
        followed(s, sheet, here, rects, marks, more, led, tracing)
        for s, (sheet, here) in enumerate(zip(sheets, places, strict=True))
    ]
    both = list(enumerate(zip(sheets, places, strict=True)))
    knows = {
        "name": driven.name,
        "unit": driven.unit,
        "low": reach.low,
        "high": reach.high,
        "start": driven.start,
        "whole": reach.whole,
        "step": reach.step,
        "sense": driven.sense,
        "inputs": len(tracing.inputs),
        "closed": closed,
        "marks": marks,
        "more": more,
        "led": led,
        "grips": [list(grips(s, sheet, here, driven)) for s, (sheet, here) in both],
        "figures": list(figures_of(tracing, sheets[0].drawing)),
        "drawn_at": driver_output(tracing),
        "derived": list(derived(tracing, sheets[0].drawing)),
        "rects": rects,
        "fields": fields,
        "values": list(read_outs(places)),
        "margins": list(crossings(tracing, sheets[0])),
        "reach": size,
    }
    knows |= {"size": len(tracing.tape.outputs), "course": way_through(course, tracing, reach)}
    knows["turned"] = list(turned_through(tracing))
    return Moving(source(knows, tracing), driven, reach, knows, tracing)


def followed(
    s: int,
    sheet: ScreenSheet,
    places: MovingSheet,
    rects: list[Rect],
    records: list[Record],
    more: dict[str, tuple[str, str, str]],
    led: dict[int, list[int]],
    tracing: Tracing,
) -> list[dict[str, Any]]:
    """The data of both fields of a sheet: what must be in sight, and the labels.

    ``records`` collects the records of the sheet's marks, each with the id of its mark. ``more``
    collects the marks that the page itself creates: by id, the preceding mark, element and class.
    ``led`` collects, by a label's record, the records of the leader and the circle that go with it.

    Each field has the index of its first record, its room, and the box of the marks that do not
    move. ``reach`` gives by record how far a mark reaches across and down from its place. ``seen``
    lists the records of marks that must be in sight. ``labels`` lists the records of labels, large
    ones first, then in the order of their steps, with a number from ``MarkBindings.sides``.
    ``off`` lists the records of labels kept off a point.
    """
    angles, first = tracing.driven.angles(tracing.x, tracing.known), 0
    fields = ((sheet.left, sheet.layout.mechanism), (sheet.right, sheet.layout.plan))
    found = []
    for marks, field in fields:
        binder = FieldBinder(places, field, rects)
        following = MarkBindings(binder, sheet.layout, marks, angles)
        still, seen, off, began = set(marks), [], [], len(records)
        reach: dict[int, tuple[float, float]] = {}
        labels: list[tuple[float, int, tuple[int, int]]] = []
        bound: dict[int, int] = {}
        for k, record in following.records():
            mark = marks[k]
            still.discard(mark)
            if in_sight := following.in_sight(mark, record):
                seen.append(len(records))
            if following.keeps_off(k, record):
                off.append(len(records))
            if (in_sight or isinstance(mark, Text)) and any(size := half(mark)):
                reach[len(records)] = size
            if record[0] in "tb" and isinstance(mark, Text):
                own = len(records), following.sides(k, record)
                labels.append((-mark.height, -1 if mark.step is None else mark.step, own))
                if with_it := following.going_before(k, bound):
                    led[len(records)] = with_it
            bound[k] = len(records)
            records.append([f"m{s}-{first + k}", *record])
        for k, element, cls, record in following.more():
            before = f"m{s}-{first + k}"
            more[f"{before}h"] = (before, element, cls)
            records.append([f"{before}h", *record])
        found.append({"first": began, "room": binder.room, "still": box_of(still), "seen": seen})
        found[-1] |= {"reach": reach, "off": off, "labels": [own for *_, own in sorted(labels)]}
        first += len(marks)
    return found


def grips(
    s: int, sheet: ScreenSheet, places: MovingSheet, driven: PageDriver
) -> Iterator[tuple[str, str, bool, int]]:
    """The pins that can be dragged on a sheet: id, name, whether driven, and figure.

    The figure is -1 for the driver itself or the time.
    """
    own = points_led(places, driven)
    for k, mark in enumerate(sheet.left):
        if isinstance(mark, CircleMark) and style_class(mark) in ("pin", "point"):
            led = own.get(mark.name, -1)
            if led >= 0 or style_class(mark) == "pin":
                yield f"m{s}-{k}", mark.name, led >= 0 or mark.name in driven.pins, led


def points_led(places: MovingSheet, driven: PageDriver) -> dict[str, int]:
    """The figure that moves each point of the driven links: the last one that the point depends on.

    So a bar at the end of a driven bar follows its own driver.
    """
    graph, found = places.tape.graph, dict[str, int]()
    for number, figure in enumerate(driven.figures):
        link = None if figure.driver is None else driven.scene.link(figure.driver.link)
        for name in link.points if link else ():
            place = places.tape.lifted(places.moving.positions[name])
            if graph.input(figure.name) in graph.needed((place.node, place.imag.node)):
                found[name] = number
    return found


def figures_of(tracing: Tracing, drawing: Drawing) -> Iterator[dict[str, Any]]:
    """The data of each figure for a page: its input, the output that it shows, and its datum."""
    scene, tape, words = tracing.driven.scene, tracing.tape, drawing.words
    given = data(drawing)
    stand_by = frozenset[str]().union(*(driver.position.uses() for driver in scene.drivers))
    for figure in tracing.driven.figures:
        shows = tracing.known[figure.parameter or figure.name]
        datum = next((k for k, one in enumerate(given) if figure.parameter in one.parameters), -1)
        if figure.driver is not None:
            shows = tracing.driven.timed(figure.driver, tracing.x, tracing.known)[0]
            shows = shows / figure.metres
            datum = next(k for k, one in enumerate(given) if one.of is figure.driver.position)
        yield {
            "key": figure.key,
            "name": marked_up(figure.symbol),
            "place": tracing.inputs[figure.name],
            "start": figure.start,
            "low": figure.low,
            "high": figure.high,
            "step": figure.step,
            "unit": printed_unit(figure.unit, words),
            "shows": tape.number(shows),
            "datum": datum,
            "moves": -1 if figure.driver else int(figure.parameter in stand_by),
        }


def derived(tracing: Tracing, drawing: Drawing) -> Iterator[list[Any]]:
    """The data that depend on figures: index, markup of the name, output, and unit."""
    names = {figure.parameter for figure in tracing.driven.figures if figure.parameter}
    kind, words = traced_kind(), drawing.words
    for k, one in enumerate(data(drawing)):
        if one.of is not None and names & one.of.uses():
            number = tracing.tape.number(one.of.number(tracing.known, kind))
            yield [k, marked_up(one.name), number, printed_unit(one.of.unit, words)]


def driver_output(tracing: Tracing) -> int:
    """The output for the driver's position as a function of the parameters; -1 without one."""
    driven = tracing.driven
    if driven.driver is None or not driven.figures:
        return -1
    place = driven.driver.position.si(tracing.known, traced_kind())
    return tracing.tape.number(place * (180 / pi if driven.what == "turn" else 1 / driven.metres))


def printed_unit(unit: str, words: Words) -> str:
    """A unit as printed after its number."""
    printed = unit_words(words, unit)
    return f" {printed}" if printed and printed != "°" else printed


def read_outs(places: Sequence[MovingSheet]) -> Iterator[tuple[str, int, str, int]]:
    """Name, sheet, kind and output of each number of the tables; vectors by their length in SI.

    Sliding speeds are named ``slide 5``, sliding accelerations ``slide acceleration 5``.
    """
    for s, place in enumerate(places):
        drawing, tape = place.drawing, place.tape
        for number, step, value in drawing.steps(drawing.plane):
            vector = plan_vector(step)
            if vector is not None and isinstance(value, Vector):
                moving = place.values[number]
                size = abs(tape.lifted(moving.tip - moving.tail))
                yield vector.symbol, s, drawing.kind, tape.number(size)
        rate = drawing.rate
        for link in drawing.scene.links:
            value = place.trace.value(rate.target, link)
            if value is not None:
                yield f"{rate.letter}{link}", s, rate.target, tape.number(value)
        what = drawing.sliding.target
        name = "slide" if drawing.kind == "velocity" else what
        for block in drawing.scene.ask.slides:
            value = place.trace.value(what, block)
            if value is not None:
                yield f"{name} {block}", s, what, tape.number(value)


def crossings(tracing: Tracing, sheet: ScreenSheet) -> Iterator[tuple[int, int]]:
    """The sines of the intersections drawn on paper, by step."""
    steps = sheet.drawing.trace.program.steps
    for number, sine in sorted(tracing.margins.items()):
        if is_drawn(steps[number], float(tracing.tape.now(sine))):
            yield number, tracing.tape.number(sine)


# --- JavaScript ----------------------------------------------------------------------------------


def source(data: dict[str, Any], tracing: Tracing) -> str:
    """The construction, the data, and the code that places the marks, in one expression."""
    written = data | {"marks": list(short_ids(data["marks"]))}
    text = json.dumps(written, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")
    lines = [
        "const graphkinMotion = (() => {",
        '"use strict";',
        MATH,
        script_source(tracing.graph, tracing.tape.outputs, tracing.inputs, "run"),
        *misses(tracing),
        bundled(MOVING_CLOSED if tracing.closings else MOVING),
        f"const data = {text};",
        f"return graphkinMoving(data, run{', closings' if tracing.closings else ''});",
        "})();",
    ]
    return "\n".join(lines) + "\n"


def short_ids(records: Sequence[Record]) -> Iterator[Record]:
    """Records of marks; of ids with the letters of the one before, only the number remains."""
    letters = ""
    for name, *rest in records:
        own = name.rstrip(digits)
        number = name.removeprefix(own)
        yield [int(number) if own == letters and number else name, *rest]
        letters = own


def misses(tracing: Tracing) -> Iterator[str]:
    """The misclosure of each group that the page closes anew, as functions."""
    names = [f"miss{i}" for i, _ in enumerate(tracing.closings)]
    for name, each in zip(names, tracing.closings, strict=True):
        yield script_source(tracing.graph, each.outputs, tracing.inputs, name)
    if names:
        yield f"const closings = [{','.join(names)}];"


def turned_through(tracing: Tracing) -> Iterator[dict[str, Any]]:
    """The angle (degrees) near which each link counts its turns, by place of the driver."""
    for name, link in tracing.counting.items():
        assert tracing.turned is not None
        near = tracing.turned.near[link].tolist()
        yield {"place": tracing.inputs[name], "at": tracing.turned.at.tolist(), "near": near}


def way_through(course: TrackedBranch, tracing: Tracing, reach: Reach) -> dict[str, Any]:
    """The course of groups of higher class through the range, as data for a page.

    The page closes the groups anew near these values, so that few digits suffice.
    """
    places = [tracing.inputs[each.names[0]] for each in tracing.closings]
    sizes = [each.sizes if each.count > 1 else each.size for each in tracing.closings]
    turn = TURN if reach.whole else 0
    return {
        "at": course.at,
        "states": [[float(f"{number:.6g}") for number in state] for state in course.states],
        "places": places,
        "sizes": sizes,
        "turn": turn,
    }
