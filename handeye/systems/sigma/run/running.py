"""A MAL program during a run. A step is one statement of the task whose turn it is."""

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, Final

from handeye.core.errors import BadFile, Refused
from handeye.core.mutable_records import put_back
from handeye.ports.axes import Channel
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
from handeye.systems.sigma import ENTRY
from handeye.systems.sigma.bus.layout import SUPERSIGMA
from handeye.systems.sigma.bus.wired import WiredBus
from handeye.systems.sigma.machine.perfect import PerfectMemory, PerfectMotors
from handeye.systems.sigma.mal.happenings import Printed
from handeye.systems.sigma.mal.virtual_machine import VirtualMachine
from handeye.systems.sigma.protocol import STEP_MM
from handeye.systems.sigma.run.plan import MalPlan, listing
from handeye.systems.sigma.run.state import MalState
from handeye.tasks import any_task

if TYPE_CHECKING:  # programs run on perfect motors without a simulator
    from handeye.cell.snapshot_cell import SnapshotCell
    from handeye.systems.sigma.gantries.machine import Gantries
    from handeye.systems.sigma.gantries.witness import Witness

COMMANDS_PER_SECOND: Final = 10_000  # greatest number of commands that the bus can carry
WATCHED: Final = 50  # states of the gantries that a trace keeps per second


class RunningMal(NumberedRun):
    """Executes a program on the machine of its plan."""

    system = ENTRY.name

    def __init__(self, setup: Setup, around: RunCallbacks) -> None:
        assert isinstance(setup.plan, MalPlan)
        super().__init__(setup, around, listing(setup.plan))
        self._plan = setup.plan
        self._early: list[AnyEvent] = []
        self._begun = False
        self._machine: PerfectMotors | WiredBus = PerfectMotors()
        self._gantries: Gantries | None = None
        self._witness: Witness[Any] | None = None
        match setup.plan.arm:
            case "wired":
                self._machine = WiredBus()
            case "gantries":
                self._machine, self._gantries, self._witness = _gantries(setup)
                self._gantries.bench.after_period.append(self._watch)
        self._watched = 0
        self.vm = VirtualMachine(
            setup.plan.program,
            self._machine,
            self._tell,
            poll=self._poll,
            statement_us=setup.plan.statement_us,
        )
        self._state = MalState(memory=self.vm.memory)
        memory = self._machine.memory
        if isinstance(memory, PerfectMemory):
            self._state.machine = memory
        else:
            self._state.bus = memory

    @cached_property
    def cell(self) -> "SnapshotCell | None":
        others = () if self._witness is None else (self._witness,)
        return None if self._gantries is None else self._gantries.bench.cell(*others)

    @property
    def joints(self) -> tuple[str, ...]:
        return () if self._gantries is None else self._gantries.rig.axes

    @property
    def channels(self) -> tuple[Channel, ...]:
        return () if self._gantries is None else self._gantries.channels

    def _watch(self) -> None:
        """Report the state of the gantries at regular times."""
        assert self._gantries is not None
        if (period := int(self._gantries.bench.now * WATCHED)) > self._watched:
            self._watched = period
            self._around.watch(self._gantries.period)

    @property
    def state(self) -> MalState:
        return self._state

    @property
    def time(self) -> float:
        return self.vm.time

    @property
    def machine(self) -> PerfectMotors | WiredBus:
        """The machine that the plan names. The program commands this machine."""
        return self._machine

    def type_out(self, text: str) -> None:
        """Print a line on the console, as a program does with PRINT."""
        self._tell(Printed(time=self.time, task="", text=text))

    def _tell(self, event: SystemEvent) -> None:
        if self._witness is not None and isinstance(event, Printed):
            self._witness.hear(event.text)
        self._emit(event)

    def _emit(self, event: AnyEvent) -> None:
        if self._begun:
            self._around.emit(event)
        else:
            self._early.append(event)

    # -- going on -------------------------------------------------------------------------------------

    def begin(self) -> Sequence[AnyEvent]:
        started = self._started(encode(self._plan))
        self.vm.begin()
        self._stand()
        self._call()
        self._begun = True
        return [started, *self._early]

    def step(self) -> None:
        number, step = self._enter()
        self._around.emit(StepStarted(time=self.time, step=number, line=step.line, text=step.text))
        self.vm.statement()
        self.vm.settle()
        self._around.emit(StepFinished(time=self.time, step=number, hand=None, planned=None, gap=None))
        self._stand()
        self._call()

    def _stand(self) -> None:
        """Record where each task is in the program."""
        state, memory, program = self._state, self.vm.memory, self.vm.program
        turn = self.vm.turn
        names = sorted(memory.tasks, key=lambda name: name != turn)
        state.standing = [
            TaskPlace(name, program.line_at[memory.tasks[name].pc], self.vm.waits_for(name)) for name in names
        ]
        state.at = program.line_at[memory.tasks[turn].pc] if turn else None
        if not memory.tasks and memory.fault is None:
            self._close("done")

    def _call(self) -> None:
        """Call the operator if the program has stopped."""
        fault = self.vm.memory.fault
        if fault is not None:
            more = f"; in the stepper, `type {fault.task} 5` answers with 5" if fault.kind == "input" else ""
            self._stop(f"{fault.told}{more}", self.vm.program.line_at[fault.address])

    def answer(self, choice: Choice) -> None:
        """Follow the operator's answer: continue after the statement at which the program has stopped, repeat
        that statement, or end the program."""
        state = self._state
        state.stopped, state.onward = None, None
        if choice == "skip":
            self.vm.end()
        elif choice == "retry":
            self.vm.retry()
        else:
            self.vm.proceed()
        turn = self.vm.turn
        at = self.vm.program.line_at[self.vm.memory.tasks[turn].pc] if turn else None
        self._around.emit(OperatorAnswered(time=self.time, choice=choice, step=at))
        if choice == "skip":
            self._close("skipped")
        self._stand()
        self._call()

    def type_line(self, text: str, task: str) -> None:
        """Give the typed number to the task that waits for a number."""
        self.vm.type_number(text, task)
        state = self._state
        state.stopped, state.onward = None, None
        self._around.emit(LineTyped(time=self.time, text=text, task=task))
        self.vm.settle()
        self._stand()
        self._call()

    def finish(self) -> bool:
        return self._finish(completed=not self.vm.memory.tasks and self.vm.memory.fault is None)

    def restore(self, state: SystemState) -> None:
        if not isinstance(state, MalState) or not self.vm.fits(state.memory) or not self._fits(state):
            raise BadFile("the state of the run does not fit this program")
        machine = state.bus if isinstance(self._machine, WiredBus) else state.machine
        if machine is None:
            raise BadFile("the state of the run belongs to another machine")
        put_back(self._state, state)
        self._machine.remember(machine)
        self._begun = True
        self._watched = 0 if self._gantries is None else int(self._gantries.bench.now * WATCHED)

    @property
    def figures(self) -> Mapping[str, float]:
        vm = self.vm
        passed = vm.time
        rate = vm.memory.commands / passed if passed else 0.0
        return {
            "simulated_s": round(passed, 3),
            "commands": vm.memory.commands,
            "questions": vm.memory.questions,
            "commands_per_second": round(rate, 3),
            "bus_saturation": round(rate / COMMANDS_PER_SECOND, 6),
            "computer_idle": round(vm.idle, 4),
        }

    # -- display ------------------------------------------------------------------------------

    @property
    def shown(self) -> Mapping[str, Any]:
        memory = self.vm.memory
        return {
            "tasks": {name: self.vm.waits_for(name) or "its turn" for name in memory.tasks},
            "flags": list(memory.flags),
            "variables": dict(sorted(memory.variables.items())),
            "axes": {axis: round(count * STEP_MM, 4) for axis, count in sorted(memory.counts.items())},
            "doubtful": list(memory.doubtful),
            "commands": memory.commands,
            "idle": round(self.vm.idle, 3),
        }

    def settables(self) -> Mapping[str, Settable]:
        memory, program = self.vm.memory, self.vm.program
        words = {"variable": ("PUSHV", "POPV", "FOR", "IN"), "flag": ("SETF", "CLRF", "TAKEF", "WAITF")}
        found: dict[str, tuple[str, ...]] = {}
        for noun, ops in words.items():
            names: set[str] = set()
            for each in program.code:
                if each.op in ops:
                    names |= {each.operand} if isinstance(each.operand, str) else {*(each.operand or ())}  # type: ignore[misc]
            found[noun] = tuple(sorted(names))
        return {
            "variable": Settable(
                noun="variable", usage="NAME n", names=found["variable"], units=(1.0,), fewest=1,
                present=lambda name: (memory.variables.get(name, 0.0),),
            ),
            "flag": Settable(
                noun="flag (1 sets it, 0 clears it)", usage="NAME n", names=found["flag"], units=(1.0,), fewest=1,
                present=lambda name: (float(name in memory.flags),),
            ),
        }  # fmt: skip

    def _set(self, what: str, name: str, number: float) -> None:
        memory = self.vm.memory
        if what == "variable":
            memory.variables[name] = number
        elif number in (0.0, 1.0):
            flags = {*memory.flags} - {name}
            memory.flags = tuple(sorted(flags | {name} if number else flags))
        else:
            raise Refused(f"a flag is set by 1 and cleared by 0, not by {number:g}")


