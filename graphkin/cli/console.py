"""How the commands meet a console: UTF-8 everywhere, one line for each problem, a clear status."""

from __future__ import annotations

import atexit
import os
import re
import sys
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from importlib import import_module
from typing import Any, ClassVar, NoReturn

import click
from click.exceptions import Exit
from msgspec.structs import replace

from graphkin.scene.findings import near_name
from graphkin.text.errors import (
    PLAIN_TRACEBACK,
    ClosureError,
    FileError,
    GraphkinError,
    PageError,
    Problem,
    SceneError,
    StructureError,
    WitnessError,
    fault,
)

FAILED = 1
"""Status when the witness disagrees or something asked is unfair."""
REFUSED = 2
"""Status for bad input, a page that does not fit, a file that cannot be read or written."""
STOPPED = 130
BROKEN_PIPE = 141
OBEYED = "[\x00-\x08\x0b-\x1f\x7f-\x9f\xad\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff]"
"""Characters that control a terminal or hide what is written; tabs and ends of lines do not."""
READING = "graphkin.scene"
"""Where the context of a command keeps how its scene was called."""


class Command(click.Command):
    """A command that says in English how to ask for help.

    The option that click adds looks for a translation, with all that knows of languages.
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs | {"add_help_option": False})
        self.params.append(
            told_at_once("-h", "--help", help="this message", what=click.Context.get_help)
        )


def told_at_once(*names: str, help: str, what: Callable[[click.Context], str]) -> click.Option:
    """An option that prints a text, whatever else is written, and ends the command."""

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


class CommandGroup(Command, click.Group):
    """A group of commands that never shows a traceback and knows mistyped commands.

    ``later`` names the modules of commands that are imported when they are called.
    """

    command_class = Command
    later: ClassVar[Mapping[str, str]] = {}

    def main(self, *args: Any, **kwargs: Any) -> Any:
        """Run a command and leave with its status."""
        speak_utf8()
        kwargs["standalone_mode"] = False
        sys.exit(guarded(lambda: super(CommandGroup, self).main(*args, **kwargs)))

    def make_context(self, *args: Any, **kwargs: Any) -> click.Context:
        """The context of a command; help and version, which are printed here, may be cut short."""
        try:
            return super().make_context(*args, **kwargs)
        except BrokenPipeError:
            cut_short()

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command; what is wrong with its scene is told with the name of the scene."""
        try:
            return super().invoke(ctx)
        except BrokenPipeError:
            cut_short()
        except (SceneError, StructureError, ClosureError, PageError) as error:
            scene = ctx.meta.get(READING)
            if scene is None or isinstance(error, FileError):
                raise
            raise type(error)([of_scene(scene, problem) for problem in error.problems]) from error

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """The command that is meant; a mistyped one is answered with the nearest."""
        name, names = args[0], self.list_commands(ctx)
        if name not in names and not name.startswith("-"):
            ctx.fail(f"{name!r} is not a command; {nearest(name, names)}")
        return super().resolve_command(ctx, args)

    def list_commands(self, ctx: click.Context) -> list[str]:
        """The commands in the order in which they are written, those of other modules last."""
        return [*(name for name in self.commands if name not in self.later), *self.later]

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command of a name, imported when it is one of another module."""
        if cmd_name in self.later and cmd_name not in self.commands:
            module, _, name = self.later[cmd_name].partition(":")
            self.add_command(getattr(import_module(module), name), cmd_name)
        return super().get_command(ctx, cmd_name)


def of_scene(scene: str, problem: Problem) -> Problem:
    """A problem with the scene before its place, unless the place is the scene's file itself."""
    return problem if problem.place == scene else replace(problem, file=scene)


def nearest(name: str, names: list[str]) -> str:
    """The nearest name as a question, or all names."""
    near = near_name(name, names)
    return f"did you mean {near}?" if near else f"commands are {', '.join(names)}"


def speak_utf8() -> None:
    """Let every console and file have UTF-8; what cannot be written is replaced, not raised."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="replace")


def guarded(work: Callable[[], Any]) -> int:
    """Run a command; every failure becomes a message on standard error and a status."""
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


def status_of(found: object) -> int:
    """A status that a command returned; nought when it returned nothing of the kind."""
    return found if isinstance(found, int) else 0


def misused(error: click.ClickException) -> int:
    """Say what is wrong with the words of the command, and where its help is."""
    complain(error.format_message())
    context = getattr(error, "ctx", None)
    if context is not None:
        say_aside(f"Try: {context.command_path} --help")
    return REFUSED


def complain(text: str) -> None:
    """One line on standard error."""
    say_aside("graphkin: " + " ".join(text.split("\n")))


def say_aside(text: str) -> None:
    """A line on standard error, wherever that leads."""
    with suppress(OSError):
        say(text, err=True)


def say(text: str, *, err: bool = False) -> None:
    """Print a line. Names of files and cells may hold anything: what a terminal would obey, or
    what turns the order of letters, is printed as JSON writes it, \\u001b.
    """
    if not all(line.isprintable() for line in text.split("\n")):
        text = re.sub(OBEYED, lambda found: f"\\u{ord(found[0]):04x}", text)
    click.echo(text, err=err)


def cut_short() -> NoReturn:
    """Leave as one whose reader has left; click would leave with 1, which is our FAILED."""
    silence()
    raise Exit(BROKEN_PIPE)


def end(left: SystemExit) -> NoReturn:
    """End the process with the status of a command.

    What is registered for the end is done, but what is left is not taken apart, object by object:
    that takes a tenth of the time of ``graphkin solve pump``.
    """
    if threading.active_count() > 1 or sys.gettrace() or sys.getprofile():
        raise left
    atexit._run_exitfuncs()
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError, AttributeError):
            stream.flush()
    os._exit(status_of(left.code))


def silence() -> None:
    """Send what standard output still holds nowhere, so that leaving does not fail again."""
    with suppress(OSError, ValueError, AttributeError):
        stdout = sys.stdout.fileno()
        os.dup2(os.open(os.devnull, os.O_WRONLY), stdout)
