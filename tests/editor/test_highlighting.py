"""Colours: nothing that is part of the language is left plain, and what is not is marked."""

import json
import runpy
import tomllib
from pathlib import Path

import pytest
from pygments.token import Comment, Error, Keyword, Name, Number, String, Token, Whitespace, _TokenType
from textmate_reader import tokens

from handeye.al import INSTRUCTIONS
from handeye.al.highlight import ArmLexer

ROOT = Path(__file__).parents[2]
PUMP = (ROOT / "plans" / "water_pump.al").read_text(encoding="utf-8")
EXTENSION = ROOT / "editors" / "vscode"
MAKER = runpy.run_path(str(ROOT / "editors" / "make_grammar.py"))
grammar, grammar_text = MAKER["grammar"], MAKER["grammar_text"]


def lexed(text: str) -> list[tuple[_TokenType, str]]:
    return [(kind, piece) for kind, piece in ArmLexer().get_tokens(text) if kind is not Whitespace]


def coloured(text: str) -> list[tuple[str, str]]:
    found = ((piece.strip(), scope.removesuffix(".armal")) for piece, scope in tokens(grammar(), text))
    return [(piece, scope) for piece, scope in found if piece]


def test_the_lexer_leaves_nothing_of_the_pump_script_plain() -> None:
    kinds = {kind for kind, _ in lexed(PUMP)}
    assert not kinds & {Token, Token.Text, Error}
    assert {Comment.Single, Keyword, Keyword.Type, Name.Label, Number.Float, String.Double} <= kinds


def test_the_lexer_loses_no_character() -> None:
    assert "".join(piece for _, piece in ArmLexer(ensurenl=False, stripnl=False).get_tokens(PUMP)) == PUMP


@pytest.mark.parametrize("op", INSTRUCTIONS)
def test_every_instruction_is_a_keyword_in_capitals_or_not(op: str) -> None:
    for word in (op, op.lower()):
        kind, piece = lexed(word)[0]
        assert (kind in Keyword, piece) == (True, word)
        piece, scope = coloured(word)[0]
        assert (scope.split(".")[0] in ("keyword", "storage"), piece) == (True, word)


def test_names_that_are_words_of_the_language_are_names_where_they_stand_as_names() -> None:
    assert lexed("MOVE OPEN")[1] == (Name.Variable, "OPEN")
    assert coloured("MOVE OPEN")[1] == ("OPEN", "variable.other")


def test_labels_jumps_macros_and_messages_have_their_own_colours() -> None:
    text = "L1: JUMP L1 ;on\nDEFINE GRASP\nGRASP\nWAIT no pin ;help"
    assert lexed(text)[0] == (Name.Label, "L1")
    assert [kind for kind, piece in lexed(text) if piece in ("GRASP", "no pin")] == [
        Name.Function, Name.Function, String,
    ]  # fmt: skip
    assert [scope for piece, scope in coloured(text) if piece == "L1"] == ["entity.name.label"] * 2
    assert [scope for piece, scope in coloured(text) if piece == "GRASP"] == ["entity.name.function"] * 2
    assert coloured(text)[-2:] == [("pin", "string.unquoted"), (";help", "comment.line.semicolon")]


def test_parameters_have_a_colour_in_the_head_and_in_texts() -> None:
    text = 'DEFINE A S,G ;on\nWAIT NO {S} at {\nSTAGE "{S} {" 1\nMOVE T'
    assert [piece for kind, piece in lexed(text) if kind is String.Interpol] == ["{S}"] * 2
    assert [piece for kind, piece in lexed(text) if kind is Name.Variable] == ["S", "G", "T"]
    assert [piece for piece, scope in coloured(text) if scope == "variable.parameter"] == [
        "S",
        "G",
        "{S}",
        "{S}",
    ]
    assert not [piece for piece, scope in coloured(text) if scope.startswith("invalid") or not scope]


def test_the_label_of_a_jump_is_the_last_name_of_its_line() -> None:
    text = "AOJ TRIES,L1 ;on"
    assert [kind for kind, _ in lexed(text)][1:4] == [Name.Variable, Token.Punctuation, Name.Label]
    assert [scope for _, scope in coloured(text)][1:4] == [
        "variable.other", "punctuation.section.vector", "entity.name.label",
    ]  # fmt: skip


def test_what_is_no_part_of_the_language_is_marked() -> None:
    assert (Error, "=") in lexed("OPEN = 1")
    assert ("=", "invalid.illegal") in coloured("OPEN = 1")


def test_the_grammar_leaves_nothing_of_the_pump_script_plain() -> None:
    found = coloured(PUMP)
    assert [piece for piece, scope in found if not scope] == []
    assert [piece for piece, scope in found if scope.startswith("invalid")] == []


def test_the_extension_holds_the_grammar_of_this_table_of_instructions() -> None:
    # If not: python editors/make_grammar.py > editors/vscode/syntaxes/armal.tmLanguage.json
    held = (EXTENSION / "syntaxes" / "armal.tmLanguage.json").read_text(encoding="utf-8")
    assert held == grammar_text()


def test_every_file_the_extension_names_is_there() -> None:
    package = json.loads((EXTENSION / "package.json").read_text(encoding="utf-8"))
    (language,), (colours,) = package["contributes"]["languages"], package["contributes"]["grammars"]
    named = [package["main"], language["configuration"], colours["path"]]
    assert [name for name in named if not (EXTENSION / name).is_file()] == []
    assert json.loads((EXTENSION / language["configuration"]).read_text(encoding="utf-8"))["comments"]
    assert colours["scopeName"] == grammar()["scopeName"]


def test_the_lexer_is_registered_for_pygments() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project["entry-points"]["pygments.lexers"] == {"armal": "handeye.al.highlight:ArmLexer"}
