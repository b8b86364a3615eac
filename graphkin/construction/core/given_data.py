"""The given data: parameters, drivers, lengths, points, sides, guides and wheels."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator
from fractions import Fraction

from msgspec import Struct

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import ClosesGroup, constructions
from graphkin.construction.core.naming import (
    angle_symbol,
    axis_of,
    driver_index,
    nearest_side,
    speed_symbol,
    straight,
)
from graphkin.construction.core.pen import letter
from graphkin.construction.core.quantities import in_degrees, number_of, quantity_text, unit_words
from graphkin.construction.core.relation import figure
from graphkin.construction.guides.swung_guide import SwungGuide
from graphkin.construction.links.dyad_by_arcs import arcs_finding
from graphkin.construction.links.rolled_turn import counted_link
from graphkin.drawing.symbol_markup import bar, escape, of_wheel, symbol
from graphkin.scene.expression import CONSTANT, TIME
from graphkin.scene.link_points import under
from graphkin.scene.model import (
    FRAME,
    Angled,
    At,
    Branch,
    Cam,
    CamPiece,
    Closure,
    Driver,
    Link,
    OnLine,
    Polar,
    Rolling,
    Scene,
    Side,
    Slide,
    Triangle,
    Way,
    Wheel,
    lengths_of,
    quantities_within,
)
from graphkin.scene.quantity import LENGTHS, Quantity, exact, shortest
from graphkin.scene.read_scene import SPELLINGS
from graphkin.scene.wheels import contact_letters
from graphkin.text import Words
from graphkin.text.errors import SceneError

LETTERS = (
    "alpha beta gamma delta epsilon zeta eta theta kappa lambda mu nu xi rho sigma tau",
    "phi psi omega",
)
GREEK = dict(zip(" ".join(LETTERS).split(), "αβγδεζηθκλμνξρστφψω", strict=True))
"""Greek letters by the names that a parameter may have."""


def parameters(scene: Scene, words: Words) -> list[str]:
    """The parameters used in expressions, with their values; the data show the other ones."""
    return [parameter(scene, words, name) for name in scene.values if name in put_in(scene)]


def variant(scene: Scene, words: Words, names: Collection[str] = ()) -> list[str]:
    """The parameters that distinguish variants, as markup.

    These are ``names``; without them, those with a range and those in expressions. A parameter that
    is only the position or the speed of a driver gets the driver's symbol.
    """
    ranged = {name for name, each in scene.parameters.items() if each.minimum is not None}
    put = put_in(scene)
    wanted = names or ranged | put
    letters = {lone(scene, each.speed): speed_symbol(each) for each in scene.drivers}
    letters |= {lone(scene, each.position): angle_symbol(scene, each) for each in scene.drivers}
    text_of_value = ((name, *as_set(scene, words, name)) for name in scene.values if name in wanted)
    return [
        f"{letter if name in put else letters.get(name, letter)} = {value}"
        for name, letter, value in text_of_value
    ]


def other_parameters(scene: Scene, words: Words) -> list[tuple[str, str, str]]:
    """The parameters in expressions that no driver or length shows by itself.

    Each is a name, a symbol and a value.
    """
    shown = {name for quantity in shown_quantities(scene) if (name := lone(scene, quantity))}
    put = put_in(scene)
    return [(name, *as_set(scene, words, name)) for name in scene.values if name in put - shown]


def put_in(scene: Scene) -> set[str]:
    """The parameters in the expressions from which the drivers are computed."""
    rates = (q for d in scene.drivers for q in (d.position, d.speed, d.acceleration))
    return {name for rate in rates if not lone(scene, rate) for name in rate.uses()}


def parameter(scene: Scene, words: Words, name: str) -> str:
    """A parameter and its value."""
    return " = ".join(as_set(scene, words, name))


def parameter_symbol(name: str) -> str:
    """The symbol of a parameter: its name, or the Greek letter that the name spells."""
    return f"*{escape(GREEK.get(name, name))}*"


def as_set(scene: Scene, words: Words, name: str) -> tuple[str, str]:
    """The symbol and the value of a parameter; t is the time in laws of time, in seconds."""
    unit = "s" if name == TIME else unit_of(scene, name)
    says_it = SPELLINGS.get(name.lower(), name) == unit  # rpm = 50, not rpm = 50 rev/min
    printed = "" if says_it else unit_words(words, unit)
    space = " " if printed and printed != "°" else ""
    return parameter_symbol(name), words.decimal(shortest(scene.values[name])) + space + printed


def after_parameter(scene: Scene, words: Words, quantity: Quantity, letter: str = "") -> str:
    """A quantity as printed, after its parameter where expressions use that one: a = 80 mm.

    ``letter`` is the symbol already printed in front.
    """
    name, text = lone(scene, quantity), quantity_text(scene, words, quantity).rstrip()
    text_of_value = name in put_in(scene) and name != letter
    return f"{parameter_symbol(name)} = {text}" if text_of_value else text


def lone(scene: Scene, quantity: Quantity) -> str:
    """The parameter that makes up a quantity alone; empty for any other expression."""
    return quantity.text if quantity.text in scene.values and quantity.text != TIME else ""


def has_own_relation(scene: Scene, quantity: Quantity) -> bool:
    """Whether a separate relation says how a driver's quantity follows from the parameters."""
    derived = is_derived(quantity) and not quantity.is_zero()
    return derived or (bool(quantity.uses()) and not lone(scene, quantity))


