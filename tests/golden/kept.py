"""What is kept of an output, and whether another output is still the same.

All that a work draws has one hash, a line of ``kept/drawn.txt``. Machines of one kind may differ in
the last bit of a sine: doubles are rounded before hashing, and the witness's largest difference,
which measures rounding, is left out. A PDF is hashed by what its pages draw, in the letters that
its codes stand for: zlib and reportlab decide how it is compressed and how its faces are numbered.

Words and tables are kept as printed, with doubles to ten digits, in a file for each command. They
are compared number by number, so that no edge of rounding matters.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from hashlib import sha256
from io import BytesIO
from itertools import groupby, zip_longest
from pathlib import Path

from pypdf import PageObject, PdfReader

from tests.golden.works import SCENES, Files, works

STORE = Path(__file__).with_name("kept")
HEAD = "──── "
"""The line above what a work prints."""
DRAWN = (".pdf", ".svg", ".html", "manifest.json", "tolerances.csv")
"""What is kept as a hash."""
Items = dict[tuple[str, str], str]
"""What is kept, by the name of its file and by the work that gives it."""
OWN = (
    (r"largest difference [^\s,]+( at [^\s,]+)?", "largest difference …"),
    (r'"largest_difference": \S+\s+"quantity": ".*"', '"largest_difference": …'),
    (r"\d(?:[.,]\d+)?·10⁻¹[⁰¹²³⁴⁵⁶⁷⁸⁹]", "…"),
    (r"'sha256-[A-Za-z0-9+/]+='", "…"),  # of a page's own scripts and styles
    (r'"numpy": ".*"', '"numpy": …'),
)
"""What belongs to the machine and its libraries."""
FONT = re.compile(r"base64,([A-Za-z0-9+/=]+)")
LETTERS = re.compile(r"/(\S+) (\S+) Tf <([0-9a-f]*)> Tj")
FRACTION = re.compile(r"-?\d+(?:\.\d+(?:e[-+]?\d+)?|e-\d+)")
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
PROVED = 25
"""Signs of a number from which on it is no double, but proved digits."""
NEAR, NOUGHT = 1e-9, 1e-11
"""How far apart equal numbers may be, in parts of them, and in units of SI."""
FAR = 1e12
"""What is farther is at infinity."""


def kept(subject: str, work: str, files: Files) -> Items:
    """What is kept of a work: one hash of what it draws, and the lines of what it prints."""
    item, found, drawn = f"{subject}: {work}", Items(), []
    for name, data in sorted(files.items()):
        if name.endswith(DRAWN):
            drawn.append(f"{name}  {hashed(text_of(name, data))}")
        else:
            text = without_own(data.decode("utf-8-sig").replace("\r\n", "\n"))
            lines = rounded(text, 10, NOUGHT).rstrip("\n") + "\n"
            found[home(subject, work), item if name == "said" else f"{item} / {name}"] = lines
    if drawn:
        found["drawn", item] = hashed("\n".join(drawn))
    return found


def home(subject: str, work: str) -> str:
    """The name of the file that keeps what a work prints."""
    if subject in SCENES:
        return "-".join(re.findall(r"\w+", work)[:2])
    return "mistakes" if subject == "mistakes" else subject.partition("-")[0]


def text_of(name: str, data: bytes) -> str:
    """The text of a drawn file that is hashed."""
    if name.endswith(".pdf"):
        return pdf_text(data)
    return rounded(data.decode(), 8, NEAR) if name.endswith(".html") else data.decode()


def hashed(text: str) -> str:
    """Sixteen hexadecimal digits for a text."""
    return sha256(without_own(text).encode()).hexdigest()[:16]


def without_own(text: str) -> str:
    """A text without what is the machine's own; of a face, a third of a page, its hash."""
    text = FONT.sub(lambda face: sha256(face[1].encode()).hexdigest(), text)
    for own, instead in OWN:
        text = re.sub(own, instead, text)
    return text


def rounded(text: str, digits: int, nought: float) -> str:
    """A text with its doubles to so many digits."""

    def shorter(found: re.Match[str]) -> str:
        if len(found[0]) >= PROVED:
            return found[0]
        return "0" if abs(float(found[0])) < nought else f"{float(found[0]):.{digits}g}"

    return FRACTION.sub(shorter, text)


