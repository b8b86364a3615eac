"""Choices and requests: branches of assembly, results, the sheet, its titles and notes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from datetime import date, datetime
from fractions import Fraction
from itertools import combinations
from typing import Literal

from graphkin.scene.expression import TIME
from graphkin.scene.findings import Findings, Table, nearest, numbered, plain_text, shown
from graphkin.scene.house import FRAMES, PAPERS, House, read_signs
from graphkin.scene.link_points import ends_of
from graphkin.scene.measures import Measures
from graphkin.scene.model import (
    FRAME,
    HALVED,
    POINTS_ASKED,
    Ask,
    Branch,
    Driver,
    Link,
    Scene,
    Sheet,
    StatedPositions,
)
from graphkin.scene.phrases import (
    CLOSURE,
    SIDES,
    THE_MECHANISM,
    WAYS,
    asked_point,
    branch_words,
    known_link,
    known_point,
    link_name,
    phrase_hint,
    point_name,
)
from graphkin.scene.quantity import Quantity, exact
from graphkin.text import IMPERIAL, LANGUAGES
from graphkin.text.errors import Hint, Message, Written, either, joined, message
from graphkin.text.school_signs import SCHOOLS

OF_LINKS = ("curves",)
"""The keys of [ask] that list points of links, not points such as A@3."""
CENTRES_ASKED, PAIRS = "centres", "pairs"
"""The key that may also hold pairs of links, and where the scene keeps these."""
ALL = "all"
"""Requests the relative centres of all links."""
BRANCH_WORDS = message('"left of P-Q", "right of P-Q", "forward", "backward" or "closure 1"')
SIDES_OF_PIN = message('"left of P-Q" or "right of P-Q"')
ANY_LINK = tuple(map(Written, ('"forward"', '"backward"', '"closure 1"')))
"""The branches that need no names."""
WAYS_OF_LINK = joined(", ", (each.value for each in ANY_LINK))
KLEIN = "klein"
METHODS = ("triangles", KLEIN)
"""How the components of accelerations are obtained."""
PLANS = ("images", "kutzbach")
RULES = ("largest", "lab")
"""How the sizes of plans are chosen."""
FEWEST_STEPS, MOST_STEPS, USUAL_STEPS = 4, 48, 12
"""The least, the largest and the usual number of positions."""
POLES = ("own", "one")
"""Whether each plan of a position has its own pole, or all have one."""
MOST = 500


def read_branches(table: Table, frame: Link, links: Mapping[str, Link]) -> dict[str, Branch]:
    """The chosen branches, by the name of a pin or a link."""
    branches: dict[str, Branch] = {}
    for key, raw in table.raw.items():
        branch = branch_words(raw) if isinstance(raw, str) else None
        name = link_name(table.at(key), key, table.findings)
        if branch is None:
            table.wrong(key, shown(raw), *wanted(key, raw, frame, links))
        elif name == FRAME:
            table.wrong(
                key, message("a branch of the frame, which is at rest"), message("a pin or a link")
            )
        elif name is not None:
            branches[name] = branch
    return branches


def wanted(
    name: str, raw: object, frame: Link, links: Mapping[str, Link]
) -> tuple[Message, Hint, tuple[Written, ...]]:
    """The branches that a name may have, a hint, and replacements for a wrong branch.

    A link has a way or a closure; a pin has a side, which needs the names of other points.
    """
    if name in links:
        return WAYS_OF_LINK, phrase_hint(raw, (*WAYS, CLOSURE)), ANY_LINK
    if any(name in link.points for link in (frame, *links.values())):
        expected, hint = sides(name, links)
        return expected, phrase_hint(raw, SIDES) or hint, ()
    return BRANCH_WORDS, phrase_hint(raw, (*SIDES, *WAYS, CLOSURE)), ()


def sides(name: str, links: Mapping[str, Link], branch: object = "") -> tuple[Message, Message]:
    """The branches that a pin may have, and a hint; a block's pin is written under the block."""
    blocks = [link.name for link in links.values() if link.slides and name in link.points]
    if not blocks:
        return SIDES_OF_PIN, message(
            "P and Q are the outer pins of the two links that {name} joins", name=name
        )
    ways = [str(branch)] if branch else WAYS
    expected = either(f'{block} = "{way}"' for block in blocks for way in ways)
    return expected, message("a block's branch is written under the link's name")


def read_ask(table: Table, scene: Scene) -> Ask:
    """The requested results of a scene; each key holds a list of its points or links."""
    keys = (key for key in Ask.__struct_fields__ if key not in (CENTRES_ASKED, PAIRS))
    names = {key: names_asked(table, key, scene) for key in keys}
    centres, pairs = centres_asked(table, scene)
    table.finish()
    return Ask(**names, centres=centres, pairs=pairs)


def names_asked(table: Table, key: str, scene: Scene) -> tuple[str, ...]:
    """The names in one list, without repetition."""
    every = items(table, key)
    found = (name_asked(place, key, raw, table.findings, scene) for place, raw in every)
    return tuple(dict.fromkeys(name for name in found if name is not None))


