"""Shows the script as HTML, line by line, with syntax colours."""

from collections.abc import Mapping
from typing import Final

from pygments import lex
from pygments.token import Comment, Keyword, Name, Number, is_token_subtype
from pygments.token import _TokenType as Token

from handeye.al.compiler import LANGUAGE
from handeye.al.highlight import ArmLexer
from handeye.core.markup import Markup, element, joined, text
from handeye.program.events import StepStarted
from handeye.program.program import Program

_COLOURS: Final = ((Comment, "c"), (Keyword, "k"), (Name.Label, "l"), (Number, "n"))
_AROUND: Final = 2


def line_id(line: int, file: str = "", files: tuple[str, ...] = ()) -> str:
    """Return the HTML id of a line of the script."""
    return f"line-{files.index(file) if file in files else 0}-{line}"


def listing(program: Program) -> Markup:
    """Return all texts of a program: the script, followed by the required files."""
    files = ("", *program.required)
    texts = (program.source, *program.required.values())
    return joined(
        element(
            "div",
            *([] if not file else [element("h3", file)]),
            element(
                "ol",
                *(
                    element("li", element("code", line), id=line_id(number, file, files))
                    for number, line in enumerate(coloured(program, content), 1)
                ),
            ),
        )
        for file, content in zip(files, texts, strict=True)
    )


def numbered_listing(lines: Mapping[int, str]) -> Markup:
    """Return the lines of a program with the line numbers that the program itself gives."""
    items = (
        element("li", element("code", line), id=line_id(number), value=number)
        for number, line in lines.items()
    )
    return element("div", element("ol", *items))


def excerpt(program: Program, step: StepStarted) -> Markup:
    """Return the line of a step together with the lines around it."""
    lines = coloured(program, program.required.get(step.file, program.source))
    first = max(1, step.line - _AROUND)
    shown = lines[first - 1 : step.line + _AROUND]
    items = (
        element("li", element("code", line), value=number, class_="on" if number == step.line else None)
        for number, line in enumerate(shown, first)
    )
    return element("div", element("ol", *items), class_="source excerpt")


def coloured(program: Program, content: str) -> list[Markup]:
    """Return the lines of a text with syntax colours."""
    plain = content.replace("\r\n", "\n").expandtabs(8)
    if program.language != LANGUAGE:
        return [text(line) for line in plain.split("\n")]
    lines, pieces = [], []
    for kind, value in lex(plain, ArmLexer(stripnl=False, ensurenl=False)):
        first, *rest = value.split("\n")
        pieces.append(_piece(kind, first))
        for more in rest:
            lines.append(joined(pieces))
            pieces = [_piece(kind, more)]
    return [*lines, joined(pieces)]


def _piece(kind: Token, value: str) -> Markup:
    colour = next((name for token, name in _COLOURS if is_token_subtype(kind, token)), None)
    return text(value) if colour is None or not value.strip() else element("span", value, class_=colour)
