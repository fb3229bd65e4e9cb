"""Tries every order in which the tasks of a program may continue. States are hashed, so that each state is
examined only once.

A statement is one act. The search assumes that a motion or delay may take any length of time. Statements that do not
concern another task are not tried in different orders, because the order has no effect. If only one task uses an axis,
each motion of this axis is treated as if it took no time.
"""

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from hashlib import blake2b
from itertools import combinations
from typing import Final, Literal, NamedTuple

import msgspec

from handeye.core.mutable_records import copied
from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.program.events import SystemEvent
from handeye.systems.sigma.mal.check import driven, reads, within, writes
from handeye.systems.sigma.mal.compiler import CompiledLine, MalProgram
from handeye.systems.sigma.mal.happenings import FlagChanged
from handeye.systems.sigma.mal.memory import MalMemory, Moment, Motors, TypedNumber
from handeye.systems.sigma.mal.syntax import Statement
from handeye.systems.sigma.mal.untimed import UntimedMachine, UntimedMemory
from handeye.systems.sigma.mal.virtual_machine import VirtualMachine
from handeye.systems.sigma.protocol import STEP_MM

MOST_STATES: Final = 50_000
RAILS: Final = (("X1", "X2"), ("X3", "X4"))  # the X axes of the two arms on each rail
HANDS_MEET_MM: Final = 550.0  # sum of these axes beyond which the hands of the two arms may touch
FindingKind = Literal["deadlock", "axis", "hands", "variable", "flag", "stops"]
KINDS: Final[dict[FindingKind, str]] = {
    "deadlock": "no task can continue",
    "axis": "two tasks drive one axis at the same time",
    "hands": "the hands of both arms may meet",
    "variable": "two tasks use a variable, and the result depends on which task is first",
    "flag": "a flag is set again before a task has taken it: one of the two signals is lost",
    "stops": "a statement cannot be executed",
}
_SHARED_WORDS: Final = {"SET", "RESET", "WAIT", "TAKE", "START", "KILL", "STOP", "END"}


class Act(Record, frozen=True, kw_only=True):
    """One act of a schedule: a task begins or continues a line, or an axis reaches its goal."""

    task: str  # or the axis
    line: int | None = None
    goes_on: bool = False


class OrderFinding(Record, frozen=True, kw_only=True):
    """A problem that occurs if the tasks run in a certain order."""

    kind: FindingKind
    told: str
    lines: tuple[int, ...]
    schedule: tuple[Act, ...]  # the shortest schedule that leads to the problem


class Interleavings(Record, frozen=True, kw_only=True):
    """The result of trying all orders of the tasks."""

    states: int
    complete: bool  # True: all orders were tried
    ends: int  # number of different states in which the program ends
    findings: tuple[OrderFinding, ...]
    unreached: tuple[int, ...] = ()  # lines that no order executes; empty unless all orders were tried


class _State(NamedTuple):
    memory: MalMemory
    machine: UntimedMemory


@dataclass(slots=True)
class _Reached:
    """How the search first reached a state."""

    before: bytes | None
    act: Act | None


