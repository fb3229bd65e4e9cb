"""Checks what the types of a plan cannot express: all references must lead to something that exists, and all numbers
must be within their limits.

A plan may have been truncated, edited or made by another program. A plan that passes these checks can be executed
safely.
"""

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Final

from handeye.core.obb import Box
from handeye.core.plain_text import counted
from handeye.planfile.plan import Plan, PlannedMotion
from handeye.program.guards import AnyGuard
from handeye.program.operation import Use
from handeye.program.operations import AnyOperation
from handeye.program.program import Program, SourcePlace, Step

_NAME: Final = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")  # names that become file names
_SHORTEST: Final = 1e-5  # s, shortest segment of a motion


def faults(plan: Plan) -> Iterator[str]:
    """Yield the faults of a plan, one sentence each. A valid plan has none."""
    program = plan.program
    if not program.steps:
        yield "it has no steps"
    if "" in program.required:
        yield "it requires a file but gives no name for this file"
    if len(set(program.stages)) < len(program.stages):
        yield "two of its stages have the same name"
    if not 0 < plan.speed <= 1:
        yield f"its speed is {plan.speed:g}; it must be a fraction of the arm's limits, above 0 and at most 1"
    for key, position in program.positions.items():
        if position.of is not None and position.of not in program.parts:
            yield f"position {key} is relative to part {position.of}, which is not in the plan"
        if not all(abs(value) <= 100 for value in position.at):
            yield f"position {key} has a coordinate above 100 m or rad"
    for key, part in program.parts.items():
        if not all(abs(value) <= 100 for value in part.at):
            yield f"part {key} has a coordinate above 100 m or rad"
    for key, fixture in program.fixtures.items():
        if not all(abs(value) <= 100 for value in fixture.at):
            yield f"fixture {key} has a coordinate above 100 m or rad"
        yield from _boxes(f"fixture {key}", fixture.boxes)
    for key, held in program.held.items():
        yield from (
            f"the plan says that {key} is held at the position {at}, but the plan has no {at}"
            for at in held.positions
            if at not in program.positions
        )
        yield from _boxes(key, held.boxes)
    texts = {"": program.source, **program.required}
    lines = {file: text.split("\n") for file, text in texts.items()}
    for number, step in enumerate(program.steps):
        for fault in (*_step(plan, number, step), *_places(step, lines)):
            yield f"step {number} (line {step.place}) {fault}"
    if len(plan.joint_counts) > 1:
        yield f"its motions have different numbers of joints: {' and '.join(map(str, plan.joint_counts))}"
    for number in plan.motions:
        if not 0 <= number < len(program.steps):
            yield f"it has a motion for step {number}, which does not exist"


def _boxes(what: str, boxes: tuple[Box, ...]) -> Iterator[str]:
    for box in boxes:
        if not all(-100 <= low < high <= 100 for low, high in zip(box[:3], box[3:], strict=True)):
            yield f"{what} has an empty box"


def _step(plan: Plan, number: int, step: Step) -> Iterator[str]:
    yield from _references(plan, step)
    for judged in (step.operation, *step.operation.guards):
        yield from _numbers(judged)
    yield from _choices(step.operation)
    yield from _motion(plan, number, step)


def _references(plan: Plan, step: Step) -> Iterator[str]:
    """Yield the faults in a step's references. A step refers to other steps, and to stages, positions, parts and
    pictures.
    """
    program, operation = plan.program, step.operation
    count = len(program.steps)
    for target in step.ways:
        if target is not None and not 0 <= target < count:
            yield f"leads to step {target}; the plan has steps 0 to {count - 1}"
    if step.file and step.file not in program.required:
        yield f"is in {step.file!r}, whose text is not in the plan"
    if not 0 <= step.stage < len(program.stages):
        yield f"belongs to stage {step.stage}; the plan has {counted(len(program.stages), 'stage')}"
    for use in dict.fromkeys((*operation.reads, *operation.writes)):
        yield from _use(program, use)


def _places(step: Step, lines: Mapping[str, Sequence[str]]) -> Iterator[str]:
    """A step and its modifiers name places in the source. Yield a fault for each place whose line or column the source
    does not have.
    """
    parts: tuple[Step | SourcePlace, ...] = (step, *step.modifiers)
    for words in parts:
        there = lines.get(words.file, ())
        start, end = words.span
        length = len(there[words.line - 1]) if 1 <= words.line <= len(there) else 0
        if not 0 <= start <= end <= length:
            yield f"is at characters {start} to {end} of line {words.line}, which has {counted(length, 'character')}"


def _use(program: Program, use: Use) -> Iterator[str]:
    """Yield a fault if a step uses a name that the program does not define."""
    match use.kind:
        case "position" if use.name not in program.positions:
            yield f"uses position {use.name}, which is not in the plan"
        case "part" if use.name not in program.parts:
            yield f"uses part {use.name}, which is not in the plan"
        case "target" if use.name not in program.parts | program.positions:
            yield f"aims at {use.name}, which is neither a part nor a position of the plan"
        case "picture" if not _NAME.fullmatch(use.name):
            yield f"uses the picture name {use.name!r}; a name consists of letters, digits and underscores"


def _numbers(operation: AnyOperation | AnyGuard) -> Iterator[str]:
    """Yield the faults in the numbers of an operation or guard: numbers outside their limits."""
    for field, (low, high) in operation.bounds.items():
        value = getattr(operation, field)
        size = math.hypot(*value) if isinstance(value, tuple) else value
        if size is not None and not low <= size <= high:
            has = f"a {field} of size" if isinstance(value, tuple) else field
            yield f"has {has} {size:g}; it must be from {low:g} to {high:g}"


def _choices(operation: AnyOperation) -> Iterator[str]:
    for field, choices in operation.choices.items():
        value = getattr(operation, field)
        if not any(math.isclose(value, choice) for choice in choices):
            yield f"has {field} {value:g}; it must be {' or '.join(f'{choice:g}' for choice in choices)}"


def _motion(plan: Plan, number: int, step: Step) -> Iterator[str]:
    operation, motion = step.operation, plan.motions.get(number)
    knots = operation.knots
    if motion is None:
        if operation.planned:
            yield "has no planned motion"
    elif knots is None:
        yield "has a planned motion but does not move"
    elif len(motion.knots) != knots or len(motion.times) != knots - 1:
        has = f"{counted(len(motion.knots), 'knot')} and {counted(len(motion.times), 'segment')}"
        yield f"has {has}, but needs {counted(knots, 'knot')} and {counted(knots - 1, 'segment')}"
    elif not _can_be_run(motion, 0.0 if knots == 2 else _SHORTEST):
        yield "has a planned motion with impossible times or joints"


def _can_be_run(motion: PlannedMotion, shortest: float) -> bool:
    return all(shortest <= t <= 600 for t in motion.times) and all(
        abs(q) <= 10 for knot in motion.knots for q in knot
    )  # fmt: skip