def _gantries(setup: Setup) -> "tuple[WiredBus, Gantries, Witness[Any] | None]":
    """Return the bus of the simulated machine, the gantries, and the witness of the job on their board."""
    from handeye.systems.sigma.gantries.faults import gantries_of, planted_in
    from handeye.systems.sigma.gantries.job import JobTask
    from handeye.systems.sigma.gantries.machine import SUPERSIGMA as SUPERSIGMA_RIG
    from handeye.systems.sigma.gantries.machine import scene
    from handeye.systems.sigma.gantries.world import GantryWorld

    assert isinstance(setup.plan, MalPlan)
    world, witness, task = GantryWorld(setup.world), None, any_task(setup.plan.task)
    if isinstance(task, JobTask):
        spec, witness = task.board(world, setup.plan.pieces)
        rig, layout = task.rig, task.layout
    else:
        spec, rig, layout = scene(world), SUPERSIGMA_RIG, SUPERSIGMA
    planted = planted_in(setup.world)
    gantries = gantries_of(spec, world, planted, rig)
    if isinstance(task, JobTask):
        task.equip(world, setup.plan.pieces, gantries)
    if witness is not None:
        witness.watch(gantries)
    defects = [defect for each in planted for defect in each.bus]
    bus = WiredBus(
        layout, plant=gantries, defects=defects, seed=setup.world.seed, clock_spread=world.clock_spread
    )
    return bus, gantries, witness
