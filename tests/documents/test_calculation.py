"""The calculation pages can be checked with a pocket calculator, line by line."""

from __future__ import annotations

import re
from itertools import pairwise
from math import cos, pi, radians, sin, sqrt, tan
from pathlib import Path

import pytest

from graphkin.construction.core.given_data import given
from graphkin.construction.core.solution import Verdict
from graphkin.construction.rate_relations import of_gears, of_scales
from graphkin.construction.result_tables import vector_rows
from graphkin.documents.calculation import (
    BOTTOM,
    BY_HAND,
    LINE,
    CalculationRow,
    all_rows,
    calculation,
    laid_out,
    paged,
)
from graphkin.documents.relations import relations
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet import asked_words
from graphkin.documents.sheet_documents import drawings_of
from graphkin.drawing.marks import Page, Polyline
from graphkin.drawing.richtext import plain
from graphkin.drawing.symbol_markup import symbol
from graphkin.mechanism import Mechanism
from graphkin.scene import scene_files
from graphkin.scene.link_points import lettered
from graphkin.scene.read_scene import read_text
from graphkin.text import LANGUAGES, words
from tests.chosen import CHOSEN, HALVES
from tests.documents.full_scenes import NAMED, drawings_from
from tests.documents.sheet_tools import (
    OTHERS,
    VARIANTS,
    calculations,
    drawings,
    mechanism_named,
    named,
    relation_lines,
    texts,
)
from tests.mechanisms import SHIPPED, mechanism_of
from tests.scene_files import scene_text

WHICH = [(lab, n, language) for lab in SHIPPED for n in (7, 30) for language in ("en", "ro")]
WHICH += [(name, None, "en") for name in (*OTHERS, *CHOSEN)]

SUPERSCRIPTS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
POWER = re.compile(r"·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)")
RESULT = re.compile(r"(−?\d+(?:[.,]\d+)?)((?:·10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?)(.*)")
FIGURES = re.compile(r"(?:[\d.,·/^+\-−*()π√° ⁻⁰¹²³⁴⁵⁶⁷⁸⁹]|sin|cos|tan|sqrt)+")
REMARK = re.compile(r" \((?:[^()]|\([^()]*\))*\)$")
"""What stands in parentheses behind a result, or a place in them within."""


@pytest.fixture(params=WHICH, ids=named)
def pages(request) -> tuple[tuple[Page, ...], tuple[Page, ...]]:
    name, n, language = request.param
    return calculations(name, n, "key", language), calculations(name, n, "task", language)


def value_of(figures: str) -> float:
    """The value of printed figures."""
    text = POWER.sub(lambda m: f"*1e{int(m[1].translate(SUPERSCRIPTS))}", figures)
    text = text.replace(",", ".").replace("·", "*").replace("^", "**").replace("−", "-")
    text = re.sub(r"cos ([\d.]+)°", r"cos(\1)", text.replace("√", "sqrt"))
    text = text.replace("°", "").replace("π", repr(pi))
    known = {"sqrt": sqrt} | {f.__name__: lambda x, f=f: f(radians(x)) for f in (sin, cos, tan)}
    assert set(re.findall(r"[a-df-z]+\w*", text)) <= {*known}, figures
    return float(eval(text, {"__builtins__": {}} | known))


def last_digit(result: str) -> tuple[float, float]:
    """A printed result and what one of its last digit counts."""
    found = RESULT.match(result)
    assert found, result
    digits, power, _ = found.groups()
    places = len(re.sub(r"^[^.,]*[.,]?", "", digits))
    return value_of(digits + power), (value_of(f"1{power}") if power else 1.0) * 10.0**-places


def equations(pages) -> list[tuple[str, str, str]]:
    """Number, figures and result of each relation that has figures, remark left out."""
    found = []
    for number, line in relation_lines(pages):
        pieces = REMARK.sub("", line).split(" = ")
        if number and len(pieces) > 2 and FIGURES.fullmatch(pieces[-2]):
            found.append((number, pieces[-2], pieces[-1]))
    return found


ALL = [(lab, n, "en") for lab, n in VARIANTS] + WHICH


