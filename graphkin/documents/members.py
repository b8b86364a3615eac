"""What the links of a mechanism are, in a line: their points, blocks and wheels."""

from __future__ import annotations

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.drawing.symbol_markup import escape, symbol
from graphkin.scene.model import Link
from graphkin.text import Words


def members(drawing: Drawing) -> str:
    """The links by their numbers and the points that they join, as a task tells them."""
    words, scene = drawing.words, drawing.scene.bare
    told = [f"{escape(name)} = {of_link(words, link)}" for name, link in scene.links.items()]
    for centre, follower in scene.cam_centres.items():
        cam = escape(scene.cams[follower].on)
        told.append(words("page.member_centre", point=symbol(centre), g=cam))
    return words("page.members", list=words("list_mark").join(told))


def of_link(words: Words, link: Link) -> str:
    """The points of a link in order; one with a single point is a block, or a wheel on it."""
    points = "".join(symbol(point) for point in link.points)
    if link.slides and len(link.points) < 2:
        return words("page.member_block", points=points)
    if link.wheels:
        return words("page.member_wheel", points=points)
    return points
