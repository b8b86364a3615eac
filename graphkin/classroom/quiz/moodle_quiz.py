"""A lab as a bank of questions for Moodle (its XML format): a category for each variant.

A question holds the task as pictures, its sheets as a PDF to be printed, and a gap for each field.
A quiz that takes a random question of each student's category, or of all, marks by the tolerances
of that variant.
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

from graphkin.classroom.form_page import KINDS, first_pivot
from graphkin.classroom.grading.class_marking import Book
from graphkin.classroom.grading.feedback import SENSES, SLIPS, how
from graphkin.classroom.grading.marking import Marker, sense_is_open
from graphkin.classroom.grading.slip_diagnosis import slip_error
from graphkin.classroom.grading.slips import differs
from graphkin.classroom.lab.lab_model import Item, Lab
from graphkin.classroom.lab.lab_trial import students_of
from graphkin.classroom.lab.rules import exact_text
from graphkin.classroom.printing.answer_form import advice
from graphkin.classroom.printing.print_work import FORM, PrintOrder, Sheets
from graphkin.classroom.printing.workers import chunks, engine, results
from graphkin.classroom.roster.student import Student
from graphkin.classroom.roster.taker import Taker
from graphkin.classroom.variants.assign import Assigned, assigned
from graphkin.construction.core.quantities import TURNING
from graphkin.drawing.richtext import plain
from graphkin.text import Words
from graphkin.writers.templates import from_template

WHOLE = Fraction(1)


class Taken(Struct, frozen=True):
    """What a gap takes, of several the first that fits: an answer, as text or as a number with how
    far it may be off, the share of the points that it earns, and what is said of it.
    """

    answer: str | float
    allowed: float
    share: Fraction
    told: str


class Gap(Struct, frozen=True):
    """One field of a question: its points, and what it takes, the right answer first."""

    item: Item
    points: Fraction
    takes: tuple[Taken, ...]


def gaps(marker: Marker, points: Mapping[str, Fraction], words: Words) -> tuple[Gap, ...]:
    """The gaps of a variant: its fields that earn points and that have a value.

    A slip earns its share at the first field that it explains, and at all others what follows
    from an own value where that is more, as in marking; what it gives is looked for only where it
    is not right by the key.
    """
    paid: set[str] = set()
    found = []
    for item in marker.standard.items:
        worth = points.get(item.field)
        if worth and not isnan(marker.standard.key[item.field]):
            takes = sensed(marker, item, words) if item.what == "sense" else ()
            takes = takes or (*keyed(marker, item, words), *slipped(marker, item, paid, words))
            found.append(Gap(item, worth, tuple(takes)))
    return tuple(found)


def keyed(marker: Marker, item: Item, words: Words) -> Iterator[Taken]:
    """The right value; of a rate its negative, too, whose sense has a gap of its own."""
    standard = marker.standard
    right, allowed = standard.key[item.field], standard.tolerance[item.field].value
    told = words("feedback.right")
    size = item.size(right)
    yield Taken(size, allowed, WHOLE, told)
    if item.beside("sense") in standard.key and size:
        yield Taken(-size, allowed, WHOLE, told)


def sensed(marker: Marker, item: Item, words: Words) -> tuple[Taken, ...]:
    """Both senses; where no drawing tells it, each is right."""
    standard, turning = marker.standard, item.quantity in TURNING
    is_open = sense_is_open(standard, item.field)
    right, wrong = words("feedback.right"), plain(words("feedback.wrong_sense"))
    found = []
    for positive in (True, False):
        good = is_open or (standard.key[item.field] > 0) == positive
        share, told = (WHOLE, right) if good else (Fraction(), wrong)
        found.append(Taken(words(SENSES[turning, positive]), 0.0, share, told))
    return tuple(found)


def slipped(marker: Marker, item: Item, paid: set[str], words: Words) -> Iterator[Taken]:
    """What slips make of a value, those with a share first, of two that make the same the first.

    ``paid`` gathers those that have earned their share.
    """
    standard, field = marker.standard, item.field
    rubric, seen = standard.rubric, list[tuple[float, float]]()
    for slip in sorted(marker.slips, key=lambda slip: slip.name not in rubric.slips):
        value = slip.values.get(field)
        if value is None or not differs(standard, field, value):
            continue
        size, allowed = item.size(value), slip_error(standard, slip, field, value)
        is_nought = item.what != "place" and size <= allowed
        if is_nought or any(abs(size - other) <= near for other, near in seen):
            continue
        seen.append((size, allowed))
        share = rubric.slips.get(slip.name, 0.0)
        if share and slip.name in paid:
            share = max(share, rubric.follow)
        told = plain(words("feedback.guess", slip=words(SLIPS[slip.name])))
        yield Taken(size, allowed, Fraction(str(share)), told)
    paid.update(slip.name for slip in marker.slips if field in slip.values)


# --- A lab as a bank of questions for Moodle (its XML format): a category for each variant --------


PRINTED = "task.pdf"
"""The sheets of a variant within its question."""


class Question(Struct, frozen=True):
    """A variant as a question: its name, its text with the gaps, and the files that this shows."""

    name: str
    text: str
    remark: str
    files: tuple[tuple[str, bytes], ...]


def variants_of(lab: Lab, count: int) -> tuple[list[Assigned], list[Assigned]]:
    """The variants of a lab, each once: those that are fair, and those that are not."""
    every = {
        tuple(sorted(each.settings.items())): each
        for each in assigned(lab, students_of(lab, count))
    }
    fair = [each for each in every.values() if each.fair]
    return fair, [each for each in every.values() if not each.fair]


def questions(order: PrintOrder, variants: Sequence[Assigned], jobs: int) -> list[Question]:
    """The question of each variant, by some processes."""
    parts = chunks(list(enumerate(variants)), jobs)
    found: list[tuple[int, Question]] = []
    with engine(jobs) as (pool, workers):
        for some in results(pool, workers, partial(asked, order), parts):
            found += some
    return [question for _, question in sorted(found, key=lambda pair: pair[0])]


def asked(
    order: PrintOrder, variants: Sequence[tuple[int, Assigned]]
) -> list[tuple[int, Question]]:
    """The questions of some variants with their places."""
    book = Book(order.lab, order.scene)
    return [(place, question(order, book, each, str(place + 1))) for place, each in variants]


def question(order: PrintOrder, book: Book, each: Assigned, code: str) -> Question:
    """The question of one variant; ``code`` stands on its sheets, where long data have no room."""
    settings = {name: exact_text(value) for name, value in each.settings.items()}
    told = ", ".join(f"{name} = {value}" for name, value in settings.items())
    who = Student(each.student.row, told, name=told)
    sheets = Sheets(order, Taker(who, settings, code, each.computed))
    words = sheets.words
    marker = book.marker(settings, each.computed)
    _, points = sheets.asked()
    found = gaps(marker, points, words)
    heavy, _ = weights(gap.points for gap in found)
    files = tuple(files_of(sheets, order))
    scene = sheets.mechanism.scene
    items = [gap.item for gap in found]
    rows = [
        (gap.item.symbol, said(gap.item.what, words), Markup(cloze(gap, weight)), gap.item.unit)
        for gap, weight in zip(found, heavy, strict=True)
    ]
    text = from_template(
        "classroom/templates/quiz.html",
        title=harmless(scene.titles.get(words.language, scene.title)),
        variant=harmless(told),
        printed=PRINTED,
        pictures=[name for name, _ in files if name != PRINTED],
        advice=advice(items, words, first_pivot(sheets.mechanism)),
        gaps=rows,
        words=words,
    )
    return Question(told, str(text), plain(how(order.lab.rubric, words)), files)


def said(what: str, words: Words) -> str:
    """What is said of a field beside its symbol."""
    return words(KINDS[what]) if what in KINDS else words("table.sense")


def harmless(text: str) -> Markup:
    """A text beside gaps that is not taken for one."""
    return Markup(escape(text).replace("{", SIGNS["{"]))


def files_of(sheets: Sheets, order: PrintOrder) -> list[tuple[str, bytes]]:
    """The task sheets of a variant: a PDF to be printed, and pictures to be seen."""
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
    """The questions as a file that Moodle imports, a category for each."""
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
    """An element with a text, as Moodle nests it."""
    SubElement(element, "text").text = text
    return element


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
