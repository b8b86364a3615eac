"""Problems gathered while a scene is read, so that all of them are reported at once."""

from __future__ import annotations

from collections.abc import Iterable
from string import ascii_letters

from graphkin.text import paths
from graphkin.text.errors import (
    MOST,
    NO_WORDS,
    About,
    Change,
    Hint,
    Mend,
    Message,
    Problem,
    SceneError,
    joined,
    message,
    verbatim,
)

LISTED = 12
BEGUN = 3
"""Number of first letters that two names must share for one to be near the other."""
SHORT = 2
"""Length of a name so short that one letter is more than a third of it."""
DIGITS = "0123456789"
COMBINING = "\u0300"
"""The first combining character: a text with only lower code points is already composed (NFC)."""
CYRILLIC = "\u0400", "\u0482"
"""The first and the last letter of Cyrillic before its combining characters: all are composed."""
BARE = frozenset(f"{ascii_letters}{DIGITS}-_")
"""The characters of a bare key of TOML."""


class Findings:
    """All problems found so far in one scene, and the keys that each of its tables may have."""

    def __init__(self) -> None:
        self.problems: list[Problem] = []
        self.known: dict[str, list[str]] = {}

    def add(
        self,
        place: str,
        found: Message,
        expected: Message = NO_WORDS,
        hint: Hint = NO_WORDS,
        changes: tuple[Change, ...] = (),
        about: tuple[About, ...] = (),
    ) -> None:
        """Note one problem."""
        self.extend([Problem(place, found, expected, hint, changes, about)])

    def extend(self, problems: Iterable[Problem]) -> None:
        """Note problems, each only once; stop when there are more than an error can hold."""
        for problem in problems:
            if problem not in self.problems:
                self.problems.append(problem)
            if len(self.problems) > MOST:
                self.stop()

    def inside(self, place: str) -> bool:
        """Whether a problem was found at a place or within it."""
        return any(
            problem.place == place or problem.place.startswith((f"{place}.", f"{place}["))
            for problem in self.problems
        )

    def stop(self) -> None:
        """Raise an error if anything was found: SceneError, or the error of a subclass."""
        if self.problems:
            raise SceneError(self.problems)


WHOLE = ("graphkin", "title", "time", "module", "gravity")
"""Top-level keys that hold no table: written below a heading, they belong to that table."""
ABOVE = message("it belongs at the top of the file, above the first heading in brackets")


class Table:
    """A table of the file whose keys are taken one by one; keys left over are unknown."""

    def __init__(self, place: str, raw: dict[str, object], findings: Findings) -> None:
        self.place = place
        self.findings = findings
        self.raw = raw
        self.known = findings.known.setdefault(place, [])

    def __contains__(self, key: str) -> bool:
        return key in self.raw

    def at(self, key: str) -> str:
        return f"{self.place}.{shown_key(key)}" if self.place else shown_key(key)

    def wrong(
        self,
        key: str,
        found: Message,
        expected: Message = NO_WORDS,
        hint: Hint = NO_WORDS,
        changes: tuple[Change, ...] = (),
    ) -> None:
        """Note a problem of a key."""
        self.findings.add(self.at(key), found, expected, hint, changes)

    def take(self, key: str) -> object:
        """The raw value of a key, or None."""
        self.known.append(key)
        return self.raw.get(key)

    def text(self, key: str, default: str = "") -> str:
        """A string without control characters; newlines and tabs are kept."""
        raw = self.take(key)
        return default if raw is None else plain_text(self.at(key), raw, self.findings)

    def flag(self, key: str) -> bool:
        """A boolean value; False where the key is absent."""
        raw = self.take(key)
        if raw is None or isinstance(raw, bool):
            return raw is True
        self.wrong(key, shown(raw), message("true or false"))
        return False

    def choice(self, key: str, words: tuple[str, ...], default: str = "") -> str:
        """One of some words; the default, or the first word, where it cannot be read.

        Without a default, the key must be present.
        """
        raw = self.take(key)
        if isinstance(raw, str) and raw in words:
            return raw
        if raw is not None or not default:
            hint: Hint = NO_WORDS
            if isinstance(raw, str):
                hint = nearest(raw, words) or abbreviated(raw, words)
            found = message("is missing") if raw is None else shown(raw)
            self.wrong(key, found, listed(words), hint)
        return default or words[0]

    def table(self, key: str) -> Table:
        """A table within this one; an empty table where the key is absent."""
        raw = self.take(key)
        if raw is not None and not isinstance(raw, dict):
            self.wrong(key, shown(raw), message("a table"))
        return Table(self.at(key), raw if isinstance(raw, dict) else {}, self.findings)

    def finish(self) -> None:
        """Note each key that was not taken, with the nearest known key."""
        for key in self.raw:
            if key not in self.known:
                misplaced = self.place and key in WHOLE
                hint = ABOVE if misplaced else nearest(key, self.known)
                self.wrong(key, message("unknown key"), listed(self.known), hint)