def expression(scene: Scene, words: Words, quantity: Quantity, *, values: bool) -> str:
    """The expression of a quantity as markup, its parameters as symbols or as values."""
    text = re.sub(r"^d\(d\((.*)\)/dt\)/dt$", r"d**2(\1)/dt**2", quantity.text).replace("**", "^")
    known = scene.values

    def replaced(match: re.Match[str]) -> str:
        name = match[0]
        if name not in known:
            return "π" if name == CONSTANT else name
        return words.decimal(shortest(known[name])) if values else parameter_symbol(name)

    parts = re.split(r"([A-Za-z_]\w*)", text)
    return "".join(
        re.sub(r"^\w+$", replaced, part) if i % 2 else spelled(words, part)
        for i, part in enumerate(parts)
    )


def spelled(words: Words, text: str) -> str:
    """The signs of an expression as printed."""
    plain = escape(words.decimal(text).replace("*", "·").replace(" · ", "·"))
    return re.sub(r"\\\^(\d)(?!\d)", r"^\1", plain)


def law(scene: Scene, words: Words, quantity: Quantity) -> str:
    """The expression of a quantity with its unit: 15·n°, (30 + 2·n) rev/min."""
    text, unit = expression(scene, words, quantity, values=False), unit_words(words, quantity.unit)
    bare = re.sub(r"\([^()]*\)", "", text)
    text = f"({text})" if re.search(r"[^^(][+−-]", bare) else text
    return f"{text}{'' if unit == '°' else ' '}{unit}"


def is_derived(quantity: Quantity) -> bool:
    """Whether a rate follows from the law of time of a position or a speed."""
    return "/dt" in quantity.text


def shown_quantities(scene: Scene) -> Iterator[Quantity]:
    """The quantities of the data that are printed next to their parameter."""
    for driver in scene.drivers:
        yield driver.position
        for rate in (driver.speed, driver.acceleration):
            if driver.kind != "turn" or float(rate.si(scene.values)) > 0:
                yield rate  # words give the sense of a negative rotation
    for link in (scene.frame, *scene.links.values()):
        for placing in link.placings:
            yield from (length for _, _, length in lengths_of(placing))
        for wheel in link.wheels:
            size = wheel.teeth or wheel.radius
            yield from () if size is None else (size,)


def unit_of(scene: Scene, name: str) -> str:
    """The unit of a parameter, from the quantities that grow with it; empty for a plain number.

    A fixed length has the unit of its multiples. A parameter used in sines has the unit of angles.
    A parameter with a range that changes both lengths and angles, such as a student number, is a
    plain number.
    """
    if any(is_angle(quantity.text, name) for quantity in quantities(scene)):
        return scene.units["angle"]
    fixed = name in scene.parameters and scene.parameters[name].minimum is None
    kinds = {
        quantity.written_unit.split("/")[0] in LENGTHS
        for quantity in quantities(scene)
        if name in quantity.uses() and quantity.unit and slope_of(scene, quantity, name)
    }
    if not fixed and len(kinds) > 1:
        return ""
    units = {
        quantity.written_unit
        for quantity in quantities(scene)
        if name in quantity.uses()
        and (grows_alike(scene, quantity, name) or (fixed and is_multiple(scene, quantity, name)))
    }
    return units.pop() if len(units) == 1 else ""


def is_angle(text: str, name: str) -> bool:
    """Whether an expression takes the sine, cosine or tangent of the parameter alone."""
    return re.search(rf"\b(?:sin|cos|tan)\(\s*{re.escape(name)}\s*\)", text) is not None


def grows_alike(scene: Scene, quantity: Quantity, name: str) -> bool:
    """Whether a quantity changes by exactly as much as the parameter."""
    slope = slope_of(scene, quantity, name)
    return slope is not None and abs(slope) == 1


def is_multiple(scene: Scene, quantity: Quantity, name: str) -> bool:
    """Whether a length is proportional to a parameter."""
    slope = slope_of(scene, quantity, name)
    if slope is None or quantity.written_unit not in LENGTHS:
        return False
    whole = float(quantity.number(scene.values))
    value = float(Fraction(str(scene.values[name])))
    return abs(slope * value - whole) <= 1e-9 * abs(whole)


