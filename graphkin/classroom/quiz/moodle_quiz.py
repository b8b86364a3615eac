"""A lab as a question bank in Moodle's XML format, with a category for each variant.

A question holds the task as pictures, its sheets as a PDF to print, and a gap for each field. A
quiz takes a random question from each student's category, or from all categories, and Moodle marks
it with the tolerances of that variant.
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import partial
from html import escape
from math import isnan, lcm
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from markupsafe import Markup
from msgspec import Struct
from msgspec.structs import replace

from graphkin.classroom.form_page import KINDS, advice, first_pivot
from graphkin.classroom.grading.class_marking import Book
from graphkin.classroom.grading.explanations import CauseWay, ways_of
from graphkin.classroom.grading.feedback import SENSES, how
from graphkin.classroom.grading.graded import BLANK
from graphkin.classroom.grading.marking import Marker
from graphkin.classroom.grading.standard import sense_is_open
from graphkin.classroom.lab.lab_model import Item, Lab, exact_text
from graphkin.classroom.lab.lab_trial import students_of
from graphkin.classroom.printing.print_run import FORM, PrintOrder, Sheets
from graphkin.classroom.printing.workers import chunks, engine, results
from graphkin.classroom.roster.students import Student, Taker
from graphkin.classroom.variants.assign import Assigned, assigned
from graphkin.construction.core.given_data import variant
from graphkin.construction.core.quantities import CLOCKWISE
from graphkin.documents.sheet_documents import language_of
from graphkin.drawing.richtext import plain
from graphkin.text import Words
from graphkin.writers.templates import from_template, marked_up

WHOLE = Fraction(1)


class Taken(Struct, frozen=True):
    """An answer that a gap accepts; the first one that fits counts.

    ``answer`` is a text or a number with the tolerance ``allowed``, ``share`` the part of the
    points it earns, and ``feedback`` what Moodle shows for it.
    """

    answer: str | float
    allowed: float
    share: Fraction
    feedback: str

    def in_units(self, one: float) -> Taken:
        """The answer as a multiple of a unit."""
        if one == 1 or isinstance(self.answer, str):
            return self
        return replace(self, answer=self.answer / one, allowed=self.allowed / one)


class Gap(Struct, frozen=True):
    """One field of a question: its points and the answers it accepts, the correct one first."""

    item: Item
    points: Fraction
    takes: tuple[Taken, ...]


def gaps(marker: Marker, points: Mapping[str, Fraction], words: Words) -> tuple[Gap, ...]:
    """The gaps of a variant: its fields that earn points and have a value.

    The value that a cause gives earns what the cause leaves of all points, since a gap knows
    nothing of the others.
    """
    blank = dict.fromkeys(marker.standard.key, BLANK)
    ways = ways_of(marker.standard, blank, frozenset())
    found = []
    for item in marker.standard.items:
        worth = points.get(item.field)
        if worth and not isnan(marker.standard.key[item.field]):
            takes = sensed(marker, item, words) if item.what == "sense" else ()
            takes = takes or (*keyed(marker, item, words), *caused(marker, item, ways, words))
            found.append(Gap(item, worth, tuple(each.in_units(item.one) for each in takes)))
    return tuple(found)


def keyed(marker: Marker, item: Item, words: Words) -> Iterator[Taken]:
    """The correct value; for a rate also its negative, because the sense has a gap of its own."""
    standard = marker.standard
    right, allowed = standard.key[item.field], standard.tolerance[item.field].value
    feedback = words("feedback.right")
    size = item.size(right)
    yield Taken(size, allowed, WHOLE, feedback)
    if item.beside("sense") in standard.key and size:
        yield Taken(-size, allowed, WHOLE, feedback)


def sensed(marker: Marker, item: Item, words: Words) -> tuple[Taken, ...]:
    """Both senses; each is correct if no drawing can decide the sense."""
    standard, turning = marker.standard, item.quantity in CLOCKWISE
    is_open = sense_is_open(standard, item.field)
    right, wrong = words("feedback.right"), plain(words("feedback.wrong_sense"))
    found = []
    for positive in (True, False):
        good = is_open or (standard.key[item.field] > 0) == positive
        share, feedback = (WHOLE, right) if good else (Fraction(), wrong)
        found.append(Taken(words(SENSES[turning, positive]), 0.0, share, feedback))
    return tuple(found)


def caused(marker: Marker, item: Item, ways: Sequence[CauseWay], words: Words) -> Iterator[Taken]:
    """The values that causes in the construction give; of two equal values only the first."""
    standard, field, seen = marker.standard, item.field, list[tuple[float, float]]()
    right, own = item.size(standard.key[field]), standard.tolerance[field].value
    for way in ways:
        size, allowed = item.size(way.values[field]), own * way.times[field]
        if isnan(size) or abs(size - right) <= own + allowed:
            continue
        is_zero = item.what != "place" and size <= allowed
        if is_zero or any(abs(size - other) <= near for other, near in seen):
            continue
        seen.append((size, allowed))
        share = 1 - Fraction(str(standard.rubric.cost(way.names[0])))
        feedback = plain(words("feedback.guess", cause=words(f"cause.{way.names[0]}")))
        yield Taken(size, allowed, share, feedback)


# --- one question for each variant ----------------------------------------------------------------


MOODLE_FILES, FILES = "@@PLUGINFILE@@", "@@FILES@@"
"""Placeholders for the folder of a question's files: in Moodle, and until a package is written."""
PRINTED = "task.pdf"
"""The name of the PDF with a variant's sheets within its question."""


