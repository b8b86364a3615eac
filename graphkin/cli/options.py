"""What the commands share: their options and arguments, and how they speak and end."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

import click

from graphkin.cli.console import READING, say

if TYPE_CHECKING:
    from graphkin.drawing.scale import Scales
    from graphkin.mechanism import Mechanism

F = TypeVar("F", bound=Callable[..., Any] | click.Command)


class Option(Protocol):
    """What gives a command an option."""

    def __call__(self, command: F, /) -> F:
        """The same command with it."""


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


def formats_option(metavar: str, default: str, help: str) -> Option:
    """--format, the kinds of file that a command writes."""
    return click.option(
        "--format", "formats", metavar=metavar, default=default, show_default=True, help=help
    )


def jobs_option(
    help: str = "Processes that draw at once; as many as there are cores by default.",
) -> Option:
    """--jobs, how many processes work at once."""
    return click.option("--jobs", metavar="N", type=click.IntRange(1, 1024), help=help)


def lang_option(help: str, default: str | None = None) -> Option:
    """--lang, a language of pages."""
    kinds = click.Choice(["ro", "en", "it"])
    return click.option("--lang", type=kinds, default=default, help=help)


language_option = lang_option("Language of the pages; the scene's by default.")
"""The language of pages."""
ink_option = click.option(
    "--ink",
    type=click.Choice(["colour", "black"]),
    default="colour",
    show_default=True,
    help="black: for printers without colour; the kinds of line tell vectors apart.",
)
"""The ink of pages."""
force_option = click.option("--force", is_flag=True, help="Replace files that exist.")
"""Leave to replace files."""


def option_words(option: str, text: str, known: tuple[str, ...]) -> tuple[str, ...]:
    """The words of an option with commas between them, in the order in which they are known."""
    words = [word.strip().lower() for word in text.split(",") if word.strip()]
    wrong = [word for word in words if word not in known]
    if wrong or not words:
        found = ", ".join(wrong) or "nothing"
        told = f"{found} is none of {', '.join(known)}; several are written {','.join(known[:2])}"
        raise click.UsageError(f"{option}: {told}", current())
    return tuple(word for word in known if word in words)


def mechanism_of(name: str, settings: tuple[str, ...]) -> Mechanism:
    """The mechanism of a lab or a file with its parameters set."""
    from graphkin.mechanism import Mechanism
    from graphkin.scene import scene_files
    from graphkin.scene.read_scene import read_scene
    from graphkin.text import paths

    path, pairs = scene_files.find(name), pairs_of(settings)
    current().meta[READING] = path if paths.is_folder(name) else name
    return Mechanism(read_scene(path, pairs))


def scales_of(mechanism: Mechanism) -> Scales:
    """The scale factors of the sheets."""
    from graphkin.documents.scaling import scales

    return scales(mechanism)


def pairs_of(settings: tuple[str, ...]) -> dict[str, str]:
    """Each NAME=VALUE in its two parts; a name may be set once."""
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
    """The context of the command that runs."""
    return click.get_current_context()


def leave(status: int) -> None:
    """End the command with a status."""
    current().exit(status)


def tell(lines: Iterable[str]) -> None:
    """Print lines."""
    for line in lines:
        say(line)
