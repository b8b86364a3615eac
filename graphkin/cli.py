"""The command line: list, check, explain, solve, sheet, cycle, accuracy."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from graphkin import __version__
from graphkin.cli_grade import grade
from graphkin.cli_print import print_sheets
from graphkin.console import FAILED, READING, Desk, complain

if TYPE_CHECKING:
    from graphkin.mechanism import Mechanism
    from graphkin.paper.scale import Scales
    from graphkin.paper.style import Ink
    from graphkin.report.record import Record
    from graphkin.scene.model import Scene
    from graphkin.steps.run import Trace
    from graphkin.steps.solution import Solution, Verdict

HELP = {"help_option_names": ["-h", "--help"], "max_content_width": 96}
FORMATS = ("svg", "pdf")
LOST = 0.1
"""Bound of an error, in parts of the largest, from which no digit is sure."""


class Folder(click.Path):
    """A folder to write into; nothing at all is no folder."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The path of a folder."""
        if not str(value).strip():
            self.fail("the name of the folder is empty; . is the current one", param, ctx)
        return super().convert(value, param, ctx)


@click.group(cls=Desk, invoke_without_command=True, context_settings=HELP)
@click.version_option(__version__, "-V", "--version", prog_name="graphkin")
@click.pass_context
def app(context: click.Context) -> None:
    """Draw the velocity and acceleration plans of a planar mechanism to scale, step by step, as a
    hand does with compass and ruler, and check them by an independent calculation.

    SCENE is the name of a lab that comes with graphkin, or a .toml file that describes your own
    mechanism.

    \b
    Examples:
      graphkin list                              which labs there are
      graphkin solve pump --set n=7              all numbers of student 7's pump
      graphkin sheet pump --set n=7 -o sheets    the drawings and calculations
      graphkin cycle pump --set n=7 -o cycles    its motion from end to end, as curves
      graphkin accuracy pump -o accuracy         what accuracy costs in time, as pictures
      graphkin check mine.toml                   what is wrong with my own scene

    \b
    Exit status: 0 all is well; 1 the independent check disagrees, or something asked cannot
    be drawn fairly; 2 the scene or the command cannot be understood, drawn or written.
    """
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


def scene_argument(command: Any) -> Any:
    """SCENE and --set, which every command but list takes."""
    command = click.option(
        "--set",
        "settings",
        metavar="NAME=VALUE",
        multiple=True,
        help="Give a parameter of the scene another value, such as n=7. May be repeated.",
    )(command)
    return click.argument("name", metavar="SCENE")(command)


@app.command("list")
def list_labs() -> None:
    """List the labs that come with graphkin.

    Shows for each lab its title, the parameters that --set can change with their ranges, and what
    it asks for.
    """
    from graphkin.report.catalogue import labs_lines

    tell(labs_lines())


@app.command()
@scene_argument
def check(name: str, settings: tuple[str, ...]) -> None:
    """Check a scene and show how its mechanism is put together.

    Tells every mistake at once. Then shows links, pairs and mobility, the groups in the order of
    construction, both closures of each, the driver's range, and the flattest crossings.

    A lab, which has a lab.toml beside its scene, is then tried on a thousand variants: how many
    are fair, which limits the others break, and how much the difficulty differs.

    \b
    Examples:
      graphkin check pump
      graphkin check mine.toml --set r=120
    """
    from graphkin import labs
    from graphkin.cli_class import check_lab
    from graphkin.errors import StructureError
    from graphkin.report.checking import Checking

    checking = Checking(mechanism_of(name, settings))
    tell(checking.lines())
    if checking.problems:
        raise StructureError(checking.problems)
    for doubt in checking.doubts:
        complain(doubt)
    if not settings and labs.folder(name):
        check_lab(name)
    if checking.doubts:
        leave(FAILED)


