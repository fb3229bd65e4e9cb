"""The virtual machine: tasks in turn, a statement each, over the bus.

All it knows of the machine is `ports/microbus.py`. Between two statements everything it remembers is its memory.
"""

import math
from collections.abc import Callable
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, HandeyeError, InvalidInput
from handeye.core.mutable_records import put_back
from handeye.core.plain_text import counted
from handeye.ports.microbus import BusFault, Command, MicrobusPort, Status
from handeye.program.events import SystemEvent
from handeye.systems.sigma import protocol
from handeye.systems.sigma.mal.compiler import ARITHMETIC, Instruction, MalProgram
from handeye.systems.sigma.mal.happenings import (
    Answered,
    CommandSent,
    CountDoubtful,
    FlagChanged,
    MotorAborted,
    Printed,
    TaskEnded,
    TaskStarted,
)
from handeye.systems.sigma.mal.line_moves import line_moves
from handeye.systems.sigma.mal.memory import (
    Fault,
    Flags,
    Loop,
    MalMemory,
    Moment,
    Motors,
    Outgoing,
    Owner,
    TaskMemory,
    TypedNumber,
    Waiting,
)
from handeye.systems.sigma.mal.syntax import MAIN
from handeye.systems.sigma.mal.words import MAL_DEVICES
from handeye.systems.sigma.protocol import AXES, STEP_MM, Op

STATEMENT_US: Final = 2000  # the central computer needs this for a statement
ARITHMETIC_SHARE: Final = 4  # an instruction that calculates takes this part of it
DOUBT_N: Final = 20.0  # force on a wrist above which the count of its axis is doubted
DEEPEST_GOSUB: Final = 1000
LONGEST_PRINTED: Final = 2000  # characters of a line
ZONE: Final = 14  # columns of PRINT
_LARGEST_STEPS: Final = 0x7FFF  # of a count, which has 16 bits with its sign
_MOST_INSTRUCTIONS: Final = 100_000  # of a statement: none has a loop


class Trap(HandeyeError):
    """A statement cannot be executed."""


