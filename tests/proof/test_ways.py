"""Which paths lead to the end of a program, and which of them show a claim."""

import pytest

from handeye.al import compile_text
from handeye.core.source import Source
from handeye.core.units import INCH, OUNCE_FORCE
from handeye.editor.samples import SAMPLE
from handeye.program.program import Program
from handeye.proof.evidence import Contact, Contacted, Limits, Region, Released, Went
from handeye.proof.obligation import Claim, Obligation, Phase
from handeye.proof.proof import ClaimProof, prove


def over(x: float, y: float) -> Region:
    """A region over a point of the table, in inches."""
    return Region(at=(x * INCH, y * INCH), radius=INCH, height=Limits(0.0, 10 * INCH))


TOUCH = Phase(
    by=(Contacted(of=Contact(where=over(25, 38), force=Limits(20 * OUNCE_FORCE, 60 * OUNCE_FORCE))),),
    undone=(Released(where=over(25, 38)),),
)
TOUCHED = Claim(says="the hand touches something at T", phases=(TOUCH,))
FEEL = "MOVE T\nSTOP [0 0 -40]\nCHANGE [0 0 -1] 1\n"


def compiled(text: str) -> Program:
    program, diagnostics = compile_text(Source(name="try.al", text=text), SAMPLE)
    assert program is not None, diagnostics
    return program


def proof_of(text: str, claim: Claim = TOUCHED) -> ClaimProof:
    """The verdict on a claim for a program."""
    (found,) = prove(compiled(text), [Obligation(finding="touch", claims=(claim,), rests="")]).claims
    return found


@pytest.mark.parametrize(
    "text",
    [
        FEEL,
        FEEL + 'SKIPN 23\nWAIT "NOTHING"\n',
        FEEL + "SKIPN 23\nJUMP L\nJUMP E\nL: WAIT 'x'\nE: PARK".replace("'", '"'),
        "ASSIGN N 3\nL: " + FEEL + 'SKIPE 23\nJUMP E\nSOJG N L\nWAIT "NOTHING"\nE: PARK',
        "ASSIGN N 2\nJUMP C\nL: " + FEEL + "C: SOJG N L",
        "ASSIGN N 1\nSOJG N E\n" + FEEL + "E: PARK",
        "PARK\nSKIPE 23\nJUMP F\nJUMP E\nF: " + FEEL + "E: PARK",
        FEEL + "OPEN 1\n" + FEEL,
    ],
    ids=["untested", "call", "call elsewhere", "retries", "one round", "counted in", "error never raised", "again"],
)  # fmt: skip
def test_a_touch_that_every_way_makes_is_shown(text: str) -> None:
    assert proof_of(text).verdict == "shown"


@pytest.mark.parametrize(
    "text",
    [
        "PARK",
        FEEL.replace("STOP [0 0 -40]\n", ""),
        FEEL + "SKIPN 23\nJUMP E\nE: PARK",
        "ASSIGN N 3\nL: " + FEEL + "SKIPE 23\nJUMP E\nSOJG N L\nE: PARK",
        "ASSIGN N 1\nJUMP C\nL: " + FEEL + "C: SOJG N L",
        "ASSIGN N 2\nSOJG N E\n" + FEEL + "E: PARK",
        "PARK\nSKIPE 4\nJUMP F\nJUMP E\nF: " + FEEL + "E: PARK",
        FEEL + "OPEN 1",
        FEEL.replace("-40", "-400"),
        FEEL.replace("MOVE T", "MOVE P"),
        FEEL.replace("[0 0 -1]", "[0 0 1]").replace("-40", "40"),
        FEEL.replace("CHANGE [0 0 -1]", "CHANGE [1 0 0]"),
    ],
    ids=[
        "none", "no guard", "error ignored", "retries that end", "no round", "counted out", "error that skips it",
        "undone", "guard too strong", "elsewhere", "upwards", "sideways",
    ],
)  # fmt: skip
def test_a_touch_that_a_way_avoids_is_refused_with_the_way(text: str) -> None:
    proof = proof_of(text)
    assert proof.verdict == "avoided"
    assert proof.way


