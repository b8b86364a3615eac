"""The three picture files of a study."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from graphkin.accuracy.cost_by_scope import bars
from graphkin.accuracy.error_against_sine import slopes
from graphkin.accuracy.error_against_time import ladder
from graphkin.accuracy.machine import machine_words
from graphkin.accuracy.study import Study
from graphkin.writers import plot_style

PICTURES = {"time": ladder, "dead-point": slopes, "scope": bars}
"""The pictures by the last part of their file names."""


def picture_files(study: Study, stem: str, formats: Sequence[str]) -> dict[str, bytes]:
    """Every picture of a study by its file name, in each of the formats svg and png."""
    machine = machine_words()
    drawn = ((f"{stem}-accuracy-{k}", partial(of, study, machine)) for k, of in PICTURES.items())
    return plot_style.picture_files(drawn, formats)
