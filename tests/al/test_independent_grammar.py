"""The parser against a grammar that was written from the manual: both take the same texts for arm programs."""

import re
from functools import cache
from pathlib import Path

import lark
import pytest
from any_texts import CORPUS, programs, spoiled
from hypothesis import given

from handeye.al.instructions import INSTRUCTIONS
from handeye.al.parser import parse

LINE = re.compile(r'((?:[ \t\r\f\v]*[A-Za-z_]\w*[ \t\r\f\v]*:)*)((?:[^;"]|"[^"]*"?)*)(.*)', re.ASCII)
"""Labels, what is said, and a comment."""
DEFINES = re.compile(r"[ \t\r\f\v]*DEFINE\b", re.ASCII | re.IGNORECASE)
WORD = re.compile(r"(?<![\w.])[A-Za-z_]\w*", re.ASCII)
BLANKS = " \t\r\f\v"
HERE = Path(__file__).parent
SIZES = {"line-too-long", "number-out-of-range", "unknown-lens", "zero-vector"}
"""What the parser says of what is written as it should be, but for its size."""


@cache
def grammar() -> lark.Lark:
    """The grammar; made once it is wanted, which takes a second."""
    return lark.Lark((HERE / "arm_language.lark").read_text(encoding="utf-8"), parser="lalr")


def without_open_lines(text: str) -> str:
    """The text without what a parameter stands in, of which only a call tells what it is."""
    out, parameters = [], set[str]()
    for line in text.split("\n"):
        labels, said, comment = LINE.fullmatch(line).groups()
        if DEFINES.match(said):
            parameters = {*re.findall(r"[A-Za-z_]\w*", said, re.ASCII)[2:]}
        elif not line.strip(BLANKS):
            parameters = set()
        elif not parameters.isdisjoint(re.findall(r"\{([A-Za-z_]\w*)\}", said, re.ASCII)) or (
            re.split(r"\W", said.strip(BLANKS), maxsplit=1, flags=re.ASCII)[0].upper()
            not in ("WAIT", "REQUIRE")
            and not parameters.isdisjoint(WORD.findall(re.sub(r'"[^"]*"?', '""', said))[1:])
        ):
            said = " PARK "
        mark = (
            "" if parameters.isdisjoint(WORD.findall(labels)) else "?"
        )  # no label has the name of a parameter
        out.append(mark + labels + said + comment)
    return "\n".join(out)


def is_program(text: str) -> bool:
    """What the grammar says, and the rules that no such grammar can have."""
    text = without_open_lines(text)
    try:
        tree = grammar().parse(text + "\n" * (text[-1:] not in ("\n", "")))
    except lark.UnexpectedInput:
        return False
    heads = [[str(name) for name in head.children] for head in tree.find_data("head")]
    macros = [name.upper() for name, *_ in heads]
    takes = {name.upper(): len(parameters) for name, *parameters in heads}
    named = {name for _, *parameters in heads for name in parameters}
    calls = [
        (str(word).upper(), [g for g in given if g])
        for word, *given in (c.children for c in tree.find_data("call"))
    ]
    axes = [
        (float(count), letters) for count, *letters in (found.children for found in tree.find_data("axes"))
    ]
    return (
        len(set(macros)) == len(macros)
        and all(takes.get(word) == len(given) for word, given in calls)
        and all(len({*parameters}) == len(parameters) for _, *parameters in heads)
        and not {*INSTRUCTIONS, "DEFINE", "ALONG", "DIRECT", "HOLD", "LEVEL", "NIL", "OF", "STEPS", "TIMES"}
        & {name.upper() for name in named}
        and not {"X", "Y", "Z"} & named
        and not any([*macro.find_data("require")] for macro in tree.find_data("macro"))
        and not {*INSTRUCTIONS, "DEFINE"} & set(macros)
        and all(some.children[0].upper() != "NIL" for some in tree.find_data("some"))
        and all(float(whole.children[0]).is_integer() for whole in tree.find_data("whole"))
        and all(count == len(letters) == len({*letters} & {"X", "Y", "Z"}) for count, letters in axes)
    )


def assert_agreed(text: str) -> None:
    mistakes = {diagnostic.code for diagnostic in parse(text)[1]}
    if mistakes <= SIZES and mistakes:
        return  # a reader that stops at the first mistake of a line leaves open what its form is
    assert is_program(text) == (not mistakes), mistakes


