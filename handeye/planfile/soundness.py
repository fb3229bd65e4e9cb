"""What the types of a plan cannot say: every reference leads somewhere, and every number can be carried out.

A plan may have been cut, edited or made by another program; whatever passes here can be run without a surprise.
"""

import math
import re
from collections.abc import Iterator
from typing import Final

from handeye.boxes import Box
from handeye.planfile.plan import Motion, Plan
from handeye.ports.camera import LENSES
from handeye.program import program as op

_NAME: Final = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
"""Names that become file names."""
_FORCE: Final = (1e-6, 1e4)  # N, or N m
_LENGTH: Final = (1e-6, 10.0)  # m
_SHORTEST: Final = 1e-5  # s, segment of a polynomial

_BOUNDS: Final[dict[tuple[type, str], tuple[float, float]]] = {
    (op.Change, "speed"): (1e-4, 2.0),
    (op.Turn, "angle"): (-4 * math.pi, 4 * math.pi),
    (op.Open, "gap"): (0.0, 0.2),
    (op.Close, "minimum"): (0.0, 0.2),
    (op.Close, "maximum"): (0.0, 0.2),
    (op.Center, "minimum"): (0.0, 0.2),
    (op.Search, "step"): (1e-5, 0.5),
    (op.Search, "limit"): (1, 10_000),
    (op.Assign, "value"): (0, 1000),
    (op.Load, "weight"): (-1e3, 1e3),
    (op.Tool, "speed"): (-1e3, 1e3),
    (op.Travel, "minimum"): (-10.0, 10.0),
    (op.Travel, "maximum"): (-10.0, 10.0),
}
"""Least and greatest value of a number of an operation, SI."""


def faults(plan: Plan) -> Iterator[str]:
    """What is wrong with a plan, a sentence each; nothing if it is sound."""
    program = plan.program
    if not program.steps:
        yield "it has no steps"
    if "" in program.required:
        yield "it requires a file that has no name"
    if len(set(program.stages)) < len(program.stages):
        yield "two of its stages have the same name"
    if not 0 < plan.speed <= 1:
        yield f"its speed is {plan.speed:g}; a share of the arm's limits is above 0 and at most 1"
    for key, position in program.positions.items():
        if position.of is not None and position.of not in program.parts:
            yield f"position {key} is relative to part {position.of}, which the plan does not have"
        if not all(abs(value) <= 100 for value in position.at):
            yield f"position {key} is not on this table"
    for key, part in program.parts.items():
        if not all(abs(value) <= 100 for value in part.at):
            yield f"part {key} is not on this table"
    for key, fixture in program.fixtures.items():
        if not all(abs(value) <= 100 for value in fixture.at):
            yield f"fixture {key} is not on this table"
        yield from _boxes(f"fixture {key}", fixture.boxes)
    for key, held in program.held.items():
        yield from (
            f"{key} is held at {at}, which the plan does not have"
            for at in held.positions
            if at not in program.positions
        )
        yield from _boxes(key, held.boxes)
    for number, step in enumerate(program.steps):
        for fault in (*_references(plan, step), *_numbers(step.operation), *_motion(plan, number, step)):
            yield f"step {number} (line {step.place}) {fault}"
    for number in plan.motions:
        if not 0 <= number < len(program.steps):
            yield f"it has a motion for step {number}, and no such step"


def _boxes(what: str, boxes: tuple[Box, ...]) -> Iterator[str]:
    for box in boxes:
        if not all(-100 <= low < high <= 100 for low, high in zip(box[:3], box[3:], strict=True)):
            yield f"{what} has a box without an inside"


