"""What is given of slides, wheels and closures, in words."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import ClosesGroup, constructions
from graphkin.construction.core.naming import axis_of, nearest_side, straight
from graphkin.construction.core.parameter_words import after_parameter
from graphkin.construction.core.pen import letter
from graphkin.construction.core.quantities import quantity_text
from graphkin.construction.guides.dyad_by_arc_and_guide import arcs_finding
from graphkin.construction.guides.swung_guide import SwungGuide
from graphkin.construction.links.counted_turn import counted_link
from graphkin.drawing.symbol_markup import bar, escape, of_wheel, symbol
from graphkin.scene.link_points import under
from graphkin.scene.model import FRAME, Branch, Closure, Link, Rolling, Scene, Slide, Way, Wheel
from graphkin.scene.quantity import shortest
from graphkin.scene.wheels import contact_letters
from graphkin.text import Words


def of_guide(drawing: Drawing, link: Link, slide: Slide) -> str:
    """Words for a block's guide, for which of the two crossings it stands at, and what is plus."""
    fields = {"point": sliding_point(drawing, link), "way": which_way(drawing, link, slide)}
    fields["line"] = bar(*slide.along) if slide.along else straight(drawing, slide)
    fields["positive"] = positive(drawing, link, slide)
    key = f"page.{'slot' if slide.pin else 'guide'}{'' if slide.offset.is_zero() else '_beside'}"
    return drawing.words(key, **fields, **aside(drawing, slide))


def sliding_point(drawing: Drawing, link: Link) -> str:
    """The point by which a block is told: that of its link where blocks of several share it."""
    point, links = link.points[0], drawing.scene.links.values()
    shared = [each for each in links if each.slides and each.points[0] == point]
    return symbol(letter(under(point, link.name)) if len(shared) > 1 else point)


def which_way(drawing: Drawing, link: Link, slide: Slide) -> str:
    """Words for the one of two closures at which a block stands, seen from a known pin."""
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
    """What the scene states of a block, or of the pin that its guide leads where that has a way."""
    led = (
        scene.link(slide.on).points if link.rolls else (*scene.link(slide.on).points, *link.points)
    )
    ways = (scene.branches.get(point) for point in led)
    return next((way for way in ways if isinstance(way, Way)), scene.branches.get(link.name))


def is_led(drawing: Drawing, link: Link, slide: Slide) -> bool:
    """True where a guide is led through its block's known point from the end at which it begins."""
    if not slide.along or not slide.offset.is_zero():
        return False
    ends = slide.along[0], link.points[0]
    return any(each.points == ends for each in constructions(drawing.trace.program, SwungGuide))


def positive(drawing: Drawing, link: Link, slide: Slide) -> str:
    """Words for the positive sense of a guide that the data or the answers count along."""
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
    """Words for where a line is counted from, and in which direction, as it stands."""
    start = path.through
    where = symbol(start) if isinstance(start, str) else words("page.that_point")
    return words("page.positive", through=where, way=words(f"page.to_{nearest_side(way)}"))


def aside(drawing: Drawing, slide: Slide) -> dict[str, str]:
    """How far a block's point stays from the line it slides along, and on which side."""
    words, line = drawing.words, drawing.guide(slide)
    sign = 1 if float(slide.offset.si(drawing.scene.values)) > 0 else -1
    offset = slide.offset if sign > 0 else slide.offset.negative()
    amount = quantity_text(drawing.scene, words, offset)
    if line:
        return {"offset": amount, "side": words(f"page.{nearest_side(1j * line[1] * sign)}")}
    return {"offset": amount, "side": words("page.left" if sign > 0 else "page.right")}


def wheels(scene: Scene, words: Words) -> Iterator[str]:
    """The wheels: centre and radius, of gears the number of teeth and the module."""
    for link in (scene.frame, *scene.links.values()):
        for wheel in link.wheels:
            sign = link.wheel_sign(wheel)
            name = words("page.fixed") if link.name == FRAME else escape(link.name)
            yield words(
                f"page.{'ring' if wheel.inside else 'wheel'}{'_teeth' if wheel.teeth else ''}",
                **centre_and_size(scene, words, wheel, sign),
                k=escape(sign) if len(link.wheels) > 1 else name,
            )


