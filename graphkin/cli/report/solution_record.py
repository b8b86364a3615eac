"""The JSON and the text of solve: x right, y up, counter-clockwise positive, full precision."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from math import isfinite, isnan
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace

from graphkin.construction.core.kind import ClosesGroup, construction
from graphkin.construction.core.naming import scale_unit
from graphkin.construction.core.pen import image, letter, second_image
from graphkin.construction.core.program import Part, Program
from graphkin.construction.core.quantities import (
    CENTRES,
    OF_POINTS,
    OF_SLIDES,
    PLURALS,
    RATES,
    SLIDING,
    Around,
    LinkMotion,
    MotionQuantity,
    PointMotion,
    SlideMotion,
    Whose,
    motion_value,
    names_asked,
    points_asked,
)
from graphkin.construction.core.run import Trace
from graphkin.construction.core.solution import FAIR, Solution, Verdict
from graphkin.documents.centre_tables import (
    breadth_of,
    centre_words,
    circles_table,
    largest,
    place_of,
    pole_words,
    relative_table,
    with_blocks,
)
from graphkin.numbers.arithmetic import FLOAT, Kind
from graphkin.numbers.plane import Ratio
from graphkin.scene.link_points import ends_of, is_under
from graphkin.scene.model import Scene
from graphkin.structure.pairs import name_words
from graphkin.text import IMPERIAL, Words, words
from graphkin.text.tables import Cell, cleaned, listed, number, table

if TYPE_CHECKING:
    from graphkin.drawing.scale import Scales


Record = dict[str, Any]
Wanted = Callable[[MotionQuantity, str], bool]
"""Whether to report a quantity of a point, link or block."""


def record(
    scene: Scene,
    solution: Solution,
    verdict: Verdict | None,
    scales: Scales | None,
    *,
    asked: bool = False,
) -> Record:
    """Everything that solve reports, under the names of the scene and in its order.

    Without ``scales`` the record has none: they belong to a drawing.
    """
    full, wanted = with_blocks(scene, solution), wanted_of(scene, asked)
    slides, breadth = as_given(scene, full.slides), breadth_of(full)
    return {
        "name": scene.name,
        "parameters": {name: plain(scene.values.get(name)) for name in scene.parameters},
        "points": named(
            point_names(scene, full), lambda n: point(n, motion_of(n, full), wanted, breadth)
        ),
        "links": named(scene.links, lambda n: link(n, full.links[n], wanted, breadth)),
        **centres(scene, full),
        "slides": named(
            filter(slides.__contains__, scene.links), lambda n: slide(n, slides[n], wanted)
        ),
        **drawn_at(scales, verdict),
        "witness": witness(verdict),
        "margin": real(solution.margin),
    }


def drawn_at(scales: Scales | None, verdict: Verdict | None) -> Record:
    """The scale factors of the sheets, if they were computed.

    Those of the plans are null if some numbers have no sure digit.
    """
    if scales is None:
        return {}
    sure = verdict is None or not verdict.unsure
    plans = {"kv": scales.kv, "ka": scales.ka} if sure else {"kv": None, "ka": None}
    return {"scales": {"kL": scales.kL * scales.metre, **plans}}


def wanted_of(scene: Scene, asked: bool) -> Wanted:
    """A test that accepts every quantity, or only what [ask] asks."""
    return lambda quantity, of: not asked or of in names_asked(scene.ask, quantity)


def point_names(scene: Scene, solution: Solution) -> list[str]:
    """The frame's points, the links' points as written, then points such as A@3."""
    written = [p for link in scene.every_link for p in link.points]
    asked = filter(is_under, points_asked(scene.ask))
    names = dict.fromkeys((*written, *asked, *solution.points))
    return [name for name in names if motion_of(name, solution) is not None]


def motion_of(name: str, solution: Solution) -> PointMotion | None:
    """The motion of a point; A@3 is A itself if A belongs to link 3."""
    return solution.points.get(name) or solution.points.get(ends_of(name)[0])


def named(names: Any, entry: Callable[[str], Record]) -> Record:
    """An entry for each name that has anything to report."""
    entries = ((name, entry(name)) for name in names)
    return {name: found for name, found in entries if found}


def point(name: str, motion: PointMotion | None, wanted: Wanted, breadth: float) -> Record:
    """Position, velocity and acceleration of a point, and its centres, if wanted and known."""
    found = {q.key: motion_value(motion, q) for q in OF_POINTS if wanted(q, name)}
    known = {key: pair(value) for key, value in found.items() if value is not None}
    return known | of_centres("points", name, motion, wanted, breadth)


def link(name: str, motion: LinkMotion, wanted: Wanted, breadth: float) -> Record:
    """Turning of a link, and its centres."""
    found = {q.key: real(motion_value(motion, q)) for q in RATES if wanted(q, name)}
    return found | of_centres("links", name, motion, wanted, breadth)


def of_centres(whose: Whose, name: str, motion: Any, wanted: Wanted, breadth: float) -> Record:
    """The centres of a link or a point, or null if they are at infinity.

    A centre with a circle is reported as that circle, if it is known.
    """
    found: Record = {}
    for q in CENTRES:
        if q.whose != whose or not wanted(q, name):
            continue
        value = motion_value(motion, q)
        if q.circle is None:
            found[q.key] = pair(place_of(value, breadth))
        elif value is not None:
            found[q.key] = circle(q.circle, motion, place_of(value, breadth), breadth)
    return found


def circle(around: Around, motion: Any, found: complex | None, breadth: float) -> Record | None:
    """The circle of a centre that was found; null if it has no finite radius."""
    start = getattr(motion, around.start)
    first = place_of(start, breadth) if isinstance(start, Ratio) else start
    if first is None or found is None:
        return None
    parts = around.parts(first, found)
    return {key: real(part) if key == "radius" else pair(part) for key, part in parts.items()}


def centres(scene: Scene, solution: Solution) -> Record:
    """The relative centres that are asked, or null if they are at infinity."""
    breadth = breadth_of(solution)
    known = [name for name in scene.ask.pairs if name in solution.centres]
    found = {name: pair(place_of(solution.centres[name], breadth)) for name in known}
    return {"centres": found} if found else {}


def as_given(
    scene: Scene, slides: Mapping[str, SlideMotion], kind: Kind = FLOAT
) -> dict[str, SlideMotion]:
    """Motions of blocks, in a number kind, with the values that drivers give along their guides.

    A measured value along the guide differs from the given one by rounding. Unknown values stay
    unknown.
    """
    found, values = dict(slides), scene.values if kind is FLOAT else scene.values_in(kind)
    for driver in scene.drivers:
        own = found.get(driver.link)
        if driver.kind != "slide" or own is None:
            continue
        if driver.against != scene.links[driver.link].slides[0].on:
            continue
        given = {
            key: getattr(driver, key).si(values, kind)
            for key in ("position", "speed", "acceleration")
            if (value := getattr(own, key)) is not None and kind.sound(value)
        }
        found[driver.link] = replace(own, **given)
    return found


def slide(name: str, motion: SlideMotion, wanted: Wanted) -> Record:
    """Motion of a block along its guide; the vector of a guide that does not turn is 0."""
    if not wanted(SLIDING["position"], name):
        return {}
    found = ((q, motion_value(motion, q)) for q in OF_SLIDES)
    return {
        q.attribute: real(value) if q.sort == "number" else pair(value or 0j) for q, value in found
    }


def witness(verdict: Verdict | None) -> Record:
    """The verdict of the independent check; without a verdict, ``agrees`` is false."""
    if verdict is None:
        return {"agrees": False, "largest_difference": None}
    return {
        "agrees": verdict.agrees,
        "largest_difference": real(verdict.largest_difference),
        "quantity": verdict.quantity,
        "limit": real(verdict.limit),
        "branches_not_held": list(verdict.branches),
        "digits": dict(verdict.digits),
        "unsure": list(verdict.unsure),
    }


def real(value: Any) -> float | None:
    """A finite float, never minus zero; None for an unknown or infinite value."""
    return float(value) + 0.0 if value is not None and isfinite(value) else None


def pair(value: complex | None) -> list[float | None] | None:
    """The two components of a point or vector."""
    return None if value is None else [real(value.real), real(value.imag)]


def plain(value: object) -> int | float | None:
    """A parameter's value, as an int if it is whole."""
    if isinstance(value, Fraction) and value.denominator == 1:
        return int(value)
    return real(value)