def slope_of(scene: Scene, quantity: Quantity, name: str) -> float | None:
    """The derivative of a quantity by a parameter; None where there is no derivative."""
    try:
        return float(quantity.derivative(name).number(scene.values))
    except SceneError:
        return None


def quantities(scene: Scene) -> Iterator[Quantity]:
    """Every quantity by which a scene describes its links, drivers and pairs."""
    yield from quantities_within((scene.frame, *scene.links.values(), *scene.drivers))


# --- slides, wheels and closures, in words -------------------------------------------------------


def of_guide(drawing: Drawing, link: Link, slide: Slide) -> str:
    """The sentence for a block's guide, the chosen crossing and the positive direction."""
    fields = {"point": sliding_point(drawing, link), "way": which_way(drawing, link, slide)}
    fields["line"] = bar(*slide.along) if slide.along else straight(drawing, slide)
    fields["positive"] = positive(drawing, link, slide)
    key = f"page.{'slot' if slide.pin else 'guide'}{'' if slide.offset.is_zero() else '_beside'}"
    return drawing.words(key, **fields, **aside(drawing, slide))


def sliding_point(drawing: Drawing, link: Link) -> str:
    """The point that names a block; the point of its link where several blocks share the point."""
    point, links = link.points[0], drawing.scene.links.values()
    shared = [each for each in links if each.slides and each.points[0] == point]
    return symbol(letter(under(point, link.name)) if len(shared) > 1 else point)


def which_way(drawing: Drawing, link: Link, slide: Slide) -> str:
    """The words for the chosen crossing of a block, seen from a known pin."""
    words, branch, line = (
        drawing.words,
        stated_way(drawing.scene, link, slide),
        drawing.guide(slide),
    )
    laid = constructions(drawing.trace.program, SwungGuide)
    led = next((each for each in laid if each.ahead and each.guides(link.name, slide.on)), None)
    if led is not None:
        return words("page.ahead" if led.ahead > 0 else "page.behind", p=symbol(led.pivot))
    if not isinstance(branch, Way) or slide is not link.slides[0]:
        return ""
    dyads = tuple(arcs_finding(drawing, link.points))
    if line and dyads:
        found = dyads[-1]
        fields = {"side": words(f"page.{nearest_side(line[1] * branch.way)}")}
        if found.name == link.points[0]:
            return words("page.way", pivot=symbol(found.centre), **fields)
        return words("page.way_of", pin=symbol(found.name), pivot=symbol(found.centre), **fields)
    if is_led(drawing, link, slide):
        p, q = (symbol(point) for point in slide.along or ())
        key = "half_line" if branch.way > 0 else "half_line_back"
        return words(f"page.{key}", p=p, q=q)
    return words("page.forward" if branch.way > 0 else "page.backward")


def stated_way(scene: Scene, link: Link, slide: Slide) -> Branch | None:
    """The stated branch of a block, or of a guided pin whose branch is a way."""
    led = (
        scene.link(slide.on).points if link.rolls else (*scene.link(slide.on).points, *link.points)
    )
    ways = (scene.branches.get(point) for point in led)
    return next((way for way in ways if isinstance(way, Way)), scene.branches.get(link.name))


def is_led(drawing: Drawing, link: Link, slide: Slide) -> bool:
    """Whether a guide is drawn from its first end through the known point of its block."""
    if not slide.along or not slide.offset.is_zero():
        return False
    ends = slide.along[0], link.points[0]
    return any(each.points == ends for each in constructions(drawing.trace.program, SwungGuide))


def positive(drawing: Drawing, link: Link, slide: Slide) -> str:
    """The words for the positive direction of a guide along which data or answers count."""
    scene, words = drawing.scene, drawing.words
    driven = any(d.kind == "slide" and d.link == link.name for d in scene.drivers)
    plate = any(cam.slides and cam.on == link.name for cam in scene.cams.values())
    counted = driven or link.cam is not None or plate or link.name in scene.ask.slides
    if slide is not link.slides[0] or not counted:
        return ""
    if slide.along:
        p, q = (symbol(point) for point in slide.along)
        return words("page.positive_along", p=p, q=q)
    ways = (way.along for way in drawing.standing.guideways if way.slide is slide)
    return "".join(counted_from(words, slide, way) for way in ways)


def counted_from(words: Words, path: Slide | Rolling, way: complex) -> str:
    """The words for the origin and the direction of the coordinate along a line."""
    start = path.through
    where = symbol(start) if isinstance(start, str) else words("page.that_point")
    return words("page.positive", through=where, way=words(f"page.to_{nearest_side(way)}"))


