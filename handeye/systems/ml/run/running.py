"""An ML program during a run. A step is one statement with all the cycles that pass until another statement can be
executed.
"""

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec.structs import replace

from handeye.core.errors import BadFile, InvalidInput, Refused
from handeye.core.mutable_records import put_back
from handeye.execution.servo import ServoPeriod
from handeye.ports.axes import Channel
from handeye.ports.workcell import Sensed
from handeye.program.events import (
    AnyEvent,
    Choice,
    LineTyped,
    OperatorAnswered,
    StepFinished,
    StepStarted,
    SystemEvent,
)
from handeye.program.numbered import encode
from handeye.program.system_state import SystemState, TaskPlace
from handeye.runs.numbered import NumberedRun
from handeye.runs.setup import Setup
from handeye.runs.system import RunCallbacks, Settable
from handeye.systems.ml import ENTRY
from handeye.systems.ml.arithmetic import HIGHEST, LOWEST
from handeye.systems.ml.background.host import Host
from handeye.systems.ml.background.interpreter import Interpreter
from handeye.systems.ml.background.program import StoredProgram
from handeye.systems.ml.dashboard.history import History
from handeye.systems.ml.dashboard.live import LiveTables
from handeye.systems.ml.dashboard.tape import TapeRecorder
from handeye.systems.ml.errors import MlError
from handeye.systems.ml.happenings import Printed
from handeye.systems.ml.level import Side
from handeye.systems.ml.machine.rectilinear import INTERLOCKS
from handeye.systems.ml.machine.spec import CYCLES_PER_SECOND
from handeye.systems.ml.run.channels import level_channels, level_values
from handeye.systems.ml.run.hardware import Hardware, PerfectHardware, StationTask
from handeye.systems.ml.run.plan import MlPlan, listing
from handeye.systems.ml.run.state import MlState, tables_of
from handeye.systems.ml.tables.layout import SHAPES
from handeye.tasks import any_task

if TYPE_CHECKING:
    from handeye.cell.snapshot_cell import SnapshotCell


