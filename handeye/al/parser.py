"""Text to syntax tree: one diagnostic for a mistake, then on to the next line."""

from dataclasses import dataclass, field
from typing import Final

from handeye.al.hints import elsewhere, strange
from handeye.al.includes import REQUIRE
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.operands import Mistake, free_text, read_operands
from handeye.al.requirements import Requirements
from handeye.al.scanner import JUNK, MARK, NAME, Line, Token, scan
from handeye.al.syntax import Macro, Name, Script, Statement, Text, Value
from handeye.diagnostics import (
    LIMIT,
    Diagnostic,
    Label,
    Meant,
    MissingMark,
    alternatives,
    quoted,
    told_names,
)
from handeye.source import Source, Span

_DEFINE: Final = "DEFINE"
_TYPED: Final = ("DO", "GO")
"""Words of the console: they have an instruction, or the program, carried out."""

LONGEST_LINE: Final = 1000
"""Characters. Steps, plans and traces repeat the line they come from, for each call of a macro."""


def parse(text: str) -> tuple[Script, list[Diagnostic]]:
    """The tree of a text alone and what is wrong with its form; reading ends after `LIMIT` mistakes."""
    return _parsed(Source(name="", text=text), None)


def parse_whole(source: Source) -> tuple[Script, list[Diagnostic]]:
    """The tree of a text, that of a required one where it is required, and what is wrong with their form."""
    return _parsed(source, Requirements(source))


def _parsed(source: Source, requirements: Requirements | None) -> tuple[Script, list[Diagnostic]]:
    texts = {text.key: scan(text.text, source.begins[text.key]) for text in source.texts}
    defining = (text.key for text in source.texts if _DEFINE in text.text.upper())
    names = {name for key in defining for name in _macro_names(texts[key])}
    parser = _Parser(texts=texts, macro_names=names, requirements=requirements)
    parser.read(source)
    return Script(statements=tuple(parser.statements), macros=parser.macros), parser.diagnostics


def _macro_names(lines: list[Line]) -> set[str]:
    """Names of macros, known before they are defined, so that a call may stand first."""
    found = set()
    for line in lines:
        tokens = line.split()[1]
        if len(tokens) > 1 and tokens[0].text.upper() == _DEFINE and tokens[1].kind is NAME:
            found.add(tokens[1].text.upper())
    return found