def name_asked(place: str, key: str, raw: object, findings: Findings, scene: Scene) -> str | None:
    """The name of a point or a link; None, with a problem noted, if it cannot be requested."""
    if key not in POINTS_ASKED:
        name = moving_link(place, raw, findings)
        link = None if name is None else known_link(scene, name, place, findings)
        if key == "slides" and link is not None and not link.slides:
            findings.add(
                place,
                message("link {name} does not slide", name=name),
                message("a link with slides"),
            )
        return name if link is not None else None
    name = (point_name if key in OF_LINKS else asked_point)(place, raw, findings)
    point, of = ends_of(name or "")
    if name is None or not known_point(point, scene.points, THE_MECHANISM, place, findings):
        return None
    if key == "jerk" and point in scene.cam_centres:
        found = message("{point} is the centre of curvature of a cam", point=point)
        findings.add(place, found, message("a point of a link"))
        return None
    return None if of and known_link(scene, of, place, findings) is None else name


def items(table: Table, key: str) -> Iterator[tuple[str, object]]:
    """Each item of a list with its place; a problem is noted when the value is no list."""
    raw = table.take(key)
    if isinstance(raw, list) and len(raw) <= MOST:
        yield from ((f"{table.at(key)}[{index}]", each) for index, each in enumerate(raw))
    elif raw is not None:
        what = '["A", "B"]' if key in POINTS_ASKED else "[2, 3]"
        table.wrong(key, shown(raw), message("a list, such as {what}", what=what))


def moving_link(place: str, raw: object, findings: Findings) -> str | None:
    """The name of a moving link; None for the frame, which is at rest."""
    name = link_name(place, raw, findings)
    if name == FRAME:
        findings.add(place, message("the frame, which is at rest"), message("a moving link"))
        return None
    return name


