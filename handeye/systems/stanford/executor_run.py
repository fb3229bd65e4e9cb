"""The hand-eye system of 1973 as a `System`. The system executes plans of motions in the cell of a task."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Final

import numpy as np
from msgspec import UNSET

from handeye.cell.compiled_arm import CompiledArm
from handeye.cell.simulated import SimulatedCell
from handeye.core.diagnostics import quoted
from handeye.core.entries import PLANNED
from handeye.core.errors import (
    BadArgument,
    BadFile,
    CalibrationFailed,
    FrictionUnknown,
    InvalidInput,
    NoSuchName,
    PhysicsFailed,
)
from handeye.core.plain_text import counted
from handeye.core.processor import processor
from handeye.core.units import DEGREE, INCH
from handeye.core.versions import versions
from handeye.execution.camera_calibration import calibrate_camera
from handeye.execution.context import ExecutionContext
from handeye.execution.executor import Executor, check_devices
from handeye.execution.friction_measurement import measure_joints
from handeye.execution.state import ExecutedStep, ExecutionState, ReversalOrder, Shot, VisionResult
from handeye.execution.undo.undoing import order
from handeye.execution.vision_actions import just_found
from handeye.planfile.plan import Plan
from handeye.planfile.store import alike, decode, encode, plan_digest, written_digest
from handeye.program.diagnosis.causes import ArmNames
from handeye.program.events import AnyEvent, Choice, FrictionMeasured, JointFriction, RunStarted
from handeye.program.program import Position
from handeye.program.system_state import SystemState
from handeye.runs.operator import undoing
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup, plan_of
from handeye.runs.system import Listing, RunCallbacks, RunningSystem, Settable, StepperWords, System, Topics
from handeye.systems.stanford.kept_calibrations import KeptCalibrations
from handeye.systems.stanford.preparation import (
    Conditions,
    Preparation,
    conditions_of,
    preparation_of,
    take_up,
)
from handeye.tasks import task
from handeye.tasks.interface import CameraSetup
from handeye.touch.spiral import spiral
from handeye.vision.calibration import Calibration
from handeye.vision.marks import Mark
from handeye.vision.replaceable import with_functions


class RunningPlan(RunningSystem):
    """A plan that the arm of a simulated cell is executing."""

    def __init__(self, setup: Setup, around: RunCallbacks, cell: SimulatedCell | None = None) -> None:
        """Build the cell, or use the given cell. Raises InvalidInput if the plan was made for another arm, or if the
        camera cannot work as requested.
        """
        self._setup, self._halt, self._viewed = setup, around.halt, around.viewed
        self._anew, self._prepared, self._took_up = around.calibrate, 0.0, False
        self._unkept: str | None = None
        self.plan = plan_of(setup)
        self._eye, self.arm = task(setup.task).eye, task(setup.task).arm
        if cell is None:
            PROGRAM.check(setup)
            cell = task(setup.task).cell(setup.world, around.parts.camera or setup.camera)
        self._cell = cell
        check_devices(self.plan.program, self._cell.devices)
        self._context = ExecutionContext(
            plan=self.plan,
            arm=self.arm,
            cell=self._cell.devices,
            camera=None if self._eye is None else self._eye.drawing,
            emit=around.emit,
            search=around.parts.search or spiral,
            seeing=with_functions(around.parts.vision),
            without=frozenset(setup.without),
            vision=around.vision,
            arithmetic=CompiledArm,
        )
        self.context.drive.halt, self.context.drive.watch = around.halt, around.watch
        self.executor = Executor(run=self.context)

    @property
    def state(self) -> ExecutionState:
        return self.context.state

    @property
    def cell(self) -> SimulatedCell:
        return self._cell

    @property
    def context(self) -> ExecutionContext:
        return self._context

    @property
    def arm_cell(self) -> SimulatedCell:
        return self._cell

    @property
    def shots(self) -> Mapping[str, Shot]:
        return self.state.shots

    def marks(self, picture: str) -> list[Mark]:
        return self.state.found.get(picture, VisionResult()).marks()

    @property
    def just_found(self) -> tuple[str, list[Mark]]:
        return just_found(self.context)

    @property
    def joints(self) -> tuple[str, ...]:
        return tuple(joint.name for joint in self.arm.joints)

    @property
    def time(self) -> float:
        return self.context.time

    @property
    def trouble(self) -> str | None:
        return self.state.unable

    @property
    def switched_on(self) -> float:
        return 0.0 if self._took_up else -self._prepared

    @property
    def unkept(self) -> str | None:
        return self._unkept

    # -- running --------------------------------------------------------------------------------------

    def begin(self) -> Sequence[AnyEvent]:
        if self._eye is not None and self.plan.program.written("picture"):
            seconds = self._prepare(self._eye)
        else:
            seconds = self._measure_joints()
        if self.trouble is not None:
            self.halt()
        self._set_clock()
        return [self._started(), *self._friction(seconds)]

    def _prepare(self, eye: CameraSetup) -> float:
        """Measure the joints and calibrate the camera, or restore a stored preparation. Returns the time that the
        measurement of the joints took (s).
        """
        kept = KeptCalibrations.of_user()
        conditions = None if kept.folder is None else conditions_of(self._setup, self._cell.renderer)
        earlier = None if conditions is None or self._anew else kept.find(conditions)
        if earlier is not None and self._goes_on_from(earlier):
            return earlier.friction_s
        seconds = self._measure_joints()
        if self.trouble is None:
            self._calibrate(eye)
        if self.trouble is None:
            self._set_clock()
            made = preparation_of(self.context, self._cell, self._prepared, seconds)
            take_up(made, self.context, self._cell)  # as a later run does with a stored preparation
            if conditions is not None:
                self._keep(kept, conditions, made)
        return seconds

    def _goes_on_from(self, earlier: Preparation) -> bool:
        """Restore a stored preparation. If the preparation cannot be restored, change nothing and return False."""
        try:
            take_up(earlier, self.context, self._cell)
        except InvalidInput:
            return False
        self._prepared, self._took_up = earlier.seconds, True
        self._take_calibration()
        return True

    def _set_clock(self) -> None:
        """Set the clock to 0, because the program begins now."""
        self._prepared += self.time
        self._cell.set_to_zero()

    def _keep(self, kept: KeptCalibrations, conditions: Conditions, made: Preparation) -> None:
        try:
            kept.keep(conditions, made)
        except InvalidInput as fault:
            self._unkept = str(fault)

    def _started(self) -> RunStarted:
        return RunStarted(
            time=self.time,
            program=self.plan.program.name,
            steps=len(self.plan.program.steps),
            plan=plan_digest(self.plan),
            content=written_digest(encode(self.plan).encode()),
            arm=self.plan.arm,
            arm_digest=self.plan.arm_digest,
            world=self._setup.world,
            task=self._setup.task,
            camera=self._cell.renderer,
            versions=versions(),
            processor=processor(),
            replaced=self._setup.replaced or UNSET,
            without=self._setup.without or UNSET,
            prepared=self._prepared,
        )

    def step(self) -> None:
        assert self.state.at is not None
        self._cell.begin_stage(self.plan.program.steps[self.state.at].stage + 1)
        self.executor.step()

    def halt(self) -> None:
        with suppress(PhysicsFailed):  # if the physics has failed, the brakes cannot be set either
            self.context.drive.stop()

    def answer(self, choice: Choice) -> None:
        self.executor.answer(choice)

    @property
    def executed(self) -> Sequence[ExecutedStep]:
        return self.state.done

    def reverse(self, undoing: ReversalOrder) -> None:
        self.executor.undo(undoing)

    def finish(self) -> bool:
        return self.executor.finish()

    def restore(self, state: SystemState) -> None:
        if not isinstance(state, ExecutionState):
            raise BadFile("the state of the run belongs to another system")
        self.context.restore(state)
        self._take_calibration()

    def _measure_joints(self) -> float:
        """Measure friction and link weights if the program uses force. Returns the simulated time that the measurement
        took (s).
        """
        if not self.plan.program.feels:
            return 0.0
        before = self.time
        try:
            measured = measure_joints(self._cell.devices, self.arm, self.state.drive, self._halt, CompiledArm)
            self.state.drive.friction, self.state.drive.links = measured.friction, measured.links
        except (FrictionUnknown, PhysicsFailed) as error:
            self.state.unable = str(error)
        return round(self.time - before, 6)

    def _friction(self, seconds: float) -> Iterator[FrictionMeasured]:
        """Yield the event for a friction measurement that took `seconds`, or nothing if no friction was measured."""
        drive = self.state.drive
        if drive.links is not None:
            joints = ArmNames.of(self.arm).joints
            measured = zip(joints, drive.friction.tolist(), strict=True)
            frictions = tuple(
                JointFriction(joint=joint, friction=round(value, 6)) for joint, value in measured
            )
            links = tuple(round(factor, 6) for factor in drive.links.tolist())
            yield FrictionMeasured(time=self.time, joints=frictions, links=links, seconds=seconds)

    def _calibrate(self, eye: CameraSetup) -> None:
        """Calibrate the camera. After the calibration, the arm holds the position that it has reached."""
        cell, drive = self._cell.devices, self.state.drive
        assert self._cell.camera is not None
        try:
            with self._cell.camera.without_shadows():
                self.state.calibration = calibrate_camera(
                    cell, self.arm, drive, eye.drawing, eye.looks, self._halt, self._viewed, CompiledArm
                )
            self.state.lens = eye.looks[-1].lens
        except (CalibrationFailed, PhysicsFailed) as error:
            self.state.unable = str(error)
        drive.hold_anew(cell.sense(), self.arm)
        self._take_calibration()

    def _take_calibration(self) -> None:
        """Use the calibrated camera model or, if there is none, the model of the camera as designed."""
        if self.state.calibration is not None:
            self.context.camera = self.state.calibration.model
        elif self._eye is not None:
            self.context.camera = self._eye.drawing

    # -- experiments ----------------------------------------------------------------------------------

    def settables(self) -> Mapping[str, Settable]:
        return {
            "saved": Settable(
                noun="saved difference",
                usage="NAME x y z",
                names=tuple(sorted(self._saved_names())),
                units=(INCH, INCH, INCH),
                fewest=3,
                present=lambda _: (),
            ),
            "position": Settable(
                noun="position",
                usage="NAME x y z [o a t]",
                names=tuple(sorted(self.plan.program.positions)),
                units=(INCH, INCH, INCH, DEGREE, DEGREE, DEGREE),
                fewest=3,
                present=lambda name: self._position(name).at,
            ),
        }

    def set_value(self, what: str, name: str, value: tuple[float, ...]) -> None:
        if what == "saved" and len(value) == 3:
            self.state.saved[name] = np.array(value)
        elif what == "position" and len(value) == 6:
            known = self.plan.program.positions
            if name not in known:
                raise NoSuchName(f"there is no position {name}; the positions are {', '.join(known)}")
            x, y, z, o, a, t = value
            self.state.world.moved[name] = Position(at=(x, y, z, o, a, t), of=known[name].of)
        else:
            raise BadArgument(f"{what} {name} cannot be set to {counted(len(value), 'number')}")

    def _saved_names(self) -> set[str]:
        uses = [
            use for step in self.plan.program.steps for use in (*step.operation.reads, *step.operation.writes)
        ]
        return {use.name for use in uses if use.kind == "difference"}

    def _position(self, name: str) -> Position:
        return self.state.world.moved.get(name, self.plan.program.positions[name])


class PlanSystem(System):
    """The system that executes plans of motions for an arm."""

    name = PLANNED
    plan = Plan
    state = ExecutionState
    words = StepperWords(
        about=(
            "The script runs one step at a time. A step is a line that acts, together with the",
            "STOP, FORCE, FREE, TORQUE and RESTORE lines that belong to it; the arrow marks the next step.",
        ),
        places=(
            "PLACE is a line (58; pins.al:3 in a required file), a label (L1), an instruction (AOJ), a",
            "stage or part of its name, or an error (error:23). WHAT is one of",
        ),
        units="inches, degrees, ounces",
        commands={
            "set position NAME x y z [o a t]": "set a position, in the frame that `show positions` shows",
        },
        without=(),
    )

    def encode(self, plan: Plan) -> bytes:
        return encode(plan).encode()

    def decode(self, data: bytes, name: str) -> Plan:
        return decode(data, name)

    def digest(self, plan: Plan, data: bytes) -> str:
        return plan_digest(plan)

    def alike(self, one: Plan, other: Plan) -> bool:
        return alike(one, other)

    def listing(self, plan: Plan) -> Listing:
        return plan.program

    def build(self, setup: Setup, around: RunCallbacks) -> RunningPlan:
        return RunningPlan(setup, around)

    def machine(self, plan: Plan) -> tuple[str, str]:
        return plan.arm, plan.arm_digest

    def check(self, setup: Setup) -> None:
        """Raise InvalidInput if the plan was made for another arm, if the world of the setup is impossible in this
        task, or if a fault of the setup cannot occur in the run.
        """
        world, plan = setup.world, plan_of(setup)
        task(setup.task).check_arm(plan)
        task(setup.task).variation().check(world)
        task(setup.task).faults(world).check(world.faults)
        stages = len(plan.program.stages)
        late = next((fault for fault in world.faults if (fault.stage or 0) > stages), None)
        if late is not None:
            raise BadArgument(
                f"the fault {quoted(late.name)} begins at stage {late.stage}, but the program has "
                f"{counted(stages, 'stage')}"
            )

    def executed(self, plan: Plan, state: ExecutionState) -> Sequence[ExecutedStep]:
        return state.done

    def order(self, plan: Plan, state: ExecutionState, undoing: ReversalOrder) -> None:
        order(state, undoing)

    def calibration(self, state: ExecutionState) -> Calibration | None:
        return state.calibration

    @property
    def topics(self) -> Topics:
        from handeye.systems.stanford.topics import TOPICS  # needs the stepper: only when topics are shown

        return TOPICS

    def choices(self, runner: Runner) -> Mapping[Choice, str]:
        steps, onward = runner.listing.steps, runner.onward
        first = next(step.place for step in steps if step.stage == runner.stage)
        where = "to the end of the program" if onward is None else f"continue at line {steps[onward].place}"
        return {
            "proceed": "proceed: continue undoing" if undoing(runner) else f"proceed: {where}",
            "retry": f"retry the stage from line {first}, in the world as it is now",
            "skip": "skip the rest of the stage",
        }


PROGRAM: Final = PlanSystem()
