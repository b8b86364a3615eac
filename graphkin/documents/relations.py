"""The relations of the calculation in the order of the work, read off the steps.

They cover lengths laid off, lengths found by crossing lines, and lengths that follow from others.

The vector equations of a plan: motions about pins and along guides, and given motions.

A vector that is computed and laid off, not found by a crossing, is given with its value.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations
from operator import truediv

from msgspec.structs import replace

from graphkin.construction.cams.cam_centre import of_cams
from graphkin.construction.core.component import components_on
from graphkin.construction.core.drawn_scene import NOISE, Drawing
from graphkin.construction.core.given_data import given
from graphkin.construction.core.kind import GivenVector, auxiliary_plan, construction
from graphkin.construction.core.link_poses import Disc
from graphkin.construction.core.naming import drawn_in, scale_of, segment_of, sense
from graphkin.construction.core.program import Part, Step, plan_vector, sign_of
from graphkin.construction.core.quantities import (
    BY_TARGET,
    FORCE,
    SHEETS,
    TIME_RATIO,
    Whose,
    names_asked,
    request,
)
from graphkin.construction.core.relation import (
    ROOM,
    Relation,
    VectorEquation,
    answer,
    as_read,
    length_laid_off,
    length_of,
    put_in,
    value_of,
)
from graphkin.construction.drivers.driven_slide import DrivenSlide
from graphkin.construction.higher_class.divided_point import SHARE
from graphkin.construction.higher_class.two_trials import of_trials
from graphkin.construction.links.plate_points import of_rolled_turns
from graphkin.construction.rate_relations import (
    KA,
    by_radius,
    laid_bars,
    of_driver,
    of_scales,
    of_slides,
    of_sum,
    of_turning,
)
from graphkin.construction.registry import ALSO_READ, COMPONENTS
from graphkin.construction.result_tables import slide_sense, slides_asked
from graphkin.construction.velocity.relative_motion import (
    TurnedAcceleration,
    TurnedVelocity,
    as_relation,
)
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.mechanism import Mechanism
from graphkin.motion.follower_limits import travels
from graphkin.numbers.plane import Ratio, Vector
from graphkin.scene.findings import natural
from graphkin.scene.link_points import lettered
from graphkin.scene.model import FRAME, Driver, Scene, lengths_of
from graphkin.structure.decomposition import decompose
from graphkin.structure.driver_count import count
from graphkin.structure.groups import (
    ROMAN,
    CamFollower,
    Crank,
    Driven,
    Dyad,
    Geared,
    Group,
    Higher,
    KeptParallel,
    OnTwoPins,
    Spun,
    Stretched,
    Tie,
)
from graphkin.structure.pairs import Sliding
from graphkin.text import Words


def of_equations(drawing: Drawing) -> list[tuple[str, Relation]]:
    """The equations of a plan in drawing order, each once, with the rate that it uses."""
    found: dict[object, tuple[str, Relation]] = {}
    for number, step, _ in drawing.steps(drawing.plane):
        if (plan := auxiliary_plan(drawing, number)) and plan.repeats:
            continue
        kind = construction(step)
        for relation in kind.equations(drawing, step.role) if kind else ():
            taken = ""
            if isinstance(kind, GivenVector) and relation.symbols:
                taken = kind.rate_taken(drawing, step.role)
            said = relation.equation or relation.left + relation.symbols
            found.setdefault(said, (taken, relation))
    return joined(list(found.values()))


def joined(found: list[tuple[str, Relation]]) -> list[tuple[str, Relation]]:
    """The list with the equations for one vector merged, at the place of the last one.

    Equations for the same vector are chained. An equation for a summand of a known vector is
    substituted.
    """
    rest: dict[str, tuple[str, Relation]] = {}
    for taken, relation in found:
        equation = relation.equation
        if equation is None:
            rest[relation.left + relation.symbols] = taken, relation
            continue
        for name in unknown_in(equation):
            _, before = rest.pop(name, ("", None))
            if before is not None and before.equation is not None:
                equation = equation.joined_to(before.equation)
        is_known = equation.whole.known == 2 and bool(equation.sums)
        rest[equation.markup if is_known else equation.whole.symbol] = taken, as_relation(equation)
    return list(rest.values())


def unknown_in(equation: VectorEquation) -> list[str]:
    """The vectors of points that an equation helps to find: the whole vector, or a summand."""
    found = [term.symbol for terms in equation.sums for term in terms if not term.known]
    return found if equation.whole.known == 2 else [equation.whole.symbol, *found]


def is_laid_off(drawing: Drawing, step: Step) -> bool:
    """Whether a component was computed and laid off, not found by the plan."""
    kind = sign_of(step)
    if kind in ("ν", "c"):
        return True
    tip = drawing.trace.program.steps[step.args[1]]
    return kind == "τ" and tip.role == "image" and isinstance(construction(tip), TurnedAcceleration)


def of_structure(drawing: Drawing) -> Iterator[Relation]:
    """Gruebler's count, and each group with its links."""
    words, counted = drawing.words, count(drawing.scene)
    singles = words("calculation.counted_singles", pairs=counted.singles) if counted.singles else ""
    pairs = words("calculation.counted", links=counted.moving, pairs=counted.pairs) + singles
    yield Relation(f"*M* = {counted.words} ({pairs})")
    unseen = drawing.scene.unseen
    *groups, last = [group_words(words, group, unseen) for group in decompose(drawing.scene)]
    mark = words("clause_mark").rstrip()
    first, *more = [*(f"{group}{mark}" for group in groups), last]
    yield Relation(first, more=tuple(more))


