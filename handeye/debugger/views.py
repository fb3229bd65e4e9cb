"""Looking at a run that pauses: what the arm's own sensors say, and what the program remembers."""

import math
from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np

from handeye.core.diagnostics import quoted
from handeye.core.errors import CannotWrite, NoSuchName, Refused
from handeye.core.files import write_whole
from handeye.core.pose import Array, Pose, hand_angles, yaw
from handeye.core.record import Vector3
from handeye.core.units import DEGREE, INCH, OUNCE_FORCE
from handeye.debugger.breakpoints import meant
from handeye.debugger.view_records import (
    ErrorView,
    HandView,
    JointView,
    PartPose,
    PartShown,
    PictureShown,
    PositionView,
    SearchView,
    Shown,
)
from handeye.program.cause_text import error_sentence
from handeye.program.events import GuardTripped, PictureTaken
from handeye.program.world_model import planned_pose
from handeye.results.pictures import annotated_png
from handeye.runs.runner import Runner
from handeye.systems.stanford.executor_run import ProgramSystem, context_of


def show(runner: Runner, what: str = "", pictures: Path | None = None) -> Shown:
    """Look at a run.

    Args:
        what: topics, or their beginnings, one after the other; all but `positions` if empty.
        pictures: folder that the last picture goes to as a file; None: nothing is written.

    Raises:
        InvalidInput: no such topic, or the picture cannot be written.
    """
    known = topics(runner)
    names = [_topic(word, known) for word in what.split()] or [n for n in known if n != "positions"]
    fields: dict[str, Any] = {}
    for name in names:
        field, look = known[name]
        fields[field] = look(runner)
    last = fields.get("picture")
    if last is not None and pictures is not None:
        fields["picture"] = _kept(runner, last.name, pictures)
    return Shown(**fields)


def topics(runner: Runner) -> "Topics":
    """What of a run can be shown."""
    return TOPICS if isinstance(runner.system, ProgramSystem) else PLAIN


def write_picture(runner: Runner, file: Path) -> str:
    """Write the last picture, with what was found in it, as a PNG file; its name in the program.

    Raises:
        InvalidInput: none was taken yet, or the file cannot be written.
    """
    last = _picture(runner)
    if last is None:
        raise Refused("the program has taken no picture yet")
    write_whole(file, annotated_png(context_of(runner.system), last.name))
    return last.name


def _topic(what: str, topics: Collection[str]) -> str:
    found = [name for name in topics if name.startswith(what.casefold())]
    if what.casefold() not in topics and len(found) != 1:
        near = meant(what, topics) or f"; there are {', '.join(topics)}"
        raise NoSuchName(f"there is no {quoted(what)} to show{near}")
    return found[0]


# -- by the sensors -------------------------------------------------------------------------------------


def _joints(runner: Runner) -> tuple[JointView, ...]:
    unit = {"revolute": ("deg", DEGREE), "prismatic": ("in", INCH)}
    return tuple(
        JointView(name=joint.name, value=_round(q / unit[joint.kind][1]), unit=unit[joint.kind][0])
        for joint, q in zip(
            context_of(runner.system).arm.joints, context_of(runner.system).drive.sensed.q, strict=True
        )
    )


def _hand(runner: Runner) -> HandView:
    X_WT = context_of(runner.system).drive.hand()
    return HandView(at_in=_inches(X_WT[:3, 3]), angles_deg=_three(np.array(hand_angles(X_WT)) / DEGREE))


def _force(runner: Runner) -> Vector3 | None:
    """The force on which a guard has stopped the hand; it is old as soon as a servo period has passed."""
    tripped = next((event for event in reversed(runner.events) if isinstance(event, GuardTripped)), None)
    if tripped is None or tripped.time != runner.time:
        return None
    return _three(-context_of(runner.system).drive.state.wrench[:3] / OUNCE_FORCE)


# -- remembered -----------------------------------------------------------------------------------------


def _error(runner: Runner) -> ErrorView | None:
    fault = context_of(runner.system).state.pending
    if fault is None:
        return None
    return ErrorView(number=fault.number, sentence=error_sentence(fault.number, fault.cause))


