"""Make the sheet's font from Source Sans 3 (upright), STIX Two (italic) and DejaVu Sans (the rest).

A tool for maintainers (needs fontTools, brotli and matplotlib): ``python make_fonts.py FOLDER``.
FOLDER holds the unpacked packages source-sans-3 and stix-two-text of Fontsource. Capitals of all
fonts get the same height. Two runs give the same bytes. Writing sheets does not need this module.
"""

from __future__ import annotations

import json
import shutil
import sys
from pathlib import Path

import matplotlib
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.boundsPen import BoundsPen
from fontTools.pens.recordingPen import DecomposingRecordingPen
from fontTools.pens.transformPen import TransformPen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTFont

HERE = Path(__file__).parent
DEJAVU = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
FACES = {
    "upright": ("source-sans-3", "normal", "DejaVuSans.ttf", "GraphkinSans", "Regular"),
    "italic": (
        "stix-two-text",
        "italic",
        "DejaVuSans-Oblique.ttf",
        "GraphkinSans-Italic",
        "Italic",
    ),
}
PARTS = ("latin", "latin-ext", "greek", "greek-ext", "cyrillic")
"""The files into which Fontsource divides a face; not every face has all of them."""
EM, CAPITAL = 1000, 660
"""Font units per em, and the height of capitals in font units."""
ASCENT, DESCENT = 1024, 400
SIGNS = (
    "′″‴⁗‖†•…‰‹›⁄–—―‘’‚‛“”„‟€№™Ω℮"
    "⁰ⁱ⁴⁵⁶⁷⁸⁹⁺⁻⁼⁽⁾ⁿ₀₁₂₃₄₅₆₇₈₉₊₋₌₍₎ₐₑₒₓₕₖₗₘₙₚₛₜ"
    "←↑→↓↔↕↖↗↘↙↶↷↺↻⇐⇒⇔⟶"
    "∀∂∃∅∆∈∏∑−∓∕∗∘∙√∛∝∞∟∠∡∢∣∥∦∧∨∩∪∫∴∼≃≅≈≠≡≤≥≪≫⊕⊖⊗⊙⊥⋅"
    "■□▪▫▲△▶▷▼▽◀◁◆◇○◎●◦⌀✓✔✗"
    "①②③④⑤⑥⑦⑧⑨⑩"
)


def wanted() -> set[int]:
    """The code points that sheets may use: Latin, Greek, Russian and signs."""
    latin = set(range(0x20, 0x7F)) | set(range(0xA0, 0x180)) - {0xAD}
    comma_below = set(range(0x218, 0x21C))
    greek = set(range(0x386, 0x3CF)) | {0x3D1, 0x3D5, 0x3D6, 0x3F1, 0x3F5}
    greek -= {0x38B, 0x38D, 0x3A2}
    russian = set(range(0x410, 0x450)) | {0x401, 0x451}
    return latin | comma_below | greek | russian | {ord(sign) for sign in SIGNS}


def sources(folder: Path, package: str, style: str, other: str) -> list[TTFont]:
    """The fonts of a face, in the order in which characters are searched for."""
    files = folder / package / "package" / "files"
    found = [files / f"{package}-{part}-400-{style}.woff2" for part in PARTS]
    return [TTFont(path) for path in (*found, DEJAVU / other) if path.exists()]


