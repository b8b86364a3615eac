"""The step page: one safe file, in which every mark appears after what it is drawn from."""

from __future__ import annotations

import gc
import json
import re
from base64 import b64encode
from functools import cache
from hashlib import sha256
from html import unescape

import pytest

from graphkin.construction.core.program import Part, Plane
from graphkin.construction.result_tables import turning_rows, vector_rows
from graphkin.documents.sentences import TURNING, sentences
from graphkin.documents.sheet import HEADING
from graphkin.drawing.marks import CircleMark, LineMark, Text, reach
from graphkin.drawing.richtext import plain
from graphkin.drawing.style import BRIEF
from graphkin.mechanism import Mechanism, load
from graphkin.scene.read_scene import read_text
from graphkin.text import LANGUAGES, words
from graphkin.web import step_page as page
from graphkin.web.facts import results
from graphkin.web.highlights import ghosts, rows_found
from graphkin.web.offline_page import data_block, ink_sheet, offline_page, part
from graphkin.web.protocol import (
    MOST,
    PageProtocol,
    SentencePart,
    grouped,
    in_parts,
    strokes,
    telling,
)
from graphkin.web.screen_sheets import ScreenSheet, screen_sheets
from graphkin.web.step_page import step_page, task_page
from graphkin.writers.svg import number
from tests.chosen import CHOSEN, SCENES, by_turns, shared
from tests.documents.sheet_tools import mechanism_named

LABS = ("pump", "offset-slider-crank", "slotted-lever")
FEW = (*LABS, "oldham", "gears-ring", "rapid-return", "centrodes-cardan", "eight-link-1")
"""Scenes of different kinds: dyads, slots, gears, trial plans, centrodes, many links."""
TAG = re.compile(r"<[a-z][^>]*>")
ALLOWED = 380_000
"""Most letters of a page."""

HOSTILE = "</title><script>alert(1)</script>\"'&"
NASTY = f"""graphkin = 1
title = '''{HOSTILE}'''
notes = {{ en = '''{HOSTILE} *_^{{''' }}
units = {{ length = "mm", angle = "deg", speed = "rad/s" }}
[frame]
O = [0, 0]
[links.1]
O-A = 60
[links.2]
A-B = 200
[links.3]
B = [0, 0]
slides = {{ on = 0, through = "O", angle = 0 }}
[[drivers]]
turn = 1
angle = 40
speed = 5
[branches]
3 = "forward"
[ask]
velocity = ["B"]
acceleration = ["B"]
[sheet]
language = "en"
owner = '''{HOSTILE}'''
"""


@cache
def mechanism_of(name: str) -> Mechanism:
    """A mechanism by its name."""
    return mechanism_named(name) if name in SCENES else load(name)


@cache
def sheets_of(name: str) -> list[ScreenSheet]:
    """The sheets of a mechanism."""
    return screen_sheets(mechanism_of(name), "en")


@cache
def told_of(name: str) -> PageProtocol:
    """The run of a mechanism."""
    return telling(sheets_of(name))


@cache
def page_of(name: str, language: str = "en") -> str:
    """The page of a mechanism."""
    return step_page(mechanism_of(name), language)


def seen(page: str) -> str:
    """The words of a page, without scripts, styles and tags."""
    page = re.sub(r"<(script|style)\b.*?</\1>", " ", page, flags=re.DOTALL)
    return unescape(re.sub(r"<[^>]*>", "", page))


# --- the run of sentences ------------------------------------------------------------------------


@pytest.mark.parametrize("name", FEW)
def test_what_a_step_is_drawn_from_stands_before_it(name):
    told = told_of(name)
    late = {
        step: source
        for step, sources in told.sources.items()
        for source in sources
        if told.at[source] > told.at[step] > 0
    }
    assert not late
    assert sum(map(len, told.sources.values())) > len(told.sources)


@pytest.mark.parametrize("name", FEW)
def test_the_sources_of_a_step_are_all_that_it_hangs_on_by_one_stroke(name):
    told, program = told_of(name), sheets_of(name)[0].drawing.trace.program
    for step, sources in told.sources.items():
        before = {*program.behind([step], by_hand=True)} - {step}
        assert set(sources) <= before
        farther = {*program.behind(sources, by_hand=True)}
        assert {one for one in before if one in told.at} <= farther


