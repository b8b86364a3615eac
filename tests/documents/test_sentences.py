"""What the sentences, the data and the calculation say is enough to draw by, in every scene."""

from __future__ import annotations

import re
from cmath import phase
from math import asin, degrees

import pytest

from graphkin.construction.core.component import components_on
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.given_data import given
from graphkin.construction.core.layout import lay_out
from graphkin.construction.core.naming import TINY, angle_symbol
from graphkin.construction.core.program import Plane
from graphkin.construction.rate_relations import drawn_bars, laid_bars
from graphkin.construction.result_tables import slide_rows, vectors
from graphkin.documents.relations import dimensioned_bars, ends_on, relations
from graphkin.documents.sentences import sentences
from graphkin.documents.sheet import sheet
from graphkin.documents.sheet_documents import drawings_of, proved
from graphkin.drawing.marks import Text
from graphkin.drawing.richtext import plain
from graphkin.drawing.symbol_markup import bar, symbol
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from graphkin.text import words
from tests.chosen import CHOSEN, FOLDER
from tests.documents.sheet_tools import drawings, named

LABS = [(lab, n) for lab in ("pump", "slotted-lever") for n in (7, 20)]
ALL = [*((name, None) for name in CHOSEN), *LABS]
HIGHER = (
    "rapid-return",
    "platform-3rpr",
    "stephenson-2-binary",
    "stephenson-2-ternary",
    "stephenson-3-crank",
)
BARS = r"(?:\*[A-Z]\*(?:_\{[^}]*\})?){2}"
BAR = re.compile(r"[/·]((?:\*[A-Z]\*(?:_\{[^}]*\})?){2})$")
ARTICLES = re.compile(r"\b(?:a|da|di|su|in) (?:la|il|lo|le|gli|i) |\b(?:a|da|di|su) l['’]")
CLASHING = re.compile(r"(?<!\S)(?:a A|a a|e E|e e)")


@pytest.fixture(params=ALL, ids=named)
def both(request) -> tuple[Drawing, ...]:
    return drawings(*request.param)


def all_said(found: tuple[Drawing, ...]) -> list[str]:
    """Every sentence, piece of data and remark of a scene."""
    said = [piece for drawing in found for piece in given(drawing)]
    said += [one.markup for drawing in found for one in sentences(drawing)]
    return said + [r.remark for _, section in relations(found) for r in section]


def test_every_length_of_the_calculation_is_known_or_measured_before_and_once(both):
    """A bar from A to B is no longer than one from A1 to B2 that lies on it."""
    first = both[0]
    told = (*dimensioned_bars(first.scene.bare), *laid_bars(first))
    known = {ends_on(first, *ends) for ends in told}
    said = " ".join([*given(first), *(names for names, _ in drawn_bars(first))])
    drawn_before = False
    for section, found in relations(both):
        drawn_before |= section == "lengths"
        for relation in found:
            bars = [ends_on(first, *ends) for ends in relation.over]
            names = {bar(p, q) for p, q in relation.over}
            if section in ("radii", "lengths") or (section == "cams" and relation.left in names):
                assert len(set(bars)) == 1 and bars[0] not in known, relation
                known.add(bars[0])
            elif drawn_before:
                assert set(bars) <= known, relation
                last = BAR.search(relation.symbols)
                assert not last or last[1] in names or last[1] in said, relation
    assert drawn_before


def test_what_a_driver_tells_is_not_measured():
    """The cylinder's length is told by its driver, and the arcs that find B and E are known."""
    for name in ("platform-3rpr", "cylinders-two"):
        found = dict(relations(drawings(name)))
        assert found["lengths"] == [], name


def test_every_bar_that_is_laid_off_is_told_as_long_as_it_is_drawn(both):
    """A hand lays off a length on paper: the calculation divides it by the scale."""
    drawing = both[0]
    drawn = {name for names, _ in drawn_bars(drawing) for name in re.findall(BARS, names)}
    for each in sentences(drawing):
        if drawing.trace.program.steps[each.step].plane is not Plane.MECHANISM:
            continue
        for laid in re.finditer(rf"lay off ({BARS})(?=:|;|,| at |$)", each.markup):
            assert laid[1] in drawn, each.markup


def test_every_point_that_a_sentence_speaks_of_has_a_letter(both):
    """A point without one would leave its gap empty, between two spaces."""
    assert not [said for said in all_said(both) if "  " in said]


# --- trial plans ---------------------------------------------------------------------------------


@pytest.mark.parametrize("language", ["en", "ro", "it"])
def test_a_trial_goes_on_from_the_end_of_a_component_without_a_letter(language):
    """The Coriolis component under E ends in a point of the trial plan that bears no name."""
    said = [one.markup for one in sentences(drawings("platform-3rpr", None, language)[1])]
    end = {
        "en": "from its end lay off",
        "ro": "din capătul ei se ia",
        "it": "dal suo estremo riportare",
    }
    ways = [re.search(rf"; {end[language]} (\S+) ∥", markup) for markup in said]
    assert [way[1] for way in ways if way] == [symbol("a_B4B^r")] * 2
    assert not [markup for markup in said if "  " in markup]


