"""An imported scene stands as the file draws it, and moves as its closure does.

The places are read from the text by other code, and speeds are differences of closures found here.
"""

from __future__ import annotations

import re
from cmath import phase, pi, rect, sqrt
from pathlib import Path
from string import ascii_lowercase, ascii_uppercase, digits

import pytest
from click.testing import CliRunner
from msgspec.structs import replace

from graphkin.cli.main import app
from graphkin.documents.program_files import pmks_file
from graphkin.importing.formats import content, imported
from graphkin.importing.record import DrawnGuide
from graphkin.importing.scene_text import scene_text
from graphkin.mechanism import Mechanism, load
from graphkin.scene import scene_files
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import GraphkinError

HERE = Path(__file__).parent
LINKS = dict(line.split(" ", 1) for line in (HERE / "pmks_links.txt").read_text().splitlines())
PYSLVS = {
    "four-bar": "M[J[R, color[Green], P[0.0, 0.0], L[ground, a]], J[R, color[Green], "
    "P[12.92, 32.53], L[a, b]], J[R, color[Green], P[73.28, 67.97], L[b, c]], "
    "J[R, color[Green], P[33.3, 66.95],"
    " L[b]], J[R, color[Green], P[90.0, 0.0], L[ground, c]]]",
    "slider": "M[J[R, P[-49.625, 4.125], L[ground, b]], J[R, P[-26.625, 46.125], L[a, b]],"
    " J[RP, A[10.0], P[0.0, 0.0], L[ground, a]]]",
}
BASE = f"{digits}{ascii_uppercase}{ascii_lowercase}_-"
CENTIMETRE = 0.01
SENT = (
    "crank-rocker",
    "slider-crank",
    "watt-2",
    "shaper",
    "rapid-return",
    "crank-slot",
    "geneva-wheel",
)
STEP = 1e-6


def opened(text: str) -> Mechanism:
    return Mechanism(read_text(scene_text(imported(text)).text, "imported"))


def places(mechanism: Mechanism, unit: float) -> dict[str, complex]:
    return {n: complex(p.position) / unit for n, p in mechanism.solve().points.items()}


def thousandths(text: str) -> float:
    value = 0
    for sign in text.removeprefix("0"):
        value = 64 * value + BASE.index(sign)
    return (-value if text.startswith("0") else value) / 1000


def drawn(text: str) -> dict[str, complex]:
    """Names and places of the joints in a new or old text."""
    if text.startswith("j="):
        rows = [line.split(",") for line in text[2 : text.index("&l=")].split("%0A") if line]
        return {row[0]: complex(float(row[1]), float(row[2])) for row in rows}
    rows = [joint.split(",") for joint in text[: text.index("..")].split(".")[4:]]
    return {row[1]: complex(thousandths(row[2]), thousandths(row[3])) for row in rows}


def crossing(one: complex, a: float, other: complex, b: float, near: complex) -> complex:
    """The crossing of two circles that is nearest to a place."""
    way = other - one
    along = (a * a - b * b + abs(way) ** 2) / (2 * abs(way))
    height = sqrt(a * a - along * along)
    both = [one + way / abs(way) * (along + sign * 1j * height) for sign in (1, -1)]
    return min(both, key=lambda place: abs(place - near))


def turned(place: complex, pivot: complex, angle: float) -> complex:
    return pivot + (place - pivot) * rect(1, angle)


def rate(angle_at) -> float:
    return (angle_at(STEP) - angle_at(-STEP)) / (2 * STEP)


@pytest.mark.parametrize("name", LINKS)
def test_every_joint_stands_where_the_link_draws_it(name):
    mechanism = opened(LINKS[name])
    found, at = places(mechanism, CENTIMETRE), drawn(LINKS[name])
    forces = mechanism.scene.forces
    more = (
        {each.at for each in forces.loads} | {m.centre for m in forces.masses.values()}
        if forces
        else set()
    )
    joints = [name for name in found if "@" not in name and name not in more - at.keys()]
    assert len(joints) >= 2
    for point in joints:
        assert abs(found[point] - at[point]) < 2e-3, point


@pytest.mark.parametrize("name", ["inverted-slider-crank", "whitworth"])
def test_a_lever_with_a_slot_turns_as_the_line_to_its_pin(name):
    at, solved = drawn(LINKS[name]), opened(LINKS[name]).solve()
    omega = -20 * pi / 30
    lever = rate(
        lambda t: phase((turned(at["B"], at["A"], omega * t) - at["C"]) / (at["D"] - at["C"]))
    )
    assert float(solved.links["2"].omega) == pytest.approx(lever, rel=1e-3)