@pytest.mark.parametrize("name", FEW)
def test_the_run_tells_every_step_of_every_sentence_of_every_sheet_once(name):
    """The page parts sentences; it leaves none out and tells none twice."""
    told = told_of(name)
    for place, sheet in enumerate(sheets_of(name)):
        said, own = sentences(sheet.drawing), in_parts(sheet)[0]
        ends = [step for one in own for step in one.all_steps if one.name != TURNING]
        assert {step for one in said for step in one.all_steps} <= {*ends}
        assert len({*ends}) == len(ends)
        first, last = told.bounds(place)
        assert last - first + 1 == len(own) >= len(said)
    assert told.bounds(0)[0] == 1
    assert told.bounds(len(sheets_of(name)) - 1)[1] == len(told.said)


@pytest.mark.parametrize("name", [*LABS, "pump-collinear", *shared(CHOSEN, 3)])
def test_a_step_draws_three_strokes_at_most(name):
    for sheet in sheets_of(name):
        own, _, timed = in_parts(sheet)
        for sentence, count in zip(own, strokes(timed, len(own)), strict=True):
            assert count <= MOST, sentence.markup


@pytest.mark.parametrize("name", [*FEW, "stephenson-3-crank"])
def test_a_step_that_draws_lines_in_a_plan_draws_those_of_one_point(name):
    """Two points are never found in one step: each image has a sentence of its own."""
    for sheet in sheets_of(name):
        steps = sheet.drawing.trace.program.steps
        for one in in_parts(sheet)[0]:
            found = {
                n
                for n in one.all_steps
                if steps[n].plane is sheet.drawing.plane and not steps[n].arrow
            }
            assert sum(bool(steps[n].name) for n in found) <= 1 or one.name.startswith("trial")


@pytest.mark.parametrize("name", [*FEW, "stephenson-2-binary", "gears-pair"])
def test_every_step_has_its_reason(name):
    assert not [plain(one.markup) for one in told_of(name).said if not one.why]


@pytest.mark.parametrize(
    ("name", "found"),
    [
        ("gears-ring", [("3", "omega"), ("2", "willis"), ("3", "willis")]),
        ("gears-pair", [("2", "omega radii")]),
        ("slotted-lever", [("3 2", "omega together"), ("4", "omega")]),
    ],
)
def test_a_rate_has_the_reason_of_how_it_is_found(name, found):
    """By a bar, with another link, or by wheels that do not slip, seen from the arm or not."""
    spoken = words("en")
    rates = [one for one in told_of(name).said if one.rates and "ω" in plain(one.markup)]
    assert [(" ".join(one.rates), list(one.why)) for one in rates][-len(found) :] == [
        (links, [spoken(f"why.{key}") for key in keys.split()]) for links, keys in found
    ]


def test_the_line_of_the_trials_has_its_reason_where_it_is_drawn():
    """What is missed grows in proportion; where this line is cut, the point lies on both."""
    spoken = words("en")
    said = told_of("stephenson-3-crank").said
    drawn = [
        one
        for one in said
        if "line " in plain(one.markup) and "of the trials;" in plain(one.markup)
    ]
    assert drawn
    for one in drawn:
        after = said[said.index(one) + 1]
        assert spoken("why.trials") in one.why
        assert spoken("why.trials") not in after.why
        assert any(plain(why).startswith("each line alone holds") for why in after.why)


def test_a_letter_that_shares_a_label_appears_with_its_own_sentence():
    """o stands from the first; the images of the first trial plan fall on it only with that."""
    told = told_of("stephenson-3-crank")
    (label,) = (one for one in told.timed[0] if one.letters and one.mark.name.startswith("o "))
    (trial,) = (
        at
        for at, one in enumerate(told.said, 1)
        if "first trial plan" in one.markup and one.sheet == 0
    )
    assert label.at == 0
    assert label.letters == (0, trial, trial, trial)
    markup = page_of("stephenson-3-crank")
    assert '<tspan data-from="0" ' in markup and f'<tspan data-from="{trial}" ' in markup


def test_the_beginning_shows_the_mechanism_and_nothing_of_the_construction():
    sheet = sheets_of("stephenson-3-crank")[0]
    marks = [
        told_of("stephenson-3-crank").timed[0][k].mark
        for k in ghosts(sheet, told_of("stephenson-3-crank"))
    ]
    assert {mark.name for mark in marks if mark.cls == "pin"} == {"A", "B", "C", "D"}
    assert not [
        m for m in marks if {"compass", "construction", "velocity", "locus"} & {*m.cls.split()}
    ]
    assert not [m.name for m in marks if m.name.startswith("locus")]