def aside(drawing: Drawing, slide: Slide) -> dict[str, str]:
    """The distance of a block's point from its guide line, and the side."""
    words, line = drawing.words, drawing.guide(slide)
    sign = 1 if float(slide.offset.si(drawing.scene.values)) > 0 else -1
    offset = slide.offset if sign > 0 else slide.offset.negative()
    amount = quantity_text(drawing.scene, words, offset)
    if line:
        return {"offset": amount, "side": words(f"page.{nearest_side(1j * line[1] * sign)}")}
    return {"offset": amount, "side": words("page.left" if sign > 0 else "page.right")}


ROUNDED = 6
"""Length of a module that is written in full, where the scene does not write it."""


def wheels(scene: Scene, words: Words) -> Iterator[str]:
    """The wheels with centre and radius; of gears, whose numbers are apart, the centres."""
    for name, sign, wheel in each_wheel(scene, words):
        fields = {"k": name, "centre": symbol(wheel.centre)}
        if wheel.teeth is None:
            assert wheel.radius is not None
            fields["r"] = of_wheel("r", sign)
            fields["radius"] = after_parameter(scene, words, wheel.radius, "r")
        key = "ring" if wheel.inside else "wheel"
        yield words(f"page.{key}{'_teeth' if wheel.teeth else ''}", **fields)


def each_wheel(scene: Scene, words: Words) -> Iterator[tuple[str, str, Wheel]]:
    """The wheels of all links, each with its name and the label of its symbols."""
    for link in (scene.frame, *scene.links.values()):
        for wheel in link.wheels:
            sign = link.wheel_sign(wheel)
            name = words("page.fixed") if link.name == FRAME else escape(link.name)
            yield escape(sign) if len(link.wheels) > 1 else name, sign, wheel


def gears(scene: Scene, words: Words) -> Iterator[Datum]:
    """The numbers of teeth of gears and their module, once where it is that of all."""
    found = [(sign, wheel) for _, sign, wheel in each_wheel(scene, words) if wheel.teeth]
    modules = {sign: module(scene, words, wheel) for sign, wheel in found}
    for sign, wheel in found:
        assert wheel.teeth is not None
        teeth, by = wheel.teeth, tuple(filter(None, [lone(scene, wheel.teeth)]))
        value = after_parameter(scene, words, teeth, "z")
        yield Datum(name=of_wheel("z", sign), value=value, of=teeth, parameters=by)
    alike = len({*modules.values()}) == 1
    for sign, value in [*modules.items()][: 1 if alike else None]:
        yield Datum(name="*m*" if alike else of_wheel("m", sign), value=value)


def module(scene: Scene, words: Words, wheel: Wheel) -> str:
    """The module of a gear: the diameter of its pitch circle over its number of teeth.

    A module that follows from the distance of the centres is rounded.
    """
    assert wheel.radius is not None and wheel.teeth is not None
    size = 2 * wheel.radius.number(scene.values) / wheel.teeth.number(scene.values)
    text = shortest(size)
    if wheel.sized and len(text) > ROUNDED:
        text = f"{float(size):.{ROUNDED - 1}g}"
    return f"{words.decimal(text)} {words.spelled(wheel.radius.written_unit)}"


def tracks(drawing: Drawing) -> Iterator[str]:
    """Each rolling pair with its contact point and its start, and that it does not slip."""
    scene, words = drawing.scene, drawing.words
    letters = contact_letters(scene)
    for link in scene.every_link:
        for rolling, contact in zip(link.rolls, letters.get(link.name, ()), strict=True):
            own, there = wheels_of(drawing, link, rolling)
            fields = {"k": escape(own), "touch": symbol(contact)}
            if rolling.angle is None:
                toothed = any(w.teeth for w in (*link.wheels, *scene.link(rolling.on).wheels))
                start = start_on_wheel(drawing, link, rolling)
                fixed = "_fixed" if there == FRAME and len(scene.frame.wheels) < 2 else ""
                key = f"page.meshes{fixed}" if toothed else f"page.rolls{fixed or '_wheel'}"
                if belt := rolling.belt:
                    alike = "_alike" if scene.turn_alike(link.name, rolling) else ""
                    key = f"page.belt{'_crossed' if belt.crossed else ''}{fixed}{alike}"
                yield words(key, other=escape(there), start=start, **fields)
            else:
                fields["side"] = words("page.beneath" if rolling.side < 0 else "page.upon")
                fields["start"] = start_on_track(drawing, link, rolling)
                fields["positive"] = positive_track(drawing, link, rolling)
                if keeper := scene.links.get(rolling.keeper):
                    fields["side"] += which_way(drawing, keeper, keeper.slides[0])
                key = "page.rack" if any(w.teeth for w in link.wheels) else "page.rolls"
                if link.name == FRAME:
                    key, fields["k"] = "page.rolls_on_drum", escape(rolling.on)
                yield words(key, line=straight(drawing, rolling), **fields)
    if any(link.rolls for link in scene.every_link):
        yield words("page.no_slip")
    yield from whole_turns(drawing)