def test_the_way_names_the_branch_that_avoids_the_touch() -> None:
    text = "PARK\nSKIPE 4\nJUMP F\nJUMP E\nF: " + FEEL + "E: PARK"
    program, proof = compiled(text), proof_of(text)
    assert [program.steps[each.step].line for each in proof.way] == [1, 2, 4, 8]
    assert [each.raised for each in proof.way] == [4, None, None, None]
    assert proof.leaves is not None
    assert program.steps[proof.way[proof.leaves].step].word == "PARK"  # and error 4 leads on from there


def test_the_step_that_undoes_a_touch_is_named() -> None:
    text = FEEL + "OPEN 1\nPARK"
    proof = proof_of(text)
    assert proof.undone is not None
    assert compiled(text).steps[proof.way[proof.undone].step].word == "OPEN"


def test_a_place_that_the_program_does_not_fix_is_not_decided() -> None:
    claim = Claim(says="the hand is at T", phases=(Phase(by=(Went(where=over(25, 38)),)),))
    assert proof_of("HERE A\nPARK\nMOVE A", claim).verdict == "undecided"
    assert proof_of("MOVE T\nHERE A\nPARK\nMOVE A", claim).verdict == "shown"
    assert proof_of("MOVE P\nHERE A\nPARK\nMOVE A", claim).verdict == "avoided"


def test_phases_count_only_in_their_order() -> None:
    then = Claim(says="", phases=(TOUCH, Phase(by=(Went(where=over(18, 44)),))))
    assert proof_of(FEEL + "MOVE P", then).verdict == "shown"
    assert proof_of("MOVE P\n" + FEEL, then).verdict == "avoided"


def test_a_check_that_has_failed_must_be_made_again() -> None:
    checked = "SKIPE 23\nJUMP E\n"
    again = FEEL + FEEL + checked + FEEL + "E: PARK"
    assert proof_of(again).verdict == "shown"
    assert proof_of(FEEL + FEEL + checked + "E: PARK").verdict == "avoided"


def test_a_step_undoes_a_touch_even_if_it_raises_an_error() -> None:
    assert proof_of(FEEL + "OPEN 1\nSKIPN 51\nJUMP E\n" + FEEL + "E: PARK").verdict == "avoided"


def test_any_action_may_raise_the_error_of_the_gap() -> None:
    assert proof_of("PARK\nSKIPE 51\nJUMP F\nJUMP E\nF: " + FEEL + "E: PARK").verdict == "avoided"


def test_an_undone_stage_is_taken_to_show_nothing() -> None:
    text = 'STAGE "A"\nPARK\nSTAGE "B"\n' + FEEL + "SKIPN 23\nUNDO STAGE\nPARK"
    assert proof_of(text).verdict == "avoided"  # after the last reversal, the program goes on


def test_a_stage_that_is_repeated_after_an_undo_begins_with_nothing_shown() -> None:
    undone = "PARK\nSKIPE 4\nJUMP E\nMOVE T\nOPEN 1\nUNDO STAGE\n" + FEEL + "E: WHERE"
    assert proof_of(f'STAGE "A"\n{FEEL}STAGE "B"\n{undone}').verdict == "avoided"


def test_counters_are_not_followed_through_a_reversal() -> None:
    counted_in = "ASSIGN N 1\nSOJG N E\n" + FEEL + "E: PARK"
    assert proof_of(counted_in).verdict == "shown"
    assert proof_of(counted_in + "\nSKIPN 4\nUNDO STAGE\nPARK").verdict == "avoided"


def test_a_program_without_an_end_shows_nothing() -> None:
    proof = prove(compiled("L: PARK\nJUMP L"), [Obligation(finding="touch", claims=(TOUCHED,), rests="")])
    assert not proof.ends
    assert not proof.holds
