"""Explains each student's sheet as a whole: no mistake, one cause, two causes, or unexplained.

Every hypothesis says what the student would have written. It is judged by all answers together,
with the pencil's errors in the student's own construction and with a pencil of any coarseness. A
value is compared with the student's own length, from which it was computed: so what follows from
the cause counts for it once. An answer that no hypothesis gives is a mistake of any size.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import combinations
from math import inf, log, pi
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from graphkin.accuracy.pencil import STRAIGHT
from graphkin.classroom.grading.answer_numbers import rounding
from graphkin.classroom.grading.causes import Cause, Change, Variants
from graphkin.classroom.grading.graded import Answer
from graphkin.classroom.grading.keys import ASTRAY, HALF, Key, Keys, fit
from graphkin.classroom.grading.readings import OWN, FormFields, View
from graphkin.classroom.grading.standard import Standard, alike, sense_is_open
from graphkin.numbers.arithmetic import np

Array = Any
PENCILS = (0.35, 0.7, 1.4, 2.8, 5.6, 11.0)
"""The coarseness of pencils, relative to the one that is forgiven."""
RARE_PENCILS = (-0.7, 0.0, 0.0, -0.7, -2.0, -4.0)
"""How rare each of them is, as a logarithm."""
MISTAKES = 0.03
"""The share of answers that are mistakes of their own."""
COMPUTED = 0.004
"""The relative error of a value computed from a length as it was read."""
DIRECT = 0.15
"""How often a value is not computed from the length that was handed in."""
SHARE = log(1 / 60)
"""How frequent each cause is, as a logarithm."""
LIKELY = 3.0
"""The least odds, as a logarithm, at which a cause is named."""
FAINT, AS_ONE = 1.0, 8.0
"""The same where answers fit a cause as one drawing with at least the second odds."""
SENSES = -1.0
"""The same where nothing but senses is wrong, all of which the cause must reverse."""
SECOND = 2.0
"""The least odds, as a logarithm, by which two causes must be likelier than one."""
EXPLAINS = 0.6
"""The least share of the wrong answers that an explanation must give."""
MOSTLY = 0.1
"""The part of its distance from the key, as a logarithm, within which a number is explained in the
main: it is a mistake of its own beside the cause."""
SPOILS = 0.25
"""The largest share of all answers that an explanation may leave unexplained."""
SPAN = (0.5, 4.0)
"""The least and largest factor by which an error scales with its value."""
SPREAD = (0.5, 30.0)
"""The least and largest factor by which an error grows in another drawing."""
ONE_DRAWING = 3.3
"""The least odds of an explanation as one drawing against the key as one, as a logarithm."""
TOGETHER = 8.0
"""The least sum of both odds: field by field, and as one drawing."""
MOST = 1.0
"""The largest error of an answer that an explanation gives, in parts of the value."""
BEST = 12
"""The number of hypotheses of a student that are compared, and of causes of which pairs are."""
COARSE = (2,)
"""The pencil by which all pairs are compared."""
CLOSE = 4
"""The number of pairs that are compared with every pencil."""
EVEN = 2.0
"""The odds, as a logarithm, within which the answers do not tell two causes apart."""
CHOICE = 4.0
"""The largest difference in how frequent two such causes are, as a logarithm."""


class SheetCauses(Struct, frozen=True):
    """The causes that explain a sheet, and what a student with these causes would have written.

    ``values`` are sizes, places and senses by field. ``times`` is how many times as large each
    error then is. ``odds`` says how much likelier this is than no mistake, as a logarithm.
    ``fits`` are the fields whose answers agree; those that are ``alone`` agree whatever they are.
    ``single`` is the best explanation by one cause, where these are two. ``either`` names another
    cause that gives the same answers as the one cause, within the errors of the drawing.
    """

    causes: tuple[Cause, ...]
    values: Mapping[str, float]
    times: Mapping[str, float]
    odds: float
    fits: frozenset[str] = frozenset()
    alone: frozenset[str] = frozenset()
    single: SheetCauses | None = None
    either: str = ""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the causes, each once."""
        return tuple(dict.fromkeys(cause.name for cause in self.causes))


class Hypothesis(Struct, frozen=True):
    """Some causes, the change of the construction, and the readings after it."""

    causes: tuple[Cause, ...] = ()

    @property
    def share(self) -> float:
        """How frequent it is, as a logarithm."""
        return sum(SHARE + log(cause.rare) for cause in self.causes)

    @property
    def made(self) -> tuple[tuple[str, str], ...]:
        """The names and ways of its causes in the construction."""
        return tuple((e.name, e.way) for e in self.causes if e.change is not None)

    @property
    def change(self) -> Change | None:
        """The change of the construction by all causes; None where they do not go together."""
        whole: Change | None = Change()
        for cause in self.causes:
            if cause.change is not None and whole is not None:
                whole = whole.and_then(cause.change)
        return whole


