"""Problems collected while a scene is read, so that all of them are reported at once."""

from __future__ import annotations

from collections.abc import Iterable

from graphkin.text import paths
from graphkin.text.errors import MOST, About, Change, Hint, Mend, Problem, SceneError

LISTED = 12
BEGUN = 3
"""Initial letters that a name and a longer one must share for either to be near the other."""
DIGITS = "0123456789"
COMBINING = "\u0300"
"""The first combining character; text below it is already composed."""


class Findings:
    """All problems found so far in one scene, and the permitted keys of each of its tables."""

    def __init__(self) -> None:
        self.problems: list[Problem] = []
        self.known: dict[str, list[str]] = {}

    def add(
        self,
        place: str,
        found: str,
        expected: str = "",
        hint: Hint = "",
        changes: tuple[Change, ...] = (),
        about: tuple[About, ...] = (),
    ) -> None:
        """Record one problem."""
        self.extend([Problem(place, found, expected, hint, changes, about)])

    def extend(self, problems: Iterable[Problem]) -> None:
        """Record new problems; raise when there are more than an error can hold."""
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
        """Raise SceneError, or the error of the file at hand, if anything was found."""
        if self.problems:
            raise SceneError(self.problems)


WHOLE = ("graphkin", "title", "time", "module")
"""Keys of a whole scene that are not tables; below a heading they would belong to its table."""
ABOVE = "it belongs at the top of the file, above the first heading in brackets"


class Table:
    """A table of the file whose keys are read one by one; those left over are unknown."""

    def __init__(self, place: str, raw: dict[str, object], findings: Findings) -> None:
        self.place = place
        self.findings = findings
        self.raw = raw
        self.known = findings.known.setdefault(place, [])

    def __contains__(self, key: str) -> bool:
        return key in self.raw

    def at(self, key: str) -> str:
        """The place of one key."""
        return f"{self.place}.{shown_key(key)}" if self.place else shown_key(key)

    def take(self, key: str) -> object:
        """The raw value of a key, or None without one."""
        self.known.append(key)
        return self.raw.get(key)

    def text(self, key: str, default: str = "") -> str:
        """A string without control characters; newlines and tabs are kept."""
        raw = self.take(key)
        return default if raw is None else plain_text(self.at(key), raw, self.findings)

    def flag(self, key: str) -> bool:
        """True or false; false where the key is missing."""
        raw = self.take(key)
        if raw is None or isinstance(raw, bool):
            return raw is True
        self.findings.add(self.at(key), shown(raw), "true or false")
        return False

    def choice(self, key: str, words: tuple[str, ...], default: str = "") -> str:
        """One of some words, or the first on an error; required if there is no default."""
        raw = self.take(key)
        if isinstance(raw, str) and raw in words:
            return raw
        if raw is not None or not default:
            hint = nearest(raw, words) if isinstance(raw, str) else ""
            found = "is missing" if raw is None else shown(raw)
            self.findings.add(self.at(key), found, listed(words), hint)
        return default or words[0]

    def table(self, key: str) -> Table:
        """A table within this one, empty where it is missing."""
        raw = self.take(key)
        if raw is not None and not isinstance(raw, dict):
            self.findings.add(self.at(key), shown(raw), "a table")
        return Table(self.at(key), raw if isinstance(raw, dict) else {}, self.findings)

    def finish(self) -> None:
        """Record each unread key, with the nearest known one."""
        for key in self.raw:
            if key not in self.known:
                misplaced = self.place and key in WHOLE
                hint = ABOVE if misplaced else nearest(key, self.known)
                self.findings.add(self.at(key), "unknown key", listed(self.known), hint)


def plain_text(place: str, raw: object, findings: Findings) -> str:
    """A printable text in composed letters (NFC); control and bidi characters are refused."""
    if not isinstance(raw, str):
        findings.add(place, shown(raw), "a text in quotes")
        return ""
    if raw.isprintable() and all(letter < COMBINING for letter in raw):
        return raw
    import unicodedata

    for character in raw:
        if character not in "\n\t" and unicodedata.category(character) in ("Cc", "Cf", "Cs"):
            findings.add(place, f"the control character {character!a}", "printable text")
            return ""
    return unicodedata.normalize("NFC", raw)


def one_or_many(raw: object) -> list[object]:
    """A value that may be written alone or as a list, as a list; empty where it is missing."""
    if raw is None:
        return []
    return raw if isinstance(raw, list) else [raw]


def numbered(place: str, index: int, count: int) -> str:
    """The place of one of several; a single one has no number."""
    return f"{place}[{index}]" if count > 1 else place


def nearest(name: str, known: Iterable[str]) -> Hint:
    """The correction of an unknown name to the nearest known one; empty when none is near."""
    near = near_name(name, known)
    return Mend(name, near) if near else ""


def near_name(name: str, known: Iterable[str]) -> str:
    """The known name nearest to an unknown one; empty when none is near.

    A name is near if it differs by case or number, begins alike, or needs changes in at most a
    third of its letters.
    """
    meant = name[:60].lower()
    near: dict[str, tuple[int, int]] = {}
    for candidate in known:
        other = candidate.lower()
        short, long = sorted((len(meant), len(other)))
        begun = short >= BEGUN and other[:short] == meant[:short]
        numbered_otherwise = meant.rstrip(DIGITS) == other.rstrip(DIGITS) != ""
        if begun or numbered_otherwise or 3 * (long - short) <= long:
            changes = changes_between(meant, other)
            if begun or numbered_otherwise or 3 * changes <= long:
                near[candidate] = changes, abs(number_of(meant) - number_of(other))
    return min(near, key=lambda candidate: near[candidate], default="")


def number_of(name: str) -> int:
    """The number at the end of a name, 0 where it has none."""
    return int(f"0{name[len(name.rstrip(DIGITS)) :]}")


def changes_between(name: str, other: str) -> int:
    """The number of letters to insert, leave out, replace or exchange with the next one."""
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
    """The existing file whose name is nearest to a missing one, whatever their endings."""
    ending = path.rpartition(".")[2]
    known: dict[str, str] = {}
    for each in sorted(files, key=lambda each: each.rpartition(".")[2] != ending):
        known.setdefault(paths.stem(each), each)
    return known.get(near_name(paths.stem(path), known), "")


def listed(names: Iterable[str]) -> str:
    """A short list of names: one of A, B, C."""
    every = sorted(dict.fromkeys(names), key=natural)
    some = ", ".join(every[:LISTED]) + (", …" if len(every) > LISTED else "")
    return f"one of {some}" if len(every) > 1 else some


def natural(name: str) -> tuple[bool, int, str]:
    """Sort key that puts numbered links in order of number, before names."""
    return (False, int(name), "") if name.isdigit() else (True, 0, name)


def shown(raw: object) -> str:
    """A raw value as shown in an error: short, on one line, with nothing invisible."""
    match raw:
        case bool():
            return str(raw).lower()
        case str():
            return f'"{visible(raw)}"'
        case int():
            return str(raw) if raw.bit_length() < 200 else "a very large whole number"
        case list():
            return f"a list of {len(raw)}"
        case dict():
            return "a table"
    return visible(str(raw))


def shown_key(key: str) -> str:
    """A key as shown in an error, in quotes when it is not a bare key."""
    bare = key.isascii() and all(c.isalnum() or c in "-_" for c in key) and key
    return key if bare and len(key) <= 60 else f'"{visible(key)}"'


def visible(text: str) -> str:
    """A text cut to 60 characters, with invisible ones written as escapes."""
    cut = text if len(text) <= 60 else text[:57] + "…"
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in cut)
