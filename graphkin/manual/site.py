"""The manual as a web site that needs no network: a page for each page, one index for the search.

The pictures and the texts of scenes are in the site; nothing is loaded from elsewhere.
"""

from __future__ import annotations

import json
import posixpath
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import lru_cache
from html import escape
from importlib import metadata
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from graphkin import __version__
from graphkin.manual.pages import HERE, INDEX, Section, chapters, names, sections, text_of
from graphkin.scene import scene_files
from graphkin.writers.templates import from_template

if TYPE_CHECKING:
    from markdown_it import MarkdownIt
    from markdown_it.token import Token

GALLERY = "gallery"
"""The page whose sections of the third level are cards, each with the text of its scene."""
PICTURES = "pictures"
FILES = ("site.css", "site.js")
TOKEN = re.compile(
    r"""(?P<comment>\#.*)|(?P<text>"[^"\n]*"|'[^'\n]*')|(?P<heading>^\s*\[\[?[^\]\n]*\]\]?)"""
    r"""|(?P<key>^\s*[\w-]+(?=\s*=))""",
    re.MULTILINE,
)
"""What is coloured in a block of TOML."""
SCENE = re.compile(r"(?:^|/)(?:scenes/([\w-]+)\.toml|sheets/([\w-]+)/scene\.toml)$")
"""The address of the text of a shipped scene or lab, as the pages write it."""
SHOWS = "Shows: "


class NavEntry(Struct, frozen=True):
    """An entry of the navigation: an address relative to the page, and a title."""

    to: str
    title: str
    here: bool = False


Leading = Callable[[str], str]
"""The address, as seen from the gallery, to which the card of a scene leads; empty for none."""


def nowhere(name: str) -> str:
    return ""


def site(leading: Leading = nowhere) -> Iterator[tuple[str, bytes]]:
    """The files of the web site by their names, in a fixed order."""
    order = names()
    for name in order:
        yield f"{name}.html", page(name, order, leading).encode()
    yield "search.js", f"const SECTIONS = {searched(order)};\n".encode()
    for file in FILES:
        yield file, (HERE / "web" / file).read_bytes()
    for path in sorted((HERE / PICTURES).iterdir()):
        yield f"{PICTURES}/{path.name}", path.read_bytes()


MOVING = "moving"
"""The folder of the pages that move."""


def moving_page(name: str) -> str:
    """The name of the page that moves a scene, in the site."""
    return f"{MOVING}/{name}.html"


def moving_pages(announce: Callable[[str], None]) -> Iterator[tuple[str, bytes]]:
    """The page that draws and moves each shipped scene, in English; each name is reported."""
    from concurrent.futures import ProcessPoolExecutor

    from graphkin.classroom.printing.workers import cores

    order = [*scene_texts()]
    with ProcessPoolExecutor(cores()) as pool:
        for name, html in zip(order, pool.map(drawn_and_moved, order), strict=True):
            announce(name)
            yield moving_page(name), html.encode()


def drawn_and_moved(name: str) -> str:
    """The page of one scene."""
    from graphkin.classroom.sheet_files import hand_out_page
    from graphkin.mechanism import load

    return hand_out_page(load(name), name, name, language="en")


def page(name: str, order: Sequence[str], leading: Leading = nowhere) -> str:
    """A page of the site as HTML, with the navigation around it."""
    titles = {INDEX: "graphkin"} | dict(pair for each in chapters() for pair in each.pages)
    at = order.index(name)

    def link(to: str) -> NavEntry:
        return NavEntry(relative(name, f"{to}.html"), titles[to], to == name)

    return from_template(
        "manual/web/page.html",
        title=titles[name],
        body=markup(name, leading),
        root=relative(name, ""),
        name=name,
        home=link(INDEX),
        chapters=[(each.title, [link(to) for to, _ in each.pages]) for each in chapters()],
        here=[each for each in sections(name) if each.level == 2],
        before=link(order[at - 1]) if at else None,
        after=link(order[at + 1]) if at + 1 < len(order) else None,
        version=__version__,
        published=published(),
        is_gallery=name == GALLERY,
    )


@lru_cache(maxsize=1)
def published() -> tuple[tuple[str, str], ...]:
    """Names and addresses of where graphkin is published, as pyproject.toml states them.

    Empty if it states none, or if graphkin runs without being installed.
    """
    try:
        stated = metadata.metadata("graphkin").get_all("Project-URL") or []
    except metadata.PackageNotFoundError:
        return ()
    pairs = (each.partition(",") for each in stated)
    return tuple((name.strip(), address.strip()) for name, _, address in pairs)


def relative(page: str, to: str) -> str:
    """The address of a file of the site, as seen from a page; the site itself for ""."""
    folder = posixpath.dirname(page)
    return posixpath.relpath(to or ".", folder or ".") + ("" if to else "/")


