"""The certified digits of solve: the record with proved decimals, and its text.

The record has the structure of the usual one, with strings in place of numbers. An undecided number
is null, and ``undecided`` gives the reason by its path.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from msgspec import Struct, field
from msgspec.structs import replace

from graphkin.accuracy.certified import Balls, Certifier, decimals, precisions
from graphkin.cli.report.solution_record import (
    Record,
    as_given,
    heading,
    motion_of,
    scale_lines,
    verdict_words,
)
from graphkin.construction.core.program import Program, Target
from graphkin.construction.core.quantities import (
    CENTRES,
    CIRCLES,
    OF_SLIDES,
    QUANTITIES,
    Around,
    PointMotion,
    SlideMotion,
    Sort,
    Whose,
    motion_value,
)
from graphkin.construction.core.run import StepFailed
from graphkin.construction.core.solution import Solution, Verdict, gathered
from graphkin.construction.higher_class.closure_solver import closer_of
from graphkin.diagnosis.assembly_failure import not_found, why
from graphkin.documents.centre_tables import motion_of_block, with_pole
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import Kind
from graphkin.numbers.kinds import ball_kind, sound_ball
from graphkin.numbers.plane import Ratio
from graphkin.scene.link_points import ends_of
from graphkin.scene.model import Scene
from graphkin.text.errors import NO_WORDS, message
from graphkin.text.tables import table

FAR = "at infinity, or too far to tell: not decided"
NOWHERE = "none: at infinity, or the link is at rest"
SECTIONS = {"points": "point", "links": "link", "centres": "links", "slides": "block"}
"""The sections of the record with certified digits, and the head of their column of names."""
CALLED = {
    **{each.attribute: (each.words, each.unit) for each in QUANTITIES if each.words},
    "": ("centre of both", "m"),
    **{key: (circle.words, "m") for key, circle in CIRCLES.items()},
    **{
        f"{each.key}.{part}": (f"{each.circle.words}, {part}" if n else each.words, "m")
        for each in CENTRES
        if each.circle
        for n, part in enumerate(each.circle.parts(0j, 0j))
    },
}
"""The words and units of the record's keys."""


def certify(mechanism: Mechanism, found: Record, digits: int, targets: Any = None) -> Record:
    """The record of a float run with ``digits`` proved digits; ``undecided`` lists the others.

    The precision is raised until every number is decided, up to a sensible limit.
    """
    certifier = Certifier.of(mechanism, targets)
    for bits, narrowed in precisions(digits):
        printer = Printer(mechanism.scene, certifier.run(bits, narrowed), digits)
        kind = ball_kind(bits)
        with kind.working():
            record = certified_record(found, printer, kind)
        if not printer.undecided:
            break
    return record | {"digits": digits, "bits": bits, "undecided": printer.undecided}


class Printer(Struct):
    """Prints the numbers of a run in balls, and records the undecided ones by path."""

    scene: Scene
    balls: Balls
    digits: int
    undecided: dict[str, str] = field(default_factory=dict)

    @property
    def targets(self) -> Mapping[Target, int]:
        return self.balls.trace.program.targets

    def real(self, path: str, ball: Any, target: Target) -> str | None:
        """The digits of a number; None if they are not proved, or the number was not found."""
        if ball is None:
            self.lost(path, target)
            return None
        if not sound_ball(ball):
            self.doubted(path, FAR)
            return None
        printed = decimals(ball, self.digits)
        if printed.text is None:
            self.doubted(path, printed.doubt)
        return printed.text

    def pair(self, path: str, ball: Any, target: Target) -> list[str | None] | None:
        """The digits of a point or a vector."""
        if ball is None:
            self.lost(path, target)
            return None
        parts = (("x", ball.real), ("y", ball.imag))
        return [self.real(f"{path}.{axis}", part, target) for axis, part in parts]

    def centre(self, path: str, ratio: Ratio | None, target: Target) -> list[str | None] | None:
        """The digits of a centre; None, without a doubt recorded, only if it is at infinity."""
        if ratio is None:
            self.lost(path, target)
            return None
        if ratio.size == 0:
            return None
        place = place_of(ratio)
        if place is None:
            self.doubted(path, FAR)
            return None
        return self.pair(path, self.balls.narrowed(place, target), target)

    def lost(self, path: str, target: Target) -> None:
        """Record a number that was not found because an earlier step is singular within the ball.

        Without such a step nothing is recorded: the number does not exist in floats either.
        """
        failed = self.balls.failure(target)
        if failed is not None:
            self.doubted(path, singular_words(self.scene, self.balls.trace.program, failed))

    def doubted(self, path: str, words: str) -> None:
        """Record an undecided number, with the reason."""
        self.undecided[path] = words