def wheels_of(drawing: Drawing, link: Link, rolling: Rolling) -> tuple[str, str]:
    """The names of a wheel and of the wheel on which it rolls or to which a belt joins it."""
    if rolling.belt is not None:
        on = drawing.scene.link(rolling.on)
        own, there = rolling.pairs(link.wheels, on.wheels)[0]
        return link.wheel_sign(own), on.wheel_sign(there)
    touch = next((each for each in drawing.standing.touches if each.rolling is rolling), None)
    if touch is None:
        return link.name, rolling.on
    return touch.disc.sign, touch.other.sign if touch.other else rolling.on


def whole_turns(drawing: Drawing) -> Iterator[str]:
    """The whole turns of links since the start, where wheels depend on them."""
    scene, words = drawing.scene, drawing.words
    rolls = [rolling for link in scene.every_link for rolling in link.rolls]
    steps = drawing.trace.program.steps
    counted = {counted_link(steps[number]) for number in drawing.trace.values}
    for link in scene.links.values():
        if link.name not in counted or (link.name in scene.unseen and link.slides):
            continue
        stated = next((each.turns[link.name] for each in rolls if link.name in each.turns), None)
        turns = "0" if stated is None else words.decimal(stated.written(scene.values))
        key = "page.turned_half" if turns == "0" else "page.turned_whole"
        yield words(key, axis=axis_of(drawing, link), turns=turns)


def start_on_track(drawing: Drawing, link: Link, rolling: Rolling) -> str:
    """The words for the contact point and the angles of a wheel on a track at the start.

    On a moving track the angle is relative to the track's link. The angle of that link is added if
    it is stated.
    """
    named, words = rolling.through, drawing.words
    through = symbol(named) if isinstance(named, str) else words("page.that_point")
    turned = drawing.scene.link(rolling.on) if link.name == FRAME else link
    angles = start_angle(drawing, turned, rolling)
    if FRAME not in (link.name, rolling.on):
        to = axis_of(drawing, drawing.scene.link(rolling.on))
        angles = words("page.start_angle_to", angle=angles, axis=to)
        if rolling.on in rolling.start:
            own = start_angle(drawing, drawing.scene.link(rolling.on), rolling)
            angles = words("list_mark").join((angles, own))
    return words("page.start", through=through, angles=angles)


def start_on_wheel(drawing: Drawing, link: Link, rolling: Rolling) -> str:
    """The words for the angles of two wheels and of their arm at the start."""
    scene, found = drawing.scene, []
    on = scene.link(rolling.on)
    centres = {wheel.centre for each in (link, on) for wheel in each.wheels}
    for each in scene.links.values():
        arm = len(centres & set(each.points)) > 1
        if each.name in (link.name, on.name) or arm:
            found.append(start_angle(drawing, each, rolling))
    return drawing.words("page.counted", angles=drawing.words("list_mark").join(found))


def start_angle(drawing: Drawing, link: Link, rolling: Rolling) -> str:
    """The words for the angle of a link where a rolling starts; 0° where none is written."""
    angle = rolling.start.get(link.name)
    turn = quantity_text(drawing.scene, drawing.words, angle) if angle else "0°"
    return drawing.words("page.start_angle", axis=axis_of(drawing, link), angle=turn)


def positive_track(drawing: Drawing, link: Link, rolling: Rolling) -> str:
    """The words for the positive direction of a track along which a driver rolls a wheel."""
    if not any(d.kind == "roll" and d.link == link.name for d in drawing.scene.drivers):
        return ""
    touches = (touch for touch in drawing.standing.touches if touch.rolling is rolling)
    return "".join(counted_from(drawing.words, rolling, touch.along) for touch in touches)


def closures(drawing: Drawing) -> Iterator[str]:
    """The sentence for the chosen closure of each group of higher class."""
    groups = [*constructions(drawing.trace.program, ClosesGroup)]
    for name, branch in drawing.scene.branches.items():
        if isinstance(branch, Closure):
            yield next(kind for kind in groups if name in kind.closes).branch_words(drawing)


# --- the data as names and values ----------------------------------------------------------------


class Datum(Struct, frozen=True):
    """One of the data as markup: a value with its ``name`` and a remark, or words alone.

    ``sign`` is printed between name and value. A rate may be ``constant`` and have a ``sense``,
    which follows its name after a ``colon``. ``of`` is the printed quantity, ``parameters`` are the
    parameters that set it. ``by_rate`` says that it holds for the driver's stated rate alone.
    """

    words: str = ""
    name: str = ""
    value: str = ""
    sign: str = " = "
    constant: str = ""
    sense: str = ""
    colon: str = ": "
    of: Quantity | None = None
    parameters: tuple[str, ...] = ()
    by_rate: bool = False

    @property
    def said(self) -> str:
        """The datum as a piece of a sentence."""
        if not self.value:
            return self.remark
        text_of_value = " = ".join(filter(None, (self.value, self.constant)))
        return self.name + self.sign + text_of_value + (f", {self.sense}" if self.sense else "")

    @property
    def remark(self) -> str:
        """The remark of the datum, apart from its value."""
        if self.constant:
            return f"{self.name} = {self.constant}" + (f", {self.sense}" if self.sense else "")
        return f"{self.name}{self.colon}{self.sense}" if self.sense else self.words


