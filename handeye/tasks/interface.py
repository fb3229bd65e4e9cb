"""A task: what one kind of work needs besides a plan. Each lives in a folder of its own."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal

from msgspec import field

from handeye.arm.model import ArmModel, digest
from handeye.core.diagnostics import quoted
from handeye.core.errors import Refused
from handeye.core.faults import Catalogue
from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.core.units import INCHES, Measures

if TYPE_CHECKING:  # a plan is made and checked without a simulator, and soon
    import mujoco

    from handeye.cell.rendering import RendererMaker
    from handeye.cell.simulated import SimulatedCell
    from handeye.cell.truth import Truth
    from handeye.core.pose import Array
    from handeye.core.variation import Variation, WorldSpec
    from handeye.judge.finding import Findings
    from handeye.planfile.plan import Plan
    from handeye.program.program import Fixture
    from handeye.tasks.trial import Trial
    from handeye.vision.calibration import CalibrationLook
    from handeye.vision.camera_model import CameraModel


class CameraSetup(Record, frozen=True, kw_only=True):
    """The television camera of a cell as the program knows it before it is calibrated."""

    drawing: CameraModel
    looks: tuple[CalibrationLook, ...]  # how the arm shows its lamp to it, in order


class HistoricalTiming(Record, frozen=True, kw_only=True):
    """Times of the same work in the period, s."""

    year: int
    program: str  # the program that these are the times of
    times: Mapping[str, float]  # by the names `planning`, `manipulation`, `lens` and `vision`


class ExportedScene(Record, frozen=True, kw_only=True):
    """A scene for other programs, with its description."""

    spec: mujoco.MjSpec
    about: str  # Markdown: its names, and how it differs from the cell
    parts: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Names of bodies that can be exported on their own, by the name of the whole they make."""
    densities: Mapping[str, float] = field(default_factory=dict)
    """Densities of solids of one metal throughout, by their names, kg/m3."""


class Disturbance(Record, frozen=True, kw_only=True):
    """A change of the cell between what the arm did and its reversal."""

    name: str
    meaning: str  # what is changed, in a sentence
    make: Callable[[SimulatedCell], None]  # makes the change in a cell
    after: int | None = None  # number of the stage after which it is made; None: the last


class Words(Record, frozen=True, kw_only=True):
    """Words for the product of a task."""

    product: str  # the product with its article: `the pump`
    done: str  # sentence for a product that is finished and right
    apart: str = "Every part is back where the run found it."
    """Sentence for a run of which the arm has undone everything."""


class AnyTask(ABC):
    """A task of any kind of system: worlds, and a referee."""

    name: str
    words: Words
    camera: str = "studio"
    """The camera of the scene that shows all of it to people: pictures are taken by it where none is named."""
    photographs: tuple[str, ...] = ()  # cameras of the scene whose view of the end is kept as a photograph

    force_axes: str = "world axes"  # the axes along which forces of the hand are given
    measures: Measures = INCHES  # the units in which its runs are shown to people
    holds_from: Mapping[str, int] = MappingProxyType({})
    """Stages of its own program after which findings must hold before its end, by how their names begin."""

    def __repr__(self) -> str:
        return f"<Task {self.name}>"

    @property
    @abstractmethod
    def joint_kinds(self) -> Mapping[str, Literal["revolute", "prismatic"]]:
        """Names of the arm's joints, and whether each turns or slides."""

    @abstractmethod
    def variation(self) -> Variation:
        """The quantities in which worlds differ."""

    def faults(self, world: WorldSpec) -> Catalogue:
        """The faults possible in a world; none by default."""
        return Catalogue()

    @abstractmethod
    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        """The scene of a world for pictures, before anything has happened in it; it is never simulated.

        It must have the cameras that the task names, and shapes in the groups that pictures show
        (`handeye/cell/looks.py`): `shown` checks it.

        Raises:
            InvalidInput: there is no such world.
        """

    def recorded_scene(self, spec: WorldSpec, plan: bytes) -> mujoco.MjModel:
        """The scene of a run with a plan, which may say what lies there; arguments and errors are those of `scene`."""
        return self.scene(spec)

    def shown(self, spec: WorldSpec, plan: bytes | None = None) -> mujoco.MjModel:
        """The scene of a world, or of a run with a plan; raises InvalidInput if it lacks what pictures need."""
        scene = self.scene(spec) if plan is None else self.recorded_scene(spec, plan)
        _check_scene(self, scene)
        return scene

    @abstractmethod
    def judge(self, truth: Truth) -> Findings:
        """Findings of the referee on the finished work. The cell is not touched."""

    def judge_apart(self, truth: Truth) -> Findings:
        """Findings of the referee where the arm has undone all it did; none by default. The cell is not touched."""
        return {}

    @property
    def judges_apart(self) -> bool:
        """True if its referee judges work that the arm has undone."""
        return type(self).judge_apart is not AnyTask.judge_apart