@pytest.mark.parametrize("name", LABS)
def test_each_result_is_found_by_a_sentence_of_its_own_sheet(name):
    found, told = rows_found(sheets_of(name), told_of(name)), told_of(name)
    for place, sheet in enumerate(sheets_of(name)):
        first, last = told.bounds(place)
        rows = [each["data-row"] for t in results(sheet.drawing, found) for each in t.marks]
        assert rows
        assert all(found[row] == 0 or first <= found[row] <= last for row in rows)
        assert len({found[row] for row in rows}) > 2


def test_the_rate_of_each_link_is_found_in_figures_of_its_own_step():
    said = [plain(one.markup) for one in told_of("pump").said]
    (omega,) = (text for text in said if "ω3 =" in text)
    assert omega == "ω3 = vBA/AB = 11.059/0.4 = 27.65 rad/s (counter-clockwise)"
    for link in "234":
        assert sum(f"ε{link} =" in text for text in said) == 1


@pytest.mark.parametrize("name", FEW)
def test_each_mark_appears_with_a_sentence_of_its_own_sheet_or_stands_before(name):
    told = told_of(name)
    for place, timed in enumerate(told.timed):
        first, last = told.bounds(place)
        assert all(mark.at == 0 or first <= mark.at <= last for mark in timed)
        assert max(mark.at for mark in timed) > first


