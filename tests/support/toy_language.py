"""The counter machine's files: lines in the order of execution. The lines after `TASK NAME` are those of a task."""

from typing import Final

from toy_system import Line, Lines

from handeye.core.diagnostics import Diagnostic, problem
from handeye.core.errors import BadFile
from handeye.core.source import Source, Span
from handeye.program.language import OwnLanguage

WORDS: Final = {
    "ADD": "add a number to a register",
    "JUMP": "go to a label while a register is positive",
    "CALL": "call the operator",
    "TELL": "tell what a register holds",
    "WAIT": "wait until a register holds a number",
    "TASK": "the lines behind it are those of a task",
}


class ToyLanguage(OwnLanguage):
    """Lines of the counter machine."""

    system = "toy"

    def check(self, source: Source) -> list[Diagnostic]:
        found, start = [], 0
        for line in source.text.split("\n"):
            words = line.rpartition(": ")[2].split()
            if words and words[0] not in WORDS:
                span = Span(start=start, end=start + len(line))
                told = f"`{words[0]}` is no line of the counter machine"
                found.append(problem("toy-line", told, span, own="error"))
            start += len(line) + 1
        return found

    def formatted(self, text: str) -> str:
        return "".join(f"{' '.join(line.split())}\n" for line in text.splitlines())

    def explanation(self, word: str) -> str | None:
        return {**WORDS, "toy-line": "a line begins with a word that the machine does not know"}.get(word)

    def words(self, source: Source, offset: int) -> list[tuple[str, str]]:
        return [*WORDS.items()]


LANGUAGE = ToyLanguage()


def compiled(source: Source) -> Lines:
    """The program of a text."""
    if LANGUAGE.check(source):
        raise BadFile(f"{source.name} has errors; `handeye check {source.name}` tells them")
    texts, tasks, labels = list[tuple[int, str]](), dict[str, int](), dict[str, int]()
    for number, line in enumerate(source.text.splitlines(), 1):
        label, _, text = line.rpartition(": ")
        if text.startswith("TASK "):
            tasks[text.split()[1]] = len(texts)
        elif text.strip():
            labels |= {label: len(texts)} if label else {}
            texts.append((number, text))
    begins = {*tasks.values(), len(texts)}
    named = {number: label for label, number in labels.items()}
    steps = tuple(
        Line(stage=0, line=line, text=text, label=named.get(number, ""), ways=_ways(number, text, begins, labels))
        for number, (line, text) in enumerate(texts)
    )  # fmt: skip
    return Lines(steps=steps, tasks=tasks)


def _ways(number: int, text: str, begins: set[int], labels: dict[str, int]) -> tuple[int | None, ...]:
    onward = None if number + 1 in begins else number + 1
    return (onward, labels[text.split()[2]]) if text.startswith("JUMP") else (onward,)
