"""From the place that a problem names to the line and the key of the text that it is about."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from msgspec import Struct

from graphkin.scene.toml_spans import Path, Span, parts, spans
from graphkin.studio.mends import Edit, mends_of, units
from graphkin.text.errors import InLine, Problem, Setting, Sought

SOLID = ("frame", "links")
"""The tables whose keys hold points."""
VERSION = ("graphkin",)
DRIVERS = ("drivers",)


class MarkedProblem(Struct, frozen=True):
    """A problem with where it stands: its line from 1, 0 where it has none, and what to select.

    ``start`` and ``end`` count as a browser does, a sign beyond the basic plane as two. ``column``,
    from 1, is where the text fails to be TOML. ``mends`` are changes of which each would mend it.
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
    told = line_of(problem)
    column = told.column if told else 0
    return MarkedProblem(problem, line, units(text[:start]), units(text[:end]), column, mends)


def span_of(problem: Problem, text: str, found: Mapping[Path, Span]) -> Span | None:
    """What of the text a problem is about; the nearest heading where its key is not written."""
    if told := line_of(problem):
        return span_of_line(text, told)
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
    """The line that a problem is about, if it is about one."""
    return next((each for each in problem.about if isinstance(each, InLine)), None)


def paths(problem: Problem, found: Mapping[Path, Span]) -> Iterator[Path]:
    """The paths that a problem may mean, the likeliest first.

    A pin that is missing is a point that one link alone has; of lengths that make no triangle the
    longest is meant; what cannot be found by drawing is settled by a branch, else by a length
    there, else by where the drivers stand.
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
    """The first key of a link, or of the frame, that holds a point: ``B`` stands in ``A-B``."""
    if len(path) < 2 or path[0] not in SOLID:
        return None
    table = path[:-1]
    keys = (key for key in found if key[:-1] == table and path[-1] in str(key[-1]).split("-"))
    return next((found[key] for key in keys), None)


def holding(point: str, found: Mapping[Path, Span]) -> Iterator[Path]:
    """The keys of links that hold a point and another: the lengths that place it."""
    for path in found:
        names = str(path[-1]).split("-")
        if path[0] == "links" and len(path) == 3 and len(names) > 1 and point in names:
            yield path


def span_of_line(text: str, told: InLine) -> Span:
    """A line without the blanks around it, from the sign at which it fails to be TOML."""
    lines = text.split("\n")
    number, column = min(told.line, len(lines)), told.column - 1
    start = sum(len(line) + 1 for line in lines[: number - 1])
    line = lines[number - 1]
    first, last = len(line) - len(line.lstrip()), len(line.rstrip())
    heading = line.lstrip().startswith("[")
    if first < column < last and line[column] != "#" and not heading:
        first = column
    return Span(start + first, start + last)