def _references(plan: Plan, step: op.Step) -> Iterator[str]:
    """Steps, stages, positions, parts and pictures a step names."""
    program, operation = plan.program, step.operation
    count = len(program.steps)
    for target in step.ways:
        if target is not None and not 0 <= target < count:
            yield f"leads to step {target}; the plan has steps 0 to {count - 1}"
    if step.file and step.file not in program.required:
        yield f"stands in {step.file!r}, a file whose text the plan does not have"
    if not 0 <= step.stage < len(program.stages):
        yield f"belongs to stage {step.stage}; the plan has {len(program.stages)} stages"
    named = [getattr(operation, field, None) for field in ("goal", "centre", "position")]
    for name in (*named, *getattr(operation, "via", ())):
        if name is not None and name not in program.positions:
            yield f"uses position {name}, which the plan does not have"
    part = getattr(operation, "part", None)
    if part is not None and part not in program.parts:
        yield f"uses part {part}, which the plan does not have"
    if isinstance(operation, op.Aim) and operation.target not in program.parts | program.positions:
        yield f"aims at {operation.target}, which is no part or position of the plan"
    for field in ("picture", "before", "after"):
        name = getattr(operation, field, None)
        if name is not None and not _NAME.fullmatch(name):
            yield f"calls a picture {name!r}; a name has letters, digits and underscores"


def _numbers(operation: op.AnyOperation) -> Iterator[str]:
    """Numbers that cannot be carried out."""
    for (kind, field), (low, high) in _BOUNDS.items():
        value = getattr(operation, field) if isinstance(operation, kind) else None
        if value is not None and not low <= value <= high:
            yield f"has {field} {value:g}; it has to be from {low:g} to {high:g}"
    if isinstance(operation, op.Change):
        yield from _size("displacement", operation.displacement, _LENGTH)
        for field in ("press", "moment"):
            value = getattr(operation, field)
            if value is not None:
                yield from _size(field, value, _FORCE)
    if isinstance(operation, op.Lens) and not any(math.isclose(operation.focal_length, f) for f in LENSES):
        yield f"wants a lens of {operation.focal_length * 1000:g} mm; the turret has 25 and 50 mm"
    stop = getattr(operation, "stop", None)
    if stop is not None:
        yield from _stop(stop)


def _stop(stop: op.Stop) -> Iterator[str]:
    """What is wrong with what ends a motion."""
    given = [value for value in (stop.force, stop.against, stop.torque, stop.touch) if value is not None]
    beside = stop.moment is not None and (stop.torque is not None or stop.touch is not None)
    if len(given) > 1 or (not given and stop.moment is None) or beside:
        yield f"has a stop with {len(given) + (stop.moment is not None)} conditions; it has to have one"
    if stop.touch not in (None, 1, 2, 3):
        yield f"has a stop on finger switches {stop.touch}; there are 1, 2, and 3 for either"
    for value in (stop.force, stop.moment, stop.against, stop.torque):
        if value is not None:
            yield from _size("stop", value if isinstance(value, tuple) else (value, 0.0, 0.0), _FORCE)


def _size(what: str, vector: op.Vector, bounds: tuple[float, float]) -> Iterator[str]:
    size = math.hypot(*vector)
    if not bounds[0] <= size <= bounds[1]:
        yield f"has a {what} of size {size:g}; it has to be from {bounds[0]:g} to {bounds[1]:g}"


def _motion(plan: Plan, number: int, step: op.Step) -> Iterator[str]:
    motion = plan.motions.get(number)
    moves = isinstance(step.operation, op.Move | op.Change | op.Turn)
    if motion is None:
        if isinstance(step.operation, op.Move):
            yield "has no planned motion"
        return
    via = len(getattr(step.operation, "via", ()))
    knots = 4 + via if isinstance(step.operation, op.Move) else 2
    if via > op.VIAS:
        yield f"is led by {via} positions; {op.VIAS} are the most"
    elif not moves:
        yield "has a planned motion, and does not move"
    elif len(motion.knots) != knots or len(motion.times) != knots - 1:
        yield f"has {len(motion.knots)} knots and {len(motion.times)} times; {knots} and {knots - 1} are right"
    elif not _can_be_run(motion, 0.0 if knots == 2 else _SHORTEST):
        yield "has a planned motion with times or joints no arm can have"


def _can_be_run(motion: Motion, shortest: float) -> bool:
    return all(shortest <= t <= 600 for t in motion.times) and all(
        abs(q) <= 10 for knot in motion.knots for q in knot
    )  # fmt: skip
