"""From bytes to tables: the limits of a file before it is read, and hints for its mistakes."""

from __future__ import annotations

import re
import tomllib
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Iterable, Iterator
from contextlib import suppress
from errno import EFBIG, EINVAL
from stat import S_ISDIR, S_ISREG
from typing import TYPE_CHECKING, Any

from graphkin.scene.expression import unit_hint
from graphkin.scene.findings import Findings, shown_key, visible
from graphkin.scene.measures import FloatText
from graphkin.text import paths
from graphkin.text.errors import (
    NO_WORDS,
    Hint,
    InLine,
    Mend,
    Message,
    Problem,
    SceneError,
    message,
    verbatim,
)

if TYPE_CHECKING:
    from graphkin.scene.toml_spans import Again, Path

LARGEST = 256 * 1024
"""The most bytes of a scene file."""
LARGEST_KEPT = 64 << 20
"""The most bytes of a file from an earlier run: a manifest, a table of marks, a reading."""
LONGEST_LINE = 4000
DOTTED = r"(?<![\w\"'.-])(?>[\w\"'-]+[ \t]*\.[ \t]*){16}"
ROUNDED = r"[=\[,]\s*(\([^][()\"']*,[^][()\"']*[])]|\[[^][()\"']*,[^][()\"']*\))"
"""A list with a round bracket."""
CURLED = "“”„‟‘’‚«»″"
"""Quotation marks that a word processor writes."""
WHERE = r"\s*\(at (?:line (\d+), column (\d+)|end of document)\)\s*$"


