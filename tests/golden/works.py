"""What is run: the command line on every lab and scene, and on a made-up class of every lab.

The small scenes of other tests are checked and drawn once each; some are wrong, and told so.

Everything goes through the entry of the command line, in this process, so that nothing else here
depends on what the modules are called. A work is named by its command line without the scene.
"""

from __future__ import annotations

import atexit
import csv
import io
import os
import re
import shutil
import sys
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from tempfile import TemporaryDirectory
from unittest.mock import patch
from zlib import crc32

import tomlkit

from graphkin.__main__ import main

ROOT = Path(__file__).resolve().parents[2]
SCENES = {path.parent.name: path.parent.name for path in sorted(ROOT.glob("sheets/*/scene.toml"))}
CLASSES = {f"class-{lab}": ROOT / "sheets" / lab for lab in SCENES}
SCENES |= {f"scene-{path.stem}": str(path) for path in sorted(ROOT.glob("examples/scenes/*.toml"))}
LANGUAGES = ("ro", "en", "it")
FOLDERS = ("documents", "documents/others", "documents/rare", "loops", "textbook")
SMALL = {f"small-{Path(name).name}": ROOT / "tests" / "scenes" / name for name in FOLDERS}
"""Folders of small scenes, most of them without their head: what no shipped scene has."""
HEAD = """graphkin = 1
title = "Small"
units = { length = "mm", angle = "deg", speed = "rad/s" }
"""
MISTAKES = tomllib.loads(Path(__file__).with_name("mistakes.toml").read_text(encoding="utf-8"))
SAID = (
    "solve",
    "solve --json",
    "solve --asked --pencil 0.25 --digits 30",
    "check",
    "explain --json",
)
SHEETS = [
    f"sheet --view {view} --lang {language}{kind}"
    for kind, views in (("", "key task steps overlay"), (" --format html", "key task steps"))
    for view in views.split()
    for language in LANGUAGES
]
GRADED, PRINTED = 200, 3
"""How many are marked in a class, and how many get sheets."""
TIMES = re.compile(r'("(?:median|low|high|rounds)":) [^,\s]+')
"""What explain measures."""

Files = dict[str, bytes]


def works() -> dict[str, list[str]]:
    """What is run of every lab, scene and class; the slow page of a cycle in one language."""
    found = {}
    for subject in SCENES:
        language = LANGUAGES[crc32(subject.encode()) % 3]
        slow = f"cycle --steps 12 --format html --lang {language}"
        found[subject] = [*SAID, *SHEETS, slow]
    for subject, folder in SMALL.items():
        stems = sorted(path.stem for path in folder.glob("*.toml"))
        found[subject] = [f"{work} of {stem}" for stem in stems for work in ("check", small(stem))]
    said = [f"{wrong.get('command', 'check')} of {name}" for name, wrong in MISTAKES.items()]
    return found | {"mistakes": said} | {subject: ["grade", "print"] for subject in CLASSES}


def small(stem: str) -> str:
    """The sheets of a small scene, in one of the languages."""
    return f"sheet --view key --lang {LANGUAGES[crc32(stem.encode()) % 3]}"


def outputs(subject: str, work: str) -> Files:
    """The files that a work writes, by name; what it prints has the name "said"."""
    with TemporaryDirectory() as name:
        if subject in SCENES:
            said, files = ran(SCENES[subject], work, Path(name))
        elif subject not in CLASSES:
            command, _, stem = work.rpartition(" of ")
            scene = Path(name) / f"{stem}.toml"
            scene.write_text(small_text(subject, stem), encoding="utf-8")
            said, files = ran(str(scene), command, Path(name) / "sheets")
        else:
            said, files = (graded if work == "grade" else printed)(subject, Path(name))
    said = said.replace(f"{name}/", "").replace(f"{ROOT}/", "")
    return files | ({"said": said.encode()} if said else {})


def small_text(subject: str, stem: str) -> str:
    """A small scene with its head; or one with a mistake, made of another."""
    if subject in SMALL:
        return whole(SMALL[subject] / f"{stem}.toml")
    wrong = MISTAKES[stem]
    text = whole(ROOT / f"{wrong['of']}.toml")
    for old, new in wrong.get("changes", [[wrong["old"], wrong["new"]]] if "old" in wrong else []):
        assert old in text, stem
        text = text.replace(old, new, 1)
    return text


def whole(path: Path) -> str:
    """The text of a scene with its head."""
    text = path.read_text(encoding="utf-8")
    own = {line.partition(" = ")[0] for line in text.splitlines()}
    return "".join(line for line in HEAD.splitlines(True) if line.split()[0] not in own) + text


def graphkin(*words: object) -> str:
    """What a command says on both channels, and its status if it has one."""
    out, err, status = io.StringIO(), io.StringIO(), ""
    argv = patch.object(sys, "argv", ["graphkin", *map(str, words)])
    leaving = patch.object(os, "_exit", sys.exit), patch.object(atexit, "_run_exitfuncs")
    with argv, leaving[0], leaving[1], redirect_stdout(out), redirect_stderr(err):
        try:
            main()
        except SystemExit as left:
            status = f"status {left.code}\n" if left.code else ""
    return TIMES.sub(r"\1 …", out.getvalue()) + err.getvalue() + status


