"""Quick fixes: a cure makes its diagnostic go away, and brings no other."""

from dataclasses import replace

import pytest
from documents import diagnosed, document, edited

from handeye.core.codes import CODES
from handeye.editor.fixes import Fix, fixes


def cures(text: str) -> list[Fix]:
    """The cures of the one diagnostic of a text."""
    (diagnostic,) = diagnosed(text)
    return fixes(document(text), diagnostic)


CURED = {
    "OPNE 1": "OPEN 1",
    "start OPEN 1": "start: OPEN 1",
    "MOVE PARKK": "MOVE PARK",
    "L1: PARK\nJUMP L2": "L1: PARK\nJUMP L1",
    'STAGE "one  ;two\nPARK': 'STAGE "one"  ;two\nPARK',
    "STAGE find the base\nPARK": 'STAGE "find the base"\nPARK',
    "CHANGE [0 0 -1 0.6": "CHANGE [0 0 -1] 0.6",
    "PARK\nDEFINE A\nOPEN 1": "PARK\nDEFINE A\nOPEN 1\n\n",
    "A\nDEFINE A\nOPEN 1\nDEFINE B\nPARK\n\nB": "A\nDEFINE A\nOPEN 1\n\nDEFINE B\nPARK\n\nB",
    "OPEN 1 2": "OPEN 1",
    "PARK 5 ;home": "PARK ;home",
    "OPEN = 1": "OPEN 1",
    "OPEN 5": "OPEN 4.13",
    "CLOSE -.1": "CLOSE 0",
    "LENS 35": "LENS 25",
    "        DO      OPEN 1": "        OPEN 1",
    "SEARCH 0\nL: PARK\nAOJ L": "SEARCH 0.001\nL: PARK\nAOJ L",
    "MOVE T\nRESTORE H": "MOVE T\n",
    "MOVE P\nSAVE HERE\nMOVE T\nRESTORE HERR": "MOVE P\nSAVE HERE\nMOVE T\nRESTORE HERE",
    "STOP [0 0 -50]\nOPEN 1": "OPEN 1",
    "L: STOP [0 0 -50] ;hard\nOPEN 1\nJUMP L": "L:  ;hard\nOPEN 1\nJUMP L",
    "STOP 9\nTORQUE 9\nMOVE T": "STOP 9\nMOVE T",
    "FORCE [0 0 -9]\nMOVE T": "MOVE T",
    "SAVE H\nOPEN 1\nRESTORE H": "SAVE H\nOPEN 1\n",
    "PARK\nSKIPE 23": "PARK\n",
    "STOP 50\nL: MOVE T\nJUMP L": "L:\nSTOP 50\n   MOVE T\nJUMP L",
    "STOP 50\nL:\nMOVE T\nJUMP L": "L:\nSTOP 50\nMOVE T\nJUMP L",
    "STOP 9\nMOVE T\nSKIPE 23\nSTOP 50\nMOVE T\nPARK": (
        "STOP 9\nMOVE T\nSKIPN 23\n        JUMP    PAST1\nSTOP 50\nMOVE T\nPAST1:\nPARK"
    ),
    "LOOK A\nLOOK B ;after\nINSPECT BASE A B": "LOOK A\nLOOK B HOLD ;after\nINSPECT BASE A B",
    "DEFINE A S G\nMOVE S\n\nA T [0 0 1] ;on\nA P 1": "DEFINE A S\nMOVE S\n\nA T ;on\nA P",
    "DEFINE A S\nMOVE S\n\nA PARKK": "DEFINE A S\nMOVE S\n\nA PARK",
    "DEFINE D\nSTOP 9\n\nCHANGE Z -1\n\nMOVE T\nD\nPARK": (
        "DEFINE D\nSTOP 9\nCHANGE Z -1\n\nMOVE T\nD\nPARK"
    ),
    "SAVE H\nSTOP 9\nMOVE T\nSKIPN 23\nSTOP 50\nMOVE T\nRESTORE H": (
        "SAVE H\nSTOP 9\nMOVE T\nSKIPE 23\n        JUMP    PAST1\nSTOP 50\nMOVE T\nRESTORE H\nPAST1:\n"
    ),
}
"""A text with one mistake, and what its first cure makes of it."""


@pytest.mark.parametrize("text", CURED)
def test_the_first_cure_cures(text: str) -> None:
    assert edited(text, cures(text)[0].edits) == CURED[text]
    (wrong,) = diagnosed(text)
    assert wrong.code not in {d.code for d in diagnosed(CURED[text])}


@pytest.mark.parametrize("code", [code for code, entry in CODES.items() if entry.phase == "language"])
def test_no_cure_of_an_example_leaves_its_diagnostic_or_adds_errors(code: str) -> None:
    text = CODES[code].example
    found = diagnosed(text)
    for diagnostic in found:
        for fix in fixes(document(text), diagnostic):
            after = [d.code for d in diagnosed(edited(text, fix.edits))]
            assert len(after) < len(found) or code not in after or after == ["empty-program"], fix


@pytest.mark.parametrize("text", CURED)
def test_cures_do_not_hang_on_the_words_of_a_diagnostic(text: str) -> None:
    (diagnostic,) = diagnosed(text)
    silent = replace(diagnostic, message="", help=None, notes=())
    assert fixes(document(text), silent) == fixes(document(text), diagnostic)


def test_a_near_name_is_put_in_whole_however_long_it_is() -> None:
    near = "A" * 40 + "B"
    (fix,) = cures(f"{near}: PARK\nJUMP {near[:-1]}")
    assert [edit.text for edit in fix.edits] == [near]


@pytest.mark.parametrize("code", [code for code in CODES if code.startswith("unused-")])
def test_everything_unused_can_be_removed(code: str) -> None:
    text = CODES[code].example
    (unused,) = (found for found in diagnosed(text) if found.code == code)
    fix = fixes(document(text), unused)[0]
    assert code not in {found.code for found in diagnosed(edited(text, fix.edits))}


def test_a_macro_is_not_closed_up_over_its_own_call() -> None:
    assert cures("DEFINE D\nSTOP 9\n\nCHANGE Z -1\nD\nMOVE T\n\nPARK") == []


def test_a_missing_name_is_chosen_among_those_there_are() -> None:
    assert [fix.title for fix in cures("GENERAL")] == ["name `BASE`", "name `GASKET`"]
    text = "AIM BASE\nJUMP"
    assert cures(text) == []


def test_several_choices_are_offered_when_none_is_near() -> None:
    assert [f.title for f in cures("LOOK WIDE\nGENERAL BASE V")] == ["change to `WIDE`"]


def test_what_has_no_known_cure_gets_none() -> None:
    assert cures("L: OPEN 1\nL: OPEN 2") == []
    assert cures("CHANGE [0 0 0] 1") == []
    assert cures("SPECIFIC [ .5") == []