def group_words(words: Words, group: Group, unseen: frozenset[str] = frozenset()) -> str:
    """A group with its links, by kind, class and order; unseen keepers are not mentioned."""
    seen = sorted({*group.links} - unseen, key=natural)
    noun = "one_link" if len(seen) == 1 else "many_links"
    numbers = words("list_mark").join(map(escape, seen))
    links = words(f"calculation.{noun}", links=numbers)
    match group:
        case Crank() | Driven() | Spun():
            return words("calculation.group_driven", links=links)
        case OnTwoPins():
            return words("calculation.group_pins", links=links, rail=escape(group.rail))
        case Dyad():
            return words("calculation.group_dyad", links=links, type=group.type)
        case KeptParallel():
            bars = words("list_mark").join(map(escape, group.bars))
            if group.lead == FRAME:
                return words("calculation.group_shifting", links=links, bars=bars)
            lead = escape(group.lead)
            return words("calculation.group_parallel", links=links, lead=lead, bars=bars)
        case CamFollower():
            return words("calculation.group_cam", links=links, type=group.dyad.type)
        case Stretched():
            one, two = "calculation.group_stretched_one", "calculation.group_stretched_two"
            key = one if len(group.cylinders) == 1 else two
            return words(key, links=links, type=group.dyad.type)
        case Higher() if isinstance(group.last, Tie):
            rank, order = group.order
            rank_words = ROMAN[min(rank, len(ROMAN) - 1)]
            return words("calculation.group_higher", links=links, rank=rank_words, order=order)
        case Higher():
            key = "closed" if isinstance(group.last, Driver) else "unslipping"
            return words(f"calculation.group_{key}", links=links)
        case Tie() if isinstance(group.first, Sliding):
            return words("calculation.group_led", links=links)
        case Tie():
            return words("calculation.group_idle", links=links)
        case Geared() if group.is_belted:
            return words("calculation.group_belt", links=links)
    return words("calculation.group_geared", links=links)


# --- the relations of the calculation in the order of the work, read off the steps ----------------


Bar = tuple[str, str]
Section = tuple[str, list[Relation]]


