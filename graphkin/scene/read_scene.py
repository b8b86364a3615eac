"""A scene from its file: every problem in it is found before one error tells them all."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from fractions import Fraction
from typing import Any

from msgspec.structs import replace

from graphkin.scene.check import check_scene
from graphkin.scene.expression import TIME
from graphkin.scene.file_limits import decoded, read_bytes, tables_of
from graphkin.scene.findings import Findings, Table, listed, shown
from graphkin.scene.link_names import read_names
from graphkin.scene.measures import Measures
from graphkin.scene.model import FRAME, Ask, Link, Scene
from graphkin.scene.parameters import read_parameters, set_values
from graphkin.scene.phrases import FRAME_WORD, LONGEST_NAME, is_link_name
from graphkin.scene.placing import read_shape
from graphkin.scene.quantity import LENGTHS, TURNS, Quantity
from graphkin.scene.read_drivers import read_drivers
from graphkin.scene.read_joints import read_profiles, read_slides
from graphkin.scene.requests import read_ask, read_branches, read_languages, read_sheet
from graphkin.scene.wheels import read_drums, read_tracks, read_wheels
from graphkin.text import paths
from graphkin.text.errors import GraphkinError, Mend, Problem, SceneError
from graphkin.text.hooks import service

FORMAT = 1
"""Version of the scene format that is read."""
MOST_LINKS = 500
CHOSEN = {"ask", "branches", "notes", "titles"}
"""The tables that no link hangs on."""
SPELLINGS = {
    **dict.fromkeys(("rpm", "r.p.m.", "rot/min", "1/min", "min^-1", "rev/mn"), "rev/min"),
    **dict.fromkeys(("rad/sec", "radians/s", "1/s", "s^-1"), "rad/s"),
    **dict.fromkeys(("°", "degree", "degrees", "degs", "grade"), "deg"),
    **dict.fromkeys(("radian", "radians", "rads"), "rad"),
    **dict.fromkeys(("millimetre", "millimetres", "millimeter", "millimeters"), "mm"),
    **dict.fromkeys(("centimetre", "centimetres", "centimeter", "centimeters"), "cm"),
    **dict.fromkeys(("metre", "metres", "meter", "meters"), "m"),
    **dict.fromkeys(("inch", "inches", '"'), "in"),
}
"""Other spellings of units, for hints; a unit that is only spelt alike is not meant."""
UNITS = {"length": tuple(LENGTHS), "angle": tuple(TURNS), "speed": ("rev/min", "rad/s")}
NO_SETTINGS: Mapping[str, object] = {}


def read_scene(path: paths.Named, settings: Mapping[str, object] = NO_SETTINGS) -> Scene:
    """The scene in a file, its parameters set; SceneError with every problem found.

    The scene is named after its file, or after its folder when the file is ``scene.toml``.
    """
    name = paths.stem(path)
    if name == "scene":
        name = paths.name_of(paths.folder_of(path)) or name
    return read_text(decoded(read_bytes(path)), name, str(path), settings)


def read_text(
    text: str, name: str, source: str | None = None, settings: Mapping[str, object] = NO_SETTINGS
) -> Scene:
    """The scene in a TOML text, its parameters set; SceneError with every problem found."""
    return read_into(Findings(), text, name, source, settings)


def known_keys(text: str, name: str) -> dict[str, list[str]]:
    """The keys that the reader knows in each table of a text, by the table's place, as far as the
    text can be read: those that are written there and those that might be.
    """
    findings = Findings()
    with suppress(GraphkinError):
        read_into(findings, text, name)
    return findings.known


def read_into(
    findings: Findings,
    text: str,
    name: str,
    source: str | None = None,
    settings: Mapping[str, object] = NO_SETTINGS,
) -> Scene:
    """The scene in a text, its problems noted; SceneError where there are any."""
    top = Table("", tables_of(text), findings)
    if not top.raw:
        found = "nothing but comments" if text.strip("\ufeff \t\r\n") else "the file is empty"
        raise SceneError(Problem("", found, f"a scene, its first line graphkin = {FORMAT}"))
    check_version(top, findings)
    scene = assembled(top, name, source, settings, findings)
    asked = top.table("ask")
    top.finish()
    check_scene(scene, findings)
    scene = replace(scene, ask=read_ask(asked, findings, scene))
    note_structure(scene, findings)
    findings.stop()
    return scene


def note_structure(scene: Scene, findings: Findings) -> None:
    """Beside what is wrong with what is chosen and asked alone, note what is wrong with the links.

    What is asked does not change these, and a branch with a problem is taken out; nothing is said
    of a branch that is missing, for one with a problem may be meant for it.
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


def check_version(top: Table, findings: Findings) -> None:
    """The format is ours; a newer one stops the reading at once."""
    version = top.take("graphkin")
    if version is None:
        found = "the version of the format is missing"
        findings.add("", found, f"the first line graphkin = {FORMAT}")
    elif isinstance(version, bool) or not isinstance(version, int) or version < 1:
        findings.add("", f"graphkin = {shown(version)}", f"graphkin = {FORMAT}")
    elif version > FORMAT:
        found = f"graphkin = {shown(version)}: this scene is written for a newer graphkin"
        raise SceneError(Problem("", found, f"graphkin = {FORMAT}", "update graphkin"))