PROBES = {
    "MOVE T direct": True,
    "move T": True,
    "MOVE OPEN": True,
    "MOVE, T": False,
    "MOVE T, DIRECT": True,
    "MOVE OF": True,
    "GENERAL A, OF": True,
    "SOJG N,NIL": True,
    "INSPECT A HOLD, LEVEL": True,
    "L :M: PARK": True,
    "OPEN: PARK": True,
    "L:\nPARK": True,
    "1: PARK": False,
    "OPEN 1e0": True,
    "OPEN 1e": False,
    "OPEN 1.": True,
    "OPEN .": False,
    "OPEN --1": False,
    "OPEN 1_0": False,
    "SKIPE 2.5": False,
    "SKIPE 2.0": True,
    "CHANGE[0 0 1]1": True,
    "CHANGE [0,0,1],1": True,
    "CHANGE [0 0 1,] 1": False,
    "CHANGE Z 1 0 0": True,
    "CHANGE Z 1 0 NIL": False,
    "CHANGE [[0 0 1]] 1": False,
    "STOP NIL [5 0 0]": True,
    "STOP 50 NIL": True,
    "STOP NIL NIL": False,
    "STOP NIL": False,
    "FORCE F,M": True,
    "FORCE 50": False,
    "VIA A B,C D": True,
    "VIA A B C D E": False,
    "HERE A": True,
    "HERE": False,
    "TOUCH 3": True,
    "TOUCH 2.5": False,
    "REQUIRE pins.al": True,
    'REQUIRE "pins.al" ;mine': True,
    "REQUIRE": False,
    "DEFINE A\nREQUIRE a.al\n\nA": False,
    "FREE 2 X,Y": True,
    "FREE 2 X X": False,
    "FREE 1 x": False,
    "WAIT": False,
    "WAIT NO PIN": True,
    'WAIT "a;b" c;d': True,
    'WAIT "a': False,
    "STAGE A": False,
    "DEFINE A\nPARK\n\na": True,
    "DEFINE A\nPARK\n;\n": False,
    "DEFINE A\nPARK\n ": True,
    "DEFINE A\nPARK\n": False,
    "L: DEFINE A\nPARK\n\nA": True,
    "DEFINE A S,G\nMOVE S\nOPEN G\n\nA T 1": True,
    "DEFINE A, S\nMOVE S DIRECT\n\nA T": True,
    "DEFINE A S\nMOVE S\n\nA, T": False,
    "DEFINE A S\nMOVE S\n\nA [0 0 1]": True,
    "DEFINE A S\nMOVE S\n\nA [0 T 1]": False,
    'DEFINE A S\nWAIT AT {S}\n\nA "T"': True,
    'DEFINE A S\nMOVE S\n\nA "T': False,
    "DEFINE A S\nMOVE S\n\nA": False,
    "DEFINE A S\nMOVE S\n\nA T P": False,
    "DEFINE A S\nMOVE S\n\nA 1in": False,
    "DEFINE A S S\nMOVE S\n\nA T P": False,
    "DEFINE A 1\nPARK\n\nA 1": False,
    "DEFINE A open\nPARK\n\nA T": False,
    "DEFINE A X\nPARK\n\nA T": False,
    "DEFINE A x\nCHANGE x 1\n\nA Y": True,
    "DEFINE A Nil\nPARK\n\nA T": False,
    "DEFINE A S\nS: MOVE S\n\nA T": False,
    "DEFINE A S\nMOVE S\n\nMOVE S T": False,
    "TRANS A [0 0 0 0 0 0] OFB": False,
    "MOVE é": False,
    "PARK\r\n\x0bPARK\x0c": True,
    "\ufeffPARK": False,
    "": True,
}
"""Where two readers of the manual might part."""


@pytest.mark.parametrize("text", CORPUS)
def test_grammar_and_parser_agree_on_every_program_there_is(text: str) -> None:
    assert_agreed(text)


@pytest.mark.parametrize("text", PROBES)
def test_grammar_and_parser_agree_where_they_might_part(text: str) -> None:
    assert (is_program(text), not parse(text)[1]) == (PROBES[text], PROBES[text])


@given(programs)
def test_grammar_and_parser_agree_on_random_words(text: str) -> None:
    assert_agreed(text)


@given(spoiled(CORPUS))
def test_grammar_and_parser_agree_on_spoiled_programs(text: str) -> None:
    assert_agreed(text)
