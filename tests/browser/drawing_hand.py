"""A hand that draws a turn as a student does who knows the board: by dragging, and by typing."""

from __future__ import annotations

from typing import Any

from graphkin.construction.registry import PALETTE
from graphkin.web.screen_sheets import ScreenSheet
from graphkin.web.your_turn import PLANES, PaletteMove, YourTurn
from graphkin.writers.templates import marked_up
from tests.browser.opening import PAINTED
from tests.browser.turning_hand import SPOT, UNSEEN, TurningHand

PLAIN = str.maketrans({"′": "'", "ν": "n", "τ": "t", "ω": "w"})
"""How a letter without a key of its own is typed."""
PLAIN_TEXT = """markup =>
  Object.assign(document.createElement('i'), { innerHTML: markup }).textContent"""


class DrawingHand(TurningHand):
    """Draws moves by drags and single clicks; ``presses`` counts those of the mouse's button."""

    def __init__(self, page: Any, sheets: list[ScreenSheet], turn: YourTurn) -> None:
        super().__init__(page, sheets, turn, "mouse")
        self.presses, self.tool = 0, ""

    def by_pointer(self, move: PaletteMove) -> str:
        """Draw a move with as few presses as the board allows."""
        inputs = [self.turn.picks[key].by or key for key in move.inputs]
        if move.action == "cut":
            return self.drag(self.found(move))
        if move.action == "lay_off":
            start, vector = inputs
            self.press_on(f"#chips [data-pick='{vector}']")
            self.drag(self.spot(start, {"image"}), self.found(move))
            if self.page.locator("#which").is_visible():  # of a short vector both ends are near
                self.press_on("#which button >> nth=0")
            return self.said
        if move.action != self.tool:
            self.press_on(f"[data-action={move.action}]")
            self.tool = move.action
        kinds = {kind for _, own in PALETTE[move.action].slots for kind in own}
        near = [key for key in inputs if self.is_here(key)]
        far = [key for key in inputs if key not in near]
        while len(near) > 2:
            self.drag(self.spot(near.pop(0), kinds))
        self.drag(*(self.spot(key, kinds) for key in near))
        for key in far:
            self.press_on(f"#chips [data-pick='{key}']")
        return self.said

    def is_here(self, key: str) -> bool:
        """Whether a pick is drawn on the sheet in sight."""
        return self.turn.picks[key].kind not in UNSEEN and self.field(self.plane(key)) is not None

    def press_on(self, button: str) -> None:
        """Press a button."""
        self.page.locator(button).click()
        self.presses += 1

    def drag(self, start: list[float], end: list[float] | None = None) -> str:
        """Press at a place and let go at another, or at the same one; hear what the page says."""
        self.page.mouse.move(*start)
        self.page.mouse.down()
        if end:
            self.page.mouse.move(*end, steps=2)
        self.page.mouse.up()
        self.presses += 1
        self.page.evaluate(PAINTED)
        return self.said

    def spot(self, key: str, kinds: set[str]) -> list[float]:
        """A place of the window where a pick is pointed at and nothing else."""
        side, own = self.drawn(key)
        rivals = [self.drawn(other) for other in self.there(kinds) if other != key]
        near = [shape for found, shape in rivals if found == side]
        found: list[float] = self.page.evaluate(SPOT, [side, own, near])
        return found

    def found(self, move: PaletteMove) -> list[float]:
        """The place of the window where the point of a move is found."""
        plane, value = self.turn.planes[move.step], self.turn.values[move.step]
        at = {"at": self.placed(plane, value)}
        place: list[float] = self.page.evaluate(SPOT, [int(plane is not PLANES[0]), at, []])
        return place


class TypingHand(TurningHand):
    """Draws moves by typing their lines; ``presses`` counts the keys of each move."""

    def __init__(self, page: Any, sheets: list[ScreenSheet], turn: YourTurn) -> None:
        super().__init__(page, sheets, turn, "keys")
        self.presses: list[int] = []
        self.action = ""

    def by_pointer(self, move: PaletteMove) -> str:
        """Type a move, with its action where that has changed; a digit chooses one of two."""
        line = self.line(move)
        self.page.keyboard.type(line)
        self.page.keyboard.press("Enter")
        presses = len(line) + 1
        if self.page.locator("#which").is_visible():
            self.page.keyboard.press("1")
            presses += 1
        self.presses.append(presses)
        return self.said

    def line(self, move: PaletteMove) -> str:
        """The shortest line for a move after those before it."""
        if move.action == "cut":
            return "x"
        names = [self.typed(self.turn.picks[key].by or key) for key in move.inputs]
        if move.action in ("perpendicular", "parallel", "triangle"):
            word = "" if move.action == self.action else f"{PALETTE[move.action].typed[-1]} "
            self.action = move.action
            return word + "".join(names)
        return "".join(names)

    def typed(self, key: str) -> str:
        """A pick as it is typed: its letters, without markup and the words before them."""
        name = self.page.evaluate(PLAIN_TEXT, str(marked_up(self.turn.picks[key].name)))
        return str(name).translate(PLAIN).split(" (")[0].split(" ")[-1]