def centres_asked(table: Table, scene: Scene) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The links and the pairs of links whose centres are requested: 2, "2-4", or "all" pairs."""
    if table.raw.get(CENTRES_ASKED) == ALL:
        table.take(CENTRES_ASKED)
        return (), tuple(all_pairs(scene))
    centres: list[str] = []
    pairs: list[str] = []
    for place, raw in items(table, CENTRES_ASKED):
        if raw == ALL:
            pairs += all_pairs(scene)
        elif isinstance(raw, str) and "-" in raw:
            pairs += link_pair(place, raw, table.findings, scene)
        elif name := name_asked(place, CENTRES_ASKED, raw, table.findings, scene):
            centres.append(name)
    return tuple(dict.fromkeys(centres)), tuple(dict.fromkeys(pairs))


def all_pairs(scene: Scene) -> Iterator[str]:
    """Every pair of links, in the order of the scene with the frame first."""
    return ("-".join(pair) for pair in combinations((FRAME, *scene.links), 2))


def link_pair(place: str, raw: str, findings: Findings, scene: Scene) -> list[str]:
    """A pair of links written with a dash, in the order of the scene; [] with a problem noted."""
    first, _, second = raw.replace(" ", "").partition("-")
    names = [name for each in (first, second) if (name := link_name(place, each, findings))]
    if len(names) < 2:
        return []
    if names[0] == names[1]:
        findings.add(
            place,
            message("{raw} is one link twice", raw=shown(raw)),
            message('two links, such as "2-4"'),
        )
        return []
    if None in [known_link(scene, name, place, findings) for name in names]:
        return []
    return ["-".join(sorted(names, key=(FRAME, *scene.links).index))]


def read_sheet(table: Table, measures: Measures, house: House) -> Sheet:
    """The sheet: the title block, the language, the scales and the number of sheets.

    What a scene does not state is that of the house.
    """
    rule, ka = table.choice("rule", RULES, RULES[0]), table.take("ka")
    sheets = table.take("sheets")
    if sheets is not None and (isinstance(sheets, bool) or sheets not in (1, 2)):
        table.wrong("sheets", shown(sheets), message("1 or 2"))
        sheets = None
    signs = read_signs(table, "signs", house.signs)
    usual = house.frame or ("GOST" if signs == SCHOOLS["russian"].signs else FRAMES[0])
    sheet = Sheet(
        owner=table.text("owner", "\n".join(house.header)),
        author=table.text("author", house.author),
        approved=table.text("approved", house.approved),
        date=lenient_text(table, "date"),
        number=lenient_text(table, "number"),
        language=table.choice("language", LANGUAGES, house.language),
        scale=read_scale(table, measures),
        sheets=2 if not isinstance(sheets, int) else sheets,
        rule=rule,
        enlarge=read_enlarge(table, measures, rule),
        ka=None if ka is None else measures.number(table.at("ka"), ka, positive=True),
        method=table.choice("method", METHODS, METHODS[0]),
        plan=table.choice("plan", PLANS, PLANS[0]),
        signs=signs,
        steps=house.steps or (HALVED if measures.units["length"] in IMPERIAL else ()),
        paper=table.choice("paper", tuple(PAPERS), house.paper),
        frame=table.choice("frame", FRAMES, usual),
    )
    table.finish()
    return sheet


def read_positions(
    table: Table, drivers: tuple[Driver, ...], measures: Measures
) -> StatedPositions:
    """The positions that a sheet of the whole motion shows."""
    count = read_count(table, measures)
    numbers = 0, MOST_STEPS
    strong = whole_number(table, table.at("strong"), table.take("strong"), *numbers)
    one_pole = table.choice("poles", POLES, POLES[0]) == POLES[1]
    raw = table.take("accelerations")
    accelerations: tuple[int, ...] | None = None
    if isinstance(raw, list) and len(raw) <= MOST:
        some = (
            whole_number(table, f"{table.at('accelerations')}[{i}]", each, *numbers)
            for i, each in enumerate(raw)
        )
        accelerations = tuple(sorted({each for each in some if each is not None}))
    elif raw is not None and raw != ALL:
        expected = message('numbers of positions, such as [0, 3], or "all"')
        table.wrong("accelerations", shown(raw), expected)
    start = read_start(table, drivers, measures)
    table.finish()
    return StatedPositions(count, start, strong, one_pole, accelerations)


def read_count(table: Table, measures: Measures) -> int | Quantity:
    """The number of positions: a whole number, or an expression in parameters that gives one."""
    raw, place = table.take("count"), table.at("count")
    if isinstance(raw, str):
        return measures.number(place, raw, "")
    return whole_number(table, place, raw, FEWEST_STEPS, MOST_STEPS) or USUAL_STEPS


def whole_number(table: Table, place: str, raw: object, least: int, most: int) -> int | None:
    """A whole number between two others; None, with a problem noted, for anything else."""
    if raw is None:
        return None
    if isinstance(raw, int) and not isinstance(raw, bool) and least <= raw <= most:
        return raw
    expected = message("a whole number from {least} to {most}", least=least, most=most)
    table.findings.add(place, shown(raw), expected)
    return None


def read_start(
    table: Table, drivers: tuple[Driver, ...], measures: Measures
) -> Literal["scene", "dead"] | Quantity:
    """The place from which positions are counted: a word, or a position of the driver."""
    raw, place = table.take("start"), table.at("start")
    if raw is None or raw == "scene":
        return "scene"
    if raw == "dead":
        return "dead"
    if isinstance(raw, str) and (hint := nearest(raw, ("scene", "dead"))):
        expected = message('"scene", "dead", or a position of the driver')
        table.findings.add(place, shown(raw), expected, hint)
        return "scene"
    unit = "s"
    if len(drivers) == 1 and TIME not in drivers[0].position.uses():
        unit = measures.units["angle" if drivers[0].kind == "turn" else "length"]
    return measures.number(place, raw, unit)


def lenient_text(table: Table, key: str) -> str:
    """A text that may also be written as a TOML date or a whole number."""
    raw = table.take(key)
    if isinstance(raw, date | datetime):
        return raw.isoformat()
    if isinstance(raw, int) and not isinstance(raw, bool):
        return shown(raw)
    return "" if raw is None else plain_text(table.at(key), raw, table.findings)


def read_scale(table: Table, measures: Measures) -> Quantity | None:
    """The scale kL, real length over drawn length: 5 or ``"1:5"``; None to fit the page."""
    raw, place = table.take("scale"), table.at("scale")
    if raw is None:
        return None
    parts = raw.split(":") if isinstance(raw, str) else []
    if len(parts) == 2 and all(part.strip().isdecimal() and len(part) < 9 for part in parts):
        drawn, true = int(parts[0]), int(parts[1])
        if drawn and true:
            return Quantity(str(raw), exact(Fraction(true, drawn)).tree, "", place)
    return measures.number(place, raw, positive=True)


def read_enlarge(table: Table, measures: Measures, rule: str) -> tuple[Quantity, ...]:
    """The enlargement of vectors against the crank's length: 2 for both plans, or ``[2, 3]``."""
    raw, place = table.take("enlarge"), table.at("enlarge")
    if raw is None:
        return ()
    if rule != RULES[0]:
        hint = message('leave out enlarge, or rule = "lab"')
        measures.findings.add(
            place,
            message('is written beside rule = "lab", which says 1'),
            message("one of the two"),
            hint,
        )
    pair = raw if isinstance(raw, list) else [raw]
    if len(pair) not in (1, 2):
        measures.findings.add(
            place, shown(raw), message("a number, or one for each of the two plans")
        )
        return ()
    found = [
        measures.number(numbered(place, index, len(pair)), each, positive=True)
        for index, each in enumerate(pair)
    ]
    return tuple(each for each in found if each is not None)


def read_languages(table: Table) -> dict[str, str]:
    """A text per language: ``ro = "…"``, ``en = "…"``."""
    texts = {language: table.text(language) for language in LANGUAGES if language in table}
    table.known.extend(LANGUAGES)
    table.finish()
    return texts
