"""Links that three or more parallel bars keep parallel: their direction needs no trial."""

from cmath import rect
from math import radians, sqrt
from random import Random

import pytest

from graphkin.construction.compile import write
from graphkin.construction.core.kind import constructions
from graphkin.construction.higher_class.closed_group import ClosedGroup
from graphkin.diagnosis.closures import choices
from graphkin.loops.assemble import assemble
from graphkin.loops.equations import parts_of
from graphkin.mechanism import Mechanism
from graphkin.motion.cycle import cycle, jumps
from graphkin.scene.model import FRAME
from graphkin.scene.read_scene import read_text
from graphkin.structure.groups import Higher
from graphkin.structure.pairs import parallel_sets
from graphkin.text.errors import StructureError
from tests.scene_files import scene_text

SCHMIDT = scene_text("structure/schmidt-three-bars")
BY_A_SIDE = scene_text("structure/schmidt-by-a-side")
PLATE = scene_text("structure/plate-on-parallel-bars")


def mechanism_of(text):
    return Mechanism(read_text(text, "scene", None, {}))


@pytest.mark.parametrize(("text", "bars"), [(SCHMIDT, ["456", "789"]), (PLATE, ["b1b2b3b4"])])
def test_parallel_bars_form_sets(text, bars):
    """Three bars a side of a Schmidt coupling, four bars under a plate, at unequal distances."""
    sets = parallel_sets(mechanism_of(text).scene)
    assert ["".join(each.bars) for each in sets] == bars


def chain(discs, seed):
    """Discs in series, three bars between each two, with the links written in a random order.

    Each disc has its pins in a figure of its own. The first bars of all sets but the last two are
    driven, so that one dyad of bars remains.
    """
    rng = Random(seed)
    figures = [[(rng.randint(-40, 40), rng.randint(-40, 40)) for _ in "123"] for _ in range(discs)]
    links = {"d1": {"O": (0, 0)}, f"d{discs}": {"P": (0, 0)}}
    for n in range(1, discs):
        for k in range(3):
            links.setdefault(f"d{n}", {})[f"A{n}{k}"] = figures[n][k]
            links.setdefault(f"d{n + 1}", {})[f"B{n}{k}"] = figures[n][k]
    names = [*links, *(f"b{n}{k}" for n in range(1, discs) for k in range(3))]
    rng.shuffle(names)
    text = [
        'graphkin = 1\ntitle = "Chain"\nunits = { length = "mm", angle = "deg", speed = "rad/s" }'
    ]
    text.append(f"[frame]\nO = [0, 0]\nP = [{40 * discs}, 11]")
    for name in names:
        text.append(f"[links.{name}]")
        if name in links:
            text += [f"{point} = [{x}, {y}]" for point, (x, y) in links[name].items()]
        else:
            text.append(f"A{name[1:]}-B{name[1:]} = {60 + int(name[1])}")
    drivers = [("d1", 20, 12), *((f"b{n}0", 25 + 9 * n, 5 - n) for n in range(1, discs - 2))]
    for link, angle, speed in drivers:
        text.append(f'[[drivers]]\nturn = "{link}"\nangle = {angle}\nspeed = {speed}')
    text.append(f'[branches]\nd{discs - 1} = "closure 1"')
    return "\n".join(text)


@pytest.mark.parametrize(("discs", "seed"), [(3, 1), (3, 2), (4, 3), (5, 4)])
def test_of_a_chain_of_discs_one_dyad_of_bars_remains(discs, seed):
    """Every disc turns as the first; both routes agree, with all bars in place."""
    mechanism = mechanism_of(chain(discs, seed))
    tried = [group for group in mechanism.groups if isinstance(group, Higher)]
    assert [len(group.links) for group in tried] == [3]
    found = mechanism.solve()
    assert mechanism.witness(found).agrees
    for n in range(1, discs + 1):
        assert found.links[f"d{n}"].omega == pytest.approx(12)


def test_the_closures_are_counted_by_a_link_whose_angle_differs():
    (group,) = constructions(mechanism_of(SCHMIDT).program, ClosedGroup)
    assert group.counted == "4"


@pytest.mark.parametrize("text", [SCHMIDT, BY_A_SIDE, PLATE])
def test_the_independent_route_agrees_with_all_bars_in_place(text):
    """It numbers the closures, too, and finds the position without the construction."""
    mechanism = mechanism_of(text)
    found = mechanism.solve()
    assert mechanism.witness(found).agrees
    own = assemble(mechanism.scene).motion
    for name, point in found.points.items():
        assert own.place(name)[0] == pytest.approx(point.position, abs=1e-9)


@pytest.mark.parametrize("text", [BY_A_SIDE, PLATE])
def test_a_turn_passes_where_bars_are_in_line_with_their_pins(text):
    """In line, two bars alone could cross there; the third one forbids it."""
    found = cycle(mechanism_of(text), steps=40)
    assert found.ranges == ((0.0, 360.0),)
    assert found.path.returns and not found.singulars
    assert found.witnessed.agrees.all() and not jumps(found)


