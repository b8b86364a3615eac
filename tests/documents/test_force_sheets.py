"""The sheets of forces: made where forces are asked, in every view and language, and checked."""

from __future__ import annotations

import random
import re
from functools import cache
from itertools import pairwise
from pathlib import Path

import pytest
import shapely

from graphkin.classroom.sheet_files import sheet_files
from graphkin.construction.core.kind import constructions
from graphkin.construction.core.program import Part
from graphkin.construction.forces.moments import ForceArm
from graphkin.construction.forces.polygon import PolygonStart
from graphkin.documents.diagrams_sheet import force_courses
from graphkin.documents.force_fields import force_drawing, traced
from graphkin.documents.positions import positions_of
from graphkin.documents.scaling import sheet_motion
from graphkin.documents.sentences import force_relations, load_data
from graphkin.documents.sheet import asked_words
from graphkin.documents.sheet_documents import drawings_of, hand_out, proved
from graphkin.drawing.field import paper_of
from graphkin.drawing.marks import LineMark, Page, Text, reach, style_class
from graphkin.drawing.richtext import plain
from graphkin.drawing.style import FORCES, INKS
from graphkin.drawing.symbol_markup import symbol
from graphkin.mechanism import Mechanism, load
from graphkin.scene.house import house_of
from graphkin.scene.read_scene import read_scene, read_text
from graphkin.text import LANGUAGES, words
from graphkin.text.errors import StructureError
from tests.chance.forces import dyads
from tests.chosen import EVERY, FOLDER, by_turns
from tests.laws.force_routes import loaded
from tests.mechanisms import mechanism_of
from tests.scene_files import scene_text

SCENES = Path(__file__).parents[1] / "scenes" / "forces"
NAMES = (
    "class-three",
    "four-bar",
    "gas-engine",
    "gears",
    "planetary",
    "rack",
    "ram",
    "roller",
    "shaper",
    *("tipper", "cam"),
)
DRAWN = (*NAMES, "cam-rocker", "cylinders")
"""Those with a lever, and all: a moment on a cam's rocker has no point, two drivers no lever."""


@cache
def forces_of(name: str, language: str = "en"):
    """The drawing of the forces of a scene."""
    mechanism = load(SCENES / f"{name}.toml")
    verdict = proved(mechanism, sheet_motion(mechanism))
    return force_drawing(mechanism, drawings_of(mechanism, verdict, words(language)))


@cache
def sheet_of(name: str, view: str, language: str | None = None) -> tuple[Page, ...]:
    """The pages of the force sheet."""
    found = hand_out(load(SCENES / f"{name}.toml"), view, language)
    return next(each.pages for each in found if each.kind == "force")


def texts(page: Page) -> list[Text]:
    return [mark for mark in page.marks if isinstance(mark, Text)]


@pytest.mark.parametrize(
    ("name", "view", "language"), by_turns(DRAWN, ("key", "task", "steps", "overlay"), LANGUAGES)
)
def test_every_view_has_a_sheet_of_forces_that_fits_and_no_gap_in_any_language(
    name, view, language
):
    for page in sheet_of(name, view, language):
        page.check()
        assert not [m.markup for m in texts(page) if re.search(r"None|nan\b|[{}]", plain(m.markup))]


def test_a_task_gives_the_scales_that_the_lecturer_chose():
    """Nothing else says how large polygons and lever are to be drawn."""
    drawing = forces_of("four-bar")
    said = " ".join(plain(m.markup) for page in sheet_of("four-bar", "task") for m in texts(page))
    for letter, scale in (("F", drawing.scales.kF), ("v", drawing.scales.k_lever)):
        (found,) = {float(each) for each in re.findall(rf"k{letter} = ([\d.]+) \S+/mm", said)}
        assert found == pytest.approx(scale / 1000)


@pytest.mark.parametrize("view", ["key", "task"])
@pytest.mark.parametrize("name", ["four-bar", "gas-engine", "planetary"])
def test_the_calculation_gives_the_masses_and_loads_that_its_relations_use(name, view):
    """Each mass, inertia, load and stiffness, before the first relation."""
    parts = hand_out(load(SCENES / f"{name}.toml"), view, "en")
    pages = next(each.pages for each in parts if each.kind == "calculation")
    said = " ".join(plain(m.markup) for page in pages for m in texts(page)).partition("Driver")[0]
    drawing = forces_of(name)
    given = load_data(drawing)
    scene = drawing.scene
    masses = [link for link, each in scene.forces.masses.items() if not each.mass.is_zero()]
    assert all(f"m{link} = " in said for link in masses)
    assert all(plain(each.name) + " = " in said for each in given if each.value)


