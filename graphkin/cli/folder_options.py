"""Options and arguments of the commands that write into a folder or read one.

They need pathlib, which ``graphkin solve`` does without: it would take a twentieth of its time.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from graphkin.cli.options import Option
from graphkin.text.errors import FileError, message


class FolderType(click.Path):
    """A folder to write into; an empty name is refused."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The path of a folder; raises FileError if it is a file."""
        if not str(value).strip():
            self.fail("the name of the folder is empty; . is the current one", param, ctx)
        if Path(value).is_file():
            hint = message("name another folder with -o")
            raise FileError.at(str(value), message("is a file"), message("a folder"), hint)
        return super().convert(value, param, ctx)


def folder_option(help: str, metavar: str = "DIR", name: str = "folder", **more: Any) -> Option:
    """The option -o: the folder of a command that writes files."""
    kind = FolderType(path_type=Path)
    return click.option("-o", "--output", name, metavar=metavar, type=kind, help=help, **more)


output_option = folder_option(
    "Folder to write into, made if it is missing; the current one by default.", default=Path()
)
"""The option -o, with the current folder as default."""
class_argument = click.argument("folder", metavar="DIR", type=click.Path(path_type=Path))
"""The argument DIR: the folder of a class."""