@pytest.mark.parametrize("which", dict.fromkeys(ALL), ids=named)
def test_the_figures_of_every_relation_give_its_result_to_the_last_digit(which):
    name, n, language = which
    found = equations(calculations(name, n, "key", language))
    told = relations(drawings(name, n, language))
    in_figures = [relation for _, several in told for relation in several if relation.figures]
    assert len(found) == len(in_figures) > 0
    wrong = []
    for number, figures, result in found:
        printed, unit = last_digit(result)
        if abs(value_of(figures) - printed) > 1.000001 * unit:
            wrong.append(f"({number}) {figures} = {value_of(figures):.7g}, not {result}")
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize("name", ["stephenson-3-crank", "stephenson-2-binary", "crank-rocker"])
def test_every_bar_for_which_the_compass_is_opened_has_its_drawn_length(name):
    """That by which a locus is cut as well."""
    drawing = drawings(name)[0]
    said = " ".join(sentence.markup for sentence in sentences(drawing))
    opened = {*re.findall(r"arc of radius (\S+) about", said)}
    told = {r.left for _, found in relations([drawing]) for r in found if r.unit == "mm"}
    told = {each.removesuffix("/*k*_L") for left in told for each in left.split(" = ")}
    assert opened and opened <= told, opened - told


@pytest.mark.parametrize(
    ("name", "third", "told"),
    [
        ("six-bar", "BC", ["*C* right of *O*_{2}→*B*", "∠*B**O*_{2}*C* = 70°"]),
        ("cam-conjugate", "BC", ["*C* left of *Q*→*B*", "∠*B**Q**C* = 70°"]),
    ],
)
def test_the_bar_between_the_arms_of_an_angle_follows_by_the_law_of_cosines(name, third, told):
    """A minus on an angle tells nobody its sense: the side does."""
    drawing = drawings(name)[0]
    (relation,) = [r for r in of_scales(drawing) if "cos " in r.symbols]
    assert relation.left == "".join(map(symbol, third))
    length = drawing.length(abs(drawing.standing.spot(third[0]) - drawing.standing.spot(third[1])))
    metres = length * {"mm": 1e-3, "cm": 1e-2, "m": 1}[drawing.scene.units["length"]]
    figures = re.sub(r"\*(\S)\*", r"\1", relation.figures)
    assert value_of(figures) == pytest.approx(metres, rel=1e-4)
    assert value_of(relation.result) == pytest.approx(metres, rel=1e-4)
    assert {*told} <= {*given(drawing)}


BY_BAR = re.compile(r"\*[va]\*_\{[^}]*\}(?:\^\{τ\}|\^2)?/\*?[A-Z].*|2·\*ω\*.*")
"""What divides by the length of a bar, and twice the product of a Coriolis component."""


@pytest.mark.parametrize("which", dict.fromkeys(ALL), ids=named)
def test_a_quotient_by_a_bar_rounds_to_its_result(which):
    """A normal component, ω, ε or a Coriolis component is what a pocket calculator shows, rounded;
    figures of five digits let a square be off by two of its last digit."""
    seen = 0
    for relation in (r for _, several in relations(drawings(*which)) for r in several):
        if relation.figures and BY_BAR.fullmatch(relation.symbols):
            printed, unit = last_digit(relation.result)
            assert abs(value_of(relation.figures) - printed) <= 0.50001 * unit, relation
            seen += 1
    assert seen or which[0] not in SHIPPED


@pytest.mark.parametrize("which", dict.fromkeys(ALL), ids=named)
def test_a_vector_has_one_value_on_the_sheet_and_in_the_calculation(which):
    both = drawings(*which)
    told = {r.left: (r.symbols, r.result) for _, found in relations(both) for r in found}
    compared = 0
    for drawing in both:
        for row in vector_rows(drawing, empty=False):
            vector, segment, drawn, value = row.cells
            laid, length = told.get(segment, ("", drawn))
            assert length == drawn, (segment, laid)
            symbols, result = told.get(vector, ("", ""))
            if symbols.startswith("*k*_"):
                assert result == value, (vector, symbols)
                compared += 1
    assert compared or not any(vector_rows(each, empty=False) for each in both)


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("gears-planet", {"PT": "*r*_{3} = *m*·*z*_{3}/2 = 0.004·20/2 = 0.04000 m"}),
        ("gears-lever", {"QT": "*r*_{4} = 0.05000 m"}),
        (
            "hoist-differential",
            {
                "T_{3}T_{4}": "2·*r*_{4} = 2·0.085 = 0.1700 m",
                "T_{3}P": "*r*_{4} = 0.08500 m",
                "T_{4}P": "*r*_{4} = 0.08500 m",
            },
        ),
        ("belts-arm", {}),
    ],
)
def test_a_bar_that_is_a_radius_or_a_diameter_of_a_wheel_follows_from_the_data(name, told):
    sections = dict(relations(drawings(name)))
    found = {r.left.replace("*", ""): r.parts(solved=True)[1:] for r in sections["radii"]}
    assert {bar: " ".join(parts)[2:] for bar, parts in found.items()} == told
    measured = {ends for relation in sections["lengths"] for ends in relation.over}
    assert not measured.intersection(e for r in sections["radii"] for e in r.over)