def test_scenes_without_forces_have_no_such_sheet():
    kinds = [each.kind for each in hand_out(load(FOLDER / "shaper.toml"))]
    assert kinds == ["velocity", "acceleration", "calculation"]


@pytest.mark.parametrize("name", NAMES)
def test_lever_and_polygons_agree_and_the_sheet_says_it(name):
    drawing = forces_of(name)
    (lever,) = drawing.lever_balances()
    assert lever.difference(drawing) < 1e-12
    shown = (mark for page in sheet_of(name, "key") for mark in texts(page))
    (said,) = {mark.markup for mark in shown if mark.name == "witness"}
    assert "equations of equilibrium" in said and "lever and polygons" in said


def test_seven_fields_beside_a_wide_mechanism_have_room():
    """Six polygons and the lever, which are 143 mm wide together; the usual captions need 150."""
    made = dyads(30)
    mechanism = loaded(made.mechanism, random.Random(30))
    pages = next(each.pages for each in hand_out(mechanism) if each.kind == "force")
    for page in pages:
        page.check()


def printed_arms(name: str, view: str = "key") -> dict[str, str]:
    """The arms of a sheet's tables, by their symbols."""
    cells = [m for page in sheet_of(name, view) for m in texts(page) if style_class(m) == "table"]
    rows = pairwise(cells)
    return {one.markup: plain(two.markup) for one, two in rows if one.markup[:3] in ("*h*", "*H*")}


@pytest.mark.parametrize("name", ("four-bar", "shaper", "gas-engine"))
def test_the_key_has_the_arms_of_weights_and_of_the_lever(name):
    """A weight has the horizontal distance of its line; on the lever, the arm is a power."""
    drawing, printed = forces_of(name), printed_arms(name)
    values, found = drawing.trace.values, 0
    for each in constructions(drawing.trace.program, ForceArm):
        if each.name.startswith("G_") and symbol(each.number) in printed:
            apart = abs((values[each.place] - values[each.about]).real)
            assert printed[symbol(each.number)] == f"{drawing.on_paper(apart):.2f}"
            found += 1
    (lever,) = drawing.lever_balances()
    for _, number, moment, force, arm in lever.terms(drawing):
        if force and arm > 0.3:
            length = abs(moment) / force / drawing.scales.k_lever * 1000
            assert printed[symbol(number)] == f"{length:.2f}"
            found += 1
    assert found > 3


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("gears", ["the reactions in pins", "the contact forces on links 2, 3"]),
        ("belt-on-arm", ["the reactions in pins", "both strands of the belt of link 2"]),
        ("rack", ["the guide of block", "the contact force on link"]),
    ],
)
def test_the_task_names_each_pair_by_its_kind(name, said):
    asked = [plain(each) for each in asked_words(forces_of(name))]
    for words_said in said:
        assert any(words_said in each for each in asked), asked


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_task_says_which_link_pushes_which(language):
    said = " ".join(plain(mark.markup) for mark in texts(sheet_of("four-bar", "task", language)[0]))
    assert "Rik" in said


def test_a_task_lists_no_arms():
    assert not printed_arms("four-bar", "task")


@pytest.mark.parametrize("name", NAMES)
def test_a_pencil_s_error_moves_both_balances_by_little(name):
    """Forces and arms of the paper, read to 0.1 mm, balance the lever within the pencil's error."""
    drawing = forces_of(name)
    (lever,) = drawing.lever_balances()
    read = [(sign(m) * f * round(arm, 1), f * 0.05) for _, _, m, f, arm in lever.terms(drawing)]
    couples = [m for _, _, m, force, _ in lever.terms(drawing) if not force]
    scale = drawing.scales.k_lever / 1000
    total = sum(value for value, _ in read) * scale + sum(couples)
    allowed = sum(error for _, error in read) * scale
    exact = sum(m for _, _, m, _, _ in lever.terms(drawing))
    assert abs(total - exact) <= allowed


