"""The command line: all commands by section; list, check, explain, solve and words."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import click

from graphkin import __version__
from graphkin.cli.options import (
    FAILED,
    CommandGroup,
    command,
    complain,
    eager_option,
    leave,
    mechanism_of,
    say,
    scales_of,
    scene_argument,
    tell,
)
from graphkin.text import LANGUAGES
from graphkin.text import words as spoken

if TYPE_CHECKING:
    from collections.abc import Iterable

    from graphkin.cli.report.solution_record import Record
    from graphkin.construction.core.program import Target
    from graphkin.construction.core.run import Trace
    from graphkin.construction.core.solution import Solution, Verdict
    from graphkin.drawing.scale import Scales
    from graphkin.mechanism import Mechanism
    from graphkin.scene.model import Scene

COMMANDS = {
    "Start here": {
        "manual": "page_commands:manual",
        "help": "page_commands:help_on",
        "list": "main:list_labs",
    },
    "One mechanism": {
        "check": "main:check",
        "explain": "main:explain",
        "solve": "main:solve",
        "sheet": "draw_commands:sheet",
        "cycle": "draw_commands:cycle",
        "accuracy": "draw_commands:accuracy",
        "studio": "page_commands:studio",
    },
    "Class and marks": {
        "new": "class_commands:new",
        "ranges": "class_commands:ranges",
        "variants": "class_commands:variants",
        "print": "paper_commands:print_sheets",
        "read": "paper_commands:read",
        "grade": "grade_command:grade",
        "desk": "paper_commands:desk",
    },
    "Other programs and languages": {
        "import": "exchange_commands:import_scene",
        "export": "exchange_commands:export",
        "quiz": "class_commands:quiz",
        "words": "main:words",
    },
}
"""The sections of the help, each with its commands as ``module:function`` of ``graphkin.cli``."""
HELP = {"help_option_names": ["-h", "--help"], "max_content_width": 96}
VERSION = f"graphkin, version {__version__}"


class Commands(CommandGroup):
    """The group of all commands."""

    sections = COMMANDS


@click.group(
    cls=Commands,
    invoke_without_command=True,
    context_settings=HELP,
    params=[eager_option("-V", "--version", help="the version", what=lambda context: VERSION)],
)
@click.pass_context
def app(context: click.Context) -> None:
    """Draw the velocity and acceleration plans of a planar mechanism to scale.

    The plans are drawn step by step, as by hand with compass and ruler, and are checked by an
    independent calculation.

    SCENE is the name of a lab or scene that comes with graphkin, or a .toml file that describes
    your own mechanism.

    \b
    Examples:
      graphkin manual                            first steps, for student and lecturer
      graphkin list                              the labs that come with graphkin
      graphkin solve pump --set n=7              all numbers of student 7's pump
      graphkin sheet pump --set n=7 -o sheets    the drawings and calculations
      graphkin cycle pump --set n=7 -o cycles    its motion over the whole range, as curves
      graphkin accuracy pump -o accuracy         the time that accuracy costs, as pictures
      graphkin check mine.toml                   the mistakes in my own scene
      graphkin help slides                       what a key of a scene means

    \b
    Exit status: 0 success; 1 the independent check disagrees, or something asked cannot
    be drawn fairly; 2 the scene or the command cannot be understood, drawn or written.
    """
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


@command("list")
@click.option("--scenes", is_flag=True, help="List the names and titles of all scenes instead.")
def list_labs(scenes: bool) -> None:
    """List the labs and scenes that come with graphkin.

    Prints for each lab its title, the parameters that --set can change with their ranges, and the
    quantities that the lab asks for. SCENE can be any name that it prints.

    \b
    Examples:
      graphkin list
      graphkin list --scenes
    """
    from graphkin.cli.report.catalogue import labs_lines, scenes_lines

    tell(scenes_lines() if scenes else labs_lines())


@command()
@scene_argument
def check(name: str, settings: tuple[str, ...]) -> None:
    """Check a scene and show how its mechanism is put together.

    Reports all mistakes at once. Then prints links, pairs and mobility, the groups in the order of
    construction, both closures of each group, the driver's range, and the flattest crossings.

    A lab, which has a lab.toml in the folder of its scene, is then tried on a thousand variants:
    how many are fair, which limits the others exceed, and how much the difficulty differs.

    For a school's conventions, such as house.toml, it prints what they state.

    \b
    Examples:
      graphkin check pump
      graphkin check mine.toml --set r=120
    """
    from graphkin.cli.class_commands import check_lab
    from graphkin.cli.report.check_report import Checking
    from graphkin.scene import scene_files
    from graphkin.scene.house import is_house, read_house
    from graphkin.text.errors import StructureError

    if is_house(name):
        from graphkin.cli.report.check_report import house_lines

        tell(house_lines(read_house(name)))
        return
    checking = Checking(mechanism_of(name, settings))
    tell(checking.lines())
    if checking.problems:
        raise StructureError(checking.problems)
    for doubt in checking.doubts:
        complain(doubt)
    if not settings and scene_files.folder(name):
        check_lab(name)
    if checking.doubts:
        leave(FAILED)


@command()
@scene_argument
@click.option("--json", "as_json", is_flag=True, help="Print JSON, times in seconds.")
def explain(name: str, settings: tuple[str, ...], as_json: bool) -> None:
    """Explain which effects of the motion the construction needs.

    Lists the effects that the construction includes for what the scene asks (tangential components,
    an accelerated driver, ...), those that it leaves out, and why. For each effect prints the
    number of steps and the time that these steps take on this computer. Then prints the time you
    wait for each task (load, solve, check, page), and how accurate a drawing and the numbers are.

    \b
    Examples:
      graphkin explain pump
      graphkin explain mine.toml --json
    """
    from graphkin.cli.report.explain_report import explain_lines, explain_record, explained

    found = explained(lambda: mechanism_of(name, settings))
    if as_json:
        import json

        say(json.dumps(explain_record(found), indent=2, ensure_ascii=False))
    else:
        tell(explain_lines(found))


@command()
@scene_argument
@click.option(
    "--asked", is_flag=True, help="Compute and report only what [ask] in the scene asks for."
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON, full precision, SI units.")
@click.option(
    "--units",
    type=click.Choice(["SI", "scene"]),
    help="Units of lengths, speeds and accelerations: SI, or the scene's. Default: SI for JSON,"
    " else what the scene or the school says; inches for a scene in inches, feet for one in feet.",
)
@click.option(
    "--pencil",
    metavar="MM",
    type=click.FloatRange(0, 100),
    help="Predict the errors of a drawing whose marks lie within MM millimetres of their place.",
)
@click.option(
    "--digits",
    metavar="N",
    type=click.IntRange(1, 1000),
    help="Print N significant digits of each number, all of them proved.",
)
def solve(
    name: str,
    settings: tuple[str, ...],
    asked: bool,
    as_json: bool,
    units: str | None,
    pencil: float | None,
    digits: int | None,
) -> None:
    """Compute positions, velocities and accelerations, and check them.

    Units are m, s and rad, or those of --units; x points right, y up; counter-clockwise is
    positive. With --asked, the construction and the check run only the steps that [ask] needs, and
    the scales of a drawing are computed only for --json or --pencil.

    --json --units scene prints the units with the numbers. Certified digits, forces and the errors
    of a pencil are in SI units.

    With --digits, every printed digit is proved by ball arithmetic of sufficient precision. Where
    no ball decides, such as whether a number is zero, the command says so, and the exit status is
    1.

    With --pencil, prints how flat the lines cross, and the largest error of what is asked in 95 of
    100 drawings. It assumes that 95 of 100 marks lie within MM millimetres and lines within as many
    degrees.

    \b
    Examples:
      graphkin solve pump --set n=7
      graphkin solve pump --set n=7 --asked
      graphkin solve pump --set n=7 --asked --digits 30
      graphkin solve pump --set n=7 --asked --pencil 0.25
      graphkin solve mine.toml --json > mine.json
    """
    from graphkin.cli.report.solution_record import record
    from graphkin.construction.core.solution import gathered
    from graphkin.loops.differences import sure_of
    from graphkin.mechanism import Mechanism

    mechanism = mechanism_of(name, settings)
    stated = mechanism.scene
    if digits is None:
        mechanism = computed_in(mechanism, units, as_json=as_json)
    targets = mechanism.asked() if asked else None
    trace, drawable = traced(mechanism, targets, digits)
    solution = gathered(trace)
    verdict = verdict_on(mechanism, solution)
    solution = sure_of(solution, dict.fromkeys(verdict.unsure, True)) if verdict else solution
    drawn = drawable and not (asked and pencil is None and not as_json)
    drawn_at = scales_of(mechanism) if drawn else None
    found = record(mechanism.scene, solution, verdict, drawn_at, asked=asked)
    if digits is not None:
        from graphkin.cli.report.certified_report import certify

        found = certify(mechanism, found, digits, targets)
    lines: tuple[str, ...] = ()
    given, own = stated.forces, mechanism if digits is None else Mechanism(stated)
    by_forces = own.forces() if given is not None and given.asked else None
    if given is not None and by_forces is None:
        complain("masses and loads are left aside: [ask] has neither reactions nor balance")
    if given is not None and by_forces is not None:
        if digits is not None:
            complain(
                "reactions and the balance are computed in doubles: their digits are not proved"
            )
        from graphkin.cli.report.force_report import force_lines, force_record

        held = force_record(given, *by_forces)
        found |= held
        lines = tuple(force_lines(held, spoken("en", length=own.scene.base).unit))
    if pencil is not None and drawn_at is not None:
        own = mechanism if mechanism.scene.base == "m" else Mechanism(stated)
        found["pencil"], errors = by_pencil(own, scales_of(own), pencil)
        lines += errors
    if as_json:
        import json

        if units == "scene":
            found = in_units(found, mechanism, drawn_at)
        say(json.dumps(found, indent=2, ensure_ascii=False, allow_nan=False))
    else:
        say(motion_words(mechanism.scene, solution, found, verdict))
        tell(lines)
    uncertain = not_certified(found)
    doubtful = doubts(mechanism.scene, trace, solution, verdict, proved=digits is not None)
    doubtful |= by_forces is not None and not by_forces[1].agrees
    if doubtful or uncertain:
        leave(FAILED)


def in_units(found: Any, mechanism: Mechanism, drawn_at: Scales | None) -> Any:
    """The record with its units; kL is a length per metre of paper, as kv and ka are."""
    scales = {"scales": {**found["scales"], "kL": drawn_at.kL}} if drawn_at is not None else {}
    return {"units": units_of(mechanism), **found, **scales}


def computed_in(mechanism: Mechanism, units: str | None, *, as_json: bool) -> Mechanism:
    """The mechanism computed in the units of an option; by default SI for JSON, else of results."""
    from graphkin.mechanism import Mechanism

    scene = mechanism.scene
    usual = "m" if as_json else scene.unit_of_results
    base = {"SI": "m", "scene": scene.units["length"]}.get(units or "", usual)
    measured = scene.computed_in(base)
    return mechanism if measured is scene else Mechanism(measured)


def units_of(mechanism: Mechanism) -> dict[str, str]:
    """The units of the numbers of a mechanism's motion."""
    base = mechanism.scene.base
    found = {"length": base, "speed": f"{base}/s", "acceleration": f"{base}/s²"}
    found |= {"turning": "rad/s", "turning acceleration": "rad/s²"}
    if mechanism.scene.forces is not None:
        unit = spoken("en", length=base).unit
        found |= {"force": unit("N"), "moment": unit("N·m")}
    return found


