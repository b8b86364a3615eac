"""What a straight track of a known link gives a wheel in each drawing."""

from __future__ import annotations

from msgspec import Struct

from graphkin.construction.core.pen import Pen
from graphkin.construction.links.link_shapes import LinkShapes
from graphkin.construction.rolling import rolling, wheel_images
from graphkin.scene.model import Driver
from graphkin.structure.pairs import Contact


class LedWheel(Struct, frozen=True):
    """A wheel on the straight track of a known link."""

    pair: Contact

    def line(self, pen: Pen, shapes: LinkShapes) -> int:
        """The line of the track."""
        return rolling.track_of(pen, shapes, self.pair)

    def path(self, pen: Pen, shapes: LinkShapes, link: str, point: str) -> int:
        """The line on which its centre is led."""
        return rolling.path_of_centre(pen, shapes, self.pair)

    def direction(self, pen: Pen, shapes: LinkShapes) -> int:
        """A line along which its centre moves against the track."""
        return rolling.path_of_centre(pen, shapes, self.pair)

    def driven(self, pen: Pen, driver: Driver, which: str) -> int:
        """What a driver gives its centre along the track: position, speed or acceleration."""
        if which == "position":
            return rolling.driven_way(pen, driver, self.pair)
        return wheel_images.given_speed(pen, driver, self.pair, which)

    def set_at(self, pen: Pen, shapes: LinkShapes, link: str, where: int) -> None:
        """The wheel where it has rolled a way along the track."""
        centre = self.pair.led_point(pen.scene, link)
        rolling.set_on_track(pen, shapes, self.pair, centre, where)

    def finish(self, pen: Pen, shapes: LinkShapes) -> None:
        """Its point of contact and its turning, once its centre stands."""
        rolling.touch_and_turn(pen, shapes, self.pair)

    def touch(self, pen: Pen) -> None:
        """The image of its point of contact."""
        wheel_images.touch(pen, self.pair)

    def second_touch(self, pen: Pen) -> None:
        """The second image of its point of contact."""
        wheel_images.second_touch(pen, self.pair)

    def rim(self, pen: Pen) -> int | None:
        """The radius that ties its turning to its coordinate."""
        return rolling.radius_of(pen, self.pair)