def heading(scene: Scene) -> str:
    """Title and name of a scene, and its parameters as set."""
    settings = settings_words({name: plain(scene.values.get(name)) for name in scene.parameters})
    return f"{scene.title} ({scene.name})" + (f", {settings}" if settings else "")


def settings_words(parameters: Mapping[str, Any]) -> str:
    """Parameters as set, such as n = 7."""
    return ", ".join(f"{name} = {value}" for name, value in parameters.items())


SPOKEN = words("en")
"""English, with results in metres."""
COLUMNS = {"place": ("x", "y"), "vector": ("x", "y", "")}
"""The components of each sort of quantity, the magnitude last."""


def motion_text(scene: Scene, solution: Solution, found: Record, verdict: Verdict | None) -> str:
    """Everything in a record, in aligned tables, in the unit in which the scene is computed."""
    spoken = words("en", length=scene.base)
    parts = [
        [heading(scene)],
        points_table(found["points"], solution, spoken),
        turning_table(found["links"], solution),
        centres_table(scene, solution, found["links"]),
        relative_table(solution, found.get("centres", {}), scene.base),
        *(circles_table(found[each.whose], each, scene.base) for each in CENTRES if each.circle),
        slides_table(found["slides"], spoken),
        scale_lines(found["scales"], spoken) if "scales" in found else [],
        [f"witness  {verdict_words(verdict, scene)}", *sure_lines(verdict)],
    ]
    return "\n\n".join("\n".join(lines) for lines in parts if lines)


