"""Each student gets data of their own, written so that every sheet can be derived again."""

from __future__ import annotations

import csv
import hashlib
import io
import json
import shutil
import sys
from fractions import Fraction

import pytest
from msgspec.structs import replace

from graphkin.classroom.grading.class_marking import Book
from graphkin.classroom.lab.fairness import judged
from graphkin.classroom.lab.lab_model import Fair, LabRule, Range, ValueList, exact_text, settings
from graphkin.classroom.lab.read_lab import read_lab
from graphkin.classroom.printing.edition import read_edition
from graphkin.classroom.roster.read_roster import read_roster
from graphkin.classroom.roster.students import Student, Taker
from graphkin.classroom.variants.assign import assigned
from graphkin.classroom.variants.class_files import class_lines, write_class
from graphkin.scene.scene_files import UNFINISHED
from graphkin.text.errors import PageError, RosterError
from tests.classroom.variants.rederiving import read_rule, rederived
from tests.running import killed_at, ran

NUMBERS = Range(Fraction(1), Fraction(30), Fraction(1))
STUDENTS = [Student(n + 1, f"{n:04d}", n, f"Student {n}", "A") for n in range(1, 31)]


def drawing_lab(fair: Fair | None = None, tries: int = 100):
    """The pump with data drawn from its whole range."""
    lab = read_lab("pump")
    rule = LabRule("mechanics 2026", {"n": NUMBERS}, tries)
    return replace(lab, rule=rule, fair=fair or lab.fair)


@pytest.fixture
def roster(tmp_path):
    return listed(tmp_path)


# ----------------------------------------------------------------------------------- assigned


def test_what_ranges_give_is_drawn_again_until_it_is_fair():
    """Who draws again is told: row, number, id, name, draws; no more than a list names."""
    students = [Student(i, f"s{i}") for i in range(60)]
    lab = drawing_lab()
    found = assigned(lab, students)
    assert all(each.fair for each in found)
    again = [each for each in found if each.attempt]
    assert again
    for each in found:
        assert each.settings == settings(lab, each.student, each.attempt)
    for each in again:
        earlier = [settings(lab, each.student, attempt) for attempt in range(each.attempt)]
        assert not judged(lab, earlier).fair.any()
    lines = [*class_lines(lab, found)]
    (first,) = (n for n, line in enumerate(lines) if line.startswith("again "))
    told = [line.split() for line in lines[first : first + len(again) + 1]]
    assert told[0] == ["again", "row", "number", "id", "name", "draws"]
    rows = [(f"{each.student.row}", each.student.id, f"{each.attempt + 1}") for each in again]
    assert [tuple(cells) for cells in told[1:]] == rows


def test_after_hundreds_without_room_nobody_else_is_compared():
    """Data lie apart for a few of 30 numbers; a list of thousands is not compared for ever."""
    fair = replace(read_lab("pump").fair, apart=0.5)
    lab = drawing_lab(fair)
    found = assigned(lab, [Student(i, f"s{i}") for i in range(900)])
    limits = [each.faults[0].limit if each.faults else "" for each in found]
    assert 1 < limits.count("") < 30
    first = limits.index("room")
    assert set(limits[first:]) == {"room"} and "apart" in limits[:first]


def test_the_data_of_a_student_do_not_hang_on_the_others_or_on_the_order():
    lab = drawing_lab()
    whole = {each.student.id: each for each in assigned(lab, STUDENTS)}
    few = assigned(lab, list(reversed(STUDENTS))[:5])
    for each in few:
        assert each.settings == whole[each.student.id].settings
        assert each.flattest == pytest.approx(whole[each.student.id].flattest)


def test_numbers_that_the_scene_does_not_allow_are_all_told_with_their_rows():
    students = [Student(2, "a", 30), Student(3, "b", 31), Student(4, "c", 0)]
    with pytest.raises(RosterError) as caught:
        assigned(read_lab("pump"), students, "class.csv")
    found = [str(problem) for problem in caught.value.problems]
    assert found == [
        f"class.csv, row {row}: number {number} gives n = {number}, which is out of range; "
        "expected n from 1 to 30 in steps of 1"
        for row, number in ((3, 31), (4, 0))
    ]


# ----------------------------------------------------------------------------------- written


ROSTER = "\n".join(
    ["number;id;name;group;e-mail", *(f"{n};{n:04d};Student {n};A;=mail{n}" for n in range(1, 31))]
)
DRAWING = """graphkin = 1
[variants]
course = "mechanics 2026"
draw = { n = { min = 1, max = 30, step = 1 } }
[fair]
crossing = 9
"""


