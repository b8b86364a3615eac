"""Write markup as LaTeX, and the drawings of a page as a TikZ picture in true millimetres."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import groupby

from graphkin.drawing.marks import CircleMark, LineMark, Mark, Page, Point, Polyline, Text, reach
from graphkin.drawing.richtext import PRIMES, TextPiece, pieces
from graphkin.drawing.style import Ink, Style, style_of
from graphkin.writers.svg import number

HEAD = r"""\documentclass[{options}]{{{kind}}}
\usepackage{{iftex}}
\ifPDFTeX
  \usepackage[utf8]{{inputenc}}
  \usepackage[{encodings}T1]{{fontenc}}
\fi
\usepackage{{amsmath,amssymb}}
"""
"""The beginning of a document, for pdflatex and lualatex."""
SPECIAL = {
    **{sign: f"\\{sign}" for sign in "#$%&_{}"},
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "\u00a0": "~",
}
"""The characters of LaTeX, and no-break spaces, as text."""
MATHS = {
    **dict(zip("αβγδεζηθικλμνξπρστυφχψω", (
        *("alpha", "beta", "gamma", "delta", "varepsilon", "zeta", "eta", "theta", "iota"),
        *("kappa", "lambda", "mu", "nu", "xi", "pi", "rho", "sigma", "tau", "upsilon"),
        *("varphi", "chi", "psi", "omega"),
    ), strict=True)),
    "Γ": "Gamma", "Δ": "Delta", "Θ": "Theta", "Λ": "Lambda", "Ξ": "Xi", "Π": "Pi",
    "Σ": "Sigma", "Φ": "Phi", "Ψ": "Psi", "Ω": "Omega",
    "⊥": "perp", "∥": "parallel", "·": "cdot", "×": "times", "÷": "div", "−": "-",
    "≈": "approx", "≡": "equiv", "≠": "neq", "≤": "leq", "≥": "geq", "±": "pm", "→": "to",
    "∞": "infty", "√": "surd", "∠": "angle", "△": "triangle", "°": "degree", "∓": "mp",
    "′": "prime", "″": "prime\\prime", "‴": "prime\\prime\\prime", "∫": "textstyle\\int",
    "↔": "leftrightarrow", "←": "gets", "↑": "uparrow", "↓": "downarrow", "∼": "sim",
    "∈": "in", "∂": "partial", "∑": "textstyle\\sum", "∝": "propto",
}  # fmt: skip
"""Signs and Greek letters as commands of mathematics."""
POWERS = {"²": "2", "³": "3", "¹": "1"}
"""Exponents that are characters."""


def latex(markup: str) -> str:
    """Markup as LaTeX text: italics and scripts in mathematics, words between them."""
    found = ""
    parts = [part for piece in pieces(markup) for part in parted(piece)]
    for is_formula, group in groupby(parts, key=is_mathematics):
        some = [*group]
        if not is_formula:
            found += "".join(words(piece.text) for piece in some)
            continue
        before = " " * some[0].text.startswith(" ")
        after = " " * some[-1].text.endswith(" ")
        found += f"{before}${formula_of(some)}${after}"
    return found


LISTED = r"(?<=\d)(?:, | ?: | \()"
"""What follows a number in a list: a comma, a colon, or a bracket after a space."""
NUMBERS = re.compile(rf"[^\W\d_]+(?:/[^\W\d_]+)*|{LISTED}|(?:(?!{LISTED})[\W\d_])+")
"""Words of letters, and what is between them."""
SUMS = re.compile(r"[\d=+−·÷×≈≡⊥∥±√<>′″‴]")
"""The characters by which text between words is mathematics."""
JOINING = ("/", "(", ")", ")/", "/(")
"""Pieces that are mathematics by themselves."""


def parted(piece: TextPiece) -> Iterator[TextPiece]:
    """A piece of upright text, divided into words and mathematics; other pieces whole."""
    if piece.italic or piece.level:
        yield piece
        return
    for text in NUMBERS.findall(piece.text):
        yield piece._replace(text=text)


def is_mathematics(piece: TextPiece) -> bool:
    """Whether a piece is written as mathematics."""
    signs_alone = piece.text in JOINING or all(sign in MATHS for sign in piece.text)
    return bool(piece.italic or piece.level or signs_alone or SUMS.search(piece.text))


def maths(markup: str) -> str:
    """Markup as LaTeX mathematics, without the signs around it."""
    return formula_of(pieces(markup))


def words(text: str) -> str:
    """Plain text as LaTeX."""
    return "".join(word(sign) for sign in text)


def word(sign: str) -> str:
    """A character of plain text as LaTeX."""
    if sign in SPECIAL:
        return SPECIAL[sign]
    if sign in PRIMES:
        return f"${{}}^{{\\{MATHS[sign]}}}$"
    if sign in POWERS:
        return f"${{}}^{{{POWERS[sign]}}}$"
    if sign == "°":
        return r"${}^{\circ}$"
    return f"${sign_of(sign, italic=True).strip()}$" if sign in MATHS else sign


def formula_of(parts: Iterable[TextPiece]) -> str:
    """Pieces as LaTeX mathematics; a prime is in the superscript of its letter."""
    found, upper = "", ""

    def closed() -> str:
        return f"^{{{upper}}}" if upper else ""

    for piece in parts:
        bare = piece.text.rstrip(PRIMES)
        primes = "".join("\\" + MATHS[sign] for sign in piece.text[len(bare) :])
        if piece.level > 0:
            upper += signs(piece)
        elif piece.level < 0:
            found += f"_{{{signs(piece)}}}"
        else:
            found += closed() + signs(piece._replace(text=bare))
            upper = primes
    return found + closed()


def signs(piece: TextPiece) -> str:
    """The characters of a piece as LaTeX mathematics; upright ones as roman letters."""
    said = "".join(sign_of(sign, italic=piece.italic) for sign in piece.text)
    said = said.replace("{,} ", ", ")
    roman = not piece.italic and any(sign.isalpha() and sign not in MATHS for sign in piece.text)
    return f"\\mathrm{{{said}}}" if roman else said


def sign_of(sign: str, *, italic: bool) -> str:
    """A character as LaTeX mathematics."""
    if sign == "°":
        return r"{}^{\circ}"
    if sign == "−":
        return "-"
    if sign in PRIMES:
        return f"^{{\\{MATHS[sign]}}}"
    if sign in MATHS:
        return f"\\{MATHS[sign]} "
    if sign in POWERS:
        return f"{{}}^{{{POWERS[sign]}}}"
    if sign in " \u00a0":
        return r"\ " if italic else " "
    if sign in ",;":
        return f"{{{sign}}}" if sign == "," else sign
    return SPECIAL.get(sign, sign) if italic or sign.isascii() else f"\\text{{{sign}}}"


def head(kind: str, options: str, language: str) -> str:
    """The beginning of a document of a kind; Russian letters need an encoding of their own."""
    return HEAD.format(kind=kind, options=options, encodings="T2A," if language == "ru" else "")


# --- the drawings of a page -----------------------------------------------------------------------


POINT, CAPITAL = 72.27 / 25.4, 0.694
"""Points of TeX in a millimetre, and the height of capitals of Computer Modern Sans in em."""
ANCHORS = {"start": "base west", "middle": "base", "end": "base east"}


def write_tikz(page: Page, ink: Ink = "colour") -> str:
    """The drawings of a page as a document of one TikZ picture, in millimetres and y down.

    Only what lies in the drawn part of the page is written, without frame, title block and tables.
    A script includes it by ``\\input`` with the package standalone. Raises PageError for marks that
    are not finite.
    """
    page.check()
    shown = [mark for mark in page.marks if is_inside(mark, page)]
    styled = [(mark, style_of(mark.cls, ink, page.weight)) for mark in shown]
    looks = dict.fromkeys(style for mark, style in styled if not isinstance(mark, Text))
    names = {style: f"g{number}" for number, style in enumerate(looks, 1)}
    lines = [
        head("standalone", "tikz", page.lang) + r"\begin{document}",
        r"\begin{tikzpicture}[x=1mm, y=-1mm, every node/.style={inner sep=0pt, outer sep=0pt}]",
        *(f"\\tikzset{{{name}/.style={{{options(style)}}}}}" for style, name in names.items()),
        *(tikz(mark, style, names.get(style, "")) for mark, style in styled),
        r"\end{tikzpicture}",
        r"\end{document}",
    ]
    return "\n".join(lines) + "\n"


def is_inside(mark: Mark, page: Page) -> bool:
    """Whether a mark lies in the drawn part of its page; without such a part all marks do."""
    if page.drawn is None:
        return True
    left, top, right, low = page.drawn
    x1, y1, x2, y2 = reach(mark)
    return left <= x1 and x2 <= right and top <= y1 and y2 <= low


def colour(code: str) -> str:
    """Write ``#rrggbb`` as a colour of TikZ."""
    red, green, blue = (int(code[i : i + 2], 16) for i in (1, 3, 5))
    return f"{{rgb,255:red,{red};green,{green};blue,{blue}}}"