def points_table(points: Mapping[str, Record], solution: Solution, spoken: Words) -> list[str]:
    """Position, velocity and acceleration of each point, with magnitudes."""
    heads = {
        each.key: [f"{each.letter}{part}, {spoken.unit(each.unit)}" for part in COLUMNS[each.sort]]
        for each in OF_POINTS
    }
    known = [key for key in heads if any(key in point for point in points.values())]
    if not known:
        return []
    every = solution.points.values()
    biggest = {key: largest(getattr(point, key) for point in every) for key in known}
    rows: list[list[Cell]] = []
    for name, point in points.items():
        row: list[Cell] = [name]
        for key in known:
            row += components(point.get(key), biggest[key], len(heads[key]))
        rows.append(row)
    return table(["point", *(head for key in known for head in heads[key])], rows)


def components(pair: list[float | None] | None, biggest: float, columns: int) -> list[Cell]:
    """The two components of a vector, and its magnitude if there is a third column."""
    known = [part for part in pair or () if part is not None]
    if len(known) < 2:
        return [None] * columns
    return [cleaned(value, biggest) for value in (*known, abs(complex(*known)))[:columns]]


def turning_table(links: Mapping[str, Record], solution: Solution) -> list[str]:
    """ω and ε of each link, with their senses in words.

    An ε that is tiny compared with ω² is rounding and is printed as zero.
    """
    biggest = 0.0
    heads: list[str] = ["link"]
    columns: list[list[Cell]] = [list(links)]
    for rate in RATES:
        values = [link.get(rate.attribute) for link in links.values()]
        biggest = max(
            biggest**2, largest(motion_value(link, rate) for link in solution.links.values())
        )
        if any(value is not None for value in values):
            clean = [None if value is None else cleaned(value, biggest) for value in values]
            heads += [f"{rate.letter}, {rate.unit}", f"sense of {rate.letter}"]
            columns += [list(clean), [sense(value) for value in clean]]
    unsure = {
        name
        for name, link in solution.links.items()
        if any((value := motion_value(link, rate)) is not None and isnan(value) for rate in RATES)
    }
    every = zip(*columns, strict=True)
    rows = [row for row in every if row[0] in unsure or any(cell is not None for cell in row[1:])]
    return table(heads, rows) if rows else []