def place_of(ratio: Ratio) -> Any:
    """The point of a ratio; None if its ball reaches infinity."""
    try:
        place = ratio.start + ratio.shift / ratio.size
    except ZeroDivisionError:
        return None
    return place if sound_ball(place) else None


def singular_words(scene: Scene, program: Program, failed: StepFailed) -> str:
    """Why a step cannot be drawn in balls, in the words used for a step that fails in floats."""
    action, reason = failed.step.action, message("the ball does not tell where")
    crosses = action is not None and action.margin is not None
    if crosses or closer_of(failed.step) is not None:
        reason = why(scene, program, failed)
    problem = not_found(program, failed.number, reason, NO_WORDS)
    return f"singular within the ball: {problem.place}: {problem.found}"


# --- the record ----------------------------------------------------------------------------------


def certified_record(found: Record, printer: Printer, kind: Kind) -> Record:
    """A record with the digits of a run in balls, of that kind, in place of its numbers."""
    solution = completed(printer.scene, gathered(printer.balls.trace, printer.scene.links))
    solution = replace(solution, slides=as_given(printer.scene, solution.slides, kind))
    record = found | {
        "points": {n: point(n, found["points"][n], solution, printer) for n in found["points"]},
        "links": {n: link(n, found["links"][n], solution, printer) for n in found["links"]},
        "slides": {n: slide(n, solution, printer) for n in found["slides"]},
    }
    if "centres" in found:
        record["centres"] = {
            name: printer.centre(f"centres.{name}", solution.centres.get(name), ("centre", name))
            for name in found["centres"]
        }
    return record


def completed(scene: Scene, solution: Solution) -> Solution:
    """The solution with every moving link; a block turns with its guide."""
    links = {
        name: with_pole(solution.links.get(name), motion_of_block(scene, name, solution))
        for name in scene.links
    }
    return replace(solution, links=links)


def point(name: str, entry: Record, solution: Solution, printer: Printer) -> Record:
    """The quantities of a point, those in its entry in floats."""
    motion = motion_of(name, solution) or PointMotion()
    of = name if (next(iter(entry)), name) in printer.targets else ends_of(name)[0]
    return printed("points", name, of, entry, motion, printer)


def link(name: str, entry: Record, solution: Solution, printer: Printer) -> Record:
    """Turning and centres of a link, those in its entry in floats."""
    return printed("links", name, name, entry, solution.links[name], printer)


def printed(
    whose: Whose, name: str, of: str, entry: Record, motion: Any, printer: Printer
) -> Record:
    """The quantities in an entry with their digits; ``of`` names its owner in the program."""
    found = {each.key: each for each in QUANTITIES if each.whose == whose and each.words}
    record: Record = {}
    for key in entry:
        each, path = found[key], f"{whose}.{name}.{key}"
        target, value = (each.target, of), motion_value(motion, each)
        if each.circle is not None:
            record[key] = circle(path, target, each.circle, motion, value, printer)
        else:
            record[key] = PRINTED[each.sort](printer, path, value, target)
    return record