@dataclass(kw_only=True)
class _Search:
    program: MalProgram
    most: int
    events: list[SystemEvent] = field(default_factory=list)
    reached: dict[bytes, _Reached] = field(default_factory=dict)
    found: dict[tuple[str, object], OrderFinding] = field(default_factory=dict)
    ends: set[bytes] = field(default_factory=set)
    executed: set[int] = field(default_factory=set)

    def __post_init__(self) -> None:
        self.machine = UntimedMachine(self.instant)
        self.vm = VirtualMachine(self.program, self.machine, self.events.append, statement_us=0)

    # -- what the program shares ----------------------------------------------------------------------

    @cached_property
    def _users(self) -> dict[str, set[str]]:
        """The tasks that use each variable and each axis."""
        users: dict[str, set[str]] = {}
        for line in self.program.statements:
            for statement in within(line.statement):
                used = [*reads(statement), *writes(statement), *driven(statement)]
                used += statement.names if statement.word == "NEXT" else ()
                for name in used:
                    users.setdefault(name.text, set()).add(line.task)
        return users

    @cached_property
    def rails(self) -> tuple[tuple[str, str], ...]:
        """For each rail whose two arms are used by different tasks, the X axes of these arms."""
        users = self._users
        return tuple(pair for pair in RAILS if len(users.get(pair[0], set()) | users.get(pair[1], set())) > 1)

    @cached_property
    def instant(self) -> frozenset[str]:
        """Axes whose motions do not concern any other task."""
        asked = "STATUS(" in self.program.text.upper().replace(" ", "")
        private = {name for name, tasks in self._users.items() if len(tasks) == 1}
        return frozenset() if asked else frozenset(private.difference(*self.rails))

    @cached_property
    def _private(self) -> tuple[bool, ...]:
        """For each line, True if the line does not concern any other task."""
        return tuple(all(map(self._is_private, within(line.statement))) for line in self.program.statements)

    def _is_private(self, statement: Statement) -> bool:
        used = [*reads(statement), *writes(statement), *driven(statement)]
        used += statement.names if statement.word == "NEXT" else ()
        moved = {axis.text for axis in driven(statement)}
        return (
            statement.word not in _SHARED_WORDS
            and all(len(self._users[name.text]) == 1 for name in used)
            and moved <= self.instant
        )

    # -- searching ------------------------------------------------------------------------------------

    def run(self) -> Interleavings:
        self.vm.memory.began = 0
        self.vm.begin()
        start = self._taken()
        key = self._key(start)
        self.reached[key] = _Reached(None, None)
        waiting, complete = deque([(key, start)]), True
        while waiting:
            key, state = waiting.popleft()
            for act, after in self._expanded(key, state):
                other = self._key(after)
                if other in self.reached:
                    continue
                if len(self.reached) >= self.most:
                    complete = False
                    continue
                self.reached[other] = _Reached(key, act)
                self._look(other, after)
                waiting.append((other, after))
        order = sorted(self.found.values(), key=lambda each: (len(each.schedule), each.told))
        numbers = [line.number for line in self.program.lines] if complete else []
        return Interleavings(
            states=len(self.reached),
            complete=complete,
            ends=len(self.ends),
            findings=tuple(order),
            unreached=tuple(number for number in numbers if number not in self.executed),
        )

    def _expanded(self, key: bytes, state: _State) -> list[tuple[Act, _State]]:
        """Return the states that follow a state. If a statement that concerns no other task leads to a new state, only
        this new state is returned.
        """
        if state.memory.fault is not None:
            return []
        for name in state.memory.tasks:
            task = state.memory.tasks[name]
            private = (
                isinstance(task.waits, Moment | TypedNumber)
                if task.amid
                else self._private[self._line(state, name)]
            )
            if private:
                after = self._after(key, state, name)
                if after is not None and self._key(after[1]) not in self.reached:
                    return [after]
        found = [after for name in state.memory.tasks if (after := self._after(key, state, name)) is not None]
        found += [self._arrived(state, axis) for axis in state.machine.moving]
        if not found and state.memory.tasks:
            self._put(state)
            waits = [
                (n, self.program.lines[self._line(state, n)].number, self.vm.waits_for(n))
                for n in state.memory.tasks
            ]
            told = "; ".join(f"the task {name}, line {line}, waits for {what}" for name, line, what in waits)
            self._find("deadlock", told, [line for _, line, _ in waits], key)
        return found

    def _after(self, key: bytes, state: _State, name: str) -> tuple[Act, _State] | None:
        """Let a task continue, and return the act and the new state, or None if the task cannot continue."""
        self._put(_State(copied(state.memory), copied(state.machine)))
        memory = self.vm.memory
        task, line = memory.tasks[name], self.program.lines[self._line(state, name)]
        amid = task.amid
        if amid:
            if isinstance(task.waits, Moment):
                task.waits, task.pc = None, task.pc + 1
            elif isinstance(task.waits, TypedNumber):
                self.vm.type_number("0", name)
            waits, pc = task.waits, task.pc
            self.vm.goes_on(name)
            if (
                name in memory.tasks
                and task.amid
                and (task.waits, task.pc) == (waits, pc)
                and waits is not None
            ):
                return None
        else:
            self.executed.add(line.number)
            self.vm.choose(name)
            self.vm.statement()
        self._see_events(key, state, Act(task=name, line=line.number, goes_on=amid))
        if name in memory.tasks and not task.amid and task.pc in self.program.closing:
            self.vm.goes_on(name)  # it ends
        return Act(task=name, line=line.number, goes_on=amid), self._taken()

    def _arrived(self, state: _State, axis: str) -> tuple[Act, _State]:
        self._put(_State(copied(state.memory), copied(state.machine)))
        self.machine.arrive(axis)
        return Act(task=axis), self._taken()

    def _put(self, state: _State) -> None:
        self.vm.memory, self.machine.state = state
        self.events.clear()

    def _taken(self) -> _State:
        """Return the present state, without the values that have no effect on later states."""
        memory = self.vm.memory
        memory.turn, memory.last, memory.printed, memory.commands, memory.questions = "", "", "", 0, 0
        for axis in [axis for axis in memory.owners if axis not in self.machine.state.moving]:
            if not any(axis in pair for pair in self.rails):
                del memory.owners[axis]
        return _State(memory, self.machine.state)

    def _key(self, state: _State) -> bytes:
        return blake2b(_encoder.encode(state), digest_size=16).digest()

    def _line(self, state: _State, name: str) -> int:
        return self.program.line_at[state.memory.tasks[name].pc]

    # -- looking --------------------------------------------------------------------------------------

    def _see_events(self, key: bytes, state: _State, act: Act) -> None:
        """Record each flag that an act sets although the flag is already set: a signal is lost."""
        taken = {each.operand for each in self.program.code if each.op == "TAKEF"}
        for event in self.events:
            lost = (
                isinstance(event, FlagChanged) and event.change == "sets" and event.flag in state.memory.flags
            )
            if lost and isinstance(event, FlagChanged) and event.flag in taken:
                told = (
                    f"the task {act.task}, line {act.line}, sets the flag {event.flag}, which is already set"
                )
                self._find("flag", told, [act.line or 0], key, act)

    def _look(self, key: bytes, state: _State) -> None:
        memory = state.memory
        if memory.fault is not None:
            line = self.program.line_of(memory.fault.address).number
            if memory.fault.kind != "fail":  # such a stop is what the program wants
                self._find("stops", memory.fault.told, [line], key)
            return
        if not memory.tasks:
            self.ends.add(
                blake2b(
                    _encoder.encode((sorted(memory.variables.items()), memory.flags)), digest_size=16
                ).digest()
            )
        for name, task in memory.tasks.items():
            if isinstance(task.waits, Motors):
                self._see_axes(key, state, name, task.waits.names)
        self._see_hands(key, state)
        free = [name for name, task in memory.tasks.items() if not task.amid]
        for one, other in combinations(free, 2):
            self._see_variables(key, state, one, other)

    def _see_axes(self, key: bytes, state: _State, name: str, names: Sequence[str]) -> None:
        here = self.program.lines[self._line(state, name)].number
        for axis in names:
            owner = state.memory.owners.get(axis)
            if owner is not None and owner.task != name:
                there = self.program.line_of(owner.address).number
                told = f"the tasks {owner.task} (line {there}) and {name} (line {here}) both drive {axis}"
                self._find("axis", told, [there, here], key)

    def _see_hands(self, key: bytes, state: _State) -> None:
        for pair in self.rails:
            self._see_rail(key, state, pair)

    def _see_rail(self, key: bytes, state: _State, pair: tuple[str, str]) -> None:
        if not {*pair} <= {*state.memory.owners}:
            return
        self.machine.state = state.machine
        near = sum(map(self.machine.reach, pair)) * STEP_MM
        if near > HANDS_MEET_MM and state.machine.moving.keys() & {*pair}:
            owners = [state.memory.owners[axis] for axis in pair]
            lines = [self.program.line_of(owner.address).number for owner in owners]
            who = " and ".join(
                f"the task {owner.task}, line {line}, moves {axis}"
                for axis, owner, line in zip(pair, owners, lines, strict=True)
            )
            both = " and ".join(pair)
            told = f"the sum of {both} may reach {near:.0f} mm (the limit is {HANDS_MEET_MM:.0f} mm): {who}"
            self._find("hands", told, lines, key)

    def _see_variables(self, key: bytes, state: _State, one: str, other: str) -> None:
        lines = [self.program.lines[self._line(state, name)] for name in (one, other)]
        uses = [_uses(self.program, line) for line in lines]
        for name in sorted((uses[0][1] & (uses[1][0] | uses[1][1])) | (uses[1][1] & uses[0][0])):
            deeds = ["sets" if name in written else "reads" for _, written in uses]
            both = " and ".join(
                f"the task {line.task}, line {line.number}, {deed} the variable"
                for line, deed in zip(lines, deeds, strict=True)
            )
            self._find("variable", f"{name}: {both}", [line.number for line in lines], key)

    def _find(
        self, kind: FindingKind, told: str, lines: Sequence[int], key: bytes, act: Act | None = None
    ) -> None:
        """Record a finding, unless the same finding is already recorded. The first path that leads to a finding is the
        shortest.
        """
        name = (kind, tuple(sorted(lines)) if kind != "variable" else told)
        if name not in self.found:
            schedule = (*self._schedule(key), *(() if act is None else (act,)))
            self.found[name] = OrderFinding(kind=kind, told=told, lines=tuple(lines), schedule=schedule)

    def _schedule(self, key: bytes) -> Iterator[Act]:
        acts: list[Act] = []
        reached = self.reached[key]
        while reached.before is not None and reached.act is not None:
            acts.append(reached.act)
            reached = self.reached[reached.before]
        return reversed(acts)


