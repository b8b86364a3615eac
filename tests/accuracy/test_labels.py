"""Names on pictures cover neither each other nor points."""

from __future__ import annotations

import numpy as np
import pytest

from graphkin.accuracy.point_names import PointName, name_points, overlap
from graphkin.writers.plot_style import look, new_figure


def written(points, texts):
    with look():
        figure = new_figure(6, 5)
        ax = figure.subplots()
        ax.set_xlim(0, 1)
        ax.set_ylim(0, 1)
        names = [PointName(x, y, text, "k") for (x, y), text in zip(points, texts, strict=True)]
        boxes = name_points(figure, ax, names)
        room = ax.get_window_extent()
        return boxes, [tuple(ax.transData.transform(point)) for point in points], room


@pytest.mark.parametrize("seed", range(5))
def test_twelve_names_find_room_beside_their_points(seed):
    points = np.random.default_rng(seed).uniform(0.1, 0.9, (12, 2)).tolist()
    boxes, spots, room = written(points, [f"method {n}" for n in range(12)])
    for n, box in enumerate(boxes):
        assert overlap(box, boxes[:n]) == 0
        assert not any(box[0] < x < box[2] and box[1] < y < box[3] for x, y in spots)
        assert room.x0 <= box[0] and box[2] <= room.x1


def test_points_on_one_spot_have_names_apart():
    boxes, _, _ = written([(0.5, 0.5)] * 4, ["one", "two", "three", "four"])
    assert all(overlap(box, boxes[:n]) == 0 for n, box in enumerate(boxes))


def test_the_shared_area_of_two_boxes():
    assert overlap((0, 0, 2, 2), [(1, 1, 3, 3), (5, 5, 6, 6)]) == 1
