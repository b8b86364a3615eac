"""What the commands share: options and arguments, output, and exit statuses."""

from __future__ import annotations

import atexit
import os
import re
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Protocol, TypeVar

import click
from click.exceptions import Exit
from msgspec.structs import replace

from graphkin.scene.findings import near_name
from graphkin.text import LANGUAGES, paths
from graphkin.text.errors import (
    PLAIN_TRACEBACK,
    ClosureError,
    FileError,
    GraphkinError,
    HouseError,
    PageError,
    Problem,
    SceneError,
    StructureError,
    WitnessError,
    fault,
)

if TYPE_CHECKING:
    from pathlib import Path

    from graphkin.classroom.lab.lab_model import Lab
    from graphkin.drawing.scale import Scales
    from graphkin.mechanism import Mechanism
    from graphkin.scene.house import House
    from graphkin.text.tables import Say


FAILED = 1
"""The exit status when the independent check disagrees or something asked is unfair."""
REFUSED = 2
"""The exit status for bad input, a page that does not fit, or a file that cannot be used."""
STOPPED = 130
BROKEN_PIPE = 141
OBEYED = "[\x00-\x08\x0b-\x1f\x7f-\x9f\xad\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff]"
"""Characters that control a terminal or hide text; tabs and line ends are harmless."""
OF_SCENES = (SceneError, StructureError, ClosureError, PageError)
MOST_KEYS = 3
"""Keys that are named under the problems of a scene."""
HOUSE = "graphkin.house"
"""The key under which a command's context keeps the file of --house."""
READING = "graphkin.scene"
"""The key under which a command's context keeps the name of its scene."""


class Command(click.Command):
    """A command whose help option is described in English.

    The help option that click adds looks for a translation, which loads all of its language
    support.
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs | {"add_help_option": False})
        self.params.append(
            eager_option("-h", "--help", help="this message", what=click.Context.get_help)
        )


def eager_option(*names: str, help: str, what: Callable[[click.Context], str]) -> click.Option:
    """An option that prints a text, whatever the other arguments, and ends the command."""

    def tell(context: click.Context, option: click.Parameter, asked: bool) -> None:
        if asked and not context.resilient_parsing:
            click.echo(what(context))
            context.exit()

    return click.Option(
        names,
        is_flag=True,
        expose_value=False,
        is_eager=True,
        help=f"Show {help} and exit.",
        callback=tell,
    )


def command(name: str | None = None) -> Callable[[Callable[..., Any]], Command]:
    """Make a function a command, of its own name by default."""
    return click.command(name, cls=Command)


SHORT = 120
"""The most characters of a command's first sentence in the list of commands."""


class CommandGroup(Command, click.Group):
    """A group of commands that shows no traceback and suggests the nearest command.

    ``sections`` lists them; a command of another module is imported only when it is called.
    """

    command_class = Command
    sections: ClassVar[Mapping[str, Mapping[str, str]]] = {}

    def main(self, *args: Any, **kwargs: Any) -> Any:
        """Run a command and exit with its status."""
        speak_utf8()
        kwargs["standalone_mode"] = False
        sys.exit(guarded(lambda: super(CommandGroup, self).main(*args, **kwargs)))

    def make_context(self, *args: Any, **kwargs: Any) -> click.Context:
        """The context of a command; the reader of help or version may close the pipe."""
        try:
            return super().make_context(*args, **kwargs)
        except BrokenPipeError:
            cut_short()

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command; problems of its scene get the name of the scene."""
        try:
            return super().invoke(ctx)
        except BrokenPipeError:
            cut_short()
        except (SceneError, StructureError, ClosureError, PageError) as error:
            scene = ctx.meta.get(READING)
            if scene is None or isinstance(error, FileError | HouseError):
                raise
            raise type(error)([of_scene(scene, problem) for problem in error.problems]) from error

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """The command that is called; for an unknown one, the error suggests the nearest."""
        name, names = args[0], self.list_commands(ctx)
        if name not in names and not name.startswith("-"):
            ctx.fail(f"{name!r} is not a command; {nearest(name, names)}")
        return super().resolve_command(ctx, args)

    def list_commands(self, ctx: click.Context) -> list[str]:
        """The commands in the order of the help."""
        listed = [name for section in self.sections.values() for name in section]
        return listed or list(self.commands)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command of a name, imported if it belongs to another module."""
        if cmd_name not in self.commands:
            for section in self.sections.values():
                if cmd_name in section:
                    module, _, name = section[cmd_name].partition(":")
                    self.add_command(
                        getattr(import_module(f"graphkin.cli.{module}"), name), cmd_name
                    )
        return super().get_command(ctx, cmd_name)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the commands section by section."""
        widest = max(map(len, self.list_commands(ctx)))
        for title, section in (
            self.sections or {"Commands": dict.fromkeys(self.commands, "")}
        ).items():
            with formatter.section(title):
                commands = ((name, self.get_command(ctx, name)) for name in section)
                formatter.write_dl(
                    [
                        (f"{name:{widest}}", cmd.get_short_help_str(SHORT))
                        for name, cmd in commands
                        if cmd
                    ]
                )


def of_scene(scene: str, problem: Problem) -> Problem:
    """A problem with the scene's name before its place, unless the place is the scene's file."""
    return problem if problem.place == scene else replace(problem, file=scene)


def nearest(name: str, names: list[str]) -> str:
    """The nearest name as a question, or all names."""
    near = near_name(name, names)
    return f"did you mean {near}?" if near else f"commands are {', '.join(names)}"


def speak_utf8() -> None:
    """Use UTF-8 on every console and file; characters that cannot be written are replaced."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="replace")