def test_a_four_bar_turns_as_its_circles_cross():
    at, solved = (
        drawn(LINKS["teaching-lab-four-bar"]),
        opened(LINKS["teaching-lab-four-bar"]).solve(),
    )
    omega, (a, b, c, d) = -20 * pi / 30, (at[name] for name in "ABCD")

    def rocker(time: float) -> float:
        return phase(crossing(turned(b, a, omega * time), abs(c - b), d, abs(c - d), c) - d)

    assert float(solved.links["3"].omega) == pytest.approx(rate(rocker), rel=1e-5)


CSV = """joints
id,x,y,links,type,ground,angle,input
a,0,0,ab,R,true,Null,true
b,3,4,ab|bc,R,false,Null,false
c,15,-1,bc|cd,R,false,Null,false
d,15,-1,cd,P,true,0.25,false
links
id,type,mass,mass_moi,center_of_mass_x,center_of_mass_y,joints,forces,shape
ab,R,1,1,1.5,2,"a,b","",
bc,R,1,1,9,1.5,"b,c","F1",
cd,P,1,Null,Null,Null,"c,d","",Null
forces
id,link,startx,starty,endx,endy,fixed,direction,mag
F1,bc,9,1,9,3,true,true,10
settings
input_speed_mag,clockwise,gravity,unit
30,true,false,cm
"""


def test_a_csv_file_of_pmks_moves_as_its_slider_crank():
    """The guide rises at 0.25 rad through (15, -1); in its axes the pin is at y = b.imag."""
    found = scene_text(imported(CSV))
    assert any("force F1" in note for note in found.notes)
    solved = Mechanism(read_text(found.text, "imported")).solve()
    way, start, rod = rect(1, 0.25), 15 - 1j, abs(12 - 5j)

    def along(time: float) -> float:
        pin = (turned(3 + 4j, 0, -pi * time) - start) / way
        return (pin.real + sqrt(rod**2 - pin.imag**2)).real

    assert along(0) == pytest.approx(0, abs=1e-9)
    velocity = complex(solved.points["c"].velocity) * 100
    assert velocity == pytest.approx(rate(along) * way, rel=1e-6)


@pytest.mark.parametrize(
    ("part", "other"), [("type,ground", "kind,ground"), ("settings", "other"), ('"b,c"', '"b,x"')]
)
def test_a_damaged_csv_file_is_refused_in_words(part, other):
    assert part in CSV
    with pytest.raises(GraphkinError, match=r"damaged|no unit|nothing"):
        scene_text(imported(CSV.replace(part, other)))


def test_a_link_that_hangs_on_nothing_is_left_out_and_named():
    text = (HERE / "crank.linkage2").read_text()
    loose = (
        '<connector id="0" x="0" y="0"/><connector id="9" x="50" y="0"/>'
        '<Link id="7"><connector id="0"/><connector id="9"/></Link></linkage2>'
    )
    found = scene_text(imported(text.replace("</linkage2>", loose)))
    alone = scene_text(imported(text))
    assert [note for note in found.notes if note not in alone.notes] == [
        "link link 7 is connected with nothing fixed and is left out"
    ]
    one, other = (Mechanism(read_text(each.text, "a")).solve() for each in (found, alone))
    assert one.links.keys() == other.links.keys()


def test_an_older_file_of_linkage_is_read_and_named():
    text = (HERE / "crank.linkage2").read_text()
    old = imported(text.replace("linkage2>", "linkage>"))
    assert any("older file" in note for note in old.notes)
    assert old.joints == imported(text).joints


def test_an_old_link_turns_counter_clockwise_where_it_says_so():
    assert float(opened(LINKS["old-four-bar"]).solve().links["1"].omega) == pytest.approx(pi / 3)


@pytest.mark.parametrize("name", ["crank", "pick"])
def test_a_file_of_linkage_stands_in_96ths_of_an_inch(name):
    text = (HERE / f"{name}.linkage2").read_text()
    found = places(opened(text), 0.001)
    rows = [line.split('"') for line in text.splitlines() if ' x="' in line]
    at = {f"P{row[1]}": complex(float(row[3]), float(row[5])) / 96 * 25.4 for row in rows}
    assert len(found) >= 4
    for point in found:
        assert abs(found[point] - at[point]) < 1e-3, point