class VirtualMachine:
    """Executes a compiled program. `tell` hears what happens, `poll` is called before time passes."""

    def __init__(
        self,
        program: MalProgram,
        machine: MicrobusPort,
        tell: Callable[[SystemEvent], None] = lambda _: None,
        *,
        poll: Callable[[], None] = lambda: None,
        statement_us: int = STATEMENT_US,
    ) -> None:
        self.program, self.machine, self.memory = program, machine, MalMemory()
        self._tell, self._poll, self._statement_us = tell, poll, statement_us
        self._acts = {
            name.removeprefix("_do_").upper(): getattr(self, name)
            for name in dir(self)
            if name.startswith("_do_")
        }

    # -- knowing --------------------------------------------------------------------------------------

    @property
    def time(self) -> float:
        """Seconds since the program began."""
        return (self.machine.now - self.memory.began) / 1e6

    @property
    def idle(self) -> float:
        """The share of the time in which the central computer had nothing to do."""
        passed = self.machine.now - self.memory.began
        return 1.0 - self.memory.worked / passed if passed else 0.0

    @property
    def turn(self) -> str:
        """The task whose turn it is; empty: none can go on."""
        return self.memory.turn

    def waits_for(self, task: str) -> str:
        """What a task waits for, in words; empty: its turn."""
        match self.memory.tasks[task].waits:
            case Flags(names=names):
                return f"{'flag' if len(names) == 1 else 'flags'} {' and '.join(names)}"
            case Motors(names=names):
                busy = [name for name in names if self._busy(name)] or names
                return f"{' and '.join(busy)} to be free"
            case Moment(until=until):
                return f"{(until - self.memory.began) / 1e6:.3f} s"
            case TypedNumber(name=name):
                return f"a number for {name}, typed at the console"
        return ""

    # -- going on -------------------------------------------------------------------------------------

    def begin(self) -> None:
        """Start the task MAIN, and find whose turn it is."""
        self.memory.began = self.machine.now
        self._start(MAIN)
        self.settle()

    def statement(self) -> None:
        """Execute the statement of the task whose turn it is, as far as it goes; `settle` then finds the next."""
        memory, name = self.memory, self.memory.turn
        memory.last, began = name, self.machine.now
        calculated = self._run(name, memory.tasks[name])
        self._spend(self._statement_us + calculated * (self._statement_us // ARITHMETIC_SHARE))
        memory.worked += self.machine.now - began

    def settle(self) -> None:
        """Let time pass until a task can begin a statement; none if all have ended, or the program stands."""
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
        """Give the turn to a task, whose statement it can begin."""
        self.memory.turn = task

    def proceed(self) -> None:
        """Go on behind the statement at which the program stands."""
        fault = self._unfault()
        task = self.memory.tasks.get(fault.task)
        if fault.kind in ("trap", "abort") and task is not None:
            self._abandon(task, self._behind(fault.address))
        self.settle()

    def retry(self) -> None:
        """Execute the statement at which the program stands again."""
        fault = self._unfault()
        task = self.memory.tasks.get(fault.task)
        if fault.kind in ("trap", "abort") and task is not None:
            self._abandon(task, fault.address)
        self.settle()

    def end(self) -> None:
        """End all tasks."""
        self.memory.fault = None
        for name in (*self.memory.tasks,):
            self._end(name, killed=True)
        self.memory.turn = ""

    def type_number(self, text: str, task: str = "") -> None:
        """Give the task that waits for it a number; raises InvalidInput if none waits, or the text is none."""
        waiting = [name for name, each in self.memory.tasks.items() if isinstance(each.waits, TypedNumber)]
        if (task and task not in waiting) or not waiting:
            raise BadArgument(
                "no task waits for a number" if not task else f"the task {quoted(task)} waits for no number"
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
        """Go on from a memory that fits the program."""
        put_back(self.memory, memory)

    def fits(self, memory: MalMemory) -> bool:
        """True if all addresses and names of a memory are of this program."""
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
            and {*memory.counts, *memory.owners, *memory.curves, *memory.stopped, *memory.doubtful} <= {*AXES}
        )

    # -- turns ----------------------------------------------------------------------------------------

    def _order(self) -> list[str]:
        """The tasks, those first that come behind the one that had its turn last."""
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
        """Finish what a task waited for, if that has come about; True if it can begin a statement then."""
        task = self.memory.tasks[name]
        if task.amid:
            if task.waits is not None and not self._met(name, task, task.waits):
                return False
            began = self.machine.now
            self._run(name, task)
            self.memory.worked += self.machine.now - began
        if task.pc in self.program.closing and name in self.memory.tasks and not task.amid:
            self._end(name)
        return name in self.memory.tasks and not task.amid and self.memory.fault is None

    def _met(self, name: str, task: TaskMemory, waits: Waiting) -> bool:
        """True if what a task waits for has come about; it is done with then."""
        match waits:
            case Flags(names=names, take=take):
                if not {*names} <= {*self.memory.flags}:
                    return False
                for flag in names if take else ():
                    self._change_flag(name, flag, on=False, change="takes")
                task.pc += 1
            case Motors(names=names):
                if any(self._busy(each) for each in names):
                    return False
            case Moment(until=until):
                if self.machine.now < until:
                    return False
                task.pc += 1
            case TypedNumber():
                return False
        task.waits = None
        return True

    def _pass_time(self) -> bool:
        """Let time pass until something may have changed; False if nothing comes by itself."""
        moments = [each.waits.until for each in self.memory.tasks.values() if isinstance(each.waits, Moment)]
        event = self.machine.next_event
        times = moments if event is None else [*moments, event]
        if not times:
            return False
        self._poll()
        self.machine.wait(max(min(times), self.machine.now + 1))
        return True

    def _stand_still(self) -> None:
        """All tasks wait, and nothing comes by itself: a number is wanted, or it is a deadlock."""
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
        """The central computer works for so long."""
        self._poll()
        until = self.machine.now + microseconds
        while self.machine.now < until:
            self.machine.wait(until)

    # -- tasks ----------------------------------------------------------------------------------------

    def _start(self, name: str) -> None:
        self.memory.tasks[name] = TaskMemory(pc=self.program.tasks[name])
        self._tell(TaskStarted(time=self.time, task=name))

    def _end(self, name: str, *, killed: bool = False) -> None:
        del self.memory.tasks[name]
        self._tell(TaskEnded(time=self.time, task=name, killed=killed))

    def _behind(self, address: int) -> int:
        """The address behind the line that an address belongs to."""
        index = self.program.line_at[address]
        line = self.program.lines[index]
        if index + 1 < len(self.program.lines) and self.program.lines[index + 1].task == line.task:
            return self.program.lines[index + 1].begin
        return min(each for each in self.program.closing if each >= line.begin)

    def _abandon(self, task: TaskMemory, address: int) -> None:
        """Let a task go on at an address, whatever it did."""
        task.pc, task.amid, task.waits = address, False, None
        task.stack.clear()
        task.outgoing.clear()

    def _unfault(self) -> Fault:
        fault = self.memory.fault
        assert fault is not None
        self.memory.fault = None
        return fault

    # -- instructions ---------------------------------------------------------------------------------

    def _run(self, name: str, task: TaskMemory) -> int:
        """Execute instructions to the end of the statement, or to where it waits; how many of them calculated."""
        task.amid, began, calculated = True, self.program.line_of(task.pc).begin, 0
        try:
            for _ in range(_MOST_INSTRUCTIONS):
                instruction = self.program.code[task.pc]
                calculated += instruction.op in ARITHMETIC
                self._acts[instruction.op](name, task, instruction)
                if not task.amid or task.waits is not None or name not in self.memory.tasks:
                    return calculated
        except (Trap, BusFault, InvalidInput, OverflowError) as error:
            number = self.program.line_of(began).number
            self.memory.fault = Fault(kind="trap", task=name, address=began, told=f"line {number}: {error}")
        return calculated

    def _do_pushc(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        assert isinstance(instruction.operand, float)
        self._push(task, instruction.operand)

    def _do_pushv(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        self._push(task, self.memory.variables.get(_text(instruction), 0.0))

    def _do_popv(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        self.memory.variables[_text(instruction)] = task.stack.pop()
        task.pc += 1

    def _binary(self, task: TaskMemory, operate: Callable[[float, float], float]) -> None:
        right, left = task.stack.pop(), task.stack.pop()
        self._push(task, operate(left, right))

    def _do_add(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._binary(task, lambda a, b: a + b)

    def _do_sub(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._binary(task, lambda a, b: a - b)

    def _do_mul(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._binary(task, lambda a, b: a * b)

    def _do_div(self, _: str, task: TaskMemory, __: Instruction) -> None:
        if not task.stack[-1]:
            raise Trap("this divides by zero")
        self._binary(task, lambda a, b: a / b)

    def _do_eq(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._binary(task, lambda a, b: float(a == b))

    def _do_ne(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._binary(task, lambda a, b: float(a != b))

    def _do_lt(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._binary(task, lambda a, b: float(a < b))

    def _do_gt(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._binary(task, lambda a, b: float(a > b))

    def _do_le(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._binary(task, lambda a, b: float(a <= b))

    def _do_ge(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._binary(task, lambda a, b: float(a >= b))

    def _do_and(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._binary(task, lambda a, b: float(a != 0 and b != 0))

    def _do_or(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._binary(task, lambda a, b: float(a != 0 or b != 0))

    def _do_not(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._push(task, float(task.stack.pop() == 0))

    def _do_neg(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._push(task, -task.stack.pop())

    def _do_abs(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._push(task, abs(task.stack.pop()))

    def _do_int(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._push(task, float(math.floor(task.stack.pop())))

    def _do_sgn(self, _: str, task: TaskMemory, __: Instruction) -> None:
        value = task.stack.pop()
        self._push(task, float((value > 0) - (value < 0)))

    def _do_sqr(self, _: str, task: TaskMemory, __: Instruction) -> None:
        value = task.stack.pop()
        if value < 0:
            raise Trap(f"SQR takes no negative number, and this is {value:g}")
        self._push(task, math.sqrt(value))

    def _do_time(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._push(task, self.time)

    def _do_pos(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        axis = _text(instruction)
        if axis not in self.memory.originated:
            raise Trap(f"NOTORIGINATED: ORIGIN {axis} comes before POS({axis})")
        self._push(task, self.memory.counts.get(axis, 0) * STEP_MM)

    def _do_stat(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        axis = _text(instruction)
        status = self.machine.status(protocol.NUMBERS[axis])
        kept = self.memory.stopped.get(axis, 0) if status is Status.FREE else 0
        self._push(task, float(kept or status))

    def _do_force(self, name: str, task: TaskMemory, instruction: Instruction) -> None:
        axis = _text(instruction)
        answer = self._ask(name, protocol.force(int(axis[1]), axis[0]))
        self._push(task, protocol.signed(answer) * protocol.FORCE_STEP_N)

    def _do_crashpos(self, name: str, task: TaskMemory, instruction: Instruction) -> None:
        answer = self._ask(name, protocol.position(_text(instruction), at_abort=True))
        self._push(task, protocol.signed(answer) * STEP_MM)

    def _do_beam(self, name: str, task: TaskMemory, __: Instruction) -> None:
        arm = task.stack.pop()
        if arm not in (1, 2):
            raise Trap(f"the arms are 1 and 2, and not {arm:g}")
        self._push(task, float(self._ask(name, protocol.beam(int(arm)))[0]))

    def _do_jmp(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        task.pc = instruction.target

    def _do_jz(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        task.pc = task.pc + 1 if task.stack.pop() else instruction.target

    def _do_nextline(self, _: str, task: TaskMemory, __: Instruction) -> None:
        task.pc, task.amid = task.pc + 1, False

    def _do_go(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        task.pc, task.amid = instruction.target, False

    def _do_call(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        if len(task.returns) >= DEEPEST_GOSUB:
            raise Trap(f"{counted(DEEPEST_GOSUB, 'GOSUB')} are under way: a subroutine does not RETURN")
        task.returns.append(self._behind(task.pc))
        self._do_go("", task, instruction)

    def _do_ret(self, _: str, task: TaskMemory, __: Instruction) -> None:
        if not task.returns:
            raise Trap("no GOSUB is under way")
        task.pc, task.amid = task.returns.pop(), False

    def _do_for(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        name = _text(instruction)
        step, last, first = task.stack.pop(), task.stack.pop(), task.stack.pop()
        if not step:
            raise Trap("a STEP of 0 never ends")
        self.memory.variables[name] = first
        names = [loop.name for loop in task.loops]
        del task.loops[names.index(name) if name in names else len(names) :]
        if len(task.loops) >= DEEPEST_GOSUB:
            raise Trap(f"{counted(DEEPEST_GOSUB, 'loop')} are under way")
        task.loops.append(Loop(name=name, last=last, step=step, begin=self._behind(task.pc)))
        task.pc += 1

    def _do_next(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        name = _text(instruction)
        names = [loop.name for loop in task.loops]
        if name not in names:
            raise Trap(f"no FOR {name} is under way")
        del task.loops[names.index(name) + 1 :]
        loop = task.loops[-1]
        value = self.memory.variables.get(name, 0.0) + loop.step
        self.memory.variables[name] = value
        if value * math.copysign(1, loop.step) <= loop.last * math.copysign(1, loop.step):
            task.pc, task.amid = loop.begin, False
        else:
            task.loops.pop()
            task.pc += 1

    def _do_end(self, name: str, _: TaskMemory, __: Instruction) -> None:
        self._end(name)

    def _do_halt(self, _: str, __: TaskMemory, ___: Instruction) -> None:
        for name in (*self.memory.tasks,):
            self._end(name)

    def _do_start(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        for name in _names(instruction):
            if name in self.memory.tasks:
                raise Trap(f"the task {name} is under way already")
            self._start(name)
        task.pc += 1

    def _do_kill(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        task.pc += 1
        for name in _names(instruction):
            if name in self.memory.tasks:
                self._end(name, killed=True)

    def _do_setf(self, name: str, task: TaskMemory, instruction: Instruction) -> None:
        self._change_flag(name, _text(instruction), on=True, change="sets")
        task.pc += 1

    def _do_clrf(self, name: str, task: TaskMemory, instruction: Instruction) -> None:
        self._change_flag(name, _text(instruction), on=False, change="clears")
        task.pc += 1

    def _do_waitf(self, name: str, task: TaskMemory, instruction: Instruction) -> None:
        self._wait(name, task, Flags(names=_names(instruction), take=False))

    def _do_takef(self, name: str, task: TaskMemory, instruction: Instruction) -> None:
        self._wait(name, task, Flags(names=(_text(instruction),), take=True))

    def _do_sleep(self, name: str, task: TaskMemory, __: Instruction) -> None:
        seconds = task.stack.pop()
        if not 0 <= seconds <= 86400:
            raise Trap(f"a delay is from 0 to 86400 s, and not {seconds:g}")
        self._wait(name, task, Moment(until=self.machine.now + round(seconds * 1e6)))

    def _do_in(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        task.waits = TypedNumber(name=_text(instruction))

    def _do_trap(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        task.handlers[_text(instruction)] = instruction.target
        task.pc += 1

    def _do_resume(self, _: str, task: TaskMemory, __: Instruction) -> None:
        if task.resume is None:
            raise Trap("no motion of this task was aborted")
        task.pc, task.amid, task.resume = task.resume, False, None

    # -- commands -------------------------------------------------------------------------------------

    def _do_goal(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        axis, mode = _names(instruction)
        value = task.stack.pop() / STEP_MM
        count = self.memory.counts.get(axis, 0)
        target = round(value) + (count if mode == "BY" else 0)
        if abs(target) > _LARGEST_STEPS:
            most = _LARGEST_STEPS * STEP_MM
            raise Trap(
                f"a place is at most {most:.0f} mm from 0; {axis} would go to {target * STEP_MM:.6g} mm"
            )
        task.outgoing.insert(0, Outgoing(to=axis, target=target))
        task.pc += 1

    def _do_speeds(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        if instruction.operand == "LINE":
            goals = [(each.to, each.target or 0) for each in task.outgoing]
            task.outgoing[:] = line_moves(goals, self.memory.counts)
        else:
            speed = task.stack.pop()
            if not 2 <= speed <= 254:
                raise Trap(f"a constant speed is from 2 to 254 mm/s, and not {speed:g}")
            task.outgoing[:] = [
                Outgoing(to=each.to, target=each.target, slow=speed) for each in task.outgoing
            ]
        task.pc += 1

    def _do_orig(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        names = _names(instruction)
        task.outgoing += [Outgoing(to=axis, command=protocol.origin(axis)) for axis in names]
        task.pc += 1

    def _do_act(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        name, value = _text(instruction), task.stack.pop()
        if not 0 <= value <= 0xFFFF or value != int(value):
            raise Trap(f"{name} takes a whole number from 0 to 65535, and not {value:g}")
        arm, device = MAL_DEVICES[name]
        task.outgoing.append(Outgoing(to=f"HAND{arm}", command=protocol.actuate(arm, device, int(value))))
        task.pc += 1

    def _do_limspeed(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        (axis,), speed = _names(instruction), task.stack.pop()
        if not 0 <= speed <= 2400:
            raise Trap(f"a limit of speed is from 0 to 2400 mm/s, and not {speed:g}")
        command = protocol.limit_speed(axis, round(speed / STEP_MM))
        task.outgoing.append(Outgoing(to=axis, command=command))
        task.pc += 1

    def _do_curve(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        (axis,), curve = _names(instruction), task.stack.pop()
        if curve not in (0, 1, 2, 3, 4):
            raise Trap(f"a curve is 0, 1, 2, 3 or 4, and not {curve:g}")
        self.memory.curves[axis] = int(curve)
        task.pc += 1

    def _do_threshold(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        axis, *standard = _names(instruction)
        newtons = None if standard else task.stack.pop()
        if newtons is not None and not 0 <= newtons <= 655:
            raise Trap(f"a limit of force is from 0 to 655 N, and not {newtons:g}")
        command = protocol.threshold(int(axis[1]), axis[0], newtons)
        task.outgoing.append(Outgoing(to=f"FORCE{axis[1]}", command=command))
        task.pc += 1

    def _do_cmd(self, name: str, task: TaskMemory, _: Instruction) -> None:
        """Send what is to be sent, in order; wait for what is busy."""
        while task.outgoing:
            first = task.outgoing[0]
            needed = tuple(each for each in (first.to, *first.after) if self._busy(each))
            if needed:
                task.waits = Motors(names=needed)
                return
            self._send(name, task, task.outgoing.pop(0))
        task.pc += 1

    def _do_busywait(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        busy = tuple(name for name in _names(instruction) if self._busy(name))
        if busy:
            task.waits = Motors(names=busy)
        else:
            task.pc += 1

    def _send(self, name: str, task: TaskMemory, what: Outgoing) -> None:
        command, means = what.command, ""
        if command is None:
            assert what.target is not None
            steps = what.target - self.memory.counts.get(what.to, 0)
            if not steps:
                return
            curve = self.memory.curves.get(what.to, 0)
            command = (
                protocol.move_slow(what.to, steps, what.slow)
                if what.slow
                else protocol.move(what.to, steps, curve)
            )
            self.memory.counts[what.to] = what.target
            means = f"move by {counted(steps, 'step')}" + (f" at {what.slow:g} mm/s" if what.slow else "")
        if what.to in AXES:
            began = self.program.line_of(task.pc).begin
            self.memory.owners[what.to] = Owner(task=name, address=began)
            self.memory.stopped.pop(what.to, None)
        if command.op == Op.ORIGIN:
            self.memory.counts[what.to] = 0
            self.memory.originated = tuple(sorted({*self.memory.originated, what.to}))
            self.memory.doubtful = tuple(axis for axis in self.memory.doubtful if axis != what.to)
        self._transmit(name, command, means or _meaning(command))
        self.machine.send(command)

    def _transmit(self, name: str, command: Command, means: str) -> None:
        self.memory.commands += 1
        to = protocol.name_of(command.number)
        self._tell(CommandSent(time=self.time, task=name, to=to, frame=command.frame.hex(" "), means=means))

    def _ask(self, name: str, command: Command) -> bytes:
        self.memory.questions += 1
        self._transmit(name, command, _meaning(command))
        answer = self.machine.ask(command, protocol.ANSWERS[Op(command.op)])
        value = protocol.signed(answer)
        to = protocol.name_of(command.number)
        self._tell(Answered(time=self.time, task=name, to=to, answer=answer.hex(" "), means=f"{value}"))
        return answer

    def _busy(self, name: str) -> bool:
        """True if an axis or device has a command to finish; a force microcomputer always takes one."""
        if name.startswith("FORCE"):
            return False
        if name in MAL_DEVICES:
            name = f"HAND{MAL_DEVICES[name][0]}"
        return self.machine.status(protocol.NUMBERS[name]) is Status.BUSY

    # -- aborts ---------------------------------------------------------------------------------------

    def _see_aborts(self) -> None:
        """If a motor interrupts, ask where it is, and let its task go where ON ABORT says; else the program stands."""
        if not self.machine.interrupt:
            return
        for axis in AXES:
            status = self.machine.status(protocol.NUMBERS[axis])
            if not status.aborted or axis in self.memory.stopped:
                continue
            self.memory.stopped[axis] = int(status)
            owner = self.memory.owners.get(axis)
            name = "" if owner is None else owner.task
            try:
                self.memory.counts[axis] = protocol.signed(self._ask(name, protocol.position(axis)))
            except BusFault as error:
                self.memory.fault = Fault(kind="trap", task=name, address=0, told=str(error))
                return
            at, cause = self.memory.counts[axis] * STEP_MM, status.name
            self._tell(MotorAborted(time=self.time, task=name, axis=axis, cause=cause, at=round(at, 4)))
            if status is Status.FORCE:
                self._doubt(name)
            self._after_abort(axis, owner, f"ABORT {axis} {cause} {at:.2f}")

    def _doubt(self, name: str) -> None:
        """Ask both wrists what they have felt at most: a standing motor that was run into says nothing itself."""
        for axis in AXES:
            try:
                answer = self._ask(name, protocol.force(int(axis[1]), axis[0], peak=True))
            except BusFault:
                peak = None
            else:
                peak = protocol.signed(answer) * protocol.FORCE_STEP_N
            if axis not in self.memory.doubtful and (peak is None or peak > DOUBT_N):
                self.memory.doubtful = tuple(sorted({*self.memory.doubtful, axis}))
                self._tell(CountDoubtful(time=self.time, axis=axis, force=peak))

    def _after_abort(self, axis: str, owner: Owner | None, told: str) -> None:
        task = None if owner is None else self.memory.tasks.get(owner.task)
        if owner is None or task is None:
            address = 0 if owner is None else owner.address
            whose = (
                "no task had sent it" if owner is None else f"the task {owner.task} that sent it has ended"
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
            task.resume = self._behind(owner.address)
            self._abandon(task, handler)
        elif self.memory.fault is None:
            line = self.program.line_of(owner.address).number
            told = f"{told}: the task {owner.task}, line {line}{self._doubts()}"
            self.memory.fault = Fault(kind="abort", task=owner.task, address=owner.address, told=told)

    def _doubts(self) -> str:
        axes = self.memory.doubtful
        if not axes:
            return ""
        counts = f"the count of {axes[0]} is" if len(axes) == 1 else f"the counts of {' and '.join(axes)} are"
        return f"; {counts} doubtful until ORIGIN"

    # -- console --------------------------------------------------------------------------------------

    def _do_out(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        text = instruction.operand if isinstance(instruction.operand, str) else shown(task.stack.pop())
        self._print(text)
        task.pc += 1

    def _do_tab(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._print(" " * (ZONE - len(self.memory.printed) % ZONE))
        task.pc += 1

    def _do_eol(self, name: str, task: TaskMemory, __: Instruction) -> None:
        text, self.memory.printed = self.memory.printed, ""
        self._tell(Printed(time=self.time, task=name, text=text.rstrip()))
        task.pc += 1

    def _print(self, text: str) -> None:
        if len(self.memory.printed) + len(text) > LONGEST_PRINTED:
            raise Trap(f"a printed line has {LONGEST_PRINTED} characters at most")
        self.memory.printed += text

    # -- small ----------------------------------------------------------------------------------------

    def _push(self, task: TaskMemory, value: float) -> None:
        if not math.isfinite(value):
            raise Trap("this is beyond the largest number")
        task.stack.append(value)
        task.pc += 1

    def _wait(self, name: str, task: TaskMemory, waiting: Waiting) -> None:
        """Wait for something, unless it has come about."""
        task.waits = waiting
        self._met(name, task, waiting)

    def _change_flag(self, name: str, flag: str, *, on: bool, change: str) -> None:
        flags = {*self.memory.flags} - {flag}
        self.memory.flags = tuple(sorted(flags | {flag} if on else flags))
        self._tell(FlagChanged(time=self.time, task=name, flag=flag, change=change))


def shown(value: float) -> str:
    """A number as PRINT shows it."""
    whole = value == int(value) and abs(value) < 1e15
    return f"{value:.0f}" if whole else f"{value:.6g}"


def _text(instruction: Instruction) -> str:
    assert isinstance(instruction.operand, str)
    return instruction.operand


def _names(instruction: Instruction) -> tuple[str, ...]:
    assert isinstance(instruction.operand, tuple)
    return instruction.operand


_DEVICES: Final = {number: name for name, number in protocol.DEVICES.items()}


def _meaning(command: Command) -> str:
    """A command in words."""
    return {
        Op.ORIGIN: "search the end of the rail",
        Op.LIMIT_SPEED: f"limit the speed to {counted(command.value, 'step')}/s",
        Op.POSITION: "where are you?",
        Op.ABORT_POSITION: "where were you when you were aborted?",
        Op.FORCE: f"what is the force along {protocol.COMPONENTS[command.detail % 3]}?",
        Op.PEAK_FORCE: f"what was the greatest force along {protocol.COMPONENTS[command.detail % 3]}?",
        Op.THRESHOLD: f"threshold along {protocol.COMPONENTS[command.detail % 3]}: "
        + (
            "standard"
            if command.value == protocol.STANDARD
            else f"{command.value * protocol.FORCE_STEP_N:g} N"
        ),
        Op.ACTUATE: f"{_DEVICES.get(command.detail, command.detail)} to {command.value}",
        Op.BEAM: "is the beam cut?",
    }[Op(command.op)]