@pytest.mark.parametrize("name", HIGHER)
def test_the_gaps_of_the_trials_divide_the_line_as_the_sentence_says(name):
    """Checked on the plan itself: the parts of the line are to each other as the two numbers."""
    for drawing in drawings(name):
        (said,) = [s for s in sentences(drawing) if "divide the line" in s.markup]
        one, two = (
            float(text) for text in re.search(r"= ([\d.]+) : ([\d.]+)", said.markup).groups()
        )
        for number in said.all_steps:
            step = drawing.trace.program.steps[number]
            first, second, _ = (drawing.trace.values[arg] for arg in step.args)
            right, apart = drawing.trace.values[number], abs(second - first)
            if apart:
                parts = abs(right - first), abs(second - right)
                assert abs(parts[0] * two - parts[1] * one) < 0.02 * apart * (one + two)
                assert (sum(parts) > 1.000001 * apart) is ("beyond" in said.markup)


# --- closing and Coriolis ------------------------------------------------------------------------


@pytest.mark.parametrize("language", ["en", "ro", "it"])
@pytest.mark.parametrize(
    ("angle", "zero"), [("90", "vAA3 = 0"), (f"{360 - degrees(asin(0.4))!r}", "ω3 = 0")]
)
def test_it_is_said_which_factor_of_a_coriolis_component_is_zero(angle, zero, language):
    """With the crank along the lever the block stands on it; square to it the lever turns back."""
    text = (FOLDER / "shaper.toml").read_text().replace('angle = "angle"', f"angle = {angle}")
    mechanism = Mechanism(read_text(text, "shaper", None, {}))
    found = drawings_of(mechanism, proved(mechanism, mechanism.solve()), words(language))
    told = [plain(one.markup) for one in sentences(found[1])]
    (said,) = (one for one in told if one.startswith("aAA3c = 0, "))
    assert said.endswith(f" {zero}")


@pytest.mark.parametrize("name", ["shaper", "oscillating-slide"])
def test_a_figure_and_its_sentence_have_the_same_factor_of_the_relative_velocity(name):
    """On the mechanism stands 2v, as the law has it; its segment is told as it is set there."""
    drawing = drawings(name)[1]
    said = next(s.markup for s in sentences(drawing) if "Coriolis" in s.markup)
    _, slid = re.search(r"set 2·(\*v\*_\{(\w+)\}) = ", said).groups()
    page = sheet(drawing, "key", "2/2", lay_out(drawing))[0]
    labels = {mark.markup for mark in page.marks if isinstance(mark, Text)}
    assert any(f"2*v*_{{{slid}}}" in label for label in labels), labels
    assert ("of the velocity plan’s scale" in said) is (drawing.scales.larger > 1)


# --- guides --------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["crank-fixed-slot", "mobility-cam", "gears-rack"])
def test_a_block_moves_to_where_its_guide_is_positive_when_its_speed_is(name):
    (drawing, *_) = drawings(name)
    ways = {"to the right": 0, "upwards": 90, "to the left": 180, "downwards": -90}
    table = {row.name: row.cells[-1] for row in slide_rows(drawing, empty=False)}
    seen = 0
    for block in drawing.scene.ask.slides:
        link = drawing.scene.links[block]
        if link.slides[0].on != "0":
            continue
        piece = next(p for p in given(drawing) if p.startswith(f"{symbol(link.points[0])} slides"))
        said = re.search(
            r"\(positive from .*? (to the right|upwards|to the left|downwards)\)", piece
        )
        velocity = drawing.trace.value("velocity", link.points[0])
        speed = drawing.trace.value("slide speed", block)
        off = degrees(phase(velocity if speed > 0 else -velocity)) - ways[said[1]]
        assert abs((off + 180) % 360 - 180) < 46
        first, last = drawing.words("calculation.forward", guide="|").split("|")
        told = table[f"slide {block}"]
        assert (told.startswith(first) and told.endswith(last)) is (speed > 0)
        seen += 1
    assert seen


# --- languages -----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ALL, ids=named)
def test_italian_joins_its_prepositions_and_parts_its_vowels(name):
    for said in all_said(drawings(*name, "it")):
        assert not ARTICLES.search(said), said
        assert not CLASHING.search(plain(said)), said


def test_italian_parts_equal_vowels_alone():
    spoken = words("it")
    assert spoken("step.compass", bar="AB", p="A") == "arco di raggio AB e centro A"
    assert spoken("step.square-to", s="b", bar="*A**B*") == "per b la perpendicolare ad *A**B*"
    assert spoken("step.square-to", s="b", bar="*O**B*") == "per b la perpendicolare a *O**B*"
    assert spoken("step.kennedy-line", m="*I*", n="*E*") == "congiungere *I* ed *E*"


