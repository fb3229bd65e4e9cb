"""Parses text to a syntax tree, with at most one diagnostic per line."""

from dataclasses import dataclass, field
from typing import Final

from msgspec.structs import replace

from handeye.al.definition import Instruction
from handeye.al.heads import heads, taken
from handeye.al.hints import elsewhere, strange
from handeye.al.includes import REQUIRE, Requirements
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.operands import Mistake, free_text, read_operands, separated
from handeye.al.parameters import braced_in, parameters_in
from handeye.al.scanner import JUNK, MARK, NAME, Line, Token, scan
from handeye.al.syntax import LONGEST_LINE, Macro, Name, Script, Statement, Text, Value
from handeye.core.diagnostics import (
    LIMIT,
    Diagnostic,
    Label,
    Meant,
    MissingMark,
    alternatives,
    names_sentence,
    problem,
    quoted,
)
from handeye.core.source import Source, Span

_DEFINE: Final = "DEFINE"
_CONSOLE_WORDS: Final = ("DO", "GO")  # console commands that execute an instruction or the program


def parse(text: str) -> tuple[Script, list[Diagnostic]]:
    """Parse a text without the texts that it requires. Returns the syntax tree and the syntax errors. Stops after
    `LIMIT` errors.
    """
    return _parsed(Source(name="", text=text), None)


def parse_whole(source: Source) -> tuple[Script, list[Diagnostic]]:
    """Parse a text and the texts that it requires. Returns the syntax tree and the syntax errors."""
    return _parsed(source, Requirements(source))


def _parsed(source: Source, requirements: Requirements | None) -> tuple[Script, list[Diagnostic]]:
    texts = {text.key: scan(text.text, source.begins[text.key]) for text in source.texts}
    defining = (text.key for text in source.texts if _DEFINE in text.text.upper())
    # The heads of all macros are read first, so a call may come before the definition.
    known: dict[str, Instruction | None] = {}
    for head in (head for key in defining for head in heads(texts[key])):
        known.setdefault(head.word, head.usage)
    parser = _Parser(texts=texts, known=known, requirements=requirements)
    parser.read(source)
    return Script(statements=tuple(parser.statements), macros=parser.macros), parser.diagnostics