def relations(drawings: Sequence[Drawing], *, solved: bool = True) -> list[Section]:
    """The sections of the calculation, in the order of the work.

    An unsolved calculation leaves out data that it asks for. The drive of a cam's centre of
    curvature follows once the centre is found. Without an acceleration plan, accelerations of
    drivers are left out.
    """
    first = drawings[0]
    whole = any(each.kind == "acceleration" for each in drawings)
    driver = [r for d in first.scene.drivers for r in of_driver(first, d, accelerated=whole)]
    scales = [r for r in of_scales(first) if whole or r.unit != KA]
    own = [section for drawing in drawings for section in sections_of(drawing)]
    cams = list(
        of_cams(first, {b for _, some in [("", driver), *own] for r in some for b in r.over})
    )
    after = {ends for relation in cams for ends in relation.over}
    driven = [relation for relation in driver if after.intersection(relation.over)]
    sections: list[Section] = [
        ("data", [clauses(first, given(first, solved=solved)), *loads_line(drawings)]),
        ("structure", list(of_structure(first)) if solved else []),
        ("driver", [relation for relation in driver if relation not in driven]),
        ("scales", scales),
        ("cams", cams + driven),
    ]
    used = dict.fromkeys(ends for _, found in own for each in found for ends in each.over)
    lengths = of_lengths(first, [ends for ends in used if ends not in after])
    found = [*sections, ("turned", list(of_rolled_turns(first))), *lengths, *own]
    found.append(("travel", list(of_travel(first))))
    return [(name, [in_results(first, each) for each in some]) for name, some in once(found)]


def of_travel(drawing: Drawing) -> Iterator[Relation]:
    """The strokes, swings and time ratios that are asked, from the dead positions."""
    words = drawing.words
    for (target, name), found in travels(Mechanism(drawing.scene)).items():
        quantity, travel = BY_TARGET[target], found.follower
        sign = drawing.symbol(f"{quantity.letter}_{name}")
        if quantity is TIME_RATIO:
            assert travel.strokes is not None
            slow, fast = (f"{words.fixed(angle, 1)}°" for angle in travel.strokes)
            remark = words("calculation.stroke_angles")
            result = words.significant(found.value)
            yield Relation(sign, figures=f"{slow} : {fast}", result=result, remark=remark)
            continue
        unit, remark = words.unit(quantity.unit), words("calculation.dead_positions")
        yield Relation(sign, result=words.significant(found.value), unit=unit, remark=remark)


def travel_words(drawing: Drawing) -> list[str]:
    """The strokes, swings and time ratios that are asked, in words."""
    ask, links = drawing.scene.ask, drawing.scene.links
    asked = {
        "ask.strokes": [name for name in ask.strokes if links[name].slides],
        "ask.swings": [name for name in ask.strokes if not links[name].slides],
        "ask.time_ratios": ask.time_ratios,
    }
    return [request(drawing.words, key, map(escape, some)) for key, some in asked.items() if some]


def once(sections: Iterable[Section]) -> Iterator[Section]:
    """The sections without the numbered relations that an earlier line already has."""
    said = set[tuple[str, str, str]]()
    for name, some in sections:
        kept = []
        for each in some:
            key = each.left, each.symbols, each.result
            if not each.result or key not in said:
                kept.append(each)
            said.add(key)
        yield name, kept


def in_results(drawing: Drawing, relation: Relation) -> Relation:
    """A relation with its unit of length that of the results."""
    unit = drawing.words.unit(relation.unit)
    return relation if unit == relation.unit else replace(relation, unit=unit)


def of_lengths(drawing: Drawing, bars: Sequence[Bar]) -> tuple[Section, Section]:
    """The lengths that follow from wheel radii, then the lengths measured on the mechanism.

    Bars that lie on one another share a relation. Lengths in the data, and lengths laid off in
    drawing the mechanism, are known already.
    """
    radii, measured = [], []
    known_bars = (*dimensioned_bars(drawing.scene.bare), *laid_bars(drawing))
    known = {ends_on(drawing, *ends) for ends in known_bars}
    alike: dict[frozenset[complex], list[Bar]] = {}
    for ends in bars:
        alike.setdefault(ends_on(drawing, *ends), []).append(ends)
    for places, some in alike.items():
        if places in known:
            continue
        name, length = " = ".join(bar(*ends) for ends in some), length_of(drawing, *some[0])
        if found := wheel_about(drawing, places):
            radii.append(replace(by_radius(drawing, *found), left=name, over=tuple(some)))
            continue
        read = as_read(drawing, drawing.on_paper(length), drawing.scales.kL / 1000)
        remark = drawing.words("calculation.measured")
        measured.append(Relation(name, "", *read, "m", remark, over=tuple(some)))
    return ("radii", radii), ("lengths", measured)