def test_what_two_trial_plans_miss_of_a_driver_between_moving_links_is_reckoned_in_figures():
    """A plate on three legs, the elbow of each driven (3-RRR): ω or ε found, less what is given."""
    mechanism, verdict = (
        mechanism_of(scene_text("construction/elbows")),
        Verdict(True, 0.0, "", 0.0, 0.0, 0.0),
    )
    pages = calculation(drawings_of(mechanism, verdict, words("en")), "key")
    found = equations(pages)
    gaps = [each for each in found if re.search(r"[\d)] − ", each[1]) and each[2].endswith("rad/s")]
    assert gaps, found
    for _, figures, result in found:
        printed, unit = last_digit(result)
        assert value_of(figures) == pytest.approx(printed, abs=1.000001 * unit)


def test_the_task_has_the_same_relations_in_the_same_order_without_results(pages):
    key, task = (after_data(relation_lines(form)) for form in pages)
    assert [number for number, _ in key] == [number for number, _ in task]
    for (number, solved), (_, blank) in zip(key, task, strict=True):
        if not number:
            assert solved == blank
            continue
        if is_chosen(solved):
            assert solved == blank, "what nobody can compute is given"
            continue
        place = re.fullmatch(r"(.*) = \((?:\. )*\.[;,] (?:\. )*\.\) (?:mm|cm|m) \([^)]*\)", blank)
        if place:
            assert solved.startswith((f"{place[1]} = ", f"{place[1]} at infinity"))
            continue
        symbols, dots, unit = re.fullmatch(r"(.*) =((?: \.){10,}) ?(.*)", blank).groups()
        assert solved.startswith(f"{symbols} = "), (solved, blank)
        unit, has_sense, sense = unit.partition(" (")
        assert bool(has_sense) is unit.startswith("rad/"), blank
        assert not has_sense or sense.endswith(" .)"), blank
        assert dots and not re.search(r"\d", unit.replace("^2", "")), blank
        rest = solved.removeprefix(f"{symbols} = ")
        assert unit in rest, (solved, blank)


def is_chosen(line):
    """Whether a relation states a scale factor that follows from nothing."""
    return any(line.endswith(f"({words(code)('calculation.chosen')})") for code in LANGUAGES)


def after_data(lines):
    """The relations after the data, of which a form leaves out what it asks."""
    heads = {words(c)(f"calculation.{of}") for c in LANGUAGES for of in ("driver", "scales")}
    return lines[next(i for i, (_, line) in enumerate(lines) if line in heads) :]


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_form_gives_only_the_parameters_of_what_it_asks(language):
    key, task = (relation_lines(calculations("pump", 28, of, language)) for of in ("key", "task"))
    given = [line for number, line in task[: task.index(after_data(task)[0])] if not number]
    asked = dict(task)
    mark = words(language)("clause_mark").rstrip()
    assert f"*n* = 28{mark}" in " ".join(given)
    assert words(language)("page.turning_anticlockwise") in " ".join(given)
    assert not re.search(r"\b(86|580)\b", " ".join(line for _, line in task))
    assert f"*φ* = 86°{mark}" in " ".join(line for _, line in key)
    assert asked["1"].startswith("*φ* = 30 + 2·*n* = . .") and asked["1"].endswith(". °")
    assert dict(key)["1"] == "*φ* = 30 + 2·*n* = 30 + 2·28 = 86°"


def test_a_task_has_no_figures_but_those_of_the_data_and_of_the_laws(pages):
    """What is left are the constants of a relation: pi·n/30, the powers, expressions given."""
    _, task = pages
    for number, line in relation_lines(task):
        if number and "*t*" not in line and not is_chosen(line):
            left = re.sub(r"_\{[^}]*\}|_\w|\^\{?\w+\}?|\d+$", "", line.partition(" .")[0])
            figures = re.findall(r"\d+[.,]\d+", left)
            assert not figures or line.startswith("*k*_"), line


def test_no_line_breaks_between_a_number_and_its_unit(pages):
    for form in pages:
        rows = [m.markup for m in texts(form) if m.cls == "caption"]
        assert not [row for row in rows if re.match(r"(?:mm|cm|m|rev/min|rot/min|rad/s)\b", row)]
        assert not [row for row in rows if re.search(r"=$", row)]


