"""The account says what happened and why, as somebody who knows the language would tell it."""

from handeye.core.variation import WorldSpec
from handeye.ports.camera import Renderer
from handeye.program import events as happened
from handeye.program.diagnosis.causes import GapTooSmall
from handeye.program.events import AnyEvent
from handeye.trace.account import account

BEGUN = happened.RunStarted(
    time=0.0, program="pins", steps=5, plan="0123456789abcdef", arm="Stanford", arm_digest="0" * 16,
    world=WorldSpec(seed=7), camera=Renderer(method="rays"), versions={"handeye": "0.1.0"},
)  # fmt: skip


def _step(time: float, line: int, text: str) -> AnyEvent:
    return happened.StepStarted(time=time, step=line, line=line, text=text)


def _ended(time: float, z: float, planned: float | None) -> AnyEvent:
    goal = None if planned is None else (0.508, 0.254, planned)
    return happened.StepFinished(time=time, step=0, hand=(0.508, 0.254, z), planned=goal, gap=0.0254)


def test_the_account_of_a_run_that_is_not_over_says_so() -> None:
    told = account([BEGUN, happened.StageStarted(time=0.0, stage="find the hole"), _step(0.0, 12, "OPEN 1")])
    assert told[-1] == "     0.00  the run pauses here, before the end of the program"


def test_an_account_of_a_stage() -> None:
    events: list[AnyEvent] = [
        BEGUN,
        happened.StageStarted(time=0.0, stage="find the hole"),
        _step(0.0, 12, "LOOK    WIDE"),
        happened.CameraBusy(time=0.5, action="digitise", seconds=0.5),
        happened.PictureTaken(time=0.5, picture="WIDE", lens=0.025),
        _ended(0.5, 0.1, None),
        _step(0.5, 14, "CHANGE  [0 0 -1] 0.6"),
        happened.ErrorRaised(time=1.5, number=23, cause=None),
        _ended(1.5, 0.08476, 0.08476),
        _step(1.5, 15, "SKIPE   23"),
        happened.ErrorTested(time=1.5, number=23, occurred=True),
        _ended(1.5, 0.08476, None),
        _step(1.5, 18, "CHANGE  [0 0 -1] 0.6"),
        happened.GuardTripped(time=2.0, guard="force", value=17.8, limit=16.680831),
        _ended(2.0, 0.0762, 0.06952),
        happened.StageFinished(time=2.0, stage="find the hole", status="done"),
        happened.RunFinished(time=2.0, completed=True),
    ]
    assert account(events) == [
        "pins: 5 steps on the Stanford arm, the world of seed 7, pictures by ray casting",
        "plan 0123456789abcdef; handeye 0.1.0",
        "",
        "FIND THE HOLE: done in 2.0 s, 0.5 s of it for the camera",
        "     0.00    12  LOOK    WIDE",
        "                    the arm waits for the picture: 0.5 s",
        "                    picture WIDE, 25 mm lens",
        "     0.50    14  CHANGE  [0 0 -1] 0.6",
        "                    error 23: the motion ended without meeting the force of its STOP",
        "     1.50    15  SKIPE   23",
        "                    error 23 occurred: continue at line 18",
        "     1.50    18  CHANGE  [0 0 -1] 0.6",
        "                    stopped: the hand presses with 64.0 ounces, over 60.0",
        "                    the hand is at (20.00, 10.00, 3.00) in, 0.26 in from its planned end",
        "",
        "     2.00  the program finished",
    ]


def test_a_motion_to_a_goal_that_was_moved_is_measured_against_where_it_was_moved_to() -> None:
    events: list[AnyEvent] = [
        _step(0.0, 12, "MOVE    T"),
        happened.Adjusted(time=0.0, goal="T", shift=(0.0, 0.0, 0.0127)),
        _ended(1.0, 0.1127, 0.1),
        _step(1.0, 13, "CHANGE  [0 0 1] 1"),
        _ended(2.0, 0.1381, 0.1254),
    ]
    assert account(events)[:-2] == [
        "     0.00    12  MOVE    T",
        "                    T is (0.000, 0.000, 0.500) in from its planned place",
        "     1.00    13  CHANGE  [0 0 1] 1",
    ]


def test_a_stop_and_what_the_operator_chose_stand_out() -> None:
    events: list[AnyEvent] = [
        happened.StageStarted(time=0.0, stage="find the hole"),
        _step(0.0, 12, "CLOSE   .1"),
        happened.ErrorRaised(time=1.0, number=2, cause=GapTooSmall(gap=0.000508, minimum=0.00254)),
        _ended(1.0, 0.1, None),
        happened.OperatorCalled(time=1.1, message="nothing is held", error=2),
        happened.OperatorAnswered(time=1.1, choice="retry", step=4),
        happened.ExperimentMade(time=1.1, what="saved", name="H", value=(0.0254, 0.0, 0.0)),
        happened.PanicStopped(time=1.2),
        happened.StageFinished(time=1.2, stage="find the hole", status="stopped"),
        happened.RunFinished(time=1.2, completed=False),
    ]
    assert account(events)[1:] == [
        "FIND THE HOLE: stopped in 1.2 s",
        "     0.00    12  CLOSE   .1",
        "                    error 2: the fingers closed beyond the minimum gap: there is nothing between them, or "
        "the object is too thin (gap 0.02 in, minimum 0.10 in)",
        "     1.10  *** brakes set, operator called: nothing is held (error 2)",
        "     1.10  *** the operator chooses to retry the stage",
        "     1.10  *** experiment: saved H is set to (1.000, 0.000, 0.000) in",
        "     1.20  *** panic button: drives off, brakes set",
        "",
        "     1.20  the run ended before the program did",
    ]


def test_a_step_of_a_required_file_is_told_with_it() -> None:
    event = happened.StepStarted(time=0.0, step=1, file="lib/pins.al", line=3, text="OPEN    1")
    assert account([event])[0] == "     0.00 lib/pins.al:3  OPEN    1"
