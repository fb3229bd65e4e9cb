"""Tests of errors carried out: an action of the small arm raises an error or none, and SKIPE and SKIPN skip or do not.

Which error an action raised is told by the run's own events, so that no row rests on an error that never was.
"""

from dataclasses import dataclass

import pytest
from block_task import block_run

from handeye.core.errors import NO_FORCE, NOTHING_HELD
from handeye.program.events import ErrorRaised, StepStarted
from handeye.runs.advance import advance

pytestmark = pytest.mark.slow

UNMET = "STOP [0 0 -16]\nCHANGE [0 0 -1] .3"
"""A stop that nothing meets in the air: error 23."""
FREE = "CHANGE [0 0 -1] .3"
"""A motion that raises no error."""
EMPTY = "CLOSE .8"
"""The hand closes on nothing: error 2."""


@dataclass(frozen=True, kw_only=True)
class Account:
    """How a run went whose first action was tested."""

    raised: list[int]
    called: int | None
    """The error that the operator was called with."""
    opened: list[str]
    """Those of `OPEN 1` and `OPEN 2` that were carried out, in order, where the operator says to proceed."""


def account(action: str, test: str) -> Account:
    runner = block_run(f"{action}\n{test}\nOPEN 1\nOPEN 2")
    called = advance(runner).error
    if runner.call is not None:
        runner.answer("proceed")
        advance(runner)
    texts = [event.text for event in runner.events if isinstance(event, StepStarted)]
    return Account(
        raised=[event.number for event in runner.events if isinstance(event, ErrorRaised)],
        called=called,
        opened=[text for text in texts if text.startswith("OPEN")],
    )


@pytest.mark.row(7, drawn=1)
def test_skipe_skips_when_the_error_occurred() -> None:
    assert account(UNMET, "SKIPE 23") == Account(raised=[NO_FORCE], called=None, opened=["OPEN 2"])


@pytest.mark.row(8, drawn=1)
def test_skipe_does_not_skip_without_error() -> None:
    assert account(FREE, "SKIPE 23") == Account(raised=[], called=None, opened=["OPEN 1", "OPEN 2"])


@pytest.mark.row(9, drawn=1)
def test_skipn_skips_without_error() -> None:
    assert account(FREE, "SKIPN 23") == Account(raised=[], called=None, opened=["OPEN 2"])


@pytest.mark.row(10, drawn=1)
def test_skipn_does_not_skip_when_the_error_occurred() -> None:
    assert account(UNMET, "SKIPN 23") == Account(raised=[NO_FORCE], called=None, opened=["OPEN 1", "OPEN 2"])


@pytest.mark.row(11, drawn=1)
def test_skipe_does_not_skip_on_another_error_which_goes_to_the_operator() -> None:
    other = Account(raised=[NOTHING_HELD], called=NOTHING_HELD, opened=["OPEN 1", "OPEN 2"])
    assert account(EMPTY, "SKIPE 23") == other