def linkage_of(name: str) -> tuple[Mechanism, dict[str, complex]]:
    """A file of Linkage as a mechanism, and its connectors in metres, read from the text."""
    text = (HERE / f"{name}.linkage2").read_text()
    rows = re.findall(r'connector id="(\d+)" x="([^"]*)" y="([^"]*)"', text)
    at = {f"P{own}": complex(float(x), float(y)) / 96 * 0.0254 for own, x, y in rows}
    mechanism = opened(text)
    for point, place in places(mechanism, 1.0).items():
        if "@" not in point:
            assert abs(place - at[point]) < 1e-6, point
    return mechanism, at


def test_gears_turn_against_one_another_and_a_chain_turns_its_wheels_alike():
    solved = linkage_of("gears")[0].solve()
    speeds = sorted(float(link.omega) for link in solved.links.values())
    assert speeds == pytest.approx([-1.5 * pi, -0.5 * pi, pi])


def test_a_fastened_gear_is_a_part_of_its_link():
    found = imported((HERE / "gears.linkage2").read_text())
    assert sorted(map(len, (body.joints for body in found.bodies.values()))) == [1, 1, 2]
    assert {gear.belt for gear in found.gears} == {False, True}


def test_a_cylinder_extends_at_its_mean_speed():
    """15 cycles in a minute are 30 strokes, so that a stroke of half an inch takes two seconds."""
    mechanism, at = linkage_of("cylinder")
    solved = mechanism.solve()
    length, arm = abs(at["P1"] - at["P0"]), abs(at["P1"] - at["P2"])

    def lever(time: float) -> float:
        reach = length + time * 0.0127 / 2
        return phase(crossing(at["P0"], reach, at["P2"], arm, at["P1"]) - at["P2"])

    assert float(solved.links["3"].omega) == pytest.approx(rate(lever), rel=1e-5)


def test_a_rod_in_two_bushings_slides_without_turning():
    mechanism, at = linkage_of("bushings")
    solved = mechanism.solve()
    moved = solved.points["P1"].velocity
    assert abs(complex(solved.points["P0"].velocity) - complex(moved)) < 1e-12

    def place(time: float) -> float:
        pin = turned(at["P6"], at["P5"], pi / 2 * time)
        rise, rod = pin.imag - at["P1"].imag, abs(at["P6"] - at["P1"])
        return pin.real - sqrt(rod**2 - rise**2).real

    assert complex(moved) == pytest.approx(complex(rate(place), 0), abs=1e-9)


def test_what_linkage_bends_is_refused():
    text = (HERE / "crank.linkage2").read_text()
    assert 'slider="true"' in text
    with pytest.raises(GraphkinError, match="curved"):
        imported(text.replace('slider="true"', 'slider="true" slideradius="30"'))
    text = (HERE / "cylinder.linkage2").read_text()
    end = '<connector id="1"/></Link>\n<Link id="1">'
    assert end in text
    with pytest.raises(GraphkinError, match="link 0"):
        imported(text.replace(end, f'<connector id="3"/>{end}'))


@pytest.mark.parametrize("name", PYSLVS)
def test_an_expression_stands_at_its_coordinates(name):
    found = places(opened(PYSLVS[name]), 0.001)
    spots = re.findall(r"P\[([^],]*),([^]]*)\]", PYSLVS[name])
    assert len(found) == len(spots)
    for number, (x, y) in enumerate(spots):
        assert abs(found[f"P{number}"] - complex(float(x), float(y))) < 1e-3, number


@pytest.mark.parametrize("name", SENT)
def test_what_goes_out_to_pmks_comes_back_the_same(name):
    path = scene_files.examples()[name]
    sent = Mechanism(read_text(path.read_text("utf-8"), name))
    one, other = sent.solve(), opened(pmks_file(sent).decode("ascii")).solve()
    number = 1 + [*sent.scene.links].index(sent.scene.drivers[0].link)
    omega = float(one.links[sent.scene.drivers[0].link].omega)
    assert float(other.links[str(number)].omega) == pytest.approx(omega, abs=1e-6)
    fastest = max(abs(complex(point.velocity)) for point in one.points.values() if point.velocity)
    moving = [name for name, point in one.points.items() if point.velocity and name in other.points]
    assert len(moving) > 1
    for point in moving:
        there, here = one.points[point], other.points[point]
        if there.position is not None:
            assert abs(complex(there.position) - complex(here.position)) < 2e-5, point
        assert abs(complex(there.velocity) - complex(here.velocity)) < 2e-3 * fastest, point