@pytest.mark.parametrize("language", ["en", "ro", "it"])
def test_one_vector_is_transferred_to_its_point_and_several_each_to_its_own(language):
    both = {"en": "each", "ro": "fiecare", "it": "ciascuna"}
    for name, one in (("cam-roller", True), ("pump", False)):
        for drawing in drawings(name, 7 if name == "pump" else None, language):
            last = plain(sentences(drawing)[-1].markup)
            assert (both[language] in last) is not one


def test_coordinates_that_do_not_end_have_the_digits_that_a_hand_needs():
    drawing, _ = drawings("geneva-wheel")
    assert "O2 (70.7107, 0) mm" in map(plain, given(drawing))


@pytest.mark.parametrize(
    ("name", "language"),
    [("cam-plate", "en"), ("cam-roller", "ro"), ("cam-lever", "it"), ("cam-plate-lever", "ro")],
)
def test_the_law_of_a_cam_bears_its_follower_s_index_and_no_symbol_of_a_driver(name, language):
    """The displacement of a plate is s too: one letter names one quantity on a sheet."""
    drawing, *_ = drawings(name, None, language)
    drivers = {plain(angle_symbol(drawing.scene, driver)) for driver in drawing.scene.drivers}
    law = next(s.markup for s in sentences(drawing) if "′" in s.markup and "″" in s.markup)
    named = re.findall(r"\*[sψ]\*[′″]?(?:_\{(\w+)\})? =", law)
    assert named == list(drawing.scene.cams) * 3
    assert not drivers & set(re.findall(r"(?<=[ ,])[sψ]\S*(?= =)", plain(law)))


@pytest.mark.parametrize(
    ("name", "language"), [("bar-on-roller", "en"), ("rope-on-drum", "ro"), ("plank-axle", "it")]
)
def test_no_rate_is_that_of_a_link_of_which_nobody_speaks(name, language):
    """What keeps a wheel on its track slides along it: both turn alike, and the track is named."""
    found = drawings(name, None, language)
    unseen = found[0].scene.unseen
    assert unseen
    parts = (r.parts(solved=True) for _, some in relations(found) for r in some)
    told = [*all_said(found), *(piece for pieces in parts for piece in pieces)]
    rates = {link for text in told for link in re.findall(r"\*[ωε]\*_\{?(\w+)", text)}
    assert rates and not rates & unseen


def test_of_many_triangles_on_one_mechanism_none_is_drawn():
    """Their components are computed, v²/l, and laid off; on a pump's sheet they are drawn."""
    for name, n, drawn in (("plates-ring", None, False), ("pump", 7, True)):
        sheet = drawings(name, n)[1]
        assert any(c.is_drawn(sheet) for c in components_on(sheet)) is drawn
        text = " ".join(one.markup for one in sentences(sheet))
        assert ("right triangle" in text) is drawn
        assert (", computed: " in text) is not drawn


@pytest.mark.parametrize("name", ["plank-two-sizes", "inflection-cardan"])
def test_the_calculation_tells_no_rounding_and_nothing_twice(name):
    """The plank stands level for an instant, the inflection pole lies on the axis: both are 0."""
    for _, some in relations(drawings(name)):
        said = [" ".join(relation.parts(solved=True)) for relation in some if relation.result]
        assert not [text for text in said if re.search("10⁻¹[0-9⁰¹²³⁴-⁹]", text)]
        assert len({*said}) == len(said)


# --- what is too short to be drawn ---------------------------------------------------------------

LEFT_OUT = "what is too short to be drawn is left out: "
SHORT = [*((name, None) for name in ("watt-1", "lifter", "stephenson-1")), ("pump", 29)]
SHORT += [("pump-collinear", 22), *(each for each in ALL if each != ("plates-ring", None))]
"""But for one of which a trial plan lays one off on its own, with the tangential component."""


@pytest.mark.parametrize("which", SHORT, ids=named)
def test_no_sentence_lays_off_what_is_too_short_or_draws_its_triangle(which):
    for drawing in drawings(*which):
        said = [plain(sentence.markup).partition(LEFT_OUT) for sentence in sentences(drawing)]
        for name, _, length, size in vectors(drawing):
            if size and re.search(r"\^[νc]$", name):
                own, is_short = plain(symbol(name)), length < TINY
                assert sum(own in after for _, _, after in said) == is_short, name
                assert not (is_short and any(own in before for before, _, _ in said)), name


@pytest.mark.parametrize(
    ("name", "is_said"), [("crank-rocker", True), ("excavator-relative", False)]
)
def test_how_a_rate_is_read_is_said_where_one_is_found(name, is_said):
    """Of an excavator the drivers give the rates of all links; of a crank-rocker that of one."""
    drawing = drawings(name)[0]
    how = plain(drawing.words("step.read-omega"))
    assert any(how in plain(each.markup) for each in sentences(drawing)) is is_said
