"""A lab as packages of questions for other platforms: QTI 1.2 for Canvas, and QTI 3.0.

In Canvas each fair variant is a quiz of its own: the task, then a question for each field. In QTI
3.0 each variant is one item with a gap for each field. Both have the tolerances of that variant's
own drawing.
"""

from __future__ import annotations

import io
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from hashlib import sha256
from xml.etree.ElementTree import Element, SubElement, fromstring, indent, tostring

from graphkin.classroom.form_page import KINDS
from graphkin.classroom.grading.answers import DATE
from graphkin.classroom.quiz.moodle_quiz import FILES, WHOLE, Gap, Question, Taken
from graphkin.text import Words
from graphkin.writers.templates import marked_up

CANVAS_FILES = "%24IMS-CC-FILEBASE%24"
"""The placeholder for the folder of uploaded files in Canvas."""
INSTANCE = "http://www.w3.org/2001/XMLSchema-instance"
COMMON_CARTRIDGE = "http://www.imsglobal.org/xsd/imsccv1p1/imscp_v1p1"
QTI_1 = "http://www.imsglobal.org/xsd/ims_qtiasiv1p2"
CANVAS = "http://canvas.instructure.com/xsd/cccv1p0"
QTI_3 = "http://www.imsglobal.org/xsd/imsqtiasi_v3p0"
CONTENT_3 = "http://www.imsglobal.org/xsd/qti/qtiv3p0/imscp_v1p1"
SCHEMA_3 = "https://purl.imsglobal.org/spec/qti/v3p0/schema/xsd"
MANIFEST = "imsmanifest.xml"


def named(title: str, question: Question) -> str:
    """A name for the files of a question, the same in every run."""
    return f"g{sha256(f'{title}/{question.name}'.encode()).hexdigest()[:24]}"


def exact(value: float, digits: int = 7) -> str:
    """A number without an exponent, which no reader misunderstands."""
    return format(Decimal(f"{value:.{digits}g}"), "f")


def heading(gap: Gap, words: Words) -> str:
    """What a gap asks, as browser markup: symbol, kind and unit."""
    item = gap.item
    kind = words(KINDS[item.what]) if item.what in KINDS else words("table.sense")
    return ", ".join(
        filter(None, (marked_up(item.symbol), marked_up(kind), words.spelled(item.unit)))
    )


def is_decided(gap: Gap) -> bool:
    """Whether a wrong answer to a gap is possible: not where no drawing decides a sense."""
    return gap.item.what != "sense" or any(each.share != WHOLE for each in gap.takes)


def added(parent: Element, tag: str, text: str = "", **attributes: str) -> Element:
    """Add an element with a text; _ in the names of attributes means a hyphen."""
    own = {name.replace("_", "-"): value for name, value in attributes.items()}
    found = SubElement(parent, tag, own)
    found.text = text or None
    return found


def root(tag: str, space: str, schema: str, **attributes: str) -> Element:
    """The root of a document in a default namespace, with the place of its schema."""
    own = {name.replace("_", "-"): value for name, value in attributes.items()}
    namespaces = {"xmlns": space, "xmlns:xsi": INSTANCE, "xsi:schemaLocation": f"{space} {schema}"}
    return Element(tag, namespaces | own)


def written(document: Element) -> bytes:
    """A document as bytes."""
    indent(document)
    return bytes(tostring(document, encoding="utf-8", xml_declaration=True)) + b"\n"


def packed(files: Mapping[str, bytes]) -> bytes:
    """A ZIP file; the same files give the same bytes."""
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as found:
        for name, content in files.items():
            found.writestr(zipfile.ZipInfo(name, DATE), content, zipfile.ZIP_DEFLATED)
    return data.getvalue()


