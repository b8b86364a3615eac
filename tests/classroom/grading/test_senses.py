"""Senses in words, as students write them in each language, and nothing taken for one that is
none."""

from __future__ import annotations

import re

import pytest

from graphkin.classroom.grading.answer_numbers import read_answer, sense_of
from graphkin.classroom.lab.lab_model import Item
from graphkin.text import LANGUAGES, words

LEFT_ABOUT = """+ | +1 | (+) | ↺ | ccw | CCW | c.c.w. | acw | counter-clockwise | counter clockwise
counterclockwise | anticlockwise | anti-clockwise | in the counter-clockwise sense | positive
trigonometric | Trigonometric | trigonometric (+) | + trig | trig. | sens trigonometric | antiorar
sensul trigonometric | în sens trigonometric | anti-orar | sens antiorar | antiorario | antior.
invers acelor de ceasornic | în sens invers acelor de ceasornic | contrar acelor de ceasornic
invers sensului acelor de ceasornic | contra acelor de ceas | in senso antiorario | levogiro
contrario alle lancette dell'orologio | linksherum | gegen den Uhrzeigersinn
entgegen dem Uhrzeigersinn | antihoraire | sens trigonométrique
sens inverse des aiguilles d’une montre | sentido antihorario
en sentido contrario a las agujas del reloj | против часовой | против часовой стрелки
против хода часовой стрелки | gegen UZS | gegen den UZS | entgegen UZS | gegen d. UZS | GUZS
Gegenuhrzeigersinn | links | linksdrehend | links drehend | linksherum | Linksdrehung
math. positiv | mathematisch positiv | im mathematisch positiven Sinn | math. pos. | math. +
math. positiver Drehsinn | sens anti-horaire | trigo | sens trigo | sens trigonométrique direct
sens direct | contrario a las manecillas del reloj | antihor. | levógiro | contrahorario
antihoraria | antioraria | in senso antior. | против ч.с. | против ЧС | против час. стр.
пр. час. стр. | против стрелки часов | положительное | anti-clock | mathematically positive
sens trigonometric pozitiv | matematic pozitiv | contra acelor ceasului"""
RIGHT_ABOUT = """- | − | – | -1 | ↻ | cw | c.w. | clockwise | negative | orar | or. | orar (−)
- orar | sens orar | în sens orar | sensul orar | acelor de ceasornic
în sensul acelor de ceasornic | invers trigonometric
sens invers trigonometric | antitrigonometric | orario | in senso orario
contrar sensului trigonometric | senso delle lancette dell’orologio | destrogiro
rechtsherum | im Uhrzeigersinn | sens horaire | dans le sens des aiguilles d’une montre
sentido horario | en el sentido de las agujas del reloj | по часовой | по часовой стрелке
по ходу часовой стрелки | UZS | im UZS | mit UZS | in UZS | im UZ-Sinn | U.Z.S. | rechts
rechtsdrehend | rechts drehend | rechts herum | Rechtsdrehung | math. negativ | math. neg.
mathematisch negativ | im mathematisch negativen Drehsinn | Uhrzeigersinn | mit dem Uhrzeigersinn
horaire | sens hor. | antitrigo | anti-trigo | sens indirect | sens rétrograde
en sentido de las manecillas del reloj | dextrógiro | hor. | senso orario | sensul acelor ceasului
по ч.с. | по ЧС | по час. стр. | отрицательное | mathematically negative | matematic negativ"""
ALONG = """+ | forward | along the guide | away | înainte | în sensul ghidajului | după ghidaj
avanti | nel verso della guida | lungo la guida | vorwärts | le long du guide | adelante | вперёд"""
AGAINST = """- | backward | against the guide | towards | înapoi | contra ghidajului | indietro
contra sensului ghidajului | în sens invers ghidajului | contro il verso della guida
gegen die Führung | en arrière | hacia atrás | против направляющей"""
NO_TURNING = """gegen rechts links | mathematisch | math.
left | right | dreapta | left-handed | sus | 0 | ? | 2 | -- | sens | anti | ccww
maybe clockwise | not clockwise | trigonometric orar | counter counter clockwise | - trig
orar (+) | forward | înainte"""
NO_SLIDING = (
    """left | stânga | orar | cw | clockwise | trigonometric | înainte înapoi | forward (−)"""
)
WRITTEN = (
    (LEFT_ABOUT, True, 1),
    (RIGHT_ABOUT, True, -1),
    (ALONG, False, 1),
    (AGAINST, False, -1),
    (NO_TURNING, True, None),
    (NO_SLIDING, False, None),
)
"""Texts, whether they tell a turning, and its sign: counter-clockwise, along the guide is +."""


@pytest.mark.parametrize(("texts", "turning", "sign"), WRITTEN)
def test_a_sense_has_its_sign_in_whatever_words(texts, turning, sign):
    every = texts.replace("\n", " | ").split(" | ")
    assert {text: sense_of(text, turning=turning) for text in every} == dict.fromkeys(every, sign)


def test_the_words_of_the_feedback_may_be_written_on_the_form():
    signs = {"anticlockwise": 1, "clockwise": -1, "forward": 1, "backward": -1}
    for language in LANGUAGES:
        for key, sign in signs.items():
            said = words(language)(f"feedback.{key}")
            assert sense_of(said, turning="clock" in key) == sign, (language, key)


@pytest.mark.parametrize(("key", "turning"), [("turning", True), ("sliding", False)])
def test_every_sense_that_the_desk_offers_is_read(key, turning):
    """Those of two signs are named in the language's own words, and in the order +, then −."""
    for language in LANGUAGES:
        offered = words(language)(f"unread.{key}").partition(":")[2].split("+")
        for text, sign in zip(offered, (1, -1), strict=True):
            own = re.sub(r"^ *(?:or|sau|oppure|oder|ou|u|o|или) |−", "", text).strip(" ,\N{NBSP}")
            read = {said: sense_of(said, turning=turning) for said in own.split(", ")}
            assert read == dict.fromkeys(read, sign), language
            if turning and language != "en":
                assert not {"cw", "ccw"} & read.keys(), language


@pytest.mark.parametrize(
    ("quantity", "text", "value"),
    [("omega", "orar", -1), ("epsilon", "orar", -1), ("slide speed", "avanti", 1)],
)
def test_a_field_is_read_by_what_it_is_the_sense_of(quantity, text, value):
    item = Item("x", "sense", "x", "", quantity, "2")
    assert read_answer(text, item).value == value
