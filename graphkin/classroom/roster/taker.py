"""A student of a class with assigned data: the owner of printed sheets and of graded answers."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct

from graphkin.classroom.roster.language_names import language_in
from graphkin.classroom.roster.student import Student


class Taker(Struct, frozen=True):
    """A student who takes part: the parameters of the student's variant, exact and as written.

    ``compute`` are the fields too small to measure, which the student computes. ``code`` is the
    opaque name on the sheets. ``language`` and ``email`` are those of the class list.
    """

    student: Student
    settings: Mapping[str, str]
    code: str = ""
    compute: tuple[str, ...] = ()
    language: str = ""
    email: str = ""

    @property
    def spoken(self) -> str | None:
        """The code of the student's language; None if the student has the language of the class."""
        return language_in(self.language)
