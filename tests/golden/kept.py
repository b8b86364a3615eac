"""What is kept of an output, and whether another is still the same.

Of what is drawn a hash. Machines of one kind may differ in the last bit of a sine, so doubles are
rounded first, and what measures rounding itself (the witness's largest difference) is left out. Of
a PDF it is what its pages draw, in the letters that its codes stand for: how it is compressed and
its faces are numbered is up to zlib and reportlab. Words and tables are kept as they are, doubles
to ten digits, and compared number by number, so that no edge of rounding can turn one over.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from hashlib import sha256
from io import BytesIO
from itertools import zip_longest
from pathlib import Path

from pypdf import PageObject, PdfReader

from tests.golden.works import Files

STORE = Path(__file__).with_name("kept")
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


def kept(files: Files) -> dict[str, str]:
    """What is kept of outputs, by name: one line, a hash; or words, all their lines ended."""
    found = {}
    for name, data in sorted(files.items()):
        if name.endswith(".pdf"):
            found[name] = hashed(pdf_text(data))
        elif name.endswith((".svg", "manifest.json")):
            found[name] = hashed(data.decode())
        elif name.endswith(".html"):
            found[name] = hashed(rounded(data.decode(), 8, NEAR))
        elif name.endswith("tolerances.csv"):  # too long to be kept: a hash for each student
            for who in sorted(set(re.findall(r"^s\d+,", text := data.decode(), re.MULTILINE))):
                rows = [row for row in text.splitlines() if row.startswith(who)]
                found[f"{name} {who[:-1]}"] = hashed("\n".join(rows))
        else:
            text = without_own(data.decode("utf-8-sig").replace("\r\n", "\n"))
            found[name] = rounded(text, 10, NOUGHT).rstrip("\n") + "\n"
    return found


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


def differences(stored: Mapping[str, str], fresh: Mapping[str, str]) -> Iterator[str]:
    """A line for each item that is not as it is stored."""
    for name in sorted({*stored, *fresh}):
        if name not in fresh or name not in stored:
            yield f"{name}: {'is no longer made' if name in stored else 'is new'}"
        elif change := changed(stored[name], fresh[name]):
            yield f"{name}: {change}"


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


def read(subject: str) -> dict[str, str]:
    """What is stored of a subject, by item."""
    path = STORE / f"{subject}.txt"
    lines, *words = (path.read_text(encoding="utf-8") if path.exists() else "").split("\f\n")
    hashes = {
        name: code for name, _, code in (line.rpartition("  ") for line in lines.splitlines())
    }
    return hashes | {name: text for name, _, text in (part.partition("\n") for part in words)}


def write(subject: str, fresh: Mapping[str, str]) -> None:
    """Store what is kept of a subject; what is still the same stays as it was written."""
    before = read(subject)
    items = {
        name: text if changed(before.get(name, ""), text) else before[name]
        for name, text in sorted(fresh.items())
    }
    text = "".join(f"{name}  {text}\n" for name, text in items.items() if "\n" not in text)
    text += "".join(f"\f\n{name}\n{text}" for name, text in items.items() if "\n" in text)
    STORE.mkdir(exist_ok=True)
    (STORE / f"{subject}.txt").write_text(text, encoding="utf-8")