def manifest_of(title: str, space: str, schema: str, kind: tuple[str, str]) -> Element:
    """The manifest of a package up to its resources; ``kind`` is its schema and version."""
    identifier = f"g{sha256(title.encode()).hexdigest()[:24]}"
    manifest = root("manifest", space, schema, identifier=identifier)
    metadata = added(manifest, "metadata")
    for tag, text in zip(("schema", "schemaversion"), kind, strict=True):
        added(metadata, tag, text)
    added(manifest, "organizations")
    return manifest


# --- QTI 1.2, as Canvas reads it ------------------------------------------------------------------


def canvas_package(title: str, every: Sequence[Question], words: Words) -> bytes:
    """A ZIP file that Canvas imports: a quiz for each question, its fields as its questions."""
    manifest = manifest_of(
        title,
        COMMON_CARTRIDGE,
        "http://www.imsglobal.org/xsd/imscp_v1p1.xsd",
        ("IMS Content", "1.1.3"),
    )
    resources = added(manifest, "resources")
    files: dict[str, bytes] = {MANIFEST: b""}
    for question in every:
        name = named(title, question)
        quiz, about = f"{name}/{name}.xml", f"{name}/assessment_meta.xml"
        one = added(resources, "resource", identifier=name, type="imsqti_xmlv1p2")
        added(one, "file", href=quiz)
        added(one, "dependency", identifierref=f"{name}-meta")
        kind = "associatedcontent/imscc_xmlv1p1/learning-application-resource"
        meta = added(resources, "resource", identifier=f"{name}-meta", type=kind, href=about)
        added(meta, "file", href=about)
        files[quiz] = assessment(title, question, words)
        files[about] = assessment_meta(title, question)
        for number, (own, data) in enumerate(question.files):
            path = f"images/{name}-{own}"
            web = added(
                resources, "resource", identifier=f"{name}-{number}", type="webcontent", href=path
            )
            added(web, "file", href=path)
            files[path] = data
    files[MANIFEST] = written(manifest)
    return packed(files)


def assessment(title: str, question: Question, words: Words) -> bytes:
    """The quiz of a variant."""
    name = named(title, question)
    schema = "http://www.imsglobal.org/xsd/ims_qtiasiv1p2p1.xsd"
    document = root("questestinterop", QTI_1, schema)
    quiz = added(document, "assessment", ident=name, title=f"{title}, {question.name}")
    section = added(quiz, "section", ident="root_section")
    task = question.task.replace(f"{FILES}/", f"{CANVAS_FILES}/images/{name}-")
    first = canvas_item(section, f"{name}-task", "text_only_question", Fraction(), task)
    first.set("title", question.name)
    for number, gap in enumerate(filter(is_decided, question.gaps), 1):
        own = f"{name}-{number}"
        if gap.item.what == "sense":
            canvas_choice(section, own, gap, words)
        else:
            canvas_number(section, own, gap, words)
    return written(document)


def canvas_item(
    parent: Element,
    ident: str,
    kind: str,
    points: Fraction,
    text: str,
    answers: Sequence[str] = (),
) -> Element:
    """A question with its kind, its points, its text and the names of its answers."""
    item = added(parent, "item", ident=ident, title=ident)
    fields = added(added(item, "itemmetadata"), "qtimetadata")
    metadata = (
        ("question_type", kind),
        ("points_possible", exact(float(points))),
        ("original_answer_ids", ",".join(answers)),
        ("assessment_question_identifierref", f"{ident}-ref"),
    )
    for label, entry in metadata:
        field = added(fields, "qtimetadatafield")
        added(field, "fieldlabel", label)
        added(field, "fieldentry", entry)
    shown = added(item, "presentation")
    added(added(shown, "material"), "mattext", text, texttype="text/html")
    return item


