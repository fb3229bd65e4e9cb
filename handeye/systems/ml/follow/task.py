"""The job `follow`: the program of figure 5 follows the outline of a plate by touch."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Final

import numpy as np

from handeye.cell.mechanism import Mechanism
from handeye.core.diagnostics import quoted
from handeye.core.distributions import Noise, Range
from handeye.core.errors import BadFile, NoSuchName
from handeye.core.faults import Catalogue
from handeye.core.markup import PagePart
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.core.variation import Variation, WorldSpec
from handeye.judge.finding import Findings
from handeye.results.result import Result
from handeye.runs.folder import REPORT
from handeye.systems.ml.bench.faults import put_away
from handeye.systems.ml.bench.hardware import ArmTask, StationHardware
from handeye.systems.ml.bench.station import Station, scene
from handeye.systems.ml.bench.world import ARM, ArmWorld, quantity
from handeye.systems.ml.follow.circuit import LONGEST, Felt, followed
from handeye.systems.ml.follow.faults import FAULTS, MISSING, MOVED, SLIPPERY
from handeye.systems.ml.follow.happenings import CircuitClosed
from handeye.systems.ml.follow.names import OutlineName
from handeye.systems.ml.follow.outlines import OUTLINES, PLATE, lay, placed
from handeye.systems.ml.follow.page import FollowReport, follow_files
from handeye.systems.ml.follow.referee import judge
from handeye.systems.ml.run.hardware import Ending, Hardware, Tell
from handeye.tasks.interface import Words

if TYPE_CHECKING:
    import mujoco

    from handeye.cell.truth import Truth
    from handeye.systems.ml.run.plan import MlPlan

FELT, LAID = "felt", "laid"
USUAL: Final[OutlineName] = "square"
HEIGHT: Final = 8071  # units of z at which the wand hangs beside a plate
_Y, _X = 3, 4  # motors
_FORWARD: Final = (2, 1)  # variables that hold the forward step along x and y
_PLACE, _TURNED, _FRICTION = "plate.place", "plate.turned", "plate.friction"
VARIATION: Final = Variation(
    *ARM,
    quantity(
        _PLACE,
        "mm",
        Noise(1.0),
        10.0,
        "Standard deviation of the plate's position along x and y. No source: our choice, for a plate laid by hand.",
    ),
    quantity(
        _TURNED,
        "deg",
        Noise(0.1),
        10.0,
        "Standard deviation of the plate's rotation. No source: our choice, for a plate that a person aligns with "
        "a line on the table.",
    ),
    quantity(
        _FRICTION,
        "",
        Range(0.25, 0.45),
        2.0,
        "Coefficient of friction between plate and table. No source: our choice.",
        0.35,
    ),
)


class Laid(Record, frozen=True, kw_only=True):
    """The true place of the plate before the program began."""

    outline: OutlineName
    corners: tuple[tuple[float, float], ...]  # x, y of its true outline, in units of the slides


class Plate(Mechanism[Laid]):
    """Remembers where the plate truly lay when the program began. Only the referee knows this place."""

    name, kind = LAID, Laid

    def __init__(self, laid: Laid) -> None:
        self.laid = laid

    def state(self) -> Laid:
        return self.laid

    def check(self, state: Laid) -> None:
        if state != self.laid:
            raise BadFile("the plate in the saved run differs from the plate in this run")

    def restore(self, state: Laid) -> None:
        self.laid = state


class Tracker(Mechanism[Felt]):
    """Keeps what the follower has felt."""

    name, kind = FELT, Felt

    def __init__(self) -> None:
        self.felt = Felt()

    def state(self) -> Felt:
        return self.felt

    def check(self, state: Felt) -> None:
        if len(state.touches) > LONGEST or not np.isfinite(state.touches).all():
            raise BadFile(
                "the follower has too many saved touches, or a saved touch contains a value that is not a finite "
                "number"
            )

    def restore(self, state: Felt) -> None:
        self.felt = state


class Follower(StationHardware):
    """A station with a plate, whose outline a program follows."""

    def __init__(self, station: Station, tell: Tell, tracker: Tracker, plate: Plate) -> None:
        super().__init__(station, tell)
        self._tell, self._tracker, self._plate = tell, tracker, plate

    def ending(self, statement: int) -> Ending | None:
        level, tracker = self.machine.levels["right"], self._tracker
        newest = level.memory.FE[0]
        forward = [level.read("VR", variable, 1) for variable in _FORWARD]
        touch, noticed = (float(newest.m4), float(newest.m3)), (newest.epoch, newest.cycle)
        felt = tracker.felt = followed(tracker.felt, forward, touch, noticed)
        if felt.closed:
            self._tell(CircuitClosed(time=self.machine.now / 100, text=felt.text))
            return Ending(done=True, text=felt.text)
        return Ending(done=False, text=felt.text) if felt.lost else None

    @property
    def figures(self) -> Mapping[str, float]:
        felt = self._tracker.felt
        return {
            "touches": len(felt.touches),
            "left_turns": felt.left,
            "right_turns": felt.right,
            "squares_without_touch": felt.idle,
        }

    def files(self, world: WorldSpec, result: Result, parts: Sequence[PagePart]) -> Mapping[str, bytes]:
        felt, laid = self._tracker.felt, self._plate.laid
        done = FollowReport(
            outline=laid.outline,
            world=str(world),
            end=felt.text if felt.closed or felt.lost else result.message,
            exit_code=result.exit_code,
            felt=felt,
            true=tuple(map(tuple, outline_now(self.station.bench.data, laid.outline).tolist())),
            checks=result.referee,
        )
        return follow_files(done, REPORT, parts)


class Follow(ArmTask):
    """Follow the outline of a plate by touch."""

    name = "follow"
    words = Words(
        product="the outline",
        done="The wand has followed the outline once around, and the plate has not moved.",
    )

    def variation(self) -> Variation:
        return VARIATION

    def faults(self, world: WorldSpec) -> Catalogue:
        return FAULTS

    def station(self, outline: OutlineName, world: ArmWorld) -> tuple[Station, Tracker, Plate]:
        """Return the station with a plate. The wand begins beside the plate."""
        spec, shape = scene(world), OUTLINES[outline]
        off = world.normal("plate.x", _PLACE) + (world.fault(MOVED) or 0.0), world.normal("plate.y", _PLACE)
        friction = world.fault(SLIPPERY) or world.value(_FRICTION)
        lay(spec, shape, off, world.normal(_TURNED, _TURNED), friction)
        if world.fault(MISSING) is not None:
            put_away(spec, PLATE)
        station = Station(spec, world, at={2: HEIGHT, _Y: shape.start[1], _X: shape.start[0]})
        corners = outline_now(station.bench.data, outline)
        tracker, plate = Tracker(), Plate(Laid(outline=outline, corners=tuple(map(tuple, corners.tolist()))))
        station.others = tracker, plate
        return station, tracker, plate

    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        return self.station(USUAL, self.world(spec))[0].bench.model

    def recorded_scene(self, spec: WorldSpec, plan: bytes) -> mujoco.MjModel:
        from handeye.systems.ml.run.plan import decode

        outline = outline_of(decode(plan, "the plan of the run"))
        return self.station(outline, self.world(spec))[0].bench.model

    def hardware(self, plan: MlPlan, world: WorldSpec, tell: Tell) -> Hardware:
        station, tracker, plate = self.station(outline_of(plan), self.world(world))
        return Follower(station, tell, tracker, plate)

    def judge(self, truth: Truth) -> Findings:
        felt, laid = truth.states[FELT], truth.states[LAID]
        assert isinstance(felt, Felt)
        assert isinstance(laid, Laid)
        return judge(np.array(felt.touches), outline_now(truth.data, laid.outline), np.array(laid.corners))


def outline_of(plan: MlPlan) -> OutlineName:
    """Return the outline that a plan names. Raises NoSuchName if no outline has this name."""
    for name in OUTLINES:
        if name == plan.variant:
            return name
    raise NoSuchName(f"there is no outline {quoted(plan.variant)}; the outlines are {', '.join(OUTLINES)}")


def outline_now(data: mujoco.MjData, outline: OutlineName) -> Array:
    """Return the corners of the plate as it truly lies, shape (n, 2), in units of the slides."""
    body = data.body(PLATE)
    return placed(OUTLINES[outline].points, body.xmat.reshape(3, 3), body.xpos)


FOLLOW: Final = Follow()
