"""The parts of the manual that the program writes: commands, Python, fields, causes, gallery.

A page holds such a part between ``<!-- made: NAME -->`` and ``<!-- end -->``.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterator, Mapping
from functools import cache, partial
from html import escape
from importlib import import_module
from pathlib import Path
from typing import Any

import click

from graphkin.classroom.lab.new_lab import causes, kinds
from graphkin.cli.main import app
from graphkin.diagnosis.effects import effects
from graphkin.documents.sheet_documents import drawn_of, hand_out, language_of
from graphkin.drawing.marks import Page
from graphkin.drawing.richtext import font_face
from graphkin.drawing.style import Ink
from graphkin.mechanism import Mechanism, load
from graphkin.scene import scene_files
from graphkin.scene.house import HEADINGS, HOUSE_KEYS, house_of
from graphkin.scene.read_scene import read_scene
from graphkin.studio.panels import MECHANISM, Memory, edges_of, panels
from graphkin.text.school_signs import NAMES, SCHOOLS
from graphkin.writers.svg import LETTERING, element, rules
from tests.manual.kinds import EVERYWHERE, KINDS

ROOT = Path(__file__).resolve().parents[2]
MANUAL = ROOT / "graphkin" / "manual"
PICTURES = MANUAL / "pictures"
PART = re.compile(r"(<!-- made: (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)
INK: Ink = "colour"
PUBLIC = {
    "Load and solve": ("graphkin.mechanism:load", "graphkin.mechanism:Mechanism"),
    "Results": tuple(
        f"graphkin.construction.core.solution:{name}"
        for name in ("Solution", "PointMotion", "LinkMotion", "SlideMotion", "Verdict")
    ),
    "A whole motion": ("graphkin.motion.cycle:cycle",),
    "Sheets": (
        "graphkin.documents.sheet_documents:hand_out",
        "graphkin.documents.notebook:plot",
        "graphkin.writers.files:rendered",
        "graphkin.writers.files:write_all",
    ),
    "Accuracy": (
        "graphkin.accuracy.pencil:Pencil",
        "graphkin.accuracy.pencil:original",
        "graphkin.accuracy.pencil:forecast",
        "graphkin.accuracy.pencil:pencil_drawings",
    ),
}
"""What the reference of Python describes, by heading."""
METHODS = ("asked", "solve", "witness", "batch", "stream", "plot", "spoken")
"""The methods of a mechanism that it describes."""


def pages() -> Iterator[Path]:
    """The pages that have a part written by the program."""
    for path in sorted(MANUAL.rglob("*.md")):
        if PART.search(path.read_text(encoding="utf-8")):
            yield path


def made(path: Path) -> str:
    """A page with its parts as the program writes them now."""
    text = path.read_text(encoding="utf-8")
    return PART.sub(lambda found: f"{found[1]}{MAKERS[found[2]]()}{found[3]}", text)


# --- tables and references ------------------------------------------------------------------------


def table(heads: tuple[str, ...], rows: Mapping[str, str]) -> str:
    """A table of names in code with their meanings."""
    lines = [f"| {' | '.join(heads)} |", f"|{'---|' * len(heads)}"]
    return "\n".join([*lines, *(f"| `{name}` | {told} |" for name, told in rows.items())]) + "\n"


def fields_table() -> str:
    """Every kind of field of a form."""
    return table(("field", "meaning"), kinds())


def causes_table() -> str:
    """Every slip that is known by name."""
    return table(("cause", "what the student did"), causes())


def house_tables() -> str:
    """Every key of house.toml, a section for each of its tables."""
    lines: list[str] = []
    for heading, about in HEADINGS.items():
        lines += [f"## `[{heading}]`", "", f"{about[0].upper()}{about[1:]}.", ""]
        lines += ["| key | meaning | example |", "|---|---|---|"]
        keys = (key for key in HOUSE_KEYS if key.table == heading)
        lines += [f"| `{key.name}` | {key.words} | `{key.name} = {key.example}` |" for key in keys]
        lines.append("")
    return "\n".join(lines)


def schools_table() -> str:
    """The signs of each set, and the books that write them so."""
    lines = [f"| sign | {' | '.join(SCHOOLS)} |", f"|{'---|' * (len(SCHOOLS) + 1)}"]
    for name in NAMES:
        signs = (getattr(school.signs, name) for school in SCHOOLS.values())
        lines.append(f"| `{name}` | {' | '.join(signs)} |")
    books = (f"- **{name}**: {school.books}" for name, school in SCHOOLS.items())
    return "\n".join([*lines, "", *books]) + "\n"


def commands() -> str:
    """Every command with its help, from its own parser."""
    return "\n".join(map(command_section, contexts(app, root())))


def root() -> click.Context:
    """The context of the command line itself, with its own settings."""
    return click.Context(app, info_name="graphkin", **app.context_settings)


def contexts(group: click.Group, above: click.Context) -> Iterator[click.Context]:
    """The context of each command of a group, and of the commands of groups within it."""
    for name in group.list_commands(above):
        command = group.get_command(above, name)
        assert command is not None
        context = click.Context(command, parent=above, info_name=name)
        yield context
        if isinstance(command, click.Group):
            yield from contexts(command, context)


def command_section(context: click.Context) -> str:
    """The section of one command: usage, what it does, examples, arguments and options."""
    command, name = context.command, context.command_path
    usage = " ".join(command.collect_usage_pieces(context))
    lines = [f"## `{name}`", "", "```text", f"{name} {usage}", "```", ""]
    for paragraph in re.split(r"\n\s*\n", inspect.cleandoc(command.help or "")):
        kept = paragraph.startswith("\b")
        told = paragraph.removeprefix("\b").strip("\n")
        head, _, rest = told.partition("\n")
        if kept and head.startswith("Example"):
            examples = [line.strip() for line in rest.splitlines()]
            lines += [f"{head}", "", "```sh", *examples, "```", ""]
        else:
            lines += [angle_free(" ".join(told.split())), ""]
    options = [p for p in command.get_params(context) if isinstance(p, click.Option)]
    records = [record for p in options if (record := p.get_help_record(context))]
    lines += ["| option | meaning |", "|---|---|"]
    lines += [f"| `{o.replace('|', ', ')}` | {angle_free(told)} |" for o, told in records]
    return "\n".join(lines) + "\n"


def angle_free(text: str) -> str:
    """A text in which Markdown finds no markup of its own."""
    return re.sub(r"([*_<|\[\]])", r"\\\1", " ".join(text.split()))


def python() -> str:
    """What a program may call, from the docstrings."""
    parts = []
    for heading, names in PUBLIC.items():
        parts += [f"## {heading}\n"]
        for name in names:
            module, _, attribute = name.partition(":")
            parts += described(getattr(import_module(module), attribute), module, attribute)
    return "\n".join(parts)


def described(thing: Any, module: str, name: str) -> Iterator[str]:
    """The section of a function or a class: where it is, how it is called, what it does."""
    yield f"### `{name}`\n"
    yield f"```python\nfrom {module} import {name}\n```\n"
    if not inspect.isclass(thing):
        yield f"```text\n{called(name, thing)}\n```\n"
    yield docstring(thing)
    if name == "Mechanism":
        for method in METHODS:
            function = getattr(thing, method)
            yield f"### `Mechanism.{method}`\n"
            yield f"```text\n{called(method, function)}\n```\n"
            yield docstring(function)
    elif fields := getattr(thing, "__struct_fields__", ()):
        hints = inspect.get_annotations(thing)
        yield table(
            ("field", "type"), {each: f"`{hints[each]}`" for each in fields if each in hints}
        )


def called(name: str, function: Any) -> str:
    """How a function is called: its arguments with their defaults."""
    signature = inspect.signature(function)
    plain = [
        each.replace(annotation=inspect.Parameter.empty)
        for each in signature.parameters.values()
        if each.name != "self"
    ]
    return f"{name}{signature.replace(parameters=plain, return_annotation=signature.empty)}"


def docstring(thing: Any) -> str:
    """A docstring as Markdown: double back-quotes become single."""
    return (inspect.getdoc(thing) or "").replace("``", "`").replace("|", "\\|") + "\n"


# --- the gallery ----------------------------------------------------------------------------------


@cache
def shown(name: str) -> Mechanism:
    """A shipped lab or scene in English."""
    return load(name if is_lab(name) else scene_files.examples()[name]).spoken("en")


def is_lab(name: str) -> bool:
    """Whether a name is that of a shipped lab."""
    return name in scene_files.names()


def gallery() -> str:
    """Every shipped scene with its picture, under its kind."""
    parts = []
    for kind, members in KINDS.items():
        parts += [f"## {kind}\n", *(card(name) for name in members)]
    return "\n".join(parts)


def card(name: str) -> str:
    """One scene of the gallery."""
    scene = shown(name).scene
    title = scene.titles.get("en", scene.title)
    shows = ", ".join(shown_effects(shown(name)))
    folder = f"sheets/{name}/scene" if is_lab(name) else f"examples/scenes/{name}"
    lines = [
        f"### {name}",
        "",
        f"![{title}](pictures/{name}.svg)",
        "",
        f"[{title}](../../{folder}.toml)",
    ]
    return "\n".join([*lines, *(["", f"Shows: {shows}"] if shows else []), "", ""])


def shown_effects(mechanism: Mechanism) -> Iterator[str]:
    """What a scene shows beyond what all scenes show."""
    scene = mechanism.scene
    for row in effects(mechanism):
        if row.included and row.name not in EVERYWHERE:
            yield row.name
    others = {
        "several drivers": len(scene.drivers) > 1,
        "groups by trial": mechanism.is_of_higher_class,
        "forces": scene.forces is not None,
        "paths": bool(scene.ask.curves),
        "inflection circle": bool(scene.ask.inflection),
        "Klein's construction": scene.sheet.method == "klein",
        "Kutzbach's plan": scene.sheet.plan == "kutzbach",
    }
    yield from (name for name, shows in others.items() if shows)


def picture(name: str) -> str:
    """The mechanism of a scene with its forces, else its velocities, as an SVG of its own."""
    mechanism = shown(name)
    drawings = drawn_of(mechanism, language_of(mechanism, "en"))
    some = [each for each in drawings if each.kind == "force"] or drawings[:1]
    panel, _ = next(panels(some, "", some[0].kind, Memory(), quick=False))
    assert panel.name == MECHANISM
    title = escape(mechanism.scene.titles.get("en", mechanism.scene.title))
    return svg_of(edges_of(panel.marks), title, panel.marks, INK)


def svg_of(edges: tuple[float, float, float, float], title: str, marks: Any, ink: Ink) -> str:
    """Marks as an SVG of its own, which shows what lies between left, top, right and bottom."""
    left, top, right, bottom = edges
    view = f"{left:g} {top:g} {right - left:g} {bottom - top:g}"
    size = f'width="{right - left:g}mm" height="{bottom - top:g}mm"'
    style = "\n".join([LETTERING, *rules(marks, ink)])
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} viewBox="{view}" role="img">'
    named = f"<title>{title}</title>\n<style>{style}</style>"
    ground = f'<rect x="{left:g}" y="{top:g}" width="100%" height="100%" fill="#fff"/>'
    drawn = (re.sub(r' data-[a-z]+="[^"]*"', "", element(mark)) for mark in marks)
    return "\n".join([head, named, ground, *drawn, "</svg>\n"])


SCHOOLS_PAGE = MANUAL / "howto" / "five-schools.md"
HOUSE_BLOCK = re.compile(r"^```toml (\w+)\.toml\n(.*?)^```$", re.DOTALL | re.MULTILINE)
ACROSS, APART, CAPTION = 2, 10.0, 14.0
"""Sheets in a row of the picture, the space between them, and that for a name above each, in mm."""


def school_sheet(text: str) -> tuple[Page, Ink]:
    """The acceleration sheet of the pump by a house.toml, and its ink."""
    house = house_of(text, str(MANUAL))
    scene = read_scene(load("pump", n=7).scene.source, {"n": 7}, house)
    parts = hand_out(Mechanism(scene), "key", house.language)
    return next(part for part in parts if part.kind == "acceleration").pages[0], house.ink


def five_schools() -> str:
    """The sheets of the schools of the page, side by side, each with the name of its file."""
    found = HOUSE_BLOCK.findall(SCHOOLS_PAGE.read_text(encoding="utf-8"))
    parts, y, row = list[str](), 0.0, 0.0
    for i, (name, text) in enumerate(found):
        page, ink = school_sheet(text)
        x = (i % ACROSS) * (440.0 + APART)
        if i and i % ACROSS == 0:
            y, row = y + row + CAPTION + APART, 0.0
        row = max(row, page.height)
        own = svg_of((0.0, 0.0, page.width, page.height), name, page.marks, ink)
        own = own.replace("<svg ", f'<svg x="{x:g}" y="{y + CAPTION:g}" ', 1)
        own = scoped(own.replace('mm"', '"'), f"school{i}")
        place = f'x="{x + 4:g}" y="{y + 10:g}" font-size="9" font-family="Graphkin Sans"'
        parts.append(f"<text {place}>{name}.toml</text>\n{own}")
    wide, high = 440.0 * ACROSS + APART, y + CAPTION + row
    view = f'width="{wide / 2:g}mm" height="{high / 2:g}mm" viewBox="0 0 {wide:g} {high:g}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {view} role="img">'
    ground = '<rect width="100%" height="100%" fill="#fff"/>'
    faces = "\n".join(font_face(italic=italic) for italic in (False, True))
    return "\n".join([head, f"<style>{faces}</style>", ground, *parts, "</svg>\n"])


def scoped(svg: str, name: str) -> str:
    """A picture whose rules of style hold in it alone, since pictures in one file share theirs."""
    head, style, rest = re.split(r"<style>|</style>", svg)
    own = re.sub(r"(?m)^(?=[.a-z][^@{]*\{)", f".{name} ", style)
    own = re.sub(r",\s*(?=\.)", f", .{name} ", own)
    return f"{head}<style>{own}</style>".replace("<svg ", f'<svg class="{name}" ', 1) + rest


def course_sheet(view: str, kind: str) -> str:
    """The first sheet of a kind that shows the whole motion of the shaper."""
    (page, *_) = next(e for e in hand_out(load("shaper"), view, "en") if e.kind == kind).pages
    return svg_of((0.0, 0.0, page.width, page.height), escape(page.title), page.marks, INK)


PICTURES_OF_PAGES: Mapping[str, Callable[[], str]] = {
    "five-schools": five_schools,
    "shaper-positions": partial(course_sheet, "positions", "mechanism"),
    "shaper-plans": partial(course_sheet, "positions", "velocity"),
    "shaper-diagrams": partial(course_sheet, "diagrams", "differentiation"),
}
"""The pictures of pages other than the gallery."""


MAKERS = {
    "commands": commands,
    "fields": fields_table,
    "gallery": gallery,
    "python": python,
    "causes": causes_table,
    "house": house_tables,
    "schools": schools_table,
}
"""The function that writes each part."""
