"""Templates: what a user wrote is never markup, and what is let through as markup is listed."""

from __future__ import annotations

import re

import pytest
from jinja2 import UndefinedError

from graphkin.text.tables import CellTable, Row
from graphkin.writers.templates import HOUSE, environment, from_template, tables_html

HOSTILE = "<script>alert(\"1\")</script> & 'two'"
ESCAPED = "&lt;script&gt;alert(&quot;1&quot;)&lt;/script&gt; &amp; &#x27;two&#x27;"
LET_THROUGH = {
    "policy",
    "style",
    "script",
    "picture",
    "mark",
    "run",
    "turning",
    "scheme[1]",
    "board",
}
"""What the program itself wrote: hashes, its own files, drawings, data made safe for a script."""


@pytest.mark.parametrize("written", ["{{ it }}", "{{ it|markup }}", '{{ [it, ""]|select|join }}'])
def test_what_is_no_markup_is_escaped(written):
    assert environment().from_string(written).render(it=HOSTILE) == ESCAPED


def test_markup_of_the_sheets_becomes_tags_and_its_text_is_escaped():
    shown = environment().from_string("{{ it|markup }}").render(it="*v*_A <b>")
    assert shown == "<i>v</i><sub>A</sub> &lt;b&gt;"


def test_a_filled_template_goes_into_another_as_it_is():
    table = tables_html([CellTable(("*x*",), [Row(("1",))], HOSTILE)])
    assert ESCAPED in table and "<i>x</i>" in table
    assert environment().from_string("{{ table }}").render(table=table) == table


def test_a_gap_that_nothing_fills_is_no_page():
    with pytest.raises(UndefinedError):
        from_template("studio/web/notes.html")


def test_what_is_let_through_is_known():
    texts = [path.read_text(encoding="utf-8") for path in HOUSE.rglob("*.html")]
    assert len(texts) > 10
    found = {name for text in texts for name in re.findall(r"([^{\s]+)\|safe", text)}
    assert found == LET_THROUGH
    assert not any("autoescape" in text for text in texts)
