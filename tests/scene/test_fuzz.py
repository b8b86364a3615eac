"""Whatever a file holds, reading it gives a scene or a SceneError, nothing else."""

from __future__ import annotations

import contextlib
import random
from pathlib import Path

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from graphkin.scene.expression import UnreadableError, parse
from graphkin.scene.file_limits import decoded
from graphkin.scene.model import Scene
from graphkin.scene.read_scene import read_text
from graphkin.text.errors import SceneError
from tests.chosen import EVERY

MANY = 400 if EVERY else 120
DATA = Path(__file__).parent / "data"
SCENES = [path.read_text(encoding="utf-8") for path in sorted(DATA.glob("*.toml"))]
WORDS = sorted({word for scene in SCENES for word in scene.split()})
NUMBERS = ["0", "-1", "1e999", "nan", "true", '"n"', '"1/0"', '"t"', "[]", "{}", "[[1]]", "2**99"]
NAMES = ["A", "B", "O1", "1", "0", "frame", "A-B", "A-B-C", "slides", "rolls", "wheel", "é", '""']


def safely(text: str) -> Scene | None:
    with contextlib.suppress(SceneError):
        return read_text(text, "fuzz")
    return None


@given(st.binary(max_size=400))
def test_any_bytes(data: bytes) -> None:
    with contextlib.suppress(SceneError):
        read_text(decoded(data), "fuzz")


@given(st.text(max_size=300))
def test_any_text(text: str) -> None:
    safely(text)
    safely(f"graphkin = 1\n[links.1]\n{text}")


@given(st.text(alphabet="0123456789.en+-*/() _pitsqrcoa", max_size=40))
def test_any_expression(text: str) -> None:
    with contextlib.suppress(UnreadableError):
        parse(text)
    safely(f'graphkin = 1\ntime = 1\n[[drivers]]\nturn = 1\nangle = "{text}"')


values = st.recursive(
    st.sampled_from(NUMBERS + [f'"{name}"' for name in ("A", "left of A-B", "on A-B", "forward")])
    | st.integers().map(str)
    | st.floats().map(str),
    lambda inner: (
        st.lists(inner, max_size=3).map(lambda each: f"[{', '.join(each)}]")
        | st.dictionaries(st.sampled_from(["on", "from", "through", "centre", "angle"]), inner).map(
            lambda table: "{" + ", ".join(f"{key} = {value}" for key, value in table.items()) + "}"
        )
    ),
    max_leaves=6,
)
HEADS = ["[frame]", "[links.1]", "[links.B]", "[[drivers]]", "[branches]", "[ask]", "[sheet]"]
KEYS = [*NAMES, "turn", "angle", "velocity", "poles", "scale", "graphkin", "units", "time"]
lines = st.tuples(st.sampled_from(KEYS), values).map(" = ".join) | st.sampled_from(HEADS)


@given(st.lists(lines, max_size=12))
@settings(max_examples=MANY)
def test_any_tables(rows: list[str]) -> None:
    safely("\n".join(rows))


@given(st.sampled_from(SCENES), st.randoms(use_true_random=False), st.integers(1, 4))
@settings(max_examples=MANY, suppress_health_check=[HealthCheck.too_slow], deadline=None)
def test_scenes_with_words_exchanged(scene: str, chance: random.Random, times: int) -> None:
    pieces = scene.split(" ")
    for _ in range(times):
        place = chance.randrange(len(pieces))
        pieces[place] = chance.choice([chance.choice(WORDS), chance.choice(NUMBERS), *NAMES])
    read = safely(" ".join(pieces))
    assert read is None or all(
        len(link.placings) == len(link.points) for link in read.links.values()
    )


@given(st.sampled_from(SCENES), st.randoms(use_true_random=False))
@settings(max_examples=MANY, deadline=None)
def test_scenes_with_lines_lost_and_doubled(scene: str, chance: random.Random) -> None:
    rows = [row for row in scene.splitlines() for _ in range(chance.choice([0, 1, 1, 1, 1, 1, 2]))]
    safely("\n".join(rows))