def given(drawing: Drawing, *, solved: bool = True, laws: bool = False) -> list[str]:
    """The data of a scene as short pieces of markup, in the order of the scene.

    Unless ``solved``, the numbers that a student computes from the parameters are left out. With
    ``laws`` their expressions are printed instead, where no form next to them shows these.
    """
    return [datum.said for datum in data(drawing, solved=solved, laws=laws)]


def data(drawing: Drawing, *, solved: bool = True, laws: bool = False) -> list[Datum]:
    """The data of a scene with names and values apart; for the arguments see ``given``."""
    scene, words = drawing.scene, drawing.words
    sentences = [
        *sides(scene, words),
        *(
            of_guide(drawing, link, slide)
            for link in scene.bare.links.values()
            if link.name not in scene.cam_links
            for slide in link.slides
        ),
        *wheels(scene, words),
        *tracks(drawing),
        *arcs(scene, words),
        *cams(drawing),
        *closures(drawing),
    ]
    notes = (escape(note) for note in [scene.notes.get(words.language)] if note)
    return [
        *(
            Datum(name=name, value=value, parameters=(of,))
            for of, name, value in other_parameters(scene, words)
        ),
        *(
            piece
            for driver in scene.drivers
            for piece in of_driver(scene, words, driver, solved=solved, laws=laws)
        ),
        *lengths(scene, words),
        *gears(scene, words),
        *fixed_points(scene, words),
        *plates(drawing),
        *map(Datum, sentences),
        *(Datum(said, by_rate=True) for said in of_scales(drawing)),
        *map(Datum, notes),
    ]


def arcs(scene: Scene, words: Words) -> Iterator[str]:
    """The links that turn in the hollow of another link, along an arc about a common centre."""
    for link in scene.every_link:
        for hollow in (each for each in link.profiles if each.hollow):
            for other in scene.every_link:
                for arc in (each for each in other.profiles if each.about == hollow.about):
                    if other is not link and not arc.hollow:
                        ends = {"p": symbol(arc.through), "q": symbol(hollow.through)}
                        links = {"g": escape(other.name), "k": escape(link.name)}
                        yield words("page.arcs", centre=symbol(arc.about), **links, **ends)


def cams(drawing: Drawing) -> Iterator[str]:
    """Each cam with the tip of its follower, its circles and its law, piece by piece."""
    scene, words = drawing.scene, drawing.words
    for follower, cam in scene.cams.items():
        fields = {"g": escape(cam.on), "k": escape(follower)}
        fields["tip"] = cam_tip(scene, words, cam)
        base = quantity_text(scene, words, cam.base)
        senses = ("cam_forward", "cam_backward") if cam.slides else ("cam_counter", "cam_clockwise")
        sense = words(f"page.{senses[cam.sense < 0]}")
        start = words("page.cam_start", angle=quantity_text(scene, words, cam.start))
        turned = sense + ("" if cam.start.is_zero() else start)
        key = "page.cam_plate" if cam.slides else "page.cam"
        if cam.slides:
            fields["p"] = symbol(cam.pivot)
        if cam.lever:
            line, pin = bar(cam.pivot, cam.lever.pin), symbol(cam.lever.pin)
            fields["side"] = words("page.cam_left" if cam.lever.side > 0 else "page.cam_right")
            fields |= {"q": pin} if cam.slides else {"line": line}
            key += "_lever"
        yield words(key, base=base, **fields)
        if cam.carrier != FRAME and not cam.slides:
            yield words("page.cam_seen", g=fields["g"], c=escape(cam.carrier))
        if cam.conjugate:
            radius, at = (
                quantity_text(scene, words, cam.conjugate.roller),
                symbol(cam.conjugate.at),
            )
            yield words("page.cam_conjugate", radius=radius, p=at, **fields)
        if cam.slopes:
            points = cam_points(scene, words, cam)
            yield words("page.cam_table", sense=turned, points=points, **fields)
            continue
        first, *rest = (cam_piece(scene, words, piece) for piece in cam.law)
        by = "page.cam_plate_by" if cam.slides else "page.cam_by"
        yield words(by, sense=turned, piece=first, **fields)
        yield from rest