def _check_scene(task: AnyTask, scene: mujoco.MjModel) -> None:
    """Raises Refused if a scene lacks a camera that its task names, or shows nothing."""
    from handeye.cell.looks import LATENT, SCENERY, SEEN

    cameras = [scene.camera(number).name for number in range(scene.ncam)]
    for name in (task.camera, *task.photographs):
        if name not in cameras:
            there = f"it has {', '.join(map(quoted, cameras))}" if cameras else "it has none"
            lacks = f"does not have the camera {quoted(name)} that the task names; {there}"
            raise Refused(f"the scene of the task {quoted(task.name)} {lacks}")
    if not {SCENERY, SEEN, LATENT} & {*map(int, scene.geom_group)}:
        raise Refused(
            f"the scene of the task {quoted(task.name)} shows nothing: none of its shapes is in group {SEEN} (parts "
            f"and fixtures) or {SCENERY} (surroundings)"
        )


class Task(AnyTask):
    """Work for an arm that a planned program drives: its cell, its worlds, and its referee."""

    arm: ArmModel
    park: Array
    """Joint positions when the cell is switched on, rad or m, shape (n,)."""
    script: str | None = None
    """The program that is taken where none is named: a file among the plans, or the path of one elsewhere."""
    other_scripts: tuple[str, ...] = ()
    """Its other programs, likewise. Commands find each by the name of its file without the ending."""
    eye: CameraSetup | None = None
    period: HistoricalTiming | None = None
    contacts: Mapping[str, tuple[str, ...]] = MappingProxyType({})
    """Positions at which the hand, or what it holds, meets something, by the name of the operation."""

    @property
    def joint_kinds(self) -> Mapping[str, Literal["revolute", "prismatic"]]:
        """Names of the arm's joints, and whether each turns or slides."""
        return {joint.name: joint.kind for joint in self.arm.joints}

    @property
    def trials(self) -> Mapping[str, Trial[Any]]:
        """Trials in many worlds that run no program, by their names; none by default."""
        return {}

    def fixtures(self) -> Mapping[str, Fixture]:
        """Obstacles that the planner keeps clear of, unless the program is taught others."""
        return {}

    @abstractmethod
    def cell(self, spec: WorldSpec, camera: str | RendererMaker) -> SimulatedCell:
        """The cell of a world, switched on.

        Args:
            camera: how pictures are made: `auto`, `gl` or `ray`, or what makes a renderer.

        Raises:
            InvalidInput: there is no such world, or pictures cannot be made so here.
        """

    def disturbances(self) -> tuple[Disturbance, ...]:
        """Changes that can be made before its work is undone; by default none."""
        return ()

    def bystanders(self, truth: Truth) -> Mapping[str, Array]:
        """Places of the parts that the hand does not hold, by their names, m, each of shape (3,)."""
        return {}

    def exported(self, world: WorldSpec, truth: Truth, keyframe: str) -> ExportedScene:
        """The scene of a world in the state of a truth of its cell, for other programs.

        Args:
            keyframe: name of the last keyframe, which is that state.

        Raises:
            InvalidInput: this task exports none.
        """
        raise Refused(f"the task {quoted(self.name)} exports no scene")

    def check_arm(self, plan: Plan) -> None:
        """See that a plan was made for the arm of this task; raises Refused if it was made for another one."""
        if (plan.arm, plan.arm_digest) != (self.arm.name, digest(self.arm)):
            raise Refused(f"the plan was made for another arm ({plan.arm}, {plan.arm_digest}); plan it again")
        joints = len(self.arm.joints)
        if plan.joint_counts not in ((), (joints,)):
            raise Refused(
                f"the plan has positions of {counted(plan.joint_counts[0], 'joint')}; "
                f"the {self.arm.name} arm has {joints}"
            )
