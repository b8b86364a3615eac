"""A student of a class list."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct, field


class Student(Struct, frozen=True):
    """One row of a class list; ``row`` is its line in the file, ``extra`` its other columns.

    ``number`` is the student's number in the group, None if the list has none. ``id`` keeps its
    leading zeros.

    A student with several sheets has an entry for each ``part``, counted from 1. Its id is that of
    the ``owner`` in the class list with the number of the part.
    """

    row: int
    id: str
    number: int | None = None
    name: str = ""
    group: str = ""
    extra: Mapping[str, str] = field(default_factory=dict)
    owner: str = ""
    part: int = 0

    @property
    def whose(self) -> str:
        """The id of the student in the class list."""
        return self.owner or self.id

    @property
    def called(self) -> str:
        """The student's name and id, as notes name a student."""
        return f"{self.name} ({self.id})" if self.name else self.id
