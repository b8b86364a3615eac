"""A hand that draws a turn: by mouse or finger on the drawing."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from graphkin.construction.core.program import Plane
from graphkin.construction.registry import PALETTE
from graphkin.numbers.plane import Circle, Line, Ratio
from graphkin.web.screen_sheets import ScreenSheet
from graphkin.web.your_turn import PLANES, PaletteMove, YourTurn

UNSEEN = ("length", "rate", "vector")
"""Kinds that are drawn nowhere: they are taken from a list, as is what stands on another sheet."""
SPOT = """([side, own, rivals]) => {
  const svg = document.querySelectorAll('.sheet:not([hidden]) .view > svg')[side];
  const { x, y, width, height } = svg.viewBox.baseVal, matrix = svg.getScreenCTM();
  const drawn = ({ key, line, ...rest }) => {
    if (!line) return rest;
    const mark = svg.querySelector(`line[data-of='${key}']:not(.later)`);
    const ends = mark && ['x1', 'y1', 'x2', 'y2'].map(name => Number(mark.getAttribute(name)));
    if (ends) return { seg: [ends.slice(0, 2), ends.slice(2)] };
    const [[u, v], [a, b]] = line;
    return { seg: [[u - 1000 * a, v - 1000 * b], [u + 1000 * a, v + 1000 * b]], long: true };
  };
  const off = ([u, v], { at, r, seg }) => {
    if (at) return Math.abs(Math.hypot(u - at[0], v - at[1]) - (r ?? 0));
    const [[a, b], [c, d]] = seg, long = (c - a) ** 2 + (d - b) ** 2 || 1;
    const part = Math.min(Math.max(((u - a) * (c - a) + (v - b) * (d - b)) / long, 0), 1);
    return Math.hypot(u - a - part * (c - a), v - b - part * (d - b));
  };
  const { at, r, seg, long } = drawn(own), found = [];
  const alike = other => long && other.seg?.every(end => off(end, { seg }) < 1); // as right as it
  const others = rivals.map(drawn).filter(other => !alike(other));
  if (at && r === undefined) found.push(at);
  for (let k = 0; at && r !== undefined && k < 72; k++) {
    found.push([at[0] + r * Math.cos(k * Math.PI / 36), at[1] + r * Math.sin(k * Math.PI / 36)]);
  }
  for (let k = 1; seg && k < (long ? 2000 : 20); k++) {
    const part = k / (long ? 2000 : 20);
    found.push([0, 1].map(i => seg[0][i] + part * (seg[1][i] - seg[0][i])));
  }
  const inside = ([u, v]) => u > x + 2 && u < x + width - 2 && v > y + 2 && v < y + height - 2;
  const free = place => Math.min(...others.map(other => off(place, other)), 1e6);
  const places = found.filter(inside), room = places.map(free);
  const best = places[room.indexOf(Math.max(...room))];
  const point = new DOMPoint(...best).matrixTransform(matrix);
  return [point.x, point.y];
}"""


class TurningHand:
    """Draws moves on a page on which a turn has begun; ``way`` is mouse or touch."""

    def __init__(self, page: Any, sheets: list[ScreenSheet], turn: YourTurn, way: str) -> None:
        self.page, self.sheets, self.turn, self.way = page, sheets, turn, way
        self.done: set[int] = set()
        self.sheet = sheets[0]

    def draw(self, move: PaletteMove) -> str:
        """Draw a move on the sheet in sight, and hear what the page says of it."""
        seen = (self.page.locator(f"#sheet-{k}").is_visible() for k in range(len(self.sheets)))
        self.sheet = self.sheets[[*seen].index(True)]
        said = self.by_pointer(move)
        self.done.add(move.step)
        return said

    @property
    def said(self) -> str:
        """What the page says."""
        return str(self.page.locator("#turn-say").inner_text())

    # --- on the drawing ---------------------------------------------------------------------------

    def by_pointer(self, move: PaletteMove) -> str:
        """Choose the action, point at its inputs, and at the one that is meant of two."""
        button = self.page.locator(f"[data-action={move.action}]")
        if button.get_attribute("aria-pressed") == "false":
            self.point_at(button)
        inputs = [self.turn.picks[key].by or key for key in move.inputs]
        for place, key in enumerate(inputs):
            if self.turn.picks[key].kind in UNSEEN or not self.field(self.plane(key)):
                self.page.locator("#inputs select").nth(place).select_option(value=key)
            else:
                kinds = {kind for _, kinds in PALETTE[move.action].slots[place:] for kind in kinds}
                self.tap(key, kinds)
        button = self.page.locator("#turn-draw")
        if button.is_visible():
            self.point_at(button)
        if self.page.locator("#which").is_visible():
            self.tap_value(move)
        return self.said

    def point_at(self, button: Any) -> None:
        """Press a button with mouse or finger."""
        button.tap() if self.way == "touch" else button.click()

    def touch(self, at: list[float]) -> None:
        """Touch a place of the window."""
        if self.way == "touch":
            self.page.touchscreen.tap(*at)
        else:
            self.page.mouse.click(*at)

    def tap(self, key: str, kinds: set[str]) -> None:
        """Touch what a pick is drawn as, where it is farthest from all else that may be meant."""
        side, own = self.drawn(key)
        rivals = [self.drawn(other) for other in self.there(kinds) if other != key]
        near = [shape for found, shape in rivals if found == side]
        self.touch(self.page.evaluate(SPOT, [side, own, near]))

    def tap_value(self, move: PaletteMove) -> None:
        """Touch the place where the point of a move is found."""
        plane, value = self.turn.planes[move.step], self.turn.values[move.step]
        at = {"at": self.placed(plane, value)}
        self.touch(self.page.evaluate(SPOT, [int(plane is not PLANES[0]), at, []]))

    def there(self, kinds: set[str]) -> Iterator[str]:
        """The picks of some kinds that are drawn."""
        for key, pick in self.turn.picks.items():
            seen = pick.kind in kinds and pick.kind not in UNSEEN and not pick.by
            if seen and self.done.issuperset(pick.needs) and self.field(self.plane(key)):
                yield key

    def plane(self, key: str) -> Plane:
        """The drawing in which a pick lies."""
        pick = self.turn.picks[key]
        return (
            self.plane(str(pick.on[0]))
            if pick.on and str(pick.on[0]) in self.turn.picks
            else (
                self.turn.planes[int(key)]
                if key.isdigit() and int(key) in self.turn.moves
                else pick.plane
            )
        )

    def field(self, plane: Plane) -> Any:
        """The field of the sheet in sight that shows a drawing."""
        if plane is PLANES[0]:
            return self.sheet.layout.mechanism
        return self.sheet.layout.plan if plane is self.sheet.drawing.plane else None

    def placed(self, plane: Plane, value: Any) -> list[float]:
        """The place of a value in its field, in mm."""
        if isinstance(value, Ratio):
            value = value.start + value.shift / value.size
        return [float(x) for x in self.field(plane)(value)]

    def drawn(self, key: str) -> tuple[int, dict[str, Any]]:
        """The field of a pick, and as what it is drawn there: point, segment, line or circle."""
        pick, plane = self.turn.picks[key], self.plane(key)
        side = int(plane is not PLANES[0])
        if pick.on:
            return side, {"seg": [self.placed(plane, self.turn.values[end]) for end in pick.on]}
        value = pick.value if pick.value is not None else self.turn.values[int(key)]
        if isinstance(value, Line):
            unit = value.along / abs(value.along)
            line = [self.placed(plane, value.point), [unit.real, -unit.imag]]
            return side, {"key": key, "line": line}
        if isinstance(value, Circle):
            r = float(value.radius) * self.field(plane).mm
            return side, {"at": self.placed(plane, value.centre), "r": r}
        return side, {"at": self.placed(plane, value)}
