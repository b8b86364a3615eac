"""Paths as text, without pathlib, for modules that every start loads.

pathlib and its imports would take a twentieth of the time of ``graphkin solve pump``.
"""

from __future__ import annotations

import os
from errno import EBADF, ELOOP, ENOENT, ENOTDIR
from os.path import abspath, basename, dirname, join, realpath, splitext
from stat import S_ISDIR, S_ISREG

Named = str | os.PathLike[str]
"""A path, as text or as a pathlib path."""


def within(folder: Named, *names: str) -> str:
    """The path of a file in a folder, or further down."""
    return join(folder, *names)


def beside(module: str, *names: str) -> str:
    """The path of a file in the folder of a module's file, or further down."""
    return within(dirname(realpath(module)), *names)


def mode(path: Named) -> int:
    """The mode of a file or folder; 0 where there is none or its name is impossible.

    Raises OSError where access is denied.
    """
    try:
        return os.stat(path).st_mode
    except ValueError:
        return 0
    except OSError as error:
        if error.errno in (ENOENT, ENOTDIR, EBADF, ELOOP):
            return 0
        raise


def is_file(path: Named) -> bool:
    """Whether there is a file; raises as ``mode`` does."""
    return S_ISREG(mode(path))


def is_folder(path: Named) -> bool:
    """Whether there is a folder; raises as ``mode`` does."""
    return S_ISDIR(mode(path))


def in_folder(path: Named) -> list[str]:
    """The names in a folder, in alphabetical order; none if there is no folder."""
    return sorted(os.listdir(path)) if is_folder(path) else []


def name_of(path: Named) -> str:
    return basename(path)


def stem(path: Named) -> str:
    """The name of a file without its ending."""
    return splitext(basename(path))[0]


def folder_of(path: Named) -> str:
    """The absolute path of the folder that contains a file."""
    return dirname(abspath(path))


def first_bytes(path: Named, most: int) -> bytes:
    """The first ``most`` bytes of a file. Raises OSError."""
    with open(path, "rb") as stream:
        return stream.read(most)
