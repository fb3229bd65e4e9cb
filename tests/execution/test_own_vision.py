"""Functions of the caller behind GENERAL, SPECIFIC and INSPECT: the arm believes them, and says whose they are."""

import re

import numpy as np
import pytest
from fake_runs import FakeRun, fake_run
from looked_runs import PART, POSE, SCRIPT

from handeye.api.parts import parts_of
from handeye.core.errors import FEATURES_NOT_SEEN, GASKET_WRONG, InvalidInput
from handeye.core.pose import yaw
from handeye.ports.camera import Picture
from handeye.program.program import Part
from handeye.vision.camera_model import View
from handeye.vision.replaceable import with_functions

INSPECTED = f"{SCRIPT}\nLOOK AFTER HOLD\nINSPECT PUMP NEAR AFTER"


def place(picture: Picture, view: View, part: Part) -> tuple[float, float]:
    """Finds the part rough."""
    return POSE[0] - 0.01, POSE[1]


def pose(picture: Picture, view: View, part: Part, near: tuple[float, float]) -> tuple[float, float, float]:
    """Finds the part, with the help of the rough place."""
    return near[0] + 0.01, near[1], POSE[2]


def nothing(*_: object) -> None:
    """Finds nothing."""


def ran(script: str, **functions: object) -> FakeRun:
    """A script that looks with functions of the caller, as far as it goes."""
    run = fake_run(script, parts={"PUMP": PART})
    run.executor.run.seeing = with_functions(parts_of(None, "auto", functions).vision)  # type: ignore[arg-type]
    return run.go()


def test_a_part_is_believed_where_the_function_of_the_caller_has_found_it() -> None:
    run = ran(SCRIPT, GENERAL=place, SPECIFIC=pose)
    X_WP = run.executor.run.world.part("PUMP")
    assert (run.errors, *X_WP[:2, 3]) == ([], pytest.approx(POSE[0]), pytest.approx(POSE[1]))
    assert yaw(X_WP) == pytest.approx(POSE[2])


def test_the_picture_shows_the_holes_at_the_pose_that_the_function_has_found() -> None:
    state = ran(SCRIPT, GENERAL=place, SPECIFIC=pose).executor.state
    found, view = state.found["NEAR"].specific, state.shots["NEAR"].view
    assert found is not None
    seen = view.back_project(np.array([(hole.u, hole.v) for hole in found.holes]), PART.at[2] + PART.face)
    apart = np.hypot(*(seen[1] - seen[0])[:2])
    assert seen[0, :2] == pytest.approx(POSE[:2])
    assert apart == pytest.approx(np.hypot(PART.holes[1].x, PART.holes[1].y))


@pytest.mark.parametrize(
    ("functions", "error"),
    [
        ({"SPECIFIC": nothing}, FEATURES_NOT_SEEN),
        ({"SPECIFIC": pose, "INSPECT": lambda *_: False}, GASKET_WRONG),
    ],
)
def test_what_the_function_does_not_accept_is_an_error_of_the_instruction_with_its_name(
    functions: dict[str, object], error: int
) -> None:
    run, name = ran(INSPECTED, GENERAL=place, **functions), [*functions.values()][-1].__qualname__
    assert run.errors == [error]
    assert f"the calling program's own vision, {__name__}.{name}, does not accept what it sees" in run.told


def test_a_gasket_that_the_function_accepts_is_in_place() -> None:
    assert ran(INSPECTED, GENERAL=place, SPECIFIC=pose, INSPECT=lambda *_: True).errors == []


@pytest.mark.parametrize(
    ("functions", "sentence"),
    [
        ({"GENERAL": lambda *_: (1, 2, 3)}, "must return the place x, y (m) or None, not (1, 2, 3)"),
        (
            {"GENERAL": place, "SPECIFIC": lambda *_: (1, 2, np.nan)},
            "must return the pose x, y (m), yaw (rad)",
        ),
        ({"GENERAL": place, "SPECIFIC": pose, "INSPECT": nothing}, "must return True or False, not None"),
        (
            {"LOOK": place},
            "vision has no function for 'LOOK'; you can give one for GENERAL, SPECIFIC, INSPECT",
        ),
        ({"GENERAL": 3}, "the vision of GENERAL must be a function; 3 is not a function"),
    ],
)
def test_a_function_or_a_result_that_is_no_use_is_refused(
    functions: dict[str, object], sentence: str
) -> None:
    with pytest.raises(InvalidInput, match=re.escape(sentence)):
        ran(INSPECTED, **functions)