@pytest.mark.parametrize(
    ("name", "wheels"), [("gears-pair", "2"), ("gears-planet", "3"), ("gears-ring", "23")]
)
def test_each_wheel_that_another_turns_has_willis_relation(name, wheels):
    """Whether the arm of the two is a link or the frame, and whether the other wheel is fixed."""
    (drawing, *_) = drawings(name)
    told = [relation.left for relation in of_gears(drawing)]
    assert [left for left in told if left.startswith("*ω*")] == [f"*ω*_{{{n}}}" for n in wheels]


@pytest.mark.parametrize(
    ("lines", "begin"),
    [([20, 20, 20], [True, True]), ([38, 10], [True, True]), ([60], [True, False])],
    ids=str,
)
def test_pages_begin_with_a_heading_where_that_takes_no_more_of_them(lines, begin):
    """Of sections that a page holds none is parted; of a longer one, as few pages as hold it."""
    rows = [CalculationRow("", heading=nth == 0) for count in lines for nth in range(count)]
    pages = laid_out(rows, solved=True)
    assert [page[0][1].heading for page in pages] == begin
    assert [row for page in pages for _, row in page] == rows


@pytest.mark.parametrize("lines", [[22, 38], [21, 12, 30, 10], [24, 40, 30]], ids=str)
def test_a_section_is_parted_where_a_page_would_be_much_emptier_than_the_next(lines):
    rows = [CalculationRow("", heading=nth == 0) for count in lines for nth in range(count)]
    pages = laid_out(rows, solved=True)
    ends = [page[-1][0] - page[0][0] for page in pages]
    assert min(ends[:-1]) > 0.75 * max(ends)


def test_lines_to_be_filled_in_stand_as_far_apart_as_takes_no_more_pages():
    """Whatever their number: on the last page, too, the next wider distance would not hold them."""
    for count in range(1, 120):
        rows = [CalculationRow("")] * count
        pages = laid_out(rows, solved=False)
        assert len(pages) == len(laid_out(rows, solved=True))
        for line in (line for line in BY_HAND if count > 1):
            held = 1 + int((BOTTOM - pages[0][0][0]) / line + 1e-9)
            apart = pages[0][1][0] - pages[0][0][0] if len(pages[0]) > 1 else LINE
            assert apart >= line - 1e-9 or count > held * len(pages), (count, line)
            assert any(apart == pytest.approx(each) for each in (*BY_HAND, LINE))


@pytest.mark.parametrize("language", LANGUAGES)
def test_results_of_measured_lengths_have_no_more_digits_than_these_however_large(language):
    """A speed of 1e50 rad/s is as many digits as one of 10: m/s and m/s² by powers of ten."""
    fast = NAMED.format(crank="A", rocker="B").replace("speed = 10", "speed = 1e50")
    pages = calculation(drawings_from(fast, language), "key")
    figures = re.findall(
        r"\d[\d.,]*(?=·10[⁰¹²³⁴⁵⁶⁷⁸⁹])", " ".join(mark.markup for mark in texts(pages))
    )
    assert len(figures) > 20
    assert max(len(figure) for figure in figures) <= 7


@pytest.mark.parametrize(("name", "drawn"), [("link-motion", False), ("slider-crank", True)])
def test_nothing_of_accelerations_is_told_where_no_plan_of_them_is_drawn(name, drawn):
    found = relations(drawings(name))
    told = {relation.left for _, several in found for relation in several}
    assert ("*k*_a" in told) is drawn
    assert ("*a*_{A}" in told) is drawn


# --- in its order --------------------------------------------------------------------------------

SYMBOL = re.compile(r"\*[vaωελ]\*(?:_(?:\{[^}]*\}|\w))?(?:\^\{?[νταcr]\}?)?")
"""A velocity, an acceleration, a rate, or the ratio of two trial plans."""


def symbols(markup):
    """The vectors and rates of a formula."""
    return {
        m[0] for m in SYMBOL.finditer(markup) if not markup[m.end() :].startswith(("^1", "^{1"))
    }


@pytest.mark.parametrize("name", HALVES[1])
def test_what_a_relation_uses_is_found_before_it_and_no_rate_enters_a_plan_in_degrees(name):
    whole = [r for _, section in relations(drawings(name)) for r in section if r.result]
    late = []
    for place, relation in enumerate(whole):
        known = {r.left for r in whole[:place]}
        later = {r.left for r in whole[place + 1 :]}
        used = symbols(relation.symbols) - {relation.left}
        late += [(relation.left, name) for name in used & later - known]
        assert "deg" not in relation.unit
        if relation.unit.startswith("°/s"):
            assert any(r.left == relation.left and r.unit.startswith("rad/s") for r in whole)
    assert not late


