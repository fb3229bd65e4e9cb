"""The stages of a run: as they were carried out, and as the arm went through them either way."""

import pytest

from handeye.program.events import (
    AnyEvent,
    OperatorCalled,
    RunFinished,
    StageFinished,
    StageStarted,
    StageUndone,
    StepStarted,
    UndoEnded,
    UndoStarted,
)
from handeye.trace.stages import Stage, stages, stages_both_ways


def began(stage: str, time: float) -> AnyEvent:
    return StageStarted(time=time, stage=stage)


def ended(stage: str, time: float) -> AnyEvent:
    return StageFinished(time=time, stage=stage, status="done")


def step(time: float) -> AnyEvent:
    return StepStarted(time=time, step=0, line=1, text="OPEN 1")


def undo(time: float) -> AnyEvent:
    return UndoStarted(time=time, step=0, line=1, text="OPEN 1")


BUILT = [began("a", 0), step(0), ended("a", 1), began("b", 1), step(1), ended("b", 2)]


def told(found: tuple[Stage, ...]) -> str:
    """`b 2-3 done` of a stage, `-b 2-3 done` of one undone."""
    return ", ".join(f"{'-' * s.back}{s.name} {s.begin:g}-{s.end:g} {s.status}" for s in found)


@pytest.mark.parametrize(
    ("events", "both_ways"),
    [
        ([*BUILT, RunFinished(time=2, completed=True)], "a 0-1 done, b 1-2 done"),
        (
            [
                *BUILT,
                undo(2),
                undo(3),
                StageUndone(time=4, stage="b"),
                undo(4),
                StageUndone(time=5, stage="a"),
            ],
            "a 0-1 done, b 1-2 done, -b 2-4 done, -a 4-5 done",
        ),
        (
            [*BUILT, undo(2), UndoEnded(time=3, step=0), step(3), ended("b", 4)],
            "a 0-1 done, b 1-2 done, -b 2-3 turned, b 3-4 done",
        ),
        (
            [*BUILT[:-1], undo(1.5), StageUndone(time=2, stage="b"), began("b", 2), step(2), ended("b", 3)],
            "a 0-1 done, b 1-1.5 turned, -b 1.5-2 done, b 2-3 done",
        ),
        (
            [*BUILT, undo(2), OperatorCalled(time=3, message="it presses"), undo(3)],
            "a 0-1 done, b 1-2 done, -b 2-3 stopped, -b 3-3 broken off",
        ),
    ],
)
def test_the_arm_goes_through_stages_either_way(events: list[AnyEvent], both_ways: str) -> None:
    assert told(stages_both_ways(events)) == both_ways


def test_the_stages_carried_out_are_those_forwards_alone() -> None:
    events = [*BUILT, undo(2), StageUndone(time=3, stage="b")]
    assert told(stages(events)) == "a 0-1 done, b 1-2 done"