class Predicted(Struct, frozen=True):
    """What students would draw and write by a hypothesis.

    ``other``, ``price`` and ``alone`` are those of what is :class:`Told`.
    ``grown`` is how many times as large the errors of such a drawing are beside those of the key.
    """

    drawn: Array
    written: Array
    grown: Array
    other: Array | None = None
    price: Array | float = 0.0
    alone: Array | bool = False


class AnswerSheets(Struct, frozen=True, dict=True):
    """The answers of some students whose variants draw alike, as arrays.

    ``rows`` are the places of their variants. ``missed`` marks answers that are wrong by the key.
    """

    form: FormFields
    rows: Array
    given: Sequence[Mapping[str, Answer]]
    missed: Array

    @property
    def variants(self) -> Variants:
        """The variants of the students."""
        return self.form.variants

    @cached_property
    def answers(self) -> Array:
        """The answers, NaN where there is none."""
        fields = self.variants.fields
        read = [[each[field].value for field in fields] for each in self.given]
        values = np.array([[np.nan if v is None else v for v in row] for row in read], dtype=float)
        sized = ~(self.form.senses | self.form.centres)
        return np.where(sized, abs(values), values)

    @cached_property
    def rounded(self) -> Array:
        """The relative rounding error of each answer as it is written."""
        fields = self.variants.fields
        return np.array([[rounding(each[field]) for field in fields] for each in self.given])

    @cached_property
    def view(self) -> View:
        """What the students have before them."""
        fields = self.variants.fields
        whole = [[not {".", ","} & {*each[field].text} for field in fields] for each in self.given]
        return View(self.form, self.rows, self.answers, np.array(whole), self.errors[0])

    @cached_property
    def is_read(self) -> Array:
        """The answers that can be judged."""
        return ~np.isnan(self.answers)

    @cached_property
    def key(self) -> Array:
        """The right values."""
        return self.variants.key[self.rows]

    @cached_property
    def errors(self) -> tuple[Array, Array]:
        """The deviations of the forgiven pencil and ruler in each field; zero for senses."""
        tolerances = [each.tolerance for each in self.variants.standards]
        fields = self.variants.fields
        pencil, ruler = (
            np.array(
                [[getattr(t[f], part) if f in t else 0.0 for f in fields] for t in tolerances]
            )[self.rows]
            for part in ("pencil", "ruler")
        )
        return np.nan_to_num(pencil, posinf=1e12) / STRAIGHT, np.nan_to_num(ruler) / STRAIGHT

    @cached_property
    def astray(self) -> Array:
        """The density of mistakes of their own, as a logarithm."""
        sizes = np.maximum(self.answers, 1e-12 + 1e-6 * abs(self.key))
        with np.errstate(all="ignore"):
            apart = np.log(sizes / np.maximum(abs(self.key), 1e-12)) / HALF
            size = -np.log(pi * HALF * sizes * (1 + apart**2))
            away = (self.answers - self.key) / ASTRAY
            place = -np.log(pi * ASTRAY * (1 + away**2))
        return log(MISTAKES) + np.where(self.form.centres, place, size)

    @cached_property
    def known(self) -> Array:
        """The places of fields whose own segment was answered, as pairs of value and segment."""
        values = np.flatnonzero(self.form.segments >= 0)
        return np.array([values, self.form.segments[values]]) if len(values) else None

    # --- judging hypotheses -----------------------------------------------------------------------

    def shown(self, hypothesis: Hypothesis, *, closely: bool = False) -> Predicted | None:
        """What the students would write by a hypothesis; None where it cannot be drawn.

        ``closely`` draws with the pencil's errors; else these grow with what is drawn.
        """
        drawing = self.drawn(hypothesis)
        if drawing is None:
            return None
        drawn, values = drawing
        predicted, other = drawn, None
        price: Array | float = 0.0
        alone: Array | bool = False
        for cause in hypothesis.causes:
            if cause.reads is not None:
                told = cause.reads(predicted, self.view, values)
                if other is not None:
                    again = cause.reads(other, self.view, values)
                    same, also = other == predicted, again.other
                    other = again.written if also is None else np.where(same, also, again.written)
                elif told.other is not None:
                    other = told.other
                predicted, price = told.written, price + told.price
                alone = alone if told.alone is None else alone | told.alone
        with np.errstate(all="ignore"):
            grown = growing(drawn, self.key)
            if closely and hypothesis.made:
                most = SPREAD[1] * np.maximum(1.0, abs(drawn / self.key))
                own = self.grown(hypothesis)
                grown = np.where(np.isnan(own), grown, np.clip(own, SPREAD[0], most))
        grown = np.where(self.form.senses, 1.0, grown)
        found = Predicted(drawn, predicted, grown, other, price, alone)
        return replace(found, written=self.with_open_senses(found)) if closely else found

    def with_open_senses(self, prediction: Predicted) -> Array:
        """What is written, with zero for senses that such a drawing leaves open."""
        sized = self.form.sized
        if not (sized >= 0).any():
            return prediction.written
        error = STRAIGHT * self.errors[0] * self.times(prediction, prediction.written)
        is_open = (abs(prediction.written) <= error)[:, sized] & (sized >= 0)
        return np.where(is_open, 0.0, prediction.written)

    def grown(self, hypothesis: Hypothesis) -> Array:
        """How many times as large a drawing's errors are, by drawing with the pencil's errors."""
        change = hypothesis.change
        assert change is not None
        known = self.growths.setdefault(hypothesis.made, {})
        new = sorted({*self.rows.tolist()} - known.keys())
        if new:
            plain = self.growths.setdefault((), {})
            first = sorted({*new} - plain.keys())
            if first:
                deviations = self.variants.deviations(Change(), first)
                plain.update(zip(first, deviations, strict=True))
            growths = self.variants.deviations(change, new) / np.array([plain[i] for i in new])
            known.update(zip(new, growths, strict=True))
        return np.array([known[i] for i in self.rows.tolist()])

    @cached_property
    def growths(self) -> dict[tuple[tuple[str, str], ...], dict[int, Array]]:
        """A cache of the growth of errors by hypothesis and variant; of deviations, by none."""
        return {}

    def drawn(self, hypothesis: Hypothesis) -> tuple[Array, Mapping[int, Any]] | None:
        """The fields as read rightly off the drawing of a hypothesis, and its values by step."""
        key = hypothesis.made
        if key not in self.drawings:
            change = hypothesis.change
            found = None if change is None else self.variants.changed(change)
            self.drawings[key] = None
            if found is not None and change is not None:
                read_values = self.variants.read(found, change.faster)
                self.drawings[key] = read_values, {**self.variants.values, **found}
        known: tuple[Array, Mapping[int, Any]] | None = self.drawings[key]
        return None if known is None else (known[0][self.rows], known[1])

    @cached_property
    def drawings(self) -> dict[tuple[tuple[str, str], ...], Any]:
        """A cache of the drawings of hypotheses, of all variants."""
        return {}

    def judged(
        self,
        hypothesis: Hypothesis,
        pencils: Iterable[int] = range(len(PENCILS)),
        *,
        closely: bool = False,
    ) -> Array:
        """How likely each student's answers are by a hypothesis, as a logarithm."""
        prediction = self.shown(hypothesis, closely=closely)
        if prediction is None:
            return np.full(len(self.rows), -inf)
        return self.likely(prediction, pencils) + hypothesis.share

    def likely(self, prediction: Predicted, pencils: Iterable[int] = range(len(PENCILS))) -> Array:
        """How likely each student's answers are with the likeliest pencil, as a logarithm."""
        some = list(pencils)
        each = self.by_field(prediction, prediction.written, np.array(PENCILS)[some])
        if prediction.other is not None:
            also = self.by_field(prediction, prediction.other, np.array(PENCILS)[some])
            with np.errstate(invalid="ignore"):
                each = np.logaddexp(each, also) - HALF
        whole = np.where(self.is_read, each, 0.0).sum(axis=2)
        likely: Array = (whole + np.array(RARE_PENCILS)[some, None]).max(axis=0)
        return likely + prediction.price

    def by_field(self, prediction: Predicted, predicted: Array, pencils: Array) -> Array:
        """The density of each answer where some values are aimed at, as a logarithm.

        An array by pencil, student and field.
        """
        form, answers = self.form, self.answers
        with np.errstate(all="ignore"):
            sizes = np.where(form.centres, predicted, abs(predicted))
            drawn, read = self.errors
            times = self.times(prediction, predicted)
            fixed = (read * np.maximum(times, 1.0)) ** 2
            fixed = fixed + (self.rounded * answers) ** 2 / 3 + (COMPUTED * sizes) ** 2
            spread = pencils[:, None, None] ** 2 * (drawn * times) ** 2 + fixed
            found = -0.5 * ((answers - sizes) ** 2 / spread + np.log(2 * pi * spread))
            if self.known is not None:
                values, own = self.known
                found[..., values] = self.by_length(sizes, found, values, own)
            found = np.logaddexp(log(1 - MISTAKES) + found, self.astray)
            found = np.where(np.isnan(found), self.astray, found)
            found = np.where(prediction.alone, -np.log(2 * log(OWN) * abs(answers)), found)
            sense = np.where(answers == np.sign(predicted), log(1 - MISTAKES), log(MISTAKES))
            unclear = np.isnan(predicted) | (predicted == 0)
            sense = np.where(unclear | self.open_senses, log(0.5), sense)
        return np.where(form.senses, sense, found)

    def by_length(self, sizes: Array, direct: Array, values: Array, own: Array) -> Array:
        """The density of values that are computed from a length of the student's own."""
        answers = self.answers
        apart = np.log(answers[:, values] / answers[:, own])
        apart = apart - np.log(sizes[:, values] / sizes[:, own])
        spread = COMPUTED + self.rounded[:, values] + self.rounded[:, own] / 2
        found = -0.5 * (apart / spread) ** 2 - np.log(spread * answers[:, values]) - log(2 * pi) / 2
        direct = direct[..., values]
        whole = np.logaddexp(log(1 - DIRECT) + found, log(DIRECT) + direct)
        return np.where(np.isnan(whole), direct, whole)

    def times(self, prediction: Predicted, predicted: Array) -> Array:
        """How many times as large an error is beside that of the key.

        The errors of what is read grow as it is misread.
        """
        with np.errstate(all="ignore"):
            misread = abs(predicted / prediction.drawn)
            misread = np.where(np.isfinite(misread), misread, 1.0)
        return np.where(self.form.centres | self.form.senses, 1.0, misread) * prediction.grown

    @cached_property
    def open_senses(self) -> Array:
        """The senses that no drawing determines."""
        items = self.form.items
        open_by_standard = [
            [item.what == "sense" and sense_is_open(each, item.field) for item in items]
            for each in self.variants.standards
        ]
        return np.array(open_by_standard)[self.rows]

    # --- comparing them ---------------------------------------------------------------------------

    @property
    def causes(self) -> tuple[Cause, ...]:
        """All causes, those of the construction first."""
        return self.form.causes

    def explained(self) -> list[SheetCauses | None]:
        """The explanation of each sheet, where values that cannot be drawn are NaN."""
        with np.errstate(all="ignore"):
            return self.compared()

    def compared(self) -> list[SheetCauses | None]:
        """The explanation of each sheet; None where nothing is wrong, or nothing explains it."""
        found: list[SheetCauses | None] = [None] * len(self.rows)
        wrong = np.flatnonzero(self.missed.any(axis=1)).tolist()
        if wrong:
            sheet_causes = self.some(wrong).compared_wrong()
            for i, each in zip(wrong, sheet_causes, strict=True):
                found[i] = each
        return found

    def compared_wrong(self) -> list[SheetCauses | None]:
        """The explanation of each sheet, on each of which something is wrong."""
        count = len(self.rows)
        honest = self.judged(Hypothesis())
        ranked = Ranked(count)
        for cause in self.causes:
            ranked.add(each := Hypothesis((cause,)), self.judged(each))
        for place, own in ranked.best().items():
            if ranked.every[place].made:
                again = self.some(own).judged(ranked.every[place], closely=True)
                ranked.table[place, own] = np.nan_to_num(again, nan=-inf)
        found = [self.chosen(i, ranked.of(i), honest[i]) for i in range(count)]
        more = [i for i, each in enumerate(found) if self.left(i, each) > (each is None)]
        hopeful = (ranked.table > honest).any(axis=0)
        lost = {i for i in more if found[i] is None and self.is_lost(i)}
        pairs = {
            i: ranked.wide_pairs(i) if i in lost else ranked.pairs(i, found[i])
            for i in more
            if i in lost or hopeful[i]
        }
        self.explain_more(pairs, honest, found)
        return found

    def is_lost(self, i: int) -> bool:
        """Whether most numbers of a sheet are wrong."""
        numbers = self.is_read[i] & ~self.form.senses
        return bool((self.missed[i] & numbers).sum() > numbers.sum() / 2)

    def explain_more(
        self,
        which: Mapping[int, Sequence[Hypothesis]],
        honest: Array,
        found: list[SheetCauses | None],
    ) -> None:
        """Replace the explanations of some sheets by those of two causes that are likelier.

        ``which`` holds the pairs by sheet that are tried.
        """
        pairs: dict[tuple[tuple[str, str], ...], tuple[Hypothesis, list[int]]] = {}
        for i, own_pairs in which.items():
            for pair in own_pairs:
                key = pair_key(pair)
                pairs.setdefault(key, (pair, []))[1].append(i)
        tried: dict[int, list[tuple[float, Any]]] = {i: [] for i in which}
        plain = self.judged(Hypothesis(), COARSE)
        for key, (pair, own) in pairs.items():
            for i, each in zip(own, self.some(own).judged(pair, COARSE).tolist(), strict=True):
                if each > plain[i]:
                    tried[i].append((each, key))
            if all(cause.change is not None for cause in pair.causes):
                self.drawings.pop(pair.made, None)
        close: dict[Any, list[int]] = {}
        for i, every in tried.items():
            for _, key in sorted(every, key=lambda entry: -entry[0])[:CLOSE]:
                close.setdefault(key, []).append(i)
        again: dict[int, list[tuple[Hypothesis, float]]] = {}
        for key, own in close.items():
            pair = pairs[key][0]
            likely = self.some(own).judged(pair, closely=True).tolist()
            for i, each in zip(own, likely, strict=True):
                again.setdefault(i, []).append((pair, each))
        for i, candidates in again.items():
            candidates.sort(key=lambda pair: -pair[1])
            each, single = self.chosen(i, candidates, honest[i]), found[i]
            if each is not None and (single is None or self.is_likelier(i, each, single)):
                found[i] = replace(each, single=single)

    def is_likelier(self, i: int, two: SheetCauses, one: SheetCauses) -> bool:
        """Whether two causes explain a sheet clearly better than one.

        Little is needed where only senses are left, and two causes leave none.
        """
        left, more = (self.is_read[i] & ~self.fits(i, each) for each in (one, two))
        only_senses = left.any() and not (left & ~self.form.senses).any() and not more.any()
        return two.odds > one.odds + (SENSES if only_senses else SECOND)

    def left(self, i: int, found: SheetCauses | None) -> int:
        """How many answers of a sheet are not explained; of wrong ones where there is none."""
        if found is None:
            return int((self.missed[i] & self.is_read[i]).sum())
        return int((self.is_read[i] & ~self.fits(i, found)).sum())

    def some(self, which: Sequence[int]) -> AnswerSheets:
        """The sheets of some of the students, with the same cache of drawings."""
        own = list(which)
        part = AnswerSheets(
            self.form, self.rows[own], [self.given[i] for i in own], self.missed[own]
        )
        drawn, read = self.errors
        part.__dict__.update(
            answers=self.answers[own],
            rounded=self.rounded[own],
            is_read=self.is_read[own],
            key=self.key[own],
            errors=(drawn[own], read[own]),
            astray=self.astray[own],
            known=self.known,
            open_senses=self.open_senses[own],
            view=self.view.some(own),
            drawings=self.drawings,
            growths=self.growths,
        )
        return part

    def chosen(
        self, i: int, tried: Sequence[tuple[Hypothesis, float]], honest: float
    ) -> SheetCauses | None:
        """The likeliest explanation of a sheet; None where none is likely enough."""
        if not self.missed[i].any():
            return None
        numbers = self.missed[i] & ~self.form.senses
        for hypothesis, likely in tried:
            if likely - honest < SENSES:
                break
            explanation = self.settled(i, hypothesis, likely - honest)
            found = None if explanation is None else self.judged_enough(i, explanation)
            if found is None:
                continue
            turned = not numbers.any() or self.turns_all(i, found)
            if turned or likely - honest >= LIKELY or self.is_one_drawing(i, found):
                return replace(found, either=self.alternative(i, hypothesis, tried, honest))
        return None

    def is_one_drawing(self, i: int, by: SheetCauses) -> bool:
        """Whether answers are clearly one drawing with a cause, though each is near the key."""
        return by.odds >= FAINT and self.of_one_drawing(i, by) >= AS_ONE

    def alternative(
        self, i: int, best: Hypothesis, tried: Sequence[tuple[Hypothesis, float]], honest: float
    ) -> str:
        """The name of another cause that explains a sheet as well as the one that is named.

        How frequent either is does not count: the answers cannot tell. Empty where there is none.
        """
        if len(best.causes) > 1:
            return ""
        (cause,), sheet = best.causes, self.some([i])
        least = next(likely for each, likely in tried if each is best) - CHOICE
        others = [e for e in tried if e[1] > least and e[0].causes[0].name != cause.name]
        plain = sheet.by_answers(best) if others else 0.0
        for each, likely in others:
            if sheet.by_answers(each) > plain - EVEN:
                explanation = self.settled(i, each, likely - honest)
                if explanation is not None and self.judged_enough(i, explanation) is not None:
                    return each.causes[0].name
        return ""

    def by_answers(self, hypothesis: Hypothesis) -> float:
        """How likely one student's answers are by a hypothesis, however frequent it is."""
        prediction = self.shown(hypothesis, closely=True)
        return -inf if prediction is None else float(self.likely(replace(prediction, price=0.0))[0])

    def turns_all(self, i: int, found: SheetCauses) -> bool:
        """Whether an explanation gives the wrong senses, all there are, and changes no number."""
        agree = np.array([field in found.fits for field in self.variants.fields])
        wrong, senses = self.missed[i] & self.is_read[i], self.form.senses
        every = (wrong & senses).any() and not (self.is_read[i] & senses & ~agree).any()
        values = np.array([found.values[field] for field in self.variants.fields])
        same = np.isclose(abs(values), abs(self.key[i]), rtol=1e-9)
        return bool(every and not (wrong & ~senses & ~same).any())

    def judged_enough(self, i: int, found: SheetCauses) -> SheetCauses | None:
        """An explanation with the answers that agree; None where these are too few."""
        fits, read = self.fits(i, found), self.is_read[i]
        missed = self.missed[i] & read & self.reach(i, found)
        spoilt = (read & ~fits & ~self.beside_wrong(i, found, fits)).sum() > SPOILS * read.sum()
        fitting = [f for f, fit in zip(self.variants.fields, fits, strict=True) if fit]
        agreeing = replace(found, fits=frozenset(fitting))
        enough = EXPLAINS if (missed & ~self.form.senses).any() else 1.0
        near = fits | self.is_mostly(i, found)
        few = (missed & near).sum() < enough * missed.sum()
        if spoilt or (few and not self.turns_all(i, agreeing)):
            return None
        if not self.turns_all(i, agreeing) and not self.is_nearer(i, found):
            return None
        return agreeing

    def reach(self, i: int, by: SheetCauses) -> Array:
        """The fields that an explanation could change: nothing follows from a time ratio."""
        values = np.array([by.values[field] for field in self.variants.fields])
        changed = ~np.isclose(values, self.key[i], rtol=1e-9)
        ratios = self.form.ratios
        return ratios if changed.any() and not (changed & ~ratios).any() else np.ones_like(ratios)

    def is_mostly(self, i: int, by: SheetCauses) -> Array:
        """The numbers that are far from the key and near what an explanation gives.

        One misread length beside a cause leaves such a number.
        """
        sizes = np.array([by.values[field] for field in self.variants.fields])
        with np.errstate(all="ignore"):
            apart, away = (abs(np.log(self.answers[i] / abs(e))) for e in (sizes, self.key[i]))
        return ~(self.form.senses | self.form.centres) & (apart < MOSTLY * away)

    def is_nearer(self, i: int, by: SheetCauses) -> bool:
        """Whether the answers are likelier by an explanation when all are taken as one drawing.

        The errors of one drawing go together: a crank set badly moves all answers.
        """
        one = self.of_one_drawing(i, by)
        return one > ONE_DRAWING and one + by.odds > TOGETHER

    def of_one_drawing(self, i: int, by: SheetCauses) -> float:
        """How much likelier the answers are by an explanation than by the key, as a logarithm.

        The errors of the drawing are correlated as those of the right one.
        """
        form, fields, read = self.form, self.variants.fields, self.is_read[i]
        values, times = (np.array([each[f] for f in fields]) for each in (by.values, by.times))
        senses = read & form.senses & ~self.open_senses[i]
        for_cause = senses & (self.answers[i] == np.sign(values))
        for_key = senses & (self.answers[i] == self.key[i])
        found = (for_cause.sum() - for_key.sum()) * log(1 / MISTAKES)
        keys = Keys.of([self.variants.standards[self.rows[i]].expectation])
        places = np.array([fields.index(field) for field in keys.fields])
        usable = read[places] & keys.known(0) & np.isfinite((values * times)[places])
        own = places[usable]
        if not len(own):
            return float(found)
        key, answers = keys.key(0, usable), self.answers[i][own]
        rounded = self.rounded[i][own] * abs(answers)
        scale = times[own]
        other = Key(
            np.where(key.places, values[own], abs(values[own])),
            key.spread * np.outer(scale, scale),
            key.computed * scale,
            key.cranks * scale,
            key.places,
        )
        left = np.array([fields[place] not in by.alone for place in own.tolist()])
        whatever = -np.log(2 * log(OWN) * abs(answers[~left])).sum()
        by_cause = fit(answers[left], rounded[left], some_of(other, left)).likelihood + whatever
        return float(found + by_cause - fit(answers, rounded, key).likelihood)

    def beside_wrong(self, i: int, by: SheetCauses, fits: Array) -> Array:
        """The answers that only follow from one that an explanation does not give.

        These are values computed from a length, and senses beside a value.
        """
        found = np.zeros(len(fits), dtype=bool)
        if self.known is not None:
            computed, own = self.known
            right = self.computed_rightly(i, np.array([by.values[f] for f in self.variants.fields]))
            found[computed] = right & self.is_read[i][own] & ~fits[own]
        sized = self.form.sized
        beside = self.is_read[i][sized] & ~fits[sized] & (sized >= 0)
        return found | beside

    def computed_rightly(self, i: int, sizes: Array) -> Array:
        """Whether values were computed as an explanation says from the student's own lengths."""
        assert self.known is not None
        answers, rounded = self.answers[i], self.rounded[i]
        computed, own = self.known
        with np.errstate(all="ignore"):
            apart = np.log(abs(answers[computed] / answers[own] * sizes[own] / sizes[computed]))
        near: Array = abs(apart) <= 3 * COMPUTED + rounded[computed] + rounded[own]
        return near

    def settled(
        self, i: int, hypothesis: Hypothesis, odds: float = 0.0, *, closely: bool = True
    ) -> SheetCauses | None:
        """What a student would write by a hypothesis, the likelier of two values in each field.

        None where it cannot be drawn.
        """
        part = self.some([i])
        prediction = part.shown(hypothesis, closely=closely)
        if prediction is None:
            return None
        written = prediction.written
        if prediction.other is not None:
            pencil = np.array([1.4])
            one, two = (
                part.by_field(prediction, each, pencil)[0] for each in (written, prediction.other)
            )
            written = np.where(two > one, prediction.other, written)
        times = part.times(prediction, written)
        fields = self.variants.fields
        values, scaled = (
            dict(zip(fields, each[0].tolist(), strict=True)) for each in (written, times)
        )
        alone = np.broadcast_to(prediction.alone, written.shape)[0]
        free = frozenset(field for field, own in zip(fields, alone, strict=True) if own)
        return SheetCauses(hypothesis.causes, values, scaled, float(odds), alone=free)

    def fits(self, i: int, by: SheetCauses) -> Array:
        """The answers of a student that an explanation gives, within 99 of 100 drawings."""
        answers, form, rounded = self.answers[i], self.form, self.rounded[i]
        values, times = (
            np.array([each[field] for field in self.variants.fields])
            for each in (by.values, by.times)
        )
        with np.errstate(all="ignore"):
            drawn, read = (each[i] for each in self.errors)
            sizes = np.where(form.centres, values, abs(values))
            error = 2.6 * np.hypot(1.4 * drawn, read)
            allowed = np.minimum(error * times, np.maximum(error * SPAN[1], MOST * abs(sizes)))
            allowed = allowed + 2 * COMPUTED * abs(sizes)
            near = abs(answers - sizes) <= allowed + rounded * abs(answers)
            if self.known is not None:
                computed, own = self.known
                near[computed] |= self.computed_rightly(i, sizes) & near[own]
        sense = (answers == np.sign(values)) | (values == 0) | self.open_senses[i]
        return np.where(form.senses, sense, near) & self.is_read[i]


