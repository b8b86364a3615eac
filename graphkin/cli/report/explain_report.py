"""The text and JSON of explain: the effects included, the reasons, their steps and times."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from graphkin.cli.report.catalogue import ask_words
from graphkin.cli.report.solution_record import heading
from graphkin.cli.report.waits import Waits, time_record, waits_lines, waits_of, waits_record
from graphkin.construction.core.program import Target
from graphkin.construction.core.timing import Stopwatch, Timing
from graphkin.diagnosis.effects import EFFECTS, EffectRow, effects, measured
from graphkin.scene.model import Scene
from graphkin.text.errors import ClosureError
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
