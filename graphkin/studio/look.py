"""The immediate view of a scene's text: mistakes in place, keys, sliders, drawings, numbers."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from math import ceil, floor, log10
from typing import Any

from msgspec import Struct, field, to_builtins

from graphkin.classroom.lab.lab_model import exact_text
from graphkin.construction.core.given_data import unit_of
from graphkin.construction.core.solution import FAIR, Verdict
from graphkin.documents.scaling import sheet_motion
from graphkin.documents.sheet_documents import drawings_of, language_of, lost
from graphkin.loops.differences import sure_of
from graphkin.mechanism import Mechanism
from graphkin.scene.expression import TIME
from graphkin.scene.house import PLAIN, house_beside
from graphkin.scene.model import DRIVEN, JOINED, KEYWORDS, Parameter, Scene
from graphkin.scene.parameters import plain
from graphkin.scene.quantity import Quantity
from graphkin.scene.read_scene import known_keys, read_text
from graphkin.scene.toml_spans import Path, Span, parts, spans
from graphkin.studio.mends import Edit, mends_of, units
from graphkin.studio.panels import Memory, margins, panels, results, style, verdict_words
from graphkin.text import Words, as_text, words
from graphkin.text.errors import GraphkinError, InLine, Problem, Setting, Sought, message
from graphkin.text.paths import within
from graphkin.text.problems import spoken

MOST = 1000
"""Largest number of stops of a slider; a scene with more values gets some of them."""
FINE = 200
"""Approximate number of stops of a slider without a step in the scene."""
HALF = Fraction(1, 2)
"""Range of a slider without a bound to each side, in parts of its value."""


class ParameterSlider(Struct, frozen=True):
    """A parameter: its value as set, the stops of its slider, and the index of the nearest stop.

    ``low`` and ``high`` are the bounds that the scene states, or empty.
    """

    name: str
    value: str
    unit: str
    stops: tuple[str, ...]
    index: int
    low: str
    high: str


def sliders(scene: Scene) -> Iterator[ParameterSlider]:
    """A slider for each parameter, in the order of the scene."""
    for name, parameter in scene.parameters.items():
        if name != TIME:
            yield slider(scene, parameter)


def slider(scene: Scene, parameter: Parameter) -> ParameterSlider:
    """The slider of one parameter at its current value."""
    value = Fraction(str(scene.values[parameter.name]))
    low, high = ends(parameter, value)
    step = plain(parameter.step) if parameter.step else None
    places, names = stops(plain(parameter.minimum or parameter.value), low, high, step)
    return ParameterSlider(
        parameter.name,
        exact_text(value),
        unit_of(scene, parameter.name),
        names,
        nearest(places, value),
        bound(parameter.minimum),
        bound(parameter.maximum),
    )


def bound(quantity: Quantity | None) -> str:
    """A bound as it is shown."""
    return "" if quantity is None else exact_text(plain(quantity))


def nearest(places: Sequence[Fraction], value: Fraction) -> int:
    """The index of the place nearest to a value; the lower of two equally near."""
    after = bisect_left(places, value)
    beside = [i for i in (after - 1, after) if 0 <= i < len(places)]
    return min(beside, key=lambda i: abs(places[i] - value))


def ends(parameter: Parameter, value: Fraction) -> tuple[Fraction, Fraction]:
    """The range of a slider: the bounds, or a range around its own value where there are none."""
    own = plain(parameter.value)
    least = plain(parameter.minimum) if parameter.minimum else None
    most = plain(parameter.maximum) if parameter.maximum else None
    span = abs(own) * HALF or Fraction(1)
    low = least if least is not None else min(own - span, value)
    high = most if most is not None else max(own + span, value)
    return low, high


@lru_cache(maxsize=256)
def stops(
    start: Fraction, low: Fraction, high: Fraction, step: Fraction | None
) -> tuple[Sequence[Fraction], tuple[str, ...]]:
    """The stops of a slider and their texts; they do not change while the slider moves.

    They lie on the steps from ``start``. Without steps they are round values, with both ends
    included.
    """
    stride, begin = (fine(high - low), Fraction(0)) if step is None else (step, start)
    first, last = ceil((low - begin) / stride), floor((high - begin) / stride)
    each = max(1, ceil(Fraction(last - first, MOST)))
    found = [begin + stride * k for k in range(first, last + 1, each)]
    places = sorted({low, *found, high}) if step is None else found or [start]
    return places, tuple(map(exact_text, places))


def fine(span: Fraction) -> Fraction:
    """A round step, 1, 2 or 5 times a power of ten, that divides a span into at most FINE steps."""
    if not span:
        return Fraction(1)
    power = Fraction(10) ** floor(log10(span / FINE))
    return next(step for m in (1, 2, 5, 10) if (step := m * power) * FINE >= span)


# --- from the place of a problem to the line and key of the text ----------------------------------


SOLID = ("frame", "links")
"""The tables whose keys hold points."""
VERSION = ("graphkin",)
DRIVERS = ("drivers",)


class MarkedProblem(Struct, frozen=True):
    """A problem with its place: its line from 1 (0 without a place), and the piece to select.

    ``start`` and ``end`` count UTF-16 units, as a browser does. ``column``, from 1, is where the
    text fails to be TOML. ``mends`` are edits, each of which would correct the problem.
    """

    problem: Problem
    line: int = 0
    start: int = 0
    end: int = 0
    column: int = 0
    mends: tuple[Edit, ...] = ()


def marked(problems: Iterable[Problem], text: str) -> list[MarkedProblem]:
    """Each problem with its place in the text, in the order of the text."""
    wrong = list(problems)
    found = spans(text) if wrong else {}
    marks = [mark_of(problem, text, span_of(problem, text, found)) for problem in wrong]
    return sorted(marks, key=lambda mark: (mark.line == 0, mark.start))


def mark_of(problem: Problem, text: str, span: Span | None) -> MarkedProblem:
    """A problem at a span, cut to its first line."""
    mends = tuple(mends_of(problem, text, span))
    if span is None:
        return MarkedProblem(problem, mends=mends)
    start, end = span
    stop = text.find("\n", start)
    end = min(end, len(text) if stop < 0 else stop)
    line = text.count("\n", 0, start) + 1
    place = line_of(problem)
    column = place.column if place else 0
    return MarkedProblem(problem, line, units(text[:start]), units(text[:end]), column, mends)


def span_of(problem: Problem, text: str, found: Mapping[Path, Span]) -> Span | None:
    """The piece of the text that a problem is about, or the nearest heading."""
    if place := line_of(problem):
        return span_of_line(text, place)
    if not problem.place:
        return found.get(VERSION, Span(0, 0))
    for path in paths(problem, found):
        for length in range(len(path), 0, -1):
            span = found.get(path[:length]) or found.get((*path[: length - 1], f"{path[-1]}s"))
            span = span or pinned(path[:length], found)
            if span is not None:
                return span
    return None


def line_of(problem: Problem) -> InLine | None:
    """The line that a problem is about, if any."""
    return next((each for each in problem.about if isinstance(each, InLine)), None)


def paths(problem: Problem, found: Mapping[Path, Span]) -> Iterator[Path]:
    """The paths that a problem may mean, the most likely first.

    A missing pin is a point of one link only; of lengths that form no triangle the longest is
    meant. A position that cannot be found by drawing depends on a branch, or on a length, or on the
    drivers.
    """
    for about in problem.about:
        match about:
            case Setting(name=name):
                yield "parameters", name
            case Sought(names=names):
                tried = [(table, name) for name in names for table in ("branches", "links")]
                yield from (path for path in tried if path in found)
                yield from (path for name in names for path in holding(name, found))
                yield DRIVERS
            case tuple() if about in found or pinned(about, found):
                yield about
    path = tuple(parts(problem.place))
    yield path
    if path[0] == "branches":
        yield from holding(str(path[-1]), found)


def pinned(path: Path, found: Mapping[Path, Span]) -> Span | None:
    """The first key of a link, or of the frame, that holds a point: ``A-B`` holds ``B``."""
    if len(path) < 2 or path[0] not in SOLID:
        return None
    table = path[:-1]
    keys = (key for key in found if key[:-1] == table and path[-1] in str(key[-1]).split("-"))
    return next((found[key] for key in keys), None)


def holding(point: str, found: Mapping[Path, Span]) -> Iterator[Path]:
    """The keys of links that hold a point and another point: the lengths that place it."""
    for path in found:
        names = str(path[-1]).split("-")
        if path[0] == "links" and len(path) == 3 and len(names) > 1 and point in names:
            yield path


def span_of_line(text: str, place: InLine) -> Span:
    """A line without the blanks around it, from the character at which it fails to be TOML."""
    lines = text.split("\n")
    number, column = min(place.line, len(lines)), place.column - 1
    start = sum(len(line) + 1 for line in lines[: number - 1])
    line = lines[number - 1]
    first, last = len(line) - len(line.lstrip()), len(line.rstrip())
    heading = line.lstrip().startswith("[")
    if first < column < last and line[column] != "#" and not heading:
        first = column
    return Span(start + first, start + last)


# --- the immediate view of a scene's text ---------------------------------------------------------


LINES = "\n"
EVERY = f"""
[parameters.n]
[frame]
O = {{ from = 0 }}
[links.1]
A = [0, 0]
mass = 1
P = {{ from = 0 }}
{LINES.join(f"{key} = {{}}" for key in JOINED)}
touches = {{}}
profiles = {{ about = "A" }}
cam = {{ law = [{{}}] }}
[links.2]
O-B = 1
cam = {{ tip = "roller", conjugate = {{}} }}
{LINES.join(f"[[drivers]]{LINES}{kind} = 1" for kind in DRIVEN)}
[[loads]]
at = "A"
link = 1
force = {{}}
[[springs]]
[branches]
[ask]
[sheet]
[titles]
[names]
[notes]
"""
"""A scene with every kind of table, which gives the reader's keys for tables a text lacks."""


