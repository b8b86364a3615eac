"""The signs of quantities by school, listed once: what each means, and who writes it how.

Names inside the program (of steps, fields and marks) keep the usual signs; only what is printed is
written with those of a school.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cached_property
from types import MappingProxyType

from msgspec import Struct

VELOCITY_POLE, ACCELERATION_POLE = "o", "o′"
"""The usual signs of the poles, which are their names in every program."""


class SchoolSigns(Struct, frozen=True, dict=True):
    """How quantities are written: superscripts of components, letters, poles and scale factors.

    An underscore begins an index: k_v, P_a.
    """

    normal: str = "ν"
    tangential: str = "τ"
    coriolis: str = "c"
    sliding: str = "r"
    angular_acceleration: str = "ε"
    velocity_pole: str = VELOCITY_POLE
    acceleration_pole: str = ACCELERATION_POLE
    length_scale: str = "k_L"
    velocity_scale: str = "k_v"
    acceleration_scale: str = "k_a"

    @cached_property
    def components(self) -> Mapping[str, str]:
        """The superscript of each component by its usual one."""
        return self.by_usual("normal", "tangential", "coriolis", "sliding")

    @cached_property
    def letters(self) -> Mapping[str, str]:
        """The letter of the angular acceleration by the usual one."""
        return self.by_usual("angular_acceleration")

    @cached_property
    def poles(self) -> Mapping[str, str]:
        """The signs of poles that differ, by their names."""
        found = self.by_usual("velocity_pole", "acceleration_pole")
        return {name: sign for name, sign in found.items() if name != sign}

    @cached_property
    def scales(self) -> Mapping[str, str]:
        """The markup of each scale factor by its usual index: L, v, a; n of rates, F of forces."""
        found = self.by_usual("length_scale", "velocity_scale", "acceleration_scale")
        others = {f"k_{index}": f"{self.scale_letter}_{index}" for index in "nF"}
        return {name[-1]: sign_markup(sign) for name, sign in (found | others).items()}

    @property
    def scale_letter(self) -> str:
        """The letter of scale factors."""
        return self.velocity_scale.partition("_")[0]

    def by_usual(self, *names: str) -> dict[str, str]:
        """Some of these signs, by the usual ones."""
        return {getattr(USUAL, name): getattr(self, name) for name in names}

    def beside(self, points: tuple[str, ...]) -> SchoolSigns:
        """These signs in a scene with some points: a pole is not written as the image of one.

        A point P has the image p in the velocity plan and p′ in the acceleration plan.
        """
        small = {point.lower() for point in points}
        clear = {
            name: getattr(USUAL, name)
            for name in ("velocity_pole", "acceleration_pole")
            if getattr(self, name).rstrip("′") in small or VELOCITY_POLE in points
        }
        return (
            SchoolSigns(**{each: getattr(self, each) for each in NAMES} | clear) if clear else self
        )

    def in_sentence(self, sentence: str) -> str:
        """A sentence of a text file, which has the usual signs, with these."""
        return re.sub(TOKEN, lambda found: self.tokens.get(found[0], found[0]), sentence)

    @cached_property
    def tokens(self) -> Mapping[str, str]:
        """The markup of signs in sentences, by the usual markup."""
        return {
            **{f"*{usual}*": f"*{sign}*" for usual, sign in self.letters.items()},
            **{f"*k*_{index}": markup for index, markup in self.scales.items()},
            "*k*_{{": f"*{self.scale_letter}*_{{{{",
            **{f"*a*^{{{{{u}}}}}": f"*a*^{{{{{s}}}}}" for u, s in self.components.items()},
            "*o*": sign_markup(self.velocity_pole),
            "*o*′": sign_markup(self.acceleration_pole),
            "a^c": f"a^{{{{{self.coriolis}}}}}" if self.coriolis != "c" else "a^c",
        }


def sign_markup(sign: str) -> str:
    """The markup of a scale factor or a pole: a prime stands upright beside the letter."""
    letter, _, index = sign.partition("_")
    name = f"*{letter.rstrip('′')}*{'′' * letter.count('′')}"
    if not index:
        return name
    return f"{name}_{index}" if len(index) == 1 else f"{name}_{{{index}}}"


USUAL = SchoolSigns()
NAMES = SchoolSigns.__struct_fields__
"""The keys of signs, in the order in which they are listed."""
TOKEN = r"\*ε\*|\*o\*′?|\*k\*_(?:[LvanF]\b|\{\{)|\*a\*\^\{\{.\}\}|\ba\^c\b"
"""A usual sign in a sentence."""
MEANINGS: Mapping[str, str] = MappingProxyType(
    {
        "normal": "normal component of an acceleration, a superscript",
        "tangential": "tangential component, a superscript",
        "coriolis": "Coriolis component, a superscript",
        "sliding": "acceleration along a moving guide, a superscript",
        "angular_acceleration": "angular acceleration",
        "velocity_pole": "pole of the velocity plan",
        "acceleration_pole": "pole of the acceleration plan",
        "length_scale": "scale factor of lengths; an underscore begins an index",
        "velocity_scale": "scale factor of velocities",
        "acceleration_scale": "scale factor of accelerations",
    }
)
"""What each sign means."""


class School(Struct, frozen=True):
    """The signs of a school, and the books that write them so."""

    signs: SchoolSigns
    books: str


SCHOOLS: Mapping[str, School] = MappingProxyType(
    {
        "romanian": School(
            USUAL,
            "N. I. Manolescu, F. Kovacs, A. Orănescu, Teoria mecanismelor și a mașinilor, 1972",
        ),
        "english": School(
            SchoolSigns(normal="n", tangential="t", angular_acceleration="α"),
            "Uicker, Pennock, Shigley, Theory of Machines and Mechanisms (n, t, α); "
            "Khurmi, Gupta, Theory of Machines, chapters 7 and 8 (o, o′)",
        ),
        "italian": School(
            SchoolSigns(normal="n", tangential="t", angular_acceleration="α"),
            "P. L. Magnani, G. Ruggieri, Meccanismi per macchine automatiche, 1986",
        ),
        "german": School(
            SchoolSigns(
                normal="n",
                tangential="t",
                coriolis="cor",
                sliding="rel",
                angular_acceleration="α",
                velocity_pole="P_v",
                acceleration_pole="P_a",
            ),
            "H. Kerle, B. Corves, M. Hüsing, Getriebetechnik",
        ),
        "russian": School(
            SchoolSigns(
                normal="n",
                coriolis="k",
                velocity_pole="p",
                acceleration_pole="π",
                length_scale="μ_l",
                velocity_scale="μ_v",
                acceleration_scale="μ_a",
            ),
            "I. I. Artobolevsky, Theory of Mechanisms and Machines",
        ),
    }
)
"""The sets of signs by name."""
