"""What a link slides or rolls on, and its wheels."""

from __future__ import annotations

from fractions import Fraction

from msgspec.structs import replace

from graphkin.scene.expression import Number
from graphkin.scene.expression import Pair as Product
from graphkin.scene.findings import Table, numbered, one_or_many, shown
from graphkin.scene.measures import FloatText, Measures, Pair
from graphkin.scene.model import FRAME, Belt, Rolling, Slide, Wheel
from graphkin.scene.phrases import SIDES, line_words, link_name, point_name
from graphkin.scene.quantity import Quantity

MOST = 20
GUIDE = "the link that carries the guide, 0 for the frame"
OTHER = "the link that carries the other wheel, 0 for the frame"
TRACK = "the link that carries the track or the other wheel, 0 for the frame"


def tables(table: Table, key: str) -> list[Table]:
    """The tables of a key that may hold one or a list of them."""
    raws = one_or_many(table.take(key))
    if len(raws) > MOST:
        table.findings.add(table.at(key), f"a list of {len(raws)}", f"at most {MOST}")
    found = []
    for index, raw in enumerate(raws[:MOST]):
        place = numbered(table.at(key), index, len(raws))
        if isinstance(raw, dict):
            found.append(Table(place, raw, table.findings))
        else:
            table.findings.add(place, shown(raw), "a table { … }, or a list of them")
    return found


def read_slides(table: Table, measures: Measures) -> tuple[Slide, ...]:
    """The guides of a block."""
    return tuple(read_slide(each, measures) for each in tables(table, "slides"))


def read_slide(table: Table, measures: Measures) -> Slide:
    """One guide: ``{ on, through, angle, offset }`` or ``{ on, along = "P-Q", offset }``."""
    on = link_name(table.at("on"), table.take("on"), measures.findings, GUIDE) or FRAME
    raw = table.take("along")
    through, angle, along = None, None, None
    if raw is None:
        through, angle = read_line(table, measures)
    else:
        along = line_words(table.at("along"), raw, measures.findings)
        for key in ("through", "angle"):
            if table.take(key) is not None:
                expected = 'either along = "P-Q", or through and angle'
                measures.findings.add(table.at(key), f"{key} beside along", expected)
    offset = read_offset(table, measures)
    pin = table.flag("pin")
    table.finish()
    return Slide(on, through, angle, along, offset, pin)


def read_offset(table: Table, measures: Measures) -> Quantity:
    """The distance kept to the left of a guide, nought where it is not written."""
    raw = table.take("offset")
    return measures.length(table.at("offset"), 0 if raw is None else raw)


def read_line(table: Table, measures: Measures) -> tuple[str | Pair | None, Quantity | None]:
    """A line by a point that it passes through and its angle to the x axis of its link."""
    raw, turned = table.take("through"), table.take("angle")
    if raw is None:
        expected = 'through = "P" or [x, y], with an angle, or along = "P-Q"'
        measures.findings.add(table.place, "no through", expected)
    elif turned is None:
        measures.findings.add(table.place, "through without an angle", "angle = …")
    through: str | Pair | None
    if isinstance(raw, list):
        through = measures.point(table.at("through"), raw)
    elif raw is None:
        through = None
    elif isinstance(raw, str) and not isinstance(raw, FloatText):
        through = point_name(table.at("through"), raw, measures.findings)
    else:
        through, expected = None, 'the name of a point, "P", or two coordinates [x, y]'
        measures.findings.add(table.at("through"), shown(raw), expected)
    angle = None if turned is None else measures.angle(table.at("angle"), turned)
    return through, angle


def read_wheels(table: Table, measures: Measures, module: Quantity | None) -> tuple[Wheel, ...]:
    """The wheels of a link, from ``wheel`` or ``wheels``."""
    both = tables(table, "wheel") + tables(table, "wheels")
    return tuple(read_wheel(each, measures, module) for each in both)


def read_wheel(table: Table, measures: Measures, module: Quantity | None) -> Wheel:
    """One wheel: a centre, with a radius, or with teeth whose module makes the radius."""
    centre = point_name(table.at("centre"), table.take("centre"), measures.findings) or ""
    raw_radius, raw_teeth, own = table.take("radius"), table.take("teeth"), table.take("module")
    if own is not None:
        module = measures.length(table.at("module"), own, positive=True)
    radius = teeth = None
    if raw_teeth is not None:
        teeth = read_teeth(table.at("teeth"), raw_teeth, measures)
    if raw_radius is not None:
        radius = measures.length(table.at("radius"), raw_radius, positive=True)
        if own is not None:
            measures.findings.add(table.at("module"), "module beside radius", "one of the two")
    elif teeth is not None and module is not None:
        radius = pitch_radius(teeth, module)
    else:
        found = "no radius" if teeth is None else "teeth without a module"
        hint = "" if teeth is None else "a module at the top of the file is that of every wheel"
        measures.findings.add(table.place, found, "radius = …, or teeth = … and module = …", hint)
    inside = table.flag("inside")
    table.finish()
    return Wheel(centre, radius, teeth, inside)


