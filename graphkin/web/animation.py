"""The animation of a cycle as files: a GIF picture and a page for a browser."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

from graphkin.documents.sheet_documents import language_of
from graphkin.text import Words
from graphkin.web.animation_pictures import PICTURE, Stage, stage
from graphkin.web.frames import FrameSequence

if TYPE_CHECKING:
    from collections.abc import Sequence

    from graphkin.drawing.marks import Mark
    from graphkin.motion.cycle import Cycle
    from graphkin.text.tables import Say


def animation_files(
    cycle: Cycle,
    stem: str,
    formats: Sequence[str],
    language: str | None = None,
    say: Say = lambda words: None,
) -> dict[str, bytes]:
    """The animation files of a cycle by name, for the formats ``gif`` and ``html``.

    ``language`` None means the scene's own language; ``say`` receives how far the work is. Raises
    SceneError where nothing can move.
    """
    if not {"gif", "html"} & set(formats):
        return {}
    from graphkin.web.frames import motion

    say("moving the mechanism")
    words = language_of(cycle.mechanism, language)
    found, files = motion(cycle, words), dict[str, bytes]()
    if "gif" in formats:
        files[f"{stem}-motion.gif"] = gif(found, words, say)
    if "html" in formats:
        from graphkin.web.player import player_page

        say("writing the page that moves")
        files[f"{stem}-motion.html"] = player_page(found, words).encode("utf-8")
    return files


# --- an animation as a GIF file -------------------------------------------------------------------


DOTS = 4.0
"""Dots per millimetre."""
PAUSE = 50
"""Milliseconds for which each picture is shown."""
COLOURS = 64
TASTED = 6
"""Number of pictures from which the colours are chosen."""


def gif(motion: FrameSequence, words: Words, say: Say = lambda words: None) -> bytes:
    """The GIF file of a motion, which repeats without end."""
    few = in_few_colours(drawn(stage(motion, words), say))
    first, *rest = (few[number] for number in motion.order)
    out = io.BytesIO()
    first.save(
        out, format="GIF", save_all=True, append_images=rest, duration=PAUSE, loop=0, optimize=False
    )
    return out.getvalue()


def drawn(set_up: Stage, say: Say) -> list[Any]:
    """The pictures of all moments in full colour. Marks that do not move are painted once."""
    from PIL import Image

    under = painted(set_up.still)
    ground = Image.alpha_composite(Image.new("RGBA", under.size, "white"), under)
    pictures, moments = list[Any](), set_up.motion.moments
    for number, moment in enumerate(moments, 1):
        say(f"drawing picture {number} of {len(moments)}")
        pictures.append(
            Image.alpha_composite(ground, painted(set_up.moving(moment))).convert("RGB")
        )
    return pictures


def painted(marks: Sequence[Mark]) -> Any:
    """A Pillow picture of some marks, transparent where nothing is drawn."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from PIL import Image

    from graphkin.writers.axes import put_marks

    width, height = PICTURE
    figure = Figure(figsize=(width / 25.4, height / 25.4), dpi=DOTS * 25.4, facecolor="none")
    canvas: Any = FigureCanvasAgg(figure)
    axes = figure.add_axes((0, 0, 1, 1))
    put_marks(axes, marks, (0.0, 0.0))
    axes.set_axis_off()
    axes.set_xlim(0, width)
    axes.set_ylim(-height, 0)
    dots, size = canvas.print_to_buffer()
    return Image.frombytes("RGBA", size, bytes(dots))


def in_few_colours(pictures: Sequence[Any]) -> list[Any]:
    """The pictures reduced to one shared palette, which is chosen from a few of them."""
    from PIL import Image

    step = max(len(pictures) // TASTED, 1)
    some = pictures[::step][:TASTED]
    width, height = some[0].size
    tasted = Image.new("RGB", (width, height * len(some)))
    for i, one in enumerate(some):
        tasted.paste(one, (0, i * height))
    colours = tasted.quantize(COLOURS, method=Image.Quantize.MEDIANCUT)
    return [one.quantize(palette=colours, dither=Image.Dither.NONE) for one in pictures]
