"""Parses programs by recursive descent, line by line. A mistake affects only its own line."""

from collections.abc import Callable
from dataclasses import replace
from typing import Final, Literal

from handeye.core.diagnostics import Diagnostic, SimilarName, nearest, quoted
from handeye.core.plain_text import one_line
from handeye.core.source import Source, Span
from handeye.systems.sigma.mal.codes import mistake
from handeye.systems.sigma.mal.expressions import ExpressionReader
from handeye.systems.sigma.mal.scanner import Token, tokens
from handeye.systems.sigma.mal.syntax import (
    MAIN,
    AxisGoal,
    Expression,
    Line,
    Number,
    Statement,
    Text,
)
from handeye.systems.sigma.mal.token_reader import Mistaken
from handeye.systems.sigma.mal.words import MAL_DEVICES, RESERVED, STATEMENTS

LARGEST_NUMBER: Final = 99_999  # greatest number of a line
MOST_LINES: Final = 5000


def parsed(source: Source) -> tuple[list[Line], list[Diagnostic]]:
    """Return the lines of a program in the order of the text, and the syntax errors."""
    lines: list[Line] = []
    found: list[Diagnostic] = []
    start, task = 0, MAIN
    for row, text in enumerate(source.text.split("\n"), 1):
        here, length = text.removesuffix("\r"), len(text)
        if len(lines) == MOST_LINES and here.strip(" \t"):
            told = f"a program can have at most {MOST_LINES} lines"
            return lines, [*found, mistake("too-many-lines", told, Span(start=start, end=start + 1))]
        if here.strip(" \t"):
            line, wrong = parsed_line(here, start, row, task)
            if line is not None:
                lines.append(line)
                task = line.task
            found += [] if wrong is None else [wrong]
        start += length + 1
    return lines, found


def parsed_line(text: str, start: int, row: int, task: str) -> tuple[Line | None, Diagnostic | None]:
    """Parse a line that begins at the offset `start` of its text and belongs to a task. Returns two values. For a
    correct line, these are the line and None; for a line with a mistake, None and the mistake. For an empty line, both
    values are None.
    """
    scanned, wrong = tokens(text, start)
    if wrong is not None:
        return None, wrong
    if not scanned:
        return None, None
    first = scanned[0]
    try:
        number = _line_number(first)
        parser = _Parser(scanned[1:], Span(start=first.end, end=max(first.end, start + len(text))))
        statement = parser.whole_statement()
    except Mistaken as stop:
        return None, stop.diagnostic
    if statement.word == "TASK":
        task = statement.names[0].text
    written = one_line(text[first.end - start :])
    return Line(number=number, task=task, statement=statement, row=row, text=written, span=first.span), None


def _line_number(token: Token) -> int:
    number = float(token.text) if token.kind == "number" else 0
    if not token.text.isdigit() or not 1 <= number <= LARGEST_NUMBER:
        told = f"a line must begin with its number, from 1 to {LARGEST_NUMBER}, not with {quoted(token.text)}"
        raise Mistaken(mistake("line-number", told, token.span))
    return int(token.text)