PRINTED: Mapping[Sort, Callable[[Printer, str, Any, Target], Any]] = {
    "number": Printer.real,
    "vector": Printer.pair,
    "place": Printer.pair,
    "centre": Printer.centre,
}
"""How the digits of each sort of quantity are printed."""


def circle(
    path: str, target: Target, around: Around, motion: Any, found: Ratio | None, printer: Printer
) -> Record | None:
    """The circle of a target; None, without a doubt recorded, only if it has no finite radius."""
    ends = getattr(motion, around.start), found
    if ends[0] is None or ends[1] is None:
        printer.lost(path, target)
        return None
    if any(isinstance(end, Ratio) and end.size == 0 for end in ends):
        return None
    first, last = (place_of(end) if isinstance(end, Ratio) else end for end in ends)
    if first is None or last is None:
        printer.doubted(path, FAR)
        return None
    return {
        part: (printer.real if part == "radius" else printer.pair)(f"{path}.{part}", value, target)
        for part, value in around.parts(first, last).items()
    }


def slide(name: str, solution: Solution, printer: Printer) -> Record:
    """Motion of a block along its guide; the vector of a guide that does not turn is 0."""
    motion, record = solution.slides.get(name, SlideMotion()), {}
    for each in OF_SLIDES:
        path, target = f"slides.{name}.{each.attribute}", (each.target, name)
        value, is_vector = motion_value(motion, each), each.sort == "vector"
        if is_vector and value is None and target not in printer.targets:
            value = 0j
        record[each.attribute] = (printer.pair if is_vector else printer.real)(path, value, target)
    return record


# --- the text ------------------------------------------------------------------------------------


def certified_text(scene: Scene, record: Record, verdict: Verdict | None) -> str:
    """Everything in a certified record, a number on each line."""
    parts = [
        [heading(scene)],
        *(numbers_table(record, section) for section in SECTIONS),
        scale_lines(record["scales"]) if "scales" in record else [],
        [certified_words(record), f"witness  {verdict_words(verdict, scene)}"],
    ]
    return "\n\n".join("\n".join(lines) for lines in parts if lines)


def numbers_table(record: Record, section: str) -> list[str]:
    """The numbers of the points, links, slides or centres, each with its quantity and unit."""
    rows, last = [], ""
    for name, entry in record.get(section, {}).items():
        place = f"{section}.{name}"
        values = {place: entry} if section == "centres" else below(place, entry)
        for path, text in leaves(values):
            shown = text if text is not None else record["undecided"].get(path, NOWHERE)
            sign = "" if shown.startswith("-") else " "
            rows.append([name if name != last else "", quantity(path, place), sign + shown])
            last = name
    return table([SECTIONS[section], "", f" {record['digits']} digits"], rows) if rows else []


def below(path: str, entry: Record) -> Record:
    """The parts of an entry by their paths."""
    return {f"{path}.{key}": value for key, value in entry.items()}


def leaves(values: Record) -> Iterator[tuple[str, str | None]]:
    """Every number of an entry with its path; None for a number without digits."""
    for path, value in values.items():
        if isinstance(value, dict):
            yield from leaves(below(path, value))
        elif isinstance(value, list):
            yield from zip((f"{path}.x", f"{path}.y"), value, strict=True)
        else:
            yield path, value


def quantity(path: str, place: str) -> str:
    """The words for a path in an entry, with the unit."""
    *keys, last = path.removeprefix(place).strip(".").split(".")
    axis = [last] if last in ("x", "y") else []
    words, unit = CALLED[".".join(keys if axis else [*keys, last])]
    return f"{' '.join([*filter(None, [words]), *axis])}, {unit}"


def certified_words(record: Record) -> str:
    """How many digits are proved, and with which precision."""
    missing, bits = len(record["undecided"]), record["bits"]
    if not missing:
        return f"digits   every one proved, by balls of {bits} bits"
    return f"digits   every one proved that is printed; {missing} not decided by {bits} bits"