@lru_cache(maxsize=1)
def every_key() -> dict[str, list[str]]:
    """The keys of every kind of table."""
    return known_keys(EVERY, "every")


class EditingHelp(Struct, frozen=True):
    """Names for completion and their places in the text.

    ``keys`` are the reader's keys by the place of their table. ``points``, ``links`` and
    ``parameters`` are the names in the text. ``spots`` are the start and end of each name, as a
    browser counts them; a bar AB has the spot of its key A-B.
    """

    keys: dict[str, list[str]]
    points: list[str]
    links: list[str]
    parameters: list[str]
    spots: dict[str, tuple[int, int]]


def editing_help(text: str, name: str) -> EditingHelp:
    """The names and keys of a text, as far as it can be read."""
    found = spans(text)
    points, links, parameters = dict[str, Span](), dict[str, Span](), dict[str, Span]()
    bars: dict[str, Span] = {}
    for path, span in found.items():
        match path:
            case ("links", str(link)):
                links.setdefault(link, span)
            case ("parameters", str(parameter)):
                parameters.setdefault(parameter, span)
            case ("frame", str(key)) | ("links", str(_), str(key)) if key not in KEYWORDS:
                ends = key.split("-")
                for point in ends:
                    points.setdefault(point, span)
                bars.setdefault("".join(ends), span)
    every = {**parameters, **bars, **links, **points}
    spots = {each: (units(text[: at.start]), units(text[: at.end])) for each, at in every.items()}
    known = every_key() | known_keys(text, name)
    keys = {place: list(dict.fromkeys(own)) for place, own in known.items()}
    return EditingHelp(keys, [*points], [*links], [*parameters], spots)