def face_of(fonts: list[TTFont], postscript: str, style: str) -> TTFont:
    """A face with the wanted characters, each from the first font that has it."""
    capital = [height(font) for font in fonts]
    glyphs, widths, names = {".notdef": TTGlyphPen(None).glyph()}, {".notdef": EM // 2}, {}
    for code in sorted(wanted()):
        for font, own in zip(fonts, capital, strict=True):
            if code in font.getBestCmap():
                names[code] = f"u{code:04X}"
                scale = CAPITAL / (own or capital[0])
                glyphs[names[code]] = scaled(font, font.getBestCmap()[code], scale)
                width = font.getGlyphSet()[font.getBestCmap()[code]].width
                widths[names[code]] = round(width * scale)
                break
    builder = FontBuilder(EM, isTTF=True)
    builder.setupGlyphOrder(list(glyphs))
    builder.setupCharacterMap(names)
    builder.setupGlyf(glyphs)
    left = {name: glyph.xMin if glyph.numberOfContours else 0 for name, glyph in glyphs.items()}
    builder.setupHorizontalMetrics({name: (widths[name], left[name]) for name in glyphs})
    builder.setupHorizontalHeader(ascent=ASCENT, descent=-DESCENT)
    builder.setupNameTable({
        "copyright": "\n".join(dict.fromkeys(font["name"].getDebugName(0) for font in fonts)),
        "familyName": "Graphkin Sans",
        "styleName": style,
        "uniqueFontIdentifier": f"{postscript} 2.0",
        "fullName": f"Graphkin Sans {style}",
        "version": "Version 2.0",
        "psName": postscript,
        "licenseDescription": "SIL Open Font License 1.1; some signs under the licence of DejaVu",
    }, mac=False)  # fmt: skip
    builder.setupOS2(sTypoAscender=ASCENT, sTypoDescender=-DESCENT, sCapHeight=CAPITAL)
    builder.setupPost(italicAngle=-12 if style == "Italic" else 0)
    font = builder.font
    font["head"].created = font["head"].modified = 3_786_912_000  # 2024-01-01
    font.recalcTimestamp = False
    return font


def height(font: TTFont) -> int:
    """The height of a font's capitals, in its own units; 0 for a font without them."""
    name = font.getBestCmap().get(ord("H"))
    return 0 if name is None else bounds(font, name)[1]


def scaled(font: TTFont, name: str, scale: float) -> object:
    """The outline of a glyph in units of the new font, without references to other glyphs."""
    drawn = DecomposingRecordingPen(font.getGlyphSet())
    font.getGlyphSet()[name].draw(drawn)
    pen = TTGlyphPen(None)
    drawn.replay(TransformPen(pen, (scale, 0, 0, scale, 0, 0)))
    return pen.glyph()


def bounds(font: TTFont, name: str) -> tuple[int, int]:
    """The lowest and the highest ink of a glyph, in font units."""
    pen = BoundsPen(font.getGlyphSet())
    font.getGlyphSet()[name].draw(pen)
    _, low, _, high = pen.bounds or (0, 0, 0, 0)
    return round(low), round(high)


def measures(font: TTFont) -> dict[str, list[int]]:
    """Advance, lowest and highest ink of each code point, in font units."""
    widths = font["hmtx"]
    return {
        str(code): [widths[name][0], *bounds(font, name)]
        for code, name in sorted(font.getBestCmap().items())
    }


def main() -> None:
    """Write both faces as .ttf and .woff2, the metrics and the licences next to this file."""
    folder = Path(sys.argv[1])
    metrics: dict[str, object] = {"unitsPerEm": EM, "capHeight": CAPITAL}
    metrics |= {"ascent": ASCENT, "descent": -DESCENT}
    for face, (package, slant, other, postscript, style) in FACES.items():
        font = face_of(sources(folder, package, slant, other), postscript, style)
        font.save(HERE / f"{postscript}.ttf")
        metrics[face] = measures(font)
        web = TTFont(HERE / f"{postscript}.ttf", recalcTimestamp=False)
        web.flavor = "woff2"
        web.save(HERE / f"{postscript}.woff2")
        shutil.copyfile(folder / package / "package" / "LICENSE", HERE / f"LICENSE-{package}.txt")
    text = json.dumps(metrics, separators=(",", ":"), sort_keys=True)
    (HERE / "metrics.json").write_text(text + "\n", encoding="utf-8")
    shutil.copyfile(DEJAVU / "LICENSE_DEJAVU", HERE / "LICENSE-DejaVu.txt")


if __name__ == "__main__":
    main()