def read_teeth(place: str, raw: object, measures: Measures) -> Quantity:
    """A whole number of teeth."""
    teeth = measures.number(place, raw, positive=True)
    value = teeth.number(measures.values)
    if not isinstance(value, Fraction) or value.denominator != 1:
        measures.findings.add(place, shown(raw), "a whole number of teeth")
    return teeth


def pitch_radius(teeth: Quantity, module: Quantity) -> Quantity:
    """Half the module times the number of teeth."""
    tree = Product("/", Product("*", module.tree, teeth.tree), Number(Fraction(2)))
    text = f"({module.text})*({teeth.text})/2"
    return Quantity(text, tree, module.unit, teeth.place)


def read_rolls(table: Table, measures: Measures) -> tuple[Rolling, ...]:
    """The tracks, straight or circular, that the wheels of a link roll on."""
    return tuple(read_rolling(each, measures) for each in tables(table, "rolls"))


def read_rolling(table: Table, measures: Measures) -> Rolling:
    """One track: ``{ on, through, angle, start, turns, side, link }``; a wheel's has no line."""
    on = link_name(table.at("on"), table.take("on"), measures.findings, TRACK) or FRAME
    through, angle = None, None
    if "through" in table or "angle" in table:
        through, angle = read_line(table, measures)
    start = by_link(table, "start", measures, measures.units["angle"])
    turns = by_link(table, "turns", measures, "")
    raw = table.take("side")
    side = SIDES.get(raw) if isinstance(raw, str) else None
    if raw is not None and side is None:
        measures.findings.add(table.at("side"), shown(raw), '"left" or "right"')
    if raw is not None and "through" not in table:
        measures.findings.add(table.at("side"), "a side without through", "a straight track")
    table.take("through"), table.take("angle")
    keeper = ""
    if (name := table.take("link")) is not None:
        keeper = link_name(table.at("link"), name, measures.findings) or ""
    table.finish()
    return Rolling(on, through, angle, start, side or 1, turns, keeper=keeper)


def read_drums(table: Table, measures: Measures) -> tuple[Rolling, ...]:
    """The bars that roll on wheels of the frame; ``start`` gives the angle of the bar.

    Against the bar the wheel is then turned as far the other way.
    """
    found = []
    for rolling in read_rolls(table, measures):
        start = dict(rolling.start)
        if rolling.on in start and rolling.through is not None:
            start.setdefault(FRAME, start[rolling.on].negative())
        found.append(replace(rolling, start=start))
    return tuple(found)


def read_belts(table: Table, measures: Measures) -> tuple[Rolling, ...]:
    """The belts that run from the wheels of a link to those of others."""
    return tuple(read_belt(each, measures) for each in tables(table, "belt"))


def read_belt(table: Table, measures: Measures) -> Rolling:
    """One belt: ``{ on, crossed, wheels, start, turns }``; ``wheels`` count from one."""
    on = link_name(table.at("on"), table.take("on"), measures.findings, OTHER) or FRAME
    crossed, raw = table.flag("crossed"), table.take("wheels")
    wheels = (1, 1)
    match raw:
        case [int(own), int(other)] if 0 < own <= MOST and 0 < other <= MOST:
            wheels = own, other
        case _ if raw is not None:
            expected = "[1, 2]: the wheel of this link and that of the other, counted from 1"
            measures.findings.add(table.at("wheels"), shown(raw), expected)
    start = by_link(table, "start", measures, measures.units["angle"])
    turns = by_link(table, "turns", measures, "")
    table.finish()
    belt = Belt(crossed, (wheels[0] - 1, wheels[1] - 1))
    return Rolling(on, None, None, start, 1, turns, belt)


def by_link(table: Table, key: str, measures: Measures, unit: str) -> dict[str, Quantity]:
    """A number for each link named in a table: an angle of ``start``, a count of ``turns``."""
    found: dict[str, Quantity] = {}
    inner = table.table(key)
    for link, raw in inner.raw.items():
        name = link_name(inner.at(link), link, measures.findings)
        number = measures.number(inner.at(link), raw, unit)
        if name is not None:
            found[name] = number
    return found
