"""Make the sheet's font from DejaVu Sans: a renamed subset, its web form and its metrics.

A tool for maintainers (needs fontTools, brotli and matplotlib): ``python make_fonts.py``.
Running it twice gives the same bytes; nothing here is needed when sheets are written.
"""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import matplotlib
from fontTools.pens.boundsPen import BoundsPen  # type: ignore[import-untyped]
from fontTools.subset import Options, Subsetter  # type: ignore[import-untyped]
from fontTools.ttLib import TTFont  # type: ignore[import-untyped]

HERE = Path(__file__).parent
SOURCE = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
FACES = {
    "upright": ("DejaVuSans.ttf", "GraphkinSans", "Regular"),
    "italic": ("DejaVuSans-Oblique.ttf", "GraphkinSans-Italic", "Italic"),
}
SIGNS = (
    "′″‴⁗‖†•…‰‹›⁄–—―‘’‚‛“”„‟€№™Ω℮"
    "⁰ⁱ⁴⁵⁶⁷⁸⁹⁺⁻⁼⁽⁾ⁿ₀₁₂₃₄₅₆₇₈₉₊₋₌₍₎ₐₑₒₓₕₖₗₘₙₚₛₜ"
    "←↑→↓↔↕↖↗↘↙↶↷↺↻⇐⇒⇔⟶"
    "∀∂∃∅∆∈∏∑−∓∕∗∘∙√∛∝∞∟∠∡∢∣∥∦∧∨∩∪∫∴∼≃≅≈≠≡≤≥≪≫⊕⊖⊗⊙⊥⋅"
    "■□▪▫▲△▶▷▼▽◀◁◆◇○◎●◦⌀✓✔✗"
    "①②③④⑤⑥⑦⑧⑨⑩"
)


def wanted() -> set[int]:
    """Tell the code points the sheets may use: Latin, Romanian, Italian, Greek and signs."""
    latin = set(range(0x20, 0x7F)) | set(range(0xA0, 0x180)) - {0xAD}
    comma_below = set(range(0x218, 0x21C))
    greek = set(range(0x386, 0x3CF)) | {0x3D1, 0x3D5, 0x3D6, 0x3F1, 0x3F5}
    greek -= {0x38B, 0x38D, 0x3A2}
    return latin | comma_below | greek | {ord(sign) for sign in SIGNS}


def subset(source: Path, postscript: str, style: str) -> TTFont:
    """Cut the source font down to the wanted signs and give it its own name."""
    font = TTFont(source, recalcTimestamp=False)
    options = Options()
    options.layout_features = []
    options.hinting = False
    options.notdef_outline = True
    options.drop_tables += ["GPOS", "GSUB", "GDEF", "kern", "FFTM"]
    options.name_IDs = [0, 13, 14]
    cutter = Subsetter(options)
    cutter.populate(unicodes=wanted())
    cutter.subset(font)
    rename(font, postscript, style)
    font["head"].modified = font["head"].created
    return font


def rename(font: TTFont, postscript: str, style: str) -> None:
    """Name the font Graphkin Sans; copyright and licence records stay as they were."""
    table = font["name"]
    table.names = [record for record in table.names if record.platformID == 3]
    own = {1: "Graphkin Sans", 2: style, 3: f"{postscript} 1.0", 5: "Version 1.0", 6: postscript}
    for number, text in (own | {4: f"Graphkin Sans {style}"}).items():
        table.setName(text, number, 3, 1, 0x409)
    table.names.sort()


def measures(font: TTFont) -> dict[str, list[int]]:
    """Tell advance, lowest and highest ink of each code point, in font units."""
    glyphs = font.getGlyphSet()
    found = {}
    for code, name in sorted(font.getBestCmap().items()):
        pen = BoundsPen(glyphs)
        glyphs[name].draw(pen)
        _, low, _, high = pen.bounds or (0, 0, 0, 0)
        found[str(code)] = [glyphs[name].width, round(low), round(high)]
    return found


def main() -> None:
    """Write both faces as .ttf and .woff2, the metrics and the licence beside this file."""
    metrics: dict[str, object] = {}
    for face, (file, postscript, style) in FACES.items():
        font = subset(SOURCE / file, postscript, style)
        font.save(HERE / f"{postscript}.ttf")
        glyphs = measures(font)
        if face == "upright":
            height = glyphs[str(ord("H"))][2]
            metrics |= {"unitsPerEm": font["head"].unitsPerEm, "capHeight": height}
            metrics |= {"ascent": font["hhea"].ascent, "descent": font["hhea"].descent}
        metrics[face] = glyphs
        web = TTFont(HERE / f"{postscript}.ttf", recalcTimestamp=False)
        web.flavor = "woff2"
        web.save(HERE / f"{postscript}.woff2")
    text = json.dumps(metrics, separators=(",", ":"), sort_keys=True)
    (HERE / "metrics.json").write_text(text + "\n", encoding="utf-8")
    shutil.copyfile(SOURCE / "LICENSE_DEJAVU", HERE / "LICENSE-DejaVu.txt")


if __name__ == "__main__":
    main()