def traced(
    mechanism: Mechanism, targets: Iterable[Target] | None, digits: int | None
) -> tuple[Trace, bool]:
    """The construction, and whether doubles can draw it.

    If doubles cannot and ``digits`` are requested, the construction is done in balls. Raises
    ClosureError where it does not close.
    """
    from graphkin.text.errors import ClosureError

    try:
        return mechanism.trace(targets), True
    except ClosureError as error:
        if digits is None:
            raise
        from graphkin.accuracy.certified import trace_by_balls
        from graphkin.diagnosis.assembly_failure import to_balls_too

        trace = trace_by_balls(mechanism, digits, targets)
        if trace is None:
            raise ClosureError([to_balls_too(each) for each in error.problems]) from error
        return trace, False


def by_pencil(
    mechanism: Mechanism, drawn_at: Scales, millimetres: float
) -> tuple[dict[str, Any], tuple[str, ...]]:
    """The errors of a drawing made with a pencil, as a record and as lines; prints warnings."""
    from graphkin.accuracy.pencil import Pencil, forecast, original
    from graphkin.cli.report.pencil_report import pencil_lines, pencil_record, warnings
    from graphkin.documents.force_fields import with_force_plan

    found = forecast(original(*with_force_plan(mechanism, drawn_at)), Pencil(millimetres))
    for warning in warnings(found):
        complain(f"{mechanism.scene.name} {warning}")
    return pencil_record(found), ("", *pencil_lines(found))