def sense(value: float | None) -> str | None:
    """The sense in which a link turns, in words."""
    if value is None:
        return None
    return "none" if value == 0 else "counter-clockwise" if value > 0 else "clockwise"


def centres_table(scene: Scene, solution: Solution, links: Mapping[str, Record]) -> list[str]:
    """Instantaneous centre and acceleration pole of each link for which they are reported."""
    full, breadth = with_blocks(scene, solution), breadth_of(solution)
    of_links = (each for each in CENTRES if each.whose == "links" and not each.circle)
    known = [each for each in of_links if any(each.key in link for link in links.values())]
    rows: list[list[Cell]] = []
    for name, link in links.items():
        moves = acceleration_of(scene, full, name)
        cells = [
            words_of(each, motion_value(full.links[name], each), moves, breadth)
            if each.key in link
            else None
            for each in known
        ]
        if any(cells):
            rows.append([name, *cells])
    heads = ["link", *(f"{each.words}, {scene.base}" for each in known)]
    return table(heads, rows) if rows else []


def words_of(
    quantity: MotionQuantity, ratio: Ratio | None, acceleration: complex | None, breadth: float
) -> str:
    """The place of a centre of velocities or accelerations, or what holds where it has none."""
    if quantity.kind == "velocity":
        return centre_words(ratio, breadth)
    return pole_words(ratio, acceleration, breadth)


def acceleration_of(scene: Scene, solution: Solution, link: str) -> complex | None:
    """Acceleration of the first known point of a link."""
    points = (solution.points.get(name) for name in scene.links[link].points)
    return next((p.acceleration for p in points if p is not None), None)


def slides_table(slides: Mapping[str, Record], spoken: Words) -> list[str]:
    """Motion of each block along its guide, and the vector that the turning of the guide adds."""
    *along, across = OF_SLIDES
    heads = [f"{each.words}, {spoken.unit(each.unit)}" for each in along]
    unit = spoken.unit(across.unit)
    heads += [f"{across.words} x, {unit}", f"y, {unit}"]
    rows: list[list[Any]] = [
        [name, *(slide[each.attribute] for each in along), *slide[across.attribute]]
        for name, slide in slides.items()
    ]
    return table(["block", *heads], rows) if rows else []


def scale_lines(scales: Mapping[str, float | None], spoken: Words = SPOKEN) -> list[str]:
    """The scale factors of the largest drawing that fits the sheet; those of plans where known."""
    kL, kv, ka = scales["kL"], scales["kv"], scales["ka"]
    assert kL is not None
    drawn = f"1 : {kL:g}" if kL >= 1 else f"{1 / kL:g} : 1"
    unit = f" {scale_unit(spoken)}" if spoken.length in IMPERIAL else ""
    lines = [f"scale    kL = {kL:g}{unit}, drawn {drawn}"]
    if kv is None or ka is None:
        return lines
    v, a = spoken.unit("m/s"), spoken.unit("m/s²")
    return [
        *lines,
        f"         kv = {number(kv)} {v} per metre of paper, {number(kv / 1000)} {v} per mm",
        f"         ka = {number(ka)} {a} per metre of paper, {number(ka / 1000)} {a} per mm",
    ]


def verdict_words(verdict: Verdict | None, scene: Scene) -> str:
    """The verdict of the independent check, with each cause of a doubt."""
    if verdict is None:
        return "could not judge"
    where = f" at {verdict.quantity}" if verdict.quantity else ""
    found = f"largest difference {verdict.largest_difference:.1e}{where}"
    found += f", limit {verdict.limit:.1e}"
    if verdict.agrees:
        return f"agrees: {found}"
    says = f"the numbers {'differ' if verdict.differs else 'agree'}: {found}"
    if not isfinite(verdict.limit):
        says = "bars are in line, where no difference can be judged"
    if verdict.branches:
        says += f"; does not hold of [branches]: {verdict.not_as_stated(scene.branches)}"
    if verdict.differs and verdict.digits:
        says += f"; sure digits: {digits_words(verdict)}; {PROVES}"
    return f"DOES NOT AGREE: {says}"