@app.command()
@scene_argument
@click.option("--json", "as_json", is_flag=True, help="Print JSON, times in seconds.")
def explain(name: str, settings: tuple[str, ...], as_json: bool) -> None:
    """Explain which effects of the motion the construction needs.

    For what the scene asks: which effects are in (Coriolis, normal components, an accelerated
    driver, ...), which are out, why, how many steps each of them costs, and the time that those
    steps alone take here and now.

    \b
    Examples:
      graphkin explain pump
      graphkin explain mine.toml --json
    """
    from graphkin.report.explain import explain_lines, explain_record, explained

    found = explained(mechanism_of(name, settings))
    if as_json:
        import json

        click.echo(json.dumps(explain_record(found), indent=2, ensure_ascii=False))
    else:
        tell(explain_lines(found))


@app.command()
@scene_argument
@click.option("--asked", is_flag=True, help="Compute and report only what [ask] in the scene asks.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON, full precision, SI units.")
@click.option(
    "--pencil",
    metavar="MM",
    type=click.FloatRange(0, 100),
    help="Foretell the errors of a drawing whose marks lie within so many mm of where they belong.",
)
@click.option(
    "--digits",
    metavar="N",
    type=click.IntRange(1, 1000),
    help="Print N significant digits of each number, every one of them proved.",
)
def solve(
    name: str,
    settings: tuple[str, ...],
    asked: bool,
    as_json: bool,
    pencil: float | None,
    digits: int | None,
) -> None:
    """Compute positions, velocities and accelerations, and check them.

    Units are m, s and rad; x points right, y up; counter-clockwise is positive. With --asked no
    step is run that what is asked does not need, neither here nor in the check, and no scale of a
    drawing is looked for.

    With --digits every digit that is printed is proved, by balls of as many bits as that takes;
    what no ball decides, such as whether a number is nought, is said instead, and the status is 1.

    With --pencil it shows how flat the lines cross and what 95 of 100 drawings of what is asked
    will be off at most, where 95 of 100 marks lie within MM and lines within as many degrees.

    \b
    Examples:
      graphkin solve pump --set n=7
      graphkin solve pump --set n=7 --asked
      graphkin solve pump --set n=7 --asked --digits 30
      graphkin solve pump --set n=7 --asked --pencil 0.25
      graphkin solve mine.toml --json > mine.json
    """
    from graphkin.report.record import record
    from graphkin.steps.gather import gathered

    mechanism = mechanism_of(name, settings)
    targets = mechanism.asked() if asked else None
    trace = mechanism.trace(targets)
    solution = gathered(trace)
    verdict = verdict_on(mechanism, solution)
    undrawn = asked and pencil is None and not as_json
    drawn_at = None if undrawn else scales_of(mechanism)
    found = record(mechanism.scene, solution, verdict, drawn_at, asked=asked)
    if digits is not None:
        from graphkin.report.certified import certify

        found = certify(mechanism, found, digits, targets)
    lines: tuple[str, ...] = ()
    if pencil is not None and drawn_at is not None:
        found["pencil"], lines = by_pencil(mechanism, drawn_at, pencil)
    if as_json:
        import json

        click.echo(json.dumps(found, indent=2, ensure_ascii=False, allow_nan=False))
    else:
        click.echo(motion_words(mechanism.scene, solution, found, verdict))
        tell(lines)
    uncertain = not_certified(found)
    if doubts(mechanism.scene, trace, solution, verdict) or uncertain:
        leave(FAILED)


