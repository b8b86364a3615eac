"""A student of a class who got data: whose sheets are printed, and whose answers are marked."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct

from graphkin.classroom.roster.language_names import language_in
from graphkin.classroom.roster.student import Student


class Taker(Struct, frozen=True):
    """A student who takes part: the parameters of the own variant, exact and as written.

    ``compute`` are fields too small to be measured, which are computed; ``code`` is the opaque name
    on the sheets, ``language`` and ``email`` what the class list says of the student's.
    """

    student: Student
    settings: Mapping[str, str]
    code: str = ""
    compute: tuple[str, ...] = ()
    language: str = ""
    email: str = ""

    @property
    def spoken(self) -> str | None:
        """The code of the student's language; None where it is that of the class."""
        return language_in(self.language)