def cam_tip(scene: Scene, words: Words, cam: Cam) -> str:
    """What touches the cam; the face of a lever lies along its bar or at a distance from it."""
    if cam.lever and cam.is_flat:
        line, gap = bar(cam.lever.pin, cam.point), quantity_text(scene, words, cam.lever.face)
        beside = "" if cam.lever.face.is_zero() else words("page.cam_beside", gap=gap)
        return words("page.cam_face", bar=line) + beside
    return words(f"page.cam_{cam.tip}", radius=quantity_text(scene, words, cam.roller))


def cam_points(scene: Scene, words: Words, cam: Cam) -> str:
    """The points of a table, one at each end of a cubic."""
    at, lift, unit = exact(0, cam.law[0].to.unit), Fraction(0), cam.law[0].rise.unit
    points = []
    for piece in cam.law:
        height = number_of(scene, words, exact(lift))
        points.append(f"{quantity_text(scene, words, at)}{words('colon')}{height}")
        at, lift = piece.to, lift + piece.rise.number(scene.values)
    return ", ".join(points) + f" ({words.spelled(unit)})"


def cam_piece(scene: Scene, words: Words, piece: CamPiece) -> str:
    """A piece of a law: where it ends, and by which motion it lifts or lowers."""
    to, rise = quantity_text(scene, words, piece.to), piece.rise
    size = rise.number(scene.values)
    if size == 0:
        return words("page.cam_dwell", to=to)
    motion = words(f"page.motion_{piece.motion.replace(' ', '_')}")
    size = quantity_text(scene, words, rise if size > 0 else rise.negative())
    key = "page.cam_rise" if rise.number(scene.values) > 0 else "page.cam_return"
    return words(key, to=to, size=size, motion=motion)


def of_scales(drawing: Drawing) -> Iterator[str]:
    """The stated scale factors of the plans, so that a student can follow the scene."""
    m = drawing.scales.of_bar(drawing.kind)
    stated = drawing.kind == "acceleration" and drawing.scene.sheet.ka is not None
    if m not in (0, 1) and not stated:
        change = "enlarged" if m > 1 else "reduced"
        yield drawing.words(f"page.{change}_{drawing.kind}", m=figure(drawing, m))


def of_driver(
    scene: Scene, words: Words, driver: Driver, *, solved: bool = True, laws: bool = False
) -> Iterator[Datum]:
    """The position, speed and acceleration of a driver."""
    if laws and not solved and has_own_relation(scene, driver.position):
        yield Datum(name=angle_symbol(scene, driver), value=law(scene, words, driver.position))
    elif solved or not has_own_relation(scene, driver.position):
        angle = in_degrees(scene, words, driver.position)
        place = after_parameter(scene, words, driver.position) + (f" = {angle}" if angle else "")
        yield Datum(name=angle_symbol(scene, driver), value=place, of=driver.position)
    steady = driver.acceleration.is_zero()
    rates = [(speed_symbol(driver), driver.speed, words("page.constant") if steady else "")]
    if not steady:
        rate = words.signs.in_sentence("*ε*") if driver.kind == "turn" else "*a*"
        rates.append((f"{rate}_{{{driver_index(driver)}}}", driver.acceleration, ""))
    for name, quantity, constant in rates:
        if not solved and is_derived(quantity):
            continue  # its law gives its sense, too
        size, sense = with_sense(scene, words, driver, quantity)
        text_of_value = size if solved or not has_own_relation(scene, quantity) else ""
        if laws and not text_of_value:
            text_of_value = law(scene, words, quantity)
        if text_of_value or constant or sense:
            by = tuple(filter(None, [lone(scene, quantity)]))
            yield Datum(
                name=name,
                value=text_of_value,
                constant=constant,
                sense=sense,
                colon=words("colon"),
                of=quantity,
                parameters=by,
            )


def with_sense(scene: Scene, words: Words, driver: Driver, quantity: Quantity) -> tuple[str, str]:
    """The speed or acceleration of a driver; for a crank, its magnitude and its sense in words."""
    value = float(quantity.si(scene.values))
    if driver.kind != "turn" or not value:
        return after_parameter(scene, words, quantity), ""
    if value > 0:
        return after_parameter(scene, words, quantity), words("page.turning_anticlockwise")
    return quantity_text(scene, words, quantity.negative()), words("page.turning_clockwise")


def lengths(scene: Scene, words: Words) -> Iterator[Datum]:
    """The lengths of bars; bars of equal length together."""
    equal: dict[str, list[str]] = {}
    first: dict[str, Quantity] = {}
    for link in scene.bare.every_link:
        for placing in link.placings:
            for p, q, length in lengths_of(placing):
                text = after_parameter(scene, words, length)
                equal.setdefault(text, []).append(bar(p, q))
                first.setdefault(text, length)
    for text, bars in equal.items():
        by = tuple(filter(None, [lone(scene, first[text])]))
        yield Datum(name=" = ".join(bars), value=text, of=first[text], parameters=by)


