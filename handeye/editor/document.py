"""A script in an editor: its text, its taught file, and the results computed from them."""

from collections.abc import Collection
from dataclasses import dataclass, field
from functools import cached_property

from handeye.al.compiler import compile_text
from handeye.al.includes import Read, sewn
from handeye.al.lower_statement import position
from handeye.al.macros import as_called, expand
from handeye.al.parser import parse_whole
from handeye.al.scanner import Line, scan
from handeye.core.diagnostics import Diagnostic
from handeye.core.source import Source, Span
from handeye.editor.macro_bodies import MacroBody, macros_of
from handeye.editor.occurrences import PART, POSITION, Occurrence, occurrences, taught_occurrences
from handeye.program.program import Position, Program
from handeye.program.taught import Taught


@dataclass(frozen=True, kw_only=True)
class Document:
    """A script. An offset is the number of characters from the start of the script's text. All results are computed
    when they are needed.
    """

    source: Source
    taught: Taught = field(default_factory=Taught)
    taught_text: str = ""  # text of the taught file; empty if there is no such file
    read: Read | None = None  # reads required texts; None if they are not read

    @property
    def text(self) -> str:
        return self.source.text

    @cached_property
    def whole(self) -> Source:
        """The script together with all texts that it requires."""
        return self.source if self.read is None else sewn(self.source, self.read)

    @cached_property
    def lines(self) -> list[Line]:
        """The lines of the script, divided into tokens."""
        return scan(self.text)

    @cached_property
    def macros(self) -> dict[str, MacroBody]:
        """The macros of the script and of the texts that it requires, by name."""
        required = [macros_of(text.text) for text in self.whole.required]
        return {word: macro for each in (*required, self._own_macros) for word, macro in each.items()}

    @cached_property
    def _own_macros(self) -> dict[str, MacroBody]:
        return macros_of(self.text)

    @cached_property
    def names(self) -> list[Occurrence]:
        """Occurrences of names in the script."""
        return occurrences(self.text, self.taught.parts, self.macros)

    @cached_property
    def required_names(self) -> list[tuple[Source, Occurrence]]:
        """Occurrences of names in the required texts. Each occurrence comes with the text that contains it, and its
        span is in offsets within this text.
        """
        parts = self.taught.parts
        return [(text, o) for text in self.whole.required for o in occurrences(text.text, parts, self.macros)]

    @cached_property
    def taught_names(self) -> list[Occurrence]:
        """Occurrences of names in the taught file. Spans are offsets in that file."""
        return taught_occurrences(self.taught_text)

    @cached_property
    def compiled(self) -> tuple[Program | None, list[Diagnostic]]:
        """The program and the diagnostics. The program is None if the script has errors."""
        return compile_text(self.whole, self.taught)

    @cached_property
    def positions(self) -> dict[str, Position]:
        """Hand positions by name: those in the taught file, and those written on error-free lines of the
        script."""
        script = parse_whole(self.whole)[0]
        statements = as_called(script, expand(script, lambda _: None))
        written = [s for s in statements if s.word is not None and s.word.text == "TRANS"]
        return {**self.taught.positions, **dict(position(s) for s in written if not s.broken)}

    def taught_of(self, kind: str) -> Collection[str]:
        """Return the names of one kind in the taught file."""
        if kind == POSITION:
            return self.taught.positions.keys()
        return self.taught.parts.keys() if kind == PART else ()

    def macro_at(self, offset: int) -> MacroBody | None:
        """Return the macro in whose lines an offset lies, or None if the offset is not in a macro of the script."""
        line = self.line_at(offset)
        return next((macro for macro in self._own_macros.values() if line in macro.lines), None)

    def line_at(self, offset: int) -> Line | None:
        """Return the line that contains an offset, or None after the last line."""
        number = self.source.position(offset)[0]
        return self.lines[number - 1] if number <= len(self.lines) else None

    def line_of(self, offset: int) -> Line:
        """Return the line that contains an offset. The offset must be in the text."""
        line = self.line_at(offset)
        assert line is not None
        return line

    def name_at(self, offset: int) -> Occurrence | None:
        """Return the name that contains an offset or ends just before it. Returns None if there is no such name."""
        return next((name for name in self.names if name.span.start <= offset <= name.span.end), None)

    def whole_line(self, number: int) -> Span:
        """Return the span of a line, including its line end."""
        return Span(start=self._start(number), end=self._start(number + 1))

    def _start(self, number: int) -> int:
        return self.lines[number - 1].start if number <= len(self.lines) else len(self.text)