class Ranked:
    """The likeliest hypotheses of each of some students."""

    def __init__(self, count: int) -> None:
        self.every: list[Hypothesis] = []
        self.likely: list[Array] = []
        self.count = count

    def add(self, hypothesis: Hypothesis, likely: Array) -> None:
        """Note how likely a hypothesis is for each student."""
        self.every.append(hypothesis)
        self.likely.append(likely)

    @cached_property
    def table(self) -> Array:
        """A row for each hypothesis."""
        return np.nan_to_num(np.array(self.likely), nan=-inf, neginf=-inf)

    def best(self) -> dict[int, list[int]]:
        """The students by each hypothesis that is among the likeliest of theirs."""
        found: dict[int, list[int]] = {}
        for i in range(self.count):
            for k in np.argsort(-self.table[:, i], kind="stable")[:BEST].tolist():
                found.setdefault(k, []).append(i)
        return found

    def of(self, i: int) -> list[tuple[Hypothesis, float]]:
        """The likeliest hypotheses of a student, in order."""
        column = self.table[:, i]
        order = np.argsort(-column, kind="stable")[:BEST]
        return [(self.every[k], float(column[k])) for k in order]

    def names_of(self, i: int, most: int | None = BEST) -> list[Cause]:
        """The likeliest causes of a student, one of each name, in the order they were noted."""
        best: dict[str, int] = {}
        for k in np.argsort(-self.table[:, i], kind="stable").tolist():
            if self.table[k, i] > -inf and (most is None or len(best) < most):
                best.setdefault(self.every[k].causes[0].name, k)
        return [self.every[k].causes[0] for k in sorted(best.values())]

    def pairs(self, i: int, single: SheetCauses | None) -> list[Hypothesis]:
        """Pairs of the likeliest causes of a student, and of the ``single`` one with all others."""
        found = {pair_key(pair): pair for pair in pairs_of(self.names_of(i))}
        for cause in single.causes if single is not None else ():
            for each in self.names_of(i, None):
                places = sorted((cause, each), key=self.place_of)
                found |= {pair_key(pair): pair for pair in pairs_of(places)}
        return list(found.values())

    def place_of(self, cause: Cause) -> int:
        """The place of a cause in the order in which causes were noted."""
        return next(k for k, each in enumerate(self.every) if each.causes == (cause,))

    def wide_pairs(self, i: int) -> list[Hypothesis]:
        """Pairs of all causes of a student whose sheet no single cause comes near.

        Each cause has its likeliest way, those in reading any way beside one in the construction.
        """
        names = self.names_of(i, None)
        reads = [e.causes[0] for e in self.every if e.causes[0].change is None]
        made = [cause for cause in names if cause.change is not None]
        found = {pair_key(pair): pair for pair in pairs_of(names)}
        for cause in made:
            every = (Hypothesis((cause, each)) for each in reads)
            found |= {pair_key(pair): pair for pair in every}
        return list(found.values())