def set_parameters(scene: Scene, words: Words, names: Iterable[str]) -> list[str]:
    """Some parameters as markup, as the data print them; the length of a bar by its name."""
    bars = {name: datum.said for datum in lengths(scene, words) for name in datum.parameters}
    return [bars.get(name) or parameter(scene, words, name) for name in names]


def fixed_points(scene: Scene, words: Words) -> Iterator[Datum]:
    """The coordinates of the frame's points."""
    for placing in scene.frame.placings:
        if isinstance(placing, At):
            value = placed(scene, words, placing)
            yield Datum(name=symbol(placing.point), value=value, sign=" ")


def plates(drawing: Drawing) -> Iterator[Datum]:
    """The points of links that are given by coordinates or by an angle."""
    scene, words = drawing.scene, drawing.words
    for link in scene.every_link:
        fixed = link is scene.frame
        if not fixed:
            yield from on_link(scene, words, link)
        for placing in link.placings:
            point = symbol(placing.point)
            if isinstance(placing, Polar):
                key = "page.polar_frame" if fixed else "page.polar"
                fields = {"bar": bar(placing.start, placing.point), "axis": axis_of(drawing, link)}
                yield Datum(words(key, angle=quantity_text(scene, words, placing.angle), **fields))
            elif isinstance(placing, Angled):
                arms, angle = [symbol(placing.arm), point], placing.angle
                if placing.clockwise:  # written from the point that it places
                    arms, angle = arms[::-1], angle.negative()
                name = f"∠{arms[0]}{symbol(placing.vertex)}{arms[1]}"
                text_of_value = quantity_text(scene, words, angle)
                within = abs(float(angle.si(scene.values))) < math.pi  # the side gives its sense
                yield Datum(
                    name=name, value=text_of_value.removeprefix("−") if within else text_of_value
                )


def on_link(scene: Scene, words: Words, link: Link) -> Iterator[Datum]:
    """The points of a moving link with coordinates in its axes; a single one is its origin.

    A point with coordinates in the axes of several links has the index of the link, which the
    remark explains.
    """
    places = coordinates_on(link)
    if len(places) < 2:
        return
    often = Counter(p.point for each in scene.every_link for p in coordinates_on(each))
    names = [
        symbol(letter(under(p.point, link.name)) if often[p.point] > 1 else p.point) for p in places
    ]
    for name, placing in zip(names, places, strict=True):
        yield Datum(name=name, value=placed(scene, words, placing), sign=" ")
    own = [symbol(p.point) for p in places]
    told = [
        name if name == point else f"{name} ≡ {point}"
        for name, point in zip(names, own, strict=True)
    ]
    axes = words("page.on_link", k=escape(link.name))
    yield Datum(f"{words('list_mark').join(told)}{words('colon')}{axes}")


def coordinates_on(link: Link) -> list[At]:
    """The points of a link with coordinates in its axes."""
    return [placing for placing in link.placings if isinstance(placing, At)]


def placed(scene: Scene, words: Words, placing: At) -> str:
    """The coordinates of a point with their unit."""
    x, y = (number_of(scene, words, q) for q in (placing.x, placing.y))
    return f"{words.place(x, y)} {words.spelled(placing.x.written_unit)}"


def sides(scene: Scene, words: Words) -> Iterator[str]:
    """The sides on which points of plates and of closures lie."""
    for link in (scene.frame, *scene.links.values()):
        for placing in link.placings:
            if isinstance(placing, Triangle):
                yield side(words, placing.point, placing.first, placing.second, placing.side)
            elif isinstance(placing, Angled):
                way = math.sin(float(placing.angle.si(scene.values)))
                if abs(way) > 1e-9:
                    yield side(
                        words, placing.point, placing.vertex, placing.arm, 1 if way > 0 else -1
                    )
            elif isinstance(placing, OnLine) and placing.by_parts:
                parted = bar(placing.first, placing.point)
                yield words("page.on_line", point=symbol(placing.second), bar=parted)
            elif isinstance(placing, OnLine):
                is_between = (placing.start == placing.first) is (placing.sense > 0)
                key = "page.on_line" if is_between else "page.beyond"
                fields = {"point": symbol(placing.point), "start": symbol(placing.start)}
                yield words(key, bar=bar(placing.first, placing.second), **fields)
    for point, branch in scene.branches.items():
        if isinstance(branch, Side):
            yield side(words, point, branch.first, branch.second, branch.side)


def side(words: Words, point: str, p: str, q: str, sign: int) -> str:
    """The words for the side of a directed line."""
    key = "page.left_handed" if sign > 0 else "page.right_handed"
    return words(key, point=symbol(point), p=symbol(p), q=symbol(q))