@pytest.fixture(scope="module", params=["formula", "ranges"])
def written(request, tmp_path_factory):
    """A class by the number, or with drawn data, as it is written."""
    place = tmp_path_factory.mktemp(request.param)
    lab, table = read_lab("pump"), listed(place)
    if request.param == "ranges":
        (place / "drawn").mkdir()
        shutil.copy(lab.scene, place / "drawn")
        (place / "drawn" / "lab.toml").write_text(DRAWING, encoding="utf-8")
        lab = read_lab(place / "drawn")
    found = assigned(lab, read_roster(table))
    write_class(place / "out", lab, found, table, force=False)
    return lab, found, manifest_of(place / "out"), place / "out"


def listed(folder):
    """The class list of thirty."""
    path = folder / "class.csv"
    path.write_text(ROSTER, encoding="utf-8-sig")
    return path


def manifest_of(folder):
    return json.loads((folder / "manifest.json").read_text(encoding="utf-8"))


def test_every_variant_is_derived_again_from_the_manifest_alone(written):
    lab, found, raw, _ = written
    assert read_rule(raw) == lab.rule
    assert rederived(raw) == [entry["parameters"] for entry in raw["students"]]
    for each, entry in zip(found, raw["students"], strict=True):
        assert {n: Fraction(v) for n, v in entry["parameters"].items()} == each.settings


def test_every_variant_is_derived_again_by_a_few_lines_of_python(written):
    """Without a line of graphkin: what the documentation says is enough."""
    _, _, raw, _ = written
    for entry in raw["students"]:
        if "set" in raw["rule"]:
            assert raw["rule"]["set"] == {"n": "number"}
            assert entry["parameters"]["n"] == str(entry["number"])
            continue
        ends = raw["rule"]["draw"]["n"]
        low, high, step = (Fraction(ends[key]) for key in ("min", "max", "step"))
        words = json.dumps(
            [raw["course"], raw["lab"], entry["id"], entry["attempt"], "n"],
            ensure_ascii=False,
            separators=(",", ":"),
        )
        index = int(hashlib.sha256(words.encode()).hexdigest(), 16) % int((high - low) / step + 1)
        assert Fraction(entry["parameters"]["n"]) == low + index * step


def test_the_copy_of_the_lab_gives_the_same_variants(written):
    lab, found, raw, folder = written
    copy = read_lab(folder / "lab", raw["lab"])
    same = [(each.name, each.rule, each.fair, each.rubric) for each in (copy, lab)]
    assert same[0] == same[1]
    assert [each.settings for each in assigned(copy, [e.student for e in found])] == [
        each.settings for each in found
    ]


def test_the_table_has_the_exact_data_and_the_rosters_other_columns(written):
    _, found, raw, folder = written
    text = (folder / "variants.csv").read_text(encoding="utf-8")
    rows = list(csv.DictReader(io.StringIO(text)))
    assert [row["id"] for row in rows] == [f"{n:04d}" for n in range(1, 31)]
    for row, each, entry in zip(rows, found, raw["students"], strict=True):
        assert Fraction(row["n"]) == each.settings["n"]
        assert row["status"] == each.status
        assert row["compute"].split() == list(each.computed) == entry["compute"]
        assert float(row["flattest_deg"]) == pytest.approx(each.flattest, abs=0.005)
        assert row["tries"] == str(each.attempt + 1)
        assert row["code"] == entry["code"]
        assert row["e-mail"] == f"'=mail{each.student.number}"


def test_a_second_class_in_the_folder_is_refused_and_one_written_again_keeps_its_bytes(written):
    lab, found, raw, folder = written
    roster = folder.parent / "class.csv"

    def there():
        return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}

    before = there()
    with pytest.raises(PageError, match="exists already"):
        write_class(folder, lab, found, roster, force=False)
    assert there() == before
    write_class(folder, lab, found, roster, force=True)
    assert there() == before
    for text in ("{", "[" * 100_000):  # a salt that cannot be read is made anew
        (folder / "manifest.json").write_text(text, encoding="utf-8")
        write_class(folder, lab, found, roster, force=True)
        again = manifest_of(folder)
        assert again["salt"] != raw["salt"]
        assert again["students"][0]["parameters"] == raw["students"][0]["parameters"]
    for path, data in before.items():
        path.write_bytes(data)


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL there")
@pytest.mark.parametrize(("point", "student"), [(12, ("0001", None)), (24, ("0003", "it"))])
def test_a_class_whose_writing_was_killed_is_whole_for_the_next_command(
    tmp_path, roster, point, student
):
    """It is the old class until all is written aside, then the new one."""
    folder, other = tmp_path / "class", tmp_path / "other.csv"
    other.write_text("number;id;limba\n3;0003;it\n", encoding="utf-8")
    assert ran("variants", "pump", roster, "-o", folder).exit_code == 1
    killed_at(point, folder, "variants", "pump", other, "-o", folder, "--force")
    assert (folder / UNFINISHED).is_dir()
    ran("grade", folder, other)
    assert not (folder / UNFINISHED).exists()
    first = read_edition(folder).takers[0]
    assert (first.student.id, first.spoken) == student


