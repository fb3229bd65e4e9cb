"""Actions of the camera, and of vision on the pictures of the camera."""

import math
from collections.abc import Callable
from functools import partial
from typing import Final, TypeVar

from handeye.core import errors
from handeye.core.pose import Array, planar, yaw
from handeye.execution.context import Action, ExecutionContext
from handeye.execution.state import Fault, Shot, VisionResult
from handeye.planning.grasp_state import first_grasp
from handeye.ports.camera import DIGITISE, Picture, TvCamera
from handeye.program.diagnosis.causes import NoGeneral, NoPicture
from handeye.program.diagnosis.sense_causes import PictureBlank, PictureNoisy, PictureRepeated, SenseCause
from handeye.program.events import (
    CameraBusy,
    CameraStarted,
    PartInspected,
    PartMatched,
    PartSeen,
    PictureTaken,
)
from handeye.program.operation import Operation
from handeye.program.program import Part
from handeye.program.vision_operations import Aim, Comparison, General, Inspect, Lens, Look, Match, Specific
from handeye.vision.base import Failure, GeneralLocation, PartMatch, SpecificLocation
from handeye.vision.camera_model import CameraModel, View
from handeye.vision.gasket import GasketInspection
from handeye.vision.live import MAX_NOISE, blank, noise, repeated
from handeye.vision.marks import Mark, grasp_line

Found = TypeVar("Found")


def _tv(run: ExecutionContext) -> TvCamera:
    """Return the camera of the cell. There is one, because every plan that takes pictures requires it."""
    assert run.cell.camera is not None
    return run.cell.camera


def _known(run: ExecutionContext) -> CameraModel:
    """Return the calibrated camera model."""
    assert run.camera is not None
    return run.camera


def lens(run: ExecutionContext, operation: Lens) -> Fault | None:
    """Turn the lens turret."""
    _start(run, "lens", _tv(run).lens(operation.focal_length))
    run.state.lens = operation.focal_length
    return None


def aim(run: ExecutionContext, operation: Aim) -> Fault | None:
    """Turn the camera to the face of a part or to a hand position, and focus it on this face or position."""
    p_W = _target(run, operation.target)
    pan, tilt = _known(run).aim(p_W, run.state.lens)
    _start(run, "aim", _tv(run).aim(pan, tilt))
    distance = math.dist(_known(run).mount, p_W)
    _start(run, "focus", _tv(run).focus(distance))
    return None


def _target(run: ExecutionContext, name: str) -> Array:
    if name not in run.world.parts:
        return run.world.position(name)[:3, 3]
    part = run.world.parts[name]
    p_W = run.world.part(name)[:3, 3].copy()
    if len(part.holes) > 1:  # the picture is centred on the middle of the two large holes
        X_WP, hole = run.world.part(name), part.holes[1]
        p_W[:2] = X_WP[:2, :2] @ (hole.x / 2, hole.y / 2) + X_WP[:2, 3]
    p_W[2] += part.face
    return p_W


def look(run: ExecutionContext, operation: Look) -> Fault | None:
    """Take a picture as soon as the mechanism of the camera is ready."""
    _wait(run, "wait", run.state.camera_ready - run.time)
    _wait(run, "digitise", DIGITISE)
    picture = _tv(run).digitise(hold_target=operation.hold_target)
    dead = _dead(run, operation.picture, picture)
    if dead is not None:
        return Fault(number=errors.PICTURE_WRONG, cause=dead)
    pan, tilt = _tv(run).pots()
    run.state.shots[operation.picture] = Shot(
        picture=picture, view=_known(run).view(run.state.lens, pan, tilt)
    )
    run.state.found.pop(operation.picture, None)  # it belonged to the earlier picture of this name
    run.emit(PictureTaken(time=run.time, picture=operation.picture, lens=run.state.lens))
    return None


def _dead(run: ExecutionContext, name: str, picture: Picture) -> SenseCause | None:
    """Return a reason to suspect that the camera is faulty, or None. The camera is suspect if the picture is blank,
    noisy or equal to an earlier picture.
    """
    if blank(picture):
        return PictureBlank(picture=name)
    for earlier, shot in run.state.shots.items():
        if repeated(picture, shot.picture):
            return PictureRepeated(picture=name, earlier=earlier)
    measured = noise(picture)
    if measured > MAX_NOISE:
        return PictureNoisy(picture=name, noise=round(measured, 3), most=MAX_NOISE)
    return None


def _start(run: ExecutionContext, action: str, seconds: float) -> None:
    """Add the duration of an action to the time at which the camera will be ready, because the mechanism of the camera
    performs one action after another.
    """
    if seconds <= 0:
        return
    run.state.camera_ready = max(run.state.camera_ready, run.time) + seconds
    run.emit(CameraStarted(time=run.time, action=action, seconds=round(seconds, 6)))


def _wait(run: ExecutionContext, action: str, seconds: float) -> None:
    """Wait for the camera with the brakes set, for a whole number of servo periods."""
    period = run.drive.period
    periods = math.ceil(round(seconds / period, 6))
    if periods <= 0:
        return
    begun = run.time
    run.drive.brake(periods * period)
    run.emit(CameraBusy(time=run.time, action=action, seconds=round(run.time - begun, 6)))


def _no_picture(number: int, picture: str) -> Fault:
    return Fault(number=number, cause=NoPicture(picture=picture))


