"""HEIGHT: two touches at one place tell how thick a layer is, whatever the arm is off by there."""

import numpy as np
import pytest
from fake_runs import FakeRun, fake_run
from fakes import Wall
from msgspec.structs import replace

from handeye.core.errors import WRONG_HEIGHT
from handeye.core.units import INCH

FACE = 5.6
"""Height (in) of the face that is touched, .4 in under T."""
TOUCH = "MOVE T\nSTOP [0 0 -12]\nCHANGE [0 0 -1] .8 .5\n"
STEPS = np.array([0.0015, 0.0015, 0.00024, 0.0015, 0.0009, 0.0015])
"""One step of a 12-bit converter of each joint, rad and m."""


def touched_twice(layer: float, check: str = "HEIGHT BARE .04 .08", *, steps: bool = False) -> FakeRun:
    """A face is touched, and once more with a layer (in) on it."""
    run = fake_run(f"{TOUCH}SAVE BARE\n{TOUCH}{check}")
    if steps:
        right = run.cell.arm.read
        run.cell.arm.read = lambda: replace(  # type: ignore[method-assign]
            right(), q=np.round(right().q / STEPS) * STEPS
        )
    run.cell.arm.walls = [Wall(point=(0.0, 0.0, FACE * INCH))]
    while "SAVE BARE" not in run.steps:
        run.executor.step()
    run.cell.arm.walls = [Wall(point=(0.0, 0.0, (FACE + layer) * INCH))]
    return run.go()


def test_one_layer_is_within_its_range() -> None:
    assert touched_twice(0.06).errors == []


@pytest.mark.parametrize("layer", [0.0, 0.12])
def test_a_height_outside_its_range_raises_error_9(layer: float) -> None:
    run = touched_twice(layer)
    assert run.errors == [WRONG_HEIGHT]
    assert "in above BARE; allowed: 0.040 to 0.080 in" in run.told


def test_a_height_over_what_was_never_saved_raises_error_9() -> None:
    run = touched_twice(0.06, "HEIGHT OTHER .04 .08")
    assert run.errors == [WRONG_HEIGHT]
    assert run.told.endswith("(no place was saved as OTHER)")


@pytest.mark.parametrize("layer", [0.05, 0.06, 0.07])
def test_a_layer_is_measured_through_converters_of_coarse_steps(layer: float) -> None:
    """Within .015 in: two periods of the way; one reading is off by up to .03."""
    run = touched_twice(layer, steps=True)
    state = run.executor.state
    over = (run.executor.run.drive.height - state.heights["BARE"]) / INCH
    assert over == pytest.approx(layer, abs=0.015)
