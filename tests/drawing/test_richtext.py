import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import graphkin.text
from graphkin.drawing.richtext import (
    advance,
    capital,
    extent,
    flowed,
    measures,
    runs,
    spaced_runs,
    words_of,
)
from graphkin.text.errors import PageError


def test_capitals_have_the_height_asked_for():
    assert capital() == pytest.approx(0.66, abs=5e-4)
    assert runs("H", 3.5)[0].size == pytest.approx(5.30, abs=5e-3)
    assert extent("H", 3.5)[1:] == pytest.approx((-3.5, 0.0))


def test_a_subscript_and_a_superscript_stack():
    base, low, high = runs("*a*_{BA}^{ν}", 3.5)
    assert (base.text, low.text, high.text) == ("a", "BA", "ν")
    assert (base.italic, low.italic, high.italic) == (True, False, False)
    assert low.x == high.x > base.x
    assert low.y == pytest.approx(0.24 * base.size)
    assert high.y == pytest.approx(-0.48 * base.size)
    assert low.size == high.size == pytest.approx(0.7 * base.size)


@pytest.mark.parametrize("prime", ["′", "″", "‴"])
def test_an_index_stands_below_the_prime_of_its_letter(prime):
    letter, above, low = runs(f"*b*{prime}_{{3}}", 3.5)
    assert low.x == above.x == pytest.approx(letter.x + extent("*b*", 3.5)[0])
    assert extent(f"*b*{prime}_{{3}}x", 3.5)[0] >= extent(f"*b*{prime}x", 3.5)[0]
    top_of_index, foot_of_prime = (
        low.y + extent("3", 3.5)[1] * 0.7,
        extent(prime, 3.5)[2],
    )
    assert foot_of_prime < top_of_index


def test_what_follows_stacked_scripts_starts_after_the_longer_one():
    _, low, _, after = runs("a_{BA}^{ν}x", 3.5)
    wide = extent("BA", 3.5)[0] * 0.7
    assert after.x == pytest.approx(low.x + wide)


@pytest.mark.parametrize("markup", ["*v", "a_", "a_{b", "a_{b_c}", "a^*b*", "end\\"])
def test_markup_that_does_not_end_is_refused(markup):
    with pytest.raises(PageError, match="markup"):
        runs(markup, 2.5)


def test_blanks_move_what_follows_but_stand_in_no_run():
    found = runs("  Plan  de *v* = 3 ", 2.5)
    assert [run.text for run in found] == ["Plan", "de", "v", "= 3"]
    em, blank = found[0].size, measures(False)[" "][0]
    assert found[0].x == pytest.approx(2 * blank * em)
    assert extent("a b", 2.5)[0] == pytest.approx(extent("a", 2.5)[0] + extent(" b", 2.5)[0])


def test_words_stay_apart_when_searched():
    found = spaced_runs("viteza *v*_A  este", 2.5)
    assert [run.text for run in found] == ["viteza ", "v", "A ", "este"]


def test_a_sign_without_a_glyph_is_refused_by_its_code():
    with pytest.raises(PageError, match=r"U\+6F22"):
        runs("漢", 2.5)


def test_an_exponent_stands_after_a_long_index_and_above_a_short_one():
    """Over the first letters of a word it would be read as theirs."""
    for index, stacked in (("2", True), ("BA", True), ("coupler", False), ("B3A", False)):
        _, low, high = runs(f"*ω*_{{{index}}}^2", 3.5)
        assert (low.text, high.text) == (index, "2")
        assert (high.x == low.x) is stacked
        assert stacked or high.x > low.x + advance(index, False) * low.size * 0.99


def test_the_sign_of_a_component_stands_above_any_index():
    _, low, high = runs("*a*_{B3A}^{ν}", 3.5)
    assert high.x == low.x


def test_lines_do_not_end_between_a_number_and_its_unit_or_before_a_bar():
    markup = "lay off *a* ⊥ *AB*, 12.3 mm, at 4.5 rad/s^2, *k* = 0.1 (m/s)/mm, 3·10^{−3} m"
    markup += ", (0, −250) mm, (2) at"
    assert words_of(markup) == [
        "lay",
        "off",
        "*a*",
        "⊥ *AB*,",
        "12.3 mm,",
        "at",
        "4.5 rad/s^2,",
        "*k* = 0.1 (m/s)/mm,",
        "3·10^{−3} m,",
        "(0,",
        "−250) mm,",
        "(2)",
        "at",
    ]


def test_lines_do_not_end_after_a_sign_of_division_or_in_the_room_to_write_in():
    markup = "*ω* = speed ÷ length; (*k*_L = . . . . m/mm; *k*_v = . . . . (m/s)/mm) in all. in m"
    assert words_of(markup) == [
        "*ω* = speed",
        "÷ length;",
        "(*k*_L = . . . . m/mm;",
        "*k*_v = . . . . (m/s)/mm)",
        "in",
        "all.",
        "in",
        "m",
    ]


def test_lines_do_not_end_between_a_link_a_wheel_or_a_guide_and_its_number():
    markup = "wheel 3 of the link 12 meets gear B; guide of *AB* on links 2 and 3, in 1.5 m"
    assert words_of(markup) == [
        *("wheel 3", "of", "the", "link 12", "meets", "gear B;", "guide", "of", "*AB*", "on"),
        *("links 2", "and", "3,", "in", "1.5 m"),
    ]


STEMS = r"link|wheel|gear|guide|element|roat|roț|ghidaj|membr|ruot|guid"


@pytest.mark.parametrize("language", ["en", "ro", "it"])
def test_every_link_wheel_and_guide_that_the_texts_number_keeps_its_number(language):
    text = (Path(graphkin.text.__file__).parent / f"{language}.toml").read_text("utf-8")
    said = set(re.findall(rf"\b((?:{STEMS})\w*) \{{(?:k|g|link|other)\}}", text))
    assert len(said) >= 4
    for word in said:
        assert words_of(f"x {word} 7 y") == ["x", f"{word} 7", "y"]


PIECES = st.sampled_from(
    ["*v*_{BA}^{ν}", "= 2,5", "m/s^2", "∥ *OA*_1", "x^2", "_2", "a_{ABC}^2", "din *o*′ se ia"]
)


@given(st.lists(PIECES, max_size=14), st.sampled_from([" ", "; "]), st.floats(1, 90))
def test_lines_are_filled_with_whole_pieces_as_far_as_they_go(pieces, mark, width):
    lines = flowed(pieces, mark, width, 2.5)
    left = [piece + mark.rstrip() for piece in pieces[:-1]] + pieces[-1:]
    for line in lines:
        count = next(k for k in range(1, len(left) + 1) if " ".join(left[:k]) == line)
        assert count == 1 or extent(line, 2.5)[0] <= width + 1e-9
        if left[count:]:
            assert extent(f"{line} {left[count]}", 2.5)[0] > width - 1e-9
        left = left[count:]
    assert not left


def test_a_slanted_letter_does_not_run_into_what_stands_above_or_after_it():
    """The ink of a slanted f reaches beyond its width: a prime and an exponent keep clear of it."""
    letter, prime = runs("*f*′", 3.5)
    assert prime.x > letter.x + extent("*f*", 3.5)[0] + 0.1 * letter.size
    above = runs("*f*^{IV}", 3.5)[1]
    assert above.x == pytest.approx(prime.x)
    assert runs("*f*_{A}", 3.5)[1].x == pytest.approx(extent("*f*", 3.5)[0])
    assert runs("*a*′", 3.5)[1].x == pytest.approx(extent("*a*", 3.5)[0])