def general(run: ExecutionContext, operation: General) -> Fault | None:
    """Locate a part roughly. The result becomes the measured place of the part."""
    if "vision" in run.without:
        return None
    part = run.world.parts[operation.part]
    shot = run.state.shots.get(operation.picture)
    if shot is None:
        return _no_picture(errors.PART_NOT_SEEN, operation.picture)
    with run.vision.running():
        found = locate_general(run, shot, part)
    if isinstance(found, Failure):
        return Fault(number=errors.PART_NOT_SEEN, cause=found.cause)
    run.state.general[operation.part] = found
    run.state.found[operation.picture] = VisionResult(general=found)
    run.world.measure(operation.part, planar(found.x, found.y, part.at[2], part.at[3]))
    run.emit(PartSeen(time=run.time, part=operation.part, x=round(found.x, 6), y=round(found.y, 6), yaw=None))
    return None


def locate_general(run: ExecutionContext, shot: Shot, part: Part) -> GeneralLocation | Failure:
    return run.seeing.general(shot.picture, shot.view, part)


def specific(run: ExecutionContext, operation: Specific) -> Fault | None:
    """Locate a part by its holes and measure its pose."""
    if "vision" in run.without:
        return None
    part = run.world.parts[operation.part]
    shot = run.state.shots.get(operation.picture)
    if shot is None:
        return _no_picture(errors.FEATURES_NOT_SEEN, operation.picture)
    general = run.state.general.get(operation.part)
    if general is None:
        return Fault(number=errors.FEATURES_NOT_SEEN, cause=NoGeneral())
    with run.vision.running():
        found = locate_specific(run, shot, part, general)
    if isinstance(found, Failure):
        return Fault(number=errors.FEATURES_NOT_SEEN, cause=found.cause)
    x, y, angle = (round(value, 9) for value in found.pose)
    run.world.measure(operation.part, planar(x, y, part.at[2], angle))
    assert run.state.at is not None
    grasp = first_grasp(run.plan.program, run.arm.hand, run.state.at, operation.part)
    line = None
    if grasp is not None:
        line = grasp_line(shot.view, run.world.position(grasp.position), grasp.gap, part.at[2] + part.face)
    run.state.found[operation.picture] = VisionResult(specific=found, grasp=line)
    run.emit(PartSeen(time=run.time, part=operation.part, x=x, y=y, yaw=angle))
    return None


def locate_specific(
    run: ExecutionContext, shot: Shot, part: Part, general: GeneralLocation
) -> SpecificLocation | Failure:
    return run.seeing.specific(shot.picture, shot.view, part, general)


def inspect(run: ExecutionContext, operation: Inspect) -> Fault | None:
    """Inspect a gasket by the difference between two pictures."""
    seen = _compared(run, operation, errors.GASKET_WRONG, partial(inspect_gasket, run))
    if not isinstance(seen, GasketInspection):
        return seen
    run.state.found[operation.after] = VisionResult(inspection=seen)
    run.emit(PartInspected(time=run.time, part=operation.part, ok=seen.ok, cause=seen.cause))
    return None if seen.ok else Fault(number=errors.GASKET_WRONG, cause=seen.cause)


def inspect_gasket(
    run: ExecutionContext,
    before: Picture,
    after: Picture,
    view: View,
    part: Part,
    pose: tuple[float, float, float],
) -> GasketInspection:
    return run.seeing.inspect(before, after, view, part, pose)


def match(run: ExecutionContext, operation: Match) -> Fault | None:
    """Check with two pictures that a part has not moved."""
    from handeye.vision.matching import match as match_part  # needs OpenCV; planning must not

    seen = _compared(run, operation, errors.PART_ASTRAY, match_part)
    if not isinstance(seen, PartMatch):
        return seen
    run.state.found[operation.after] = VisionResult(match=seen)
    off, unlike = round(seen.shift, 6), round(seen.unlike, 6)
    run.emit(PartMatched(time=run.time, part=operation.part, ok=seen.ok, off=off, unlike=unlike))
    return None if seen.ok else Fault(number=errors.PART_ASTRAY, cause=seen.cause)


Pose2D = tuple[float, float, float]  # x, y (m) and yaw (rad)
Examination = Callable[[Picture, Picture, View, Part, Pose2D], Found | Failure]


def _compared(
    run: ExecutionContext, operation: Comparison, number: int, examine: Examination[Found]
) -> Found | Fault | None:
    """Call `examine` with the two pictures of a comparison, the earlier picture first, and return its finding. If the
    examination fails, returns the error `number`. If vision is switched off, returns None.
    """
    if "vision" in run.without:
        return None
    before, after = run.state.shots.get(operation.before), run.state.shots.get(operation.after)
    if before is None or after is None:
        return _no_picture(number, operation.after if before else operation.before)
    part, X_WP = run.world.parts[operation.part], run.world.part(operation.part)
    believed = float(X_WP[0, 3]), float(X_WP[1, 3]), yaw(X_WP)
    with run.vision.running():
        seen = examine(before.picture, after.picture, after.view, part, believed)
    return Fault(number=number, cause=seen.cause) if isinstance(seen, Failure) else seen


def just_found(run: ExecutionContext) -> tuple[str, list[Mark]]:
    """Return the name of the picture that the present step examined, and the marks for it."""
    assert run.state.at is not None
    name = run.plan.program.steps[run.state.at].operation.examines
    assert name is not None
    return name, run.state.found[name].marks()


VISION_ACTIONS: Final[dict[type[Operation], Action]] = {
    Lens: lens,
    Aim: aim,
    Look: look,
    General: general,
    Specific: specific,
    Inspect: inspect,
    Match: match,
}