_encoder: Final = msgspec.msgpack.Encoder(order="sorted")


def _uses(program: MalProgram, line: CompiledLine) -> tuple[set[str], set[str]]:
    """Return the variables that a line reads, and those that it sets."""
    index = program.line_at[line.begin]
    read, written = set[str](), set[str]()
    for statement in within(program.statements[index].statement):
        read |= {name.text for name in reads(statement)}
        written |= {name.text for name in writes(statement)}
        written |= {name.text for name in statement.names} if statement.word == "NEXT" else set()
    return read, written


def interleavings(program: MalProgram, most: int = MOST_STATES) -> Interleavings:
    """Try every order in which the tasks of a program may continue, until `most` different states have been
    examined."""
    return _Search(program=program, most=most).run()


def schedule_lines(schedule: Sequence[Act]) -> list[str]:
    """Return a schedule as text. Each row names the task that continues, and the program lines that this task
    executes.
    """
    rows: list[tuple[str, list[str]]] = []
    for act in schedule:
        text = "arrives" if act.line is None else f"{act.line} goes on" if act.goes_on else str(act.line)
        if rows and rows[-1][0] == act.task:
            rows[-1][1].append(text)
        else:
            rows.append((act.task, [text]))
    width = max((len(task) for task, _ in rows), default=0)
    return [f"{task:{width}}  {', '.join(texts)}" for task, texts in rows]


