"""What is drawn because wheels touch belongs to rolling, or to gears."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, Concatenate, ParamSpec, TypeVar

from msgspec import Struct

from graphkin.construction.core.pen import Pen
from graphkin.construction.core.program import Effect
from graphkin.scene.model import FRAME, Scene
from graphkin.structure.groups import Geared, Spun, Train
from graphkin.structure.pairs import Contact, contacts, meshes

P = ParamSpec("P")
R = TypeVar("R")


def by_contact(draw: Callable[Concatenate[Pen, P], R]) -> Callable[Concatenate[Pen, P], R]:
    """All that a function draws is called for by the contact, or the group with one, it is given.

    Steps inside that another effect calls for keep to that.
    """

    @wraps(draw)
    def drawn(pen: Pen, /, *args: P.args, **options: P.kwargs) -> R:
        contact = contact_among(args)
        effect = Effect.GEARS if meshes(pen.scene, contact) else Effect.ROLLING
        with pen.calls_for(effect):
            return draw(pen, *args, **options)

    return drawn


def contact_among(args: tuple[Any, ...]) -> Contact:
    """The contact among some arguments, or that of a group among them."""
    for arg in args:
        match arg:
            case Contact():
                return arg
            case Geared(contact=contact) | Spun(contact=contact):
                return contact
            case Train(contacts=contacts):
                return contacts[0]
    raise TypeError("no contact is given")


class TouchingEffect(Struct, frozen=True):
    """Why the steps that wheels call for are in or out: those in mesh, or those that only roll."""

    effect: Effect
    in_mesh: bool
    brings: str
    lacks: str

    def touching(self, scene: Scene) -> list[str]:
        """The wheels of a scene with what they touch: 3 on 0."""
        found = (each for each in contacts(scene) if meshes(scene, each) is self.in_mesh)
        return [words_of(each) for each in found]

    def cause(self, scene: Scene) -> str:
        """The wheels that bring it in."""
        return f"{self.brings} {', '.join(self.touching(scene))}"

    def absence(self, scene: Scene) -> str:
        """That there are none."""
        return "" if self.touching(scene) else self.lacks


def words_of(contact: Contact) -> str:
    """A wheel with what it touches, or runs with by a belt."""
    wheel, on = contact.links
    other = "the frame" if on == FRAME else on
    return f"{wheel} with {other} by a belt" if contact.rolling.belt else f"{wheel} on {other}"


TOUCHING = (
    TouchingEffect(Effect.ROLLING, False, "without slip roll", "no wheel rolls along a track"),
    TouchingEffect(Effect.GEARS, True, "in mesh are", "no wheels are in mesh"),
)
"""The effects that only wheels have."""
