"""A TRIG job during a run. The job is taught in the world of the run, and executed and undone step by step on a
bench.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from msgspec.structs import replace

from handeye.cell.snapshot_cell import SnapshotCell
from handeye.core.errors import BadFile, Refused
from handeye.core.mutable_records import put_back
from handeye.core.pose import Array
from handeye.core.processor import processor
from handeye.core.record import Vector3
from handeye.core.units import MILLIMETRE
from handeye.core.versions import versions
from handeye.execution.servo import Halted, ServoPeriod
from handeye.execution.state import ReversalOrder
from handeye.judge.finding import Findings
from handeye.machines.purbrick import PURBRICK
from handeye.planfile.store import written_digest
from handeye.ports.axes import Channel
from handeye.ports.workcell import sense_axes
from handeye.program.events import (
    AnyEvent,
    Choice,
    OperatorAnswered,
    OperatorCalled,
    RunFinished,
    RunStarted,
    StageFinished,
    StageStarted,
    StageUndone,
    StepFinished,
    StepStarted,
    UndoEnded,
    UndoFinished,
    UndoOrdered,
    UndoStarted,
)
from handeye.program.system_state import SystemState
from handeye.runs.setup import Setup
from handeye.runs.system import RunCallbacks, RunningSystem, Settable
from handeye.systems.trig import ENTRY
from handeye.systems.trig.jobs.benches import TaughtJob, TaughtPlan, open_job
from handeye.systems.trig.language.command_input import Script
from handeye.systems.trig.language.graph import NONE, TOP
from handeye.systems.trig.language.place import AXES, is_named
from handeye.systems.trig.language.trig_arm import told_obstacle
from handeye.systems.trig.run.plan import (
    TaughtStep,
    encode,
    imagined,
    listing,
    steps_of,
    text_now,
    told_difference,
)
from handeye.systems.trig.run.state import CompletedStep, TaughtState, Turn


class RunningJob(RunningSystem):
    """Teaches a program in the world of a run, and executes it."""

    def __init__(self, setup: Setup, around: RunCallbacks) -> None:
        """Build the bench without blocks. Nothing is taught yet."""
        self._setup, self._around, self._plan = setup, around, plan_of(setup)
        self._steps = listing(self._plan).steps
        self._numbers = listing(self._plan).numbers
        self.job: TaughtJob = open_job(self._plan.job, setup.world, self._plan.script)
        self._state = TaughtState(at=0)
        self._laid, self._taught = False, 0.0
        self._sensed = sense_axes([self.job.axes])
        self._rest, self._felt = np.zeros(3), 0.0

    @property
    def state(self) -> TaughtState:
        return self._state

    @property
    def cell(self) -> SnapshotCell:
        if not self._laid:
            self.job.lay()
            self.job.session.program = imagined(self._plan)
            self._look_on()
        return self.job.cell

    @property
    def joints(self) -> tuple[str, ...]:
        return tuple(spec.name for spec in PURBRICK.axes)

    @property
    def channels(self) -> tuple[Channel, ...]:
        return self.job.axes.channels

    @property
    def time(self) -> float:
        return self.job.bench.now

    @property
    def switched_on(self) -> float:
        return -self._taught

    @property
    def trouble(self) -> str | None:
        return None

    # -- running --------------------------------------------------------------------------------------

    def begin(self) -> Sequence[AnyEvent]:
        self.job.teach(self._ask)
        self._taught = self.time
        self.job.bench.set_to_zero()
        session = self.job.session
        session.desk = Script((), halted=self._around.halt)
        if (taught := steps_of(session.program)) != self._steps:
            raise Refused(told_difference(self._steps, taught))
        self._look_on()
        session.program.begin()
        self._to(session.program.graph[TOP].sons[0])
        self._note()
        return [
            RunStarted(
                system=ENTRY.name,
                time=self.time,
                program=self._plan.job,
                steps=len(self._steps),
                plan=written_digest(encode(self._plan)),
                arm=PURBRICK.name,
                arm_digest="",
                world=self._setup.world,
                task=self._setup.task,
                camera=self.job.cell.renderer,
                versions=versions(),
                processor=processor(),
                prepared=self._taught,
            )
        ]

    def _ask(self) -> bool:
        """Raise Halted if the user wants to halt during teaching. If not, return False."""
        if self._around.halt():
            raise Halted
        return False

    def step(self) -> None:
        if self._state.undoing is None:
            self._do()
        else:
            self._undo()
        self._note()

    def _do(self) -> None:
        state = self._state
        assert state.at is not None
        number, step = state.at, self._steps[state.at]
        if state.stage is None:
            state.stage = step.stage
            self._around.emit(StageStarted(time=self.time, stage=self._plan.job))
        text = text_now(step, self.job.session.program.graph[step.node])
        self._around.emit(StepStarted(time=self.time, step=number, line=step.line, text=text))
        refused = self._carried_out(step)
        hand, gap = self._hand()
        self._around.emit(StepFinished(time=self.time, step=number, hand=hand, planned=None, gap=gap))
        if refused is not None:
            self._call(refused, number)
        elif state.at is None:
            self._around.emit(StageFinished(time=self.time, stage=self._plan.job, status="done"))
            state.stage = None

    def _carried_out(self, step: TaughtStep) -> str | None:
        """Execute a step and the hidden nodes after it. If the arm refuses, returns the reason; if not, returns
        None.
        """
        try:
            next = self.job.session.runner.carry_out(step.node, self._state.came)
        except Refused as error:  # the arm cannot reach the goal of the step
            return str(error)
        if next is None:
            raise Halted
        self._state.came = step.node
        self._to(next)
        return None

    def _to(self, node: int) -> None:
        """Advance to the next visible step, or to the end."""
        program, state = self.job.session.program, self._state
        while node != NONE and not program.graph[node].shown:
            next = self.job.session.runner.carry_out(node, state.came)
            assert next is not None
            state.came, node = node, next
        state.at = None if node == NONE else self._numbers[node]

    def _undo(self) -> None:
        state, job = self._state, self.job
        number = self.executed[-1].step
        step = self._steps[number]
        state.stage = step.stage
        self._around.emit(UndoStarted(time=self.time, step=number, line=step.line, text=step.text))
        self._rest, self._felt = self._force(), 0.0
        refused = self._undone(job)
        hand, gap = self._hand()
        felt = round(self._felt, 3)
        self._around.emit(
            UndoFinished(time=self.time, step=number, hand=hand, planned=None, gap=gap, force=felt)
        )
        if refused is None:
            self._stand_before(number)
        else:
            self._call(refused, number)

    def _undone(self, job: TaughtJob) -> str | None:
        """Reverse the last step. If the arm stopped before the end, returns the reason; if not, returns None."""
        try:
            ran = job.session.runner.back(1)
        except Refused as error:  # the arm cannot go back to its earlier place
            return str(error)
        if ran.end == "halted":
            raise Halted
        self._state.obstacle = ran.obstacle
        return None if ran.obstacle is None else told_obstacle(ran.obstacle)

    def _stand_before(self, number: int) -> None:
        """Update the state after a step was reversed. Either the state then names the next step to reverse, or the
        reversal is complete.
        """
        state, program = self._state, self.job.session.program
        assert state.undoing is not None
        self._note()
        left = len(self.executed)
        if not left:
            while program.trail:  # hidden nodes before the first step
                self.job.session.runner.back(1)
            self._around.emit(StageUndone(time=self.time, stage=self._plan.job))
            state.stage = None
        state.came = program.trail[-1].node if program.trail else TOP
        if left > state.undoing.left:
            state.at = self.executed[-1].step
            return
        halts = state.undoing.halts
        self._around.emit(UndoEnded(time=self.time, step=number))
        state.undoing, state.at, state.onward = None, None if halts else number, number if halts else None

    def _call(self, sentence: str, number: int) -> None:
        """Call the operator, who can repeat the step or end the program."""
        state = self._state
        state.stopped = OperatorCalled(time=self.time, message=sentence)
        state.at, state.onward = None, number
        self._around.emit(state.stopped)

    def answer(self, choice: Choice) -> None:
        """Continue after a call. `retry` and `proceed` repeat the step; `skip` ends the program."""
        state = self._state
        if choice == "skip" and state.undoing is not None:
            raise Refused(
                "no step can be skipped while the program runs backwards, because the arm can undo a step only "
                "from the place where this step ended: `proceed` tries again, `abort` ends the run"
            )
        if state.undoing is None:
            state.turn = None
        state.at = None if choice == "skip" else state.onward
        state.stopped, state.onward, state.obstacle = None, None, None
        self._around.emit(OperatorAnswered(time=self.time, choice=choice, step=state.at))
        if state.at is None and state.stage is not None:
            self._around.emit(StageFinished(time=self.time, stage=self._plan.job, status="skipped"))
            state.stage = None

    @property
    def executed(self) -> Sequence[CompletedStep]:
        return self._state.executed(self._plan)

    def reverse(self, undoing: ReversalOrder) -> None:
        turn = Turn(steps=len(self.executed), ended=self._state.at is None, time=self.time)
        self._state.order(self._plan, undoing)
        if undoing.asked_by == "job":
            self._state.turn = turn
            self.job.turn()
        asked_by = undoing.asked_by
        self._around.emit(
            UndoOrdered(time=self.time, left=undoing.left, halts=undoing.halts, asked_by=asked_by)
        )

    def finish(self) -> bool:
        state = self._state
        if state.stage is not None:
            self._around.emit(StageFinished(time=self.time, stage=self._plan.job, status="stopped"))
        completed = state.at is None and state.stopped is None
        self._around.emit(RunFinished(time=self.time, completed=completed))
        return completed

    def built(self) -> Findings:
        """Return the findings on the finished work as it was before its reversal."""
        turn = self._state.turn
        return self.job.built() if turn is not None and turn.ended else {}

    def remembered(self) -> Findings:
        return self.job.remembered()

    def restore(self, state: SystemState) -> None:
        if not isinstance(state, TaughtState):
            raise BadFile("the state of the run does not belong to a taught program")
        session = self.job.session
        state.check(session.program, len(self._steps))
        put_back(self._state, state)
        state.put_into(session.program)
        assert state.arm is not None
        self.job.arm.remember(state.arm)
        session.desk = Script((), halted=self._around.halt)
        self._sensed = sense_axes([self.job.axes])

    @property
    def shown(self) -> Mapping[str, Any]:
        """The state for display, in millimetres and degrees."""
        program, arm = self.job.session.program, self.job.arm
        told = dict(zip(AXES, arm.here().measures(), strict=True))
        named = {name: p.data.measures() for name, p in program.positions.items() if is_named(name)}
        nodes = [node for node in program.graph.steps() if node.type == "loop"]
        loops = ((self._steps[self._numbers[node.id]], node) for node in nodes)
        return {
            "arm": told,
            "gap": round(arm.gap / MILLIMETRE, 3),
            "force": [round(float(each), 3) for each in self._force()],
            "executed": len(self.executed),
            "rounds": {f"{step.place} {step.text}": loop.count for step, loop in loops},
            "positions": named,
        }

    def settables(self) -> Mapping[str, Settable]:
        return {}

    def set_value(self, what: str, name: str, value: tuple[float, ...]) -> None:
        raise Refused(f"{what} {name} cannot be set: a taught program has nothing to set")

    # -- inside ---------------------------------------------------------------------------------------

    def _note(self) -> None:
        self._state.note(self.job.session.program, self.job.arm.memory)

    def _hand(self) -> tuple[Vector3, float]:
        """Return two sensed values: the position of the hand relative to the platter (m), and the gap between the
        fingers (m). Potentiometers measure the position.
        """
        x, y, z = (round(float(value), 6) for value in self.job.axes.read().q[:3])
        return (x, y, z), round(self.job.arm.gap, 6)

    def _force(self) -> Array:
        """Return the force on the finger (N, shape (3,))."""
        channels = self.job.axes.read().channels
        return np.array([channels[part] for part in PURBRICK.force.parts])

    def _look_on(self) -> None:
        """From now on, report each period of the machine to the observers of the run."""
        self._laid = True
        self._sensed = sense_axes([self.job.axes])
        self.job.bench.after_period.append(self._tell)

    def _tell(self) -> None:
        self._sensed = sensed = sense_axes([self.job.axes], self._sensed)
        *_, gap = sensed.q
        arm = replace(sensed, q=sensed.q[:-1], qd=sensed.qd[:-1], gap=float(gap))
        self._felt = max(self._felt, float(np.linalg.norm(self._force() - self._rest)))
        self._around.watch(ServoPeriod(sensed=arm, effort=np.zeros(len(arm.q)), wrench=-self._force()))


def plan_of(setup: Setup) -> TaughtPlan:
    """Return the plan of a taught job. Raises Refused for a run of another system."""
    if not isinstance(setup.plan, TaughtPlan):
        raise Refused(f"this is a run of the system {setup.system}, not of a taught job")
    return setup.plan