@app.command()
@scene_argument
@click.option(
    "-o",
    "--output",
    "folder",
    metavar="DIR",
    type=Folder(path_type=Path),
    default=Path(),
    help="Folder to write into, made if it is missing; the current one by default.",
)
@click.option(
    "--view",
    type=click.Choice(["key", "task", "steps", "overlay"]),
    default="key",
    show_default=True,
    help="key: everything drawn; task: what the student is given; steps: pages that grow sentence"
    " by sentence; overlay: the key alone, to be laid over a drawing.",
)
@click.option(
    "--lang",
    type=click.Choice(["ro", "en", "it"]),
    help="Language of the pages; the scene's by default.",
)
@click.option(
    "--ink",
    type=click.Choice(["colour", "black"]),
    default="colour",
    show_default=True,
    help="black: for printers without colour; the kinds of line tell vectors apart.",
)
@click.option(
    "--format",
    "formats",
    metavar="svg,pdf",
    default="svg,pdf",
    show_default=True,
    help="Kinds of file to write; calculations come as PDF only.",
)
@click.option("--force", is_flag=True, help="Replace files that exist.")
def sheet(
    name: str,
    settings: tuple[str, ...],
    folder: Path,
    view: str,
    lang: str | None,
    ink: Ink,
    formats: str,
    force: bool,
) -> None:
    """Draw the velocity and acceleration sheets and the calculations.

    Writes A3 drawings (SVG and PDF) and A4 calculation pages (PDF), named after the scene and
    what is set: pump-n7-velocity-key.pdf. Files that exist are kept unless --force is given.

    \b
    Examples:
      graphkin sheet pump --set n=7 -o sheets
      graphkin sheet pump --set n=7 -o sheets --view task --lang en --format pdf
    """
    kinds = formats_of(formats)
    from graphkin.handout import hand_out
    from graphkin.paper.files import file_stem, rendered, write_all

    mechanism = mechanism_of(name, settings)
    stem = file_stem(mechanism.scene.name, pairs_of(settings))
    files: dict[str, bytes] = {}
    for part in hand_out(mechanism, view=view, language=lang):
        files |= rendered(f"{stem}-{part.kind}-{view}", part.kind, part.pages, kinds, ink)
    tell(str(path) for path in write_all(folder, files, force))


@app.command()
@scene_argument
@click.option(
    "-o",
    "--output",
    "folder",
    metavar="DIR",
    type=Folder(path_type=Path),
    default=Path(),
    help="Folder to write into, made if it is missing; the current one by default.",
)
@click.option(
    "--driver",
    metavar="N",
    type=int,
    help="Of several drivers move only this one, counted from 1, while the others stand still.",
)
@click.option(
    "--steps",
    metavar="N",
    type=click.IntRange(4, 1_000_000),
    default=360,
    show_default=True,
    help="Positions in a whole turn, in a range, or in the time shown.",
)
@click.option(
    "--from", "low", metavar="NUMBER", type=float, help="Begin here, not at the start of the range."
)
@click.option("--to", "high", metavar="NUMBER", type=float, help="End here (degrees, lengths, s).")
@click.option(
    "--format",
    "formats",
    metavar="svg,png",
    default="svg,png",
    show_default=True,
    help="Kinds of picture to write; the table comes as CSV.",
)
@click.option("--force", is_flag=True, help="Replace files that exist.")
def cycle(
    name: str,
    settings: tuple[str, ...],
    folder: Path,
    driver: int | None,
    steps: int,
    low: float | None,
    high: float | None,
    formats: str,
    force: bool,
) -> None:
    """Move the driver through a whole turn, or as far as it can go.

    Tells its range, its dead points and change points by name, how far the followers go, and what
    the lengths say of a single loop. Writes a table (CSV, SI units), curves of all motions, paths
    of points, centrodes, and the circle of the driven pin against what the rest can reach.

    Several drivers, and laws of time, are moved by the time: one turn of the first, or --from
    and --to seconds.

    \b
    Examples:
      graphkin cycle pump --set n=7 -o cycles
      graphkin cycle mine.toml -o cycles --steps 720 --format png
    """
    kinds = formats_of(formats, ("svg", "png"))
    from graphkin.curves.files import picture_files
    from graphkin.motion import cycle as moved
    from graphkin.motion.sweep import bounds_in_si
    from graphkin.paper.files import file_stem, write_all
    from graphkin.report.cycle import agrees, cycle_lines
    from graphkin.report.cycle_table import cycle_table

    mechanism = mechanism_of(name, settings)
    first, last = bounds_in_si(mechanism.scene, driver, low, high)
    found = moved(mechanism, driver=driver, steps=steps, low=first, high=last)
    tell(cycle_lines(found))
    stem = file_stem(mechanism.scene.name, pairs_of(settings))
    files = {f"{stem}-cycle.csv": cycle_table(found).encode()}
    files |= picture_files(found, stem, kinds)
    tell(["", *(str(path) for path in write_all(folder, files, force))])
    if not agrees(found):
        complain("the independent route does not agree with the construction")
        leave(FAILED)


