"""Expands macros: replaces each call of a macro by the statements of the macro."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Final

import msgspec
from msgspec.structs import replace

from handeye.al.definition import Instruction
from handeye.al.heads import as_instruction
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.operands import Mistake, read_operands
from handeye.al.parameters import Argument, Call, FilledLine, filled
from handeye.al.syntax import LONGEST_LINE, Macro, Name, Script, Statement, Value
from handeye.core.diagnostics import Diagnostic, problem, quoted

MAX_STATEMENTS: Final = 10_000
MAX_DEPTH: Final = 20


class ExpandedStatement(msgspec.Struct, frozen=True, gc=False):
    """A statement of the expanded program. The statement is never the call of a macro. `inside` lists the macros that
    contain the statement, the outermost first.
    """

    statement: Statement
    call: Call
    inside: tuple[str, ...]
    line: FilledLine | None = None  # with a call's operands filled in

    @property
    def macro(self) -> str:
        """The innermost macro that contains the statement; empty if there is none."""
        return self.inside[-1] if self.inside else ""

    @property
    def jumps_from(self) -> Call:
        """The call in which the target label of a jump is looked up. A label that was given as an operand belongs
        to the caller.
        """
        label = self.statement.operands[-1:]
        given = () if self.line is None else self.line.given.values()
        calls = (one.call for one in given if label and label[0] and label[0].span == one.span)
        return next(calls, self.call)


def expand(script: Script, report: Callable[[Diagnostic], None]) -> list[ExpandedStatement]:
    """Return the statements of the program in order, as far as macros can be expanded."""
    expansion = _Expansion(script=script, report=report)
    expansion.place(script.statements, _Frame())
    return expansion.placed


def as_called(script: Script, placed: list[ExpandedStatement]) -> Iterator[Statement]:
    """Yield the statements of a script and of its macros. If a macro has parameters, its statements are yielded once
    for each call, with the operands of this call filled in.
    """
    yield from script.statements
    for macro in script.macros.values():
        if not macro.parameters:
            yield from macro.body
    filled = {name for name, macro in script.macros.items() if macro.parameters}
    if filled:
        yield from dict.fromkeys(item.statement for item in placed if item.macro in filled)


class _Frame(msgspec.Struct, frozen=True):
    """A call that is being expanded, or the main text."""

    call: Call = ()
    inside: tuple[str, ...] = ()  # names of the enclosing macros
    given: Mapping[str, Argument] = {}  # by parameter
    by: Statement | None = None

    def placed(self, statement: Statement, line: FilledLine | None = None) -> ExpandedStatement:
        return ExpandedStatement(statement, self.call, self.inside, line)


@dataclass(slots=True)
class _Expansion:
    script: Script
    report: Callable[[Diagnostic], None]
    placed: list[ExpandedStatement] = field(default_factory=list)
    visited: int = 0
    too_long: bool = False

    def place(self, statements: tuple[Statement, ...], frame: _Frame) -> None:
        for statement in statements:
            if self.too_long:
                return
            self.visited += 1
            if self.visited > MAX_STATEMENTS:
                self.stop(statement, f"the program has more than {MAX_STATEMENTS} statements")
            elif statement.word is None or statement.broken:
                self.placed.append(frame.placed(statement))
            elif statement.word.text in self.script.macros:
                self.call(statement, statement.word, frame)
            else:
                self.placed.append(self.read(statement, frame) if statement.open else frame.placed(statement))

    def read(self, statement: Statement, frame: _Frame) -> ExpandedStatement:
        """Fill in the parameters of a line with the operands of the call."""
        assert statement.word is not None
        line = filled(statement, frame.given)
        operands = self.operands(line, INSTRUCTIONS[statement.word.text], frame)
        if operands is None:
            return frame.placed(replace(statement, broken=True, open=False))
        return frame.placed(replace(statement, operands=line.at_source(operands), open=False), line)

    def call(self, statement: Statement, word: Name, frame: _Frame) -> None:
        if word.text in frame.inside:
            self.problem("recursive-macro", statement, f"macro {quoted(word.text)} uses itself")
            return
        if len(frame.inside) >= MAX_DEPTH:
            self.stop(statement, f"macros are nested more than {MAX_DEPTH} deep")
            return
        if statement.labels:
            self.placed.append(frame.placed(replace(statement, word=None)))
        macro = self.script.macros[word.text]
        given = self.given(statement, macro, frame)
        if given is None:
            self.placed.append(frame.placed(replace(statement, labels=(), broken=True)))
            return
        call, inside = (*frame.call, self.visited), (*frame.inside, word.text)
        self.place(macro.body, _Frame(call, inside, given, statement))

    def given(self, statement: Statement, macro: Macro, frame: _Frame) -> dict[str, Argument] | None:
        """Map the parameters of a macro to the operands of a call. Returns None if the operands are wrong."""
        if not macro.parameters and not statement.open:
            return {}
        names = [parameter.text for parameter in macro.parameters]
        line = filled(statement, frame.given)
        values = self.operands(line, as_instruction(macro.name.text, names), frame)
        if values is None:
            return None
        return {
            name: line.passed(v, frame.call) for name, v in zip(names, values, strict=True) if v is not None
        }

    def operands(
        self, line: FilledLine, definition: Instruction, frame: _Frame
    ) -> tuple[Value | None, ...] | None:
        """Return the operands of a line. If the line is wrong, report the mistake and return None."""
        try:
            if len(line.text) > LONGEST_LINE:
                message = f"with the operands filled in, the line has {len(line.text)} characters"
                help = f"a line can have at most {LONGEST_LINE} characters"
                raise Mistake("line-too-long", message, line.statement.span, help=help)
            return read_operands(definition, line.head, line.tokens)
        except Mistake as mistake:
            self.report(line.located(mistake.diagnostic, frame.by or line.statement))
            return None

    def stop(self, statement: Statement, message: str) -> None:
        self.too_long = True
        self.problem("program-too-long", statement, message)

    def problem(self, code: str, statement: Statement, message: str) -> None:
        self.report(problem(code, message, statement.span))
