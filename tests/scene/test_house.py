"""The conventions of a school: house.toml, where it is found, and what it changes."""

from __future__ import annotations

import base64
import re
from io import BytesIO
from itertools import islice
from pathlib import Path

import pytest
from msgspec.structs import fields, replace
from PIL import Image

from graphkin.classroom.lab.read_lab import read_lab
from graphkin.classroom.printing.edition import read_edition
from graphkin.documents.scaling import scales
from graphkin.documents.sheet_documents import hand_out
from graphkin.drawing.frame import CELLS as DRAWN
from graphkin.drawing.frame import STUDENT
from graphkin.drawing.marks import Page, Text
from graphkin.drawing.richtext import plain
from graphkin.drawing.scale import preferred_scales, ratio
from graphkin.mechanism import Mechanism, load
from graphkin.scene import scene_files
from graphkin.scene.house import CELLS, HOUSE, HOUSE_KEYS, PLAIN, House, house_of, template
from graphkin.scene.read_scene import read_scene, read_text
from graphkin.studio.look import Sight, look
from graphkin.studio.panels import Memory
from graphkin.text.errors import SceneError
from graphkin.text.school_signs import SCHOOLS
from graphkin.writers.pdf import write_pdf
from graphkin.writers.svg import write_svg
from tests.running import Run
from tests.scene_files import scene_text


def picture(width: int, height: int) -> bytes:
    """A PNG picture."""
    found = BytesIO()
    Image.new("RGBA", (width, height), (0, 60, 130, 128)).save(found, "PNG")
    return found.getvalue()


PNG = picture(2, 1)
"""A picture of two pixels, one beside the other."""
SVG = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20"><path d="M0 0H40"/></svg>'
SCENE = scene_text("classroom/printed-lab")
LINES = "University of Somewhere", "Department of Mechanisms"
WRITTEN = f"""graphkin = 1
[header]
lines = {list(LINES)}
logo = "logo.png"
[title]
author = "A. Lecturer"
labels = {{ document_type = "Kind" }}
[pages]
language = "it"
ink = "black"
[signs]
set = "english"
"""


@pytest.fixture
def school(tmp_path: Path) -> Path:
    """A folder with a lab, the conventions of a school, and its logo."""
    (tmp_path / "logo.png").write_bytes(PNG)
    (tmp_path / HOUSE).write_text(WRITTEN, encoding="utf-8")
    (tmp_path / "scene.toml").write_text(SCENE, encoding="utf-8")
    rule = 'graphkin = 1\n[variants]\nset = { n = "number" }\n'
    (tmp_path / "lab.toml").write_text(rule, encoding="utf-8")
    return tmp_path


def texts(page: Page) -> list[str]:
    return [plain(mark.markup) for mark in page.marks if isinstance(mark, Text)]


# --- the list of keys -----------------------------------------------------------------------------


def test_the_template_changes_nothing_and_names_every_key() -> None:
    assert house_of(template(), "") == House(text=template())
    for key in HOUSE_KEYS:
        assert f"# {key.name} = {key.example}" in template()


@pytest.mark.parametrize("key", HOUSE_KEYS, ids=lambda key: f"{key.table}.{key.name}")
def test_every_example_can_be_uncommented(key, tmp_path: Path) -> None:
    (tmp_path / "logo.png").write_bytes(PNG)
    text = template().replace(f"# {key.name} = {key.example}", f"{key.name} = {key.example}", 1)
    assert house_of(text, str(tmp_path)).text == text


def test_every_field_of_the_record_has_a_key() -> None:
    given = {key.gives for key in HOUSE_KEYS if key.gives}
    assert given == {each.name for each in fields(House)} - {"signs", "text"}


def test_labels_are_those_of_the_cells_but_not_the_students() -> None:
    assert tuple(name for name, _, _ in DRAWN) == CELLS
    assert STUDENT not in CELLS


# --- mistakes -------------------------------------------------------------------------------------