class Question(Struct, frozen=True):
    """The question of a variant: its name, its text with the gaps, and the files shown.

    ``task`` is the text without the gaps, as XML; ``FILES`` represents the folder of the files.
    """

    name: str
    text: str
    remark: str
    files: tuple[tuple[str, bytes], ...]
    task: str = ""
    gaps: tuple[Gap, ...] = ()


def variants_of(lab: Lab, count: int) -> tuple[list[Assigned], list[Assigned]]:
    """The variants of a lab, each once: the fair ones and the others."""
    every = {
        tuple(sorted(each.settings.items())): each
        for each in assigned(lab, students_of(lab, count))
    }
    fair = [each for each in every.values() if each.fair]
    return fair, [each for each in every.values() if not each.fair]


def questions(order: PrintOrder, variants: Sequence[Assigned], jobs: int) -> list[Question]:
    """The question of each variant, made by ``jobs`` processes."""
    parts = chunks(list(enumerate(variants)), jobs)
    found: list[tuple[int, Question]] = []
    with engine(jobs) as (pool, workers):
        for some in results(pool, workers, partial(asked, order), parts):
            found += some
    return [question for _, question in sorted(found, key=lambda pair: pair[0])]


def asked(
    order: PrintOrder, variants: Sequence[tuple[int, Assigned]]
) -> list[tuple[int, Question]]:
    """The questions of some variants, each with its place in the list."""
    book = Book(order.lab, order.scene)
    return [(place, question(order, book, each, str(place + 1))) for place, each in variants]


def question(order: PrintOrder, book: Book, each: Assigned, code: str) -> Question:
    """The question of one variant; ``code`` is printed on sheets where long data do not fit."""
    settings = {name: exact_text(value) for name, value in each.settings.items()}
    mechanism = book.mechanism(settings)
    words = language_of(mechanism, order.language)
    data = variant(mechanism.scene, words, settings)
    variant_text = ", ".join(map(plain, data))
    who = Student(each.student.row, variant_text, name=variant_text)
    sheets = Sheets(order, Taker(who, settings, code, each.computed))
    marker = book.marker(settings, each.computed)
    _, points = sheets.asked()
    found = gaps(marker, points, words)
    heavy, _ = weights(gap.points for gap in found)
    files = tuple(files_of(sheets, order))
    scene = sheets.mechanism.scene
    items = [gap.item for gap in found]
    rows = [
        (
            gap.item.symbol,
            said(gap.item.what, words),
            Markup(cloze(gap, weight)),
            words.spelled(gap.item.unit),
        )
        for gap, weight in zip(found, heavy, strict=True)
    ]
    shown = {
        "title": gapless(escape(scene.title_in(words.language))),
        "variant": gapless(", ".join(map(marked_up, data))),
        "printed": PRINTED,
        "pictures": [name for name, _ in files if name != PRINTED],
        "advice": advice(items, words, first_pivot(sheets.mechanism)),
        "words": words,
    }
    template = "classroom/templates/quiz.html"
    fitted = Markup(' style="max-width:100%"')
    text = from_template(template, base=MOODLE_FILES, fitted=fitted, gaps=rows, **shown)
    task = from_template(template, base=FILES, fitted=Markup(" /"), gaps=(), **shown)
    remark = plain(how(order.lab.rubric, words))
    return Question(variant_text, str(text), remark, files, str(task), found)