# --- Markdown to HTML -----------------------------------------------------------------------------


@lru_cache(maxsize=1)
def reader() -> MarkdownIt:
    """The reader of Markdown: CommonMark with tables."""
    from markdown_it import MarkdownIt

    return MarkdownIt("commonmark", {"highlight": highlighted}).enable("table")


def markup(name: str, leading: Leading = nowhere) -> str:
    """A page as HTML: links lead within the site, and headings have the anchors of code hosts."""
    from markupsafe import Markup

    text = re.sub(r"<!--.*?-->\n*", "", text_of(name), flags=re.DOTALL)
    tokens = reader().parse(text)
    headed = iter(sections(name))
    for token in tokens:
        if token.type == "heading_open":
            token.attrSet("id", next(headed).anchor)
        for child in token.children or ():
            redirect(child, name)
    if name == GALLERY:
        tokens = in_cards(tokens, sections(name), leading)
    return Markup(reader().renderer.render(tokens, reader().options, {}))


def redirect(token: Token, page: str) -> None:
    """Let a link to another page or to a scene lead within the site."""
    if token.type == "image":
        token.attrSet("loading", "lazy")
    to = token.attrGet("href")
    if token.type != "link_open" or not isinstance(to, str) or "://" in to:
        return
    path, mark, anchor = to.partition("#")
    if scene := SCENE.search(path):
        shown = relative(page, f"{GALLERY}.html")
        token.attrSet("href", f"{shown}#{anchor_of_scene(scene[1] or scene[2])}")
    elif path.endswith(".md"):
        token.attrSet("href", f"{path.removesuffix('.md')}.html{mark}{anchor}")


def anchor_of_scene(name: str) -> str:
    """The anchor of a scene in the gallery."""
    return next(each.anchor for each in sections(GALLERY) if each.title == name)


def in_cards(tokens: Sequence[Token], headed: Sequence[Section], leading: Leading) -> list[Token]:
    """The gallery with a card around each section of a scene, with its text and a link."""
    from markdown_it.token import Token

    texts = scene_texts()
    cards = {section.anchor: section for section in headed if section.title in texts}
    found: list[Token] = []
    card: Section | None = None

    def close() -> None:
        if card is not None:
            text = highlighted(texts[card.title], "toml", "")
            details = f"<details><summary>Text</summary><pre><code>{text}</code></pre></details>"
            to = leading(card.title)
            link = f'<p><a href="{escape(to)}">Draw and move it</a></p>' if to else ""
            found.append(Token("html_block", "", 0, content=f"{link}{details}</section>\n"))

    for token in tokens:
        if token.type == "heading_open":
            close()
            card = cards.get(str(token.attrGet("id")))
            if card is not None:
                shows = escape(shown_by(card))
                content = f'<section class="card" data-shows="{shows}">\n'
                found.append(Token("html_block", "", 0, content=content))
        found.append(token)
    close()
    return found


def shown_by(card: Section) -> str:
    """What a card of the gallery says that its scene shows."""
    return next((li[len(SHOWS) :] for li in card.text.splitlines() if li.startswith(SHOWS)), "")


@lru_cache(maxsize=1)
def scene_texts() -> Mapping[str, str]:
    """The texts of all shipped labs and scenes by their names."""
    labs = {name: scene_files.shelf() / name / scene_files.SCENE for name in scene_files.names()}
    every = labs | scene_files.examples()
    return {name: path.read_text(encoding="utf-8").rstrip() for name, path in every.items()}


def highlighted(text: str, language: str, _info: str) -> str:
    """A block of code as HTML; comments, texts, headings and keys of TOML get a class."""
    if language != "toml":
        return escape(text, quote=False)
    parts, at = [], 0
    for found in TOKEN.finditer(text):
        parts += [escape(text[at : found.start()], quote=False)]
        parts += [f'<span class="{found.lastgroup}">{escape(found[0], quote=False)}</span>']
        at = found.end()
    return "".join((*parts, escape(text[at:], quote=False)))


# --- search ---------------------------------------------------------------------------------------


def searched(order: Sequence[str]) -> str:
    """The sections of all pages for the search, as JSON: address, title, page and words."""
    found: list[dict[str, Any]] = []
    for name in order:
        whole, *_ = sections(name)
        for section in sections(name):
            words = re.sub(r"<!--.*?-->|[`*|#\[\]]|\(\S*?\.(?:md|svg|toml)\S*?\)|-{3,}", " ",
                           section.text, flags=re.DOTALL)  # fmt: skip
            address = f"{name}.html#{section.anchor}"
            plain = section.title.replace("`", "")
            found.append({"to": address, "title": plain, "page": whole.title,
                          "words": " ".join(words.split())})  # fmt: skip
    return json.dumps(found, ensure_ascii=False, separators=(",", ":")).replace("</", "<\\/")