def test_all_mistakes_are_told_at_once(tmp_path: Path) -> None:
    wrong = """
[header]
lines = ["a", "b", "c"]
logo = "no.png"
[title]
labels = { student = "Me" }
[pages]
language = "xx"
ink = "blue"
papers = 3
[scales]
steps = [1, 10]
[lines]
thick = "0.5"
[signs]
set = "englich"
normal = "n_t_t"
[hedder]
"""
    with pytest.raises(SceneError) as error:
        house_of(wrong, str(tmp_path))
    places = [str(problem.place) for problem in error.value.problems]
    assert places == [
        *("graphkin", "header.lines", "header.logo", "title.labels.student", "pages.language"),
        *(
            "pages.ink",
            "scales.steps",
            "lines.thick",
            "pages.papers",
            "signs.set",
            "signs.normal",
            "hedder",
        ),
    ]


@pytest.mark.parametrize("data", [b"no picture", b"<svg/>", PNG[:20], b"<!DOCTYPE a><svg/>", b""])
def test_a_file_that_is_no_picture_is_refused(data: bytes, tmp_path: Path) -> None:
    (tmp_path / "logo.png").write_bytes(data)
    with pytest.raises(SceneError, match=r"header\.logo: is no picture"):
        house_of('graphkin = 1\n[header]\nlogo = "logo.png"\n', str(tmp_path))


def test_a_logo_elsewhere_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="copy the picture there"):
        house_of('graphkin = 1\n[header]\nlogo = "../logo.png"\n', str(tmp_path))


@pytest.mark.parametrize("data, aspect", [(PNG, 2.0), (SVG, 2.0)])
def test_the_shape_of_a_logo(data: bytes, aspect: float, tmp_path: Path) -> None:
    (tmp_path / "logo").write_bytes(data)
    house = house_of('graphkin = 1\n[header]\nlogo = "logo"\n', str(tmp_path))
    assert house.logo is not None
    assert house.logo.aspect == aspect


# --- what it changes ------------------------------------------------------------------------------


def test_a_house_beside_a_scene_holds(school: Path) -> None:
    mechanism = Mechanism(read_scene(school / "scene.toml"))
    sheets = hand_out(mechanism)
    page, last = sheets[0].pages[0], sheets[-1].pages[0]
    assert page.lang == "it"
    assert {*LINES, "A. Lecturer", "Kind"} <= {*texts(page)}
    assert ", ".join(LINES) in texts(last)
    assert mechanism.scene.sheet.signs == SCHOOLS["english"].signs
    (logo,) = page.pictures
    assert logo.width == pytest.approx(2 * logo.height)


def test_what_a_scene_states_goes_first(school: Path) -> None:
    stated = '[sheet]\nowner = "Own"\nauthor = "B"\nlanguage = "ro"\nsigns = { normal = "m" }\n'
    (school / "scene.toml").write_text(f"{SCENE}\n{stated}", encoding="utf-8")
    sheet = read_scene(school / "scene.toml").sheet
    assert (sheet.owner, sheet.author, sheet.language) == ("Own", "B", "ro")
    assert (sheet.signs.normal, sheet.signs.tangential) == ("m", "t")


def test_the_students_box_stays_the_students(school: Path) -> None:
    page = hand_out(Mechanism(read_scene(school / "scene.toml")), "task")[0].pages[0]
    at = next(m for m in page.marks if isinstance(m, Text) and m.markup == "A. Lecturer")
    box = next(rect for name, rect, _ in DRAWN if name == "creator")
    assert not (at.x > 230 + box[0] and at.y < 251 + box[3])


@pytest.mark.parametrize("words", [90, 110])
def test_a_long_name_of_a_faculty_fits(words: int, school: Path) -> None:
    name = ("Faculty of Mechanical Engineering " * 6)[:words].strip()
    text = WRITTEN.replace(LINES[0], name)
    (school / HOUSE).write_text(text, encoding="utf-8")
    page = hand_out(Mechanism(read_scene(school / "scene.toml")))[0].pages[0]
    lines = [m for m in page.marks if isinstance(m, Text) and m.name == "legal_owner"]
    assert " ".join(plain(m.markup) for m in lines) == f"{name} {LINES[1]}"