@pytest.mark.parametrize(
    ("name", "language"),
    by_turns(["shaper", "gas-engine"], LANGUAGES if EVERY else ("ru", "de")),  # the longest words
)
def test_checks_of_forces_stay_within_a_sheet_of_a4(name, language):
    house = house_of('graphkin = 1\n[pages]\npaper = "A4"\n', ".")
    source = load(SCENES / f"{name}.toml").scene.source
    found = hand_out(Mechanism(read_scene(source, house=house)), "key", language)
    paper, said = paper_of("A4", "ISO"), []
    for page in next(each.pages for each in found if each.kind == "force"):
        feet = [mark for mark in texts(page) if mark.name in ("witness", "flattest")]
        said += [plain(mark.markup) for mark in feet if mark.name == "witness"]
        for mark in feet:
            assert reach(mark)[2] <= paper.area[2] - 0.5
            others = (shapely.box(*reach(m)) for m in texts(page) if m is not mark)
            assert not any(shapely.box(*reach(mark)).intersects(other) for other in others)
    told, told_lever = (
        plain(words(language)(f"page.{key}_verified", difference="1"))
        for key in ("forces", "lever")
    )
    assert told[:-1] in " ".join(said) and told_lever[:-1] in " ".join(said)


@pytest.mark.parametrize(("name", "number"), [("class-three", "h_11"), ("tipper", "h_3")])
def test_an_arm_ends_at_the_edge_of_its_field_and_a_note_says_so(name, number):
    page, *_ = sheet_of(name, "key")
    left, top, right, low = forces_of(name).fields.mechanism.rect
    on_mechanism = [mark for mark in page.marks if reach(mark)[0] < right]
    arms = [m for m in on_mechanism if style_class(m) in ("dimension", "ray")]
    arms += [m for m in on_mechanism if m.name == number and style_class(m) == "arrowhead"]
    assert any(mark.name == number for mark in arms)
    for mark in arms:
        box = reach(mark)
        assert left <= box[0] and box[2] <= right and top + 6.5 <= box[1] and box[3] <= low
    heads = [m for m in arms if m.name == number and style_class(m) == "arrowhead"]
    assert len(heads) == 1
    said = plain(words("en")("page.arm_beyond", name=symbol(number)))
    assert said in [plain(mark.markup) for mark in texts(page)]


def sign(value: float) -> int:
    return 1 if value > 0 else -1


@pytest.mark.parametrize("name", DRAWN)
def test_every_force_has_a_class_of_forces_and_a_name(name):
    page, *_ = sheet_of(name, "key")
    own = [m for m in page.marks if isinstance(m, LineMark) and style_class(m) in FORCES]
    assert own
    assert all(mark.name and mark.step is not None for mark in own)


@pytest.mark.parametrize("name", NAMES)
def test_a_force_of_a_polygon_is_as_long_as_its_scale_says(name):
    """Law: each side, measured on the sheet, times k_F is the force of the step behind it."""
    drawing = forces_of(name)
    page, *_ = sheet_of(name, "key")
    k, sides = drawing.scales.kF / 1000, 0
    for kind in constructions(drawing.trace.program, PolygonStart):
        field = drawing.fields.polygons[kind.polygon]
        assert abs(field.mm * k - 1) < 1e-12
    for mark in page.marks:
        if not isinstance(mark, LineMark) or style_class(mark) not in ("load", "inertia"):
            continue
        step = drawing.trace.program.steps[mark.step]
        if step.role == "corner":
            force = drawing.trace.values[step.of.force]
            length = abs(complex(mark.x2 - mark.x1, mark.y2 - mark.y1))
            assert abs(length * k - abs(force)) < 1e-6 * abs(force)
            sides += 1
    assert sides


@pytest.mark.parametrize("name", DRAWN)
def test_every_polygon_has_its_start_marked_and_its_links_named(name):
    drawing = forces_of(name)
    page, *_ = sheet_of(name, "key")
    starts = [*constructions(drawing.trace.program, PolygonStart)]
    captions = [mark.markup for mark in texts(page) if mark.name == "field-caption"]
    for start in starts:
        assert any(said.startswith(f"{start.polygon}:") for said in captions)
        assert any(mark.step == start.start for mark in page.marks)