def unreached_lines(program: MalProgram, result: Interleavings) -> str:
    """Name the program lines that are not executed in any order of the tasks. Returns a text such as `lines 40, 70 to
    90`, or an empty text if each line is executed in some order.
    """
    numbers, spans = [line.number for line in program.lines], list[list[int]]()
    for before, number in zip([None, *numbers], numbers, strict=False):
        if number in result.unreached:
            if spans and spans[-1][-1] == before:
                spans[-1].append(number)
            else:
                spans.append([number])
    texts = [f"{span[0]} to {span[-1]}" if len(span) > 1 else str(span[0]) for span in spans]
    return f"{'line' if len(result.unreached) == 1 else 'lines'} {', '.join(texts)}" if texts else ""


def told_orders(name: str, program: MalProgram, result: Interleavings) -> Iterator[str]:
    """Yield the result of trying all orders: first each finding (with a schedule for the first finding of each kind),
    then the lines that no order reaches.
    """
    shown: set[str] = set()
    for finding in result.findings:
        yield f"{finding.kind}: {KINDS[finding.kind]}"
        yield f"    {finding.told}"
        if finding.kind not in shown:
            yield "  for example in this order of the tasks"
            yield from (f"    {line}" for line in schedule_lines(finding.schedule))
        shown.add(finding.kind)
    if lines := unreached_lines(program, result):
        yield (
            f"not checked: {lines}, which no order of the tasks reaches (in this check, sensors answer 0 and no "
            "motion is aborted)"
        )
    count = counted(result.states, "state")
    orders = (
        "all orders were tried"
        if result.complete
        else "not all orders were tried; give a larger `--most` to try more"
    )
    found = counted(len(result.findings), "finding") if result.findings else "no deadlock and no race"
    ends = f"; the program ends in {counted(result.ends, 'different way')}" if result.ends > 1 else ""
    yield f"{name}: {count}, {orders}; {found}{ends}"
