"""HEAD, which feels a screw head in the last stage: its second touch does not repeat the error of its first."""

from functools import cache

import numpy as np
import pytest
from fake_runs import AT_T, FakeRun, T, fake_run
from fakes import Wall
from msgspec.structs import replace

from handeye.arm.converters import position_step
from handeye.arm.ik import solve
from handeye.arm.kinematics import forward, jacobian
from handeye.arm.robots.stanford import STANFORD
from handeye.core.errors import WRONG_HEIGHT
from handeye.core.pose import translated
from handeye.core.resources import plans
from handeye.core.units import INCH
from handeye.planfile.store import read_plan
from handeye.ports.workcell import ArmReading
from handeye.program.diagnosis.causes import HeightOutside
from handeye.program.events import ErrorRaised, SearchAdvanced
from handeye.program.flow_operations import Search
from handeye.program.motion_operations import Move
from handeye.touch.spiral import line

SCRIPT = (plans() / "water_pump.al").read_text(encoding="utf-8")
MACRO = SCRIPT[SCRIPT.index("DEFINE HEAD ") :].split("\n\n")[0]
SHOULDER = 1
STACK = 0.511 * INCH
"""Height (m) of a head over the face of the base."""
MISREAD = 0.025
"""How much too high or too low (in) the hand seems to be; allowed: .018."""


@cache
def height() -> float:
    """The height (m) at which a touch of the head ends."""
    first = touched(0.0).all(ErrorRaised)[0].cause
    assert isinstance(first, HeightOutside)
    return first.height


def touched(face: float, off: float = 0.0, *, everywhere: bool = False) -> FakeRun:
    """A head .1 in under T is touched; the face was felt at a height (m). At the taught place, or everywhere, the
    shoulder reads so that the hand seems to be `off` (in) too high.
    """
    run = fake_run(f"{MACRO}\n\nASSIGN AGAIN 2\nHEAD T FACE 2\n")
    arm, step = run.cell.arm, position_step(STANFORD)
    arm.walls = [Wall(point=(0.0, 0.0, T.at[2] - 0.1 * INCH))]
    right, wrong = arm.read, np.zeros(6)
    wrong[SHOULDER] = off * INCH / jacobian(STANFORD, AT_T)[2, SHOULDER]

    def read() -> ArmReading:
        reading, there = right(), everywhere or abs(arm.tcp[1] - T.at[1]) < 0.03 * INCH
        return replace(reading, q=np.round((reading.q + wrong * there) / step) * step)

    arm.read = read  # type: ignore[method-assign]
    run.executor.state.heights["FACE"] = face
    return run.go()


@pytest.mark.slow
def test_what_the_shoulder_misreads_at_one_place_a_touch_beside_it_corrects() -> None:
    run = touched(height() - STACK, -MISREAD)
    assert run.errors == [WRONG_HEIGHT]
    assert len(run.all(SearchAdvanced)) == 1
    assert not run.called


@pytest.mark.slow
@pytest.mark.parametrize(
    ("off", "call"), [(-MISREAD, "SCREW 2 IS GONE: "), (MISREAD, "SCREW 2 STANDS HIGH: ")]
)
def test_a_head_that_two_touches_find_too_low_or_too_high_is_called(off: float, call: str) -> None:
    run = touched(height() - STACK, off, everywhere=True)
    assert len(run.all(SearchAdvanced)) == 1
    assert run.told.startswith(call)


def test_at_the_second_place_the_shoulder_stands_half_a_step_of_its_converter_from_the_first() -> None:
    plan = read_plan(plans() / "water_pump.plan.json")
    steps = list(enumerate(plan.program.steps))
    asides = [
        step.operation for _, step in steps if step.macro == "HEAD" and isinstance(step.operation, Search)
    ]
    heads = [number for number, step in steps if step.macro == "HEAD" and isinstance(step.operation, Move)]
    assert len(heads) == len(asides) == 6
    for number, aside in zip(heads, asides, strict=True):
        first = plan.motions[number].knots[-1]
        assert aside.along is not None
        x, y = line(1, aside.along)
        there = translated(forward(STANFORD, np.array(first)), (x * aside.step, y * aside.step, 0.0))
        second = solve(STANFORD, there, np.array(first)).q
        assert second is not None
        apart = abs(second - first)[SHOULDER] / position_step(STANFORD)[SHOULDER]
        assert apart == pytest.approx(0.5, abs=0.1)