def test_the_logo_is_in_the_files_and_they_are_the_same_each_time(school: Path) -> None:
    page = hand_out(Mechanism(read_scene(school / "scene.toml")))[0].pages[0]
    assert base64.b64encode(PNG).decode() in write_svg(page)
    assert b"/Subtype /Image" in write_pdf([page])
    assert write_pdf([page]) == write_pdf([page])


def test_a_logo_of_lines_is_drawn_as_lines(school: Path) -> None:
    pytest.importorskip("svglib")
    (school / "logo.png").write_bytes(SVG)
    page = hand_out(Mechanism(read_scene(school / "scene.toml")))[0].pages[0]
    assert b"/Subtype /Image" not in write_pdf([page])
    assert write_pdf([page]) == write_pdf([page])
    assert "data:image/svg+xml;base64," in write_svg(page)


def test_without_a_house_there_is_no_picture_and_no_header() -> None:
    scene = read_text(SCENE, "x")
    assert scene.house is PLAIN
    assert not PLAIN.files
    pages = [page for part in hand_out(Mechanism(scene)) for page in part.pages]
    assert not any(page.pictures for page in pages)
    assert not any(mark.name == "school" for page in pages for mark in page.marks)


def test_the_program_chooses_among_the_scales_of_the_school() -> None:
    scene = load("pump").scene
    chosen = {}
    for steps in ((), (1.0, 2.0), (1.0, 3.0)):
        own = replace(scene, sheet=replace(scene.sheet, steps=steps))
        chosen[steps] = scales(Mechanism(own)).words
    assert chosen == {(): "1:5", (1.0, 2.0): "1:10", (1.0, 3.0): "1:10"}
    small = islice(preferred_scales(0.03, (1.0, 2.0, 5.0)), 6)
    assert [ratio(kL) for kL in small] == ["20:1", "10:1", "5:1", "2:1", "1:1", "1:2"]


def test_all_lines_have_the_width_of_the_school() -> None:
    page = hand_out(Mechanism(read_text(SCENE, "x", house=House(thick=0.25))))[0].pages[0]
    assert "stroke-width:0.35;" in write_svg(page)  # the frame, 0.7 as a rule
    assert "stroke-width:0.7;" not in write_svg(page)
    usual = hand_out(Mechanism(read_text(SCENE, "x")))[0].pages[0]
    assert write_svg(usual) == write_svg(replace(page, weight=1.0))
    assert write_pdf([usual]) != write_pdf([page])


# --- where it is found ----------------------------------------------------------------------------


def test_the_command_takes_the_file_it_is_given(run: Run, school: Path, tmp_path: Path) -> None:
    other = tmp_path / "other.toml"
    other.write_text('graphkin = 1\n[header]\nlines = "Elsewhere"\n', encoding="utf-8")
    done = run("sheet", school, "--house", other, "-o", tmp_path / "out", "--format", "svg")
    assert done.exit_code == 0, done.output
    found = next((tmp_path / "out").glob("*-velocity-key.svg")).read_text(encoding="utf-8")
    assert "Elsewhere" in found and LINES[0] not in found