def wheel_about(drawing: Drawing, places: frozenset[complex]) -> tuple[Disc, int] | None:
    """The wheel of which a bar is a radius or a diameter, with the number of radii.

    A radius joins the centre to a contact point; a diameter joins two opposite contact points.
    """
    near, touches = NOISE * drawing.reach, drawing.standing.touches
    for disc in (each for touch in touches for each in (touch.disc, touch.other) if each):
        rim = [t.at for t in touches if t.belt is None and disc in (t.disc, t.other)]
        spans = [(1, disc.centre, at) for at in rim]
        spans += [(2, a, b) for a, b in combinations(rim, 2) if abs(a + b - 2 * disc.centre) < near]
        for radii, *ends in spans:
            if all(min(abs(z - end) for z in places) < near for end in ends):
                return disc, radii
    return None


def dimensioned_bars(scene: Scene) -> Iterator[Bar]:
    """The ends of the bars whose lengths the data give, driven cylinders included."""
    for link in scene.every_link:
        for placing in link.placings:
            yield from ((p, q) for p, q, _ in lengths_of(placing))
    for driver in scene.drivers:
        if driver.kind == "slide":
            link = scene.link(driver.link)
            slide = link.slides[0]
            start = slide.along[0] if slide.along else slide.through
            if isinstance(start, str) and slide.offset.is_zero():
                yield start, link.points[0]


def ends_on(drawing: Drawing, p: str, q: str) -> frozenset[complex]:
    """The places of the ends of a bar, equal for all bars that lie on one another."""
    return frozenset((drawing.standing.spot(p), drawing.standing.spot(q)))


def sections_of(drawing: Drawing) -> list[Section]:
    """The sections of one sheet."""
    if drawing.kind == FORCE:
        from graphkin.documents.sentences import force_relations

        return force_relations(drawing)
    plan = list(of_plan(drawing))
    turning = [relation for relation in of_turning(drawing) if relation not in plan]
    if drawing.kind == "velocity":
        return [
            ("velocities", plan),
            ("turning", turning),
            ("slides", list(of_slides(drawing))),
            ("centres", list(of_centres(drawing))),
        ]
    return [
        *of_components(drawing),
        ("accelerations", plan),
        ("spinning", turning),
        ("sliding", list(of_slides(drawing))),
        ("poles", list(of_centres(drawing))),
        ("curvatures", list(of_centres(drawing, "points"))),
    ]


def of_plan(drawing: Drawing) -> list[Relation]:
    """The relations that a plan needs and gives, each once and before its use."""
    found: list[Relation] = []
    if drawing.kind == "acceleration":
        for driver in drawing.scene.drivers:
            found += of_sum(drawing, driver)
    found += of_laid_off(drawing)
    for rate, relation in of_equations(drawing):
        found += before_use(drawing, rate)
        found.append(relation)
    found += [*of_trials(drawing), *read_off(drawing), *read_besides(drawing)]
    return list(dict.fromkeys(found))


def read_besides(drawing: Drawing) -> Iterator[Relation]:
    """The readings without a vector of their own."""
    for also in ALSO_READ:
        yield from also(drawing)


def before_use(drawing: Drawing, rate: str) -> Iterator[Relation]:
    """The relation for a rate that computes a vector, and the reading that the rate needs."""
    for relation in of_turning(drawing):
        if relation.left == rate:
            if relation.takes == SHARE:
                yield from of_trials(drawing)
            yield from before_use(drawing, relation.takes)
            read = (*read_off(drawing), *read_besides(drawing))
            yield from (r for r in read if r.left == relation.takes)
            yield relation


def loads_line(drawings: Sequence[Drawing]) -> Iterator[Relation]:
    """The data of forces, where there is a sheet of forces."""
    for drawing in drawings:
        if drawing.kind == FORCE:
            from graphkin.documents.sentences import load_data

            if found := load_data(drawing):
                yield clauses(drawing, [datum.said for datum in found])


