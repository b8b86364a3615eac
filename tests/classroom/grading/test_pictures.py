"""The pictures of the class report call fields by their symbols."""

from __future__ import annotations

import pytest
from matplotlib.mathtext import MathTextParser

from graphkin.classroom.grading.class_pictures import called, difficulty
from graphkin.classroom.lab.items import all_fields
from graphkin.mechanism import load
from graphkin.text import LANGUAGES, words
from tests.classroom.grading.students import LABS
from tests.classroom.grading.test_feedback import waiting


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", LABS)
def test_each_field_has_a_name_of_its_own_that_can_be_set(name, language):
    fields = all_fields(load(name))
    names = {field: called(item, words(language)) for field, item in fields.items()}
    assert len(set(names.values())) == len(fields)
    parser = MathTextParser("path")
    for text in names.values():
        parser.parse(text)


def test_names_are_symbols_with_units_or_the_word_for_a_sense():
    graded = waiting()
    items = {mark.item.field: mark.item for mark in graded.marks}
    assert called(items["epsilon_2"], words("en")) == r"$\mathit{ε}_{\mathrm{2}}$, rad/s²"
    assert called(items["omega_2_sense"], words("it")) == r"$\mathit{ω}_{\mathrm{2}}$, verso"
    assert called(items["v_D_mm"], words("en")) == r"$\mathit{v}_{\mathrm{D}}$, mm"
    (ax,) = difficulty([graded], words("en")).axes
    shown = [label.get_text() for label in ax.get_yticklabels()]
    assert shown == [called(mark.item, words("en")) for mark in graded.marks if mark.points]
