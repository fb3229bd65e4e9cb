"""Defines the interface of a task. A task provides the cell, the worlds, the programs, the limits and the
referee of one kind of work, and has its own folder."""

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

if TYPE_CHECKING:  # types only: plans are made and checked without a simulator
    import mujoco

    from handeye.cell.rendering import RendererMaker
    from handeye.cell.simulated import SimulatedCell
    from handeye.cell.truth import Truth
    from handeye.core.pose import Array
    from handeye.core.variation import Variation, WorldSpec
    from handeye.judge.finding import Findings
    from handeye.planfile.plan import Plan
    from handeye.program.program import Fixture
    from handeye.proof.obligation import Obligation
    from handeye.tasks.trial import Trial
    from handeye.vision.calibration import CalibrationLook
    from handeye.vision.camera_model import CameraModel


class CameraSetup(Record, frozen=True, kw_only=True):
    """The model of a cell's television camera according to its drawing, and the views with which this camera is
    calibrated.
    """

    drawing: CameraModel
    looks: tuple[CalibrationLook, ...]  # the views in which the arm shows its lamp to the camera, in order


class HistoricalTiming(Record, frozen=True, kw_only=True):
    """The duration (s) of a task's work in 1973."""

    year: int
    program: str  # the program that was timed
    times: Mapping[str, float]  # durations by the names `planning`, `manipulation`, `lens` and `vision`
    differs: str = ""  # how the program differs from the work that was timed, in one or two sentences


class ExportedScene(Record, frozen=True, kw_only=True):
    """A scene for export to other programs, with a description."""

    spec: mujoco.MjSpec
    about: str  # Markdown: the names in the scene, and how the scene differs from the cell
    parts: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Groups of bodies that can be exported separately: the name of each group, and the names of its bodies."""
    densities: Mapping[str, float] = field(default_factory=dict)
    """Density (kg/m3) of each solid that consists of one metal. The keys are the names of the solids."""


class Disturbance(Record, frozen=True, kw_only=True):
    """A change that a person makes to the cell after the arm has finished, and before the arm undoes its work."""

    name: str
    meaning: str  # sentence that says what is changed
    make: Callable[[SimulatedCell], None]  # makes the change in a cell
    after: int | None = None  # number of the stage after which the change is made; None: the last


class Words(Record, frozen=True, kw_only=True):
    """The phrases that messages use for a task's product and for the outcome of the work."""

    product: str  # the product with its article: `the pump`
    done: str  # sentence for a product that is finished and right
    apart: str = "Every part is back where the run found it."
    """Sentence for a run in which the arm has undone all its work."""


class AnyTask(ABC):
    """A task for any kind of system. The task provides worlds, a scene and a referee."""

    name: str
    words: Words
    camera: str = "studio"
    """Name of the camera that shows the whole cell. Photographs are taken with this camera unless another is
    named.
    """
    photographs: tuple[str, ...] = ()  # cameras of the scene that photograph the end of a run

    force_axes: str = "world axes"  # axes of the hand's force in traces
    measures: Measures = INCHES  # display units for runs of the task
    holds_from: Mapping[str, int] = MappingProxyType({})
    """Findings that must already hold while the work is unfinished. The key is the beginning of the finding's name; the
    value is the number of the stage, in the task's own program, after which the finding must hold.
    """
    judges_stopped = False
    """True if the referee also measures the work of a program that has stopped before its end."""

    def __repr__(self) -> str:
        return f"<Task {self.name}>"

    @property
    @abstractmethod
    def joint_kinds(self) -> Mapping[str, Literal["revolute", "prismatic"]]:
        """The kind of each joint of the arm: `revolute` or `prismatic`. The keys are the names of the joints."""

    @abstractmethod
    def variation(self) -> Variation:
        """Return the table of the quantities that vary between worlds."""

    def faults(self, world: WorldSpec) -> Catalogue:
        """Return the faults that are possible in a world; none by default."""
        return Catalogue()

    @abstractmethod
    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        """Return the scene of a world in its initial state. The scene is only for pictures and is never simulated.

        The scene must have the cameras that the task names. At least one shape must be in a geom group that is visible
        in pictures (see `handeye/cell/looks.py`). The method `shown` checks both.

        Raises:
            InvalidInput: the world does not fit this task.
        """

    def recorded_scene(self, spec: WorldSpec, plan: bytes) -> mujoco.MjModel:
        """Return the scene of a recorded run. The run's plan may determine which objects lie in the cell. Raises the
        same errors as `scene`.
        """
        return self.scene(spec)

    def shown(self, spec: WorldSpec, plan: bytes | None = None) -> mujoco.MjModel:
        """Return the scene of a world. If `plan` is given, return the scene of the run that executed that plan. Raises
        InvalidInput if the scene lacks a camera that the task names, or if no shape in it is visible.
        """
        scene = self.scene(spec) if plan is None else self.recorded_scene(spec, plan)
        _check_scene(self, scene)
        return scene

    @abstractmethod
    def judge(self, truth: Truth) -> Findings:
        """Return the referee's findings on the finished work. The referee does not change the cell."""

    def judge_between(self, truth: Truth, done: int) -> Findings:
        """Return the findings that must hold after the first `done` stages of the task's own program, but need not
        hold at the end of this program. Empty by default. The referee does not change the cell.
        """
        return {}

    @property
    def referees(self) -> Mapping[str, Callable[[Truth], Findings]]:
        """Referees for other work in the cell of this task, by name; none by default. Exercises of the course use them
        (docs/course.md).
        """
        return {}

    def judge_apart(self, truth: Truth) -> Findings:
        """Return the referee's findings after the arm has undone all its work; empty by default. The referee
        does not change the cell."""
        return {}

    @property
    def judges_apart(self) -> bool:
        """True if the task's referee can judge the cell after the arm has undone its work."""
        return type(self).judge_apart is not AnyTask.judge_apart


