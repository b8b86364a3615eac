"""Gaps as Moodle's embedded answers (Cloze) write them: {4:NUMERICAL:=43.5:0.8#right~%50%87:2}."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from html import escape
from math import lcm

from graphkin.classroom.quiz.gaps import Gap, Taken

SIGNS = {sign: f"&#{ord(sign)};" for sign in "{}~#\\"}
"""What means something within a gap, as references to characters, which Moodle turns back."""


def weights(points: Iterable[Fraction]) -> tuple[list[int], int]:
    """Points as whole numbers, which are the only ones that a gap may have, and how many times as
    many they are."""
    every = list(points)
    times = lcm(*(each.denominator for each in every)) if every else 1
    return [int(each * times) for each in every], times


def cloze(gap: Gap, weight: int) -> str:
    """A gap within the text of a question."""
    kind = "MULTICHOICE" if gap.item.what == "sense" else "NUMERICAL"
    return f"{{{weight}:{kind}:{'~'.join(map(taken, gap.takes))}}}"


def taken(each: Taken) -> str:
    """One thing that a gap takes; older Moodles read shares in whole percent alone."""
    share = "=" if each.share == 1 else f"%{round(100 * each.share)}%"
    if isinstance(each.answer, str):
        answer = written(each.answer)
    else:
        answer = f"{each.answer:.6g}:{each.allowed:.4g}"
    return f"{share}{answer}#{written(each.told)}"


def written(text: str) -> str:
    """A text in which nothing ends a gap or begins one."""
    return "".join(SIGNS.get(sign) or escape(sign) for sign in text)
