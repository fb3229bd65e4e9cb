"""What a run knows and remembers; the skills and the executor share it."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from handeye.arm.model import ArmModel
from handeye.events import AnyEvent
from handeye.execution.drive import ArmDrive
from handeye.planfile.plan import Plan
from handeye.ports.camera import FIRST_LENS, Picture
from handeye.ports.workcell import Workcell
from handeye.pose import Array
from handeye.program.world_model import WorldModel
from handeye.touch.spiral import spiral
from handeye.units import JIFFY
from handeye.vision.base import GeneralLocation, SpecificLocation
from handeye.vision.camera import CameraModel, View
from handeye.vision.gasket import Inspection


@dataclass(frozen=True, slots=True, kw_only=True)
class Fault:
    """An error number that an action raises, with the words for this occasion."""

    number: int
    detail: str = ""


@dataclass(slots=True, kw_only=True)
class SearchState:
    """A spiral search under way."""

    step: float
    limit: int
    count: int = 0

    def offset(self) -> tuple[float, float]:
        """Horizontal offset of the present place, m."""
        i, j = spiral(self.count)
        return i * self.step, j * self.step


@dataclass(frozen=True, slots=True, kw_only=True)
class Shot:
    """A picture and how it was taken."""

    picture: Picture
    view: View


@dataclass(frozen=True, slots=True, kw_only=True)
class Found:
    """What vision found in a picture."""

    general: GeneralLocation | None = None
    specific: SpecificLocation | None = None
    inspection: Inspection | None = None


@dataclass(slots=True, kw_only=True)
class Clockwork:
    """Where the time went: simulated seconds of the camera's mechanism, processor seconds of vision."""

    lens: float = 0.0
    vision: float = 0.0


@dataclass(slots=True, kw_only=True)
class ExecutionState:
    """The mutable state of one working phase."""

    plan: Plan
    arm: ArmModel
    cell: Workcell
    camera: CameraModel
    """The calibrated camera."""
    emit: Callable[[AnyEvent], None]
    stopwatch: Callable[[], float] = lambda: 0.0
    """Processor time for the timing table; the working phase itself never reads a clock of the host."""
    drive: ArmDrive = field(init=False)
    world: WorldModel = field(init=False)
    saved: dict[str, Array] = field(default_factory=dict)
    counters: dict[str, int] = field(default_factory=dict)
    search: SearchState | None = None
    restored: dict[str, Array] = field(default_factory=dict)
    """What RESTOREs added to the goal of the last Move."""
    goal: Array = field(default_factory=lambda: np.zeros(3))
    """Goal of the last Move without its search offset, in W (m)."""
    travel: float = 0.0
    """How far the last straight motion went (m)."""
    finger_line: Array | None = None
    """Unit vector of the finger line when the last action was a Center."""
    lens: float = FIRST_LENS
    shots: dict[str, Shot] = field(default_factory=dict)
    general: dict[str, GeneralLocation] = field(default_factory=dict)
    found: dict[str, Found] = field(default_factory=dict)
    """What vision made of each picture."""
    clockwork: Clockwork = field(default_factory=Clockwork)

    def __post_init__(self) -> None:
        self.drive = ArmDrive(cell=self.cell, arm=self.arm)
        self.world = WorldModel.of(self.plan.program)

    @property
    def time(self) -> float:
        """The cell's clock, rounded to its period so that it prints the same everywhere."""
        return round(round(self.drive.sensed.time / JIFFY) * JIFFY, 6)


def vector(p: Array) -> tuple[float, float, float]:
    """A vector for an event, to the micrometre."""
    x, y, z = (round(float(c), 6) + 0.0 for c in p)
    return x, y, z