def _check_scene(task: AnyTask, scene: mujoco.MjModel) -> None:
    """Raise Refused if a scene lacks a camera that its task names, or if no shape in it is visible."""
    from handeye.cell.looks import LATENT, SCENERY, SEEN

    cameras = [scene.camera(number).name for number in range(scene.ncam)]
    for name in (task.camera, *task.photographs):
        if name not in cameras:
            there = f"its cameras are {', '.join(map(quoted, cameras))}" if cameras else "it has no cameras"
            lacks = f"does not have the camera {quoted(name)} that the task names; {there}"
            raise Refused(f"the scene of the task {quoted(task.name)} {lacks}")
    if not {SCENERY, SEEN, LATENT} & {*map(int, scene.geom_group)}:
        raise Refused(
            f"the scene of the task {quoted(task.name)} shows nothing: none of its shapes is in group {SEEN} (parts "
            f"and fixtures) or {SCENERY} (surroundings)"
        )


class Task(AnyTask):
    """The work of an arm that runs planned programs. The task provides the cell, the worlds, the programs and the
    referee.
    """

    arm: ArmModel
    park: Array
    """Joint positions of the arm when the cell is switched on (rad or m), shape (n,)."""
    script: str | None = None
    """The task's own program: a file among the included plans, or the path of a file elsewhere. The task runs this
    program unless the user names another.
    """
    other_scripts: tuple[str, ...] = ()
    """Further programs of the task, given in the same way as `script`. Commands find each program by its file name
    without the extension.
    """
    eye: CameraSetup | None = None
    period: HistoricalTiming | None = None
    contacts: Mapping[str, tuple[str, ...]] = MappingProxyType({})
    """For each contact operation, the positions at which the hand, or the object that it holds, makes contact. The key
    is the name of the operation.
    """

    @property
    def joint_kinds(self) -> Mapping[str, Literal["revolute", "prismatic"]]:
        """The kind of each joint of the arm: `revolute` or `prismatic`. The keys are the names of the joints."""
        return {joint.name: joint.kind for joint in self.arm.joints}

    @property
    def trials(self) -> Mapping[str, Trial[Any]]:
        """Trials that repeat one part of the task in many worlds without running a program; none by default. The keys
        are their names.
        """
        return {}

    def fixtures(self) -> Mapping[str, Fixture]:
        """Return the obstacles that the planner avoids. The keys are their names. A fixture of the same name in the
        program's taught file replaces the obstacle."""
        return {}

    @abstractmethod
    def cell(self, spec: WorldSpec, camera: str | RendererMaker) -> SimulatedCell:
        """Build the cell of a world and switch it on.

        Args:
            camera: the renderer: `auto`, `gl` or `ray`, or a function that makes a renderer.

        Raises:
            InvalidInput: the world does not fit this task, or this renderer does not work on this computer.
        """

    def obligations(self, world: WorldSpec) -> tuple[Obligation, ...]:
        """Return the obligations of a program. Each obligation belongs to one finding of the referee. The obligation
        says what the program must show before the program ends. By default, there are no obligations. Each finding
        occurs once. The obligations may depend on what the world asks for, such as the number of screws, but not on
        the errors of the machines and parts.
        """
        return ()

    def disturbances(self) -> tuple[Disturbance, ...]:
        """Return the changes that can be made to the cell before the arm undoes its work; none by default."""
        return ()

    def bystanders(self, truth: Truth) -> Mapping[str, Array]:
        """Return the positions (in metres, shape (3,)) of the parts that the hand does not hold. The keys are the names
        of the parts."""
        return {}

    def exported(self, world: WorldSpec, truth: Truth, keyframe: str) -> ExportedScene:
        """Return the scene of a world for export to other programs. Every object is at its true pose.

        Args:
            keyframe: name of the scene's last keyframe, which stores the true state of all objects.

        Raises:
            InvalidInput: this task exports no scene.
        """
        raise Refused(f"the task {quoted(self.name)} exports no scene")

    def check_arm(self, plan: Plan) -> None:
        """Raise Refused if a plan was not made for this task's arm."""
        if (plan.arm, plan.arm_digest) != (self.arm.name, digest(self.arm)):
            raise Refused(
                f"the plan was made for another arm ({plan.arm}, {plan.arm_digest}); make the plan again"
            )
        joints = len(self.arm.joints)
        if plan.joint_counts not in ((), (joints,)):
            raise Refused(
                f"the plan has positions of {counted(plan.joint_counts[0], 'joint')}; "
                f"the {self.arm.name} arm has {joints}"
            )
