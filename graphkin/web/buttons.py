"""Buttons with a picture, and with words for those to whom it tells nothing."""

from __future__ import annotations

from html import escape

ICONS = {
    "previous": ("M11 2 5 8l6 6",),
    "next": ("M5 2l6 6-6 6",),
    "play": ("M4 2v12l10-6z", "M4 2v12M11 2v12"),
    "follow": ("M7 2a5 5 0 1 0 0 10A5 5 0 0 0 7 2M11 11l4 4M7 5v4M5 7h4",),
    "back": ("M3 3v4h4M3.5 7a5 5 0 1 1 0 3.5",),
}
"""The drawings on a button, in a square of 16: those of its states."""


def button(name: str, label: str, more: str = "", short: str = "") -> str:
    """A button by its id; ``more`` are further attributes, ``short`` is a word to be seen."""
    told = f'aria-label="{escape(label)}" title="{escape(label)}"'
    drawn = "".join(
        f'<svg viewBox="0 0 16 16" aria-hidden="true"><path d="{path}"/></svg>'
        for path in ICONS[name]
    )
    word = f"<span>{escape(short)}</span>" if short else ""
    return f'<button type="button" id="{name}" {told} {more}>{drawn}{word}</button>'
