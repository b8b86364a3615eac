"""How to mend what is no TOML: a sentence for each thing that its reader finds amiss."""

from __future__ import annotations

import re

from graphkin.text.errors import Hint, Mend

PARTS = "a line holds one heading in brackets, or one key = value, and a comment after #"
VALUE = "a value is a number, a text in quotes, a list [ ] or a table { }"
POINT = "a point has digits on both sides: 40.0, 0.5"
HEADING = "a heading ends as it begins: [links.2], [[drivers]]"
UNCLOSED = "the quote of this text is not closed"
OPEN = "put its quote at its end"
DATE = "a date is no value of a scene: put it in quotes"
UNSEEN = "a sign that cannot be seen stands here: take it out"
COMMENT = "a comment begins with #"
NOUGHT = "a number has no zero in front: 12"
NUMBER = 'a number stands here, in the unit that units states, or an expression in quotes: "2*n"'
PLAIN = "a number stands here: 12"
MEASURED = frozenset(
    ("angle", "speed", "acceleration", "position", "offset", "length", "radius", "module")
)
"""Keys of numbers with a unit, beside those of lengths and angles between points."""
COUNTED = frozenset(("value", "min", "max", "step", "teeth", "time"))
"""Keys of numbers that no unit of the scene measures."""
ADVICE = (
    ("expected '='", "between a key and its value stands ="),
    ("expected ']", HEADING),
    ('expected "', OPEN),
    ("invalid initial character for a key", "keys have letters, digits, _ and -"),
    ("illegal character", OPEN),
    ("found invalid character", OPEN),
    ("unterminated string", OPEN),
    ("unclosed array", "the list above is not closed: ] or a comma is missing before this place"),
    ("unclosed inline table", "the table { } is not closed: } or a comma is missing"),
    ("duplicate inline table key", "the same key stands twice between the braces"),
    ("cannot mutate immutable", "what is written between braces cannot be added to elsewhere"),
    ("unescaped '\\'", "write a backslash twice, or put the text in single quotes"),
    ("invalid statement", PARTS),
)
"""How what the reader of TOML says begins, and what helps."""
LAST = "'\\n'"
"""The sign that stands where a text is not closed on its line."""


def advice(found: str, line: str, at: int, known: Hint = "") -> Hint:
    """What helps against a fault that is found in a line at an index; nothing where none is known.

    ``found`` is what the TOML reader says, its first letter small; ``known`` is a hint that comes
    of the value itself, and better than a general one.
    """
    rest = line[at:].strip() if at >= 0 else ""
    return certain(found, line, rest) or known or general(found, line[: max(at, 0)], rest)


def certain(found: str, line: str, rest: str) -> Hint:
    """What helps against a fault that can be nothing else; ``rest`` stands from the fault on."""
    if line.lstrip().startswith("[") and found.startswith("expected ']"):
        return HEADING
    comment = re.match(r"//|;", rest)
    if comment:
        return Mend(comment[0], "#", COMMENT)
    word = re.match(r"(True|TRUE|False|FALSE)\b", rest)
    if word:
        return Mend(word[1], word[1].lower(), f"write {word[1].lower()}")
    return DATE if found.startswith("invalid date") else ""


def number_hint(before: str) -> str:
    """What is to stand where a key wants a number; nothing where none is known to.

    ``before`` is the line as far as the value.
    """
    key = re.search(r"([\w-]+)[ \t]*=[ \t]*$", before)
    name = key[1] if key else ""
    if name in MEASURED or "-" in name:
        return NUMBER
    return PLAIN if name in COUNTED else ""


def general(found: str, before: str, rest: str) -> str:
    """What helps against what the reader says, by what stands before and after."""
    if found.startswith("invalid value"):
        if not rest or rest[0] in "#,]}":
            return f"the value is missing: {VALUE}"
        return POINT if re.match(r"[+-]?\.\d", rest) else VALUE
    if found.startswith("expected newline"):
        if re.search(r"=\s*[+-]?0$", before) and rest[:1].isdigit():
            return NOUGHT
        return POINT if rest.startswith(".") else PARTS
    if "character '" in found and LAST not in found:
        return UNSEEN
    return next((said for begins, said in ADVICE if found.startswith(begins)), "")