def test_a_full_disk_leaves_nothing(tmp_path, roster, monkeypatch):
    lab = read_lab("pump")
    found = assigned(lab, read_roster(roster))

    def full(self, data):
        raise OSError(28, "No space left on device", str(self))

    monkeypatch.setattr("pathlib.Path.write_bytes", full)
    with pytest.raises(PageError, match="no space left"):
        write_class(tmp_path / "out", lab, found, roster, force=False)
    assert not [p for p in (tmp_path / "out").rglob("*") if p.is_file()]


# ---------------------------------------------------------------------------------- commands


def test_the_command_writes_tells_and_leaves_with_1_for_unfair_data(tmp_path, roster):
    result = ran("variants", "pump", roster, "-o", tmp_path / "out")
    assert result.exit_code == 1
    assert "29 of 30 students" in result.stdout
    assert (
        "30      0030  Student 30  n = 30  triangle v_DC v/l 0.0441, at least 0.05" in result.stdout
    )
    assert "computed instead of measured" in result.stdout
    assert "flattest crossing  " in result.stdout
    assert "1 student has unfair data" in result.stderr
    assert (tmp_path / "out" / "manifest.json").is_file()


def test_check_tries_a_lab_and_a_scene_stays_as_it_was(tmp_path):
    made = ran("new", "lab", "mine", "-o", tmp_path)
    assert made.exit_code == 0
    whole = ran("check", tmp_path / "mine")
    assert whole.exit_code == 0, whole.stderr
    assert "30 of 30 variants" in whole.stdout
    path = tmp_path / "mine" / "lab.toml"
    path.write_text(path.read_text(encoding="utf-8").replace("v_B_mm", "v_b_mm"), encoding="utf-8")
    wrong = ran("check", tmp_path / "mine")
    assert wrong.exit_code == 2
    assert "lab.toml: marks.v_b_mm: no field of this scene" in wrong.stderr
    assert "did you mean v_B_mm?" in wrong.stderr
    path.unlink()
    alone = ran("check", tmp_path / "mine")
    assert alone.exit_code == 0
    assert whole.stdout.startswith(alone.stdout)
    assert "variants" not in alone.stdout


def test_a_number_that_the_scene_does_not_allow_is_told_beside_the_other_mistakes(tmp_path):
    path = tmp_path / "class.csv"
    path.write_text("number;id\n31;a\nx;b\n7;a\n", encoding="utf-8")
    said = ran("variants", "pump", path, "-o", tmp_path / "class")
    assert said.exit_code == 2
    lines = said.stderr.splitlines()
    for row, word in (
        (2, "n = 31, which is out of range"),
        (3, "no whole number"),
        (4, "row 2 already"),
    ):
        assert f"row {row}" in lines[row - 2]
        assert word in lines[row - 2]
    assert len(lines) == 3
    assert not (tmp_path / "class").exists()


def test_fields_that_hardly_any_drawing_settles_are_told_when_the_class_is_made():
    """Those that the report of the marking names, where they earn points."""
    lab = read_lab("slotted-lever")
    students = [Student(i, f"01{i:02d}", i) for i in range(1, 13)]
    found = assigned(lab, students)
    book = Book(lab, lab.scene.read_text(encoding="utf-8"))
    wanted: dict[str, list[str]] = {}
    for each in found:
        given = {name: exact_text(value) for name, value in each.settings.items()}
        form = book.expectation(Taker(each.student, given, "", each.computed))
        for field, allowed in form.tolerance.items():
            if allowed.unsure and field not in each.computed:
                wanted.setdefault(field, []).append(each.student.id)
    assert wanted
    lines = [*class_lines(lab, found)]
    at = next(i for i, line in enumerate(lines) if line.startswith("unsure"))
    rows = [line.split(None, 3) for line in lines[at + 1 : at + 1 + len(wanted)]]
    told = {field: ids.split(", ") for field, _, _, ids in rows}
    assert told == wanted
    assert "off there by more than 25 % of the value" in lines[at + 1 + len(wanted)]
    (alone,) = [each for each in found if each.student.id == wanted["omega_4"][0]]
    assert any("omega_4" in line for line in class_lines(lab, [alone]))


