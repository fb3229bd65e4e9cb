"""Commands for writing scripts. They format a script, explain an instruction or an error, and serve an editor."""

import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from handeye.al.compiler import check_form
from handeye.al.formatter import format_text
from handeye.al.includes import read_script
from handeye.cli.common import note, put, say, show
from handeye.core.diagnostics import has_errors, quoted, suggestion
from handeye.core.errors import BadArgument, BadFile
from handeye.core.files import write_whole
from handeye.core.source import Source, read_source, with_line_ends
from handeye.program.language import own_language

STANDARD_INPUT = Path("-")


def fmt(
    *files: Annotated[Path, Parameter(allow_leading_hyphen=True, json_list=False)],
    check: Annotated[
        bool, Parameter(help="Write nothing; the exit code is 1 if a file would change.")
    ] = False,
) -> int:
    """Format scripts in columns, like a listing of 1973; comments are kept.

    `-` reads standard input and writes standard output. A script with syntax errors is left as it is. Exit code
    2: a script has syntax errors, or a file cannot be used.

    Parameters
    ----------
    files
        Scripts to format in place.
    """
    if not files:
        raise BadArgument("fmt needs the name of a script, or - for standard input")
    for file in files:
        if file.name.startswith("-") and file != STANDARD_INPUT and not file.exists():
            near = suggestion(file.name, ("--check", "--help"))
            raise BadArgument(f"`fmt` has no option {quoted(file.name)}{f'; {near}' if near else ''}")
    code = 0
    for file in files:
        if file == STANDARD_INPUT:
            source = _standard_input()
        else:
            source = read_script(file) if own_language(file.name) is None else read_source(file)
        code = max(code, _fmt(file, source, check=check))
    return code


def _fmt(file: Path, source: Source, *, check: bool) -> int:
    own = own_language(source.name)
    mistakes = check_form(source) if own is None else own.check(source)
    if has_errors(mistakes):
        show(mistakes, source, json=False)
        note(f"{source.name} is unchanged")
        return 2
    tidy = format_text(source.text) if own is None else own.formatted(source.text)
    if check:
        if tidy != source.text:
            say(f"{source.name} would change")
        return int(tidy != source.text)
    if file == STANDARD_INPUT:
        put(tidy.encode())
    elif tidy != source.text:
        write_whole(file, tidy.encode())
        say(f"{source.name}: formatted")
    return 0


def _standard_input() -> Source:
    try:
        text = sys.stdin.buffer.read().decode("utf-8-sig")
        return Source(name="standard input", text=with_line_ends(text))
    except UnicodeDecodeError as error:
        raise BadFile(f"standard input is not UTF-8 text: {error.reason} at byte {error.start}") from None


def explain(word: str | None = None, /) -> int:
    """Explain a diagnostic code, an error number or an instruction; without an argument, list the codes.

    Parameters
    ----------
    word
        The code, number or instruction, such as label-twice, 23 or CHANGE.
    """
    from handeye.editor.explain import explanation, listing

    say(listing() if word is None else explanation(word))
    return 0


def lsp() -> int:
    """Serve an editor over standard input and output (language server protocol)."""
    from handeye.editor.server import serve

    serve()
    return 0
