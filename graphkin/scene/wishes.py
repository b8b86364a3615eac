"""What is chosen and asked: branches of assembly, results, the sheet, its titles and notes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from datetime import date, datetime
from fractions import Fraction
from itertools import combinations

from graphkin.scene.findings import Findings, Table, listed, nearest, plain_text, shown
from graphkin.scene.measures import Measures
from graphkin.scene.model import FRAME, Ask, Branch, Sheet
from graphkin.scene.quantity import Quantity, exact
from graphkin.scene.words import asked_point, branch_hint, branch_words, link_name, point_name

LANGUAGES = ("en", "it", "ro")
POINTS_ASKED = ("velocity", "acceleration")
PATHS_ASKED = "curves"
LINKS_ASKED = ("omega", "epsilon", "poles", "centrodes", "slides", "inflection")
ALL = "all"
"""Asks for the relative centres of all links."""
BRANCH_WORDS = '"left of P-Q", "right of P-Q", "forward", "backward" or "closure 1"'
MOST = 500


def read_branches(table: Table, findings: Findings) -> dict[str, Branch]:
    """The chosen closures, by the name of a pin or of a link."""
    branches: dict[str, Branch] = {}
    for key, raw in table.raw.items():
        branch = branch_words(raw) if isinstance(raw, str) else None
        name = link_name(table.at(key), key, findings)
        if branch is None:
            findings.add(table.at(key), shown(raw), BRANCH_WORDS, branch_hint(raw))
        elif name == FRAME:
            findings.add(
                table.at(key), "a branch of the frame, which is at rest", "a pin or a link"
            )
        elif name is not None:
            branches[name] = branch
    return branches


def read_ask(table: Table, findings: Findings, links: Sequence[str] = ()) -> Ask:
    """What is asked; each key holds a list of points or of links. ``links`` are all, as written."""
    points = {key: names_asked(table, key, findings, asked_point) for key in POINTS_ASKED}
    of_links = {key: names_asked(table, key, findings, moving_link) for key in LINKS_ASKED}
    curves = names_asked(table, PATHS_ASKED, findings, point_name)
    centres, pairs = centres_asked(table, findings, (FRAME, *links))
    table.finish()
    return Ask(**points, **of_links, centres=centres, pairs=pairs, curves=curves)


def names_asked(
    table: Table, key: str, findings: Findings, read: Callable[[str, object, Findings], str | None]
) -> tuple[str, ...]:
    """The names in one list, each once."""
    found = (read(place, each, findings) for place, each in items(table, key, findings, read))
    return tuple(dict.fromkeys(name for name in found if name is not None))


def items(table: Table, key: str, findings: Findings, read: object) -> Iterator[tuple[str, object]]:
    """Each item of a list with its place; a problem is noted when there is no list."""
    raw = table.take(key)
    if isinstance(raw, list) and len(raw) <= MOST:
        yield from ((f"{table.at(key)}[{index}]", each) for index, each in enumerate(raw))
    elif raw is not None:
        what = "[2, 3]" if read is moving_link else '["A", "B"]'
        findings.add(table.at(key), shown(raw), f"a list, such as {what}")


def moving_link(place: str, raw: object, findings: Findings) -> str | None:
    """The name of a link; not that of the frame, which is at rest."""
    name = link_name(place, raw, findings)
    if name == FRAME:
        findings.add(place, "the frame, which is at rest", "a moving link")
        return None
    return name


def centres_asked(
    table: Table, findings: Findings, links: Sequence[str]
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The links and the pairs of links whose centres are asked: 2, "2-4", or "all" pairs."""
    if table.raw.get("centres") == ALL:
        table.take("centres")
        return (), tuple("-".join(pair) for pair in combinations(links, 2))
    centres: list[str] = []
    pairs: list[str] = []
    for place, raw in items(table, "centres", findings, moving_link):
        if raw == ALL:
            pairs += ["-".join(pair) for pair in combinations(links, 2)]
        elif isinstance(raw, str) and "-" in raw:
            pairs += link_pair(place, raw, findings, links)
        elif name := moving_link(place, raw, findings):
            centres.append(name)
    return tuple(dict.fromkeys(centres)), tuple(dict.fromkeys(pairs))


def link_pair(place: str, raw: str, findings: Findings, links: Sequence[str]) -> list[str]:
    """Two links with a dash, in the order of the scene; none, with a problem noted, if not so."""
    first, _, second = raw.replace(" ", "").partition("-")
    names = [link_name(place, name, findings) for name in (first, second)]
    if None in names:
        return []
    if names[0] == names[1]:
        findings.add(place, f"{shown(raw)} is one link twice", 'two links, such as "2-4"')
        return []
    rank = {name: number for number, name in enumerate(links)}
    return ["-".join(sorted((str(name) for name in names), key=lambda n: rank.get(n, len(rank))))]


def read_sheet(table: Table, measures: Measures) -> Sheet:
    """The title block: owner, author, approved, date, number; the language, scales and sheets."""
    findings = measures.findings
    language = table.text("language", "en")
    if language not in LANGUAGES:
        hint = nearest(language, LANGUAGES)
        findings.add(table.at("language"), shown(language), listed(LANGUAGES), hint)
    sheets = table.take("sheets")
    if sheets is not None and (isinstance(sheets, bool) or sheets not in (1, 2)):
        findings.add(table.at("sheets"), shown(sheets), "1 or 2")
        sheets = None
    sheet = Sheet(
        owner=table.text("owner"),
        author=table.text("author"),
        approved=table.text("approved"),
        date=lenient_text(table, "date"),
        number=lenient_text(table, "number"),
        language=language,
        scale=read_scale(table, measures),
        sheets=2 if not isinstance(sheets, int) else sheets,
        enlarge=read_positive(table, measures, "enlarge"),
        ka=read_positive(table, measures, "ka"),
    )
    table.finish()
    return sheet


def lenient_text(table: Table, key: str) -> str:
    """A text that may also be written as a TOML date or a whole number."""
    raw = table.take(key)
    if isinstance(raw, date | datetime):
        return raw.isoformat()
    if isinstance(raw, int) and not isinstance(raw, bool):
        return shown(raw)
    return "" if raw is None else plain_text(table.at(key), raw, table.findings)


def read_scale(table: Table, measures: Measures) -> Quantity | None:
    """The scale kL, real over drawn: 5 or ``"1:5"``; None where it is left to the page."""
    raw, place = table.take("scale"), table.at("scale")
    if raw is None:
        return None
    parts = raw.split(":") if isinstance(raw, str) else []
    if len(parts) == 2 and all(part.strip().isdecimal() and len(part) < 9 for part in parts):
        drawn, true = int(parts[0]), int(parts[1])
        if drawn and true:
            return Quantity(str(raw), exact(Fraction(true, drawn)).tree, "", place)
    return measures.number(place, raw, positive=True)


def read_positive(table: Table, measures: Measures, key: str) -> Quantity | None:
    """A number above nought, None where it is not written."""
    raw = table.take(key)
    return None if raw is None else measures.number(table.at(key), raw, positive=True)


def read_languages(table: Table, findings: Findings) -> dict[str, str]:
    """A text per language: ``ro = "…"``, ``en = "…"``."""
    texts = {language: table.text(language) for language in LANGUAGES if language in table}
    table.known.extend(LANGUAGES)
    table.finish()
    return texts
