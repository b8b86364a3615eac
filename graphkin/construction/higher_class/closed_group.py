"""The position of a group of class III or higher: the locus of one of its points closes it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from graphkin.construction.core.canvas import Canvas
from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.kind import ClosesGroup, LaidLength, PlacesLink
from graphkin.construction.core.naming import angle_symbol, axis_of, way_of
from graphkin.drawing.symbol_markup import bar, escape, symbol
from graphkin.scene.model import Driver
from graphkin.structure.groups import Higher, Tie
from graphkin.structure.pairs import Pin, Sliding


class ClosedGroup(ClosesGroup, PlacesLink, frozen=True):
    """A group in one closure: the closing step, the tried link's position, the sides of its dyads.

    The closures are numbered by the angle of the link ``counted``. ``traced`` are the points whose
    loci are drawn by hand.
    """

    group: Higher
    number: int
    counted: str
    traced: tuple[str, ...]
    closing: int
    tried: tuple[int, ...]
    sides: tuple[int, ...]

    def reason(self, drawing: Drawing, role: str) -> str:
        """The reason: no two lines are known from which to draw the group."""
        if role != "closing":
            return ""
        return "why.closed" if len(self.group.nested) == 1 else "why.closed_together"

    def given(self) -> Iterator[tuple[str, int]]:
        """The closing step, and each value taken from it."""
        yield "closing", self.closing
        yield from (("tried", number) for number in self.tried)
        yield from (("side", number) for number in self.sides)

    @property
    def closes(self) -> tuple[str, ...]:
        return self.group.links

    @property
    def cut_off(self) -> set[str]:
        """The links that are cut off, in this group and in the groups within it."""
        return {one.last.link for one in self.group.nested if isinstance(one.last, Tie)}

    @property
    def found_link(self) -> str:
        return self.group.tried.link

    # --- where it is cut -------------------------------------------------------------------------

    @property
    def guide(self) -> str:
        """The block that is cut off its guide, or off the pin on it; empty for other groups."""
        match self.group.last:
            case Tie(second=Sliding(links=(block, _))):
                return block
        return ""

    @property
    def pins(self) -> tuple[str, ...]:
        """The pins at the ends of the link that is cut off; the last one traces the locus."""
        last = self.group.last
        pairs = (last.first, last.second) if isinstance(last, Tie) else ()
        return tuple(pair.point for pair in pairs if isinstance(pair, Pin))

    @property
    def points(self) -> tuple[str, ...]:
        """The points that its sentence names."""
        return self.pins

    def laid_length(self, role: str) -> LaidLength | None:
        """The bar that is cut off: the compass opening, or the gap between the loci."""
        if role != "closing" or len(self.pins) < 2:
            return None
        first, second = self.pins
        return LaidLength(first, second)

    @property
    def locus(self) -> str:
        """The point whose locus closes the group; empty where a driver closes it."""
        return self.pins[-1] if self.pins else ""

    def ends_of_bar(self, drawing: Drawing) -> tuple[str, str]:
        """The ends of the cut bar: the known one, or an empty name, and the moving one."""
        first, second = self.pins
        targets = drawing.trace.program.targets
        known = {p for p in (first, second) if targets["position", p] < self.closing}
        if second in known:
            return second, first
        return first if first in known else "", second

    def marks(self, canvas: Canvas, role: str) -> None:
        """Draw the part of the arc on which the locus finds the pin."""
        if role == "closing" and len(self.pins) > 1:
            fixed, moving = self.ends_of_bar(canvas.drawing)
            if fixed:
                targets = canvas.drawing.trace.program.targets
                ends = (canvas.value(targets["position", point]) for point in (fixed, moving))
                canvas.opening("".join(self.pins), *ends)

    # --- sentences -------------------------------------------------------------------------------

    def sentence_alone(self, drawing: Drawing, role: str) -> str:
        """How the position of the group is found."""
        if role != "closing":
            return ""
        listed = escape(", ".join(seen(drawing, self.closes)))
        (tried,) = seen(drawing, [self.group.tried.link])
        fields = {"k": escape(tried), "n": str(self.number), "list": listed}
        last = self.group.last
        if not isinstance(last, Tie):
            if isinstance(last, Driver):
                fields["what"] = angle_symbol(drawing.scene, last)
                whole = drawing.words("step.close-driver", **fields)
            else:
                fields |= {"c": symbol(last.wheel.centre), "t": symbol(last.letter)}
                whole = drawing.words("step.close-wheel", **fields)
            within = drawing.words("list_mark").join(self.tried_within(drawing))
            return drawing.words.clauses((whole, within)) if within else whole
        fields["draw"] = self.drawn_each_time(drawing)
        fields["q"] = symbol(self.locus)
        if self.guide:
            return drawing.words("step.close-guide", guide=way_of(drawing, self.guide), **fields)
        fixed, moving = self.ends_of_bar(drawing)
        fields |= {"p": symbol(fixed or self.pins[0]), "q": symbol(moving)}
        key = "step.close-bar" if fixed else "step.close-gap"
        return drawing.words(key, bar=bar(*self.pins), **fields)

    def drawn_each_time(self, drawing: Drawing) -> str:
        """The words for the links and inner trials drawn at each position of the tried link."""
        inner = {link for one in self.group.nested[1:] for link in one.links}
        drawn = seen(drawing, (link for link in self.links_drawn(drawing) if link not in inner))
        key = "step.close-links" if len(drawn) > 1 else "step.close-link"
        first = drawing.words(key, list=escape(", ".join(drawn)))
        mark, within = drawing.words("list_mark"), [*self.tried_within(drawing)]
        return mark.join((first, *within)) + (mark.rstrip() if within else "")

    def tried_within(self, drawing: Drawing) -> Iterator[str]:
        """How each group within this one is closed."""
        for one in self.group.nested[1:]:
            match one.last:
                case Driver() as driver:
                    cut = angle_symbol(drawing.scene, driver)
                case Tie(first=Pin(point=p), second=Pin(point=q)):
                    cut = bar(p, q)
                case Tie(first=Pin(point=p)):
                    cut = symbol(p)
                case wheel if not isinstance(wheel, Tie):
                    cut = symbol(wheel.letter)
            (tried,) = seen(drawing, [one.tried.link])
            drawn = (link for each in one.chain for link in each.links)
            listed = escape(", ".join(seen(drawing, drawn)))
            yield drawing.words("step.close-within", k=escape(tried), list=listed, cut=cut)

    def links_drawn(self, drawing: Drawing) -> list[str]:
        """The links that give the locus: all but the link that is cut off at a pin or guide."""
        links, near, ends = drawing.scene.links, list(self.closes), {*self.pins}
        if self.guide:
            near = [self.guide, *(slide.on for slide in links[self.guide].slides)]
        cut = next(name for name in near if name in self.closes and ends <= {*links[name].points})
        return [name for name in self.closes if name != cut]

    def branch_words(self, drawing: Drawing) -> str:
        """The words that say which closure is drawn."""
        return drawing.words(
            "page.closure",
            list=escape(", ".join(seen(drawing, self.closes))),
            number=str(self.number),
            axis=axis_of(drawing, drawing.scene.link(self.counted)),
        )


def seen(drawing: Drawing, links: Iterable[str]) -> list[str]:
    """The links as sentences name them; a link that holds a wheel has the wheel's or bar's name."""
    scene, found = drawing.scene, list[str]()
    for name in links:
        if name in scene.unseen:
            wheel, track = scene.keepers[name]
            found.append(track.on if track.through is not None else wheel)
        else:
            found.append(name)
    return [*dict.fromkeys(found)]