def pdf_text(data: bytes) -> str:
    """What a PDF says of itself and what its pages draw."""
    reader = PdfReader(BytesIO(data))
    about = [reader.metadata and reader.metadata.title, reader.trailer["/Root"].get("/Lang")]
    return "\n".join([str(about), *(f"{page.mediabox}\n{drawn(page)}" for page in reader.pages)])


def drawn(page: PageObject) -> str:
    """The operators of a page, codes of letters replaced by the letters and their face."""
    faces = {}
    for name, font in page["/Resources"].get("/Font", {}).items():
        if "/ToUnicode" in (found := font.get_object()):
            pairs = re.findall(
                rb"^<(\w\w)> <(\w{4})>$", found["/ToUnicode"].get_data(), re.MULTILINE
            )
            letters = {int(code, 16): chr(int(letter, 16)) for code, letter in pairs}
            faces[name] = found["/BaseFont"].partition("+")[2], letters

    def lettered(found: re.Match[str]) -> str:
        face, letters = faces["/" + found[1]]
        return f"{face} {found[2]} " + "".join(letters[code] for code in bytes.fromhex(found[3]))

    return LETTERS.sub(lettered, page["/Contents"].get_data().decode("latin-1"))


def differences(stored: Items, fresh: Items) -> Iterator[str]:
    """A line for each item that is not as it is stored."""
    for key in sorted({*stored, *fresh}):
        if key not in fresh or key not in stored:
            yield f"{key[1]}: {'is no longer made' if key in stored else 'is new'}"
        elif change := changed(stored[key], fresh[key]):
            yield f"{key[1]}: {change}"


def changed(stored: str, fresh: str) -> str:
    """How an item differs from what is stored, by its first number or word; empty if in nothing."""
    if "\n" not in stored:
        return "" if stored == fresh else "is drawn otherwise"
    both = zip_longest(stored.splitlines(), fresh.splitlines(), fillvalue="")
    for line, (old, new) in enumerate(both, 1):
        if NUMBER.split(old) != NUMBER.split(new):
            at = next((i for i, (a, b) in enumerate(zip(old, new, strict=False)) if a != b), 0)
            part = slice(max(0, at - 20), at + 40)
            return f"line {line}: {old[part]!r} became {new[part]!r}"
        for a, b in zip(NUMBER.findall(old), NUMBER.findall(new), strict=True):
            if not near(a, b):
                return f"line {line}: {a} became {b} in {old.strip()[:60]!r}"
    return ""


def near(a: str, b: str) -> bool:
    """True for the same number but for the rounding of doubles."""
    if a == b or max(len(a), len(b)) >= PROVED:
        return a == b
    x, y = float(a), float(b)
    return min(abs(x), abs(y)) > FAR or abs(x - y) <= NEAR * abs(x) + NOUGHT


@cache
def stored() -> Items:
    """Everything that is stored."""
    found = Items()
    for path in sorted(STORE.glob("*.txt")):
        text = path.read_text(encoding="utf-8")
        if path.stem == "drawn":
            lines = (line.rpartition("  ") for line in text.splitlines())
            found |= {("drawn", item): code for item, _, code in lines}
        else:
            _, *parts = re.split(f"^{HEAD}(.*)\n", text, flags=re.MULTILINE)
            found |= {
                (path.stem, item): lines
                for item, lines in zip(parts[::2], parts[1::2], strict=True)
            }
    return found


def stored_of(subject: str, work: str) -> Items:
    """What is stored of a work."""
    item = f"{subject}: {work}"
    return {key: text for key, text in stored().items() if key[1].partition(" / ")[0] == item}


def write(subject: str, fresh: Items) -> None:
    """Store what is kept of a subject; what is still the same stays as it was written."""
    before, known = stored(), works().keys() - {subject}
    items = {key: text for key, text in before.items() if key[1].partition(": ")[0] in known}
    for key, text in fresh.items():
        items[key] = text if changed(before.get(key, ""), text) else before[key]
    STORE.mkdir(exist_ok=True)
    for path in STORE.glob("*.txt"):
        path.unlink()
    for name, group in groupby(sorted(items.items()), lambda each: each[0][0]):
        text = "".join(
            f"{item}  {text}\n" if name == "drawn" else f"{HEAD}{item}\n{text}"
            for (_, item), text in group
        )
        (STORE / f"{name}.txt").write_text(text, encoding="utf-8")
    stored.cache_clear()