def ran(scene: str, work: str, folder: Path) -> tuple[str, Files]:
    """What a command says of a scene, and its files; of sheets it only lists them."""
    command, *options = work.split()
    folder.mkdir(exist_ok=True)
    options += ["-o", str(folder)] if command in ("sheet", "cycle") else []
    said, stem = graphkin(command, scene, *options), Path(scene).stem
    files = {name.removeprefix(f"{stem}-"): data for name, data in tree(folder).items()}
    return "" if files and command == "sheet" else said, files


def made_up(lab: Path, folder: Path, count: int) -> str:
    """A class whose codes are always the same, and no two of whom have the same data."""
    shutil.copytree(lab, folder / "lab")
    for name, change in {"scene.toml": without_step, "lab.toml": by_formula}.items():
        text = (folder / "lab" / name).read_text(encoding="utf-8")
        (folder / "lab" / name).write_text(change(text), encoding="utf-8")
    numbers = range(1, GRADED + 1, GRADED // count)[:count]
    rows = [[str(n), f"s{n:03}", f"Ștefan {n}", LANGUAGES[n % 3]] for n in numbers]
    write_csv(folder / "class.csv", [["number", "id", "name", "language"], *rows])
    (folder / "class").mkdir()
    (folder / "class" / "manifest.json").write_text('{"salt": "golden"}')
    return graphkin(
        "variants", folder / "lab", folder / "class.csv", "-o", folder / "class", "--force"
    )


def without_step(scene: str) -> str:
    """A scene whose *n* may be any number of its range."""
    assert ", step = 1 }" in scene
    return scene.replace(", step = 1 ", " ", 1)


def by_formula(lab: str) -> str:
    """A lab that sets *n*, spread over its range, and draws nothing."""
    file = tomlkit.parse(lab)
    file["variants"] = {"set": {"n": f"1 + 29*(number - 1)/{GRADED - 1}"}}
    file["fair"].pop("apart", None)
    return tomlkit.dumps(file)


def graded(subject: str, folder: Path) -> tuple[str, Files]:
    """The variants, tolerances, marks and feedback of a class that is often, not always, right."""
    said = made_up(CLASSES[subject], folder, GRADED)
    fields = list(tomllib.loads((folder / "lab" / "lab.toml").read_text(encoding="utf-8"))["marks"])
    write_csv(folder / "none.csv", [["id", *fields]])
    grade = ("grade", folder / "class", "--jobs", 1)
    graphkin(*grade, folder / "none.csv", "-o", folder / "keys", "--format", "none")
    write_csv(folder / "answers.csv", list(answers(folder / "keys" / "tolerances.csv", fields)))
    said += graphkin(*grade, folder / "answers.csv", "-o", folder / "report", "--format", "html")
    variants = [folder / "class" / name for name in ("variants.csv", "manifest.json")]
    return said, tree(folder / "report") | {path.name: path.read_bytes() for path in variants}


def answers(tolerances: Path, fields: Sequence[str]) -> Iterator[Sequence[str]]:
    """A row of answers for every student, made of the program's key; every eighth wrong alike."""
    keys: dict[str, dict[str, tuple[float, float]]] = {}
    for row in csv.DictReader(io.StringIO(tolerances.read_text(encoding="utf-8-sig"))):
        key, allowed = float(row["key"] or 0), float(row["tolerance"] or 0)
        keys.setdefault(row["id"], {})[row["field"]] = key, allowed
    yield ["id", *fields]
    students = list(keys)
    for i, who in enumerate(students):
        own = keys[students[i - 1] if i % 8 == 7 else who]  # or the data of another
        yield [who, *(answer(i, j, field, own) for j, field in enumerate(fields))]


def answer(i: int, j: int, field: str, own: Mapping[str, tuple[float, float]]) -> str:
    """What student i writes into field j: right, or off in a way, far from the tolerance's edge."""
    key, allowed = own.get(field.removesuffix("_sense"), (0.0, 0.0))
    way, hit = i % 8, (i // 8 + j) % 3 == 0
    if way in (1, 2) and hit:
        return ("", "about 3")[way - 1]
    if field.endswith("_sense"):
        return "-" if (key < 0) != (way == 3) else "+"
    size = key if field.endswith(("_x_mm", "_y_mm")) else abs(key)
    if way == 4 or (way == 5 and hit):
        size += (0.7 if way == 4 else 1.3) * allowed
    if way == 6 and field.startswith(("omega", "epsilon")):
        size *= 9.5493  # rev/min for rad/s
    return f"{size:.4g}"


def printed(subject: str, folder: Path) -> tuple[str, Files]:
    """The sheets of a small class, each in the student's language, and those for the printer."""
    said = made_up(CLASSES[subject], folder, PRINTED)
    said += graphkin("print", folder / "class", "--jobs", 1, "--format", "pdf,svg,html")
    return said, tree(folder / "class" / "print")


def tree(folder: Path) -> Files:
    """All files of a folder by name, but for journals."""
    files = [path for path in folder.rglob("[!.]*") if path.is_file()]
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


def write_csv(path: Path, rows: Sequence[Sequence[str]]) -> None:
    """Write a table."""
    with path.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows(rows)
