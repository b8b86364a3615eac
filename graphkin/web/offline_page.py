"""An offline page: everything in one file, and a policy that lets a browser run nothing else."""

from __future__ import annotations

import json
import re
from base64 import b64encode
from collections.abc import Sequence
from functools import lru_cache
from hashlib import sha256
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphkin.writers.templates import from_template

if TYPE_CHECKING:
    from markupsafe import Markup

WEB = Path(__file__).resolve().parent / "assets"
ENDS = re.compile(r"</(?:script|style)|<!--", re.IGNORECASE)
"""What would end a script or a style sheet before its end."""
OWN = "font-src data:; img-src data: blob:; base-uri 'none'; form-action 'none'"
"""What a page may use besides its scripts and styles: what it holds itself."""


def offline_page(
    title: str, language: str, body: Markup, styles: Sequence[str], scripts: Sequence[str] = ()
) -> str:
    """A whole page of HTML; scripts run after it in their order.

    The policy names each script and style sheet by its hash: no other runs, nothing is fetched,
    attributes with code or styles do nothing. Raises ValueError for a script or a style sheet that
    would end early.
    """
    for text in (*styles, *scripts):
        if ENDS.search(text):
            raise ValueError(f"{ENDS.search(text)} would end a script or a style sheet")
    policy = f"default-src 'none'; style-src {hashes(styles)}; script-src {hashes(scripts)}; {OWN}"
    page = from_template(
        "web/templates/offline.html",
        title=title,
        language=language,
        policy=policy,
        styles=styles,
        body=body,
        scripts=scripts,
    )
    return f"{page}\n"


def hashes(texts: Sequence[str]) -> str:
    """The texts as a policy names them; 'none' where there are none."""
    return " ".join(map(named, texts)) or "'none'"


@lru_cache(maxsize=64)
def named(text: str) -> str:
    """A text by its hash."""
    return f"'sha256-{b64encode(sha256(text.encode('utf-8')).digest()).decode('ascii')}'"


def data_block(name: str, value: Any) -> str:
    """Data that a script reads by its id; no sign in it ends the block."""
    text = json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    text = text.replace("<", "\\u003c").replace("&", "\\u0026")
    return f'<script type="application/json" id="{escape(name)}">{text}</script>'


@lru_cache(maxsize=32)
def part(name: str) -> str:
    """A file of those that a browser reads: a script or a style sheet."""
    return (WEB / name).read_text(encoding="utf-8")