def canvas_number(parent: Element, ident: str, gap: Gap, words: Words) -> None:
    """A question for a number, with each value that earns all points and its tolerance."""
    text = f"<p>{heading(gap, words)}</p>"
    item = canvas_item(parent, ident, "numerical_question", gap.points, text, [f"{ident}-0"])
    asked = added(item[1], "response_str", ident="response1", rcardinality="Single")
    added(added(asked, "render_fib", fibtype="Decimal"), "response_label", ident="answer1")
    process = resprocessing(item)
    for each in gap.takes:
        if each.share == WHOLE and not isinstance(each.answer, str):
            variable, low, high = right(process), each.answer - each.allowed, each.answer
            either = added(variable, "or")
            added(either, "varequal", exact(high), respident="response1")
            within = added(either, "and")
            added(within, "vargte", exact(low), respident="response1")
            added(within, "varlte", exact(high + each.allowed), respident="response1")


def canvas_choice(parent: Element, ident: str, gap: Gap, words: Words) -> None:
    """A question for a sense: two choices, of which one is right."""
    text = f"<p>{heading(gap, words)}</p>"
    names = [f"{ident}-{number}" for number in range(len(gap.takes))]
    item = canvas_item(parent, ident, "multiple_choice_question", gap.points, text, names)
    asked = added(item[1], "response_lid", ident="response1", rcardinality="Single")
    choices, process = added(asked, "render_choice"), resprocessing(item)
    for own, each in zip(names, gap.takes, strict=True):
        label = added(choices, "response_label", ident=own)
        added(added(label, "material"), "mattext", str(each.answer), texttype="text/plain")
        if each.share == WHOLE:
            added(right(process), "varequal", own, respident="response1")


def resprocessing(item: Element) -> Element:
    """The part of a question that says what its answers earn."""
    process = added(item, "resprocessing")
    limits = {"maxvalue": "100", "minvalue": "0", "varname": "SCORE", "vartype": "Decimal"}
    added(added(process, "outcomes"), "decvar", **limits)
    return process


def right(process: Element) -> Element:
    """A condition under which an answer earns everything."""
    condition = SubElement(process, "respcondition", {"continue": "No"})
    variable = added(condition, "conditionvar")
    added(condition, "setvar", "100", action="Set", varname="SCORE")
    return variable


def assessment_meta(title: str, question: Question) -> bytes:
    """What Canvas notes about a quiz: unpublished, and one attempt."""
    name = named(title, question)
    schema = "https://canvas.instructure.com/xsd/cccv1p0.xsd"
    document = root("quiz", CANVAS, schema, identifier=name)
    points = sum((gap.points for gap in question.gaps if is_decided(gap)), Fraction())
    entries = (
        ("title", f"{title}, {question.name}"),
        ("description", question.remark),
        ("shuffle_answers", "false"),
        ("quiz_type", "assignment"),
        ("points_possible", exact(float(points))),
        ("allowed_attempts", "1"),
        ("available", "false"),
    )
    for tag, text in entries:
        added(document, tag, text)
    return written(document)


# --- QTI 3.0 --------------------------------------------------------------------------------------


def qti3_package(title: str, every: Sequence[Question], words: Words) -> bytes:
    """A QTI 3.0 package: an item for each question, with a gap for each field."""
    manifest = manifest_of(
        title, CONTENT_3, f"{SCHEMA_3}/imsqtiv3p0_imscpv1p2_v1p0.xsd", ("QTI Item", "3.0.0")
    )
    resources = added(manifest, "resources")
    files: dict[str, bytes] = {MANIFEST: b""}
    for question in every:
        name = named(title, question)
        own = [(f"items/{name}/{file}", data) for file, data in question.files]
        path = f"items/{name}.xml"
        one = added(resources, "resource", identifier=name, type="imsqti_item_xmlv3p0", href=path)
        for href in (path, *(href for href, _ in own)):
            added(one, "file", href=href)
        files[path] = item3(title, question, words)
        files |= own
    files[MANIFEST] = written(manifest)
    return packed(files)