def clauses(drawing: Drawing, said: Sequence[str]) -> Relation:
    """Data as one relation that may be broken after each piece."""
    *pieces, last = said
    mark = drawing.words("clause_mark").rstrip()
    first, *more = [f"{piece}{mark}" for piece in pieces] + [last]
    return Relation(first, more=tuple(more))


def read_off(drawing: Drawing) -> Iterator[Relation]:
    """Each vector that is read off the plan: scale factor times drawn length."""
    scale = scale_of(drawing, drawing.plane)
    k = drawing.in_signs(f"*k*_{drawing.vector.letter}")
    unit = drawing.vector.caret_unit
    for _, step, value in drawing.steps(drawing.plane):
        vector = plan_vector(step)
        if vector is None or not isinstance(value, Vector) or is_laid_off(drawing, step):
            continue
        size = drawing.settled(abs(value.tip - value.tail))
        if is_by_rate(drawing, step):
            if size and not is_by_driver(drawing, step):
                yield laid_off_length(drawing, step, value)
            continue
        read = as_read(drawing, drawn_in(drawing, drawing.plane, size), scale / 1000)
        symbols = f"{k}·{segment_of(drawing, step)}"
        yield Relation(drawing.symbol(vector.symbol), symbols, *read, unit)


def of_laid_off(drawing: Drawing) -> Iterator[Relation]:
    """The drawn lengths of the vectors that drivers give."""
    for _, step, value in drawing.steps(drawing.plane):
        if plan_vector(step) and isinstance(value, Vector) and is_by_driver(drawing, step):
            yield laid_off_length(drawing, step, value)


def laid_off_length(drawing: Drawing, step: Step, value: Vector) -> Relation:
    """The drawn length of a known vector: its size divided by the scale factor."""
    vector, scale = plan_vector(step), scale_of(drawing, drawing.plane) / 1000
    assert vector is not None
    size = drawing.settled(abs(value.tip - value.tail))
    drawn = length_laid_off(drawing, drawn_in(drawing, drawing.plane, size))
    return Relation(
        segment_of(drawing, step),
        drawing.in_signs(f"{drawing.symbol(vector.symbol)}/*k*_{drawing.vector.letter}"),
        "/".join(put_in(drawing, drawn, truediv, size, scale, shown_as=length_laid_off)),
        drawn,
        "mm",
        drawing.words("calculation.drawn"),
    )


def is_by_rate(drawing: Drawing, step: Step) -> bool:
    """Whether a vector is laid off by a rate, which has a relation of its own.

    Such a vector is whole, or is given by a driver along a guide.
    """
    if plan_vector(step) is None:
        return False
    kind = construction(drawing.trace.program.steps[step.args[1]])
    if isinstance(kind, DrivenSlide):
        return kind.start == step.args[0]
    if sign_of(step) or (isinstance(kind, TurnedAcceleration) and not kind.is_steady):
        return False
    return isinstance(kind, TurnedVelocity | TurnedAcceleration) and kind.start == step.args[0]


def is_by_driver(drawing: Drawing, step: Step) -> bool:
    """Whether a step is the whole velocity or acceleration of a point that a driver gives."""
    kind = construction(drawing.trace.program.steps[step.args[1]])
    known = isinstance(kind, GivenVector) and kind.known_by(drawing)
    return is_by_rate(drawing, step) and bool(known)


def of_components(drawing: Drawing) -> list[Section]:
    """The components, in the order of the work within each section."""
    found: dict[str, list[Relation]] = {}
    for kind in COMPONENTS:
        for each in components_on(drawing):
            if isinstance(each, kind):
                section, relation = each.section(drawing), each.relation(drawing)
                # plans may give the same relation
                if relation not in found.setdefault(section, []):
                    found[section].append(relation)
    return list(found.items())