def guarded(work: Callable[[], Any]) -> int:
    """Run a command; turn every failure into a message on standard error and a status."""
    try:
        status = work()
        if sys.stdout is not None:
            sys.stdout.flush()
    except BrokenPipeError:
        silence()
        return BROKEN_PIPE
    except SystemExit as left:
        return status_of(left.code)
    except (KeyboardInterrupt, click.Abort):
        complain("stopped")
        return STOPPED
    except click.ClickException as error:
        return misused(error)
    except GraphkinError as error:
        for problem in error.problems:
            complain(str(problem))
        if keys := explained_keys(error):
            more = "; ".join(f"graphkin help {key}" for key in keys)
            complain(f"the manual says more: {more}")
        return FAILED if isinstance(error, WitnessError) else REFUSED
    except OSError as error:
        silence()
        place = error.filename if error.filename is not None else "output"
        complain(f"{place}: {error.strerror or error}")
        return REFUSED
    except Exception as error:
        if os.environ.get(PLAIN_TRACEBACK):
            raise
        complain(fault(error))
        return REFUSED
    return status_of(status)


def explained_keys(error: GraphkinError) -> list[str]:
    """The keys of a scene that the manual explains, in the places of problems."""
    if isinstance(error, FileError) or not isinstance(error, OF_SCENES):
        return []
    from graphkin.manual.pages import explained

    known = explained()
    parts = ([*reversed(str(problem.place).split("."))] for problem in error.problems)
    keys = (next((part for part in each if part in known), "") for each in parts)
    return [key for key in dict.fromkeys(keys) if key][:MOST_KEYS]


def status_of(found: object) -> int:
    """The status that a command returned; zero if it returned none."""
    return found if isinstance(found, int) else 0


def misused(error: click.ClickException) -> int:
    """Report wrong arguments of a command and how to see its help."""
    complain(error.format_message())
    context = getattr(error, "ctx", None)
    if context is not None:
        say_aside(f"Try: {context.command_path} --help")
    return REFUSED


def complain(text: str) -> None:
    """Print a message as one line on standard error."""
    say_aside("graphkin: " + " ".join(text.split("\n")))


def say_aside(text: str) -> None:
    """Print a line on standard error; ignore a closed stream."""
    with suppress(OSError):
        say(text, err=True)


@contextmanager
def working() -> Iterator[Say]:
    """A function that shows progress on one line of a terminal; silent elsewhere."""

    def shown(words: str) -> None:
        click.echo(f"\r\x1b[K{words}{' …' if words else ''}", nl=False, err=True)

    if sys.stderr is None or not sys.stderr.isatty():
        yield lambda words: None
        return
    try:
        yield shown
    finally:
        shown("")


def say(text: str, *, err: bool = False) -> None:
    """Print a line.

    File names and cells may contain anything. Characters that a terminal would obey, or that change
    the order of letters, are printed as JSON writes them, \\u001b.
    """
    if not all(line.isprintable() for line in text.split("\n")):
        text = re.sub(OBEYED, lambda found: f"\\u{ord(found[0]):04x}", text)
    click.echo(text, err=err)


def cut_short() -> NoReturn:
    """End as a command whose reader closed the pipe; click would use status 1, which is FAILED."""
    silence()
    raise Exit(BROKEN_PIPE)


def end(left: SystemExit) -> NoReturn:
    """End the process with the status of a command.

    Registered exit functions run, but objects are not destroyed one by one: that would take a tenth
    of the time of ``graphkin solve pump``.
    """
    if threading.active_count() > 1 or sys.gettrace() or sys.getprofile():
        raise left
    atexit._run_exitfuncs()
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError, AttributeError):
            stream.flush()
    os._exit(status_of(left.code))


def silence() -> None:
    """Discard what standard output still holds, so that the exit does not fail again."""
    with suppress(OSError, ValueError, AttributeError):
        stdout = sys.stdout.fileno()
        os.dup2(os.open(os.devnull, os.O_WRONLY), stdout)


# --- shared options and arguments -----------------------------------------------------------------