def assembled(
    top: Table,
    name: str,
    source: str | None,
    settings: Mapping[str, object],
    findings: Findings,
) -> Scene:
    """All parts but what is asked; where one cannot be read, a problem is noted, another put in."""
    units = read_units(top.table("units"), findings)
    parameters = read_parameters(top.table("parameters"), findings)
    values = set_values(parameters, settings, findings)
    time = read_time(top, Measures(findings, units, values), values)
    measures = Measures(findings, units, values)
    module = read_module(top, measures)
    title = top.text("title", name)
    frame = read_link(FRAME, top.table(FRAME_WORD), measures, module)
    frame, links = read_links(top, frame, measures, module)
    drivers = read_drivers(top, measures)
    if any(link.has_wheels for link in (frame, *links.values())):
        from graphkin.scene.keepers import with_keepers

        frame, links = with_keepers(frame, links, drivers, measures)
    return Scene(
        name=name,
        title=title,
        units=units,
        parameters=parameters,
        frame=frame,
        links=links,
        drivers=drivers,
        branches=read_branches(top.table("branches"), findings),
        ask=Ask(),
        sheet=read_sheet(top.table("sheet"), measures),
        time=time,
        titles=read_languages(top.table("titles"), findings),
        names=read_names(top.table("names"), findings),
        notes=read_languages(top.table("notes"), findings),
        values=values,
        source=source,
    )


def read_units(table: Table, findings: Findings) -> dict[str, str]:
    """The units of lengths, angles and turning speeds; each must be written."""
    units = {}
    lost = findings.inside(table.place)
    for key, choices in UNITS.items():
        raw = table.take(key)
        units[key] = raw if isinstance(raw, str) and raw in choices else choices[0]
        if raw is None and not lost:
            findings.add(table.at(key), f"no unit of {key}", listed(choices))
        elif raw is not None and raw != units[key]:
            spelt = str(raw).strip().lower()
            meant = SPELLINGS.get(spelt, spelt)
            hint = Mend(str(raw), meant) if meant in choices else ""
            findings.add(table.at(key), shown(raw), listed(choices), hint)
    table.finish()
    return units


def read_time(top: Table, measures: Measures, values: dict[str, Fraction]) -> Quantity | None:
    """The moment at which laws of time are taken, in seconds; it joins the values as ``t``."""
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
    """The frame, and the moving links by name; what reads touching profiles and cams is loaded for
    these."""
    table = top.table("links")
    if not table.raw and not measures.findings.inside(table.place):
        measures.findings.add("links", "no link", "a table [links.NAME] for each moving link")
    if len(table.raw) > MOST_LINKS:
        found = f"{len(table.raw)} links"
        raise SceneError(Problem("links", found, f"at most {MOST_LINKS}"))
    links: dict[str, Link] = {}
    written: dict[str, Table] = {}
    for name, raw in table.raw.items():
        place = table.at(name)
        if name in (FRAME, FRAME_WORD):
            measures.findings.add(place, "the frame among the links", "[frame]")
        elif not is_link_name(name):
            expected = f"a number, or a letter and letters, digits or _, at most {LONGEST_NAME}"
            measures.findings.add(place, "no name of a link", expected)
        elif not isinstance(raw, dict):
            measures.findings.add(place, shown(raw), "a table with its points")
        else:
            written[name] = Table(place, raw, measures.findings)
            links[name] = read_link(name, written[name], measures, module)
    if any("touches" in each for each in written.values()):
        from graphkin.scene.touching_profiles import normals

        frame = Table(FRAME_WORD, as_table(top.raw.get(FRAME_WORD)), measures.findings)
        for name, lengths in normals(written, frame, links, measures):
            links[name] = read_link(name, lengths, measures, module)
    if any("cam" in each for each in written.values()):
        from graphkin.scene.read_cams import with_cams

        return with_cams(written, fixed, links, measures)
    return fixed, links


def as_table(raw: object) -> dict[str, Any]:
    """A table as it was written; an empty one for anything else."""
    return raw if isinstance(raw, dict) else {}


def read_link(name: str, table: Table, measures: Measures, module: Quantity | None) -> Link:
    """One link: its points and their placings, its guides, wheels, tracks and profiles."""
    points, placings = read_shape(table, measures)
    wheels, profiles = read_wheels(table, measures, module), read_profiles(table, measures)
    if name == FRAME:
        for key in ("slides", "belt", "touches", "cam"):
            if table.take(key) is not None:
                measures.findings.add(table.at(key), "the frame is at rest", "a moving link")
        drums = read_drums(table, measures)
        return Link(FRAME, points, placings, (), wheels, drums, profiles)
    slides = read_slides(table, measures)
    tracks = read_tracks(table, measures)
    return Link(name, points, placings, slides, wheels, tracks, profiles)