@app.command()
@scene_argument
@click.option(
    "-o",
    "--output",
    "folder",
    metavar="DIR",
    type=Folder(path_type=Path),
    default=Path(),
    help="Folder to write into, made if it is missing; the current one by default.",
)
@click.option("--quick", is_flag=True, help="A few positions, hardly timed: to see what comes.")
@click.option(
    "--format",
    "formats",
    metavar="svg,png",
    default="svg,png",
    show_default=True,
    help="Kinds of picture to write; the table comes as CSV.",
)
@click.option("--force", is_flag=True, help="Replace files that exist.")
def accuracy(
    name: str, settings: tuple[str, ...], folder: Path, quick: bool, formats: str, force: bool
) -> None:
    """Measure what accuracy costs in time: errors of every method against certified answers.

    Runs the same positions in doubles one by one and in batches, in single and extended precision,
    in decimals of up to 120 digits, in balls that prove their radius, by Newton's method on the
    loop equations and by central differences, and foretells what a pencil makes of them. Writes
    a table (CSV) and three pictures: error against time; error towards a dead point; cost by what
    is asked. It takes about half a minute; groups of class III and higher some minutes.

    \b
    Examples:
      graphkin accuracy pump -o accuracy
      graphkin accuracy mine.toml -o accuracy --quick
    """
    kinds = formats_of(formats, ("svg", "png"))
    from graphkin.accuracy.files import picture_files
    from graphkin.accuracy.stopwatch import QUICK, Effort
    from graphkin.accuracy.study import study
    from graphkin.paper.files import file_stem, write_all
    from graphkin.report.accuracy import accuracy_lines, accuracy_table

    mechanism = mechanism_of(name, settings)
    effort = QUICK if quick else Effort()
    say = progress()
    found = study(mechanism, scales_if_any(mechanism), effort, say=say)
    say("")
    tell(accuracy_lines(found))
    stem = file_stem(mechanism.scene.name, pairs_of(settings))
    files = {f"{stem}-accuracy.csv": accuracy_table(found).encode()}
    files |= picture_files(found, stem, kinds)
    tell(["", *(str(path) for path in write_all(folder, files, force))])


app.add_command(print_sheets)
app.add_command(grade)


def formats_of(text: str, known: tuple[str, ...] = FORMATS) -> tuple[str, ...]:
    """The kinds of file named with commas between them."""
    kinds = tuple(dict.fromkeys(kind.strip().lower() for kind in text.split(",") if kind.strip()))
    wrong = [kind for kind in kinds if kind not in known]
    if wrong or not kinds:
        found, both = ", ".join(wrong) or "nothing", ",".join(known)
        words = f"--format: {found} is not {', '.join(known)} or {both}"
        raise click.UsageError(words, current())
    return kinds


def mechanism_of(name: str, settings: tuple[str, ...]) -> Mechanism:
    """The mechanism of a lab or a file with its parameters set."""
    from graphkin import labs
    from graphkin.mechanism import Mechanism
    from graphkin.scene.read import read_scene

    path, pairs = labs.find(name), pairs_of(settings)
    current().meta[READING] = str(path) if Path(name).is_dir() else name
    return Mechanism(read_scene(path, pairs))


def pairs_of(settings: tuple[str, ...]) -> dict[str, str]:
    """Each NAME=VALUE in its two parts; a name may be set once."""
    found: dict[str, str] = {}
    for setting in settings:
        name, equals, value = (part.strip() for part in setting.partition("="))
        if not (name and equals and value):
            raise click.UsageError(f"--set {setting}: write NAME=VALUE, such as n=7", current())
        if name in found:
            raise click.UsageError(f"--set {name}: is set twice", current())
        found[name] = value
    return found


