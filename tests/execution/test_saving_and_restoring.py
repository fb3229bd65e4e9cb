"""SAVE and RESTORE carried out by the small arm: what is saved comes back, and where nothing is off nothing shifts."""

import numpy as np
import pytest
from block_task import block_run

from handeye.core.units import INCH
from handeye.program.events import AnyEvent, Restored, Saved, StepFinished
from handeye.runs.advance import advance

pytestmark = pytest.mark.slow

SERVO = 0.002
"""How far (in) the servo may end from its set-point."""


def carried_out(script: str, seed: int) -> list[AnyEvent]:
    """Everything that happened; the program finished."""
    runner = block_run(script, seed)
    assert advance(runner).kind == "end"
    return runner.events


def ends(events: list[AnyEvent]) -> np.ndarray:
    """Where the hand was (in) at the end of each motion that was planned, shape (n, 3)."""
    return np.array([e.hand for e in events if isinstance(e, StepFinished) and e.planned is not None]) / INCH


def differences(events: list[AnyEvent]) -> np.ndarray:
    """What was saved, in order, in inches, shape (n, 3)."""
    return np.array([event.difference for event in events if isinstance(event, Saved)]) / INCH


SEEDS = (0, 1)


@pytest.mark.row(20, drawn=len(SEEDS))
@pytest.mark.parametrize("seed", SEEDS)
def test_an_unperturbed_motion_saves_no_difference_and_restoring_it_changes_nothing(seed: int) -> None:
    events = carried_out("MOVE OVER\nSAVE D\nMOVE PARK\nMOVE OVER\nRESTORE D", seed)
    (restored,) = [event for event in events if isinstance(event, Restored)]
    first, _, again = ends(events)
    assert differences(events)[0] == pytest.approx(0.0, abs=SERVO)
    assert np.array(restored.difference) / INCH == pytest.approx(differences(events)[0])
    assert again == pytest.approx(first, abs=2 * SERVO)


@pytest.mark.row(21, drawn=len(SEEDS))
@pytest.mark.parametrize("seed", SEEDS)
def test_restoring_a_name_that_was_never_saved_shifts_nothing(seed: int) -> None:
    events = carried_out("MOVE OVER\nMOVE PARK\nMOVE OVER\nRESTORE D", seed)
    (restored,) = [event for event in events if isinstance(event, Restored)]
    first, _, again = ends(events)
    assert restored.difference == (0.0, 0.0, 0.0)
    assert again == pytest.approx(first, abs=SERVO)


def test_what_was_restored_still_belongs_to_a_difference_that_is_saved_anew() -> None:
    events = carried_out("MOVE OVER\nCHANGE X .5\nSAVE D\nMOVE OVER\nRESTORE D\nSAVE D", seed=0)
    before, after = differences(events)
    assert before == pytest.approx([0.5, 0.0, 0.0], abs=SERVO)
    assert after == pytest.approx(before, abs=SERVO)