def some_of(key: Key, which: Array) -> Key:
    """The key of some of the fields."""
    spread = key.spread[np.ix_(which, which)]
    return Key(
        key.sizes[which], spread, key.computed[which], key.cranks[:, which], key.places[which]
    )


def growing(drawn: Array, key: Array) -> Array:
    """How many times as large errors are that grow with what is drawn."""
    with np.errstate(all="ignore"):
        return np.clip(np.nan_to_num(abs(drawn / key), nan=1.0), *SPAN)


def pair_key(pair: Hypothesis) -> tuple[tuple[str, str], ...]:
    """The names and ways of the causes of a pair."""
    return tuple((cause.name, cause.way) for cause in pair.causes)


def pairs_of(causes: Sequence[Cause]) -> Iterator[Hypothesis]:
    """All pairs of different causes that go together, those in the construction first."""
    for one, other in combinations(causes, 2):
        if one.name == other.name and one.reads is not None:
            continue
        pair = Hypothesis((one, other))
        if pair.change is not None:
            yield pair


def explanations(
    standards: Sequence[Standard],
    rows: Sequence[int],
    given: Sequence[Mapping[str, Answer]],
    missed: Sequence[frozenset[str]],
) -> list[SheetCauses | None]:
    """The explanation of each sheet of students whose variants draw alike.

    ``rows`` are the places of their variants among the ``standards``. ``missed`` are the fields
    that are wrong by the key.
    """
    return sheets_of(standards, rows, given, missed).explained()


