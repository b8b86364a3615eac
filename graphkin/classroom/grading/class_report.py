"""The report on a class for its lecturer: points, difficulty, slips, evidence; one file."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Iterator, Sequence
from html import escape
from statistics import mean, median

from graphkin.classroom.grading.answer_numbers import shown
from graphkin.classroom.grading.answers import Answers, Unread
from graphkin.classroom.grading.class_pictures import pictures, slip_counts
from graphkin.classroom.grading.feedback_html import RIGHT, page
from graphkin.classroom.grading.feedback_rows import SLIPS, points_words
from graphkin.classroom.grading.feedback_rows import unread as unread_words
from graphkin.classroom.grading.graded import SURE, Graded, Result, Suspicion, Taker
from graphkin.classroom.roster.language_names import language_in
from graphkin.classroom.roster.student import Student
from graphkin.text import Words
from graphkin.writers.html_markup import marked_up

NAMED = 5
"""Students that are named of many with the same data."""


def class_report(result: Result, title: str, unread: Sequence[Unread], words: Words) -> str:
    """The report as a page for a browser, its pictures within."""
    own = own_work(result)
    pngs = pictures(result.graded, words, "png", own)
    body = [f"<h1>{escape(words('class.title'))}</h1>", f"<p>{escape(title)}</p>"]
    body.append(f'<p class="total">{escape(summary(result.graded, words))}</p>')
    for name, key in (("distribution", "class.distribution"), ("difficulty", "class.difficulty")):
        if name in pngs:
            body += [f"<h2>{escape(words(key))}</h2>", picture(pngs[name], words(key))]
    body += slips_section(own, pngs, words)
    body += evidence_sections(result, words)
    students = [each.taker.student for each in result.graded]
    body += lines_section(words("class.unread"), unread_lines(students, unread, words))
    body += lines_section(words("class.absent"), absent_lines(result))
    body += lines_section(words("class.unsure"), unsure_lines(result, words))
    return page(f"{title} – {words('class.title')}", words.language, body)


def own_work(result: Result) -> list[Graded]:
    """Who handed in answers that fit no other's data: slips are counted among these."""
    others = {each.students[0] for each in result.wrong_variants}
    return [g for g in result.graded if g.present and g.taker.student.id not in others]


def summary(graded: Sequence[Graded], words: Words) -> str:
    """How many handed in, and how they did."""
    shares = [float(100 * g.share) for g in graded if g.share is not None]
    amounts = {
        name: words.fixed(found(shares), 1) if shares else "–"
        for name, found in (("mean", mean), ("median", median))
    }
    present = sum(each.present for each in graded)
    text = words("class.summary", present=present, all=len(graded), **amounts)
    waiting = sum(bool(each.pending) for each in graded)
    return f"{text}; {words('class.pending', count=waiting)}" if waiting else text


def picture(png: bytes, text: str) -> str:
    """A picture within the page."""
    data = b64encode(png).decode("ascii")
    return f'<img alt="{escape(text)}" src="data:image/png;base64,{data}">'


def slips_section(graded: Sequence[Graded], pngs: dict[str, bytes], words: Words) -> Iterator[str]:
    """The frequent slips, drawn and in a table."""
    yield f"<h2>{escape(words('class.frequent'))}</h2>"
    counts = slip_counts(graded)
    if not counts:
        yield f"<p>{escape(words('class.none'))}</p>"
        return
    if "slips" in pngs:
        yield picture(pngs["slips"], words("class.frequent"))
    heads = "".join(
        f'<th scope="col"{RIGHT if i else ""}>{escape(words(key))}</th>'
        for i, key in enumerate(("class.slip_name", "class.students", "class.times"))
    )
    yield f"<table><tr>{heads}</tr>"
    for name, answers, students in counts:
        yield (
            f"<tr><td>{marked_up(words(SLIPS[name]))}</td>"
            f'<td class="n">{students}</td><td class="n">{answers}</td></tr>'
        )
    yield "</table>"


def evidence_sections(result: Result, words: Words) -> Iterator[str]:
    """Wrong variants and copies; nothing where there is no evidence."""
    names = {each.taker.student.id: name_of(each) for each in result.graded}
    yield from lines_section(words("class.wrong_variant"), wrong_variant_lines(result, words))
    yield from lines_section(
        words("class.copies"), (copies_words(each, names, words) for each in result.copies)
    )
    held = held_line(result, words)
    if held:
        yield f"<p>{escape(held)}</p>"
    if result.wrong_variants or result.copies:
        yield f'<p class="small">{escape(words("class.evidence"))}</p>'


def name_of(graded: Graded) -> str:
    """A student by name and id."""
    return named(graded.taker.student)


