"""The crossings of a construction in words, with the names of the scene."""

from __future__ import annotations

from graphkin.construction.core.kind import ClosesGroup, construction
from graphkin.construction.core.pen import image, letter, second_image
from graphkin.construction.core.program import Part, Program
from graphkin.scene.link_points import ends_of
from graphkin.structure.pairs import name_words
from graphkin.text.tables import listed


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
