"""Executes the instructions of a task: arithmetic, jumps, loops, tasks, flags, and the console."""

import math
from collections.abc import Callable
from functools import partial
from typing import Final

from handeye.core.errors import InvalidInput
from handeye.core.plain_text import counted
from handeye.ports.microbus import BusFault, MicrobusPort
from handeye.program.events import SystemEvent
from handeye.systems.sigma.mal.arithmetic import BINARY, UNARY, Trap, shown
from handeye.systems.sigma.mal.bus_operations import BusOperations, names_of, text_of
from handeye.systems.sigma.mal.compiler import ARITHMETIC, Instruction, MalProgram
from handeye.systems.sigma.mal.happenings import FlagChanged, Printed, TaskEnded, TaskStarted
from handeye.systems.sigma.mal.memory import (
    Fault,
    Flags,
    Loop,
    MalMemory,
    Moment,
    Motors,
    TaskMemory,
    TypedNumber,
    Waiting,
)
from handeye.systems.sigma.protocol import name_of

DEEPEST_GOSUB: Final = 1000
LONGEST_PRINTED: Final = 2000  # greatest number of characters in a printed line
ZONE: Final = 14  # columns in a zone of PRINT
_MOST_INSTRUCTIONS: Final = 100_000  # greatest number of instructions in a statement; none has a loop


