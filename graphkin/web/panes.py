"""How a picture is parted into panes, at what scale a drawing stands in one, and where.

The scale stays for a whole motion. It is chosen for most of it, not for its peaks: a plan that is
larger for a short while leaves its pane. The pole stands still as long as its plan has room, and
moves aside for one that would not have.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import ceil

from msgspec.structs import replace

from graphkin.drawing.areas import Rect
from graphkin.drawing.field import Field
from graphkin.drawing.scale import Extent, extent_of

PICTURE = (240.0, 140.0)
"""Width and height of a picture in mm."""
HEAD = 11.0
"""Room for the title above the panes, in mm."""
AREA: Rect = (3.0, HEAD, PICTURE[0] - 3, PICTURE[1] - 3)
"""The part of a picture for all panes."""
CAPTION = 5.0
"""Room for the caption of a pane, in mm, more than there is around its drawing."""
ROOM = 13.0
"""Room around a mechanism within its pane, for letters and ground, in mm."""
AIR = 8.0
"""Room around a plan, for its letters, in mm."""
SHARES = (0.4, 0.5, 0.6, 0.7)
"""Parts of a picture that the mechanism may take."""
HELD = (1.0, 0.95, 0.9, 0.85, 0.8, 0.75)
"""Parts of a motion over which a plan stays in its pane: the largest at which it is large enough.

Below three quarters it would be gone too often.
"""
ENOUGH = 0.5
"""A plan is large enough when its middle size over the motion is this part of its room."""


def arrangements(plans: int) -> Iterator[list[Rect]]:
    """Ways to part a picture, the mechanism first, in the order of WAYS for each of its shares."""
    if not plans:
        yield [AREA]
        return
    for share in SHARES:
        for way in WAYS:
            yield way(share, plans)


def beside_plans(share: float, plans: int) -> list[Rect]:
    """The mechanism beside its plans, which stand one above the other."""
    left, top, right, bottom = AREA
    x, down = left + share * (right - left), (bottom - top) / plans
    return [
        (left, top, x, bottom),
        *((x, top + i * down, right, top + (i + 1) * down) for i in range(plans)),
    ]


def above_plans(share: float, plans: int) -> list[Rect]:
    """The mechanism above its plans, which stand side by side."""
    left, top, right, bottom = AREA
    y, across = top + share * (bottom - top), (right - left) / plans
    return [
        (left, top, right, y),
        *((left + i * across, y, left + (i + 1) * across, bottom) for i in range(plans)),
    ]


def in_a_row(share: float, plans: int) -> list[Rect]:
    """The mechanism and its plans side by side."""
    left, top, right, bottom = AREA
    x = left + share * (right - left)
    across = (right - x) / plans
    return [
        (left, top, x, bottom),
        *((x + i * across, top, x + (i + 1) * across, bottom) for i in range(plans)),
    ]


WAYS = (beside_plans, above_plans, in_a_row)


def worth(rects: Sequence[Rect], box: Extent, plans: Sequence[Sequence[Extent]]) -> float:
    """How large all drawings are together; the mechanism counts twice."""
    own, *others = rects
    found = scale_in(room_in(own, ROOM), [box]) ** 2
    for rect, boxes in zip(others, plans, strict=True):
        found *= scale_in(room_in(rect, AIR), boxes)
    return found


def room_in(rect: Rect, around: float) -> Rect:
    """The part of a pane for a drawing, below its caption."""
    left, top, right, bottom = rect
    return left + around, top + around + CAPTION, right - around, bottom - around


def scale_in(room: Rect, boxes: Sequence[Extent]) -> float:
    """Millimetres for each unit of a drawing, one for all the boxes that it takes up in turn."""
    width, height = room[2] - room[0], room[3] - room[1]
    sizes = sorted(max(box.width / width, box.height / height) for box in boxes)
    usual, size = sizes[len(sizes) // 2], sizes[-1]
    for part in HELD:
        size = sizes[ceil(part * len(sizes)) - 1] or size
        if usual >= ENOUGH * size:
            break
    return 1 / size if size > 0 else 1.0


def mechanism_pane(rect: Rect, box: Extent) -> Field:
    """The field of a mechanism, in the middle of its room below the caption."""
    room = room_in(rect, ROOM)
    return Field(rect, scale_in(room, [box]), box.middle, middle_of(room))


def posed(rect: Rect, boxes: Sequence[Extent]) -> Field:
    """The field of a plan with its pole where the plan needs to be moved least: at its middle."""
    room = room_in(rect, AIR)
    sides = [sorted(each) for each in zip(*(b.sides for b in boxes), strict=True)]
    half = len(boxes) // 2
    usual = extent_of([complex(sides[i][half], sides[i + 1][half]) for i in (0, 2)])
    field = Field(rect, scale_in(room, boxes), usual.middle, middle_of(room))
    return field if field.holds(0j, AIR) else replace(field, middle=0j)


def middle_of(room: Rect) -> tuple[float, float]:
    """The middle of a rectangle."""
    return (room[0] + room[2]) / 2, (room[1] + room[3]) / 2


def plan_pane(field: Field, box: Extent) -> Field:
    """The field of a plan at one moment: its pole moved aside where the plan has no room else."""
    left, top, right, bottom = room_in(field.rect, AIR)
    (x, y), (low, high) = field(0j), field(complex(box.left, box.top))
    far, deep = field(complex(box.right, box.bottom))
    across, down = aside(low, far, x, left, right), aside(high, deep, y, top, bottom)
    return replace(field, at=(field.at[0] + across, field.at[1] + down))


def aside(low: float, high: float, pole: float, start: float, end: float) -> float:
    """How far a plan from low to high is moved into the room from start to end, one way.

    A larger one leaves the room on both sides of its pole, as much as it lies there.
    """
    if high - low <= end - start:
        return max(start - low, 0.0) + min(end - high, 0.0)
    return start + (pole - low) / (high - low) * (end - start) - pole


def leaves(field: Field, box: Extent) -> bool:
    """Whether a drawing is not all in its pane."""
    corners = complex(box.left, box.bottom), complex(box.right, box.top)
    return not all(field.holds(corner) for corner in corners)