def sheets_of(
    standards: Sequence[Standard],
    rows: Sequence[int],
    given: Sequence[Mapping[str, Answer]],
    missed: Sequence[frozenset[str]],
) -> AnswerSheets:
    """The sheets of some students as arrays."""
    form = FormFields(Variants(standards))
    fields = form.variants.fields
    wrong = np.array([[field in each for field in fields] for each in missed])
    return AnswerSheets(form, np.array(rows, dtype=int), given, wrong)


class CauseWay(Struct, frozen=True):
    """What a student would write by some causes, and how many times as large the errors are.

    ``share`` says how frequent it is, as a logarithm.
    """

    names: tuple[str, ...]
    values: Mapping[str, float]
    times: Mapping[str, float]
    share: float


def ways_of(
    standard: Standard,
    given: Mapping[str, Answer],
    missed: frozenset[str],
    *,
    two: bool = False,
) -> tuple[CauseWay, ...]:
    """Every way of working with one cause, and with the ``two`` that explain a student's sheet."""
    sheet = sheets_of([standard], [0], [given], [missed])
    single = (Hypothesis((cause,)) for cause in sheet.causes)
    with np.errstate(all="ignore"):
        ways = [(each, sheet.settled(0, each, closely=False)) for each in single]
    (found,) = sheet.explained() if two else (None,)
    if found is not None:
        ways.append((Hypothesis(found.causes), found))
    return tuple(CauseWay(e.names, e.values, e.times, each.share) for each, e in ways if e)