class _Parser(ExpressionReader):
    """Parses the statement after a line number."""

    def whole_statement(self) -> Statement:
        """Parse all tokens as one statement."""
        statement = self._statement(top=True)
        if self._next is not None:
            self._word = statement.word
            self._wrong("the end of the line")
        return statement

    def _statement(self, *, top: bool = False) -> Statement:
        self._deeper()
        first = self._next
        if first is None:
            self._wrong("a statement")
        if first.kind != "name":
            self._wrong("a statement")
        word, self._word = first.text, first.text
        if word == "DIM":
            told = "MAL has no arrays, and no DIM"
            raise Mistaken(mistake("arrays-dropped", told, first.span))
        following = self._tokens[self._at + 1] if self._at + 1 < len(self._tokens) else None
        if word in RESERVED and following is not None and following.text == "=" and following.kind == "mark":
            told = f"{quoted(word)} is a word of MAL and cannot be the name of a variable"
            raise Mistaken(mistake("reserved-word", told, first.span))
        if word not in STATEMENTS:
            statement = self._assignment()
        elif word in ("TASK", "REM") and not top:
            self._wrong("a statement that can be executed")
        else:
            self._take()
            statement = _FORMS[word](self, word)
        last = self._tokens[self._at - 1]
        self._depth -= 1
        return replace(statement, span=Span(start=first.start, end=last.end))

    def _assignment(self) -> Statement:
        name = self._next
        assert name is not None
        following = self._tokens[self._at + 1] if self._at + 1 < len(self._tokens) else None
        if following is not None and following.text == "(" and name.text not in RESERVED:
            told = f"MAL has no arrays; {quoted(name.text)} cannot have a subscript"
            raise Mistaken(mistake("arrays-dropped", told, name.span))
        if following is None or following.text != "=":
            near = nearest(name.text, STATEMENTS, max(1, len(name.text) // 3))
            told = f"{quoted(name.text)} is not a statement of MAL"
            raise Mistaken(
                mistake("unknown-statement", told, name.span, meant=SimilarName(near) if near else None)
            )
        return self._let("LET")

    def _bare(self, word: str) -> Statement:
        return Statement(word=word, span=self._end)

    def _stop(self, word: str) -> Statement:
        if self._next is None or self._next.kind != "text":
            return self._bare(word)
        return Statement(word=word, span=self._end, items=(Text(self._take().text),))

    def _remark(self, word: str) -> Statement:
        self._at = len(self._tokens)
        return self._bare(word)

    def _let(self, word: str) -> Statement:
        self._word = "LET"
        name = self._name("the name of a variable")
        self._need("=")
        return Statement(word="LET", span=self._end, names=(name,), values=(self._expression(),))

    def _if(self, word: str) -> Statement:
        condition = self._condition()
        self._need("THEN")
        then, otherwise = self._branch(), None
        if self._skip("ELSE"):
            self._word = word
            otherwise = self._branch()
        return Statement(word=word, span=self._end, values=(condition,), then=then, otherwise=otherwise)

    def _branch(self) -> Statement:
        token = self._next
        if token is not None and token.kind == "number":
            target = self._target()
            return Statement(word="GOTO", span=target.span, target=target)
        return self._statement()

    def _jump(self, word: str) -> Statement:
        return Statement(word=word, span=self._end, target=self._target())

    def _for(self, word: str) -> Statement:
        name = self._name("the name of a variable")
        self._need("=")
        first = self._expression()
        self._need("TO")
        last = self._expression()
        step = self._expression() if self._skip("STEP") else Number(1.0)
        return Statement(word=word, span=self._end, names=(name,), values=(first, last, step))

    def _of_name(self, word: str) -> Statement:
        what = {
            "TASK": "the name of a task",
            "NEXT": "the name of a variable",
            "INPUT": "the name of a variable",
        }.get(word, "the name of a flag")
        return Statement(word=word, span=self._end, names=(self._name(what),))

    def _of_tasks(self, word: str) -> Statement:
        return Statement(
            word=word, span=self._end, names=self._listed(lambda: self._name("the name of a task"))
        )

    def _wait(self, word: str) -> Statement:
        flags = [self._name("the name of a flag")]
        while self._skip("AND"):
            flags.append(self._name("the name of a flag"))
        return Statement(word=word, span=self._end, names=tuple(flags))

    def _delay(self, word: str) -> Statement:
        return Statement(word=word, span=self._end, values=(self._expression(),))

    def _print(self, word: str) -> Statement:
        items: list[Text | Expression | str] = []
        while self._next is not None and not self._is("ELSE"):
            if self._is(",", ";"):
                items.append(self._take().text)
                continue
            if items and not isinstance(items[-1], str):
                self._wrong("`,` or `;`")
            token = self._next
            items.append(Text(self._take().text) if token.kind == "text" else self._expression())
        return Statement(word=word, span=self._end, items=tuple(items))

    def _move(self, word: str) -> Statement:
        goals = [self._goal()]
        while self._skip(","):
            goals.append(self._goal())
        slow: Expression | None = None
        options: list[Token] = []
        while self._is("SLOW", "LINE", "NOWAIT"):
            option = self._take()
            taken = {each.text for each in options}
            if option.text in taken or {"SLOW", "LINE"} <= {option.text, *taken}:
                told = (
                    f"{option.text} is given twice"
                    if option.text in taken
                    else "SLOW and LINE exclude each other: both choose the speed"
                )
                raise Mistaken(mistake("option-twice", told, option.span))
            options.append(option)
            if option.text == "SLOW":
                slow = self._expression()
        named = {option.text for option in options}
        return Statement(
            word=word, span=self._end, goals=tuple(goals), slow=slow, straight="LINE" in named,
            waits="NOWAIT" not in named,
        )  # fmt: skip

    def _goal(self) -> AxisGoal:
        axis = self._axis()
        mode: Literal["TO", "BY"] = "TO" if self._need("TO", "BY").text == "TO" else "BY"
        return AxisGoal(axis, mode, self._expression())

    def _origin(self, word: str) -> Statement:
        return Statement(word=word, span=self._end, names=self._listed(self._axis))

    def _axis_value(self, word: str) -> Statement:
        axis = self._axis()
        self._need(",")
        if word == "LIMIT" and self._skip("STANDARD"):
            return Statement(word=word, span=self._end, names=(axis,))
        return Statement(word=word, span=self._end, names=(axis,), values=(self._expression(),))

    def _actuate(self, word: str) -> Statement:
        device = self._one_of((*MAL_DEVICES,), "a device")
        value = self._expression() if self._skip("=") else Number(1.0)
        return Statement(word=word, span=self._end, names=(device,), values=(value,))

    def _on(self, word: str) -> Statement:
        self._need("ABORT")
        axis = () if self._is("GOTO") else (self._axis(),)
        self._need("GOTO")
        return Statement(word=word, span=self._end, names=axis, target=self._target())


_FORMS: Final[dict[str, Callable[[_Parser, str], Statement]]] = {
    "REM": _Parser._remark,
    "LET": _Parser._let,
    "IF": _Parser._if,
    "GOTO": _Parser._jump,
    "GOSUB": _Parser._jump,
    "RETURN": _Parser._bare,
    "FOR": _Parser._for,
    "NEXT": _Parser._of_name,
    "PRINT": _Parser._print,
    "INPUT": _Parser._of_name,
    "STOP": _Parser._stop,
    "END": _Parser._bare,
    "TASK": _Parser._of_name,
    "START": _Parser._of_tasks,
    "KILL": _Parser._of_tasks,
    "SET": _Parser._of_name,
    "RESET": _Parser._of_name,
    "WAIT": _Parser._wait,
    "TAKE": _Parser._of_name,
    "DELAY": _Parser._delay,
    "MOVE": _Parser._move,
    "ORIGIN": _Parser._origin,
    "SPEED": _Parser._axis_value,
    "CURVE": _Parser._axis_value,
    "LIMIT": _Parser._axis_value,
    "ACTUATE": _Parser._actuate,
    "ON": _Parser._on,
    "RESUME": _Parser._bare,
}
"""For each word that begins a statement: the function that parses what follows the word."""
assert (*_FORMS,) == STATEMENTS