def named(student: Student) -> str:
    """The same of a class list."""
    return f"{student.name} ({student.id})" if student.name else student.id


def wrong_variant_lines(result: Result, words: Words) -> Iterator[str]:
    """Each wrong variant, with the points that the row earned and what of them a person decides."""
    graded = {each.taker.student.id: each for each in result.graded}
    names = {who: name_of(each) for who, each in graded.items()}
    for found in result.wrong_variants:
        each = graded[found.students[0]]
        text = wrong_variant_words(found, names, words)
        amounts = (each.earned, each.decided, each.spared)
        earned, points, spared = (points_words(amount, words) for amount in amounts)
        key = "class.held" if each.held else "class.stays"
        text += f"; {words(key, earned=earned, points=points)}"
        yield f"{text}, {words('class.spared', spared=spared)}" if each.spared else text


def held_line(result: Result, words: Words) -> str:
    """Whose marks are held, and how that is decided; empty where nobody's are."""
    held = [name_of(each) for each in result.graded if each.held]
    return words("class.held_row", who=words("list_mark").join(held)) if held else ""


def wrong_variant_words(found: Suspicion, names: dict[str, str], words: Words) -> str:
    """A wrong variant in a sentence."""
    who, *others = found.students
    return words(
        "class.wrong_variant_row",
        who=names[who],
        count=len(found.fields),
        all=found.of,
        other=some([names[each] for each in others], words),
        odds=odds_words(found.odds, words),
    )


def copies_words(found: Suspicion, names: dict[str, str], words: Words) -> str:
    """A copied set in a sentence."""
    return words(
        "class.copies_row",
        who=some([names[each] for each in found.students], words),
        fields=", ".join(found.fields),
        odds=odds_words(found.odds, words),
    )


def some(names: Sequence[str], words: Words) -> str:
    """Some names, and how many more."""
    more = len(names) - NAMED
    rest = words("class.more", count=more) if more > 0 else ""
    return words("list_mark").join(names[:NAMED]) + rest


def odds_words(odds: float, words: Words) -> str:
    """Odds with the one digit that they are worth, and no surer than they can be."""
    if odds >= SURE:
        return words("class.at_least", odds=f"{SURE:.0f}")
    return words.significant(odds, 1)


def unread_lines(
    students: Iterable[Student], unread: Iterable[Unread], words: Words
) -> Iterator[str]:
    """The cells that cannot be read, each in a sentence."""
    names = {student.id: named(student) for student in students}
    for cell in unread:
        yield words(
            "unread.row",
            file=cell.file,
            row=cell.row,
            who=names.get(cell.who, cell.who),
            field=cell.field,
            text=shown(cell.text.strip()),
            why=unread_words(cell.problem, cell.unit, words),
        )


def stranger_lines(given: Answers, words: Words) -> Iterator[str]:
    """Columns that are no fields, and fields that have no column."""
    for each in given.strangers:
        near = f"; {words('class.meant', field=each.near)}" if each.near else ""
        yield words("class.stranger", file=each.file, name=each.name) + near
    if given.missing:
        yield words("class.unanswered", fields=", ".join(given.missing))


def language_lines(takers: Iterable[Taker], words: Words) -> Iterator[str]:
    """Students for whom the class list names a language that is none of the pages'."""
    for taker in takers:
        if taker.language and language_in(taker.language) is None:
            yield words("class.no_language", who=named(taker.student), text=shown(taker.language))


def absent_lines(result: Result) -> Iterator[str]:
    """Those who handed in nothing."""
    for each in result.graded:
        if not each.present:
            yield name_of(each)


def unsure_lines(result: Result, words: Words) -> Iterator[str]:
    """The fields of each student that hardly a drawing tells."""
    names = {each.taker.student.id: name_of(each) for each in result.graded}
    for who, fields in result.unsure.items():
        yield words("class.unsure_row", who=names[who], fields=", ".join(fields))


def lines_section(title: str, lines: Iterable[str]) -> Iterator[str]:
    """A list under a heading; nothing where it is empty."""
    items = [f"<li>{escape(line)}</li>" for line in lines]
    if items:
        yield from (f"<h2>{escape(title)}</h2>", "<ul>", *items, "</ul>")


def result_lines(result: Result, words: Words) -> Iterator[str]:
    """What a terminal shows: how the class did, and evidence."""
    yield summary(result.graded, words)
    names = {each.taker.student.id: name_of(each) for each in result.graded}
    yield from wrong_variant_lines(result, words)
    for each in result.copies:
        yield copies_words(each, names, words)
    held = held_line(result, words)
    if held:
        yield held