def centre_and_size(scene: Scene, words: Words, wheel: Wheel, sign: str) -> dict[str, str]:
    """The words for a wheel's centre and size, with its symbols."""
    assert wheel.radius is not None
    fields = {"centre": symbol(wheel.centre), "r": of_wheel("r", sign), "z": of_wheel("z", sign)}
    if wheel.teeth is None:
        return {**fields, "radius": after_parameter(scene, words, wheel.radius, "r")}
    teeth = after_parameter(scene, words, wheel.teeth, "z")
    return {**fields, "teeth": teeth, "module": module(scene, words, wheel)}


def module(scene: Scene, words: Words, wheel: Wheel) -> str:
    """The module of a gear: its pitch circle's diameter over its number of teeth."""
    assert wheel.radius is not None and wheel.teeth is not None
    size = 2 * wheel.radius.number(scene.values) / wheel.teeth.number(scene.values)
    return f"{words.decimal(shortest(size))} {wheel.radius.unit}"


def tracks(drawing: Drawing) -> Iterator[str]:
    """What rolls on what in which point, and the start it counts from; that there is no slip."""
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
    """What a wheel and the other that it rolls on, or runs with by a belt, are called."""
    if rolling.belt is not None:
        own, there = rolling.belt.wheels
        on = drawing.scene.link(rolling.on)
        return link.wheel_sign(link.wheels[own]), on.wheel_sign(on.wheels[there])
    touch = next((each for each in drawing.standing.touches if each.rolling is rolling), None)
    if touch is None:
        return link.name, rolling.on
    return touch.disc.sign, touch.other.sign if touch.other else rolling.on


def whole_turns(drawing: Drawing) -> Iterator[str]:
    """How far links have turned since the start, where wheels depend on it and pins do not say."""
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
    """Words for where a wheel touches a straight track at the start, and how it then stands.

    On a moving track the angle is that to the track's link; its own is told if it is stated.
    """
    named, words = rolling.through, drawing.words
    through = symbol(named) if isinstance(named, str) else words("page.that_point")
    turned = drawing.scene.link(rolling.on) if link.name == FRAME else link
    angles = stands(drawing, turned, rolling)
    if FRAME not in (link.name, rolling.on):
        to = axis_of(drawing, drawing.scene.link(rolling.on))
        angles = words("page.stands_to", stands=angles, axis=to)
        if rolling.on in rolling.start:
            own = stands(drawing, drawing.scene.link(rolling.on), rolling)
            angles = words("list_mark").join((angles, own))
    return words("page.start", through=through, angles=angles)


def start_on_wheel(drawing: Drawing, link: Link, rolling: Rolling) -> str:
    """Words for the angles of a wheel, of the one it rolls on and of their arm at the start."""
    scene, found = drawing.scene, []
    on = scene.link(rolling.on)
    centres = {wheel.centre for each in (link, on) for wheel in each.wheels}
    for each in scene.links.values():
        arm = len(centres & set(each.points)) > 1
        if each.name in (link.name, on.name) or arm:
            found.append(stands(drawing, each, rolling))
    return drawing.words("page.counted", angles=drawing.words("list_mark").join(found))


def stands(drawing: Drawing, link: Link, rolling: Rolling) -> str:
    """Words for the angle of a link where a rolling starts; nought where none is written."""
    angle = rolling.start.get(link.name)
    turn = quantity_text(drawing.scene, drawing.words, angle) if angle else "0°"
    return drawing.words("page.stands", axis=axis_of(drawing, link), angle=turn)


def positive_track(drawing: Drawing, link: Link, rolling: Rolling) -> str:
    """Words for the positive sense of a track along which a driver rolls a wheel."""
    if not any(d.kind == "roll" and d.link == link.name for d in drawing.scene.drivers):
        return ""
    touches = (touch for touch in drawing.standing.touches if touch.rolling is rolling)
    return "".join(counted_from(drawing.words, rolling, touch.along) for touch in touches)


def closures(drawing: Drawing) -> Iterator[str]:
    """Which of the ways in which a group of higher class closes is meant."""
    groups = [*constructions(drawing.trace.program, ClosesGroup)]
    for name, branch in drawing.scene.branches.items():
        if isinstance(branch, Closure):
            yield next(kind for kind in groups if name in kind.closes).branch_words(drawing)