@dataclass(slots=True)
class _Parser:
    texts: dict[str, list[Line]]
    macro_names: set[str]
    requirements: Requirements | None
    """None: what is required is not read."""
    errors: int = 0
    statements: list[Statement] = field(default_factory=list)
    macros: dict[str, Macro] = field(default_factory=dict)
    diagnostics: list[Diagnostic] = field(default_factory=list)
    opened: Name | None = None
    """The macro whose body is being read."""
    body: list[Statement] = field(default_factory=list)

    def read(self, source: Source) -> None:
        """A text from its beginning to its end."""
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
                # They belong to what follows the macro.
                self.statements.append(self.statement(line, labels, "", ()))
            return
        statement = self.statement(line, labels, word, tokens)
        (self.statements if self.opened is None else self.body).append(statement)
        if word == REQUIRE and not statement.broken and statement.word is not None:
            self.require(statement.word, statement.operands[0])

    def require(self, word: Name, file: Value | None) -> None:
        assert isinstance(file, Text)
        if self.opened is not None:
            self.report(
                "require-in-macro",
                "a macro cannot require a file",
                word.span,
                help="require it before the macro",
            )
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
        self.report("line-too-long", message, span, help=f"a line has at most {LONGEST_LINE}")
        broken = Statement(span.start, span.end, (), None, line.number, broken=True)
        (self.statements if self.opened is None else self.body).append(broken)

    def end(self) -> None:
        if self.opened is not None and self.errors < LIMIT:
            self.unterminated("the text ends before the macro")
        self.close()

    def close(self) -> None:
        name = self.opened
        if name is not None and name.text not in self.macros and name.text not in INSTRUCTIONS:
            self.macros[name.text] = Macro(name=name, body=tuple(self.body))
        self.opened, self.body = None, []

    def define(self, tokens: tuple[Token, ...]) -> None:
        if self.opened is not None:
            self.unterminated(f"line {quoted(' '.join(t.text for t in tokens[:2]))} comes before its end")
            self.close()
        if len(tokens) < 2 or tokens[1].kind is not NAME:
            at = tokens[1].span if len(tokens) > 1 else _behind(tokens[0])
            self.report(
                "missing-operand", "`DEFINE` needs the name of the macro", at, "the name is expected here"
            )
            self.opened = Name(tokens[0].start, tokens[0].end, "")
            return
        name = Name(tokens[1].start, tokens[1].end, tokens[1].text.upper())
        if len(tokens) > 2:
            self.beyond(name, tokens[2:])
        elif name.text in INSTRUCTIONS or name.text == "DEFINE":
            self.report("macro-name-taken", f"{quoted(name.text)} is an instruction", name.span)
        elif name.text in self.macros:
            first = Label(span=self.macros[name.text].name.span, text="first defined here")
            self.report(
                "macro-twice", f"macro {quoted(name.text)} is defined twice", name.span, secondary=(first,)
            )
        self.opened = name

    def beyond(self, name: Name, rest: tuple[Token, ...]) -> None:
        """More than a name behind a DEFINE: an instruction, or arguments."""
        message, help = f"macro {quoted(name.text)} can have no arguments", "write a macro for each use of it"
        if rest[0].text.upper() in INSTRUCTIONS:
            message = "`DEFINE` takes a name only"
            help = "write the instructions of a macro on the lines below"
        span = Span(start=rest[0].start, end=rest[-1].end)
        self.report("too-many-operands", message, span, help=help)

    def unterminated(self, why: str) -> None:
        if self.opened is None or not self.opened.text:
            return
        self.report(
            "unterminated-macro",
            f"macro {quoted(self.opened.text)} has no end",
            self.opened.span,
            why,
            help="end a macro with a blank line",
        )

    def statement(
        self, line: Line, labels: tuple[Name, ...], said: str, tokens: tuple[Token, ...]
    ) -> Statement:
        if not tokens:
            return Statement(line.tokens[0].start, line.end, labels, None, line.number)
        head, rest = tokens[0], tokens[1:]
        start, end = head.start, tokens[-1].end
        word = Name(start, head.end, said)
        if head.kind is not NAME:
            self.unreadable(head)
            return Statement(start, end, labels, None, line.number, broken=True)
        definition = INSTRUCTIONS.get(said)
        if definition is None:
            is_call = self.is_call(word, line, rest)
            return Statement(start, end, labels, word, line.number, broken=not is_call)
        try:
            operands = read_operands(definition, head, rest)
        except Mistake as mistake:
            self.tell(mistake.diagnostic)
            # What it would have named is not missing as well.
            named = tuple(_name(token) for token in rest[:1] if token.kind is NAME)
            return Statement(start, end, labels, word, line.number, named, broken=True)
        return Statement(start, end, labels, word, line.number, operands)

    def is_call(self, word: Name, line: Line, rest: tuple[Token, ...]) -> bool:
        if word.text in self.macro_names:
            if rest:
                extra = Span(start=rest[0].start, end=rest[-1].end)
                self.report("too-many-operands", f"macro {quoted(word.text)} takes no operands", extra)
            return not rest
        if word.text in _TYPED:
            self.report(
                "typed-word",
                f"`{word.text}` is a console command, not an instruction of a script",
                word.span,
                help=_alone(rest),
            )
            return False
        written = line.split()[1][0].text
        message = f"there is no instruction {quoted(written)}"
        help, meant = self.meant(written, line, rest)
        self.report("unknown-instruction", message, word.span, help=help, meant=meant)
        return False

    def meant(self, written: str, line: Line, rest: tuple[Token, ...]) -> tuple[str | None, Meant | None]:
        """Help where a line begins with a word that is neither an instruction nor a macro, and what may be meant."""
        label = f"a label ends with a colon: `{written}:`"
        behind = rest[0].text.upper() if rest else ""
        if not rest and line.comment is not None and line.tokens[-1].end == line.end - len(line.comment):
            return f"{label}; a `;` begins a comment", MissingMark(":")
        if (help := elsewhere(written)) is not None:
            return help, None
        if behind not in self.macro_names:
            names = alternatives(written, {*INSTRUCTIONS, *self.macro_names, _DEFINE})
            if names is not None:
                return told_names(names), names
        if behind in INSTRUCTIONS or behind in self.macro_names:
            return label, MissingMark(":")
        if behind.startswith("="):
            return "`ASSIGN` sets a counter, `TRANS` defines a position", None
        is_prose = sum(token.kind is NAME for token in rest) > 1
        return "a comment begins with `;`" if is_prose else None, None

    def unreadable(self, token: Token) -> None:
        message = f"a line starts with a label or an instruction, not with {quoted(token.text)}"
        code = "unexpected-character" if token.kind in (JUNK, MARK) else "unknown-instruction"
        self.report(code, message, token.span, help=strange(token.text))

    def report(
        self,
        code: str,
        message: str,
        span: Span,
        text: str = "",
        *,
        help: str | None = None,
        secondary: tuple[Label, ...] = (),
        meant: Meant | None = None,
    ) -> None:
        primary = Label(span=span, text=text)
        self.tell(
            Diagnostic(
                code=code, message=message, primary=primary, help=help, secondary=secondary, meant=meant
            )
        )

    def tell(self, diagnostic: Diagnostic) -> None:
        self.errors += diagnostic.severity == "error"
        self.diagnostics.append(diagnostic)


def _name(token: Token) -> Name:
    return Name(token.start, token.end, token.text)


def _alone(rest: tuple[Token, ...]) -> str:
    """Help to write something instead of having these words done."""
    help = "a script is carried out as a whole"
    if not rest or rest[0].text.upper() not in INSTRUCTIONS:
        return help
    return f"{help}; write the instruction alone: {quoted(free_text(rest))}"


def _behind(token: Token) -> Span:
    return Span(start=token.end, end=token.end)