class Operations(BusOperations):
    """All instructions. A method `_do_NAME` executes the instruction NAME."""

    def __init__(
        self,
        program: MalProgram,
        machine: MicrobusPort,
        memory: MalMemory,
        tell: Callable[[SystemEvent], None],
    ) -> None:
        super().__init__(program, machine, memory, tell)
        self._acts: dict[str, Callable[[str, TaskMemory, Instruction], None]] = {
            **{name: partial(self._binary, operate) for name, operate in BINARY.items()},
            **{name: partial(self._unary, operate) for name, operate in UNARY.items()},
        }
        for name in dir(self):
            if name.startswith("_do_"):
                self._acts[name.removeprefix("_do_").upper()] = getattr(self, name)

    def run(self, name: str, task: TaskMemory) -> int:
        """Execute instructions until the statement ends or waits. Returns the number of arithmetic instructions that
        were executed.
        """
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
            whose = f" ({name_of(error.number)})" if isinstance(error, BusFault) else ""
            told = f"line {number}: {error}{whose}"
            self.memory.fault = Fault(kind="trap", task=name, address=began, told=told)
        return calculated

    # -- tasks ---------------------------------------------------------------------------------------------

    def start(self, name: str) -> None:
        self.memory.tasks[name] = TaskMemory(pc=self.program.tasks[name])
        self._tell(TaskStarted(time=self.time, task=name))

    def end(self, name: str, *, killed: bool = False) -> None:
        del self.memory.tasks[name]
        self._tell(TaskEnded(time=self.time, task=name, killed=killed))

    def behind(self, address: int) -> int:
        """Find the line whose code contains `address`, and return the address of the code that follows this line."""
        index = self.program.line_at[address]
        line = self.program.lines[index]
        if index + 1 < len(self.program.lines) and self.program.lines[index + 1].task == line.task:
            return self.program.lines[index + 1].begin
        return min(each for each in self.program.closing if each >= line.begin)

    def met(self, name: str, task: TaskMemory, waits: Waiting) -> bool:
        """Return True if the condition for which a task waits is met. The task then stops waiting."""
        match waits:
            case Flags(names=names, take=take):
                if not {*names} <= {*self.memory.flags}:
                    return False
                for flag in names if take else ():
                    self._change_flag(name, flag, on=False, change="takes")
                task.pc += 1
            case Motors(names=names):
                if any(self.busy(each) for each in names):
                    return False
            case Moment(until=until):
                if self.machine.now < until:
                    return False
                task.pc += 1
            case TypedNumber():
                return False
        task.waits = None
        return True

    # -- numbers, jumps and loops --------------------------------------------------------------------------

    def _binary(
        self, operate: Callable[[float, float], float], _: str, task: TaskMemory, __: Instruction
    ) -> None:
        right, left = task.stack.pop(), task.stack.pop()
        self._push(task, operate(left, right))

    def _unary(self, operate: Callable[[float], float], _: str, task: TaskMemory, __: Instruction) -> None:
        self._push(task, operate(task.stack.pop()))

    def _do_pushc(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        assert isinstance(instruction.operand, float)
        self._push(task, instruction.operand)

    def _do_pushv(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        self._push(task, self.memory.variables.get(text_of(instruction), 0.0))

    def _do_popv(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        self.memory.variables[text_of(instruction)] = task.stack.pop()
        task.pc += 1

    def _do_time(self, _: str, task: TaskMemory, __: Instruction) -> None:
        self._push(task, self.time)

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
            raise Trap(f"{counted(DEEPEST_GOSUB, 'GOSUB')} are active: a subroutine never reaches its RETURN")
        task.returns.append(self.behind(task.pc))
        self._do_go("", task, instruction)

    def _do_ret(self, _: str, task: TaskMemory, __: Instruction) -> None:
        if not task.returns:
            raise Trap("no GOSUB is active")
        task.pc, task.amid = task.returns.pop(), False

    def _do_for(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        name = text_of(instruction)
        step, last, first = task.stack.pop(), task.stack.pop(), task.stack.pop()
        if not step:
            raise Trap("a FOR with a STEP of 0 never ends")
        self.memory.variables[name] = first
        names = [loop.name for loop in task.loops]
        del task.loops[names.index(name) if name in names else len(names) :]
        if len(task.loops) >= DEEPEST_GOSUB:
            raise Trap(f"{counted(DEEPEST_GOSUB, 'loop')} are active: a loop does not reach its NEXT")
        task.loops.append(Loop(name=name, last=last, step=step, begin=self.behind(task.pc)))
        task.pc += 1

    def _do_next(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        name = text_of(instruction)
        names = [loop.name for loop in task.loops]
        if name not in names:
            raise Trap(f"no FOR {name} is active")
        del task.loops[names.index(name) + 1 :]
        loop = task.loops[-1]
        value = self.memory.variables.get(name, 0.0) + loop.step
        self.memory.variables[name] = value
        if value * math.copysign(1, loop.step) <= loop.last * math.copysign(1, loop.step):
            task.pc, task.amid = loop.begin, False
        else:
            task.loops.pop()
            task.pc += 1

    # -- tasks and flags -----------------------------------------------------------------------------------

    def _do_end(self, name: str, _: TaskMemory, __: Instruction) -> None:
        self.end(name)

    def _do_halt(self, _: str, __: TaskMemory, ___: Instruction) -> None:
        for name in (*self.memory.tasks,):
            self.end(name)

    def _do_fail(self, name: str, task: TaskMemory, instruction: Instruction) -> None:
        line = self.program.line_of(task.pc)
        told = f"the task {name}, line {line.number}: {text_of(instruction)}"
        self.memory.fault, task.amid = Fault(kind="fail", task=name, address=line.begin, told=told), False

    def _do_start(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        for name in names_of(instruction):
            if name in self.memory.tasks:
                raise Trap(f"the task {name} is already running")
            self.start(name)
        task.pc += 1

    def _do_kill(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        task.pc += 1
        for name in names_of(instruction):
            if name in self.memory.tasks:
                self.end(name, killed=True)

    def _do_setf(self, name: str, task: TaskMemory, instruction: Instruction) -> None:
        self._change_flag(name, text_of(instruction), on=True, change="sets")
        task.pc += 1

    def _do_clrf(self, name: str, task: TaskMemory, instruction: Instruction) -> None:
        self._change_flag(name, text_of(instruction), on=False, change="clears")
        task.pc += 1

    def _do_waitf(self, name: str, task: TaskMemory, instruction: Instruction) -> None:
        self._wait(name, task, Flags(names=names_of(instruction), take=False))

    def _do_takef(self, name: str, task: TaskMemory, instruction: Instruction) -> None:
        self._wait(name, task, Flags(names=(text_of(instruction),), take=True))

    def _do_sleep(self, name: str, task: TaskMemory, __: Instruction) -> None:
        seconds = task.stack.pop()
        if not 0 <= seconds <= 86400:
            raise Trap(f"a delay must be between 0 and 86400 s, not {seconds:g}")
        self._wait(name, task, Moment(until=self.machine.now + round(seconds * 1e6)))

    def _do_in(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        task.waits = TypedNumber(name=text_of(instruction))

    def _do_trap(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        task.handlers[text_of(instruction)] = instruction.target
        task.pc += 1

    def _do_resume(self, _: str, task: TaskMemory, __: Instruction) -> None:
        if task.resume is None:
            raise Trap("RESUME has nothing to continue: no motion of this task was aborted")
        task.pc, task.amid, task.resume = task.resume, False, None

    def _wait(self, name: str, task: TaskMemory, waiting: Waiting) -> None:
        """Let a task wait for a condition, unless the condition is already met."""
        task.waits = waiting
        self.met(name, task, waiting)

    def _change_flag(self, name: str, flag: str, *, on: bool, change: str) -> None:
        flags = {*self.memory.flags} - {flag}
        self.memory.flags = tuple(sorted(flags | {flag} if on else flags))
        self._tell(FlagChanged(time=self.time, task=name, flag=flag, change=change))

    # -- console -------------------------------------------------------------------------------------------

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
            raise Trap(f"a printed line can have at most {LONGEST_PRINTED} characters")
        self.memory.printed += text