class Sight(Struct, frozen=True):
    """A view of a text: the text, the values of its sliders, and the way to show it.

    ``mechanism`` is the plan whose construction is shown on the mechanism. ``quick`` lets labels
    keep their offsets. ``language`` is the language of the page. ``folder`` may hold a house.toml.
    """

    text: str
    name: str
    language: str
    settings: Mapping[str, str] = field(default_factory=dict)
    mechanism: str = "velocity"
    quick: bool = False
    folder: str = ""


def look(sight: Sight, memory: Memory, go_on: Callable[[], None]) -> dict[str, Any]:
    """Everything that the page shows of a text, as plain records for JSON.

    ``go_on`` is called before each longer part, and may raise to end the work.
    """
    found: dict[str, Any] = {"problems": [], "sliders": []}
    if not sight.quick:
        found["help"] = to_builtins(editing_help(sight.text, sight.name), enc_hook=as_text)
    try:
        scene = read(sight)
        found["sliders"] = [to_builtins(each, enc_hook=as_text) for each in sliders(scene)]
        found["title"] = scene.title_in(sight.language)
        measured = scene.computed_in(scene.unit_of_results)
        mechanism = memory.mechanism(measured, sight.text)
        found |= drawn(mechanism, sight, memory, found["problems"], go_on)
    except GraphkinError as error:
        found["problems"] += error.problems
    found["problems"] = problem_records(found["problems"], sight.text, sight.language)
    return found