def explained_by(
    standard: Standard,
    given: Mapping[str, Answer],
    missed: frozenset[str],
    cause: Cause,
    others: Array,
    grown: Array,
) -> tuple[int, SheetCauses] | None:
    """The one of some other keys that explains a sheet, with its place; None where none does.

    ``others`` has a row for each key, by the fields of the form, and ``grown`` how many times as
    large the errors of its drawing are.
    """
    count = len(others)
    sheet = sheets_of([standard], [0], [given], [missed])
    every = sheet.some([0] * count)
    prediction = Predicted(others, others, np.clip(grown, *SPREAD))
    likely = every.likely(prediction)
    best = int(likely.argmax())
    odds = float(likely[best] - sheet.judged(Hypothesis())[0] + SHARE - log(count))
    times = every.times(prediction, others)[best]
    fields = sheet.variants.fields
    values, scaled = (dict(zip(fields, e.tolist(), strict=True)) for e in (others[best], times))
    found = sheet.judged_enough(0, SheetCauses((cause,), values, scaled, odds))
    return None if found is None or odds < LIKELY else (best, found)


def explained_by_two(
    standard: Standard,
    given: Mapping[str, Answer],
    missed: frozenset[str],
    cause: Cause,
    others: Sequence[Standard],
    one: SheetCauses | None,
) -> tuple[int, SheetCauses] | None:
    """The one of some other standards that explains a sheet together with a second cause.

    The result is its place and the explanation, ``cause`` first. None where none explains it
    better than ``one``, the explanation by such data alone.
    """
    honest = float(sheets_of([standard], [0], [given], [missed]).judged(Hypothesis())[0])
    found: list[tuple[float, int, AnswerSheets, int, Hypothesis]] = []
    best: tuple[int, SheetCauses] | None = None
    for group in alike(others):
        rows = range(len(group))
        sheet = sheets_of(
            [others[i] for i in group], rows, [given] * len(group), [missed] * len(group)
        )
        for second in sheet.causes:
            each = Hypothesis((second,))
            likely = np.nan_to_num(sheet.judged(each, COARSE), nan=-inf)
            row = int(likely.argmax())
            found.append((float(likely[row]), group[row], sheet, row, each))
    for _, place, sheet, row, each in sorted(found, key=lambda entry: -entry[0])[:CLOSE]:
        likely = float(sheet.some([row]).judged(each, closely=True)[0])
        odds = likely + SHARE - log(len(others)) - honest
        explanation = sheet.settled(row, each, odds)
        explanation = (
            None if explanation is None or odds < LIKELY else sheet.judged_enough(row, explanation)
        )
        if explanation is None or (best is not None and explanation.odds <= best[1].odds):
            continue
        if one is None or sheet.is_likelier(row, explanation, one):
            best = place, replace(explanation, causes=(cause, *explanation.causes), single=one)
    return best