def of_centres(drawing: Drawing, whose: Whose = "links") -> Iterator[Relation]:
    """The places of the centres and poles of links, or of the centres of points' paths.

    They are in millimetres on paper from the first fixed pivot, as measured, and in the axes of the
    frame.
    """
    part, owners = Part.CENTRE if drawing.kind == "velocity" else Part.POLE, owners_of(drawing)
    for number, step, value in drawing.on_mechanism:
        if step.part is not part or not isinstance(value, Ratio) or not step.name:
            continue
        if owners.get(number, "links") != whose:
            continue
        point = drawing.place(value)
        blank = blank_place(drawing)
        if point is None:
            everywhere = drawing.is_everywhere(value)
            key, equals = ("everywhere", "=") if everywhere else ("at_infinity", "")
            key, equals = ("no_curvature", "") if whose == "points" else (key, equals)
            said = drawing.words(f"calculation.{key}")
            yield Relation(drawing.symbol(step.name), result=said, equals=equals, blank=blank)
        else:
            kind = construction(step)
            yield from kind.equations(drawing, step.role) if kind is not None else ()
            yield replace(of_place(drawing, drawing.symbol(step.name), point), blank=blank)


def answers(drawing: Drawing) -> Iterator[Relation]:
    """What [ask] asks of a sheet, without how it follows."""
    if drawing.kind == FORCE:
        from graphkin.construction.forces.force_drawing import forces_asked

        yield from forces_asked(drawing)
        return
    words, vector = drawing.words, drawing.vector
    for point in names_asked(drawing.scene.ask, vector):
        value = drawing.trace.value(vector.target, point)
        if value is not None:
            size = drawing.settled(abs(value))
            shown = value_of(words, size, drawn_in(drawing, drawing.plane, size))
            name = drawing.symbol(f"{vector.letter}_{lettered(point)}")
            yield Relation(name, result=shown, unit=vector.caret_unit)
    for link in names_asked(drawing.scene.ask, drawing.rate):
        if (rate := drawing.turning(link)) is not None:
            name = drawing.symbol(drawing.turning_name(link))
            way, unit = sense(words, rate) if rate else "", drawing.rate.caret_unit
            yield Relation(name, result=words.significant(abs(rate)), unit=unit, remark=way)
    for block, slid, value in slides_asked(drawing):
        size = drawing.settled(abs(value))
        way = slide_sense(drawing, block, value) if size else ""
        yield Relation(slid, result=words.significant(size), unit=vector.caret_unit, remark=way)
    if drawing.kind == SHEETS[0]:
        yield from of_travel(drawing)
    for whose in ("links", "points"):
        yield from (place for place in of_centres(drawing, whose) if place.blank)


def owners_of(drawing: Drawing) -> dict[int, Whose]:
    """The kind of owner of each quantity, by its step."""
    targets = drawing.trace.program.targets.items()
    return {n: BY_TARGET[what].whose for (what, _), n in targets if what in BY_TARGET}


def blank_place(drawing: Drawing) -> tuple[str, str]:
    """Room for a place, and the origin of its coordinates."""
    words, pivots = drawing.words, drawing.scene.frame.points
    pair = words.place(ROOM, ROOM)
    if not pivots:
        unit = words.spelled(drawing.scene.units["length"])
        return f"{pair} {unit}", f"({words('calculation.axes')})"
    return (
        f"{pair} {words.spelled('mm')}",
        f"({words('calculation.from_pivot', pivot=symbol(pivots[0]))})",
    )


def of_place(drawing: Drawing, name: str, point: complex) -> Relation:
    """A place on paper from the first fixed pivot, and in the axes of the frame."""
    words, unit = drawing.words, drawing.words.spelled(drawing.scene.units["length"])
    away = (0.0 if abs(part) < NOISE * drawing.reach else part for part in (point.real, point.imag))
    x, y = (answer(drawing, drawing.length(part)) for part in away)
    pivots = drawing.scene.frame.points
    if not pivots:
        return Relation(name, result=words.place(x, y), unit=unit, remark=words("calculation.axes"))
    shift = point - drawing.standing.spot(pivots[0])
    parts = (drawing.on_paper(part) for part in (shift.real, shift.imag))
    measured = words.place(*(words.fixed(part, 2) for part in parts))
    remark = words(
        "calculation.on_paper", pivot=symbol(pivots[0]), place=f"{words.place(x, y)} {unit}"
    )
    return Relation(name, result=measured, unit="mm", remark=remark)