def test_each_step_page_adds_marks_and_the_last_is_the_key():
    pages = sheet_of("four-bar", "steps")
    counts = [sum(style_class(m) in FORCES for m in page.marks) for page in pages]
    assert counts == sorted(counts)
    (key,) = sheet_of("four-bar", "key")
    assert counts[-1] == sum(style_class(m) in FORCES for m in key.marks)


LOADED = """[[loads]]
link = {link}
moment = 10

[[drivers]]"""


def under_load(name: str, link: int | str) -> Mechanism:
    """A scene with a moment on a link, which asks for the balance."""
    text = (FOLDER / f"{name}.toml").read_text(encoding="utf-8")
    text = text.replace("[[drivers]]", LOADED.format(link=link), 1)
    return Mechanism(read_text(text.replace("[ask]", "[ask]\nbalance = true", 1), name, None, {}))


@pytest.mark.parametrize(
    ("name", "link", "said"),
    [
        ("plates-coupled", 2, "class IV"),
        ("gears-double-planet", 2, "coupled train"),
        ("platform-3rpr", 7, "closed by a driver"),
        ("plank-two-sizes", 3, "closed by a wheel"),
        ("wheel-in-ring", 2, "rolling on link 0"),
        ("rope-levers", 3, "order 2"),
        ("plates-ring", 3, "class IV"),
        ("gears-ravigneaux", 2, "coupled train"),
        ("gears-simpson", 3, "coupled train"),
        ("rod-and-wheel", 3, "closed by a driver"),
    ][: None if EVERY else 6],  # each kind once
)
def test_a_group_whose_forces_are_not_drawn_is_refused_and_solved(name, link, said):
    """The sheet says in one sentence that solve has the numbers, which virtual power proves."""
    mechanism = under_load(name, link)
    with pytest.raises(StructureError) as caught:
        hand_out(mechanism)
    (problem,) = caught.value.problems
    assert said in str(problem) and "not drawn yet" in str(problem)
    assert "graphkin solve gives their numbers" in str(problem)
    _, verdict = mechanism.forces()
    assert verdict.agrees and not verdict.constructed and abs(verdict.power) < 1e-12


def test_such_a_group_is_refused_on_the_sheets_of_all_positions():
    with pytest.raises(StructureError, match="graphkin solve gives their numbers"):
        hand_out(under_load("rod-and-wheel", 3), "positions")


@pytest.mark.parametrize(
    ("name", "link", "said"),
    [("locomotive", 4, "redundant constraints"), ("belts-crossed", 2, "belt")],
)
def test_forces_without_numbers_are_refused_with_the_reason(name, link, said):
    """The sheet says what solve says, not that solve would have them."""
    mechanism = under_load(name, link)
    with pytest.raises(StructureError) as solved:
        mechanism.forces()
    with pytest.raises(StructureError) as drawn:
        hand_out(mechanism)
    assert str(drawn.value) == str(solved.value) and said in str(drawn.value)


def test_the_plan_of_forces_follows_the_motion():
    """Its steps come after those of the motion, which are the same as without forces."""
    mechanism = load(SCENES / "shaper.toml")
    program = traced(mechanism).program
    own = mechanism.program.steps
    assert program.steps[: len(own)] == own
    assert all(step.part is not Part.FORCE for step in own)


@pytest.mark.parametrize("name", NAMES)
def test_every_result_of_the_calculation_follows_from_its_figures(name):
    """A reader with a pocket calculator gets the printed result, to one in its last digit."""
    checked = 0
    for _, found in force_relations(forces_of(name)):
        for relation in found:
            put = relation.figures.rpartition("= ")[2]
            if not put or "^" in put or "10" + "⁻" in put:
                continue
            worth = reckoned(put)
            result = float(relation.result.replace(" ", ""))
            assert abs(abs(worth) - result) <= 2e-3 * result + 0.006, relation
            checked += 1
    assert checked > 6


def reckoned(put: str) -> float:
    """The value of a sum of products and quotients as printed."""
    text = put.replace("·", "*").replace("−", "-").replace(" ", "")
    assert re.fullmatch(r"[-+*/().0-9\s]+", text), put
    return float(eval(text, {"__builtins__": {}}))


def test_a_form_does_not_give_the_signs_of_moments_away():
    for _, found in force_relations(forces_of("shaper")):
        for relation in found:
            shown = " ".join(relation.parts(solved=False))
            assert not re.search(r"h\}?_\{?\d.*[+−]", shown), shown


