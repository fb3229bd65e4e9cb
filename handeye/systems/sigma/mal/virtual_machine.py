"""The virtual machine of MAL. It executes one statement of each task in turn, and handles aborts and deadlocks.

The virtual machine uses the simulated machine only through `ports/microbus.py`. Between two statements, the memory of
the virtual machine is its complete state.
"""

import math
from collections.abc import Callable
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument
from handeye.core.mutable_records import put_back
from handeye.ports.microbus import BusFault, MicrobusPort, Status
from handeye.program.events import SystemEvent
from handeye.systems.sigma import protocol
from handeye.systems.sigma.mal.compiler import MalProgram
from handeye.systems.sigma.mal.happenings import CountDoubtful, MotorAborted
from handeye.systems.sigma.mal.memory import (
    Fault,
    Flags,
    MalMemory,
    Moment,
    Motors,
    Owner,
    TaskMemory,
    TypedNumber,
)
from handeye.systems.sigma.mal.operations import Operations
from handeye.systems.sigma.mal.syntax import MAIN
from handeye.systems.sigma.protocol import STEP_MM

STATEMENT_US: Final = 2000  # time that the central computer needs for a statement
ARITHMETIC_SHARE: Final = 4  # number of calculations that take as long as a statement
DOUBT_N: Final = 20.0  # force on a wrist above which the count of its axis is doubted
NEIGHBOURS: Final = {1: 2, 2: 1, 3: 4, 4: 3}  # arms with wrists, and the arm on the same rail
NEAR_MM: Final = 500.0  # X1 + X2 from which on an arm may have hit the other arm; their hands meet at 560


