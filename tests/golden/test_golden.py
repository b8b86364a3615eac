"""What the program gives is what is committed: a part of it here, all by the command."""

import re

import pytest

from tests.golden.kept import STORE, changed, differences, kept, read
from tests.golden.works import CLASSES, SCENES, outputs, works

PERIODS = {"html": 60, "sheet small": 15, "check small": 4, "mistake": 1}
"""Of how many subjects one is tried with a work that makes a page, and with small scenes."""
OTHERS = 30
"""The same of all other works."""
SLOW = tuple(
    f"scene-{name}"
    for name in (
        "plates-coupled",
        "plates-ring",
        "rapid-return",
        "rod-and-wheel",
        "stephenson-2-binary",
        "stephenson-2-ternary",
        "stephenson-3-crank",
    )
)
"""Groups of higher class of which a page that moves takes ten seconds."""
SLOWER = ("of walker", "of rapid-return-2")
"""Small scenes that take as long."""


def kind_of(work: str) -> str:
    """What kind of work it is: its options, or its command where its scene is a small one."""
    command, of, _ = work.partition(" of ")
    return f"{command.partition(' ')[0]} small" if of else work


def share() -> list[tuple[str, str]]:
    """Of every kind of work each so-many-th subject, from another one on for the next kind."""
    kinds: dict[str, list[tuple[str, str]]] = {}
    for subject, names in works().items():
        for work in names:
            kind = "mistake" if subject == "mistakes" else kind_of(work)
            kinds.setdefault(kind, []).append((subject, work))
    found = []
    for number, (kind, pairs) in enumerate(kinds.items()):
        wanted = next((count for part, count in PERIODS.items() if part in kind), OTHERS)
        period = min(wanted, len(pairs))
        found += pairs[number % period :: period]
    found = [pair for pair in found if not (pair[0] in SLOW and "html" in pair[1])]
    found = [(subject, work) for subject, work in found if not work.endswith(SLOWER)]
    tried = {subject for subject, _ in found}
    rest = [subject for subject in SCENES if subject not in tried]
    return found + [(each, "solve --json" if n % 3 else "check") for n, each in enumerate(rest)]


def test_no_fault_of_the_program_and_no_scene_that_is_no_toml_is_kept():
    """What fails would fail alike ever after."""
    for path in sorted(STORE.glob("*.txt")):
        text = path.read_text(encoding="utf-8")
        assert "a fault in graphkin" not in text, path.name
        assert path.stem == "mistakes" or "written twice" not in text, path.name


@pytest.mark.parametrize(("subject", "work"), share())
def test_nothing_changed(subject, work):
    """Where a change is meant, ``python -m tests.golden`` writes it down."""
    item = re.compile(f"{re.escape(work)}( [^-].*)?")  # not that of a work with more options
    stored = {name: text for name, text in read(subject).items() if item.fullmatch(name)}
    assert list(differences(stored, kept(outputs(subject, work)))) == []


def test_every_subject_is_tried_and_stored():
    assert {subject for subject, _ in share()} >= {*works()} - {*CLASSES}
    assert {path.stem for path in STORE.glob("*.txt")} == {*works()}


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
        kept({"a.html": page.replace(*change).encode()})
        for change in [("A", "A"), ("04}", "}"), ("7,1", "5,5"), ("12.5", "12.51"), ("A", "B")]
    )
    assert [other == first for other in others] == [True, True, False, False]
