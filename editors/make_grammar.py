"""The grammar that colours arm programs in VS Code and similar editors, made from the table of instructions.

`python editors/make_grammar.py` prints it; `editors/vscode/syntaxes/armal.tmLanguage.json` holds it.
"""

import json
import sys
from collections.abc import Iterable
from typing import Final

from handeye.al.instructions import FREE_TEXT, JUMPS, MODIFIERS, OPERAND_WORDS, OTHERS

_NAME: Final = r"[A-Za-z_]\w*"
_NUMBER: Final = r"(?<![\w.])[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?(?![\w.])"
Rule = dict[str, object]


def grammar() -> Rule:
    """The grammar as data."""
    return {
        "name": "Arm language",
        "scopeName": "source.armal",
        "patterns": [
            {"include": "#comment"},
            _match(
                rf"({_NAME})\s*(:)",
                {"1": "entity.name.label.armal", "2": "punctuation.separator.label.armal"},
            ),
            _begun(
                rf"(?i:\b(DEFINE)\b)(?:\s+({_NAME}))?",
                {"1": "keyword.other.define.armal", "2": "entity.name.function.armal"},
                [_match(rf"\b({_NAME})", {"1": "variable.parameter.armal"}), {"include": "#operands"}],
            ),
            _line(_word(FREE_TEXT), "keyword.control.armal", _ANY_WORDS),
            _line(_word(JUMPS), "keyword.control.armal", [_LABEL, {"include": "#operands"}]),
            _line(_word(MODIFIERS), "storage.modifier.armal", [{"include": "#operands"}]),
            _line(_word(OTHERS), "keyword.other.armal", [{"include": "#operands"}]),
            _line(rf"\b({_NAME})", "entity.name.function.armal", [{"include": "#operands"}]),
        ],
        "repository": {
            "comment": {"name": "comment.line.semicolon.armal", "match": ";.*$"},
            "operands": {"patterns": _operands()},
        },
    }


def _match(pattern: str, names: dict[str, str]) -> Rule:
    captures = {number: {"name": name} for number, name in names.items()}
    return {"match": pattern, "captures": captures}


def _line(begin: str, name: str, patterns: Iterable[Rule]) -> Rule:
    """An instruction and its operands, up to the comment or the end of the line."""
    return _begun(begin, {"1": name}, patterns)


def _begun(begin: str, names: dict[str, str], patterns: Iterable[Rule]) -> Rule:
    """What follows some words, up to the comment or the end of the line."""
    return {
        "begin": begin,
        "beginCaptures": {number: {"name": name} for number, name in names.items()},
        "end": "(?=;)|$",
        "patterns": list(patterns),
    }


def _word(words: Iterable[str]) -> str:
    return rf"(?i:\b({'|'.join(words)})\b)"


_PARAMETER: Final[Rule] = {"name": "variable.parameter.armal", "match": rf"\{{{_NAME}\}}"}
_STRING: Final[Rule] = {
    "begin": '"',
    "beginCaptures": {"0": {"name": "string.quoted.double.armal"}},
    "end": '"|$',
    "endCaptures": {"0": {"name": "string.quoted.double.armal"}},
    "patterns": [_PARAMETER, {"name": "string.quoted.double.armal", "match": r'[^"{]+|\{'}],
}
_LABEL: Final[Rule] = _match(rf"\b({_NAME})\s*(?=;|$)", {"1": "entity.name.label.armal"})
_ANY_WORDS: Final[list[Rule]] = [
    _STRING,
    _PARAMETER,
    {"name": "string.unquoted.armal", "match": r'[^\s;"{]+|\{'},
]


def _operands() -> list[Rule]:
    return [
        _STRING,
        {"name": "constant.numeric.armal", "match": _NUMBER},
        {"name": "punctuation.section.vector.armal", "match": r"[\[\],]"},
        _match(_word(OPERAND_WORDS), {"1": "keyword.operator.word.armal"}),
        {"name": "variable.other.armal", "match": rf"\b{_NAME}"},
        {"name": "invalid.illegal.armal", "match": r"\S"},
    ]


def grammar_text() -> str:
    """The grammar as the file holds it."""
    return json.dumps(grammar(), indent=2) + "\n"


if __name__ == "__main__":
    sys.stdout.write(grammar_text())