def said(what: str, words: Words) -> str:
    return words(KINDS[what]) if what in KINDS else words("table.sense")


def gapless(markup: str) -> Markup:
    """Browser markup in which Moodle reads no gap."""
    return Markup(markup.replace("{", SIGNS["{"]))


def files_of(sheets: Sheets, order: PrintOrder) -> list[tuple[str, bytes]]:
    """The task sheets of a variant: a PDF to print, and pictures for the screen."""
    from graphkin.writers.pdf import write_pdf
    from graphkin.writers.svg import write_svg

    drawn = [sheet for sheet in sheets.of("task") if sheet.kind != FORM]
    pages = [page for sheet in drawn for page in sheet.pages]
    files = [(PRINTED, write_pdf(pages, order.ink, title=sheets.whose.name))]
    for sheet in drawn:
        for number, page in enumerate(sheet.pages, 1):
            tail = f"-{number}" if len(sheet.pages) > 1 else ""
            files.append(
                (f"task-{sheet.kind}{tail}.svg", write_svg(page, order.ink).encode("utf-8"))
            )
    return files


# --- Moodle's XML -------------------------------------------------------------------------------


def bank(title: str, every: Sequence[Question]) -> bytes:
    """The questions as a file that Moodle imports, with a category for each."""
    quiz = Element("quiz")
    for each in every:
        category = SubElement(quiz, "question", type="category")
        path = "/".join(part.replace("/", "//") for part in (title, each.name))
        texted(SubElement(category, "category"), f"$course$/top/{path}")
        asking = SubElement(quiz, "question", type="cloze")
        texted(SubElement(asking, "name"), f"{title}, {each.name}")
        body = texted(SubElement(asking, "questiontext", format="html"), each.text)
        for name, data in each.files:
            file = SubElement(body, "file", name=name, path="/", encoding="base64")
            file.text = b64encode(data).decode("ascii")
        texted(SubElement(asking, "generalfeedback", format="html"), escape(each.remark))
        for name, number in (("penalty", Fraction()), ("hidden", Fraction())):
            SubElement(asking, name).text = str(number)
    indent(quiz)
    written: bytes = tostring(quiz, encoding="utf-8", xml_declaration=True)
    return written + b"\n"


def texted(element: Element, text: str) -> Element:
    """Add a text to an element, nested as Moodle does, and return the element."""
    SubElement(element, "text").text = text
    return element


SIGNS = {sign: f"&#{ord(sign)};" for sign in "{}~#\\"}
"""The signs with a meaning within a gap, as character references, which Moodle turns back."""


def weights(points: Iterable[Fraction]) -> tuple[list[int], int]:
    """The points as whole numbers, which Moodle requires for gaps, and the factor applied."""
    every = list(points)
    times = lcm(*(each.denominator for each in every)) if every else 1
    return [int(each * times) for each in every], times


def cloze(gap: Gap, weight: int) -> str:
    """A gap in the syntax of Moodle's cloze questions."""
    kind = "MULTICHOICE" if gap.item.what == "sense" else "NUMERICAL"
    return f"{{{weight}:{kind}:{'~'.join(map(taken, gap.takes))}}}"


def taken(each: Taken) -> str:
    """An accepted answer in cloze syntax; older versions of Moodle read only whole percentages."""
    share = "=" if each.share == 1 else f"%{round(100 * each.share)}%"
    if isinstance(each.answer, str):
        answer = written(each.answer)
    else:
        answer = f"{each.answer:.6g}:{each.allowed:.4g}"
    return f"{share}{answer}#{written(each.feedback)}"


def written(text: str) -> str:
    """A text with every sign escaped that would begin or end a gap."""
    return "".join(SIGNS.get(sign) or escape(sign) for sign in text)
