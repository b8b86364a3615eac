"""The vector equations of a plan: motions about pins and along guides, and what is given.

What is not crossed in the plan but computed and laid off stands with its numbers.
"""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.construction.core.component import laid_off as component_laid_off
from graphkin.construction.core.drawn_scene import TAGS, Drawing
from graphkin.construction.core.kind import construction
from graphkin.construction.core.naming import (
    index_of,
    is_driven,
    rate_symbol,
    vector_of,
    way_of,
)
from graphkin.construction.core.plan_vector import sign_of
from graphkin.construction.core.program import Step
from graphkin.construction.core.relation import Relation, answer, figure, length_of
from graphkin.construction.core.too_short import laid_off
from graphkin.construction.sentence_fields import fields_of
from graphkin.construction.step_sentences import in_line
from graphkin.drawing.symbol_markup import bar, symbol


def of_equations(drawing: Drawing) -> list[tuple[str, Relation]]:
    """The equations of a plan in the order of drawing, each once, with the rate that it takes."""
    found: dict[str, tuple[str, Relation]] = {}
    for number, step, _ in drawing.steps(drawing.plane):
        if drawing.tags.get(number) == TAGS[1]:
            continue
        for relation in of_step(drawing, number, step):
            taken = rate_taken(drawing, step) if relation.symbols else ""
            found.setdefault(relation.left + relation.symbols, (taken, relation))
    return list(found.values())


def of_step(drawing: Drawing, number: int, step: Step) -> Iterator[Relation]:
    """The equations that belong to one step of a plan."""
    tried = number in drawing.tags
    kind = construction(step)
    if kind is not None and (equation := kind.equation(drawing)):
        yield equation
    match step.action.key if step.action else "":
        case "square-to":
            yield euler(drawing, step)
        case "parallel-to":
            yield from along(drawing, number, step)
        case "turned-velocity" if not is_pin_of_driver(drawing, step, step.args[3]):
            yield euler(drawing, step)
            if not tried:
                yield turned(drawing, step, "v", "ω")
        case "centripetal":
            driven = is_pin_of_driver(drawing, step, step.args[3])
            if not (driven and step.name):
                yield euler(drawing, step, steady=bool(step.name))
            if not driven:
                yield turned(drawing, step, "a", "ω")
        case "driven-tangential" if not tried and not is_pin_of_driver(drawing, step, step.args[3]):
            yield turned(drawing, step, "a", "ε")
        case "driven-slide" if tried:
            yield along_way(drawing, step.says["q"], step)
        case "driven-slide":
            yield given_along(drawing, number, step, drawing.vector.letter)
        case "similar-point" if step.by_hand not in drawing.trace.values:
            yield similar(drawing, step)
        case "alike":
            yield alike(drawing, step)


def rate_taken(drawing: Drawing, step: Step) -> str:
    """The symbol of the rate of this sheet by which a step computes its vector."""
    match step.action.key if step.action else "":
        case "turned-velocity":
            return rate_symbol(drawing, step.args[3])
        case "driven-tangential":
            return rate_symbol(drawing, step.args[3], "ε")
    return ""


def is_pin_of_driver(drawing: Drawing, step: Step, rate: int) -> bool:
    """True for a pin of a crank on the frame, of which the driver's own relations tell."""
    return is_driven(drawing, rate) and step.says["p"] in drawing.scene.frame.points


# --- about a pin ---------------------------------------------------------------------------------


def euler(drawing: Drawing, step: Step, *, steady: bool = False) -> Relation:
    """Euler's theorem for the motion of a pin about another, or about a fixed pivot.

    What turns ``steady`` gives no tangential component.
    """
    p, q = step.says["p"], step.says["q"]
    pin, pivot = step.says.get("w", q), step.says.get("x", p)
    index, letter = index_of(drawing, step.says), drawing.vector.letter
    fixed = index == pin
    key = f"calculation.{'about' if fixed else 'euler'}_{drawing.kind}"
    key = "calculation.euler_steady" if steady else key
    fields = {
        "whole": symbol(f"{letter}_{pin}"),
        "start": symbol(f"{letter}_{pivot}"),
        "relative": symbol(f"v_{index}"),
        "normal": symbol(f"a_{index}^ν"),
        "tangential": symbol(f"a_{index}^τ"),
    }
    return Relation(drawing.words(key, bar=bar(p, q), p=symbol(p), q=symbol(q), **fields))