def changed(text: str, *changes: tuple[str, str]) -> str:
    """A text of PMKS+ with other parts, and the letter for its length."""
    said = text[:-1]
    for old, new in changes:
        assert said.count(old) == 1
        said = said.replace(old, new)
    return said + f"{digits}{ascii_uppercase}{ascii_lowercase}"[len(said) % 62]


@pytest.mark.parametrize(
    ("whole", "exact", "rpm"), [(20, None, 20.0), (20, 19_600_000_001, 19.600000001), (21, 1, 21.0)]
)
def test_an_exact_speed_counts_only_beside_its_whole_one(whole, exact, rpm):
    said = f".{BASE[whole]},0.1011" if exact is None else f".{BASE[whole]},0,{coded(exact)}.1011"
    found = opened(changed(LINKS["inverted-slider-crank"], (".K,0.1011", said)))
    assert float(found.solve().links["1"].omega) == pytest.approx(-rpm * pi / 30, abs=1e-9)


def coded(number: int) -> str:
    return (coded(number // 64) if number >= 64 else "") + BASE[number % 64]


def test_a_driven_slider_has_the_speed_of_the_setting_along_its_guide():
    """PMKS+ takes the number as a length per second, by its kinematic-solver.ts."""
    text = changed(LINKS["teaching-lab-slider-crank"], (".MA,A,", ".KA,A,"), (".LD,D,", ".ND,D,"))
    found = scene_text(imported(text))
    assert any("-20 is taken as cm per second" in note for note in found.notes)
    mechanism = Mechanism(read_text(found.text, "imported"))
    assert complex(mechanism.solve().points["C"].velocity) == pytest.approx(-0.2)


def test_links_at_a_welded_joint_are_one():
    """The coupler of the four-bar carries a bar EX, welded to it in E."""
    at = drawn(LINKS["watt-1"])
    assert {"E", "F", "G"} <= at.keys()
    welded = changed(LINKS["watt-1"], (".GE,E,", ".OE,E,"))
    links = imported(welded).bodies
    assert any({"D", "E", "F"} <= {*link.joints} for link in links.values())
    assert len(links) == len(imported(LINKS["watt-1"]).bodies) - 1


def test_a_part_of_a_welded_link_is_no_link_and_another_is_named():
    text = LINKS["watt-1"]
    part = ".NRDE,part,1E8,1a,bq,18q,0d125a,D,E,,.YREF,"
    alone = imported(changed(text, (".YREF,", part)))
    assert len(alone.bodies) == len(imported(text).bodies)
    assert ["part" in note for note in alone.notes].count(True) == 1
    root = ".NRde,part,1E8,1a,bq,18q,0d125a,D,E,,.YREF,"
    held = imported(changed(text, (".YREF,", root), ("C,F,G,,.", "C,F,G,,de.")))
    assert not any("part" in note for note in held.notes)


def test_a_block_with_two_guides_is_refused_by_its_name():
    text = "M[J[R, P[0, 0], L[ground, a]], J[R, P[1, 0], L[a]]]"
    found = imported(text)
    twice = tuple(DrawnGuide("a", "P1", angle=angle) for angle in (0.0, 1.0))
    with pytest.raises(GraphkinError, match="link a has two guides"):
        scene_text(replace(found, guides=twice))


def test_an_error_of_the_scene_names_the_links_of_the_file():
    free = "M[J[R, P[0, 0], L[ground, crank]], J[R, P[1, 0], L[crank, rod]], J[R, P[3, 0], L[rod]]]"
    with pytest.raises(GraphkinError, match="1 is crank, 2 is rod"):
        scene_text(imported(free))


PROJECTS = {
    "blocks": """background: {}
input:
- - 4
  - 2
links:
  ground: White
mechanism: M[J[R, color[Green], P[0.0, 0.0], L[ground, a]], J[R, color[Green], P[12.92,
  32.53], L[a, b]], J[R, color[Green], P[73.28, 67.97], L[b, c]], J[R, color[Green],
  P[33.3, 66.95], L[b]], J[R, color[Green], P[90.0, 0.0], L[ground, c]]]
pyslvs_ver: 22.7.0
""",
    "flow": "{input: [[4, 2]], links: {ground: White}, mechanism: 'M[J[R, P[0.0, 0.0], L[ground,"
    " a]], J[R, P[12.92, 32.53], L[a, b]], J[R, P[73.28, 67.97], L[b, c]], J[R, P[33.3, 66.95],"
    " L[b]], J[R, P[90.0, 0.0], L[ground, c]]]', pyslvs_ver: 22.7.0}",
}


@pytest.mark.parametrize("name", PROJECTS)
def test_a_project_of_pyslvs_drives_the_joints_of_its_inputs(name):
    """The input turns P2 about P4, which is not the first pivot of the file."""
    found = scene_text(imported(PROJECTS[name]))
    assert any("no speed" in note for note in found.notes)
    solved = Mechanism(read_text(found.text, name)).solve()
    at = [0j, 12.92 + 32.53j, 73.28 + 67.97j, 33.3 + 66.95j, 90 + 0j]
    for own, place in enumerate(at):
        assert complex(solved.points[f"P{own}"].position) * 1000 == pytest.approx(place, abs=1e-6)

    def crank(time: float) -> float:
        pin = turned(at[2], at[4], pi / 30 * time)
        return phase(crossing(pin, abs(at[2] - at[1]), at[0], abs(at[1]), at[1]))

    assert float(solved.links["1"].omega) == pytest.approx(rate(crank), rel=1e-5)


def test_a_project_with_an_input_on_no_link_is_refused():
    with pytest.raises(GraphkinError, match="damaged"):
        imported(PROJECTS["flow"].replace("[[4, 2]]", "[[4, 1]]"))


def test_a_length_without_a_unit_is_named():
    assert any("unit" in note for note in scene_text(imported(PYSLVS["slider"])).notes)


def test_a_lever_with_a_slot_of_an_expression_turns_as_the_line_to_its_pin():
    """The slot passes beside the lever's pivot, so that the lever keeps a distance from the pin."""
    text = (
        "M[J[R, P[0, 0], L[ground, crank]], J[RP, A[100], P[30, 40], L[lever, crank]],"
        " J[R, P[20, -60], L[ground, lever]]]"
    )
    pivot, pin, slot = 20 - 60j, 30 + 40j, rect(1, 100 * pi / 180)
    off = ((pin - pivot) / slot).imag

    def turns(time: float) -> float:
        way = turned(pin, 0, pi / 30 * time) - pivot
        return phase(way / (sqrt(abs(way) ** 2 - off**2) + 1j * off))

    solved = opened(text).solve()
    assert float(solved.links["2"].omega) == pytest.approx(rate(turns), rel=1e-6)


@pytest.mark.parametrize("links", ["ground, yoke", "yoke, ground"])
def test_the_yoke_of_an_expression_moves_as_its_pin_does_along_the_guide(links):
    text = (
        "M[J[R, P[0, 0], L[ground, crank]], J[RP, A[90], P[30, 40], L[yoke, crank]],"
        f" J[P, A[0], P[100, 0], L[{links}]]]"
    )
    solved = opened(text).solve()
    assert complex(solved.points["P2"].velocity) == pytest.approx(-pi / 30 * 0.040)
    assert complex(solved.points["P1"].velocity) == pytest.approx(pi / 30 * 1j * (0.03 + 0.04j))


def test_a_joint_of_another_kind_is_refused_by_its_name():
    for kind, links in (("X", "ground, a"), ("P", "ground, a, b"), ("RP", "")):
        text = f"M[J[R, P[0, 0], L[ground, a]], J[{kind}, A[0.0], P[1, 0], L[{links}]]]"
        with pytest.raises(GraphkinError, match=f"P1 is of kind {kind}"):
            imported(text)


@pytest.mark.parametrize("between", [",", " "])
def test_a_link_of_the_old_pmks_turns_as_its_circles_cross(between):
    at = {"A": 0j, "B": 3 + 26j, "C": 95 + 62j, "D": 110 - 5j}
    joints = (
        "ground,in,R,0,0,0,tfft|in,rod,R,3,26,ffff|rod,out,R,95,62,0,ffff|out,ground,R,110,-5,ffff|"
    )
    solved = opened(f"set=s-2|e0.1&mech={joints.replace(',', between)}").solve()

    def rocker(time: float) -> float:
        pin, (_, b, c, d) = turned(at["B"], 0, -2 * time), at.values()
        return phase(crossing(pin, abs(c - b), d, abs(c - d), c) - d)

    assert float(solved.links["3"].omega) == pytest.approx(rate(rocker), rel=1e-5)
    for point, place in at.items():
        assert complex(solved.points[point].position) == pytest.approx(place / 1000)


def test_a_file_of_the_old_pmks_has_a_line_for_each_joint():
    joints = "ground,in,R,0,0,0,tfft|in,rod,R,3,26,ffff|rod,out,R,95,62,0,ffff|out,ground,R,9,-5,f"
    lines = "mech=\n" + joints.replace("|", "\n") + "\n"
    assert imported(lines) == imported(f"mech={joints}")


def test_a_block_of_the_old_pmks_slides_on_its_guide():
    text = "mech=ground,a,R,0,0,tfft|a,b,R,30,40,ffff|b,c,R,150,-10,ffff|c,ground,P,150,-10,0,ffff"
    solved = opened(text).solve()

    def slider(time: float) -> float:
        pin = turned(30 + 40j, 0, time)
        return (pin.real + sqrt(abs(120 - 50j) ** 2 - (pin.imag + 10) ** 2)).real / 1000

    assert complex(solved.points["C"].velocity) == pytest.approx(rate(slider), abs=1e-9)
    with pytest.raises(GraphkinError, match="D is of kind RP"):
        imported(text.replace("ground,P", "ground,RP"))


def test_an_expression_is_read_from_the_command_line_and_driven_by_its_freedoms(tmp_path):
    """Two cranks on one pin and a dyad between them: a five-bar, of two freedoms."""
    joints = (("0, 0", "ground, a, b"), ("-30, 40", "a, c"), ("50, 30", "b, d"), ("15, 90", "c, d"))
    said = ", ".join(f"J[R, P[{place}], L[{links}]]" for place, links in joints)
    file = tmp_path / "arm.toml"
    result = CliRunner().invoke(app, ["import", f"M[{said}]", "-o", str(file)])
    assert result.exit_code == 0, result.output
    mechanism = Mechanism(read_text(file.read_text(), "arm"))
    assert [driver.link for driver in mechanism.scene.drivers] == ["1", "2"]
    at = places(mechanism, 1e-3).values()
    assert sorted(map(complex, at), key=abs) == pytest.approx(
        [0, 50j - 10j - 30, 50 + 30j, 15 + 90j]
    )


def test_what_has_no_counterpart_is_named_in_the_scene():
    lost = changed(LINKS["loaded"], ("2F1,CD,", "2F1,XY,"))
    for text, words in ((lost, "force F1 is left out"), (LINKS["trammel"], "nothing is driven")):
        found = scene_text(imported(text))
        assert [words in note for note in found.notes] == [True]
        assert f"# {found.notes[0]}" in found.text.splitlines()


@pytest.mark.parametrize(("flags", "sense"), [("2", 1), ("0", -1)])
@pytest.mark.parametrize(("units", "newtons"), [("1011", 1.0), ("1001", 4.4482216152605)])
def test_a_force_is_balanced_by_the_power_of_the_driver(flags, sense, units, newtons):
    """No link has a mass: what the driver gives is what the force takes."""
    changes = (".K,0.1011.", f".K,0.{units}."), ("2F1,CD,", f"{flags}F1,CD,")
    text = scene_text(imported(changed(LINKS["loaded"], *changes))).text
    mechanism = Mechanism(read_text(f"{text}[ask]\nbalance = true\n", "loaded"))
    at, end = ((thousandths(x), thousandths(y)) for x, y in (("0RF", "Oj"), ("0RF", "95")))
    way = complex(*end) - complex(*at)
    force = sense * newtons * thousandths("2SG") * way / abs(way)
    (load,) = mechanism.scene.forces.loads
    point = mechanism.solve().points[load.at]
    assert complex(point.position) * 100 == pytest.approx(complex(*at), abs=2e-3)
    found = mechanism.solve()
    power = (force * complex(point.velocity).conjugate()).real
    omega = float(found.links["1"].omega)
    solved, verdict = mechanism.forces()
    assert verdict.agrees
    (balance,) = solved.balance
    assert float(balance.moment) * omega == pytest.approx(-power, rel=1e-4)


def test_a_text_that_breaks_off_is_refused_in_words():
    for text in (LINKS["trammel"], LINKS["old-four-bar"], PYSLVS["slider"]):
        for length in range(0, len(text), 3):
            cut = text[:length]
            for said in (cut, cut + f"{digits}{ascii_uppercase}{ascii_lowercase}"[length % 62]):
                try:
                    scene_text(imported(said))
                except GraphkinError as error:
                    assert str(error)


def test_a_file_of_linkage_without_a_line_is_refused_in_words_or_read():
    text = (HERE / "gears.linkage2").read_text()
    lines = text.splitlines(keepends=True)
    for place in range(len(lines)):
        try:
            scene_text(imported("".join(lines[:place] + lines[place + 1 :])))
        except GraphkinError as error:
            assert str(error)
    fixed = text.replace('id="3" x', 'id="3" anchor="true" x')
    assert fixed != text
    with pytest.raises(GraphkinError, match="gear link 3 does not move"):
        scene_text(imported(fixed))


def test_entities_large_numbers_and_many_joints_are_refused():
    bomb = '<!DOCTYPE a [<!ENTITY b "c">]><linkage2>&b;</linkage2>'
    many = "<linkage2>" + '<connector id="1" x="1" y="1"/>' * 201 + "</linkage2>"
    far = '<linkage2><connector id="1" x="1e99" y="nan"/></linkage2>'
    for text, words in ((bomb, "XML"), (many, "200"), (far, "1e99")):
        with pytest.raises(GraphkinError, match=words):
            imported(text)


def test_a_link_is_read_and_not_opened():
    assert content(f"https://nowhere.invalid/?{LINKS['trammel']}") == LINKS["trammel"]


def test_the_command_writes_a_scene_that_solves(tmp_path):
    scene = tmp_path / "crank.toml"
    done = CliRunner().invoke(app, ["import", str(HERE / "crank.linkage2"), "-o", str(scene)])
    assert done.exit_code == 0, done.output
    assert CliRunner().invoke(app, ["solve", str(scene)]).exit_code == 0


FOUR_BAR = """<linkage2><program units="Millimeters"/>
<connector id="0" x="0" y="0" anchor="true" input="true" rpm="15"/>
<connector id="1" x="96" y="0" anchor="true"/>
<connector id="2" x="0" y="40"/><connector id="3" x="100" y="80"/>
<Link id="1"><connector id="0"/><connector id="2"/></Link>
<Link id="2"><connector id="2"/><connector id="3"/></Link>
<Link id="3"><connector id="3"/><connector id="1"/></Link></linkage2>"""


@pytest.mark.parametrize(
    ("part", "other", "found"),
    [
        (' anchor="true"', "", "no connector is an anchor"),
        ('<connector id="3"/><connector id="1"/>', '<connector id="9"/>', "link 3 has connector 9"),
        ('id="3" x=', 'id="2" x=', "two connectors have the id 2"),
        ('x="100"', 'x=""', "connector 3 has no place"),
        ('id="3" x=', 'id="3" slider="true" x=', "connector 3 slides in no slot"),
        ("</linkage2>", "", "XML breaks off"),
    ],
)
def test_a_fault_in_a_file_of_linkage_is_told_with_its_part(part, other, found, tmp_path):
    assert opened(FOUR_BAR).solve().links
    assert part in FOUR_BAR
    path = tmp_path / "own.linkage2"
    path.write_text(FOUR_BAR.replace(part, other), encoding="utf-8")
    result = CliRunner().invoke(app, ["import", str(path)])
    assert result.exit_code == 2
    assert found in result.stderr
    assert str(path) in result.stderr


def test_a_unit_that_is_none_is_told():
    found = imported(changed(LINKS["inverted-slider-crank"], (".K,0.1011", ".K,0.7011")))
    assert found.unit == "cm"
    assert "unit 7 is unknown; lengths are taken in cm" in found.notes
    assert not imported(LINKS["inverted-slider-crank"]).notes


KILOGRAMS = {"0": (0.45359237, 0.45359237 * 0.0254**2), "1": (1e-3, 1e-4), "2": (1.0, 1.0)}
"""lb and lb·in², g and kg·cm², kg and kg·m²: the units of PMKS+ with inches, cm and m."""


class TextOfMasses:
    """The masses, centres and the force in a text of PMKS+, each by two joints of its link."""

    def __init__(self, text: str, length: str) -> None:
        self.at = drawn(text)
        kilograms, inertias = KILOGRAMS[length]
        self.masses = []
        for row in text.split("..")[1].split("."):
            if row.startswith("YR"):
                _, _, mass, inertia, x, y, _, *joints = row.split(",")
                place = self.seen_from(joints, complex(thousandths(x), thousandths(y)))
                sizes = kilograms * thousandths(mass), inertias * thousandths(inertia)
                self.masses.append((*sizes, *place))
        *_, x, y, to_x, to_y, size = text.split("..")[2].split(",")
        start, end = (complex(*map(thousandths, xy)) for xy in ((x, y), (to_x, to_y)))
        self.force = thousandths(size) * (end - start) / abs(end - start)

    def seen_from(self, joints: list[str], place: complex) -> tuple[complex, list[str]]:
        one, other = pins = [joint for joint in joints if joint in self.at][:2]
        return (place - self.at[one]) / (self.at[other] - self.at[one]), pins

    def energy(self, found, gravity: float) -> float:
        """The kinetic energy by König's theorem, and that of the heights."""
        total = 0.0
        for mass, inertia, share, pins in self.masses:
            one, other = (complex(found.points[pin].position) for pin in pins)
            slow, fast = (complex(found.points[pin].velocity) for pin in pins)
            speed = slow + share * (fast - slow)
            omega = ((fast - slow) / (other - one)).imag
            height = (one + share * (other - one)).imag
            total += (mass * abs(speed) ** 2 + inertia * omega**2) / 2 + mass * gravity * height
        return total


@pytest.mark.parametrize("length", "012")
@pytest.mark.parametrize(("settings", "gravity"), [("2P", 0.0), ("2R", 9.81)])
@pytest.mark.parametrize("name", ["watt-1", "stephenson-3"])
def test_the_driver_gives_the_energy_that_the_masses_take(name, settings, gravity, length):
    """The power of the balance and the force is the change of energy."""
    text = changed(LINKS[name], ("2P.", f"{settings}."), (".K,0.1011.", f".K,0.{length}011."))
    said, read = scene_text(imported(text)).text, TextOfMasses(text, length)

    def turned_by(degrees: float):
        again = re.sub(r"(?m)^angle = (.*)$", lambda m: f"angle = {float(m[1]) + degrees}", said)
        return Mechanism(read_text(again, "masses")).solve()

    found = turned_by(0.0)
    omega = float(found.links["1"].omega)
    time = pi / 180 * 2e-3 / omega
    change = (read.energy(turned_by(1e-3), gravity) - read.energy(turned_by(-1e-3), gravity)) / time
    mechanism = Mechanism(read_text(f"{said}[ask]\nbalance = true\n", "masses"))
    (load,) = mechanism.scene.forces.loads
    power = (read.force * complex(found.points[load.at].velocity).conjugate()).real
    solved, verdict = mechanism.forces()
    assert verdict.agrees
    (balance,) = solved.balance
    assert float(balance.moment) * omega + power == pytest.approx(change, rel=1e-4)


@pytest.mark.parametrize("name", ["old-slider-crank", "old-four-bar"])
def test_changed_masses_of_an_old_link_are_named(name):
    """The unit of its masses is not known; that of nobody's masses need not be."""
    words = "masses of the links are left out"
    assert not any(words in note for note in imported(LINKS[name]).notes)
    heavier = LINKS[name].replace("l=ab,R,1,1,", "l=ab,R,2.5,1,")
    assert any(words in note for note in imported(heavier).notes)


@pytest.mark.parametrize(
    ("file", "title"),
    [
        ("jaw_crusher-2.linkage2", "Jaw crusher-2"),
        ("механизм.linkage2", "Механизм"),
        ('a"b.linkage2', 'A"b'),
        ("机构.linkage2", "Mechanism from Linkage"),
    ],
)
def test_a_scene_has_the_name_of_its_file_as_its_title(tmp_path, file: str, title: str) -> None:
    """Sheets print it; a name that they cannot letter gives way to that of the program."""
    given, made = tmp_path / file, tmp_path / "made.toml"
    given.write_bytes((HERE / "crank.linkage2").read_bytes())
    assert CliRunner().invoke(app, ["import", str(given), "-o", str(made)]).exit_code == 0
    assert load(made).scene.title == title
