"""Feedback and class report in a real browser: whole, readable by all, nothing fetched."""

from __future__ import annotations

from pathlib import Path

from graphkin.classroom.grading.class_report import class_report
from graphkin.classroom.grading.feedback import feedback_html
from graphkin.text import words
from tests.browser.opening import Opened, barred
from tests.classroom.grading.students import marker_of
from tests.classroom.grading.test_feedback import graded, mistaken, waiting
from tests.classroom.grading.test_outputs import small_class


def pages(language: str) -> dict[str, str]:
    """Each kind of page that grading writes."""
    spoken, rubric = words(language), marker_of("pump", 7).standard.rubric
    forms = {
        "slip": mistaken("pump", "rpm_as_rad"),
        "waiting": waiting(),
        "absent": marker_of("pump", 7).mark(graded({}).taker, {}, present=False),
    }
    found = {name: feedback_html(form, "Pump", rubric, spoken) for name, form in forms.items()}
    return found | {"class": class_report(small_class(), "Pump", (), spoken)}


def test_no_page_bars_anybody(opened: Opened, tmp_path: Path) -> None:
    for name, text in pages("en").items():
        path = tmp_path / f"{name}.html"
        path.write_text(text, encoding="utf-8")
        assert not barred(opened(path, bypass_csp=True)), name
