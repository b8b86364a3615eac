"""What is written in another order is the same mechanism: every scene, shuffled."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphkin.construction.core.solution import Solution
from graphkin.mechanism import Mechanism
from graphkin.scene.read_scene import read_text
from tests.chosen import CHOSEN
from tests.examples.scenes import FILES
from tests.orders import reordered

HERE = Path(__file__).parents[1]
SCENES = {name: FILES[name] for name in ("pump", *CHOSEN)} | {
    path.stem: path
    for folder in (HERE / "scenes", HERE / "scene" / "data")
    for path in sorted(folder.glob("*.toml"))
}


@pytest.mark.parametrize("name", SCENES)
def test_the_order_of_links_keys_and_drivers_changes_nothing(name):
    text = SCENES[name].read_text(encoding="utf-8")
    here = Mechanism(read_text(text, name))
    solved = here.solve()
    other = Mechanism(read_text(reordered(text, here, seed=sum(map(ord, name))), name))
    found, expected = numbers(other.solve(), here), numbers(solved, here)
    share = 1e-9 / max(float(solved.margin), 1e-4)
    largest = {kind: max(map(abs, some.values()), default=0) for kind, some in expected.items()}
    largest["link epsilon"] = max(largest["link epsilon"], largest["link omega"] ** 2)
    moving = largest["point acceleration"]  # of what slides evenly only rounding is left
    largest["slide acceleration"] = max(largest["slide acceleration"], moving)
    for kind, values in expected.items():
        size = largest[kind]
        assert found[kind] == pytest.approx(values, abs=share * size or 1e-9, rel=0)


def numbers(solution: Solution, mechanism: Mechanism) -> dict[str, dict[str, complex]]:
    """Every number of a solution by its kind and whose it is.

    Contacts have names of their own, and so have links that are put in.
    """
    scene = mechanism.scene
    own = {point for link in (scene.frame, *scene.links.values()) for point in link.points}
    points = {name: point for name, point in solution.points.items() if name in own}
    kinds = [(key, "point", points) for key in ("position", "velocity", "acceleration")]
    kinds += [(key, "link", solution.links) for key in ("omega", "epsilon")]
    slid = ("position", "speed", "acceleration", "coriolis")
    kinds += [(key, "slide", solution.slides) for key in slid]
    return {
        f"{what} {key}": {
            name: value
            for name, record in records.items()
            if name not in scene.unseen and (value := getattr(record, key)) is not None
        }
        for key, what, records in kinds
    }