@dataclass(slots=True)
class _Parser:
    texts: dict[str, list[Line]]
    known: dict[str, Instruction | None]  # macros by name; None for a macro with a wrong head
    requirements: Requirements | None  # None if requirements are not read
    errors: int = 0
    statements: list[Statement] = field(default_factory=list)
    macros: dict[str, Macro] = field(default_factory=dict)
    diagnostics: list[Diagnostic] = field(default_factory=list)
    opened: Name | None = None  # the macro being read
    parameters: dict[str, Name] = field(default_factory=dict)  # its parameters
    body: list[Statement] = field(default_factory=list)

    def read(self, source: Source) -> None:
        """Read a text."""
        for line in self.texts[source.key]:
            self.line(line)
            if self.errors >= LIMIT:
                break
        self.end()

    def line(self, line: Line) -> None:
        if self.opened is not None and line.is_blank:
            self.close()
        if line.end - line.start > LONGEST_LINE:
            self.too_long(line)
            return
        if not line.tokens:
            return
        heads, tokens = line.split()
        labels = tuple(map(_name, heads)) if heads else ()
        word = tokens[0].text.upper() if tokens else ""
        if word == _DEFINE:
            self.define(tokens)
            if labels:
                # The labels belong to the statement after the macro.
                self.statements.append(self.statement(line, labels, "", ()))
            return
        statement = self.statement(line, labels, word, tokens)
        (self.statements if self.opened is None else self.body).append(statement)
        if word == REQUIRE and not statement.broken and statement.word is not None:
            self.require(statement.word, statement.operands[0])

    def require(self, word: Name, file: Value | None) -> None:
        assert isinstance(file, Text)
        if self.opened is not None:
            message, help = "a macro cannot require a file", "require it before the macro"
            self.tell(problem("require-in-macro", message, word.span, help=help))
            return
        found = None if self.requirements is None else self.requirements.find(file)
        if isinstance(found, Diagnostic):
            self.tell(found)
        elif found is not None and self.requirements is not None:
            self.requirements.reading.append(found.key)
            self.read(found)
            self.requirements.reading.pop()

    def too_long(self, line: Line) -> None:
        span = Span(start=line.start + LONGEST_LINE, end=line.end)
        message = f"the line has {line.end - line.start} characters"
        help = f"a line can have at most {LONGEST_LINE} characters"
        self.tell(problem("line-too-long", message, span, help=help))
        broken = Statement(span.start, span.end, (), None, line.number, broken=True)
        (self.statements if self.opened is None else self.body).append(broken)

    def end(self) -> None:
        if self.opened is not None and self.errors < LIMIT:
            self.unterminated("the text ends inside the macro")
        self.close()

    def close(self) -> None:
        name = self.opened
        if name is not None and name.text not in self.macros and name.text not in INSTRUCTIONS:
            parameters = tuple(self.parameters.values())
            self.macros[name.text] = Macro(name=name, parameters=parameters, body=tuple(self.body))
        self.opened, self.parameters, self.body = None, {}, []

    def define(self, tokens: tuple[Token, ...]) -> None:
        if self.opened is not None:
            self.unterminated(
                f"{quoted(' '.join(t.text for t in tokens[:2]))} comes before the end of the macro"
            )
            self.close()
        if len(tokens) < 2 or tokens[1].kind is not NAME:
            at = tokens[1].span if len(tokens) > 1 else Span(start=tokens[0].end, end=tokens[0].end)
            message = "`DEFINE` needs the name of the macro"
            self.tell(problem("missing-operand", message, at, text="the name is expected here"))
            self.opened = Name(tokens[0].start, tokens[0].end, "")
            return
        name = Name(tokens[1].start, tokens[1].end, tokens[1].text.upper())
        if name.text in INSTRUCTIONS or name.text == "DEFINE":
            self.tell(problem("macro-name-taken", f"{quoted(name.text)} is an instruction", name.span))
        elif name.text in self.macros:
            first = Label(span=self.macros[name.text].name.span, text="first defined here")
            message = f"macro {quoted(name.text)} is defined twice"
            self.tell(problem("macro-twice", message, name.span, first))
        self.opened = name
        try:
            for token in separated(tokens[1:])[1:]:
                self.parameter(token)
        except Mistake as mistake:
            self.tell(mistake.diagnostic)

    def parameter(self, token: Token) -> None:
        """Add a parameter to the open macro. Raises Mistake if the token cannot be a parameter."""
        if token.kind is not NAME:
            said = "give numbers and vectors in the calls of the macro"
            message = f"a parameter must be a name, not {quoted(token.text)}"
            raise Mistake("wrong-operand", message, token.span, help=said)
        name = _name(token)
        is_taken = taken(name.text)
        if is_taken is not None:
            said = "write the instructions of a macro on the lines below"
            help = said if token.text.upper() in INSTRUCTIONS else None
            message = f"{is_taken}, so it cannot be a parameter"
            raise Mistake("parameter-name-taken", message, token.span, help=help)
        first = self.parameters.setdefault(name.text, name)
        if first is not name:
            message = f"parameter {quoted(name.text)} is named twice"
            there = Label(span=first.span, text="first here")
            self.tell(problem("parameter-twice", message, name.span, there))

    def unterminated(self, why: str) -> None:
        if self.opened is None or not self.opened.text:
            return
        message, help = f"macro {quoted(self.opened.text)} has no end", "end a macro with a blank line"
        self.tell(problem("unterminated-macro", message, self.opened.span, text=why, help=help))

    def statement(
        self, line: Line, labels: tuple[Name, ...], op: str, tokens: tuple[Token, ...]
    ) -> Statement:
        for label in labels:
            self.check_label(label)
        if not tokens:
            return Statement(line.tokens[0].start, line.end, labels, None, line.number)
        head, rest = tokens[0], tokens[1:]
        start, end = head.start, tokens[-1].end
        word = Name(start, head.end, op)
        if head.kind is not NAME:
            self.unreadable(head)
            return Statement(start, end, labels, None, line.number, broken=True)
        is_call = op not in INSTRUCTIONS
        kept = rest if self.parameters or is_call else ()
        definition = INSTRUCTIONS.get(op) or self.known.get(op)
        if definition is None:
            self.unknown(word, line, rest)
            return Statement(start, end, labels, word, line.number, broken=True)
        statement = Statement(start, end, labels, word, line.number, tokens=kept)
        if self.is_open(statement):
            return replace(statement, open=True)
        try:
            operands = read_operands(definition, head, rest)
        except Mistake as mistake:
            self.tell(mistake.diagnostic)
            # The name is kept, so that it is not reported as missing as well.
            named = tuple(_name(token) for token in rest[:1] if token.kind is NAME)
            return replace(statement, operands=named, broken=True)
        return statement if is_call else replace(statement, operands=operands)

    def is_open(self, statement: Statement) -> bool:
        """Return True if a line contains a parameter of the macro in which the line is."""
        if not self.parameters:
            return False
        names = {token.text for token in parameters_in(statement)} | {n for n, _ in braced_in(statement)}
        return not names.isdisjoint(self.parameters)

    def check_label(self, label: Name) -> None:
        there = self.parameters.get(label.text)
        if there is not None:
            message = f"label {quoted(label.text)} has the name of a parameter"
            parameter = Label(span=there.span, text="the parameter")
            self.tell(problem("parameter-name-taken", message, label.span, parameter))

    def unknown(self, word: Name, line: Line, rest: tuple[Token, ...]) -> None:
        """Report an unknown word, unless the word is the name of a macro whose head has an error."""
        if word.text in self.known:
            return
        if word.text in _CONSOLE_WORDS:
            alone = "a script needs no console commands"
            if rest and rest[0].text.upper() in INSTRUCTIONS:
                alone += f"; write only the instruction: {quoted(free_text(rest))}"
            message = f"`{word.text}` is a console command, not an instruction of a script"
            self.tell(problem("typed-word", message, word.span, help=alone))
            return
        written = line.split()[1][0].text
        message = f"there is no instruction {quoted(written)}"
        help, meant = self.meant(written, line, rest)
        self.tell(problem("unknown-instruction", message, word.span, help=help, meant=meant))

    def meant(self, written: str, line: Line, rest: tuple[Token, ...]) -> tuple[str | None, Meant | None]:
        """Find a hint for an unknown first word, and the text that was probably meant."""
        label = f"a label ends with a colon: `{written}:`"
        behind = rest[0].text.upper() if rest else ""
        if not rest and line.comment is not None and line.tokens[-1].end == line.end - len(line.comment):
            return f"{label}; a `;` begins a comment", MissingMark(":")
        if (help := elsewhere(written)) is not None:
            return help, None
        if behind not in self.known:
            names = alternatives(written, {*INSTRUCTIONS, *self.known, _DEFINE})
            if names is not None:
                return names_sentence(names), names
        if behind in INSTRUCTIONS or behind in self.known:
            return label, MissingMark(":")
        if behind.startswith("="):
            return "`ASSIGN` sets a counter, `TRANS` defines a position", None
        is_prose = sum(token.kind is NAME for token in rest) > 1
        return "a comment begins with `;`" if is_prose else None, None

    def unreadable(self, token: Token) -> None:
        message = f"a line starts with a label or an instruction, not with {quoted(token.text)}"
        code = "unexpected-character" if token.kind in (JUNK, MARK) else "unknown-instruction"
        self.tell(problem(code, message, token.span, help=strange(token.text)))

    def tell(self, diagnostic: Diagnostic) -> None:
        self.errors += diagnostic.severity == "error"
        self.diagnostics.append(diagnostic)


def _name(token: Token) -> Name:
    return Name(token.start, token.end, token.text)
