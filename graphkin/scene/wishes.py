"""What is chosen and asked: branches of assembly, results, the sheet, its titles and notes."""

from __future__ import annotations

from datetime import date, datetime
from fractions import Fraction

from graphkin.scene.findings import Findings, Table, listed, nearest, plain_text, shown
from graphkin.scene.measures import Measures
from graphkin.scene.model import FRAME, Ask, Branch, Sheet
from graphkin.scene.quantity import Quantity, exact
from graphkin.scene.words import asked_point, branch_words, link_name

LANGUAGES = ("en", "it", "ro")
POINTS_ASKED = ("velocity", "acceleration")
LINKS_ASKED = ("omega", "epsilon", "poles", "centres", "centrodes", "slides")
BRANCH_WORDS = '"left of P-Q", "right of P-Q", "forward", "backward" or "closure 1"'
MOST = 500


def read_branches(table: Table, findings: Findings) -> dict[str, Branch]:
    """The chosen closures, by the name of a pin or of a link."""
    branches: dict[str, Branch] = {}
    for key, raw in table.raw.items():
        branch = branch_words(raw) if isinstance(raw, str) else None
        name = link_name(table.at(key), key, findings)
        if branch is None:
            findings.add(table.at(key), shown(raw), BRANCH_WORDS)
        elif name == FRAME:
            findings.add(
                table.at(key), "a branch of the frame, which is at rest", "a pin or a link"
            )
        elif name is not None:
            branches[name] = branch
    return branches


def read_ask(table: Table, findings: Findings) -> Ask:
    """What is asked; each key holds a list of points or of links."""
    points = {key: asked(table, key, findings, of_points=True) for key in POINTS_ASKED}
    links = {key: asked(table, key, findings, of_points=False) for key in LINKS_ASKED}
    table.finish()
    return Ask(**points, **links)


def asked(table: Table, key: str, findings: Findings, *, of_points: bool) -> tuple[str, ...]:
    """The names in one list, each once."""
    raw = table.take(key)
    if raw is None:
        return ()
    if not isinstance(raw, list) or len(raw) > MOST:
        what = '["A", "B"]' if of_points else "[2, 3]"
        findings.add(table.at(key), shown(raw), f"a list, such as {what}")
        return ()
    names: list[str] = []
    for index, each in enumerate(raw):
        place = f"{table.at(key)}[{index}]"
        name = (asked_point if of_points else link_name)(place, each, findings)
        if name == FRAME:
            findings.add(place, "the frame, which is at rest", "a moving link")
        elif name is not None and name not in names:
            names.append(name)
    return tuple(names)


def read_sheet(table: Table, measures: Measures) -> Sheet:
    """The title block: owner, author, approved, date, number; the language, scale and sheets."""
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


def read_languages(table: Table, findings: Findings) -> dict[str, str]:
    """A text per language: ``ro = "…"``, ``en = "…"``."""
    texts = {language: table.text(language) for language in LANGUAGES if language in table}
    table.known.extend(LANGUAGES)
    table.finish()
    return texts
