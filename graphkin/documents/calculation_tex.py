"""The relations of a calculation as a LaTeX document, for a script."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from graphkin.construction.core.drawn_scene import Drawing
from graphkin.construction.core.relation import Relation, Term, VectorEquation
from graphkin.documents.calculation import FIRST, legends
from graphkin.documents.relations import relations
from graphkin.documents.sheet import title_of
from graphkin.drawing.richtext import PRIMES, pieces
from graphkin.text import Words
from graphkin.writers.latex import formula_of, head, latex, maths
from graphkin.writers.latex import words as text_of

ARROWS = {"arrow": r"\vec", "bar": r"\overline"}
"""The marks of vectors by their names in the words."""


def calculation_tex(drawings: Sequence[Drawing], view: str) -> str:
    """The calculation of a mechanism: sections of numbered relations and vector equations.

    A task has room in place of the results.
    """
    words = drawings[0].words
    lines = [
        head("article", "a4paper,10pt", words.language),
        r"\setlength{\parindent}{0pt}",
        r"\setlength{\parskip}{4pt}",
        r"\begin{document}",
        f"\\section*{{{text_of(title_of(drawings[0]))}}}",
        *written(drawings, solved=view == "key"),
        r"\end{document}",
    ]
    return "\n".join(lines) + "\n"


def written(drawings: Sequence[Drawing], *, solved: bool) -> Iterator[str]:
    """The sections with their relations, numbered as on the calculation page."""
    words, number = drawings[0].words, 0
    for section, found in relations(drawings, solved=solved):
        if not found:
            continue
        yield f"\\subsection*{{{latex(words(f'calculation.{section}'))}}}"
        if solved and section == FIRST:
            for key in legends(drawings, found):
                yield f"\\emph{{{latex(words(f'calculation.{key}'))}}}\n"
        for relation in found:
            if relation.equation and relation.equation.sums:
                yield equation(relation.equation, words, solved=solved)
                continue
            number += bool(relation.result)
            yield line(relation, number, solved=solved)


def line(relation: Relation, number: int, *, solved: bool) -> str:
    """A relation in a paragraph, its number at the right."""
    said = " ".join(latex(part) for part in relation.parts(solved=solved))
    if not relation.result:
        return f"{said}\n"
    open_ = not (solved or relation.given)
    room = f" \\dotfill\\ {latex(relation.unit)}\\quad" if open_ else r" \hfill "
    return f"{said}{room}({number})\n"


def equation(found: VectorEquation, words: Words, *, solved: bool) -> str:
    """A vector equation; what is known of each vector is below it if solved."""
    mark = ARROWS[words("calculation.vector_mark")]
    sums = (" + ".join(vector(term, mark, solved) for term in terms) for terms in found.sums)
    return f"\\[{' = '.join((vector(found.whole, mark, solved), *sums))}\\]\n"


def vector(term: Term, mark: str, solved: bool) -> str:
    """A vector with its arrow or bar, underlined once for each part that is known."""
    letter, *scripts = pieces(term.symbol)
    bare = letter.text.rstrip(PRIMES)
    rest = [letter._replace(text=letter.text[len(bare) :]), *scripts]
    said = f"{mark}{{{maths_of(bare)}}}{formula_of(rest)}"
    if not solved:
        return said
    for _ in range(term.known):
        said = f"\\underline{{{said}}}"
    return f"\\underset{{{maths(term.note)}}}{{{said}}}" if term.note else said


def maths_of(letter: str) -> str:
    """The italic letter of a vector as LaTeX mathematics."""
    return maths(f"*{letter}*")