class VirtualMachine:
    """Executes a compiled program. `tell` is called with each event; `poll` is called before each advance of the
    clock.
    """

    def __init__(
        self,
        program: MalProgram,
        machine: MicrobusPort,
        tell: Callable[[SystemEvent], None] = lambda _: None,
        *,
        poll: Callable[[], None] = lambda: None,
        statement_us: int = STATEMENT_US,
    ) -> None:
        self.program, self.machine = program, machine
        self._operations = Operations(program, machine, MalMemory(), tell)
        self._tell, self._poll, self._statement_us = tell, poll, statement_us

    # -- knowing -------------------------------------------------------------------------------------------

    @property
    def memory(self) -> MalMemory:
        """The complete state between two statements."""
        return self._operations.memory

    @memory.setter
    def memory(self, memory: MalMemory) -> None:
        self._operations.memory = memory

    @property
    def time(self) -> float:
        """Seconds since the program began."""
        return self._operations.time

    @property
    def idle(self) -> float:
        """Idle time of the central computer, as a fraction of the time since the program began."""
        passed = self.machine.now - self.memory.began
        return 1.0 - self.memory.worked / passed if passed else 0.0

    @property
    def turn(self) -> str:
        """The task whose turn it is; empty if no task can continue."""
        return self.memory.turn

    def waits_for(self, task: str) -> str:
        """Say in words what a task waits for. The text is empty if the task waits only for its turn."""
        match self.memory.tasks[task].waits:
            case Flags(names=names):
                return f"{'flag' if len(names) == 1 else 'flags'} {' and '.join(names)}"
            case Motors(names=names):
                busy = [name for name in names if self._operations.busy(name)] or names
                return f"{' and '.join(busy)} to be free"
            case Moment(until=until):
                return f"{(until - self.memory.began) / 1e6:.3f} s"
            case TypedNumber(name=name):
                return f"a number for {name}, typed at the console"
        return ""

    # -- going on ------------------------------------------------------------------------------------------

    def begin(self) -> None:
        """Start the task MAIN, and determine whose turn it is."""
        self.memory.began = self.machine.now
        self._operations.start(MAIN)
        self.settle()

    def statement(self) -> None:
        """Execute the statement of the task whose turn it is, until the statement ends or waits. `settle` then
        determines the next task.
        """
        memory, name = self.memory, self.memory.turn
        memory.last, began = name, self.machine.now
        calculated = self._operations.run(name, memory.tasks[name])
        self._spend(self._statement_us + calculated * (self._statement_us // ARITHMETIC_SHARE))
        memory.worked += self.machine.now - began

    def settle(self) -> None:
        """Let time pass until a task can begin a statement, until all tasks have ended, or until the program has
        stopped.
        """
        self.memory.turn = ""
        while self.memory.fault is None and self.memory.tasks:
            self._see_aborts()
            if self.memory.fault is not None:
                return
            ready = self._ready()
            if ready is not None:
                self.memory.turn = ready
                return
            if self.memory.fault is None and self.memory.tasks and not self._pass_time():
                self._stand_still()

    def choose(self, task: str) -> None:
        """Give the turn to a task that can begin a statement."""
        self.memory.turn = task

    def proceed(self) -> None:
        """Continue after the statement at which the program has stopped."""
        fault = self._unfault()
        task = self.memory.tasks.get(fault.task)
        if fault.kind in ("trap", "abort", "fail") and task is not None:
            self._abandon(task, self._operations.behind(fault.address))
        self.settle()

    def retry(self) -> None:
        """Repeat the statement at which the program has stopped."""
        fault = self._unfault()
        task = self.memory.tasks.get(fault.task)
        if fault.kind in ("trap", "abort", "fail") and task is not None:
            self._abandon(task, fault.address)
        self.settle()

    def end(self) -> None:
        """End all tasks."""
        self.memory.fault = None
        for name in (*self.memory.tasks,):
            self._operations.end(name, killed=True)
        self.memory.turn = ""

    def type_number(self, text: str, task: str = "") -> None:
        """Give a number to a task that waits for one. Raises InvalidInput if no task waits for a number, or if the
        text is not a number.
        """
        waiting = [name for name, each in self.memory.tasks.items() if isinstance(each.waits, TypedNumber)]
        if (task and task not in waiting) or not waiting:
            raise BadArgument(
                "no task waits for a number"
                if not task
                else f"the task {quoted(task)} does not wait for a number"
            )
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value) or len(text) > 40:
            raise BadArgument(f"{quoted(text)} is not a number")
        found = self.memory.tasks[task or waiting[0]]
        assert isinstance(found.waits, TypedNumber)
        self.memory.variables[found.waits.name] = value
        found.waits, found.pc = None, found.pc + 1
        if self.memory.fault is not None and self.memory.fault.kind == "input":
            self.memory.fault = None

    def remember(self, memory: MalMemory) -> None:
        """Continue from a state that fits the program."""
        put_back(self.memory, memory)

    def fits(self, memory: MalMemory) -> bool:
        """Return True if all addresses and names in a state belong to this program."""
        size, tasks = len(self.program.code), self.program.tasks
        addresses = [each.pc for each in memory.tasks.values()]
        for each in memory.tasks.values():
            addresses += [*each.returns, *each.handlers.values(), *(loop.begin for loop in each.loops)]
            addresses += [] if each.resume is None else [each.resume]
        addresses += [owner.address for owner in memory.owners.values()]
        addresses += [] if memory.fault is None else [memory.fault.address]
        return (
            all(0 <= address < size for address in addresses)
            and {*memory.tasks} <= {*tasks}
            and memory.turn in {"", *memory.tasks}
            and {*memory.counts, *memory.owners, *memory.curves, *memory.stopped, *memory.doubtful}
            <= {*self.program.axes}
        )

    # -- turns ---------------------------------------------------------------------------------------------

    def _order(self) -> list[str]:
        """Return the tasks in the order of their next turns. The task that had the last turn comes last."""
        names = [*self.memory.tasks]
        after = names.index(self.memory.last) + 1 if self.memory.last in names else 0
        return names[after:] + names[:after]

    def _ready(self) -> str | None:
        for name in self._order():
            if name in self.memory.tasks and self.goes_on(name):
                return name
            if self.memory.fault is not None:
                return None
        return None

    def goes_on(self, name: str) -> bool:
        """If a task waits for a condition that is now met, end the wait. Returns True if the task can then begin a
        statement.
        """
        task = self.memory.tasks[name]
        if task.amid:
            if task.waits is not None and not self._operations.met(name, task, task.waits):
                return False
            began = self.machine.now
            self._operations.run(name, task)
            self.memory.worked += self.machine.now - began
        if task.pc in self.program.closing and name in self.memory.tasks and not task.amid:
            self._operations.end(name)
        return name in self.memory.tasks and not task.amid and self.memory.fault is None

    def _pass_time(self) -> bool:
        """Let time pass until something may have changed. Returns False if nothing can change without a
        command."""
        moments = [each.waits.until for each in self.memory.tasks.values() if isinstance(each.waits, Moment)]
        event = self.machine.next_event
        times = moments if event is None else [*moments, event]
        if not times:
            return False
        self._poll()
        self.machine.wait(max(min(times), self.machine.now + 1))
        return True

    def _stand_still(self) -> None:
        """Handle the case that all tasks wait and nothing can change without a command. Either a task waits for
        a typed number, or the tasks are in a deadlock.
        """
        tasks = self.memory.tasks
        typing = next((name for name, each in tasks.items() if isinstance(each.waits, TypedNumber)), None)
        if typing is not None:
            line = self.program.line_of(tasks[typing].pc)
            told = f"the task {typing}, line {line.number}, waits for {self.waits_for(typing)}"
            self.memory.fault = Fault(kind="input", task=typing, address=line.begin, told=told)
            return
        waiting = [
            f"the task {name}, line {self.program.line_of(task.pc).number}, waits for {self.waits_for(name)}"
            for name, task in tasks.items()
        ]
        first = next(iter(tasks))
        self.memory.fault = Fault(
            kind="deadlock", task=first, address=self.program.line_of(tasks[first].pc).begin,
            told=f"DEADLOCK: {'; '.join(waiting)}",
        )  # fmt: skip

    def _spend(self, microseconds: int) -> None:
        """Advance the clock by the time that the central computer needs for its work."""
        self._poll()
        until = self.machine.now + microseconds
        while self.machine.now < until:
            self.machine.wait(until)

    def _abandon(self, task: TaskMemory, address: int) -> None:
        """Let a task continue at an address, and discard what it was doing."""
        task.pc, task.amid, task.waits = address, False, None
        task.stack.clear()
        task.outgoing.clear()

    def _unfault(self) -> Fault:
        fault = self.memory.fault
        assert fault is not None
        self.memory.fault = None
        return fault

    # -- aborts --------------------------------------------------------------------------------------------

    def _see_aborts(self) -> None:
        """If a motor has raised the interrupt, query the motor's position. The task that moved the motor continues at
        the line that the task's ON ABORT statement names. If the task has no ON ABORT statement, the program stops.
        """
        if not self.machine.interrupt:
            return
        for axis in self.program.axes:
            status = self.machine.status(protocol.LINE_NUMBERS[axis])
            if not status.aborted or axis in self.memory.stopped:
                continue
            self.memory.stopped[axis] = int(status)
            owner = self.memory.owners.get(axis)
            name = "" if owner is None else owner.task
            try:
                self.memory.counts[axis] = protocol.signed(
                    self._operations.ask(name, protocol.position(axis))
                )
            except BusFault as error:
                self.memory.fault = Fault(kind="trap", task=name, address=0, told=str(error))
                return
            at, cause = self.memory.counts[axis] * STEP_MM, status.name
            self._tell(MotorAborted(time=self.time, task=name, axis=axis, cause=cause, at=round(at, 4)))
            if status is Status.FORCE:
                self._doubt(name)
            self._after_abort(axis, owner, f"ABORT {axis} {cause} {at:.2f}")

    def _doubt(self, name: str) -> None:
        """Ask both wrists for the greatest forces that they have felt: a motor that is at rest does not report that
        its axis was hit.

        If an arm was hit above its wrist, that wrist feels nothing. Therefore, while the arms are near each other, a
        great force on one wrist makes two counts doubtful: the counts of the same axis of both arms.
        """
        peaks = {axis: self._peak(name, axis) for axis in self.program.axes if int(axis[1]) in NEIGHBOURS}
        for axis, own in peaks.items():
            neighbour = NEIGHBOURS[int(axis[1])]
            other, near = peaks[f"{axis[0]}{neighbour}"], self._near(f"X{axis[1]}", f"X{neighbour}")
            felt = own is None or own > DOUBT_N
            met = near and axis in self.memory.originated and other is not None and other > DOUBT_N
            if axis not in self.memory.doubtful and (felt or met):
                self.memory.doubtful = tuple(sorted({*self.memory.doubtful, axis}))
                force = own if felt else other
                self._tell(CountDoubtful(time=self.time, axis=axis, force=force, above=not felt))

    def _peak(self, name: str, axis: str) -> float | None:
        """Query the greatest force on a wrist along an axis (N). Returns None if the wrist does not answer."""
        try:
            answer = self._operations.ask(name, protocol.force(int(axis[1]), axis[0], peak=True))
        except BusFault:
            return None
        return protocol.signed(answer) * protocol.FORCE_STEP_N

    def _near(self, *arms: str) -> bool:
        """Return True if the arms of one rail may have met, according to the counts of their X axes."""
        memory = self.memory
        if not {*arms} <= {*memory.originated}:
            return True
        return sum(memory.counts[axis] for axis in arms) * STEP_MM >= NEAR_MM

    def _after_abort(self, axis: str, owner: Owner | None, told: str) -> None:
        task = None if owner is None else self.memory.tasks.get(owner.task)
        if owner is None or task is None:
            address = 0 if owner is None else owner.address
            whose = (
                "no task started this motion"
                if owner is None
                else f"the task {owner.task}, which started this motion, has ended"
            )
            fault = Fault(
                kind="abort",
                task="" if owner is None else owner.task,
                address=address,
                told=f"{told}; {whose}",
            )
            self.memory.fault = self.memory.fault or fault
            return
        handler = task.handlers.get(axis, task.handlers.get("", -1))
        if handler >= 0:
            task.resume = self._operations.behind(owner.address)
            self._abandon(task, handler)
        elif self.memory.fault is None:
            line = self.program.line_of(owner.address).number
            told = f"{told}: the task {owner.task}, line {line}{self._doubts()}"
            self.memory.fault = Fault(kind="abort", task=owner.task, address=owner.address, told=told)

    def _doubts(self) -> str:
        axes = self.memory.doubtful
        if not axes:
            return ""
        counts = (
            f"the count of {axes[0]} is"
            if len(axes) == 1
            else f"the counts of {', '.join(axes[:-1])} and {axes[-1]} are"
        )
        return f"; {counts} doubtful until ORIGIN"