def verdict_on(mechanism: Mechanism, solution: Solution) -> Verdict | None:
    """The verdict of the independent check; None, with a message, if it cannot judge."""
    from graphkin.text.errors import StructureError, WitnessError

    try:
        return mechanism.witness(solution)
    except (StructureError, WitnessError) as error:
        for problem in error.problems:
            complain(f"the independent check cannot judge: {problem}")
        return None


def motion_words(scene: Scene, solution: Solution, found: Record, verdict: Verdict | None) -> str:
    """The text of solve, in certified digits if the record has them."""
    if "digits" in found:
        from graphkin.cli.report.certified_report import certified_text

        return certified_text(scene, found, verdict)
    from graphkin.cli.report.solution_record import motion_text

    return motion_text(scene, solution, found, verdict)


def not_certified(found: Record) -> bool:
    """Warn of numbers whose digits are not proved; True if there are any."""
    undecided = found.get("undecided", {})
    if undecided:
        from graphkin.text.tables import listed

        complain(f"not certified: {listed(undecided, 6)}")
    return bool(undecided)


def doubts(
    scene: Scene, trace: Trace, solution: Solution, verdict: Verdict | None, *, proved: bool = False
) -> bool:
    """Warn of a flat crossing, of numbers without a sure digit, and of a failed independent check.

    True if there is any doubt. With ``proved``, the digits are sure whatever doubles lose.
    """
    from graphkin.cli.report.solution_record import (
        digits_words,
        flat_words,
        unsure_words,
        verdict_words,
    )
    from graphkin.construction.core.solution import FAIR

    flat = solution.margin < FAIR
    if flat:
        sure = f"; sure digits: {digits_words(verdict)}" if verdict and not proved else ""
        complain(f"{flat_words(scene, trace)}{sure}")
    unsure = verdict is not None and bool(verdict.unsure) and not proved
    if verdict is not None and unsure:
        complain(unsure_words(verdict))
    if verdict is not None and not verdict.agrees:
        complain(f"the independent check {verdict_words(verdict, scene)}")
    return flat or verdict is None or not verdict.agrees or unsure