def read_bytes(path: paths.Named) -> bytes:
    """The bytes of a scene file, up to one beyond the limit. Raises SceneError."""
    try:
        return file_bytes(path, LARGEST + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or message("cannot be opened")
        raise SceneError.at(
            str(path), message("the scene cannot be read: {reason}", reason=reason)
        ) from None


def file_bytes(path: paths.Named, most: int) -> bytes:
    """The first ``most`` bytes of a file, without waiting for a pipe or a device.

    Raises OSError where there is no such file, ValueError for an impossible path.
    """
    mode = paths.mode(path)
    if mode and not (S_ISREG(mode) or S_ISDIR(mode)):
        raise OSError(EINVAL, "a pipe or a device is no file", str(path))
    return paths.first_bytes(path, most)


def whole_file(path: paths.Named, most: int = LARGEST_KEPT) -> bytes:
    """All bytes of a file of at most ``most`` bytes; raises OSError for a larger one."""
    data = file_bytes(path, most + 1)
    if len(data) > most:
        raise OSError(EFBIG, f"it is larger than {most >> 20} MiB", str(path))
    return data


def decoded(data: bytes) -> str:
    """The text of a scene file: UTF-8, with or without a byte order mark."""
    if len(data) > LARGEST:
        raise SceneError.at(
            "",
            message("the file is too large"),
            message("at most {most} KiB", most=LARGEST // 1024),
        )
    try:
        return data.decode().removeprefix("\ufeff")
    except UnicodeDecodeError as error:
        if data.startswith((BOM_UTF16_LE, BOM_UTF16_BE)):
            raise SceneError.at(
                "", message("the file is UTF-16"), message("a text saved as UTF-8")
            ) from None
        line = data.count(b"\n", 0, error.start) + 1
        found = message("the byte 0x{data:02x} is not UTF-8", data=data[error.start])
        raise SceneError(in_line(InLine(line), found, message("a text saved as UTF-8"))) from None


def in_line(
    at: InLine, found: Message, expected: Message = NO_WORDS, hint: Hint = NO_WORDS
) -> Problem:
    """The problem of a line at which reading stops."""
    return Problem(at.message, found, expected, hint, about=(at,))


def tables_of(text: str, findings: Findings | None = None) -> dict[str, object]:
    """The tables of a TOML text. Raises SceneError with the line where it is not TOML.

    With ``findings``, duplicate keys are recorded there and reading continues.
    """
    text = text.removeprefix("\ufeff")
    refuse_bombs(text)
    try:
        return parsed(text)
    except SceneError:
        problems, renamed, again = written_twice(text)
        if not problems:
            raise
    try:
        tables = read_once(parsed(renamed), again)
    except SceneError as other:
        raise SceneError([*problems, *other.problems]) from None
    if findings is None:
        raise SceneError(problems)
    findings.extend(problems)
    return tables


def parsed(text: str) -> dict[str, Any]:
    """The tables of a TOML text. Raises SceneError with the line where it is not TOML."""
    try:
        return tomllib.loads(text, parse_float=FloatText)
    except tomllib.TOMLDecodeError as error:
        raise SceneError(syntax_problem(str(error), text)) from None
    except (RecursionError, MemoryError):
        raise SceneError.at("", message("lists or tables nested too deeply")) from None
    except (ValueError, OverflowError) as error:
        found = message("a number or a date that cannot be read")
        raise SceneError.at("", found, hint=verbatim(str(error)[:80])) from None


def refuse_bombs(text: str) -> None:
    """Raise SceneError for text that would take long to read: a large text, line or key."""
    if len(text) > LARGEST:
        raise SceneError.at(
            "",
            message("the scene is too large"),
            message("at most {most} KiB", most=LARGEST // 1024),
        )
    for number, line in enumerate(text.splitlines(), 1):
        if len(line) > LONGEST_LINE:
            found = message("a line of {count} characters", count=len(line))
            raise SceneError(
                in_line(InLine(number), found, message("at most {most}", most=LONGEST_LINE))
            )
        if line.count(".") >= 16 and re.search(DOTTED, line):
            found = message("a key of very many parts")
            raise SceneError(in_line(InLine(number), found, message("at most 16 parts")))


def syntax_problem(error: str, text: str) -> Problem:
    """The problem that the TOML reader found, at its line."""
    where = re.search(WHERE, error)
    found = error[: where.start()] if where else error
    found = f"{found[:1].lower()}{found[1:160]}"
    line, column = len(text.splitlines()) or 1, 0
    if where and where[1]:
        line, column = int(where[1]), int(where[2])
    hint: Hint = NO_WORDS
    if found.startswith("cannot overwrite") or "twice" in found:
        hint = message("the same key or table is written above")
    lines = text.split("\n")
    if line <= len(lines):
        written = lines[line - 1]
        known = hint or value_hint(written, column - 1)
        hint = advice(found, written, column - 1, known)
    known_words = next((each for each in READER if each == found), verbatim(found))
    said = UNCLOSED if hint == OPEN else known_words
    return in_line(InLine(line, column), message("not TOML: {found}", found=said), hint=hint)


def value_hint(line: str, at: int) -> Hint:
    """A hint for a value that TOML cannot read, from its line and the index of the fault."""
    comma = re.search(r"=\s*(-?\d+,\d+)", line)
    if comma:
        pointed = comma[1].replace(",", ".")
        return Mend(comma[1], pointed, message("numbers are written with a point: 37.5"))
    bare = re.sub(r'"[^"]*"|#.*', "", line)
    if any(quote in bare for quote in CURLED):
        return message('use straight quotes: "')
    if at < 0:
        return NO_WORDS
    rounded = re.search(ROUNDED, line)
    if rounded:
        value = f"[{rounded[1][1:-1]}]"
        return Mend(
            rounded[1], value, message("a list is written in square brackets: {value}", value=value)
        )
    begins = max(line.rfind(mark, 0, at) for mark in "=[,") + 1
    value = re.split(r"[],}#]", line[begins:], maxsplit=1)[0].strip()
    if not begins or not re.fullmatch(r"[\w.°(+-][\w.°()*/^+ -]*", value):
        return NO_WORDS
    if re.fullmatch(r"[\d._ ]+", value):
        return NO_WORDS
    if re.search(r"[\d*/+(^]|^-", value):
        whole = value.count("(") == value.count(")")
        return unit_hint(value) or (in_quotes(value) if whole else NO_WORDS)
    return number_hint(line[:begins]) or in_quotes(value, text=True)


def in_quotes(value: str, *, text: bool = False) -> Mend:
    """The correction of a value that must be quoted: an expression, or a text."""
    words = message('put the expression in quotes: "{value}"', value=visible(value))
    if text:
        words = message('put the text in quotes: "{value}"', value=visible(value))
    return Mend(value, f'"{value}"', words)


READER = (
    message("invalid statement"),
    message("expected newline or end of document after a statement"),
    message("cannot overwrite a value"),
    message("expected ']' at the end of a table declaration"),
    message("expected ']]' at the end of an array declaration"),
    message("expected '=' after a key in a key/value pair"),
    message("invalid initial character for a key part"),
    message("unclosed array"),
    message("unclosed inline table"),
    message("unescaped '\\' in a string"),
    message("invalid hex value"),
    message("escaped character is not a Unicode scalar value"),
    message("unterminated string"),
    message("invalid date or datetime"),
    message("invalid value"),
)
"""What the TOML reader says, apart from messages that name a character or a key."""
PARTS = message("a line holds one heading in brackets, or one key = value, and a comment after #")
VALUE = message("a value is a number, a text in quotes, a list [ ] or a table {{ }}")
POINT = message("a point has digits on both sides: 40.0, 0.5")
HEADING = message("a heading ends as it begins: [links.2], [[drivers]]")
UNCLOSED = message("the quote of this text is not closed")
OPEN = message("put its quote at its end")
DATE = message("a date is no value of a scene: put it in quotes")
UNSEEN = message("remove the invisible character here")
COMMENT = message("a comment begins with #")
NOUGHT = message("write the number without a leading zero: 12")
NUMBER = message('a number, in the unit that units states, or an expression in quotes: "2*n"')
PLAIN = message("a number: 12")
MEASURED = frozenset(
    ("angle", "speed", "acceleration", "position", "offset", "length", "radius", "module")
)
"""Keys of numbers with a unit, except lengths and angles between points."""
COUNTED = frozenset(("value", "min", "max", "step", "teeth", "time"))
"""Keys of numbers without a unit."""
ADVICE = (
    ("expected '='", message("write = between a key and its value")),
    ("expected ']", HEADING),
    ('expected "', OPEN),
    ("invalid initial character for a key", message("keys have letters, digits, _ and -")),
    ("illegal character", OPEN),
    ("found invalid character", OPEN),
    ("unterminated string", OPEN),
    (
        "unclosed array",
        message("the list above is not closed: ] or a comma is missing before this place"),
    ),
    ("unclosed inline table", message("the table {{ }} is not closed: }} or a comma is missing")),
    ("duplicate inline table key", message("the same key occurs twice between the braces")),
    (
        "cannot mutate immutable",
        message("what is written between braces cannot be added to elsewhere"),
    ),
    ("unescaped '\\'", message("write a backslash twice, or put the text in single quotes")),
    ("invalid statement", PARTS),
)
"""Hints, by the beginning of the TOML reader's message."""
OF_KEYS = ("invalid statement", "invalid initial character", "expected '='", "expected ']'")
"""Beginnings of the TOML reader's messages about a name with a letter of another alphabet."""
LAST = "'\\n'"
"""The character that the reader names where a text is not closed on its line."""


def advice(found: str, line: str, at: int, known: Hint = NO_WORDS) -> Hint:
    """A hint for a fault in a line at an index; empty if there is none.

    ``found`` is the TOML reader's message, in lower case at its start. ``known`` is a hint derived
    from the value, which precedes a general one.
    """
    rest = line[at:].strip() if at >= 0 else ""
    return certain(found, line, rest) or known or general(found, line[: max(at, 0)], rest)


def certain(found: str, line: str, rest: str) -> Hint:
    """A hint for a fault that has only one explanation; ``rest`` is the line from the fault on."""
    if line.lstrip().startswith("[") and found.startswith("expected ']"):
        return HEADING
    if rest and rest[0].isalpha() and not rest[0].isascii() and found.startswith(OF_KEYS):
        return message(
            "“{letter}” ({code}) is no letter of a name: these are A to Z and a to z without "
            "accents",
            letter=rest[0],
            code=f"U+{ord(rest[0]):04X}",
        )
    comment = re.match(r"//|;", rest)
    if comment:
        return Mend(comment[0], "#", COMMENT)
    word = re.match(r"(True|TRUE|False|FALSE)\b", rest)
    if word:
        return Mend(word[1], word[1].lower(), message("write {lower}", lower=word[1].lower()))
    return DATE if found.startswith("invalid date") else NO_WORDS


def number_hint(before: str) -> Message:
    """A hint for a key that needs a number; empty for other keys.

    ``before`` is the line up to the value.
    """
    key = re.search(r"([\w-]+)[ \t]*=[ \t]*$", before)
    name = key[1] if key else ""
    if name in MEASURED or "-" in name:
        return NUMBER
    return PLAIN if name in COUNTED else NO_WORDS


def general(found: str, before: str, rest: str) -> Message:
    """A general hint from the reader's message and the text before and after the fault."""
    if found.startswith("invalid value"):
        if not rest or rest[0] in "#,]}":
            return message("the value is missing: {value}", value=VALUE)
        return POINT if re.match(r"[+-]?\.\d", rest) else VALUE
    if found.startswith("expected newline"):
        if re.search(r"=\s*[+-]?0$", before) and rest[:1].isdigit():
            return NOUGHT
        return POINT if rest.startswith(".") else PARTS
    if "character '" in found and LAST not in found:
        return UNSEEN
    return next((said for begins, said in ADVICE if found.startswith(begins)), NO_WORDS)


# --- keys and tables that a TOML text has twice ---------------------------------------------------


SPARE = "\ue000"
"""Start of the name that replaces a duplicate key: a character of no alphabet."""


def written_twice(text: str) -> tuple[list[Problem], str, list[Again]]:
    """The problems of duplicates, the text with the duplicates renamed, and their places."""
    from graphkin.scene.toml_spans import walked

    again = walked(text).again
    problems = [problem_of(text, each) for each in again]
    for number, each in reversed([*enumerate(again)]):
        text = f'{text[: each.key.start]}"{SPARE}{number}"{text[each.key.end :]}'
    return problems, text, again


def problem_of(text: str, each: Again) -> Problem:
    """The problem of a duplicate key or table, at its second place."""
    first, at = (text.count("\n", 0, start) + 1 for start in (each.first.start, each.key.start))
    place = InLine(at, each.key.start - text.rfind("\n", 0, each.key.start))
    found = message(
        "{path} is written twice, first in line {first}", path=dotted(each.path), first=first
    )
    if each.heading:
        said = message("one heading of a table"), message("write all of it under the first")
    else:
        said = (
            message("one value of a key"),
            message("take out one of the two, unless a heading is missing between them"),
        )
    return Problem(place.message, found, *said, about=(place,))


def dotted(path: Path) -> str:
    """A path as messages write it: ``drivers[0].speed``."""
    keys = (f"[{key}]" if isinstance(key, int) else f".{shown_key(key)}" for key in path)
    return "".join(keys).removeprefix(".")


def read_once(tables: dict[str, Any], again: Iterable[Again]) -> dict[str, Any]:
    """The tables of a renamed text: a key keeps its first value, a table gets all its keys."""
    for number, each in enumerate(again):
        own = tables.pop(f"{SPARE}{number}", None)
        if isinstance(own, dict) and isinstance(whole := inside(tables, each.path), dict):
            whole |= own | whole
    for table in within(tables):
        for key in [key for key in table if key.startswith(SPARE)]:
            del table[key]
    return tables


def inside(value: Any, path: Path) -> Any:
    """The value at a path, or None."""
    with suppress(LookupError, TypeError):
        for key in path:
            value = value[key]
        return value
    return None


def within(value: Any) -> Iterator[dict[str, Any]]:
    """A table and all tables within it."""
    if isinstance(value, dict):
        yield value
    for each in value.values() if isinstance(value, dict) else value:
        if isinstance(each, dict | list):
            yield from within(each)
