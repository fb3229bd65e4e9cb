"""Executes the instructions that use the machine. These instructions send commands, ask questions, and read status
lines.
"""

from collections.abc import Callable
from typing import Final

from handeye.core.plain_text import counted
from handeye.ports.microbus import Command, MicrobusPort, Status
from handeye.program.events import SystemEvent
from handeye.systems.sigma import protocol
from handeye.systems.sigma.mal.arithmetic import Trap, checked
from handeye.systems.sigma.mal.compiler import Instruction, MalProgram
from handeye.systems.sigma.mal.happenings import Answered, CommandSent, CountWrong
from handeye.systems.sigma.mal.line_moves import line_moves
from handeye.systems.sigma.mal.memory import MalMemory, Motors, Outgoing, Owner, TaskMemory
from handeye.systems.sigma.mal.words import MAL_DEVICES
from handeye.systems.sigma.protocol import AXES, LINE_AXES, STEP_MM, Op

_LARGEST_STEPS: Final = 0x7FFF  # the greatest count, which has 16 bits with its sign
ORIGIN_STEPS: Final = 2  # greatest difference between two finds of the same switch; a rotor slips by four


class BusOperations:
    """The instructions that use the bus. A method `_do_NAME` executes the instruction NAME."""

    def __init__(
        self,
        program: MalProgram,
        machine: MicrobusPort,
        memory: MalMemory,
        tell: Callable[[SystemEvent], None],
    ) -> None:
        self.program, self.machine, self.memory, self._tell = program, machine, memory, tell

    @property
    def time(self) -> float:
        """Seconds since the program began."""
        return (self.machine.now - self.memory.began) / 1e6

    # -- asking -----------------------------------------------------------------------------------------

    def _do_pos(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        axis = text_of(instruction)
        if axis not in self.memory.originated:
            raise Trap(f"NOTORIGINATED: POS({axis}) needs an ORIGIN {axis} first")
        self._push(task, self.memory.counts.get(axis, 0) * STEP_MM)

    def _do_stat(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        axis = text_of(instruction)
        status = self.machine.status(protocol.LINE_NUMBERS[axis])
        kept = self.memory.stopped.get(axis, 0) if status is Status.FREE else 0
        self._push(task, float(kept or status))

    def _do_force(self, name: str, task: TaskMemory, instruction: Instruction) -> None:
        axis = text_of(instruction)
        answer = self.ask(name, protocol.force(int(axis[1]), axis[0]))
        self._push(task, protocol.signed(answer) * protocol.FORCE_STEP_N)

    def _do_crashpos(self, name: str, task: TaskMemory, instruction: Instruction) -> None:
        answer = self.ask(name, protocol.position(text_of(instruction), at_abort=True))
        self._push(task, protocol.signed(answer) * STEP_MM)

    def _do_beam(self, name: str, task: TaskMemory, __: Instruction) -> None:
        arm = task.stack.pop()
        if arm not in range(1, 1 + self.program.hands):
            beams = "1 and 2" if self.program.axes == AXES else f"1 to {self.program.hands}"
            raise Trap(f"there is no light beam {arm:g}, only {beams}")
        self._push(task, float(self.ask(name, protocol.beam(int(arm)))[0]))

    # -- commands ---------------------------------------------------------------------------------------

    def _do_goal(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        axis, mode = names_of(instruction)
        value = task.stack.pop() / STEP_MM
        count = self.memory.counts.get(axis, 0)
        target = round(value) + (count if mode == "BY" else 0)
        if abs(target) > _LARGEST_STEPS:
            most = _LARGEST_STEPS * STEP_MM
            raise Trap(
                f"the goal of {axis} is {target * STEP_MM:.6g} mm; a goal can be at most {most:.0f} mm from 0"
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
                raise Trap(f"a constant speed must be between 2 and 254 mm/s, not {speed:g}")
            task.outgoing[:] = [
                Outgoing(to=each.to, target=each.target, slow=speed) for each in task.outgoing
            ]
        task.pc += 1

    def _do_orig(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        names = names_of(instruction)
        task.outgoing += [Outgoing(to=axis, command=protocol.origin(axis)) for axis in names]
        task.pc += 1

    def _do_found(self, name: str, task: TaskMemory, instruction: Instruction) -> None:
        """Check that the count of each axis was 0 at the end of its rail. Any other count shows that steps were lost
        since the last ORIGIN. Raises Trap if steps were lost.
        """
        lost = []
        for axis in names_of(instruction):
            if axis in self.memory.certain:
                count = protocol.signed(self.ask(name, protocol.position(axis, at_abort=True)))
                if abs(count) > ORIGIN_STEPS:
                    self._tell(CountWrong(time=self.time, axis=axis, off=round(count * STEP_MM, 4)))
                    lost.append(f"the count of {axis} was wrong by {count * STEP_MM:.2f} mm")
        if lost:
            raise Trap(f"LOSTSTEPS: {' and '.join(lost)}")
        task.pc += 1

    def _do_act(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        name, value = text_of(instruction), task.stack.pop()
        if not 0 <= value <= 0xFFFF or value != int(value):
            raise Trap(f"{name} takes a whole number from 0 to 65535, not {value:g}")
        arm, device = MAL_DEVICES[name]
        task.outgoing.append(Outgoing(to=f"HAND{arm}", command=protocol.actuate(arm, device, int(value))))
        task.pc += 1

    def _do_limspeed(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        (axis,), speed = names_of(instruction), task.stack.pop()
        if not 0 <= speed <= 2400:
            raise Trap(f"a speed limit must be between 0 and 2400 mm/s, not {speed:g}")
        command = protocol.limit_speed(axis, round(speed / STEP_MM))
        task.outgoing.append(Outgoing(to=axis, command=command))
        task.pc += 1

    def _do_curve(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        (axis,), curve = names_of(instruction), task.stack.pop()
        if curve not in (0, 1, 2, 3, 4):
            raise Trap(f"a curve must be 0, 1, 2, 3 or 4, not {curve:g}")
        self.memory.curves[axis] = int(curve)
        task.pc += 1

    def _do_threshold(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        axis, *standard = names_of(instruction)
        newtons = None if standard else task.stack.pop()
        if newtons is not None and not 0 <= newtons <= 655:
            raise Trap(f"a force limit must be between 0 and 655 N, not {newtons:g}")
        command = protocol.threshold(int(axis[1]), axis[0], newtons)
        task.outgoing.append(Outgoing(to=f"FORCE{axis[1]}", command=command))
        task.pc += 1

    def _do_cmd(self, name: str, task: TaskMemory, _: Instruction) -> None:
        """Send the commands of a task in order. Before each command, wait until its microcomputer is free."""
        while task.outgoing:
            first = task.outgoing[0]
            needed = tuple(each for each in (first.to, *first.after) if self.busy(each))
            if needed:
                task.waits = Motors(names=needed)
                return
            self._send(name, task, task.outgoing.pop(0))
        task.pc += 1

    def _do_busywait(self, _: str, task: TaskMemory, instruction: Instruction) -> None:
        busy = tuple(name for name in names_of(instruction) if self.busy(name))
        if busy:
            task.waits = Motors(names=busy)
        else:
            task.pc += 1

    # -- the bus ----------------------------------------------------------------------------------------

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
        if what.to in LINE_AXES:
            began = self.program.line_of(task.pc).begin
            self.memory.owners[what.to] = Owner(task=name, address=began)
            self.memory.stopped.pop(what.to, None)
        if command.op == Op.ORIGIN:
            sure = what.to in self.memory.originated and what.to not in self.memory.doubtful
            if sure:
                self._compare(name, what.to)
            others = {*self.memory.certain} - {what.to}
            self.memory.certain = tuple(sorted(others | {what.to} if sure else others))
            self.memory.counts[what.to] = 0
            self.memory.originated = tuple(sorted({*self.memory.originated, what.to}))
            self.memory.doubtful = tuple(axis for axis in self.memory.doubtful if axis != what.to)
        self._transmit(name, command, means or _meaning(command))
        self.machine.send(command)
        if _takes_time(command) and not self.machine.begun(command.number):
            raise Trap(f"NOTSTARTED: {what.to} has not begun to execute its command")

    def _compare(self, name: str, axis: str) -> None:
        """Raise Trap if the count of a motor differs from the position to which the program has sent the motor. A
        difference shows that the motor's microcomputer has missed or misread a command.
        """
        sent = self.memory.counts.get(axis, 0)
        count = protocol.signed(self.ask(name, protocol.position(axis)))
        if count != sent:
            self.memory.counts[axis] = count
            raise Trap(
                f"WRONGCOUNT: the count of {axis} is {count * STEP_MM:.2f} mm, but {axis} was sent to "
                f"{sent * STEP_MM:.2f} mm"
            )

    def _transmit(self, name: str, command: Command, means: str) -> None:
        self.memory.commands += 1
        to = protocol.name_of(command.number, line=True)
        self._tell(CommandSent(time=self.time, task=name, to=to, frame=command.frame.hex(" "), means=means))

    def ask(self, name: str, command: Command) -> bytes:
        self.memory.questions += 1
        self._transmit(name, command, _meaning(command))
        answer = self.machine.ask(command, protocol.ANSWERS[Op(command.op)])
        value = protocol.signed(answer)
        to = protocol.name_of(command.number, line=True)
        self._tell(Answered(time=self.time, task=name, to=to, answer=answer.hex(" "), means=f"{value}"))
        return answer

    def busy(self, name: str) -> bool:
        """Return True if an axis or device is executing a command. The result for a force microcomputer is always
        False, because it accepts commands at any time.
        """
        if name.startswith("FORCE"):
            return False
        if name in MAL_DEVICES:
            name = f"HAND{MAL_DEVICES[name][0]}"
        return self.machine.status(protocol.LINE_NUMBERS[name]) is Status.BUSY

    def _push(self, task: TaskMemory, value: float) -> None:
        task.stack.append(checked(value))
        task.pc += 1


def text_of(instruction: Instruction) -> str:
    assert isinstance(instruction.operand, str)
    return instruction.operand


def names_of(instruction: Instruction) -> tuple[str, ...]:
    assert isinstance(instruction.operand, tuple)
    return instruction.operand


def _takes_time(command: Command) -> bool:
    """Return True if a microcomputer is still busy with a command after the command has been sent."""
    fingers = command.op == Op.ACTUATE and command.detail == protocol.DEVICES["HAND"]
    return fingers or command.op in (Op.MOVE, Op.MOVE_SLOW, Op.ORIGIN)


_DEVICES: Final = {number: name for name, number in protocol.DEVICES.items()}


def _meaning(command: Command) -> str:
    """Describe a command in words."""
    return {
        Op.ORIGIN: "search for the end of the rail",
        Op.LIMIT_SPEED: f"limit the speed to {counted(command.value, 'step')}/s",
        Op.POSITION: "where are you?",
        Op.ABORT_POSITION: "where were you when you were aborted, or when you reached the end of your rail?",
        Op.FORCE: f"what is the force along {protocol.COMPONENTS[command.detail % 3]}?",
        Op.PEAK_FORCE: f"what was the greatest force along {protocol.COMPONENTS[command.detail % 3]}?",
        Op.THRESHOLD: f"threshold along {protocol.COMPONENTS[command.detail % 3]}: "
        + (
            "standard"
            if command.value == protocol.STANDARD
            else f"{command.value * protocol.FORCE_STEP_N:g} N"
        ),
        Op.ACTUATE: f"{_DEVICES.get(command.detail, command.detail)} to {command.value}",
        Op.BEAM: "is the beam broken?",
    }[Op(command.op)]
