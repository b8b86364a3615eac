"""What is drawn because wheels touch belongs to rolling, or to gears."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, Concatenate, ParamSpec, TypeVar

from graphkin.construction.core.effect import Effect
from graphkin.construction.core.pen import Pen
from graphkin.structure.groups import Geared, Train
from graphkin.structure.pairs import Contact, meshes

P = ParamSpec("P")
R = TypeVar("R")


def by_contact(draw: Callable[Concatenate[Pen, P], R]) -> Callable[Concatenate[Pen, P], R]:
    """All that a function draws is called for by the contact, or the group with one, it is given.

    Steps inside that another effect calls for, such as a normal component, keep to that.
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
            case Geared(contact=contact):
                return contact
            case Train(contacts=contacts):
                return contacts[0]
    raise TypeError("no contact is given")