class RunningMl(NumberedRun):
    """Executes a program on the machine of its plan."""

    system = ENTRY.name

    def __init__(self, setup: Setup, around: RunCallbacks) -> None:
        assert isinstance(setup.plan, MlPlan)
        super().__init__(setup, around, listing(setup.plan))
        self._plan = setup.plan
        self._held: list[SystemEvent] | None = []  # events that are emitted later; None: immediately
        self._foreseen: list[LineTyped] = []  # lines that were typed in the middle of the present step
        self._hardware = self._open()
        self.machine = self._hardware.machine
        self.program = StoredProgram()
        for number, line in self._plan.lines.items():
            self.program.store(number, line.statement)
        self._host = Host()
        self.interpreters: dict[Side, Interpreter] = {
            side: Interpreter(side, self.machine.levels, self.program, self._tell, self._host)
            for side in self.machine.levels
        }
        self.recorder = TapeRecorder(self.machine, self.interpreters, self.program)
        self._state = MlState(
            program=self.program.memory,
            background={side: each.memory for side, each in self.interpreters.items()},
            machine=self.machine.memory,
            perfect=self._hardware.memory,
            texts=self._host.texts,
            tape=self.recorder.tape,
        )

    def _open(self) -> Hardware:
        task = any_task(self._plan.task)
        if isinstance(task, StationTask):
            return task.hardware(self._plan, self._setup.world, self._tell)
        return PerfectHardware(self._plan, self._tell)

    @cached_property
    def cell(self) -> "SnapshotCell | None":
        return self._hardware.cell

    @property
    def hardware(self) -> Hardware:
        """The machine of the run, with its job."""
        return self._hardware

    @property
    def joints(self) -> tuple[str, ...]:
        return tuple(self._hardware.joints)

    @property
    def channels(self) -> tuple[Channel, ...]:
        return (*self._hardware.channels, *level_channels(self.machine.levels))

    @property
    def state(self) -> MlState:
        return self._state

    @property
    def time(self) -> float:
        return self.machine.now / CYCLES_PER_SECOND

    def _tell(self, event: SystemEvent) -> None:
        if isinstance(event, Printed):
            self._hardware.hear(event.text)
        if self._held is None:
            self._around.emit(event)
        else:
            self._held.append(event)

    # -- going on -------------------------------------------------------------------------------------

    def begin(self) -> Sequence[AnyEvent]:
        plan = self._plan
        started = self._started(encode(plan))
        for level in self.machine.levels.values():
            level.enable()
        self.interpreters["right"].run(plan.first)
        if plan.left is not None:
            self.interpreters["left"].run(plan.left)
        self._stand()
        self.recorder.statement()
        early, self._held = self._held or [], None
        return [started, *early]

    def step(self) -> None:
        number, step = self._enter()
        turn = self._next
        assert turn is not None
        text = self.program.memory.statements.get(turn.memory.at, step.text)
        self._around.emit(StepStarted(time=self.time, step=number, line=turn.memory.at, text=text))
        turn.statement()
        self._state.statements += 1
        self._pass()
        self._around.emit(StepFinished(time=self.time, step=number, hand=None, planned=None, gap=None))
        ending = self._hardware.ending(turn.memory.executing) if self._stopped is None else None
        if ending is not None and ending.done:
            for each in self.interpreters.values():
                each.conclude()
        if ending is None or ending.done:
            self._stand()
            self._call()
        else:
            self._stop(ending.text, self._listing.step_of(turn.memory.executing))
        self.recorder.statement()

    def _pass(self) -> None:
        """Let cycles pass until a statement can be executed, or until all programs have ended."""
        while waiting := self._unfinished:
            ready = [each.memory for each in waiting if each.ready()]
            if any(memory.at or memory.stopped for memory in ready):
                return
            if self._unfinished:
                self._cycle()
        for each in self.interpreters.values():
            each.check()

    def _cycle(self) -> None:
        self._poll()
        self.machine.cycle()
        self.recorder.cycle()
        if self.machine.now % self._hardware.watched == 0:
            self._watch()
        while self._foreseen and round(self._foreseen[0].time * CYCLES_PER_SECOND) <= self.machine.now:
            typed = self._foreseen.pop(0)
            self.interject(typed.text, typed.task)

    def _watch(self) -> None:
        """Report the present state of the machine and of the tables."""
        period = self._hardware.servo_period
        if period is None:
            nothing = np.empty(0)
            period = ServoPeriod(sensed=Sensed(time=self.time, q=nothing, qd=nothing), effort=nothing)
        channels = {**period.sensed.channels, **level_values(self.machine.levels)}
        self._around.watch(replace(period, sensed=replace(period.sensed, channels=channels)))

    @property
    def _unfinished(self) -> list[Interpreter]:
        return [each for each in self.interpreters.values() if each.running]

    @property
    def _next(self) -> Interpreter | None:
        """The interpreter of the arm whose statement is executed next; None if no program is running."""
        standing = [each for each in self.interpreters.values() if each.memory.at]
        return min(standing, key=lambda each: bool(each.memory.waits), default=None)

    def _stand(self) -> None:
        """Record the place of each arm's program: its next statement."""
        state, turn = self._state, self._next
        at = {side: each.memory.at for side, each in self.interpreters.items() if each.memory.at}
        several = len(self.interpreters) > 1
        state.standing = [
            TaskPlace(side if several else "", self._listing.step_of(at[side]), self._waits_for(side))
            for side in sorted(at, key=lambda side: self.interpreters[side] is not turn)
        ]
        state.at = None if turn is None else self._listing.step_of(turn.memory.at)
        if turn is None and not self._stopped:
            self._close("done")

    def _waits_for(self, side: Side) -> str:
        waits = self.interpreters[side].memory.waits
        return {"": "", "post": "the end of its motion", "until": "time", "joy": "a function key"}[waits]

    @property
    def _stopped(self) -> Interpreter | None:
        """The interpreter whose program was stopped; None if no program was stopped."""
        return next((each for each in self.interpreters.values() if each.memory.stopped), None)

    def _call(self) -> None:
        """Call the operator if a program was stopped."""
        if (stopped := self._stopped) is not None:
            self._stop(stopped.memory.stopped, self._listing.step_of(stopped.memory.executing))

    def answer(self, choice: Choice) -> None:
        """Follow the operator's answer: continue after the statement at which the program was stopped, repeat that
        statement, or end the program. Arms that were stopped are enabled again.
        """
        state, stopped = self._state, self._stopped
        state.stopped, state.onward = None, None
        if choice == "skip":
            for each in self.interpreters.values():
                each.end()
                each.memory.stopped = ""
        elif stopped is not None:
            self._held = []
            try:
                stopped.again(onward=choice == "proceed")
            except MlError as error:
                stopped.memory.stopped = str(error)
        self._stand()
        self._around.emit(OperatorAnswered(time=self.time, choice=choice, step=state.at))
        self._release()
        if choice == "skip":
            self._close("skipped")
        self._call()
        self.recorder.statement()

    def _release(self) -> None:
        """Emit the events that were held back."""
        held, self._held = self._held or [], None
        for event in held:
            self._around.emit(event)

    def type_line(self, text: str, task: str) -> None:
        """Execute a line that is typed at the terminal between two statements. If the line has a sequence number,
        store it instead.
        """
        side = task or "right"
        if side not in self.interpreters:
            raise Refused(f"there is no {side} arm")
        self._held = []
        try:
            self.interpreters[side].type_line(text)
        except InvalidInput:
            self._held = None
            raise
        self._around.emit(LineTyped(time=self.time, text=text, task=task))
        self._release()
        self._pass()
        self._stand()
        self._call()
        self.recorder.statement()

    def interject(self, text: str, task: str) -> None:
        """Execute the command FILE while a statement is still being executed. FILE writes words, and the real-time
        level uses them from its next cycle.
        """
        side = task or "right"
        if side not in self.interpreters:
            raise Refused(f"there is no {side} arm")
        told, self._held = self._held, []
        try:
            self.interpreters[side].file(text)
        except InvalidInput:
            self._held = told
            raise
        self._around.emit(LineTyped(time=self.time, text=text, task=task))
        self._release()
        self.recorder.statement()

    def foresee(self, typed: Sequence[LineTyped]) -> None:
        self._foreseen = [*typed]

    @cached_property
    def live(self) -> LiveTables:
        return LiveTables(self.tables.head, self.machine, self.recorder)

    def finish(self) -> bool:
        ended = self._next is None and self._stopped is None and self._state.stopped is None
        return self._finish(completed=ended)

    def restore(self, state: SystemState) -> None:
        if (
            not isinstance(state, MlState)
            or {*state.background} != {*self.interpreters}
            or not self._fits(state)
        ):
            raise BadFile("the state of the run does not fit this program")
        self.machine.remember(state.machine)
        self._hardware.remember(state.perfect)
        self.program.remember(state.program)
        self._host.texts.clear()
        self._host.texts.update(state.texts)
        for side, each in self.interpreters.items():
            each.remember(state.background[side])
        mine = self._state
        mine.at, mine.stage, mine.stopped, mine.onward = state.at, state.stage, state.stopped, state.onward
        mine.statements, mine.standing = state.statements, list(state.standing)
        put_back(mine.tape, state.tape)
        self.recorder.restart()
        if "live" in self.__dict__:
            self.live.restart()
        self._foreseen = []
        self._held = None

    @property
    def figures(self) -> Mapping[str, float]:
        cycles = self.machine.memory.arms["right"].CY[0]
        return {
            "simulated_s": self.time,
            "statements": self._state.statements,
            "motions": cycles.goals + cycles.forces,
            "force_events": cycles.forces,
            **self._hardware.figures,
        }

    @property
    def tables(self) -> History:
        """All tables at all cycles up to the present."""
        return tables_of(self._plan, self._state)

    # -- display --------------------------------------------------------------------------------------

    @property
    def shown(self) -> Mapping[str, Any]:
        variables = self.machine.memory.shared.VR
        return {
            "arms": {side: self._arm(side) for side in self.interpreters},
            "variables": {str(n): value for n, value in enumerate(variables, 1) if value},
            "statements": self._state.statements,
        }

    def _arm(self, side: Side) -> dict[str, Any]:
        level = self.machine.levels[side]
        return {
            "pump": "on" if level.enabled else "off",
            "flags": list(level.flags),
            "positions": {str(motor): level.position(motor) for motor in level.motors},
            "goals": {str(motor): level.goal(motor) for motor in level.motors},
            "sensors": {
                str(number): [line.reading, *((line.lower, line.upper) if not line.open else ())]
                for number, line in enumerate(level.memory.ST, 1)
                if line.input
            },
            "waits for": self._waits_for(side),
        }

    def settables(self) -> Mapping[str, Settable]:
        names = tuple(str(number) for number in range(1, SHAPES["VR"].lines + 1))
        locks = self.machine.memory.arms["right"].SF
        return {
            "variable": Settable(
                noun="variable", usage="NUMBER n", names=names, units=(1.0,), fewest=1,
                present=lambda name: (float(self.machine.memory.shared.VR[int(name) - 1]),),
            ),
            "interlock": Settable(
                noun="interlock (1 stops the arms)", usage="NAME n", names=INTERLOCKS, units=(1.0,), fewest=1,
                present=lambda name: (float(locks[INTERLOCKS.index(name)].now),),
            ),
        }  # fmt: skip

    def _set(self, what: str, name: str, number: float) -> None:
        if what == "interlock":
            if number not in (0.0, 1.0):
                raise Refused(f"an interlock must be 0 or 1, not {number:g}")
            self._hardware.signal(name, on=bool(number))
        elif number != int(number) or not LOWEST <= number <= HIGHEST:
            raise Refused(f"{number:g} is not an integer of 16 bits")
        else:
            self.machine.levels["right"].write("VR", int(name), 1, int(number))
        self.recorder.statement()