@pytest.mark.parametrize("view", ["key", "task"])
def test_the_web_page_of_forces_holds_the_sheet_and_fetches_nothing(view):
    mechanism = load(SCENES / "four-bar.toml")
    files, notes = sheet_files(mechanism, "four-bar", "fb", view, None, ["html"])
    page = files[f"fb-force-{view}.html"].decode()
    assert not notes and "default-src 'none'" in page
    assert not re.search(r"(?:src|href)=\"http", page)
    told = re.findall(r'<li id="step-\d+"', page)
    assert len(told) == (0 if view == "task" else len(sheet_of("four-bar", "steps")))
    assert all(f"--{ink}:" in page for ink in INKS.values())


def test_a_reaction_that_acts_beyond_its_field_is_noted_and_not_drawn():
    """At 105° the guide of the ram would push 144 mm from C on paper, within the polygons."""
    text = (SCENES / "shaper.toml").read_text(encoding="utf-8").replace("angle = 38", "angle = 105")
    text = text.replace("mass = 3\ncentre", "mass = 0\ncentre").replace("[-2000, 0]", "[-2300, 0]")
    (page,) = next(
        e.pages for e in hand_out(Mechanism(read_text(text, "far", None, {}))) if e.kind == "force"
    )
    assert any("beyond the edge" in plain(mark.markup) for mark in texts(page))
    right = next(m.x1 for m in page.marks if isinstance(m, LineMark) and m.name == "field-border")
    own = [m for m in page.marks if isinstance(m, LineMark) and m.name == "x_5"]
    assert all(max(m.x1, m.x2) < right for m in own)


@pytest.mark.parametrize("first", [2, 3, 4])
def test_a_heavy_rod_on_a_pin_of_three_links_is_drawn(first):
    """Its force on the others is the opposite of that on it; the links have only their sums."""
    text = scene_text("laws/three-links-on-a-pin", first=first, second=4)
    text += '[ask]\nvelocity = ["E"]\nreactions = ["B", "D"]\nbalance = true\n'
    mechanism = mechanism_of(text)
    assert "force" in {each.kind for each in hand_out(mechanism, "key")}


def test_the_diagrams_of_a_motion_show_the_forces_of_each_position():
    """The crosses of the moment and of a reaction are what the scene gives there."""
    mechanism = load(SCENES / "gas-engine.toml")
    found = positions_of(mechanism, words("en"))
    at = found.planned_places
    courses = {each.name: each for each in force_courses(found, at, at)}
    assert {"M_b1", "R_01", "R_03", "R_32"} <= set(courses)
    for k in (0, 5, 11):
        phi = round(at[k]) % 360
        here, verdict = load(SCENES / "gas-engine.toml", phi=phi).forces()
        assert verdict.agrees
        (balance,) = here.balance
        assert courses["M_b1"].at_positions[k] == pytest.approx(balance.moment, rel=1e-9)
        force = next(e.force for e in here.reactions if (e.name, e.link) == ("O", "1"))
        assert courses["R_01"].at_positions[k] == pytest.approx(abs(force), rel=1e-9)
    pages = {each.kind: each.pages for each in hand_out(mechanism, "diagrams")}["courses"]
    names = {getattr(mark, "name", "") for page in pages for mark in page.marks}
    assert {"M_b1", "R_01"} <= names


def test_every_moment_on_a_link_is_on_the_mechanism():
    """The given moment and the inertia moment of one link, each with its own sense."""
    drawing = forces_of("gears")
    wanted = {drawing.symbol(name) for name in ("M_3", "M_i3", "M_i2", "M_b1")}
    shown = [mark for page in sheet_of("gears", "key") for mark in page.marks]
    labels = [str(mark) for mark in shown if isinstance(mark, Text)]
    assert all(any(symbol in label for label in labels) for symbol in wanted)
    assert drawing.turnings("3")["M_3"] * drawing.turnings("3")["M_i3"] < 0


def test_a_task_asks_for_the_forces_of_contacts_by_their_name():
    """Teeth and cams touch; only blocks have guides."""
    task = next(
        part for part in hand_out(load("gears-forces"), "task", "en") if part.kind == "force"
    )
    said = " ".join(m.markup for m in task.pages[0].marks if isinstance(m, Text))
    assert "the contact forces on links 2, 3" in said
    assert "blocks" not in said