def _search(runner: Runner) -> SearchView | None:
    search = context_of(runner.system).state.search
    if search is None:
        return None
    x, y = search.offset(context_of(runner.system).search)
    return SearchView(
        place=search.count + 1, places=search.limit, offset_in=(_round(x / INCH), _round(y / INCH))
    )


def _parts(runner: Runner) -> dict[str, PartShown]:
    world = context_of(runner.system).world
    shown = {}
    for name, part in world.parts.items():
        planned, measured = planned_pose(part), world.state.measured.get(name)
        shown[name] = PartShown(
            planned=_pose(planned),
            measured=None if measured is None else _pose(measured),
            difference=None if measured is None else _difference(measured, planned),
        )
    return shown


def _pose(X_WP: Pose) -> PartPose:
    return PartPose(at_in=_inches(X_WP[:3, 3]), yaw_deg=_round(yaw(X_WP) / DEGREE))


def _difference(measured: Pose, planned: Pose) -> PartPose:
    turn = math.remainder(yaw(measured) - yaw(planned), 2 * math.pi)
    return PartPose(at_in=_inches(measured[:3, 3] - planned[:3, 3]), yaw_deg=_round(turn / DEGREE))


def _positions(runner: Runner) -> dict[str, PositionView]:
    world = context_of(runner.system).world
    shown = {}
    for name, taught in world.positions.items():
        position = world.state.moved.get(name, taught)
        x, y, z = _inches(np.array(position.at[:3]))
        o, a, t = _three(np.array(position.at[3:]) / DEGREE)
        shown[name] = PositionView(at=(x, y, z, o, a, t), of=position.of, moved=name in world.state.moved)
    return shown


def last_picture(runner: Runner) -> str | None:
    """The name of the picture that was taken last and is still there; None if there is none."""
    taken = [event.picture for event in runner.events if isinstance(event, PictureTaken)]
    return next((name for name in reversed(taken) if name in context_of(runner.system).state.shots), None)


def _picture(runner: Runner) -> PictureShown | None:
    name = last_picture(runner)
    return None if name is None else PictureShown(name=name, file=None)


def _kept(runner: Runner, name: str, folder: Path) -> PictureShown:
    """The last picture among those of the run."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CannotWrite(f"{folder} cannot be made: {error.strerror}") from None
    file = folder / f"{name.lower()}.png"
    write_picture(runner, file)
    return PictureShown(name=name, file=str(file))


# -- figures --------------------------------------------------------------------------------------------


def _round(x: float) -> float:
    return round(float(x), 4) + 0.0


def _three(values: Array) -> Vector3:
    x, y, z = (_round(value) for value in values)
    return x, y, z


def _inches(p: Array) -> Vector3:
    return _three(p / INCH)


def _named(table: dict[str, Array]) -> dict[str, Vector3]:
    return {name: _inches(difference) for name, difference in sorted(table.items())}


Topics = Mapping[str, tuple[str, Callable[[Runner], Any]]]
"""Topics: the field of the answer, and how to look."""
PLAIN: Final[Topics] = {
    "time": ("time_s", lambda runner: runner.elapsed),
    "state": ("state", lambda runner: runner.system.shown),
}
"""Topics of any system."""
TOPICS: Final[Topics] = {
    "time": ("time_s", lambda runner: runner.elapsed),
    "joints": ("joints", _joints),
    "hand": ("hand", _hand),
    "force": ("force_oz", _force),
    "gap": ("gap_in", lambda runner: _round(context_of(runner.system).drive.sensed.gap / INCH)),
    "switches": ("switches", lambda runner: tuple(map(bool, context_of(runner.system).drive.sensed.touch))),
    "error": ("error", _error),
    "saved": ("saved_in", lambda runner: _named(context_of(runner.system).state.saved)),
    "restored": ("restored_in", lambda runner: _named(context_of(runner.system).state.restored)),
    "search": ("search", _search),
    "parts": ("parts", _parts),
    "picture": ("picture", _picture),
    "positions": ("positions", _positions),
}
"""Topics of a plan of motions."""
