"""Reads the tokens of a line one by one. Raises an exception at a token that the grammar does not allow."""

from collections.abc import Callable
from typing import Final, NoReturn

from handeye.core.diagnostics import Diagnostic, quoted
from handeye.core.source import Span
from handeye.systems.sigma.mal.codes import mistake
from handeye.systems.sigma.mal.scanner import Token
from handeye.systems.sigma.mal.words import RESERVED, WORDS
from handeye.systems.sigma.protocol import LINE_AXES

DEEPEST: Final = 30


class Mistaken(Exception):
    """Raised if a line cannot be parsed."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(diagnostic.message)
        self.diagnostic = diagnostic


class TokenReader:
    """Reads the tokens after a line number."""

    def __init__(self, tokens: list[Token], whole: Span) -> None:
        self._tokens, self._at, self._depth = tokens, 0, 0
        self._end = Span(start=max(whole.start, whole.end - 1), end=whole.end)
        self._word = ""

    @property
    def _next(self) -> Token | None:
        return self._tokens[self._at] if self._at < len(self._tokens) else None

    def _take(self) -> Token:
        token = self._tokens[self._at]
        self._at += 1
        return token

    def _is(self, *texts: str) -> bool:
        token = self._next
        return token is not None and token.kind in ("mark", "name") and token.text in texts

    def _skip(self, *texts: str) -> bool:
        found = self._is(*texts)
        self._at += found
        return found

    def _wrong(self, wanted: str) -> NoReturn:
        token = self._next
        span = self._end if token is None else token.span
        found = "the line ends" if token is None else f"there is {quoted(token.text)}"
        usage = f"the form is `{WORDS[self._word].usage}`" if self._word in WORDS else None
        raise Mistaken(mistake("syntax", f"{wanted} is expected here, but {found}", span, help=usage))

    def _need(self, *texts: str) -> Token:
        if not self._is(*texts):
            self._wrong(" or ".join(f"`{text}`" for text in texts))
        return self._take()

    def _deeper(self) -> None:
        self._depth += 1
        if self._depth > DEEPEST:
            token = self._next
            told = f"the expression or statement is nested more than {DEEPEST} deep"
            raise Mistaken(mistake("too-deep", told, self._end if token is None else token.span))

    def _name(self, what: str) -> Token:
        token = self._next
        if token is None or token.kind != "name":
            self._wrong(what)
        if token.text in RESERVED:
            told = f"{quoted(token.text)} is a word of MAL and cannot be {what}"
            raise Mistaken(mistake("reserved-word", told, token.span))
        return self._take()

    def _one_of(self, known: tuple[str, ...], what: str) -> Token:
        token = self._next
        if token is None or token.kind != "name" or token.text not in known:
            self._wrong(f"{what} ({', '.join(known)})")
        return self._take()

    def _axis(self) -> Token:
        return self._one_of(LINE_AXES, "an axis")

    def _target(self) -> Token:
        token = self._next
        if token is None or token.kind != "number" or not token.text.isdigit():
            self._wrong("a line number")
        return self._take()

    def _listed(self, one: Callable[[], Token]) -> tuple[Token, ...]:
        found = [one()]
        while self._skip(","):
            found.append(one())
        return tuple(found)
