"""As much of a TextMate grammar's reader as our grammar needs: one line after the other.

At each place the pattern that matches first wins, and of several the one that stands first. A rule with `begin` holds
until its `end`.
"""

import re
from collections.abc import Iterator
from typing import Any

Token = tuple[str, str]
"""A piece of text, and the name of its scope; empty: plain."""


def tokens(grammar: dict[str, Any], text: str) -> Iterator[Token]:
    for line in text.split("\n"):
        yield from _Line(grammar, line).tokens()


class _Line:
    def __init__(self, grammar: dict[str, Any], line: str) -> None:
        self.grammar, self.line, self.at = grammar, line, 0

    def tokens(self) -> Iterator[Token]:
        yield from self.within(self.grammar["patterns"], None)

    def within(self, patterns: list[dict[str, Any]], end: str | None) -> Iterator[Token]:
        while True:
            found = [(m, rule) for rule in self.flat(patterns) if (m := self.search(rule)) is not None]
            match, rule = min(found, key=lambda f: f[0].start(), default=(None, None))
            ends = re.compile(end).search(self.line, self.at) if end is not None else None
            if ends is not None and (match is None or ends.start() <= match.start()):
                yield from self.plain(ends.start())
                return
            if match is None or rule is None:
                yield from self.plain(len(self.line))
                return
            yield from self.plain(match.start())
            yield from self.matched(match, rule)
            if "begin" in rule:
                yield from self.within(rule["patterns"], rule["end"])
                yield from self.ended(rule)

    def flat(self, patterns: list[dict[str, Any]]) -> Iterator[dict[str, Any]]:
        for rule in patterns:
            if "include" in rule:
                included = self.grammar["repository"][rule["include"].removeprefix("#")]
                yield from self.flat(included.get("patterns", [included]))
            else:
                yield rule

    def search(self, rule: dict[str, Any]) -> re.Match[str] | None:
        match = re.compile(rule.get("match") or rule["begin"], re.ASCII).search(self.line, self.at)
        return match if match is not None and match.end() > match.start() else None

    def matched(self, match: re.Match[str], rule: dict[str, Any]) -> Iterator[Token]:
        captures = rule.get("captures") or rule.get("beginCaptures") or {}
        if "name" in rule:
            yield match[0], rule["name"]
            self.at = match.end()
        for number, capture in captures.items():
            if match[int(number)] is not None:
                yield from self.plain(match.start(int(number)))
                yield match[int(number)], capture["name"]
                self.at = match.end(int(number))
        yield from self.plain(match.end())

    def ended(self, rule: dict[str, Any]) -> Iterator[Token]:
        match = re.compile(rule["end"]).match(self.line, self.at)
        if match is not None and match[0]:
            yield match[0], rule["endCaptures"]["0"]["name"]
            self.at = match.end()

    def plain(self, end: int) -> Iterator[Token]:
        if end > self.at:
            yield self.line[self.at : end], ""
        self.at = max(self.at, end)
