"""A scene from its file; all its problems are found before one error reports them together."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from fractions import Fraction
from typing import get_args

from msgspec.structs import replace

from graphkin import service
from graphkin.scene.check import check_scene
from graphkin.scene.expression import TIME, UnreadableError
from graphkin.scene.file_limits import decoded, read_bytes, tables_of
from graphkin.scene.findings import Findings, Table, listed, nearest, shown
from graphkin.scene.house import PLAIN, RESULTS, House, house_beside
from graphkin.scene.measures import Measures, quantity
from graphkin.scene.model import FRAME, MASS_KEYS, Ask, Driver, DriverKind, Link, Scene
from graphkin.scene.parameters import read_parameters, set_values
from graphkin.scene.phrases import (
    FRAME_WORD,
    LONGEST_NAME,
    is_link_name,
    line_words,
    link_name,
    read_names,
)
from graphkin.scene.placing import read_shape
from graphkin.scene.quantity import FORCES, LENGTHS, TURNS, Quantity, exact
from graphkin.scene.read_joints import read_profiles, read_slides
from graphkin.scene.requests import (
    read_ask,
    read_branches,
    read_languages,
    read_positions,
    read_sheet,
)
from graphkin.scene.wheels import read_drums, read_tracks, read_wheels, sized_by_teeth
from graphkin.text import paths
from graphkin.text.errors import NO_WORDS, FirstLine, GraphkinError, Mend, SceneError, both, message

FORMAT = 1
"""Version of the scene format that is read."""
MOST_LINKS = 500
CHOSEN = {"ask", "branches", "notes", "titles"}
"""The tables on which no link depends."""
SPELLINGS = {
    **dict.fromkeys(("rpm", "r.p.m.", "rot/min", "1/min", "min^-1", "rev/mn"), "rev/min"),
    **dict.fromkeys(("rad/sec", "radians/s", "1/s", "s^-1"), "rad/s"),
    **dict.fromkeys(("°", "degree", "degrees", "degs", "grade"), "deg"),
    **dict.fromkeys(("radian", "radians", "rads"), "rad"),
    **dict.fromkeys(("millimetre", "millimetres", "millimeter", "millimeters"), "mm"),
    **dict.fromkeys(("centimetre", "centimetres", "centimeter", "centimeters"), "cm"),
    **dict.fromkeys(("metre", "metres", "meter", "meters"), "m"),
    **dict.fromkeys(("inch", "inches", '"'), "in"),
    **dict.fromkeys(("foot", "feet", "'"), "ft"),
}
"""Other spellings of units, for hints; a unit that is merely spelt alike is not included."""
UNITS = {"length": tuple(LENGTHS), "angle": tuple(TURNS), "speed": ("rev/min", "rad/s")}
NO_SETTINGS: Mapping[str, object] = {}


def read_scene(
    path: paths.Named, settings: Mapping[str, object] = NO_SETTINGS, house: House | None = None
) -> Scene:
    """The scene in a file with its parameters set. Raises SceneError with all problems found.

    The scene is named after its file, or after its folder when the file is ``scene.toml``. It has
    the conventions of the house.toml beside the file unless others are given.
    """
    name = paths.stem(path)
    if name == "scene":
        name = paths.name_of(paths.folder_of(path)) or name
    house = house_beside(path) if house is None else house
    return read_text(decoded(read_bytes(path)), name, str(path), settings, house)


def read_text(
    text: str,
    name: str,
    source: str | None = None,
    settings: Mapping[str, object] = NO_SETTINGS,
    house: House = PLAIN,
) -> Scene:
    """The scene in a TOML text with its parameters set. Raises SceneError with all problems."""
    return read_into(Findings(), text, name, source, settings, house)


def known_keys(text: str, name: str) -> dict[str, list[str]]:
    """The keys that the reader knows in each table of a text, by the table's place.

    They include keys that are absent. Only tables that can be read are included.
    """
    findings = Findings()
    with suppress(GraphkinError):
        read_into(findings, text, name)
    return {place: [*dict.fromkeys(keys)] for place, keys in findings.known.items()}


def read_into(
    findings: Findings,
    text: str,
    name: str,
    source: str | None = None,
    settings: Mapping[str, object] = NO_SETTINGS,
    house: House = PLAIN,
) -> Scene:
    """The scene in a text, with its problems noted. Raises SceneError if there are any."""
    top = Table("", tables_of(text, findings), findings)
    if not top.raw:
        found = (
            message("nothing but comments")
            if text.strip("\ufeff \t\r\n")
            else message("the file is empty")
        )
        raise SceneError.at(
            "", found, message("a scene, its first line graphkin = {format}", format=FORMAT)
        )
    check_version(top, findings)
    scene = assembled(top, name, source, settings, findings, house)
    asked = top.table("ask")
    if has_forces(top, asked):
        from graphkin.scene.read_forces import read_forces

        measures = Measures(findings, scene.units, scene.values)
        forces = read_forces(top, asked, scene, measures)
        scene = replace(scene, forces=forces)
    top.finish()
    check_scene(scene, findings)
    scene = replace(scene, ask=read_ask(asked, scene))
    note_structure(scene, findings)
    findings.stop()
    return scene


def note_structure(scene: Scene, findings: Findings) -> None:
    """Note problems of the links too, where only the branches or requests have problems.

    Requests do not change the links, and a branch with a problem is left out. A missing branch is
    not reported then, because the branch with a problem may be meant for it.
    """
    tables = {problem.place.partition(".")[0] for problem in findings.problems}
    if not findings.problems or not tables <= CHOSEN:
        return
    wrong = {name for name in scene.branches if findings.inside(f"branches.{name}")}
    left = {name: branch for name, branch in scene.branches.items() if name not in wrong}
    for problem in service("wrong_with_structure")(replace(scene, branches=left)):
        table, _, name = problem.place.partition(".")
        if "branches" not in tables or table != "branches" or name in left:
            findings.extend([problem])


def has_forces(top: Table, asked: Table) -> bool:
    """Whether a file says anything of forces, the readers of which are imported only then."""
    keys = [top.take(key) for key in ("gravity", "loads", "springs")]
    keys += [asked.take(key) for key in ("reactions", "balance")]
    links = top.raw.get("links")
    written = [top.raw.get(FRAME_WORD), *(links.values() if isinstance(links, dict) else ())]
    masses = (key in each for each in written if isinstance(each, dict) for key in MASS_KEYS)
    return any(key is not None for key in keys) or any(masses)


def check_version(top: Table, findings: Findings) -> None:
    """Check the format version; a newer version stops the reading at once."""
    version = top.take("graphkin")
    if version is None:
        found = message("the version of the format is missing")
        line = FirstLine(f"graphkin = {FORMAT}")
        findings.add(
            "", found, message("the first line graphkin = {format}", format=FORMAT), changes=(line,)
        )
    elif isinstance(version, bool) or not isinstance(version, int) or version < 1:
        findings.add(
            "",
            message("graphkin = {version}", version=shown(version)),
            message("graphkin = {version}", version=FORMAT),
        )
    elif version > FORMAT:
        found = message(
            "graphkin = {version}: this scene is written for a newer graphkin",
            version=shown(version),
        )
        raise SceneError.at(
            "", found, message("graphkin = {version}", version=FORMAT), message("update graphkin")
        )


def assembled(
    top: Table,
    name: str,
    source: str | None,
    settings: Mapping[str, object],
    findings: Findings,
    house: House,
) -> Scene:
    """The scene without its requests; an unreadable part is noted and replaced by a default."""
    units, results = read_units(top.table("units"), findings, house)
    parameters = read_parameters(top.table("parameters"), findings)
    values = set_values(parameters, settings, findings)
    time = read_time(top, Measures(findings, units, values), values)
    measures = Measures(findings, units, values)
    module = read_module(top, measures)
    title = top.text("title", name)
    frame = read_link(FRAME, top.table(FRAME_WORD), measures, module)
    frame, links = read_links(top, frame, measures, module)
    drivers = read_drivers(top, links, measures)
    if any(link.has_wheels for link in (frame, *links.values())):
        from graphkin.scene.keepers import with_keepers

        every = sized_by_teeth({FRAME: frame, **links}, measures)
        frame, links = with_keepers(every.pop(FRAME), every, drivers, measures)
    sheet = read_sheet(top.table("sheet"), measures, house)
    points = tuple(point for link in (frame, *links.values()) for point in link.points)
    return Scene(
        name=name,
        title=title,
        units=units,
        parameters=parameters,
        frame=frame,
        links=links,
        drivers=drivers,
        branches=read_branches(top.table("branches"), frame, links),
        ask=Ask(),
        sheet=replace(sheet, signs=sheet.signs.beside(points)),
        positions=read_positions(top.table("positions"), drivers, measures),
        time=time,
        titles=read_languages(top.table("titles")),
        names=read_names(top.table("names")),
        notes=read_languages(top.table("notes")),
        values=values,
        source=source,
        house=house,
        results=results,
    )


def read_units(table: Table, findings: Findings, house: House) -> tuple[dict[str, str], str]:
    """The units of lengths, angles and turning speeds, each of which must be written.

    The unit of results is the house's where none is stated, and "" for the usual one.
    """
    units = {}
    lost = findings.inside(table.place)
    for key, choices in UNITS.items():
        raw = table.take(key)
        units[key] = raw if isinstance(raw, str) and raw in choices else choices[0]
        if raw is None and not lost:
            table.wrong(key, message("no unit of {key}", key=key), listed(choices))
        elif raw is not None and raw != units[key]:
            spelt = str(raw).strip().lower()
            meant = SPELLINGS.get(spelt, spelt)
            hint = Mend(str(raw), meant) if meant in choices else NO_WORDS
            table.wrong(key, shown(raw), listed(choices), hint)
    if "force" in table:
        units["force"] = table.choice("force", tuple(FORCES), "N")
    else:
        table.known.append("force")
    stated = "results" in table
    results = table.choice("results", RESULTS, RESULTS[0])
    table.finish()
    return units, results if stated else house.results


def read_time(top: Table, measures: Measures, values: dict[str, Fraction]) -> Quantity | None:
    """The time in seconds at which laws of time are evaluated; it joins the values as ``t``."""
    raw = top.take("time")
    if raw is None:
        return None
    time = measures.number("time", raw, "s")
    values[TIME] = Fraction(time.number(values))
    return time


def read_module(top: Table, measures: Measures) -> Quantity | None:
    """The module of all wheels given by teeth."""
    raw = top.take("module")
    return None if raw is None else measures.length("module", raw, positive=True)


def read_links(
    top: Table, fixed: Link, measures: Measures, module: Quantity | None
) -> tuple[Link, dict[str, Link]]:
    """The frame, and the moving links by name.

    The readers of touching profiles and of cams are imported only where a link needs them.
    """
    table = top.table("links")
    if not table.raw and not measures.findings.inside(table.place):
        measures.findings.add(
            "links", message("no link"), message("a table [links.NAME] for each moving link")
        )
    if len(table.raw) > MOST_LINKS:
        found = message("{count} links", count=len(table.raw))
        raise SceneError.at("links", found, message("at most {most}", most=MOST_LINKS))
    links: dict[str, Link] = {}
    written: dict[str, Table] = {}
    for name, raw in table.raw.items():
        place = table.at(name)
        if name in (FRAME, FRAME_WORD):
            measures.findings.add(place, message("the frame among the links"), message("[frame]"))
        elif not is_link_name(name):
            expected = message(
                "a number, or a letter and letters, digits or _, at most {most}", most=LONGEST_NAME
            )
            measures.findings.add(place, message("no name of a link"), expected)
        elif not isinstance(raw, dict):
            measures.findings.add(place, shown(raw), message("a table with its points"))
        else:
            written[name] = Table(place, raw, measures.findings)
            links[name] = read_link(name, written[name], measures, module)
    if any("touches" in each for each in written.values()):
        from graphkin.scene.read_joints import normals

        raw = top.raw.get(FRAME_WORD)
        frame = Table(FRAME_WORD, raw if isinstance(raw, dict) else {}, measures.findings)
        for name, lengths in normals(written, frame, links, measures):
            links[name] = read_link(name, lengths, measures, module)
    if any("cam" in each for each in written.values()):
        from graphkin.scene.read_cams import with_cams

        return with_cams(written, fixed, links, measures)
    return fixed, links


def read_link(name: str, table: Table, measures: Measures, module: Quantity | None) -> Link:
    """One link: its points and their placings, guides, wheels, tracks and profiles."""
    points, placings = read_shape(table, measures)
    wheels, profiles = read_wheels(table, measures, module), read_profiles(table, measures)
    if name == FRAME:
        for key in ("slides", "belt", "touches", "cam"):
            if table.take(key) is not None:
                table.wrong(key, message("the frame is at rest"), message("a moving link"))
        drums = read_drums(table, measures)
        return Link(FRAME, points, placings, (), wheels, drums, profiles)
    slides = read_slides(table, measures)
    tracks = read_tracks(table, measures)
    return Link(name, points, placings, slides, wheels, tracks, profiles)


MOST = 50
DERIVED = message(
    "speed and acceleration are the derivatives of a law, which must be finite at its time"
)
KINDS: tuple[DriverKind, ...] = get_args(DriverKind)


def read_drivers(top: Table, links: Mapping[str, Link], measures: Measures) -> tuple[Driver, ...]:
    """The drivers of a scene, from ``[[drivers]]``."""
    raw = top.take("drivers")
    if raw is None or raw == []:
        measures.findings.add(
            "drivers", message("no driver"), message("[[drivers]] with turn = LINK, angle, speed")
        )
        return ()
    if not isinstance(raw, list) or len(raw) > MOST:
        measures.findings.add(
            "drivers",
            shown(raw),
            message("[[drivers]] in double brackets, at most {most}", most=MOST),
        )
        return ()
    drivers = []
    for index, each in enumerate(raw):
        place = f"drivers[{index}]"
        if isinstance(each, dict):
            driver = read_driver(Table(place, each, measures.findings), links, measures)
            drivers += [driver] if driver else []
        else:
            measures.findings.add(place, shown(each), message("a table with turn, angle and speed"))
    return tuple(drivers)


def read_driver(table: Table, links: Mapping[str, Link], measures: Measures) -> Driver | None:
    """One driver; None, with a problem noted, when it does not name exactly one motion."""
    kinds = [kind for kind in KINDS if kind in table]
    if len(kinds) != 1:
        found = both(kinds) or message("nothing driven")
        expected = message("one of {names}", names=", ".join(f"{kind} = LINK" for kind in KINDS))
        hints = [hint for key in table.raw if (hint := nearest(key, KINDS))]
        measures.findings.add(
            table.place, found, expected, NO_WORDS if kinds or not hints else hints[0]
        )
        return None
    kind = kinds[0]
    link = link_name(table.at(kind), table.take(kind), measures.findings)
    against = read_against(table, kind, links.get(link or ""), measures)
    raw = table.take("of") if kind == "turn" else None
    of = None if raw is None else line_words(table.at("of"), raw, measures.findings)
    position, speed, acceleration = read_motion(table, kind, measures)
    table.finish()
    return Driver(kind, link, against, position, speed, acceleration, of) if link else None


def read_against(table: Table, kind: str, link: Link | None, measures: Measures) -> str:
    """The link against which a motion is measured.

    Where none is written it is the one link on which a driven block slides, else the frame.
    """
    raw = table.take("against")
    if raw is None:
        guides = {slide.on for slide in link.slides} if kind == "slide" and link else set()
        return guides.pop() if len(guides) == 1 else FRAME
    return link_name(table.at("against"), raw, measures.findings) or FRAME


def read_motion(
    table: Table, kind: DriverKind, measures: Measures
) -> tuple[Quantity, Quantity, Quantity]:
    """Position, speed and acceleration: three numbers, or one law in ``t`` and its derivatives."""
    key, unit = ("angle", measures.units["angle"])
    speed, acceleration = measures.units["speed"], "rad/s²"
    if kind != "turn":
        key, unit = "position", measures.units["length"]
        speed, acceleration = f"{unit}/s", f"{unit}/s²"
    law = table.raw.get(key)
    position = read_position(table, key, unit, measures)
    if TIME in position.uses():
        return derivatives(table, position, measures)
    if is_law(law):
        refuse_beside_law(table, measures)
        return position, exact(0), exact(0)
    raw = table.take("speed")
    if raw is None and not measures.findings.inside(position.place):
        measures.findings.add(
            table.place,
            message("no speed"),
            message("speed = … in {speed}, 0 if it is at rest", speed=speed),
        )
    rate = measures.number(table.at("speed"), 0 if raw is None else raw, speed)
    raw = table.take("acceleration")
    return (
        position,
        rate,
        measures.number(table.at("acceleration"), 0 if raw is None else raw, acceleration),
    )


def read_position(table: Table, key: str, unit: str, measures: Measures) -> Quantity:
    """The angle of a turning driver, or the coordinate along a guide or a track."""
    raw = table.take(key)
    other = "position" if key == "angle" else "angle"
    if raw is None and other in table:
        table.take(other)
        table.wrong(
            other,
            message("this driver has no {other}", other=other),
            message("{key} = … in {unit}", key=key, unit=unit),
        )
    elif raw is None:
        measures.findings.add(
            table.place,
            message("no {key}", key=key),
            message("{key} = … in {unit}", key=key, unit=unit),
        )
    return measures.number(table.at(key), 0 if raw is None else raw, unit, law=True)


def derivatives(
    table: Table, position: Quantity, measures: Measures
) -> tuple[Quantity, Quantity, Quantity]:
    """A law of time with its first and second derivatives."""
    refuse_beside_law(table, measures)
    try:
        speed = position.derivative(TIME)
        acceleration = speed.derivative(TIME)
    except SceneError as error:
        measures.findings.extend(error.problems)
        return position, exact(0), exact(0)
    if measures.exists(speed, hint=DERIVED):
        measures.exists(acceleration, hint=DERIVED)
    return position, speed, acceleration


def is_law(raw: object) -> bool:
    """Whether a text is an expression in the time, even if the scene gives no time."""
    try:
        return TIME in quantity(raw, "", "").uses()
    except UnreadableError:
        return False


def refuse_beside_law(table: Table, measures: Measures) -> None:
    """Note a speed or an acceleration written next to a law of time."""
    for key in ("speed", "acceleration"):
        if table.take(key) is not None:
            found = message("{key} beside a law of time", key=key)
            table.wrong(key, found, message("none: it is the derivative of the law"))
