"""A script sewn of several files: the texts that it requires, and those that they require."""

import posixpath
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path, PurePath
from typing import Final

from handeye.al.instructions import INSTRUCTIONS
from handeye.al.operands import Mistake, read_operands
from handeye.al.scanner import scan
from handeye.al.syntax import Text
from handeye.core.errors import BadFile, InvalidInput
from handeye.core.source import LARGEST, Source, Span, read_source

REQUIRE: Final = "REQUIRE"
MOST: Final = 100
"""Files that one text can require, and `LARGEST` characters in all."""
_LINE: Final = re.compile(rf"^.*\b{REQUIRE}\b.*$", re.ASCII | re.IGNORECASE | re.MULTILINE)

Read = Callable[[str], str]
"""The text of a file by its key: its path from the folder of the text that all are required by.

Raises:
    InvalidInput: it cannot be read.
"""


def read_script(path: str | Path) -> Source:
    """The text in a file, with everything it requires.

    Raises:
        InvalidInput: the file cannot be read; a required one that cannot is told of when the text is compiled.
    """
    folder = Path(path).parent
    return sewn(read_source(path), lambda key: read_source(folder / key).text)


def sewn(source: Source, read: Read) -> Source:
    """A text with everything it requires, as far as that can be read; it ends soon after the bounds are passed."""
    folder, own = PurePath(source.name).parent, own_key(source)
    required: dict[str, Source] = {}
    waiting = [(own, source.text)]
    size = len(source.text)
    while waiting:
        by, text = waiting.pop(0)
        for file in required_by(text):
            key = key_of(file.text, by)
            if key == own or key in required:
                continue
            if len(required) == MOST or size > LARGEST:
                return replace(source, required=tuple(required.values()))
            required[key] = piece = _piece(str(folder / key), key, read)
            size += len(piece.text)
            waiting.append((key, piece.text))
    return replace(source, required=tuple(required.values()))


def sewn_of(source: Source, files: Mapping[str, str]) -> Source:
    """A text with what it requires of some files, by their keys; no other can be read."""

    def read(key: str) -> str:
        if key not in files:
            raise BadFile(f"{key}: there is no such file")
        return files[key]

    return sewn(source, read)


def own_key(source: Source) -> str:
    """Name of the text itself from its own folder."""
    return PurePath(source.name).name


def key_of(file: str, by: str) -> str:
    """Name of a file from the folder of the whole, when it is required by the text `by`."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(by), file))


def _piece(name: str, key: str, read: Read) -> Source:
    try:
        return Source(name=name, key=key, text=read(key))
    except InvalidInput as error:
        return Source(name=name, key=key, text="", problem=str(error))


def required_by(text: str) -> Iterator[Text]:
    """Files that a text itself requires, in its order."""
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
    """Where the text itself requires a file that is read, or leads to it."""
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