def test_your_own_holds_where_none_is_beside(
    run: Run, school: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("click.get_app_dir", lambda name: str(tmp_path / "own"))
    assert run("new", "house", "--own").exit_code == 0
    own = tmp_path / "own" / HOUSE
    own.write_text('graphkin = 1\n[header]\nlines = "Mine"\n', encoding="utf-8")
    for name, mine in (("pump", True), (str(school), False)):
        done = run("sheet", name, "-o", tmp_path / name[-4:], "--format", "svg")
        assert done.exit_code == 0, done.output
        found = next((tmp_path / name[-4:]).glob("*-velocity-key.svg")).read_text(encoding="utf-8")
        assert (">Mine<" in found) is mine


def test_a_wrong_house_is_one_clear_error(run: Run, tmp_path: Path) -> None:
    missing = run("sheet", "pump", "--house", tmp_path / "no.toml", "-o", tmp_path / "out")
    (tmp_path / HOUSE).write_text("graphkin = 1\n[pages]\nink = 3\nlanguage = 1\n")
    wrong = run("sheet", "pump", "--house", tmp_path / HOUSE, "-o", tmp_path / "out")
    assert (missing.exit_code, wrong.exit_code) == (2, 2)
    assert "no.toml: cannot be read" in missing.output
    assert re.findall(rf"{HOUSE}: pages\.(\w+): ", wrong.output) == ["language", "ink"]
    assert not (tmp_path / "out").exists()


def test_check_reads_a_house_and_other_commands_tell_it_from_a_scene(
    run: Run, school: Path
) -> None:
    done = run("check", school / HOUSE)
    assert done.exit_code == 0
    told = dict(line.split(maxsplit=1) for line in done.output.splitlines())
    assert (told["header"], told["ink"]) == ("; ".join(LINES), "black")
    assert "tangential t" in told["signs"]
    other = run("solve", school / HOUSE)
    assert other.exit_code == 2 and "is no scene; expected a scene" in other.output
    (school / HOUSE).write_text("graphkin = 1\n", encoding="utf-8")
    assert run("check", school / HOUSE).output == "all conventions are the usual ones\n"
    near = run("check", school / "huose.toml")
    assert "did you mean house.toml" not in near.output


def test_check_knows_conventions_by_their_tables_under_any_name(run: Run, tmp_path: Path) -> None:
    german = tmp_path / "german.toml"
    german.write_text('graphkin = 1\n[pages]\nlanguage = "de"\n', encoding="utf-8")
    assert run("check", german).output == "language de\n"


def test_a_class_keeps_the_conventions_it_was_made_with(
    run: Run, school: Path, tmp_path: Path
) -> None:
    roster, folder = tmp_path / "class.csv", tmp_path / "class"
    roster.write_text("id,number\na,1\n", encoding="utf-8")
    assert run("variants", school, roster, "-o", folder).exit_code in (0, 1)
    made = read_lab(school).house
    (school / HOUSE).write_text("graphkin = 1\n", encoding="utf-8")
    assert read_edition(folder).lab.house == made
    assert read_edition(folder).words().signs == SCHOOLS["english"].signs
    (folder / "lab" / HOUSE).write_text("graphkin = 1\n", encoding="utf-8")
    with pytest.raises(SceneError, match=rf"{HOUSE}: was changed since"):
        read_edition(folder)
    (school / HOUSE).unlink()
    assert run("variants", school, roster, "-o", folder, "--force").exit_code in (0, 1)
    assert read_edition(folder).lab.house == PLAIN


def test_the_shipped_labs_have_no_house() -> None:
    assert not [*scene_files.shelf().rglob(HOUSE)]


def test_the_studio_takes_the_house_of_its_folder(tmp_path: Path) -> None:
    memory = Memory()
    usual = look(Sight(SCENE, "x", "en", folder=str(tmp_path)), memory, lambda: None)
    stated = 'graphkin = 1\n[signs]\nset = "german"\n[units]\nresults = "cm"\n'
    (tmp_path / HOUSE).write_text(stated, encoding="utf-8")
    own = look(Sight(SCENE, "x", "en", folder=str(tmp_path)), memory, lambda: None)
    assert not (usual["problems"] or own["problems"])
    assert "cm/s" not in usual["results"] and "cm/s" in own["results"]
    panels = [each["panels"][-1]["svg"] for each in (usual, own)]
    assert [re.search(">P<", panel) is not None for panel in panels] == [False, True]
    (tmp_path / HOUSE).write_text("graphkin = 2\n", encoding="utf-8")
    wrong = look(Sight(SCENE, "x", "en", folder=str(tmp_path)), memory, lambda: None)
    assert [each["place"] for each in wrong["problems"]] == ["graphkin"]