F = TypeVar("F", bound=Callable[..., Any] | click.Command)


class Option(Protocol):
    """A decorator that adds an option to a command."""

    def __call__(self, command: F, /) -> F:
        """Return the command with the option."""


def keep_house(context: click.Context, _: click.Parameter, given: str | None) -> None:
    """Keep the file of --house for the reading of a scene or a lab."""
    context.meta[HOUSE] = given


house_option = click.option(
    "--house",
    metavar="FILE",
    expose_value=False,
    callback=keep_house,
    help="Conventions of a school; by default house.toml beside the scene, else your own.",
)
"""The option --house; house_of_command reads it."""


def house_of_command(path: str | Path) -> House:
    """The conventions for a scene's file: those of --house, beside it, or the user's own."""
    from graphkin.scene.house import HOUSE as FILE
    from graphkin.scene.house import house_beside, read_house

    given = current().meta.get(HOUSE)
    if given is None and not paths.is_file(paths.within(paths.folder_of(path), FILE)):
        own = paths.within(click.get_app_dir("graphkin"), FILE)
        given = own if paths.is_file(own) else None
    return house_beside(path) if given is None else read_house(given)


def lab_of_command(name: str) -> Lab:
    """The lab of a name or a folder, with the conventions of the command."""
    from graphkin.classroom.lab.read_lab import LAB, find, read_lab

    return read_lab(name, house=house_of_command(find(name) / LAB))


def scene_argument(command: Any) -> Any:
    """Add SCENE, --set and --house, which every command for a scene takes."""
    command = house_option(command)
    command = click.option(
        "--set",
        "settings",
        metavar="NAME=VALUE",
        multiple=True,
        help="Set a parameter of the scene, such as n=7; repeatable.",
    )(command)
    return click.argument("name", metavar="SCENE")(command)


def formats_option(metavar: str, default: str, help: str) -> Option:
    """The option --format: the kinds of file that a command writes."""
    return click.option(
        "--format", "formats", metavar=metavar, default=default, show_default=True, help=help
    )


def jobs_option(help: str = "Processes that draw at once; by default one for each core.") -> Option:
    """The option --jobs: how many processes work at once."""
    return click.option("--jobs", metavar="N", type=click.IntRange(1, 1024), help=help)


def lang_option(help: str, default: str | None = None) -> Option:
    """The option --lang: a language of pages."""
    return click.option("--lang", type=click.Choice(LANGUAGES), default=default, help=help)


language_option = lang_option("Language of the pages; the scene's by default.")
ink_option = click.option(
    "--ink",
    type=click.Choice(["colour", "black"]),
    help="black: for printers without colour; line styles distinguish the vectors. Default: that of"
    " the school's conventions, else colour.",
)
force_option = click.option("--force", is_flag=True, help="Replace existing files.")


def option_words(option: str, text: str, known: tuple[str, ...]) -> tuple[str, ...]:
    """The comma-separated words of an option, in the order of ``known``."""
    words = [word.strip().lower() for word in text.split(",") if word.strip()]
    wrong = [word for word in words if word not in known]
    if wrong or not words:
        found = ", ".join(wrong) or "nothing"
        near = near_name(wrong[0], known) if wrong else ""
        mend = f"did you mean {near}?" if near else f"several are written {','.join(known[:2])}"
        raise click.UsageError(
            f"{option}: {found} is none of {', '.join(known)}; {mend}", current()
        )
    return tuple(word for word in known if word in words)


def mechanism_of(name: str, settings: tuple[str, ...]) -> Mechanism:
    """The mechanism of a lab or a file with its parameters set."""
    from graphkin.mechanism import Mechanism
    from graphkin.scene import scene_files
    from graphkin.scene.read_scene import read_scene

    path, pairs = scene_files.find(name), pairs_of(settings)
    current().meta[READING] = path if paths.is_folder(name) else name
    return Mechanism(read_scene(path, pairs, house_of_command(path)))


def scales_of(mechanism: Mechanism) -> Scales:
    """The scale factors of the sheets."""
    from graphkin.documents.scaling import scales

    return scales(mechanism)


def pairs_of(settings: tuple[str, ...]) -> dict[str, str]:
    """The names and values of NAME=VALUE; raises UsageError for a name set twice."""
    found: dict[str, str] = {}
    wrong: list[str] = []
    for setting in settings:
        name, equals, value = (part.strip() for part in setting.partition("="))
        if not (name and equals and value):
            wrong.append(f"--set {setting}: write NAME=VALUE, such as n=7")
        elif name in found:
            wrong.append(f"--set {name}: is set twice; write it once")
        found[name] = value
    if wrong:
        raise click.UsageError("; ".join(wrong), current())
    return found


def current() -> click.Context:
    return click.get_current_context()


def leave(status: int) -> None:
    current().exit(status)


def tell(lines: Iterable[str]) -> None:
    for line in lines:
        say(line)