@command()
@click.argument("language", type=click.Choice(LANGUAGES), required=False)
@click.option(
    "--missing",
    is_flag=True,
    help="Print the sentences that the language does not have yet, in English, as TOML.",
)
def words(language: str | None, missing: bool) -> None:
    """List the languages of sheets and pages, and the sentences that one of them lacks.

    A sentence that a language lacks is in English on its pages. To translate it, add it to the file
    of the language, graphkin/text/LANGUAGE.toml. Translations of error messages are in
    graphkin/text/problems/LANGUAGE.toml; the English message is the key.

    \b
    Examples:
      graphkin words
      graphkin words de --missing
    """
    if missing and language is None:
        raise click.UsageError("--missing: name a language", click.get_current_context())
    if missing and language is not None:
        tell(missing_lines(language))
    else:
        tell(line_of(each) for each in ([language] if language else LANGUAGES))


def line_of(language: str) -> str:
    """A language, its name, and how many sentences and messages it has."""
    from graphkin.text import ENGLISH, keys, untranslated
    from graphkin.text.problems import translations

    every, name = len(keys()), spoken(language)("language")
    has = every - len(untranslated(language))
    said = f"{language}  {name:10} {has} of {every} sentences"
    if language == ENGLISH:
        return said
    known = {template for each in LANGUAGES for template in translations(each)}
    return f"{said}, {len(translations(language))} of {len(known)} error messages"


def missing_lines(language: str) -> Iterator[str]:
    """The missing sentences in English as TOML, table by table."""
    import json

    from graphkin.text import untranslated

    table = ""
    for key, said in untranslated(language).items():
        own, _, last = key.rpartition(".")
        if own != table:
            table = own
            yield f"[{table}]"
        yield f"{json.dumps(last)} = {json.dumps(said, ensure_ascii=False)}"
