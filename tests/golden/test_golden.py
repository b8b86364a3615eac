"""What the program gives is what is committed: a part of it here, all of it by the command.

A work is tried or not by the hash of its own name, so that a new scene moves no other.
"""

from zlib import crc32

import pytest

from tests.chosen import EVERY
from tests.golden.kept import STORE, Items, changed, differences, kept, stored, stored_of
from tests.golden.works import SCENES, outputs, works

WHOLE = "pump"
"""The subject of which every work is tried, in one language."""
FULL = ("class-offset-slider-crank: grade", "class-pump: print")
"""Works of classes that are tried."""
SHARES = {"small": 8, "scene": 3}
"""One in so many small works is tried, and one work of one in so many scenes."""
SLOW = (
    *("class-iii", "class-three", "closure", "cylinder-within", "of rapid-return", "of walker"),
    *("plank-two-sizes", "plates-coupled", "plates-ring", "rod-and-wheel", "stephenson"),
    *("gears-double-planet", "gears-simpson", "explain", "cycle", "html", "class-"),
)
"""Parts of the names of works that take a second or more."""


def is_tried(subject: str, work: str) -> bool:
    """Whether the ordinary run tries a work."""
    item = f"{subject}: {work}"
    if EVERY or item in FULL:
        return True
    if subject == WHOLE:
        return "--lang" not in work or "--lang en" in work
    if subject not in SCENES:
        return not is_slow(item) and crc32(item.encode()) % SHARES.get(kind_of(subject), 1) == 0
    quick = [name for name in works()[subject] if not is_slow(f"{subject}: {name}")]
    number = crc32(subject.encode())
    return bool(quick) and number % SHARES["scene"] == 0 and work == quick[number % len(quick)]


def is_slow(item: str) -> bool:
    """Whether a work takes long."""
    return any(part in item for part in SLOW)


def kind_of(subject: str) -> str:
    """Scene, small, mistakes or class."""
    return "scene" if subject in SCENES else subject.partition("-")[0]


def tried(kind: str, drawn: bool) -> list[tuple[str, str]]:
    """The works of subjects of a kind that are tried: those that draw, or the others."""
    return [
        (subject, work)
        for subject, names in works().items()
        for work in names
        if kind_of(subject) == kind
        and work.startswith(("sheet", "cycle", "print")) == drawn
        and is_tried(subject, work)
    ]


def test_no_fault_of_the_program_and_no_scene_that_is_no_toml_is_kept():
    """What fails would fail alike ever after."""
    for (file, item), text in stored().items():
        assert "a fault in graphkin" not in text, item
        assert file == "mistakes" or "written twice" not in text, item


@pytest.mark.parametrize("drawn", [False, True], ids=["printed", "drawn"])
@pytest.mark.parametrize("kind", ["scene", "small", "mistakes", "class"])
def test_nothing_changed(kind, drawn):
    """Where a change is meant, ``python -m tests.golden`` writes it down."""
    before, fresh = Items(), Items()
    for subject, work in tried(kind, drawn):
        before |= stored_of(subject, work)
        fresh |= kept(subject, work, outputs(subject, work))
    assert before and list(differences(before, fresh)) == []


def test_every_work_is_stored_and_no_other():
    stems = {path.stem for path in STORE.glob("*.txt")}
    every = {f"{subject}: {work}" for subject, names in works().items() for work in names}
    assert {item.partition(" / ")[0] for _, item in stored()} == every
    assert stems == {file for file, _ in stored()}


@pytest.mark.parametrize(
    ("stored", "fresh", "told"),
    [
        ("x 0.3\ny 0\n", "x 0.30000000000004\ny -1e-17\n", ""),
        ("x 0.3 y 5\n", "x 0.3 y 5.00001\n", "line 1: 5 became 5.00001 in 'x 0.3 y 5'"),
        ("a\nx 0.3 m\n", "a\nx 0.3 mm\n", "line 2: 'x 0.3 m' became 'x 0.3 mm'"),
        ("3 pins\n", "4 pins\n", "line 1: 3 became 4 in '3 pins'"),
    ],
)
def test_the_first_number_or_word_that_changed_is_told(stored, fresh, told):
    assert changed(stored, fresh) == told


def test_what_is_drawn_may_differ_in_the_last_bit_alone():
    page = '<line x1="12.5"/><text>A 7,1·10⁻¹⁶</text>{"v":0.30000000000000004}'
    first, *others = (
        kept("pump", "sheet", {"a.html": page.replace(*change).encode()})
        for change in [("A", "A"), ("04}", "}"), ("7,1", "5,5"), ("12.5", "12.51"), ("A", "B")]
    )
    assert [other == first for other in others] == [True, True, False, False]
