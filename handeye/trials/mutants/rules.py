"""Makes the mutants of a program by rule: at each line in turn, one check is taken away or weakened, or one guard is
loosened. Steps keep their numbers, so a mutant runs with the planned motions of the original program.
"""

from collections.abc import Callable, Iterator, Mapping
from typing import Final

from msgspec.structs import replace

from handeye.core.record import Record
from handeye.program.flow_operations import Advance, Countdown, Jump, Test, Wait
from handeye.program.guards import Against, AnyGuard, Force, Guards, Moment, Torque
from handeye.program.motion_operations import Center, Change, Close, Height, Move, Travel, Turn
from handeye.program.program import Program, Step
from handeye.program.vision_operations import Comparison

DOUBLE: Final = 2.0  # factor on a range of limits, and on the force of a guard
Rule = Callable[[Program, Step], Step | None]


class Mutant(Record, frozen=True, kw_only=True):
    """A program with one change, which applies to all steps of one line."""

    name: str  # rule and line
    steps: tuple[int, ...]  # the changed steps
    program: Program

    @property
    def stage(self) -> int:
        """Number, from 1, of the first stage that the change affects."""
        return self.program.steps[self.steps[0]].stage + 1


def mutants(program: Program) -> Iterator[Mutant]:
    """Yield all mutants of a program, in the order of its lines."""
    lines: dict[tuple[str, int], list[int]] = {}
    for number, step in enumerate(program.steps):
        lines.setdefault((step.file, step.line), []).append(number)
    for _, numbers in sorted(lines.items()):
        for rule, change in RULES.items():
            made = {number: change(program, program.steps[number]) for number in numbers}
            changed = {number: step for number, step in made.items() if step is not None}
            if changed:
                steps = tuple(changed.get(number, step) for number, step in enumerate(program.steps))
                place = program.steps[numbers[0]]
                yield Mutant(
                    name=f"{rule}: line {place.place} {place.word}",
                    steps=tuple(changed),
                    program=replace(program, steps=steps),
                )


def _left_out(_: Program, step: Step) -> Step | None:
    """Leave out a check."""
    checks = isinstance(step.operation, Height | Travel | Comparison)
    return replace(step, operation=Jump()) if checks else None


def _not_called(_: Program, step: Step) -> Step | None:
    """Do not call the operator, and go on."""
    return replace(step, operation=Jump()) if isinstance(step.operation, Wait) else None


def _unmeasured(_: Program, step: Step) -> Step | None:
    """Do not measure what the fingers hold."""
    operation = step.operation
    if isinstance(operation, Close) and (operation.minimum or operation.maximum is not None):
        return replace(step, operation=replace(operation, minimum=0.0, maximum=None))
    if isinstance(operation, Center) and operation.minimum:
        return replace(step, operation=replace(operation, minimum=0.0))
    return None


def _wider(_: Program, step: Step) -> Step | None:
    """Double the range of a check, and keep the middle of the range. The minimum length of a motion is at least 0."""
    operation = step.operation
    if not isinstance(operation, Height | Travel):
        return None
    middle = (operation.minimum + operation.maximum) / 2
    half = DOUBLE * (operation.maximum - operation.minimum) / 2
    least = max(0.0, middle - half) if isinstance(operation, Travel) else middle - half
    return replace(step, operation=replace(operation, minimum=least, maximum=middle + half))


def _ignored(program: Program, step: Step) -> Step | None:
    """Make both branches of a test lead to the same target: the target of the better branch. A branch is bad if it
    leads to a call to the operator or to a repetition.
    """
    operation = step.operation
    if not isinstance(operation, Test) or operation.raised == step.next:
        return None
    bad = [_gives_up(program, step.next), _gives_up(program, operation.raised)]
    target = operation.raised if bad == [True, False] else step.next
    return replace(step, operation=replace(operation, raised=target), next=target)


def _gives_up(program: Program, number: int | None) -> bool:
    seen: set[int] = set()
    while number is not None and number not in seen:
        seen.add(number)
        step = program.steps[number]
        if not isinstance(step.operation, Jump):
            return isinstance(step.operation, Wait | Advance | Countdown)
        number = step.next
    return False


def _unguarded(_: Program, step: Step) -> Step | None:
    """Take away the guards of a motion."""
    return _guarded(step, ())


def _harder(_: Program, step: Step) -> Step | None:
    """Double the force, moment or torque at which the guards of a motion trip."""
    return _guarded(step, tuple(map(_doubled, step.operation.guards)))


def _guarded(step: Step, guards: Guards) -> Step | None:
    operation = step.operation
    if not isinstance(operation, Move | Change | Turn) or not operation.guards or guards == operation.guards:
        return None
    return replace(step, operation=replace(operation, guards=guards))


def _doubled(guard: AnyGuard) -> AnyGuard:
    match guard:
        case Force(force=(x, y, z)):
            return replace(guard, force=(DOUBLE * x, DOUBLE * y, DOUBLE * z))
        case Moment(moment=(x, y, z)):
            return replace(guard, moment=(DOUBLE * x, DOUBLE * y, DOUBLE * z))
        case Against():
            return replace(guard, force=DOUBLE * guard.force)
        case Torque():
            return replace(guard, torque=DOUBLE * guard.torque)
    return guard


RULES: Final[Mapping[str, Rule]] = {
    "left out": _left_out,
    "not called": _not_called,
    "not measured": _unmeasured,
    "limits doubled": _wider,
    "error ignored": _ignored,
    "unguarded": _unguarded,
    "guard doubled": _harder,
}
"""The rules by name. Each returns the changed step, or None if the rule does not apply to the step."""
