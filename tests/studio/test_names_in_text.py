"""Names of points in the text of a scene: found wherever a key says them, and nowhere else."""

from __future__ import annotations

import pytest
import tomlkit

from graphkin.studio.names_in_text import renamed, says

LINK = """[links.1]
O2-{p} = 20 # a bar
P = "left of O2-{p}"
wheels = [{{ centre = "{p}", radius = 9 }}, {{ centre = "O2", radius = 4 }}]
slides = {{ on = 0, along = "O1-{p}" }}
belt = {{ on = 1, wheels = [2, 1] }}
"""


def test_a_point_is_named_anew_wherever_a_link_says_it():
    text = tomlkit.parse(LINK.format(p="B"))
    renamed(text["links"]["1"], "B", "C")
    assert tomlkit.dumps(text) == LINK.format(p="C")


@pytest.mark.parametrize(
    ("key", "value", "named"),
    [
        ("O2-B", 20, True),
        ("P", "left of O2-B", True),
        ("P", "left of O2-BB", False),
        ("wheel", {"centre": "B", "radius": 9}, True),
        ("rolls", {"on": 0, "through": "B"}, True),
        ("slides", {"on": 0, "along": "O1-B"}, True),
        ("slides", {"on": 0, "through": [0, 1]}, False),
        ("belt", {"on": 1, "wheels": [1, 2]}, False),
    ],
)
def test_what_a_key_of_a_link_names(key, value, named):
    assert says("B", key, value) is named
