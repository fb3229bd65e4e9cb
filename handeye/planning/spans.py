"""Where the words of a step stand in the text it was made from."""

import re

from handeye.program.operations import Move
from handeye.program.program import Step
from handeye.source import Source, Span


def word_span(whole: Source, step: Step, word: str) -> Span:
    """Where a word of a step stands: its instruction, what comes after that, or a modifier or its name above it.

    The whole line if it is not found; offsets are those of the whole text.
    """
    text = next(text for text in whole.texts if text.key == step.file)
    found = line = text.line_span(step.line)
    for searched in dict.fromkeys((step.text.split()[0], word)):
        rest = line if found == line else Span(start=found.end, end=line.end)
        found = _search(searched, text.text, rest) or found
    if word in ("STOP", "FORCE") or (isinstance(step.operation, Move) and word in step.operation.via):
        above = (text.line_span(number) for number in range(step.line - 1, 0, -1))
        found = next(filter(None, (_search(word, text.text, line) for line in above)), found)
    begin = whole.begins[step.file]
    return Span(start=begin + found.start, end=begin + found.end)


def _search(word: str, text: str, span: Span) -> Span | None:
    """A word in a piece of a text, however it is written."""
    match = re.compile(rf"(?<!\w){re.escape(word)}(?!\w)", re.IGNORECASE).search(text, span.start, span.end)
    return None if match is None else Span(start=match.start(), end=match.end())