def test_one_sentence_says_as_many_parts_of_a_point_as_it_may_draw_strokes():
    parts = [SentencePart(step, step // 7, "") for step in range(9)]
    assert [len(some) for some in grouped(parts, [1] * 9)] == [MOST, MOST, 1, 2]
    assert [len(some) for some in grouped(parts, [MOST] * 9)] == [1] * 9


@pytest.mark.parametrize("name", [*LABS, "oldham", "gears-ring", "eight-link-1"])
def test_what_a_step_draws_appears_with_the_sentence_that_draws_it(name):
    """Also where a sentence is told in parts; what is given is there from the first."""
    for sheet in sheets_of(name):
        _, own, timed = in_parts(sheet)
        marks = [one for one in timed if one.step in own]
        assert len({one.at for one in marks}) > 4
        assert all(one.at == max(own[one.step] + 1, 0) for one in marks)


def test_b_of_the_pump_is_drawn_from_what_its_sentence_names():
    told = told_of("pump")
    letters = {step: plain(name) for step, name in told.letters.items()}
    (b,) = (step for step, name in letters.items() if name == "b")
    lines = told.sources[b]
    named = {letters[step] for line in lines for step in told.sources[line]}
    assert named == {"a", "o", "A", "B", "O2"}
    sides = [{letters[point] for point in told.sides[line]} for line in lines]
    assert sides == [{"A", "B"}, {"O2", "B"}]


@pytest.mark.parametrize("name", ["oscillating-slide", "gears-planet", "gears-ring"])
def test_a_letter_in_a_reason_has_its_index_once(name):
    labels = {plain(letter) for letter in told_of(name).letters.values()}
    for said in told_of(name).said:
        for why in said.why:
            found = re.search("each line alone holds (.*), so", plain(why))
            assert found is None or found.group(1) in labels


@pytest.mark.parametrize(("make", "language"), by_turns([step_page, task_page], LANGUAGES))
def test_each_field_has_its_bar(make, language):
    text = make(load("pump"), language)
    assert text.count('class="bar"') == text.count('<div class="view">') - (make is task_page) == 4
    assert words(language)("screen.on_paper") in text
    view = "task" if make is task_page else "key"
    for place, sheet in enumerate(screen_sheets(load("pump"), language, view)):
        left, top, right, bottom = sheet.layout.plan.rect
        rule = f"#fields-{place}>:nth-child(2){{--bar:20;--wide:{number(right - left)};"
        assert rule + f"--high:{number(bottom - top)}}}" in text


@pytest.mark.parametrize("name", FEW)
def test_every_sentence_belongs_to_a_part_of_its_sheet(name):
    """Parts follow one another, and the last one goes to the end of its sheet."""
    told = told_of(name)
    places = sorted({(first, last) for first, last, _ in told.stops()})
    firsts, lasts = zip(*places, strict=True)
    assert firsts == (1, *(last + 1 for last in lasts[:-1]))
    assert {told.bounds(place)[1] for place in range(len(sheets_of(name)))} <= {*lasts}


@pytest.mark.parametrize("name", [*FEW, "rapid-return-slider"])
def test_the_button_of_the_velocities_leads_to_the_velocity_plan(name):
    """Vectors that are transferred at the end do not carry the part along with them."""
    told = told_of(name)
    steps = sheets_of(name)[0].drawing.trace.program.steps
    drawn = [at for step, at in told.at.items() if steps[step].plane is Plane.VELOCITIES and at]
    assert min(drawn) in {first for first, _, part in told.stops() if part is Part.VELOCITY}


@pytest.mark.parametrize("name", FEW)
def test_reasons_name_what_stands_in_their_sentence(name):
    for said in told_of(name).said:
        for why in said.why:
            assert not re.search(r"[{}@]|None|\s[:,;.]|  ", plain(why)), why


def test_an_acceleration_is_not_explained_by_velocities():
    said = [one for one in told_of("slotted-lever").said if one.sheet == 1]
    every = " ".join(plain(why) for one in said for why in one.why)
    assert "keeps its length" not in every
    assert "2ω·v" in every


@pytest.mark.parametrize("name", FEW)
def test_what_is_told_of_right_triangles_has_the_names_of_the_drawing(name):
    for sheet in sheets_of(name):
        labels = {mark.markup for mark in sheet.left if isinstance(mark, Text)}
        said = [one for one in told_of(name).said if one.sheet == sheets_of(name).index(sheet)]
        told = " ".join(text for one in said for text in (one.markup, *one.why, *one.letters))
        found = re.findall(r"\*[A-Z]\*[″‴](?:_\{[^}]*\})?", told)
        assert {*found} <= labels


@pytest.mark.parametrize("name", ["stephenson-1", "watt-1"])
def test_a_triangle_that_is_left_out_has_no_letters_no_reason_and_no_crossing(name):
    """What is too short to be drawn has no point, and one letter stands for one point."""
    sheet = sheets_of(name)[1]
    labels = {plain(mark.markup) for mark in sheet.left if isinstance(mark, Text)}
    (said,) = (one for one in told_of(name).said if "is left out" in one.markup)
    assert {plain(letter) for letter in said.letters} <= labels
    reasons = " ".join(plain(why) for why in said.why)
    heights = re.findall(r"([A-Z]\d?[A-Z]\d?‴\w*) = v2/(\w+)", reasons)
    assert len(heights) == len({letter for letter, _ in heights}) == len(said.letters)
    left_out = re.findall(r"v\w+2/(\w+) \(", plain(said.markup))
    assert left_out and not {of for _, of in heights} & {*left_out}


@pytest.mark.parametrize("name", ["stephenson-2-binary", "stephenson-3-crank", "rapid-return"])
def test_a_trial_plan_names_itself_in_each_of_its_steps_and_each_point_that_it_finds(name):
    """What is tried is said first, with why; each point that two lines find has its reason."""
    said = told_of(name).said
    first = [one for one in said if "trial plan, with" in one.markup]
    assert len(first) % 2 == 0 and first
    assert all(one.why[0].startswith(("no point of these links", "a second")) for one in first)
    for one in (one for one in said if "trial plan" in one.markup):
        if "in the first trial plan" in one.markup:
            continue
        assert re.match("(first|second) trial plan[:,]", plain(one.markup))
        clauses = [plain(why) for why in one.why]
        found = re.findall(r"both lines meet at ([^; ]*)", plain(one.markup))
        alone = [clause for clause in clauses if "each line alone" in clause]
        assert len(found) == len(alone) <= 1
        assert not alone or f"holds {found[0]}," in alone[0]
        assert not any(clause.startswith(("likewise", "and ")) for clause in clauses)


@pytest.mark.parametrize("name", LABS)
def test_what_hangs_on_a_crossing_of_a_plan_is_of_that_plan_or_read_off_it(name):
    told, program = told_of(name), sheets_of(name)[0].drawing.trace.program
    assert told.hangs
    for step, lines in told.hangs.items():
        assert program.steps[step].part is not Part.POSITION
        drawn_to = {line for line in lines if step in program.steps[line].args}
        assert set(lines) <= {*program.behind([step], by_hand=True)} | drawn_to
        assert all(program.steps[line].part is not Part.POSITION for line in lines)


def test_a_centre_lies_on_lines_square_to_the_velocities_of_two_pins():
    told = told_of("pump")
    letters = {step: plain(name) for step, name in told.letters.items()}
    named = [tuple(letters[point] for point in points) for points in told.squares.values()]
    assert sorted(named) == [("A", "o", "a"), ("B", "o", "b")]


# --- one safe file -------------------------------------------------------------------------------


@pytest.mark.parametrize("name", FEW)
def test_every_mark_has_its_own_id_in_the_field_where_it_lies(name):
    page, sheets = page_of(name), sheets_of(name)
    ids = re.findall(r' id="([^"]+)"', page)
    assert len(ids) == len(set(ids))
    own = {found for found in ids if re.fullmatch(r"m\d+-\d+", found)}
    captions = {
        f"m{s}-{k}"
        for s, sheet in enumerate(sheets)
        for k, mark in enumerate((*sheet.left, *sheet.right))
        if mark.name == HEADING
    }
    every = {
        f"m{s}-{k}"
        for s, sheet in enumerate(sheets)
        for k in range(len(sheet.left) + len(sheet.right))
    }
    assert own == every - captions


@pytest.mark.parametrize("name", LABS)
def test_a_mark_keeps_its_place_in_millimetres_of_the_page(name):
    page = page_of(name)
    for s, sheet in enumerate(sheets_of(name)):
        for k, mark in enumerate((*sheet.left, *sheet.right)):
            if isinstance(mark, CircleMark):
                (tag,) = re.findall(rf'<circle id="m{s}-{k}"[^>]*>', page)
                found = [float(re.search(rf' {at}="([^"]+)"', tag)[1]) for at in ("cx", "cy")]
                assert found == pytest.approx([mark.cx, mark.cy], abs=1e-4)


@pytest.mark.parametrize("name", LABS)
def test_each_field_shows_its_own_rectangle(name):
    boxes = re.findall(r'<svg viewBox="([\d. -]+)" role="img"', page_of(name))
    rects = [r for s in sheets_of(name) for r in (s.layout.mechanism.rect, s.layout.plan.rect)]
    for box, (left, top, right, bottom) in zip(boxes, rects, strict=True):
        found = [float(one) for one in box.split()]
        assert found == pytest.approx([left, top, right - left, bottom - top], abs=1e-3)


def hashes(texts: list[str]) -> set[str]:
    """Texts as a policy names them."""
    return {f"'sha256-{b64encode(sha256(t.encode()).digest()).decode()}'" for t in texts}


def nasty() -> Mechanism:
    """A mechanism whose names are taken for markup where they can be."""
    return Mechanism(read_text(NASTY, "nasty", None, {}))


@pytest.mark.parametrize("of", [lambda: load("pump"), nasty], ids=["pump", "nasty"])
@pytest.mark.parametrize("make", [step_page, task_page])
def test_nothing_runs_but_what_the_policy_names(make, of):
    page = make(of())
    (policy,) = re.findall(r'Content-Security-Policy" content="([^"]+)"', page)
    rules = dict(part.strip().split(" ", 1) for part in policy.split(";"))
    assert rules["default-src"] == "'none'"
    scripts = re.findall(r"<script>(.*?)</script>", page, re.DOTALL)
    styles = re.findall(r"<style>(.*?)</style>", page, re.DOTALL)
    assert set(rules["script-src"].split()) == (hashes(scripts) or {"'none'"})
    assert set(rules["style-src"].split()) == hashes(styles)
    assert "unsafe" not in policy
    tags = TAG.findall(re.sub(r"<(script|style)>.*?</\1>", "", page, flags=re.DOTALL))
    assert not [tag for tag in tags if re.search(r"\s(on\w+|style)\s*=", tag)]
    assert not [tag for tag in tags if re.search(r"""(src|href)\s*=\s*["']?(?!#)\w+:""", tag)]
    assert not re.search(r"@import|url\((?!data:)", "".join(styles))


@pytest.mark.parametrize("make", [step_page, task_page])
def test_names_and_notes_are_only_text(make):
    page = make(nasty())
    assert "alert(1)" in seen(page)
    assert "<script>alert" not in page
    assert page.count("</title>") == 1
    assert f"<h1>{HOSTILE}</h1>" in unescape(page)


def test_data_never_end_their_block():
    value = {"a": "</script><!--<script>&", "b": "</SCRIPT ><!DOCTYPE"}
    block = data_block("run", value)
    assert re.findall("</script|<!", block, re.IGNORECASE) == ["</script"]
    assert block.endswith("</script>")
    assert json.loads(block[block.index(">") + 1 : block.rindex("<")]) == value


@pytest.mark.parametrize("bad", ["</SCRIPT>", "</style >", "<!--"])
def test_a_script_that_would_end_early_is_refused(bad):
    with pytest.raises(ValueError, match="would end"):
        offline_page("t", "en", "", ["a{}"], [f"let x = '{bad}'"])


# --- what it says --------------------------------------------------------------------------------


@pytest.mark.parametrize("name", FEW)
def test_a_page_is_of_moderate_size(name):
    page = page_of(name)
    assert len(page) < ALLOWED
    assert page.count('class="sheet"') == len(sheets_of(name))


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_page_speaks_one_language(language):
    page, spoken = page_of("pump", language), words(language)
    assert f'<html lang="{language}">' in page
    text = seen(page)
    own = {key for key in spoken.sentences if key.startswith("screen.")}
    for key in own & {"screen.results", "screen.help", "screen.new", "screen.vectors"}:
        assert spoken(key) in text
    for other in set(LANGUAGES) - {language}:
        assert words(other)("screen.help") not in text
    assert not re.search(r"\{\w*\}|None|\bnan\b|[\ue000\ue001]", text)


@pytest.mark.parametrize("name", LABS)
def test_the_tables_hold_what_the_sheets_hold(name):
    text = seen(page_of(name))
    for sheet in sheets_of(name):
        rows = [*vector_rows(sheet.drawing, empty=False), *turning_rows(sheet.drawing, empty=False)]
        for row in rows:
            assert all(cell in text for cell in row.cells[2:3])


@pytest.mark.parametrize("name", LABS)
def test_a_task_gives_nothing_of_the_key_away(name):
    page = task_page(load(name), "en")
    given = {mark.name for sheet in screen_sheets(load(name), "en", "task") for mark in sheet.left}
    text, written = seen(page), re.sub(r"<[^>]*>", " ", page)
    for sheet in sheets_of(name):
        values = [row.cells[-2:] for row in vector_rows(sheet.drawing, empty=False)]
        for shown in {cell for cells in values for cell in cells if len(cell) > 3}:
            assert shown not in written
        hidden = {mark.name for mark in sheet.left if isinstance(mark, Text)} - given
        assert hidden
        to_scale = re.sub(r'<figure id="scheme">.*?</figure>', "", page, flags=re.DOTALL)
        assert not [n for n in hidden if f'data-name="{n}"' in to_scale]
    assert "graphkinMotion" not in page
    assert 'id="run"' not in page
    assert 'data-of="' not in page
    assert words("en")("page.asked") in text


@pytest.mark.parametrize("name", LABS)
def test_a_task_shows_its_scheme_in_another_position(name):
    """With all letters of the mechanism, and not to scale: nothing can be traced."""
    page = task_page(load(name), "en")
    (figure,) = re.findall(r'<figure id="scheme">.*?</figure>', page, re.DOTALL)
    assert words("en")("task.scheme") in figure
    assert {"A", "B"} <= {*re.findall(r'<text [^>]*data-name="(\w+)"', figure)}
    assert page.count("not to scale") == 1


def test_black_ink_is_one_ink():
    inks = set(re.findall(r"(?:stroke|fill):var\(--(\w+)\)", step_page(load("pump"), ink="black")))
    assert not inks & {"blue", "red", "teal", "purple"}


def test_lettering_stays_within_its_field():
    for sheet in sheets_of("pump"):
        left, top, right, bottom = sheet.layout.plan.rect
        for mark in sheet.right[1:]:
            if isinstance(mark, Text):
                box = reach(mark)
                assert left <= box[0] and box[2] <= right and top <= box[1] and box[3] <= bottom


def test_a_page_leaves_the_search_for_garbage_as_it_was(monkeypatch):
    """It is off while the page is made, and on again even after a mistake."""
    seen = []
    monkeypatch.setattr(page, "screen_sheets", lambda *_: seen.append(gc.isenabled()) or 1 / 0)
    for was in (True, False):
        (gc.enable if was else gc.disable)()
        with pytest.raises(ZeroDivisionError):
            page.step_page(load("pump"))
        assert gc.isenabled() is was
    gc.enable()
    assert seen == [False, False]


def test_a_vector_that_is_short_where_it_is_drawn_has_on_a_page_a_shaft_like_all_others():
    """For it may be long elsewhere."""
    vectors = [LineMark(0, 0, 9, 0, "velocity"), LineMark(0, 0, 3, 0, f"velocity {BRIEF}")]
    assert ink_sheet(vectors, "colour") == ink_sheet(vectors[:1], "colour")


@pytest.mark.parametrize("name", ["page.css", "steps.css", "player.css"])
def test_what_scrolls_has_columns_of_its_own(name):
    """Firefox lays the columns of a subgrid out beneath its scrollbar, which cuts the last one."""
    assert "subgrid" not in part(name)
