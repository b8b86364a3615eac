"""The command about the languages of the pages: words."""

from __future__ import annotations

from collections.abc import Iterator

import click

from graphkin.cli.options import tell
from graphkin.text import LANGUAGES


@click.command()
@click.argument("language", type=click.Choice(LANGUAGES), required=False)
@click.option(
    "--missing",
    is_flag=True,
    help="Print the sentences that the language does not have yet, in English, as TOML.",
)
def words(language: str | None, missing: bool) -> None:
    """List the languages of sheets and pages, and the sentences that one of them lacks.

    A sentence that a language lacks is in English on its pages. To translate it, add it to the file
    of the language, graphkin/text/LANGUAGE.toml. Translations of error messages are in
    graphkin/text/problems/LANGUAGE.toml; the English message is the key.

    \b
    Examples:
      graphkin words
      graphkin words de --missing
    """
    if missing and language is None:
        raise click.UsageError("--missing: name a language", click.get_current_context())
    if missing and language is not None:
        tell(missing_lines(language))
    else:
        tell(line_of(each) for each in ([language] if language else LANGUAGES))


def line_of(language: str) -> str:
    """A language, its name, and how many sentences and messages it has."""
    from graphkin.text import ENGLISH, keys, untranslated
    from graphkin.text import words as spoken
    from graphkin.text.problems import translations

    every, name = len(keys()), spoken(language)("language")
    has = every - len(untranslated(language))
    said = f"{language}  {name:10} {has} of {every} sentences"
    if language == ENGLISH:
        return said
    known = {template for each in LANGUAGES for template in translations(each)}
    return f"{said}, {len(translations(language))} of {len(known)} error messages"


def missing_lines(language: str) -> Iterator[str]:
    """The missing sentences in English as TOML, table by table."""
    import json

    from graphkin.text import untranslated

    table = ""
    for key, said in untranslated(language).items():
        own, _, last = key.rpartition(".")
        if own != table:
            table = own
            yield f"[{table}]"
        yield f"{json.dumps(last)} = {json.dumps(said, ensure_ascii=False)}"