def turned(drawing: Drawing, step: Step, letter: str, rate: str) -> Relation:
    """What a known turning gives a point: rate times bar, or its square for the normal part."""
    p, q, index = step.says["p"], step.says["q"], index_of(drawing, step.says)
    value, length = abs(float(drawing.trace.values[step.args[3]])), length_of(drawing, p, q)
    kind = {"v": "", "a": "^ν" if rate == "ω" else "^τ"}[letter]
    square = "^2" if kind == "^ν" else ""
    size = value * value * length if square else value * length
    remark = drawing.words("calculation.square_to", bar=bar(p, q))
    if square:
        remark = laid_off(drawing, "laid_off", size, p=symbol(p), q=symbol(q))
    return Relation(
        symbol(f"{letter}_{index}{kind}"),
        f"{rate_symbol(drawing, step.args[3], rate)}{square}·{bar(p, q)}",
        f"{figure(drawing, value, 6)}{square}·{figure(drawing, length)}",
        answer(drawing, size),
        "m/s" if letter == "v" else "m/s^2",
        remark,
        over=(p, q),
    )


def similar(drawing: Drawing, step: Step) -> Relation:
    """The image of a point of a link by similarity to the link."""
    letter = drawing.vector.letter
    fields = {**fields_of(drawing, step, step.says), "name": symbol(step.name)}
    key = "similar_in_line" if in_line(drawing, step) else "similar"
    vector = symbol(f"{letter}_{step.says.get('w', step.says['r'])}")
    return Relation(drawing.words(f"calculation.{key}", vector=vector, **fields))


def alike(drawing: Drawing, step: Step) -> Relation:
    """The image of a point of a link that only shifts: all its points move as one."""
    letter = drawing.vector.letter
    whole, start = (symbol(f"{letter}_{step.says[key]}") for key in "qp")
    return Relation(drawing.words("calculation.alike", whole=whole, start=start))


# --- along a guide -------------------------------------------------------------------------------


def along(drawing: Drawing, number: int, step: Step) -> Iterator[Relation]:
    """The motion along a guide of the point that is found on its parallel."""
    sought = found_on(drawing, number)
    if sought:
        yield along_way(drawing, sought, step)


def along_way(drawing: Drawing, sought: str, step: Step) -> Relation:
    """The motion of a point along a guide: alone where that stands still, else on its point's."""
    point, beneath = slider(drawing, sought, step)
    velocity, guide = drawing.kind == "velocity", way_of(drawing, step.says["g"])
    letter = drawing.vector.letter
    if drawing.trace.program.steps[step.args[0]].name == drawing.pole:
        name = symbol(f"{letter}_{beneath if '@' in sought else point}")
        return Relation(drawing.words("calculation.along_guide", name=name, guide=guide))
    fields = {
        "whole": symbol(f"{letter}_{point}"),
        "start": symbol(f"{letter}_{beneath}"),
        "relative": symbol(f"{letter}_{point}{beneath}" + ("" if velocity else "^r")),
    }
    laid, key = component_laid_off(drawing.trace.program, step.args[0]), "sliding"
    if laid is not None:
        fields["component"] = symbol(f"a_{point}{beneath}^{laid.component.sign}")
        key = "with_component"
    return Relation(drawing.words(f"calculation.{key}", guide=guide, **fields))


def found_on(drawing: Drawing, number: int) -> str:
    """The point whose image is found on a line of a plan; nothing where none is."""
    found = [drawing.results.get(child, child) for child in drawing.children.get(number, ())]
    users = [drawing.trace.program.steps[child] for child in found]
    return next((user.says["q"] for user in users if "q" in user.says), "")


def slider(drawing: Drawing, sought: str, step: Step) -> tuple[str, str]:
    """The point that slides and the one beneath it on the guide, as the index of symbols."""
    point, _, link = sought.partition("@")
    block = drawing.scene.links[step.says["g"]]
    if not link:
        link = block.paths[0].on if point in block.points else block.name
    return point, point + ("" if link.isdigit() and point[-1].isalpha() else ",") + link


def given_along(drawing: Drawing, number: int, step: Step, letter: str) -> Relation:
    """The given motion of a driven slider along its guide."""
    vector = vector_of(drawing, step.args[0], number, symbol(f"{letter}_{step.says['q']}"))
    return Relation(
        vector,
        symbol(f"{letter}_{step.says['g']}"),
        "",
        answer(drawing, abs(float(drawing.trace.values[step.args[2]]))),
        "m/s" if letter == "v" else "m/s^2",
        f"∥ {way_of(drawing, step.says['g'])}",
    )


def is_laid_off(drawing: Drawing, step: Step) -> bool:
    """True for a component that was not found by the plan but computed and laid off."""
    kind = sign_of(step)
    if kind in ("ν", "c"):
        return True
    tip = drawing.trace.program.steps[step.args[1]].action
    return kind == "τ" and tip is not None and tip.key == "driven-tangential"