def scales_of(mechanism: Mechanism) -> Scales:
    """The scale factors of the sheets."""
    from graphkin.scaling import scales

    return scales(mechanism)


def by_pencil(
    mechanism: Mechanism, drawn_at: Scales, millimetres: float
) -> tuple[dict[str, Any], tuple[str, ...]]:
    """What a pencil does to a drawing of what is asked, as a record and as lines; warns."""
    from graphkin.pencil import Pencil, forecast, original
    from graphkin.report.pencil import pencil_lines, pencil_record, warnings

    found = forecast(original(mechanism, drawn_at), Pencil(millimetres))
    for warning in warnings(found):
        complain(f"{mechanism.scene.name} {warning}")
    return pencil_record(found), ("", *pencil_lines(found))


def verdict_on(mechanism: Mechanism, solution: Solution) -> Verdict | None:
    """The judgement of the independent route; None, and a message, where it cannot judge."""
    from graphkin.errors import StructureError, WitnessError

    try:
        return mechanism.witness(solution)
    except (StructureError, WitnessError) as error:
        for problem in error.problems:
            complain(f"the independent check cannot judge: {problem}")
        return None


def motion_words(scene: Scene, solution: Solution, found: Record, verdict: Verdict | None) -> str:
    """The text of solve, in certified digits where the record holds them."""
    if "digits" in found:
        from graphkin.report.certified import certified_text

        return certified_text(scene, found, verdict)
    from graphkin.report.motion import motion_text

    return motion_text(scene, solution, found, verdict)


def not_certified(found: Record) -> bool:
    """Warn of numbers whose digits are not proved; True when there are any."""
    undecided = found.get("undecided", {})
    if undecided:
        from graphkin.report.table import listed

        complain(f"not certified: {listed(undecided, 6)}")
    return bool(undecided)


def doubts(scene: Scene, trace: Trace, solution: Solution, verdict: Verdict | None) -> bool:
    """Warn of a flat crossing and of a witness that disagrees; True when there is any doubt."""
    from graphkin.report.motion import flat_words, verdict_words
    from graphkin.steps.solution import FAIR

    flat = solution.margin < FAIR
    if flat:
        bound = ""
        if verdict is not None and verdict.limit < LOST:
            bound = f"; it is good to {verdict.limit:.1e} of the largest of its kind"
        elif verdict is not None:
            bound = "; in doubles no digit of it is sure"
        complain(f"{flat_words(scene, trace)}{bound}")
    if verdict is not None and not verdict.agrees:
        complain(f"the independent check {verdict_words(verdict)}")
    return flat or verdict is None or not verdict.agrees


def scales_if_any(mechanism: Mechanism) -> Scales | None:
    """The scale factors of the sheets; None, and a message, where they cannot be drawn."""
    from graphkin.errors import GraphkinError

    try:
        return scales_of(mechanism)
    except GraphkinError as error:
        for problem in error.problems:
            complain(f"the pencil is left out: {problem}")
        return None


def progress() -> Callable[[str], None]:
    """What shows on a terminal, on one line, what is being done; elsewhere it is silent."""
    import sys

    def say(words: str) -> None:
        click.echo(f"\r\x1b[K{words}{' …' if words else ''}", nl=False, err=True)

    def silent(words: str) -> None:
        return

    return say if sys.stderr is not None and sys.stderr.isatty() else silent


def current() -> click.Context:
    """The context of the command that runs."""
    return click.get_current_context()


def leave(status: int) -> None:
    """End the command with a status."""
    current().exit(status)


def tell(lines: Iterable[str]) -> None:
    """Print lines."""
    for line in lines:
        click.echo(line)


def main() -> None:
    """Run the command line and leave with its status."""
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # our matrices are small, its threads slow
    app(prog_name="graphkin")


import graphkin.cli_class  # noqa: E402, F401  (its commands join the app, which stands by now)