def item3(title: str, question: Question, words: Words) -> bytes:
    """The item of a variant: the task, a table of gaps, and what each answer earns."""
    name = named(title, question)
    document = root(
        "qti-assessment-item",
        QTI_3,
        f"{SCHEMA_3}/imsqti_asiv3p0_v1p0.xsd",
        identifier=name,
        title=f"{title}, {question.name}",
        adaptive="false",
        time_dependent="false",
    )
    document.set("xml:lang", words.language)
    gaps = {f"R{number}": gap for number, gap in enumerate(question.gaps, 1)}
    for response, gap in gaps.items():
        declared3(document, response, gap)
    points = sum((gap.points for gap in question.gaps), Fraction())
    score = added(
        document,
        "qti-outcome-declaration",
        identifier="SCORE",
        cardinality="single",
        base_type="float",
        normal_maximum=exact(float(points)),
    )
    added(added(score, "qti-default-value"), "qti-value", "0")
    body = added(document, "qti-item-body")
    body.extend(fromstring(f"<div>{question.task.replace(FILES, name)}</div>"))
    table = added(added(body, "table"), "tbody")
    for response, gap in gaps.items():
        row = added(table, "tr")
        row.append(fromstring(f"<td>{heading(gap, words)}</td>"))
        asked3(added(added(row, "td"), "p"), response, gap)
    process = added(document, "qti-response-processing")
    for response, gap in gaps.items():
        earned3(process, response, gap)
    return written(document)


def declared3(document: Element, response: str, gap: Gap) -> None:
    """The declaration of a response, with its right value."""
    kind = "identifier" if gap.item.what == "sense" else "float"
    attributes = {"identifier": response, "cardinality": "single", "base_type": kind}
    declared = added(document, "qti-response-declaration", **attributes)
    first = next(i for i, each in enumerate(gap.takes) if each.share == WHOLE)
    added(added(declared, "qti-correct-response"), "qti-value", value3(response, gap, first))


def value3(response: str, gap: Gap, place: int) -> str:
    """An answer that a gap accepts, as its response declares it."""
    answer = gap.takes[place].answer
    return f"{response}-{place}" if isinstance(answer, str) else exact(answer)


def asked3(parent: Element, response: str, gap: Gap) -> None:
    """The interaction of a gap: a text entry for a number, a choice in the line for a sense."""
    if gap.item.what != "sense":
        attributes = {"response_identifier": response, "expected_length": "12"}
        added(parent, "qti-text-entry-interaction", **attributes)
        return
    attributes = {"response_identifier": response, "shuffle": "false"}
    choices = added(parent, "qti-inline-choice-interaction", **attributes)
    for place, each in enumerate(gap.takes):
        own = value3(response, gap, place)
        added(choices, "qti-inline-choice", str(each.answer), identifier=own)


def earned3(process: Element, response: str, gap: Gap) -> None:
    """What the answers to a gap earn: the first that fits counts."""
    condition: Element | None = None
    for place, each in paying(gap):
        if condition is None:
            condition = added(process, "qti-response-condition")
            branch = added(condition, "qti-response-if")
        else:
            branch = added(condition, "qti-response-else-if")
        fits3(branch, response, gap, place)
        change = added(branch, "qti-set-outcome-value", identifier="SCORE")
        both = added(change, "qti-sum")
        added(both, "qti-variable", identifier="SCORE")
        earned = exact(float(gap.points * each.share))
        added(both, "qti-base-value", earned, base_type="float")


def paying(gap: Gap) -> Iterator[tuple[int, Taken]]:
    """The answers to a gap that earn anything, with their places."""
    for place, each in enumerate(gap.takes):
        if each.share > 0:
            yield place, each


def fits3(branch: Element, response: str, gap: Gap, place: int) -> None:
    """The test whether a response is an answer: exactly, or within its tolerance."""
    each = gap.takes[place]
    if isinstance(each.answer, str):
        test, kind = added(branch, "qti-match"), "identifier"
    else:
        allowed = {"tolerance_mode": "absolute", "tolerance": exact(each.allowed, 5)}
        test, kind = added(branch, "qti-equal", **allowed), "float"
    added(test, "qti-variable", identifier=response)
    added(test, "qti-base-value", value3(response, gap, place), base_type=kind)
