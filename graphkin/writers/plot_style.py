"""The style of curves: one font, quiet colours, thin grids; the same data give the same bytes."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any
from warnings import catch_warnings, filterwarnings

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = ("#1f5fa8", "#c8501e", "#2b8a5b", "#8a4fa3", "#b8860b", "#4a5a6a", "#c2407d", "#008b9a")
"""Colours of the curves in order; distinct in grey and for the colour-blind, too."""
INK = "#26323c"
FAINT = "#8895a0"
PALE = "#dfe5ea"
DOTS = 150
"""Dots per inch of a PNG."""
FORMATS = ("svg", "png")

LOOK: dict[str, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "mathtext.fontset": "dejavusans",
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.7,
    "axes.titlesize": 9.5,
    "axes.titlecolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "axes.grid": True,
    "grid.color": PALE,
    "grid.linewidth": 0.5,
    "lines.linewidth": 1.5,
    "lines.solid_capstyle": "round",
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "text.color": INK,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "figure.facecolor": "white",
    "svg.hashsalt": "graphkin",
    "svg.fonttype": "path",
    "savefig.dpi": DOTS,
}


@contextmanager
def look() -> Iterator[None]:
    """Draw in the style of this package, regardless of the user's settings."""
    import matplotlib as mpl

    with mpl.rc_context(), catch_warnings():
        # A title may contain characters that the font lacks; each appears as a box.
        filterwarnings("ignore", message="Glyph .* missing from font")
        mpl.rcdefaults()
        mpl.rcParams.update(LOOK)  # type: ignore[arg-type]
        yield


def new_figure(width: float, height: float) -> Figure:
    """An empty figure, sizes in inches, with a layout that fits its contents."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


NO_DATE: dict[str, dict[str, Any]] = {
    "svg": {"Date": None, "Creator": None},
    "png": {"Software": None},
}
"""The metadata of each format, which would differ from run to run."""


def figure_file(figure: Figure, kind: str, *, laid_out: bool = False) -> bytes:
    """The file of a figure, svg or png, without a date.

    A figure that is ``laid_out`` already is drawn once; otherwise it is drawn twice, as its first
    drawing places its parts.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    out = io.BytesIO()
    if laid_out and kind == "png":
        figure.dpi = DOTS
        canvas = FigureCanvasAgg(figure)
        canvas.print_png(out, metadata=NO_DATE[kind])  # type: ignore[no-untyped-call]
    else:
        figure.savefig(out, format=kind, metadata=NO_DATE[kind])
    data = out.getvalue()
    return without_trailing_blanks(data) if kind == "svg" else data


def without_trailing_blanks(data: bytes) -> bytes:
    """The lines of a text without blanks at their ends."""
    return b"\n".join(line.rstrip() for line in data.split(b"\n"))


def figure_title(figure: Figure, text: str, **how: Any) -> None:
    """Set the title of a figure as plain text; a scene's title is no formula."""
    figure.suptitle(text, parse_math=False, **how)


def footnote(figure: Figure, text: str, *, size: float = 8, colour: str = FAINT) -> None:
    """Add a small note below a figure, from its left edge."""
    figure.supxlabel(text, x=0.01, ha="left", fontsize=size, color=colour)


def picture_files(
    figures: Iterable[tuple[str, Callable[[], Figure | None]]], formats: Sequence[str]
) -> dict[str, bytes]:
    """The files of figures by name, in each of some formats, drawn in this style one by one."""
    files: dict[str, bytes] = {}
    with look():
        for stem, drawn in figures:
            if (figure := drawn()) is None:
                continue
            for number, kind in enumerate(formats):
                files[f"{stem}.{kind}"] = figure_file(figure, kind, laid_out=number > 0)
                figure.set_layout_engine("none")  # |the next format has the places of the first
    return files


def legend(ax: Axes) -> None:
    """Draw the legend above the panel, on the right, away from the curves."""
    handles, labels = ax.get_legend_handles_labels()
    if handles:
        ax.legend(
            handles,
            labels,
            loc="lower right",
            bbox_to_anchor=(1.0, 1.0),
            ncols=min(len(handles), 8),
            borderaxespad=0.2,
            handlelength=2.2,
            columnspacing=1.4,
        )


def panel_heading(ax: Axes, text: str, *, raised: bool = False) -> None:
    """Draw the heading above a panel on the left; raised, above a long legend."""
    ax.set_title(text, loc="left", fontweight="bold", pad=20 if raised else None)