def options(style: Style) -> str:
    """A style as options of TikZ; text has none of them but its colour."""
    found = list[str]()
    if style.width:
        found += [f"draw={colour(style.colour)}", f"line width={style.width:g}mm"]
    if style.fill:
        found.append(f"fill={colour(style.fill)}")
    if style.dash:
        lengths = (f"{'off' if i % 2 else 'on'} {each:g}mm" for i, each in enumerate(style.dash))
        found.append(f"dash pattern={' '.join(lengths)}")
    if style.round:
        found.append("line cap=round, line join=round")
    return ", ".join(found)


def at(x: float, y: float) -> str:
    """Write a place with at most four decimals, as in SVG."""
    return f"({number(x)},{number(y)})"


def path(points: Iterable[Point]) -> str:
    return " -- ".join(at(x, y) for x, y in points)


def tikz(mark: Mark, style: Style, name: str) -> str:
    """A mark as a command of TikZ, in a style with a name."""
    if isinstance(mark, Text):
        size = mark.height / CAPITAL * POINT
        font = f"\\fontsize{{{size:.2f}pt}}{{{1.2 * size:.2f}pt}}\\selectfont\\sffamily"
        turn = f", rotate={mark.rotate:g}" if mark.rotate else ""
        own = f"font={font}{turn}, text={colour(style.colour)}"
        how = f"anchor={ANCHORS[mark.anchor]}, {own}"
        return f"\\node[{how}] at {at(mark.x, mark.y)} {{{latex(mark.markup)}}};"
    if isinstance(mark, LineMark):
        return f"\\path[{name}, fill=none] {path([(mark.x1, mark.y1), (mark.x2, mark.y2)])};"
    if isinstance(mark, Polyline):
        end = " -- cycle" if mark.closed else ""
        return f"\\path[{name}{'' if mark.closed else ', fill=none'}] {path(mark.points)}{end};"
    if isinstance(mark, CircleMark):
        return f"\\path[{name}] {at(mark.cx, mark.cy)} circle[radius={mark.r:.4g}];"
    turns = f"start angle={-mark.start:.4f}, end angle={-mark.end:.4f}, radius={mark.r:.4f}"
    return f"\\path[{name}, fill=none] {at(*mark.at(mark.start))} arc[{turns}];"