PROVES = "solve --digits proves what can be known"
"""What to do where doubles have lost digits."""


def sure_lines(verdict: Verdict | None) -> list[str]:
    """The number of sure digits, and the quantities without a sure digit."""
    if verdict is None or not verdict.digits:
        return []
    lines = [] if verdict.differs else [f"sure: {digits_words(verdict)}"]
    lines += [unsure_words(verdict)] if verdict.unsure else []
    return [f"{head:9}{words}" for head, words in zip(("digits", ""), lines, strict=False)]


def is_flat(trace: Trace) -> bool:
    """Whether some lines cross so flatly that their point cannot be drawn."""
    return any(float(margin) < FAIR for margin in trace.margins.values())


def flat_words(scene: Scene, trace: Trace) -> str:
    """The flattest crossing: its point, its sine, the lines nearly in line, and how to avoid it."""
    from graphkin.diagnosis.assembly_failure import beside_dead_point

    number = min(trace.margins, key=lambda step: float(trace.margins[step]))
    point, part = crossing(trace.program, number)
    sine = f"{float(trace.margins[number]):.2e}, less than {FAIR:g}"
    return (
        f"the lines at {point} ({part}) cross at a sine of {sine}: the answer is not fair to ask; "
        f"{beside_dead_point(scene, trace.program, number)}"
    )


def digits_words(verdict: Verdict) -> str:
    """The numbers of sure digits of positions, velocities and accelerations."""
    known = [(kind, verdict.digits[kind]) for kind in PLURALS if kind in verdict.digits]
    return ", ".join(f"{PLURALS[kind]} {digits}" for kind, digits in known)


def unsure_words(verdict: Verdict) -> str:
    """The quantities without a sure digit, and the reason."""
    return (
        f"no digit is sure of {listed(verdict.unsure, 6)}: the rounding of doubles, which flat "
        f"crossings and angles of many turns enlarge, exceeds them; {PROVES}"
    )


def crossing(program: Program, number: int) -> tuple[str, str]:
    """What a step finds where lines cross, as the scene names it, and the part of the work."""
    step = program.steps[number]
    return place_words(program, number) or "lines that help", step.part.value


def place_words(program: Program, number: int) -> str:
    """The point, line, centre or links that a step determines; empty if it determines none."""
    step = program.steps[number]
    whole = next((n for n, other in enumerate(program.steps) if other.by_hand == number), None)
    if whole is not None and not step.name:
        return place_words(program, whole)
    kind = construction(step)
    if kind is not None and (title := kind.title(step.role)):
        return title
    if isinstance(kind, ClosesGroup) and kind.closes:
        return f"links {listed(kind.closes)} together"
    return point_words(program, drawn_name(program, number))


def drawn_name(program: Program, number: int) -> str:
    """The letter of a step, or of a later step that uses its result, without any tag.

    The corner of a plate gets its letter only where the plate is drawn.
    """
    step = program.steps[number]
    name, reached = step.letter, {number}
    for later in range(number + 1, len(program.steps)):
        after = program.steps[later]
        if name or after.part not in (step.part, Part.POSITION):
            break
        if reached.intersection(after.args):
            name = after.letter
            reached.add(later)
    return name


def point_words(program: Program, name: str) -> str:
    """The point that has ``name`` as its letter or image in a plan; else ``name`` itself."""
    for quantity, point in program.targets:
        if quantity == "position" and name in (letter(point), image(point), second_image(point)):
            own, link = ends_of(point)
            words = name_words(type(point)(own))
            return f"{words} on link {link}" if link else words
    return name
