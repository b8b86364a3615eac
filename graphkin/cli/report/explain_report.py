"""The text and JSON of explain: the effects included, the reasons, their steps and times.

Then the time of each task: load, solve, check, page.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import isfinite, isinf
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from graphkin.accuracy.pencil import Pencil, forecast, original
from graphkin.cli.report.catalogue import ask_words
from graphkin.cli.report.solution_record import heading
from graphkin.construction.core.program import Target
from graphkin.construction.core.timing import Stopwatch, Timing
from graphkin.diagnosis.effects import EFFECTS, EffectRow, effects, measured
from graphkin.loops.witness import Check
from graphkin.scene.model import Scene
from graphkin.text.errors import ClosureError, GraphkinError
from graphkin.text.tables import listed, table

if TYPE_CHECKING:
    from graphkin.mechanism import Mechanism


class Explanation(Struct, frozen=True):
    """The content of explain for a scene.

    ``asked`` and ``everything`` are the numbers of steps and the times of a run for what is asked,
    and for everything that can be asked. ``unmeasured`` says why a time is missing.
    """

    scene: Scene
    rows: tuple[EffectRow, ...]
    asked: tuple[int, Timing | None]
    everything: tuple[int, Timing | None]
    waits: Waits | None = None
    unmeasured: str = ""


def explained(new: Callable[[], Mechanism]) -> Explanation:
    """Count the effects of a mechanism, and time them if its scene can be drawn.

    ``new`` reads the mechanism.
    """
    mechanism = new()
    if (forces := mechanism.scene.forces) is not None and forces.asked:
        mechanism = mechanism.with_forces
    program, asked, scene = mechanism.program, mechanism.asked(), mechanism.scene
    answers = *program.answers, *mechanism.forces_asked()
    less, more = (len(program.needed(targets)) for targets in (asked, answers))
    unmeasured = undrawn(mechanism, answers)
    try:
        wholes = [asked] if unmeasured else [asked, answers]
        rows, (some, *every) = measured(mechanism, Stopwatch(), wholes)
    except ClosureError as error:
        why = str(error.problems[0])
        return Explanation(scene, effects(mechanism), (less, None), (more, None), unmeasured=why)
    everything = more, every[0] if every else None
    return Explanation(scene, rows, (less, some), everything, waits_of(new), unmeasured)


def undrawn(mechanism: Mechanism, targets: Sequence[Target]) -> str:
    """Why some targets cannot be drawn together; empty if they can."""
    try:
        mechanism.trace(targets)
    except ClosureError as error:
        return str(error.problems[0])
    return ""


def explain_lines(found: Explanation) -> Iterator[str]:
    """The table of effects, each in or out, and the sums below it."""
    scene = found.scene
    yield heading(scene)
    yield f"asked: {all_words(scene)}"
    yield ""
    heads = ("effect", "", "steps", "time, µs", "quartiles", "why")
    yield from table(heads, [cells(row) for row in found.rows])
    yield ""
    (steps, asked), (all_steps, everything) = found.asked, found.everything
    if asked is None:
        yield f"{steps} steps give what is asked, {all_steps} would give everything"
        yield f"no time is measured: {found.unmeasured}"
        return
    yield f"{steps} steps give what is asked, in {in_words(asked)}; {share(found.rows)}"
    whole = f"{all_steps} steps would give everything"
    if everything is None:
        yield f"{whole}; no time is measured: {found.unmeasured}"
    else:
        yield f"{whole}, in {in_words(everything)}"
    yield (
        f"time: median of {asked.rounds} rounds of those steps alone on one scene in float64, with "
        "nothing kept; half of the rounds lie between the quartiles"
    )
    if found.waits is not None:
        yield ""
        yield from waits_lines(found.waits)


def all_words(scene: Scene) -> str:
    """What a scene asks for, in words, its forces included."""
    forces, motions = scene.forces, ask_words(scene.ask)
    if forces is None or not forces.asked:
        return motions
    said = [] if motions == "nothing" else [motions]
    said += [f"reactions {listed(forces.reactions)}"] if forces.reactions else []
    return "; ".join([*said, *(["balance"] if forces.balance else [])])


def cells(row: EffectRow) -> tuple[str, ...]:
    """One line of the table."""
    time = row.time
    spread = f"{micro(time.low)} – {micro(time.high)}" if time else ""
    return (
        row.name,
        "in" if row.included else "out",
        f"{row.steps:5d}",
        f"{micro(time.median) if time else '':>8}",
        f"{spread:>15}",
        row.reason,
    )


def micro(seconds: float) -> str:
    """A time in microseconds, with at least two digits."""
    value = seconds * 1e6
    return f"{value:.1f}" if value < 100 else f"{value:.0f}"


def in_words(time: Timing) -> str:
    """A time with its quartiles."""
    return f"{micro(time.median)} µs ({micro(time.low)} – {micro(time.high)})"


def share(rows: Sequence[EffectRow]) -> str:
    """The sum of the effects' times, to compare with a whole run."""
    seconds = sum(row.time.median for row in rows if row.time and row.name in EFFECTS)
    return f"the effects add up to {micro(seconds)} µs, the rest is the run itself"


def explain_record(found: Explanation) -> dict[str, Any]:
    """The explanation as plain data, times in seconds."""
    return {
        "name": found.scene.name,
        "asked": all_words(found.scene),
        "effects": [
            {
                "effect": row.name,
                "in": row.included,
                "steps": row.steps,
                "time": time_record(row.time),
                "why": row.reason,
            }
            for row in found.rows
        ],
        "steps_asked": found.asked[0],
        "time_asked": time_record(found.asked[1]),
        "steps_everything": found.everything[0],
        "time_everything": time_record(found.everything[1]),
        **(waits_record(found.waits) if found.waits is not None else {}),
    }


