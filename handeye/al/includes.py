"""Reads scripts that consist of several files. A script requires texts directly, or through other required texts."""

import posixpath
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path, PurePath
from typing import Final

from handeye.al.instructions import INSTRUCTIONS
from handeye.al.operands import Mistake, read_operands
from handeye.al.scanner import scan
from handeye.al.syntax import Text
from handeye.core.diagnostics import Diagnostic, Label, problem, quoted
from handeye.core.errors import BadFile, InvalidInput
from handeye.core.source import LARGEST, Source, Span, read_source

REQUIRE: Final = "REQUIRE"
MAX_FILES: Final = 100  # limit on required files; their total size is limited to `LARGEST` characters
_LINE: Final = re.compile(rf"^.*\b{REQUIRE}\b.*$", re.ASCII | re.IGNORECASE | re.MULTILINE)

Read = Callable[[str], str]
"""Function that returns the text of a file. The argument is the key of the file: its path relative to the folder of
the main text. Raises InvalidInput if the file is unreadable.
"""


def read_script(path: str | Path) -> Source:
    """Read a text with all the texts that it requires. Missing files are reported when the text is compiled."""
    folder = Path(path).parent
    return sewn(read_source(path), lambda key: read_source(folder / key).text)


def sewn(source: Source, read: Read) -> Source:
    """Join a text with the readable texts that it requires, up to the limits `MAX_FILES` and `LARGEST`."""
    folder, own = PurePath(source.name).parent, own_key(source)
    required: dict[str, Source] = {}
    waiting = [(own, source.text)]
    size = len(source.text)
    while waiting:
        by, whole = waiting.pop(0)
        for file in required_by(whole):
            key = key_of(file.text, by)
            if key == own or key in required:
                continue
            if len(required) == MAX_FILES or size > LARGEST:
                return replace(source, required=tuple(required.values()))
            text, problem = "", ""
            try:
                text = read(key)
            except InvalidInput as error:
                problem = str(error)
            required[key] = Source(name=str(folder / key), key=key, text=text, problem=problem)
            size += len(text)
            waiting.append((key, text))
    return replace(source, required=tuple(required.values()))


def sewn_of(source: Source, files: Mapping[str, str]) -> Source:
    """Join a text with the texts that it requires. The required texts are taken only from `files`, which maps their
    keys to their contents.
    """

    def read(key: str) -> str:
        if key not in files:
            raise BadFile(f"{key}: there is no such file")
        return files[key]

    return sewn(source, read)


def own_key(source: Source) -> str:
    """Return the key of the main text."""
    return PurePath(source.name).name


def key_of(file: str, by: str) -> str:
    """Return the key of a file that the text `by` requires: its path from the folder of the main text."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(by), file))


def required_by(text: str) -> Iterator[Text]:
    """Yield the files that a text requires directly, in order."""
    for found in _LINE.finditer(text):
        for line in scan(found[0], found.start()):
            tokens = line.split()[1]
            if tokens and tokens[0].text.upper() == REQUIRE:
                try:
                    (file,) = read_operands(INSTRUCTIONS[REQUIRE], tokens[0], tokens[1:])
                except Mistake:
                    continue
                assert isinstance(file, Text)
                yield file


def led_by(source: Source, key: str) -> Span | None:
    """Find the REQUIRE in the main text that leads to a file, directly or through other files. Returns the span of
    this REQUIRE, or None if no REQUIRE leads to the file.
    """
    texts = {text.key: text.text for text in source.required}
    for file in required_by(source.text):
        waiting, seen = [key_of(file.text, own_key(source))], set[str]()
        while waiting:
            by = waiting.pop()
            if by == key:
                return file.span
            if by in texts and by not in seen:
                seen.add(by)
                waiting += [key_of(further.text, by) for further in required_by(texts[by])]
    return None


_MAX_SHOWN = 6


@dataclass(slots=True)
class Requirements:
    """Resolves the REQUIREs of a text one after another."""

    source: Source
    texts: dict[str, Source] = field(init=False)  # readable texts by key
    reading: list[str] = field(init=False)  # keys of the texts being read, outermost first
    first: dict[str, Span] = field(default_factory=dict)  # first REQUIRE of each text
    missing: bool = False  # a missing text has been reported

    def __post_init__(self) -> None:
        self.texts = {text.key: text for text in self.source.required}
        self.reading = [own_key(self.source)]

    def find(self, file: Text) -> Source | Diagnostic | None:
        """Return the text to read next, or a diagnostic. Returns None if the required texts are too many or too long,
        and an earlier diagnostic has already reported this.
        """
        key = key_of(file.text, self.reading[-1])
        found = self.texts.get(key)
        if key.lower().endswith(".toml"):
            help = "remove this line: handeye always reads the taught file that has the script's name"
            message = f"{quoted(file.text)} is a taught file, not a file of instructions"
            return problem("unreadable-file", message, file.span, help=help)
        if key in self.reading:
            return self._circle(key, file)
        if key in self.first:
            message = f"{quoted(file.text)} is already required above, so this line has no effect"
            first = Label(span=self.first[key], text="first required here")
            return problem("required-twice", message, file.span, first)
        deep = len(self.reading) > MAX_FILES  # possible only in a text that `sewn` did not make
        if found is not None and not found.problem and not deep:
            self.first[key] = file.span
            return found
        told, self.missing = self.missing, True
        if deep or (found is None and self.texts):
            message = (
                f"the script requires more than {MAX_FILES} files, or more than {LARGEST} characters in all"
            )
            return None if told else problem("too-much-required", message, file.span)
        message = f"{quoted(file.text)} cannot be read"
        if found is not None:
            slashed = file.text.replace("\\", "/")
            divided = None if slashed == file.text else f"separate folders with `/`: {quoted(slashed)}"
            return problem("unreadable-file", message, file.span, notes=(found.problem,), help=divided)
        notes = ("this text has not been saved as a file",)
        help = "save this text first: a path is relative to the folder of the file that requires it"
        return problem("unreadable-file", message, file.span, notes=notes, help=help)

    def _circle(self, key: str, file: Text) -> Diagnostic:
        around = [*self.reading[self.reading.index(key) :], key]
        if len(around) > _MAX_SHOWN:
            around[_MAX_SHOWN // 2 : -_MAX_SHOWN // 2] = ["…"]
        first, *others = (name if name == "…" else quoted(name) for name in around)
        notes = (f"{first} requires {', which requires '.join(others)}",) if len(others) > 1 else ()
        return problem("require-circle", f"{quoted(key)} requires itself", file.span, notes=notes)