@pytest.mark.parametrize("name", HALVES[1])
def test_what_is_read_off_a_plan_is_the_motion(name):
    """To a twentieth of a millimetre of the plan, and to half of the last digit."""
    both, compared = drawings(name), 0
    for drawing in both:
        told = {r.left: r.result for _, some in relations(both) for r in some if r.result}
        scale = drawing.scales.kv if drawing.kind == "velocity" else drawing.scales.ka
        for (what, of), number in drawing.trace.program.targets.items():
            printed = told.get(symbol(f"{drawing.vector.letter}_{of}"))
            if what == drawing.kind and printed and number in drawing.trace.values:
                size, compared = abs(drawing.trace.values[number]), compared + 1
                value, unit = last_digit(printed)
                assert abs(value - size) < 0.51 * unit + 6e-5 * scale, of
    assert compared


ASKED_NUMBERS = (
    ("velocity", "v", "points"),
    ("omega", "ω", "links"),
    ("acceleration", "a", "points"),
    ("epsilon", "ε", "links"),
)


@pytest.mark.parametrize("name", HALVES[0])
def test_the_box_at_the_end_has_every_number_that_is_asked(name):
    """To half of the last digit, in a frame of its own below the last relation."""
    *_, last = calculations(name, None, "key", "en")
    asked, motion = drawings(name)[0].scene.ask, mechanism_named(name).solve()
    wanted = {
        symbol(f"{letter}_{lettered(of)}"): abs(getattr(getattr(motion, whose)[of], key))
        for key, letter, whose in ASKED_NUMBERS
        for of in getattr(asked, key)
    }
    answers = [text for text in texts([last]) if text.cls == "caption answer"]
    frames = [m for m in last.marks if isinstance(m, Polyline) and m.cls == "panel answer"]
    top, _, bottom, _ = (y for _, y in frames[0].points) if frames else (0.0,) * 4
    lines = [t.markup.rstrip(";") for t in answers if t.height < 3 and top < t.y < bottom]
    assert len(answers) == len(lines) + bool(lines)
    said = dict(re.findall(r"(?:^|; )(\S+) = ([−\d.,·⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)", "; ".join(lines)))
    for left, size in wanted.items():
        value, unit = last_digit(said[left])
        assert abs(value - size) < 0.51 * unit + 1e-9 * size, left


def test_strokes_are_requested_where_their_boxes_are_and_swings_of_links_only():
    """The calculation asks for a block's stroke and a link's swing; no plan's sheet asks for it."""
    text = Path(scene_files.find("slotted-lever")).read_text(encoding="utf-8")
    text = text.replace("[ask]", "[ask]\nstrokes = [3, 5]\ntime_ratios = [5]")
    mechanism = Mechanism(read_text(text, "slotted-lever", None, {}))
    verdict = mechanism.witness(mechanism.solve())
    drawings = drawings_of(mechanism, verdict, words("en"))
    rows = [plain(row.markup) for row in all_rows(drawings, {}, solved=False)]
    asked = (
        "the stroke of block 5, between its dead positions",
        "the swing of link 3, between its dead positions",
        "the time ratio of link 5",
    )
    below = " ".join(rows[rows.index("Strokes and time ratios") + 1 :])
    assert "; ".join(asked) in below
    assert not {*asked} & {each for drawing in drawings for each in asked_words(drawing)}
    solved = " ".join(plain(row.markup) for row in all_rows(drawings, {}, solved=True))
    assert not any(each in solved for each in asked)


@pytest.mark.parametrize("count", range(1, 9))
def test_no_page_has_a_single_line_of_a_section(count):
    """Nor does a page end with a heading, wherever it ends."""
    heading, line = CalculationRow("h", heading=True), CalculationRow("x")
    rows = [heading, *[line] * 12, heading, *[line] * count, heading, line]
    for end in range(60, 160):
        pages = ["".join("xh"[row.heading] for _, row in p) for p in paged(rows, 5.5, float(end))]
        assert "".join(pages) == "".join("xh"[row.heading] for row in rows)
        for page, after in pairwise(pages):
            assert not page.endswith("h")
            assert after.startswith("h") or not page.endswith("hx")
            assert len(after.partition("h")[0]) != 1