WAITED_FOR = {
    "load": "the scene read, its construction planned",
    "solve": "what is asked: every step that it needs, with nothing kept",
    "check": "what is asked held against the vector loops, these written and closed anew",
    "page": "all sheets laid out and written as SVG",
}
"""What each time measures."""
USUAL = Stopwatch(rounds=9, patience=0.5, fewest=2)
"""How often each task is run; a page takes long."""


class Waits(Struct, frozen=True):
    """The times that a user waits, those that could be measured.

    ``drawing`` is the largest relative error of an answer read off the sheets, in 95 of 100
    drawings with marks within ``point`` mm. ``digits`` is the number of digits that are sure in
    doubles, for every number that is asked. Both are None if unknown; ``undrawn`` says why there is
    no page.
    """

    times: dict[str, Timing]
    drawing: float | None
    point: float
    digits: int | None
    undrawn: str = ""


def waits_of(new: Callable[[], Mechanism], watch: Stopwatch = USUAL) -> Waits:
    """Measure the times that a user waits for a mechanism; ``new`` reads its scene.

    Raises ClosureError if the mechanism does not close.
    """
    mechanism = new()
    solution = mechanism.solve(asked=True)
    verdict = None
    works: dict[str, Callable[[], object]] = {
        "load": lambda: new().program,
        "solve": lambda: solved_anew(mechanism),
    }
    drawing, undrawn, pencil = None, "", Pencil()
    try:
        verdict = mechanism.witness(solution)
        works["check"] = lambda: Check(mechanism.scene).compare(solution)
        from graphkin.documents.scaling import scales

        works["page"] = lambda: page_of(mechanism)
        page_of(mechanism)
        drawing = unsure_by_hand(mechanism, scales(mechanism), pencil)
    except GraphkinError as error:
        works.pop("page", None)
        undrawn = str(error.problems[0])
    times = watch.times([(work, 1) for work in works.values()])
    digits = min(verdict.digits.values(), default=None) if verdict else None
    return Waits(dict(zip(works, times, strict=True)), drawing, pencil.point, digits, undrawn)


def solved_anew(mechanism: Mechanism) -> object:
    """Solve the requested quantities, without anything kept from earlier drawings."""
    mechanism.drawings.clear()
    return mechanism.solve(asked=True)


def page_of(mechanism: Mechanism) -> list[str]:
    """The sheets with their solution, as SVG."""
    from graphkin.documents.scaling import sheet_motion
    from graphkin.documents.sheet_documents import drawings_of, drawn_sheets, language_of, proved
    from graphkin.writers.svg import write_svg

    verdict = proved(mechanism, sheet_motion(mechanism))
    drawings = drawings_of(mechanism, verdict, language_of(mechanism, None))
    return [write_svg(page) for one in drawn_sheets(drawings, "key") for page in one.pages]


def unsure_by_hand(mechanism: Mechanism, scales: Any, pencil: Pencil) -> float | None:
    """The largest relative error of an answer read off a drawing; None if none is read off.

    The error is infinite if a drawing may not close. Answers that are zero have no such error.
    """
    found = forecast(original(mechanism, scales), pencil).expected
    if any(isinf(each.error) for each in found):
        return float("inf")
    relative = [each.relative for each in found]
    return max((r for r in relative if r is not None and isfinite(r)), default=None)


def waits_lines(found: Waits) -> Iterator[str]:
    """The times as a table, then the accuracy of a lab sheet in one sentence."""
    rows = [
        (name, milli(time.median), f"{milli(time.low)} – {milli(time.high)}", WAITED_FOR[name])
        for name, time in found.times.items()
    ]
    yield from table(("you wait for", "ms", "quartiles", ""), rows)
    most = max(time.rounds for time in found.times.values())
    yield f"medians of up to {most} rounds on one clock, in a program that is running"
    if found.undrawn:
        yield f"no page is drawn: {found.undrawn}"
    yield ""
    yield sheet_words(found)


def sheet_words(found: Waits) -> str:
    """The accuracy of a lab sheet: the error of a drawing, and the number of sure digits."""
    by_hand = f"a drawing with marks within {found.point:g} mm"
    if found.drawing is None:
        drawn = "nothing that is asked is read off a drawing"
    elif isinf(found.drawing):
        drawn = f"{by_hand} may not close"
    else:
        drawn = f"{by_hand} is sure to {100 * found.drawing:.2g} %"
    digits = "no verdict on float64" if found.digits is None else f"{found.digits} digits"
    leaves = digits if found.digits is None else f"float64 leaves {digits}"
    return f"for a lab sheet: {drawn}; {leaves}"


def milli(seconds: float) -> str:
    """A time in milliseconds with three digits."""
    value = seconds * 1e3
    return f"{value:.3g}" if value < 100 else f"{value:.0f}"


def waits_record(found: Waits) -> dict[str, Any]:
    """The times as plain data, in seconds, and the accuracy of a sheet."""
    return {
        "waits": {name: time_record(time) for name, time in found.times.items()},
        "sheet": {
            "drawing": shortened(found.drawing),
            "marks_within_mm": found.point,
            "digits": found.digits,
        },
    }


def shortened(share: float | None) -> float | None:
    """A share with three digits; None if there is none, or no drawing closes."""
    return None if share is None or isinf(share) else float(f"{share:.3g}")


def time_record(time: Timing | None) -> dict[str, float] | None:
    """A time in seconds; None if nothing was run."""
    if time is None:
        return None
    return {"median": time.median, "low": time.low, "high": time.high, "rounds": time.rounds}
