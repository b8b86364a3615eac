"""Check never passes what solve refuses: every scene here, and each with its branches turned."""

from __future__ import annotations

from pathlib import Path

from graphkin.cli.report.check_report import Checking
from graphkin.mechanism import Mechanism, load
from graphkin.text.errors import GraphkinError
from tests.chosen import EVERY, number_of

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = "examples/scenes", "tests/scenes", "tests/motion/scenes"
SCENES = sorted(str(p.relative_to(ROOT)) for f in FOLDERS for p in (ROOT / f).rglob("*.toml"))
TURNS = (
    ("", ""),
    ('"left of', '"right of'),
    ('"right of', '"left of'),
    ('"forward"', '"backward"'),
    ('"backward"', '"forward"'),
)
"""What is written in place of what."""
PARTS, SOME = 48, 3
"""The scenes are cut into parts, of which some are looked at."""
HEAD = 'graphkin = 1\ntitle = "t"\nunits = { length = "m", angle = "deg", speed = "rad/s" }\n'


def is_refused(mechanism: Mechanism) -> bool:
    """Whether solve refuses a mechanism."""
    try:
        mechanism.solve()
    except GraphkinError:
        return True
    return False


def passes(mechanism: Mechanism) -> bool:
    """Whether check finds nothing wrong with a mechanism."""
    checking = Checking(mechanism)
    try:
        list(checking.lines())
    except GraphkinError:
        return False
    return not (checking.problems or checking.doubts)


def test_check_never_passes_what_solve_refuses(tmp_path):
    refused = 0
    for name in (name for name in SCENES if EVERY or number_of(name) % PARTS < SOME):
        text = (ROOT / name).read_text()
        text = text if "graphkin = 1" in text else HEAD + text
        for old, new in TURNS:
            if old not in text:
                continue
            scene = tmp_path / "scene.toml"
            scene.write_text(text.replace(old, new) if old else text)
            try:
                mechanism = load(scene)
            except GraphkinError:  # |no scene, or a part of one
                continue
            if is_refused(mechanism):
                refused += 1
                assert not passes(mechanism), (name, new)
    assert refused
