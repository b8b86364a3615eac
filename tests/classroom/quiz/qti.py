"""Packages of questions as platforms read them, written from their rules and not from the writer.

- Canvas: the public importer of its quizzes (github.com/instructure/qti, lib/qti/v1). A numeric
  answer with an exact value and limits has the margin from that value to the lower limit.
- QTI 3.0: response processing by the specification, as far as these packages use it.
"""

from __future__ import annotations

import io
import zipfile
from fractions import Fraction
from xml.etree.ElementTree import Element, fromstring

from msgspec import Struct

ONE = "{http://www.imsglobal.org/xsd/ims_qtiasiv1p2}"
THREE = "{http://www.imsglobal.org/xsd/imsqtiasi_v3p0}"
MANIFESTS = (
    "{http://www.imsglobal.org/xsd/imsccv1p1/imscp_v1p1}",
    "{http://www.imsglobal.org/xsd/qti/qtiv3p0/imscp_v1p1}",
)


def unpacked(data: bytes) -> dict[str, bytes]:
    """The files of a package; every one is in its manifest, once, and every one named is there."""
    with zipfile.ZipFile(io.BytesIO(data)) as found:
        assert found.testzip() is None
        files = {name: found.read(name) for name in found.namelist()}
    manifest = fromstring(files["imsmanifest.xml"])
    space = next(each for each in MANIFESTS if manifest.tag.startswith(each))
    named = [each.get("href") for each in manifest.iter(f"{space}file")]
    assert sorted(named) == sorted(files.keys() - {"imsmanifest.xml"})
    resources = list(manifest.iter(f"{space}resource"))
    ids = [each.get("identifier") for each in resources]
    assert len({*ids}) == len(ids)
    assert {each.get("identifierref") for each in manifest.iter(f"{space}dependency")} <= {*ids}
    return files


class CanvasQuestion(Struct):
    """A question as Canvas has it: numbers with their margins, or choices with the right ones."""

    kind: str
    points: float
    text: str
    numbers: list[tuple[float, float]]
    choices: dict[str, str]
    right: list[str]

    def earns(self, answer: str) -> float:
        """The points of an answer: a number, or the text of a choice."""
        if self.choices:
            return self.points * any(self.choices[each] == answer for each in self.right)
        value = float(answer)
        return self.points * any(abs(value - own) <= near for own, near in self.numbers)


def canvas_quiz(data: bytes) -> list[CanvasQuestion]:
    """The questions of a quiz."""
    return [canvas_question(item) for item in fromstring(data).iter(f"{ONE}item")]


def canvas_question(item: Element) -> CanvasQuestion:
    """One question."""
    fields = {field[0].text: field[1].text or "" for field in item.iter(f"{ONE}qtimetadatafield")}
    text = item.find(f"{ONE}presentation/{ONE}material/{ONE}mattext")
    found = CanvasQuestion(
        fields["question_type"], float(fields["points_possible"]), text.text or "", [], {}, []
    )
    for label in item.iter(f"{ONE}response_label"):
        shown = label.find(f"{ONE}material/{ONE}mattext")
        if shown is not None:
            found.choices[label.get("ident")] = shown.text
    scored = (c for c in item.iter(f"{ONE}respcondition") if c.find(f"{ONE}setvar") is not None)
    for condition in scored:
        assert condition.find(f"{ONE}setvar").text == "100"
        (equal,) = condition.iter(f"{ONE}varequal")
        low, high = (list(condition.iter(f"{ONE}{tag}")) for tag in ("vargte", "varlte"))
        if found.kind == "multiple_choice_question":
            found.right.append(equal.text)
            continue
        value, least, most = (float(each.text) for each in (equal, low[0], high[0]))
        assert least < value < most
        found.numbers.append((value, value - least))
    return found


class Item3(Struct):
    """An item of QTI 3.0: what is declared, what is asked, and its response processing."""

    root: Element

    @property
    def correct(self) -> dict[str, str]:
        """The correct answer to each response."""
        return {
            each.get("identifier"): "".join(each.itertext()).strip()
            for each in self.root.iter(f"{THREE}qti-response-declaration")
        }

    @property
    def asked(self) -> dict[str, dict[str, str]]:
        """The choices of each interaction by their names; none for a text entry."""
        tags = ("qti-text-entry-interaction", "qti-inline-choice-interaction")
        found = {}
        for tag in tags:
            for each in self.root.iter(f"{THREE}{tag}"):
                choices = each.iter(f"{THREE}qti-inline-choice")
                found[each.get("response-identifier")] = {
                    choice.get("identifier"): choice.text for choice in choices
                }
        return found

    def score(self, answers: dict[str, str]) -> float:
        """The outcome SCORE for answers."""
        score = 0.0
        (process,) = self.root.iter(f"{THREE}qti-response-processing")
        for condition in process:
            for branch in condition:
                if self.holds(branch[0], answers):
                    (change,) = branch.iter(f"{THREE}qti-set-outcome-value")
                    assert change.get("identifier") == "SCORE"
                    before, more = change[0]
                    assert before.get("identifier") == "SCORE"
                    score += float(more.text)
                    break
        return score

    def holds(self, test: Element, answers: dict[str, str]) -> bool:
        """Whether a test holds: equal within an absolute tolerance, or the same choice."""
        variable, base = test
        given = answers.get(variable.get("identifier"))
        if given is None:
            return False
        if test.tag == f"{THREE}qti-match":
            return given == base.text
        assert test.tag == f"{THREE}qti-equal"
        assert test.get("tolerance-mode") == "absolute"
        off = abs(Fraction(given) - Fraction(base.text))
        return off <= Fraction(test.get("tolerance"))