def test_the_discs_of_a_schmidt_coupling_turn_alike():
    links = mechanism_of(SCHMIDT).solve().links
    for disc in "23":
        assert links[disc].omega == pytest.approx(30)
        assert links[disc].epsilon == pytest.approx(4)


@pytest.mark.parametrize(("side", "above"), [("right", 1), ("left", -1)])
def test_a_side_where_nothing_is_left_to_choose_picks_the_closure(side, above):
    """Of the closures with room for all bars: link 2 turns as link 1 and its centre is 50 mm from
    O1, 45 mm from O3; link 3 turns as link 1."""
    found = mechanism_of(BY_A_SIDE.replace('"right of', f'"{side} of')).solve()
    along = (50**2 - 45**2 + 70**2) / (2 * 70)
    centre = complex(along, above * sqrt(50**2 - along**2))
    arm = 40 * rect(1, radians(25))
    places = {"B1": centre + arm, "C1": centre - arm, "D1": 70 - arm}
    for point, place in places.items():
        assert 1e3 * found.points[point].position == pytest.approx(place)
    speed = 30j * arm
    for point, velocity in {"B1": speed, "C1": -speed, "D1": -speed}.items():
        assert 1e3 * found.points[point].velocity == pytest.approx(velocity)


def test_a_side_that_is_true_of_no_closure_of_the_number_is_refused():
    text = BY_A_SIDE.replace("closure 1", "closure 2")
    with pytest.raises(StructureError, match=r"branches\.D1: no group has a choice at D1"):
        mechanism_of(text).solve()


def test_the_plate_only_shifts():
    links = mechanism_of(PLATE).solve().links
    assert links["plate"].omega == pytest.approx(0, abs=1e-9)
    assert links["b3"].omega == pytest.approx(links["b1"].omega)


@pytest.mark.parametrize(
    "change", [("F3-G3 = 90", "F3-G3 = 90.01"), ("G3 = [130, -20]", "G3 = [130.01, -20]")]
)
def test_a_bar_that_is_nearly_parallel_is_refused(change):
    """A length or a pin that differs by 0.01 mm: no closure has room for all four bars."""
    scene = mechanism_of(PLATE.replace(*change)).scene
    assert [each.bars for each in parallel_sets(scene)] == [("b1", "b2", "b4")]
    with pytest.raises(StructureError, match=r"links\.b3: .* a length that fits"):
        Mechanism(scene).solve()


def test_bars_that_could_only_cross_are_not_listed_as_closures():
    mechanism = mechanism_of(PLATE)
    program = write(mechanism.scene, mechanism.groups, fitted=False)
    (choice,) = choices(mechanism.scene, mechanism.groups, program)
    assert [each.unfit for each in choice.closures] == ["", ""]


FIGURE = (0, 30, 10 + 20j)


def platform(far, lengths):
    """A plate on three bars, their pins at ``FIGURE`` on the frame and at ``far`` on the plate."""

    def written(name, places):
        return [f"{name}{k} = [{z.real}, {z.imag}]" for k, z in enumerate(map(complex, places))]

    lines = ['graphkin = 1\ntitle = "Platform"']
    lines += ['units = { length = "mm", angle = "deg", speed = "rad/s" }', "[frame]"]
    lines += [*written("A", FIGURE), "[links.plate]", *written("B", far)]
    for k, length in enumerate(lengths):
        lines += [f"[links.b{k}]", f"A{k}-B{k} = {length}"]
    lines.append("[[drivers]]\nturn = 'b0'\nangle = 70\nspeed = 1")
    return read_text("\n".join(lines), "scene", None, {})


@pytest.mark.parametrize(
    ("far", "lengths", "are_kept"),
    [
        (FIGURE, (50, 50, 50), True),
        ([z * (0.6 + 0.8j) for z in FIGURE], (50, 50, 50), True),  # turned on the plate
        (FIGURE, (50, 50, 50.001), False),
        (FIGURE, (50.001, 50, 50), False),
        ((0, 30, 10 + 20.001j), (50, 50, 50), False),
        ([1.001 * z for z in FIGURE], (50, 50, 50), False),
        ([complex(z).conjugate() for z in FIGURE], (50, 50, 50), False),  # a mirror image
    ],
)
def test_only_equal_bars_at_congruent_figures_keep_a_plate_parallel(far, lengths, are_kept):
    """The construction and the vector loops see it apart, with the plate's turn in its own axes."""
    scene = platform(far, lengths)
    assert [each.bars for each in parallel_sets(scene)] == [("b0", "b1", "b2")] * are_kept
    found = parts_of(scene).parallel
    assert len(found) == are_kept
    for each in found:
        assert {*each.bodies} == {FRAME, "plate"}
        turn = (far[1] - far[0]) / abs(far[1] - far[0])
        along = each.along if each.bodies[1] == "plate" else 1 / each.along
        assert abs(along * turn - 1) < 1e-12
