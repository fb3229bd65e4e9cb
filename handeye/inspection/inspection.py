"""The contents of a plan as data and as text: stages and steps, durations, guards, and the measurements on which
each step depends.

A step may depend on measurements made during the run: the places of parts that vision located, saved positions and
differences, and the place that a search has reached. For each step, handeye follows all paths through the graph that
lead to the step, including loops and error edges. It thus finds the newest measurements that can be valid at this
step.
"""

from typing import Final, Literal, get_args

from handeye.core.plain_text import counted, one_line
from handeye.core.record import Record, Vector3
from handeye.core.source import line_name
from handeye.inspection.wording import conditions
from handeye.planfile.plan import Plan
from handeye.program.graph import Graph
from handeye.program.guards import Guards
from handeye.program.operation import Branch, Operation
from handeye.program.program import Program

Measured = Literal["part", "position", "difference", "search"]
Key = tuple[Measured, str]
_MEASURED: Final[tuple[Measured, ...]] = get_args(Measured)
Newest = dict[Key, frozenset[int]]  # for each measurement, the steps that may have made it last


class Dependence(Record, frozen=True, kw_only=True):
    """A measurement on which a step depends. An earlier step makes this measurement during the run."""

    kind: Measured
    name: str  # empty for a search
    level: bool = False  # horizontal components only
    steps: tuple[int, ...]  # steps that may have measured it last; empty: the planned value, or zero
    lines: tuple[int | str, ...]  # lines of the source, or `pins.al:12` in a required file


def dependences(program: Program) -> tuple[tuple[Dependence, ...], ...]:
    """Find the dependences of each step, in the order of the steps."""
    newest = _newest(program)
    kept = program.written("position")
    return tuple(
        tuple(
            _dependence(program, key, level, newest[number].get(key, frozenset()))
            for key, level in _uses(program, kept, step.operation)
        )
        for number, step in enumerate(program.steps)
    )


def _dependence(program: Program, key: Key, level: bool, steps: frozenset[int]) -> Dependence:
    places = sorted({(program.steps[number].file, program.steps[number].line) for number in steps})
    lines = tuple(line_name(line, file) if file else line for file, line in places)
    return Dependence(kind=key[0], name=key[1], level=level, steps=tuple(sorted(steps)), lines=lines)


def _uses(program: Program, kept: set[str], operation: Operation) -> list[tuple[Key, bool]]:
    """Return the measured values that an operation needs. Only motions and looks of the camera need such values. Each
    value has a flag, which is True if only the horizontal part of the value is needed. `kept` holds the positions that
    `HERE` defines.
    """
    found: list[tuple[Key, bool]] = []
    for kind, name, level in operation.reads if operation.family in ("motion", "sight") else ():
        if kind in ("difference", "search"):
            found.append(((kind, name), level))
        elif kind in ("position", "target", "part"):
            of: str | None = name
            if name in kept:
                found.append((("position", name), False))
            if name in program.positions:
                of = program.positions[name].of
            if of is not None:
                found.append((("part", of), False))
    return list(dict.fromkeys(found))


def _newest(program: Program) -> list[Newest]:
    """Find the newest measurements that can be valid before each step."""
    graph = Graph(program.steps)
    measured = [
        [(kind, use.name) for use in step.operation.writes for kind in _MEASURED if kind == use.kind]
        for step in program.steps
    ]
    before: list[Newest] = [{} for _ in program.steps]
    waiting = list(range(len(program.steps)))[::-1]
    while waiting:
        number = waiting.pop()
        after = before[number] | dict.fromkeys(measured[number], frozenset({number}))
        for follower in dict.fromkeys(graph.onward[number]):
            if follower is None:
                continue
            here = before[follower]
            merged = here | {key: here.get(key, frozenset()) | found for key, found in after.items()}
            if merged != here:
                before[follower] = merged
                waiting.append(follower)
    return before


class InspectedStep(Record, frozen=True, kw_only=True):
    """A step of a plan, as shown to users."""

    step: int
    file: str = ""
    """The required file that contains the line; empty for the script itself."""
    line: int
    text: str
    """The statement of the step. The modifiers before it, such as `STOP`, `FORCE` and `RESTORE`, are covered by
    `conditions` and `depends`.
    """
    operation: str
    """Name of the operation in the plan file."""
    seconds: float | None
    """Planned duration of the motion (s); None if the step has no motion."""
    guards: Guards
    """Guards that end the motion, in SI units."""
    press: Vector3 | None
    """Force (N) that the hand exerts, in table coordinates."""
    conditions: tuple[str, ...]
    """The guards and the exerted force, in the words and units of the language."""
    depends: tuple[Dependence, ...]
    error: int | None
    """The error that the step tests for."""
    raised: int | None
    """The step that follows if the tested error was raised. None if the program then ends, or if the step tests for
    no error.
    """
    counter: str | None = None
    """The counter that the step counts down."""
    positive: int | None = None
    """The step that follows while the counter is positive."""
    next: int | None
    """The step that follows in all other cases; None for the end of the program."""


