"""What is seen of a scene's text at once: mistakes in place, keys, sliders, drawings, numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache
from typing import Any

from msgspec import Struct, field, to_builtins

from graphkin.construction.core.solution import FAIR, Verdict
from graphkin.documents.scaling import sheet_motion
from graphkin.documents.sheet_documents import drawings_of, language_of, lost
from graphkin.loops.witness import sure_of
from graphkin.mechanism import Mechanism
from graphkin.scene.model import DRIVEN, JOINED, KEYWORDS, Scene
from graphkin.scene.read_scene import known_keys, read_text
from graphkin.scene.toml_spans import Span, spans
from graphkin.studio.mends import units
from graphkin.studio.panels import Memory, panels, style
from graphkin.studio.problem_places import MarkedProblem, marked
from graphkin.studio.result_panel import margins, results, verdict_words
from graphkin.studio.sliders import sliders
from graphkin.text import Words, words
from graphkin.text.errors import GraphkinError, Problem, Setting, Sought
from graphkin.text.markup import as_text
from graphkin.text.problems import spoken

LINES = "\n"
EVERY = f"""
[parameters.n]
[frame]
O = {{ from = 0 }}
[links.1]
A = [0, 0]
P = {{ from = 0 }}
{LINES.join(f"{key} = {{}}" for key in JOINED)}
touches = {{}}
profiles = {{ about = "A" }}
cam = {{ law = [{{}}] }}
[links.2]
O-B = 1
cam = {{ tip = "roller", conjugate = {{}} }}
{LINES.join(f"[[drivers]]{LINES}{kind} = 1" for kind in DRIVEN)}
[branches]
[ask]
[sheet]
[titles]
[names]
[notes]
"""
"""A table of each kind: the reader tells its keys also where a text has none of the kind yet."""


@lru_cache(maxsize=1)
def every_key() -> dict[str, list[str]]:
    """The keys of a table of each kind."""
    return known_keys(EVERY, "every")


class EditingHelp(Struct, frozen=True):
    """``keys`` are those that the reader knows, by the place of their table; ``points``, ``links``
    and ``parameters`` are the names that the text gives, ``spots`` where each stands, that of a bar
    AB at its key A-B: its start and end as a browser counts them.
    """

    keys: dict[str, list[str]]
    points: list[str]
    links: list[str]
    parameters: list[str]
    spots: dict[str, tuple[int, int]]


def editing_help(text: str, name: str) -> EditingHelp:
    """The help of a text, as far as it can be read."""
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
    """What is to be looked at: a text, the values of its sliders, and how it is shown.

    ``mechanism`` is the plan whose construction stands on the mechanism, ``quick`` lets labels
    ride, ``language`` is the page's.
    """

    text: str
    name: str
    language: str
    settings: Mapping[str, str] = field(default_factory=dict)
    mechanism: str = "velocity"
    quick: bool = False


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
        found["title"] = scene.titles.get(sight.language, scene.title)
        mechanism = memory.mechanism(scene, sight.text)
        found |= drawn(mechanism, sight, memory, found["problems"], go_on)
    except GraphkinError as error:
        found["problems"] += error.problems
    found["problems"] = told_in(found["problems"], sight.text, sight.language)
    return found


def read(sight: Sight) -> Scene:
    """The scene of a text; values of sliders that it has no longer are dropped."""
    found = spans(sight.text) if sight.settings else {}
    own = {name: set_ for name, set_ in sight.settings.items() if ("parameters", name) in found}
    return read_text(sight.text, sight.name, None, own)


def drawn(
    mechanism: Mechanism,
    sight: Sight,
    memory: Memory,
    problems: list[Problem],
    go_on: Callable[[], None],
) -> dict[str, Any]:
    """Drawings, results, margins and the verdict; what is doubtful is drawn and said."""
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
    """Why no sheet would be handed out of a drawing that can be shown all the same."""
    found = [lost(verdict)] if verdict.unsure else []
    if margin >= FAIR:
        return found
    flattest = f"the flattest crossing has a sine of {margin:.1e}"
    hint = "the position is nearly singular: choose another driver angle"
    return [
        Problem("position", flattest, f"at least {FAIR:g}", hint, about=(Sought(),)),
        *found,
    ]


def told_in(problems: Iterable[Problem], text: str, language: str) -> list[dict[str, Any]]:
    """Problems of a text as records, in the language of the page and the order of the text."""
    return [told(mark, language) for mark in marked(problems, text)]


def told(mark: MarkedProblem, language: str) -> dict[str, Any]:
    """A problem as a record, with its line and what to select; the setting it is about, if any."""
    said = spoken(mark.problem, language)
    setting = next((each.name for each in mark.problem.about if isinstance(each, Setting)), "")
    return {
        "place": said.place,
        "found": said.found,
        "expected": said.expected,
        "hint": str(said.hint),
        "mends": [to_builtins(mend) for mend in mark.mends],
        "line": mark.line,
        "column": mark.column,
        "start": mark.start,
        "end": mark.end,
        "setting": setting,
    }


def spoken_in(language: str) -> Words:
    """The words of the page; English where a scene names a language that is not there."""
    try:
        return words(language)
    except KeyError:
        return words("en")
