"""The scale factors of a mechanism's sheets, which are the same on all of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce
from typing import Any

from msgspec.structs import replace

from graphkin.construction.core.component import as_drawn, may_give_way
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.program import PLACES, SPEEDS, Target
from graphkin.construction.core.quantities import OMEGA, SHEETS, is_found_on
from graphkin.construction.core.solution import UNPROVED, Curve, Solution, Verdict, gathered
from graphkin.documents.composing import Needs, Search, Stated, searched_scales
from graphkin.drawing.field import paper_of
from graphkin.drawing.scale import Extent, Scales, digits, extent_of, preferred
from graphkin.mechanism import Mechanism
from graphkin.numbers.arithmetic import np
from graphkin.scene.model import Sheet
from graphkin.scene.quantity import LENGTHS, Quantity
from graphkin.text import Words, words
from graphkin.text.errors import Message, PageError, SceneError, message


def targets_of(mechanism: Mechanism, kind: str) -> tuple[Target, ...]:
    """The targets of one sheet, with the whole mechanism; empty where nothing is asked for.

    The motions from which forces follow are drawn, asked for or not.

    Velocities that the acceleration sheet uses are drawn on the first sheet, asked for or not.
    """
    ask = mechanism.scene.ask
    every = dict.fromkeys((*mechanism.asked(), *mechanism.for_forces()))
    asked = [target for target in every if is_found_on(kind, target)]
    if kind == "velocity":
        later = targets_of(mechanism, "acceleration")
        asked += mechanism.program.also_found(later, ("velocity", OMEGA), asked)
    if not asked and not (kind == "velocity" and (ask.curves or ask.centrodes)):
        return ()
    drawn = ("position", *PLACES, *((SPEEDS,) if kind == "velocity" else ()))
    return (*(t for t in mechanism.program.targets if t[0] in drawn), *asked)


def sheet_targets(mechanism: Mechanism) -> dict[str, tuple[Target, ...]]:
    """The targets of each sheet; everything on both where nothing is asked for."""
    asked = {kind: targets_of(mechanism, kind) for kind in SHEETS}
    if not any(asked.values()):
        return dict.fromkeys(SHEETS, tuple(mechanism.program.targets))
    return {kind: found for kind, found in asked.items() if found}


def sheet_motion(mechanism: Mechanism) -> Solution:
    """The motion that the sheets show: all positions, and otherwise what is asked for."""
    targets = dict.fromkeys(t for kind in SHEETS for t in targets_of(mechanism, kind))
    return gathered(mechanism.trace(targets or None), mechanism.scene.links)


def scales(mechanism: Mechanism, curves: tuple[Curve, ...] | None = None) -> Scales:
    """The one set of scale factors at which every sheet's drawings fit their fields.

    Optional triangles are dropped where they leave no room for a larger mechanism. Raises PageError
    where the factors stated in the scene leave no room for the drawings, or shrink them to nothing.
    """
    if mechanism.scene.base != "m":
        metre = float(LENGTHS[mechanism.scene.base])
        found_in_metres = scales(Mechanism(mechanism.scene.computed_in("m")))
        return replace(found_in_metres, kL=found_in_metres.kL / metre, metre=metre)
    curves = curves_drawn(mechanism) if curves is None else curves
    said = stated(mechanism)
    crank, gives_way = the_crank(mechanism), may_give_way(mechanism.program)
    natural = 0.0 if crank else natural_seconds(mechanism)
    asking = searched_scales(said, crank, natural, may_give_way=gives_way)
    chosen, drafts = found(mechanism, curves, asking)
    if said.keys:
        refuse_dots(chosen, drafts, said.keys)
    return chosen


def curves_drawn(mechanism: Mechanism) -> tuple[Curve, ...]:
    """The curves on the sheets; the code that traces them is loaded only where there are any."""
    ask = mechanism.scene.ask
    if not (ask.centrodes or ask.curves or mechanism.is_of_higher_class):
        return ()
    from graphkin.motion.motion_curves import curves_of

    return curves_of(mechanism)


def stated(mechanism: Mechanism) -> Stated:
    """The scale factors that a scene states. Raises SceneError where no crank can follow them."""
    sheet = mechanism.scene.sheet
    (said,) = stated_of(sheet, mechanism.scene.values, 1)
    if any(said.times.values()) and not the_crank(mechanism):
        key = "enlarge" if sheet.enlarge else "rule"
        found = message("the plans of this mechanism are not drawn by one crank")
        hint = message("leave it out: they are then drawn as large as they fit")
        raise SceneError.at(f"sheet.{key}", found, message("one driver, which turns"), hint)
    return said


def stated_of(sheet: Sheet, values: Mapping[str, Any], count: int, *kind: Any) -> list[Stated]:
    """The scale factors stated by variants, whose parameters are arrays or shared."""

    def numbers(quantity: Quantity | None) -> list[float]:
        value = quantity.number(values, *kind) if quantity is not None else 0.0
        return [float(each) for each in np.broadcast_to(np.asarray(value, dtype=float), count)]

    once = [[1.0 if sheet.rule == "lab" else 0.0] * count]
    times = [numbers(each) for each in sheet.enlarge] or once
    paper = paper_of(sheet.paper, sheet.frame)
    columns = zip(numbers(sheet.scale), numbers(sheet.ka), times[0], times[-1], strict=True)
    return [
        Stated(kL, {SHEETS[0]: m, SHEETS[1]: n}, 1000 * ka, sheet.steps, paper)
        for kL, ka, m, n in columns
    ]


def found(
    mechanism: Mechanism, curves: tuple[Curve, ...], asking: Search
) -> tuple[Scales, list[Drawing]]:
    """The result of a search, which receives the needs of its drafts; and its final drafts."""
    sheets = sheet_targets(mechanism)
    drafted: dict[tuple[float, bool], list[Drawing]] = {}
    draft = next(asking)
    try:
        while True:
            drafts = drafts_of(mechanism, sheets, curves, draft)
            drafted[draft.seconds, draft.triangles] = drafts
            draft = asking.send(needs_of(drafts))
    except StopIteration as end:
        chosen: Scales = end.value
        drafts = drafted[chosen.seconds, chosen.triangles]
        return chosen, [replace(each, scales=replace(chosen, kL=1.0)) for each in drafts]


def needs_of(drafts: list[Drawing]) -> Needs:
    """The boxes of drafts at full size."""
    plans = {draft.kind: draft.plan_extent() for draft in drafts}
    longest = {d.kind: d.largest * d.scales.pace(d.kind) for d in drafts}
    bare, whole = (
        reduce(Extent.joined, boxes)
        for boxes in zip(*((d.bare_extent(), d.mechanism_extent()) for d in drafts), strict=True)
    )
    return Needs(bare, whole, plans, longest)


def drafts_of(
    mechanism: Mechanism,
    sheets: Mapping[str, tuple[Target, ...]],
    curves: tuple[Curve, ...],
    scales: Scales,
) -> list[Drawing]:
    """The drawings of all sheets at full size, with velocities as displacements in a time."""
    return [
        drawing(mechanism, kind, found, replace(scales, kL=1.0), UNPROVED, words("en"), curves)
        for kind, found in sheets.items()
    ]


def the_crank(mechanism: Mechanism) -> float:
    """Speed in rad/s of the only driver if it is a moving crank, otherwise 0."""
    drivers = mechanism.scene.drivers
    if len(drivers) != 1 or drivers[0].kind != "turn":
        return 0.0
    return abs(float(drivers[0].speed.si(mechanism.scene.values)))


def natural_seconds(mechanism: Mechanism) -> float:
    """The time in which vectors are about as large as the mechanism that they are set on."""
    points = sheet_motion(mechanism).points.values()
    places = extent_of([complex(point.position) for point in points if point.position is not None])
    size = max(places.width, places.height) or 1.0  # a single point has none
    fastest = max((abs(point.velocity or 0) for point in points), default=0.0)
    hardest = max((abs(point.acceleration or 0) for point in points), default=0.0)
    slowest = max(fastest / size, (hardest / size) ** 0.5)
    return 1 / slowest if slowest else 1.0


def drawing(
    mechanism: Mechanism,
    kind: str,
    targets: tuple[Target, ...],
    scales: Scales,
    verdict: Verdict,
    spoken: Words,
    curves: tuple[Curve, ...] = (),
) -> Drawing:
    """The drawing of one sheet: everything drawn by hand for it."""
    trace = as_drawn(
        mechanism.trace(targets, by_hand=True, seconds=scales.seconds), triangles=scales.triangles
    )
    on_this = curves if kind == "velocity" else ()
    return Drawing(kind, mechanism.scene, trace, scales, verdict, spoken, curves=on_this)


LEAST = 5.0
"""Length in mm below which the longest vector of a plan is too short to draw."""
LEAST_ACROSS = 15.0
"""Width in mm below which pins and letters hide the bars of a mechanism."""


def refuse_dots(scales: Scales, sheets: Sequence[Drawing], stated: Sequence[str]) -> None:
    """Raise PageError where a stated scale factor shrinks a mechanism or a plan to a dot.

    ``sheets`` are drawn at full size; ``stated`` are the keys that the scene writes. A plan whose
    vectors are all zero is no error.
    """
    across = min(1000 * sheet.reach / scales.kL for sheet in sheets)
    if across < LEAST_ACROSS and "scale" in stated:
        most = scales.kL * across / LEAST_ACROSS
        found = message(
            "at 1:{kL} the mechanism is drawn {across:.2g} mm across",
            kL=digits(scales.kL),
            across=across,
        )
        smaller = message("a smaller scale, {most} or less", most=digits(not_above(most)))
        raise dot("scale", found, smaller, LEAST_ACROSS)
    if across < LEAST_ACROSS and "enlarge" in stated:
        times = digits(scales.of_bar("velocity"))
        found = message(
            "at {times} times the mechanism is drawn {across:.2g} mm across",
            times=times,
            across=across,
        )
        raise dot("enlarge", found, message("a smaller enlarge"), LEAST_ACROSS)
    for sheet in sheets:
        longest = 1000 * abs(sheet.at_scale(sheet.plane, sheet.largest)) / scales.kL
        if longest >= LEAST or not sheet.settled(sheet.largest):
            continue
        found = message(
            "the longest acceleration is drawn {longest:.2g} mm long"
            if sheet.kind == "acceleration"
            else "the longest velocity is drawn {longest:.2g} mm long",
            longest=longest,
        )
        if sheet.kind == "acceleration" and "ka" in stated:
            ka = scales.ka / 1000
            most = not_above(ka * longest / LEAST)
            found = message("at {ka} (m/s²)/mm {found}", ka=digits(ka), found=found)
            raise dot("ka", found, message("a smaller ka, {most} or less", most=digits(most)))
        own = scales.of_bar(sheet.kind)
        if "enlarge" in stated and own < 1:
            raise dot(
                "enlarge",
                message("at {own} times {found}", own=digits(own), found=found),
                message("a larger enlarge"),
            )


def dot(key: str, found: Message, what: Message, least: float = LEAST) -> PageError:
    """The error of a scale factor that is too coarse, with a hint what to write."""
    hint = message("write {what}, or leave it out", what=what)
    return PageError.at(f"sheet.{key}", found, message("{least:g} mm or more", least=least), hint)


def not_above(number: float) -> float:
    """The largest number 1, 2 or 5 times a power of ten that does not exceed another."""
    return 1 / next(preferred(1 / number))