def plain_text(place: str, raw: object, findings: Findings) -> str:
    """A printable text in NFC form; a text with control or bidirectional characters is refused."""
    if not isinstance(raw, str):
        findings.add(place, shown(raw), message("a text in quotes"))
        return ""
    first, last = CYRILLIC
    if raw.isprintable() and all(c < COMBINING or first <= c <= last for c in raw):
        return raw
    import unicodedata

    for character in raw:
        if character not in "\n\t" and unicodedata.category(character) in ("Cc", "Cf", "Cs"):
            findings.add(
                place,
                message("the control character {character!a}", character=character),
                message("printable text"),
            )
            return ""
    return unicodedata.normalize("NFC", raw)


def one_or_many(raw: object) -> list[object]:
    """A list of a value that may be written alone or as a list; [] for None."""
    if raw is None:
        return []
    return raw if isinstance(raw, list) else [raw]


def numbered(place: str, index: int, count: int) -> str:
    """The place of one of several items; a single item has no number."""
    return f"{place}[{index}]" if count > 1 else place


def nearest(name: str, known: Iterable[str]) -> Hint:
    """A correction of an unknown name to the nearest known one; "" when none is near."""
    near = near_name(name, known)
    return Mend(name, near) if near else NO_WORDS


def abbreviated(name: str, known: Iterable[str]) -> Hint:
    """A correction to the only known short form of a name: "in" for "inch"; "" if there is none."""
    short = [each for each in known if len(each) == SHORT and name.lower().startswith(each)]
    return Mend(name, short[0]) if len(short) == 1 else NO_WORDS


def near_name(name: str, known: Iterable[str]) -> str:
    """The known name nearest to an unknown one; "" when none is near.

    A name is near if it differs only in case, number or leading zeros, begins alike, or needs
    changes to at most a third of its letters, to the first one only if that is the only change. For
    a name of one or two letters, only one near name may exist: it is one letter longer or shorter,
    or it is the only known name and differs in one letter.
    """
    meant, known = name[:60].lower(), tuple(known)
    near: dict[str, tuple[int, int]] = {}
    single: list[str] = []
    for candidate in known:
        other = candidate.lower()
        short, long = sorted((len(meant), len(other)))
        begun = short >= BEGUN and other[:short] == meant[:short]
        numbered_otherwise = meant.rstrip(DIGITS) == other.rstrip(DIGITS) != ""
        padded = meant.lstrip("0") == other.lstrip("0") != ""
        sure = begun or numbered_otherwise or padded
        if sure or 3 * (long - short) <= long or long <= SHORT:
            changes = changes_between(meant, other)
            begins_alike = changes < 2 or meant[:1] == other[:1]
            if sure or (3 * changes <= long and begins_alike):
                near[candidate] = changes, abs(number_of(meant) - number_of(other))
            elif changes == 1 and (short < long or len(known) == 1):
                single.append(candidate)
    if not near and len(single) == 1:
        return single[0]
    return min(near, key=lambda candidate: near[candidate], default="")


def number_of(name: str) -> int:
    """The number at the end of a name; 0 where there is none."""
    return int(f"0{name[len(name.rstrip(DIGITS)) :]}")


def changes_between(name: str, other: str) -> int:
    """The number of letters to insert, delete, replace or swap with the next one."""
    before: list[int] = [0] * (len(other) + 1)
    row: list[int] = [*range(len(other) + 1)]
    for i, letter in enumerate(name, 1):
        earlier, before, row = before, row, [i]
        for j, sign in enumerate(other, 1):
            row.append(min(before[j] + 1, row[-1] + 1, before[j - 1] + (letter != sign)))
            if i > 1 < j and name[i - 2 : i] == sign + other[j - 2]:
                row[-1] = min(row[-1], earlier[j - 2] + 1)
    return row[-1]


def near_file(path: str, files: Iterable[str]) -> str:
    """The file whose name is nearest to a missing file's, regardless of endings; "" if none."""
    ending = path.rpartition(".")[2]
    known: dict[str, str] = {}
    for each in sorted(files, key=lambda each: each.rpartition(".")[2] != ending):
        known.setdefault(paths.stem(each), each)
    return known.get(near_name(paths.stem(path), known), "")


def listed(names: Iterable[str]) -> Message:
    """A list of names in words: "one of A, B, C"."""
    every = sorted(dict.fromkeys(names), key=natural)
    some = joined(", ", [*every[:LISTED], *(["…"] if len(every) > LISTED else [])])
    return message("one of {names}", names=some) if len(every) > 1 else some


def natural(name: str) -> tuple[bool, int, str]:
    """The sort key that puts numbered links first, by number, and names after them."""
    return (False, int(name), "") if name.isdigit() else (True, 0, name)


def shown(raw: object) -> Message:
    """A raw value as an error shows it: short, on one line, without invisible characters."""
    match raw:
        case bool():
            return verbatim(str(raw).lower())
        case str():
            return verbatim(f'"{visible(raw)}"')
        case int() if raw.bit_length() >= 200:
            return message("a very large whole number")
        case list():
            return message("a list of {count}", count=len(raw))
        case dict():
            return message("a table")
    return verbatim(visible(str(raw)))


def shown_key(key: str) -> str:
    """A key as an error shows it, in quotes unless it is a bare key."""
    return key if 0 < len(key) <= 60 and BARE.issuperset(key) else f'"{visible(key)}"'


def visible(text: str) -> str:
    """A text cut to 60 characters, with invisible characters as escapes."""
    cut = text if len(text) <= 60 else text[:57] + "…"
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in cut)