class InspectedStage(Record, frozen=True, kw_only=True):
    """A stage of a plan, with its number (the first is 1)."""

    number: int
    name: str
    seconds: float
    """Duration of the planned motions (s). A step in a loop counts once."""
    steps: tuple[InspectedStep, ...]


class Inspection(Record, frozen=True, kw_only=True):
    """The contents of a plan, as data."""

    name: str
    version: int
    arm: str
    speed: float  # speed of free motions as a share of the arm's limits
    motions: int
    seconds: float  # planned time of all motions; each step counts once, so a long search takes longer
    stages: tuple[InspectedStage, ...]


def inspection(plan: Plan) -> Inspection:
    """Collect the contents of a plan as data."""
    depends = dependences(plan.program)
    steps = [_step(plan, number, depends[number]) for number in range(len(plan.program.steps))]
    stages = []
    for index, name in enumerate(plan.program.stages):
        own = tuple(steps[n] for n, step in enumerate(plan.program.steps) if step.stage == index)
        stages.append(InspectedStage(number=index + 1, name=name, seconds=_seconds(own), steps=own))
    return Inspection(
        name=plan.program.name, version=plan.version, arm=plan.arm, speed=plan.speed,
        motions=len(plan.motions), seconds=_seconds(tuple(steps)), stages=tuple(stages),
    )  # fmt: skip


def inspection_text(found: Inspection, stage: int | None = None) -> list[str]:
    """Write the contents of a plan, or of the stage with the given number (from 1), as lines of text."""
    count = counted(sum(len(s.steps) for s in found.stages), "step")
    out = [
        f"{one_line(found.name)}, planned for the {found.arm} arm at {found.speed:g} of full speed: "
        f"{counted(len(found.stages), 'stage')}, {count}, {counted(found.motions, 'motion')}, {found.seconds:.1f} s"
    ]
    shown = [s for s in found.stages if stage in (None, s.number)]
    width = max((len(step.text) for s in shown for step in s.steps), default=0)
    for one in shown:
        out += ["", f"{one.number:3}  {one.name}: {counted(len(one.steps), 'step')}, {one.seconds:.1f} s"]
        column = max([4, *(len(line_name(step.line, step.file)) for step in one.steps)])
        out += [_line(step, width, column) for step in one.steps]
    return out


def depends_text(one: Dependence) -> str:
    """Write a dependence in words."""
    lines = f"line{'' if len(one.lines) == 1 else 's'} {', '.join(map(str, one.lines))}"
    if one.kind == "search":
        return f"search of {lines}" if one.lines else "no search"
    if one.kind == "part":
        return f"{one.name} seen at {lines}" if one.lines else f"{one.name} as planned"
    if one.kind == "position":
        return f"{one.name} defined at {lines}" if one.lines else f"{one.name} as planned"
    level = " level" if one.level else ""
    return f"{one.name}{level} saved at {lines}" if one.lines else f"{one.name}{level}, never saved before"


def _step(plan: Plan, number: int, depends: tuple[Dependence, ...]) -> InspectedStep:
    step, motion = plan.program.steps[number], plan.motions.get(number)
    operation = step.operation
    branch = operation.branch or Branch(None)
    tests, counts = branch.error is not None, branch.counter is not None
    return InspectedStep(
        step=number, file=step.file, line=step.line, text=one_line(step.text),
        operation=type(operation).__name__.lower(),
        seconds=None if motion is None else round(sum(motion.times), 6),
        guards=operation.guards, press=operation.press,
        conditions=conditions(operation), depends=depends,
        error=branch.error, raised=branch.target if tests else None,
        counter=branch.counter, positive=branch.target if counts else None,
        next=step.next,
    )  # fmt: skip


def _seconds(steps: tuple[InspectedStep, ...]) -> float:
    return round(sum(step.seconds or 0.0 for step in steps), 6)


def _line(step: InspectedStep, width: int, column: int) -> str:
    time = "" if step.seconds is None else f"{step.seconds:.2f} s"
    facts = [*step.conditions, *map(depends_text, step.depends)]
    if step.error is not None:
        facts.append(f"error {step.error}: to {_place(step.raised)}, else to {_place(step.next)}")
    elif step.counter is not None:
        facts.append(f"{step.counter} positive: to {_place(step.positive)}, else to {_place(step.next)}")
    elif step.next != step.step + 1:
        facts.append(f"to {_place(step.next)}")
    place = line_name(step.line, step.file)
    return (
        f"{step.step:8}  line {place:{column}}  {step.text:{width}}  {time:>7}  {'; '.join(facts)}".rstrip()
    )


def _place(step: int | None) -> str:
    return "the end" if step is None else str(step)