def test_whose_language_no_page_has_is_told_by_row_and_name(tmp_path):
    path = tmp_path / "class.csv"
    rows = [f"{i};{i};{name};{'xx' if i != 1 else 'en'}" for i, name in enumerate("ABCDEF", 1)]
    path.write_text("\n".join(["id;number;name;Limba", *rows]), encoding="utf-8")
    result = ran("variants", "pump", path, "-o", tmp_path / "class")
    assert result.exit_code == 0, result.stderr
    column = 'column "Limba"'
    assert f"class.csv, row 3, {column}, B (2); class.csv, row 4, {column}, C (3);" in result.stderr
    assert (
        '(4) and 2 more: "xx" is no language of the pages (de, en, es, fr, it, ro, ru)'
        in result.stderr
    )


def test_a_class_list_that_is_not_there_is_told_with_what_to_do(tmp_path):
    (tmp_path / "class.csv").write_text("number;id\n1;1\n", encoding="utf-8")
    for name, said in (
        ("clas.csv", "expected a table, CSV or XLSX; did you mean class.csv?"),
        ("none/x.csv", f"there is no folder {tmp_path / 'none'}"),
        ("qqqqqqq", "a spreadsheet program saves one as XLSX or as CSV UTF-8"),
    ):
        result = ran("variants", "pump", tmp_path / name, "-o", tmp_path / "out")
        assert result.exit_code == 2
        assert f"{tmp_path / name}: cannot be read: no such file or directory" in result.stderr
        assert said in result.stderr


def test_a_class_has_a_language_that_it_keeps_when_it_is_written_again(tmp_path, roster):
    folder = tmp_path / "class"
    for args, language in (
        ((), ""),
        (("--lang", "en", "--force"), "en"),
        (("--force",), "en"),
        (("--lang", "it", "--force"), "it"),
    ):
        ran("variants", "offset-slider-crank", roster, "-o", folder, *args)
        assert read_edition(folder).language == language
        assert ('"language"' in (folder / "manifest.json").read_text("utf-8")) == bool(language)


# ------------------------------------------------------------------------------ lists of values


def listing_lab(tries: int = 100):
    """The pump with numbers drawn from a list of values and a range."""
    parts = (*(Range(Fraction(n), Fraction(n), Fraction(1)) for n in (2, 9)), Range(12, 20, 4))
    lab = read_lab("pump")
    return replace(lab, rule=LabRule("mechanics 2026", {"n": ValueList(parts)}, tries))


def test_a_list_is_drawn_from_as_a_range_is_and_derived_again(tmp_path, roster):
    lab = listing_lab()
    found = assigned(lab, read_roster(roster))
    assert {each.settings["n"] for each in found} <= {2, 9, 12, 16, 20}
    assert len({each.settings["n"] for each in found}) > 2
    write_class(tmp_path / "class", lab, found, roster, force=False)
    raw = manifest_of(tmp_path / "class")
    assert rederived(raw) == [{"n": str(each.settings["n"])} for each in found]


def test_of_unfair_data_the_least_unfair_are_kept():
    """Limits that nobody keeps: data with fewer faults replace those with more."""
    lab = replace(listing_lab(tries=8), fair=Fair(crossing=80, segment=25))
    students = [Student(i, f"s{i}") for i in range(40)]
    one_try = assigned(replace(lab, rule=replace(lab.rule, tries=1)), students)
    many = assigned(lab, students)
    faults = [[len(each.faults) for each in found] for found in (one_try, many)]
    assert all(after <= before for before, after in zip(*faults, strict=True))
    assert sum(faults[1]) < sum(faults[0])


@pytest.mark.parametrize("name", ["pump-collinear", "offset-slider-crank"])
def test_formulas_beside_ranges_and_rests_are_derived_again(tmp_path, roster, name):
    """The number gives n in both labs; the crank is drawn, or goes by a rest."""
    lab, students = read_lab(name), read_roster(roster)
    found = assigned(lab, students)
    assert [each.settings["n"] for each in found] == [each.number for each in students]
    write_class(tmp_path / "class", lab, found, roster, force=False)
    raw = manifest_of(tmp_path / "class")
    assert read_rule(raw) == lab.rule
    assert rederived(raw) == [entry["parameters"] for entry in raw["students"]]
    assert len({each.settings["r"] for each in found}) > 4


def test_numbers_that_a_formula_beside_ranges_does_not_suit_are_refused():
    lab = read_lab("pump-collinear")
    with pytest.raises(RosterError, match="31"):
        assigned(lab, [*STUDENTS[:2], Student(4, "0031", 31, "Student 31", "A")])
