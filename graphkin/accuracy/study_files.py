"""The three picture files of a study."""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.accuracy.cost_by_scope import bars
from graphkin.accuracy.error_against_sine import slopes
from graphkin.accuracy.error_against_time import ladder
from graphkin.accuracy.machine import machine_words
from graphkin.accuracy.study import Study
from graphkin.writers.plot_style import figure_file, look

PICTURES = {"time": ladder, "dead-point": slopes, "scope": bars}
"""The pictures by the last part of their file names."""


def picture_files(study: Study, stem: str, formats: Sequence[str]) -> dict[str, bytes]:
    """Every picture of a study by its file name, in each of the formats svg and png."""
    files: dict[str, bytes] = {}
    machine = machine_words()
    with look():
        for name, drawn in PICTURES.items():
            figure = drawn(study, machine)
            if figure is None:
                continue
            for kind in formats:
                files[f"{stem}-accuracy-{name}.{kind}"] = figure_file(figure, kind)
    return files