def read(sight: Sight) -> Scene:
    """The scene of a text; values of sliders that no longer exist are dropped."""
    found = spans(sight.text) if sight.settings else {}
    own = {name: set_ for name, set_ in sight.settings.items() if ("parameters", name) in found}
    house = house_beside(within(sight.folder, sight.name)) if sight.folder else PLAIN
    return read_text(sight.text, sight.name, None, own, house)


def drawn(
    mechanism: Mechanism,
    sight: Sight,
    memory: Memory,
    problems: list[Problem],
    go_on: Callable[[], None],
) -> dict[str, Any]:
    """Drawings, results, margins and the verdict; doubtful results are drawn with a note."""
    spoken = language_of(mechanism, sight.language)
    solution = sheet_motion(mechanism)
    verdict = mechanism.witness(solution, numbered=not sight.quick)
    problems += doubts(solution.margin, verdict)
    held = memory.held(sight.text) if sight.quick else None
    drawings = drawings_of(mechanism, verdict, spoken, held)
    pictures = []
    for panel, unplaced in panels(drawings, sight.text, sight.mechanism, memory, quick=sight.quick):
        pictures.append(panel)
        problems += unplaced
        go_on()
    return {
        "kinds": [drawing.kind for drawing in drawings],
        "panels": [{"name": p.name, "caption": p.caption, "svg": p.svg} for p in pictures],
        "style": style(pictures),
        "results": results(drawings, sure_of(solution, dict.fromkeys(verdict.unsure, True))),
        "margins": margins(drawings),
        "verdict": {
            "agrees": verdict.agrees,
            "words": verdict_words(verdict, mechanism.scene, spoken),
        },
    }


def doubts(margin: float, verdict: Verdict) -> list[Problem]:
    """The reasons why no sheet would be handed out of a drawing that can still be shown."""
    found = [lost(verdict)] if verdict.unsure else []
    if margin >= FAIR:
        return found
    flattest = message("the flattest crossing has a sine of {margin:.1e}", margin=margin)
    hint = message("the position is nearly singular: choose another driver angle")
    return [
        Problem(
            "position", flattest, message("at least {least:g}", least=FAIR), hint, about=(Sought(),)
        ),
        *found,
    ]


def problem_records(problems: Iterable[Problem], text: str, language: str) -> list[dict[str, Any]]:
    """Problems of a text as records, in the language of the page and the order of the text."""
    return [problem_record(mark, language) for mark in marked(problems, text)]


def problem_record(mark: MarkedProblem, language: str) -> dict[str, Any]:
    """A problem as a record: its words, its line, the piece to select, and its setting if any."""
    problem = mark.problem
    setting = next((each.name for each in problem.about if isinstance(each, Setting)), "")
    return {
        "place": spoken(problem.place, language),
        "found": spoken(problem.found, language),
        "expected": spoken(problem.expected, language),
        "hint": spoken(problem.help, language),
        "mends": [to_builtins(mend) for mend in mark.mends],
        "line": mark.line,
        "column": mark.column,
        "start": mark.start,
        "end": mark.end,
        "setting": setting,
    }


def spoken_in(language: str) -> Words:
    """The words of the page; English where the language is unknown."""
    try:
        return words(language)
    except KeyError:
        return words("en")
