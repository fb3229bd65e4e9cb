"""What vision has found in the step under way is told as marks on the picture that it was found in."""

import pytest
from fakes import FakeCell
from short_runs import plan_of

from handeye.arm.robots.stanford import STANFORD
from handeye.execution.context import ExecutionContext
from handeye.execution.state import VisionResult
from handeye.execution.vision_actions import just_found
from handeye.program.diagnosis.causes import NoGasket, PartAstray
from handeye.tasks.stanford_cell.dimensions import PARK
from handeye.vision.base import GeneralLocation, PartMatch, SeenHole, SpecificLocation
from handeye.vision.blob import BoundingBox
from handeye.vision.gasket import GasketInspection
from handeye.vision.marks import BLUE, BOLD, GREEN, RED, WHITE, YELLOW, Disc, Line, Loop, marks

SCRIPT = """
        LENS    25
        AIM     BASE
        LOOK    BEFORE
        GENERAL BASE BEFORE
        SPECIFIC BASE BEFORE
        LOOK    AFTER HOLD
        INSPECT BASE BEFORE AFTER
        MATCH   BASE BEFORE AFTER
"""
BOX = GeneralLocation(box=BoundingBox(10, 20, 30, 50), x=0.5, y=0.6, corners=(), beams=1, points=1)
HOLES = SpecificLocation(
    pose=(0.5, 0.6, 0.0),
    bounce_pose=(0.5, 0.6, 0.0),
    holes=(
        SeenHole(u=20.0, v=30.0, width=8.0, height=6.0, x=0.5, y=0.6),
        SeenHole(u=60.0, v=30.0, width=4.0, height=4.0, x=0.6, y=0.6),
    ),
    screw_holes=6,
    beams=1,
    points=1,
)
EXPECTED = ((20.0, 30.0), (60.0, 30.0))


def gasket(*, right: bool) -> GasketInspection:
    """An inspection that has found one of two holes."""
    found = ((21.0, 30.0), None)
    return GasketInspection(cause=None if right else NoGasket(), expected=EXPECTED, found=found, shift=None)


def matched(*, right: bool) -> PartMatch:
    """A part that stands as it stood, or does not."""
    cause = None if right else PartAstray(off=0.01, unlike=0.0)
    return PartMatch(cause=cause, outline=((1.0, 2.0), (5.0, 2.0), (5.0, 9.0)), shift=0.0, unlike=0.0)


@pytest.mark.parametrize(
    ("step", "picture", "found"),
    [
        (3, "BEFORE", VisionResult(general=BOX)),
        (4, "BEFORE", VisionResult(specific=HOLES)),
        (6, "AFTER", VisionResult(inspection=gasket(right=True))),
        (7, "AFTER", VisionResult(match=matched(right=True))),
    ],
)
def test_the_marks_are_those_of_the_picture_that_the_step_looks_at(
    step: int, picture: str, found: VisionResult
) -> None:
    run = ExecutionContext(
        plan=plan_of(SCRIPT), arm=STANFORD, cell=FakeCell(PARK).devices, camera=None, emit=lambda _: None
    )
    run.state.at, run.state.found = step, {"OTHER": VisionResult(), picture: found}
    assert just_found(run) == (picture, found.marks())


def test_a_general_location_is_a_white_box() -> None:
    (box,) = marks(general=BOX)
    assert isinstance(box, Loop)
    assert (box.points, box.colour) == (((10, 20), (30, 20), (30, 50), (10, 50)), WHITE)


def test_holes_have_boxes_of_their_size_and_a_line_between_their_centres() -> None:
    drawn = marks(specific=HOLES)
    assert isinstance(drawn[0], Line)
    assert drawn[0].ends == EXPECTED
    boxes = [mark.points for mark in drawn if isinstance(mark, Loop) and mark.colour == YELLOW]
    assert boxes[0] == ((16.0, 27.0), (24.0, 27.0), (24.0, 33.0), (16.0, 33.0))
    assert len(boxes) == 2


def test_the_line_of_the_first_grasp_is_blue() -> None:
    line = ((15.0, 10.0), (15.0, 50.0))
    assert Line(ends=line, colour=BLUE, width=BOLD) in marks(specific=HOLES, grasp=line)


@pytest.mark.parametrize(("right", "colour"), [(True, GREEN), (False, RED)])
def test_a_gasket_has_crosses_where_holes_should_be_and_discs_where_they_are(
    right: bool, colour: tuple[int, int, int]
) -> None:
    drawn = marks(inspection=gasket(right=right))
    assert [mark for mark in drawn if isinstance(mark, Disc)] == [Disc(centre=(21.0, 30.0), colour=colour)]
    assert len([mark for mark in drawn if isinstance(mark, Line)]) == 4


@pytest.mark.parametrize(("right", "colour"), [(True, GREEN), (False, RED)])
def test_a_part_that_is_looked_at_again_has_its_outline_drawn(
    right: bool, colour: tuple[int, int, int]
) -> None:
    (outline,) = marks(match=matched(right=right))
    assert isinstance(outline, Loop)
    assert (outline.points, outline.colour) == (((1.0, 2.0), (5.0, 2.0), (5.0, 9.0)), colour)
