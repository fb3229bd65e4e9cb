"""Compares two plans: pairs their steps, and finds the differences in stages, steps, positions, parts and motions."""

from collections.abc import Iterator, Sequence
from difflib import SequenceMatcher
from typing import Any, Final, Literal

import msgspec
import numpy as np

from handeye.arm.model import ArmModel, constants
from handeye.arm.robots import robot
from handeye.core.closeness import alike
from handeye.core.plain_text import one_line
from handeye.core.pose import Pose, hand, planar
from handeye.core.record import Record
from handeye.inspection.wording import conditions
from handeye.planfile.plan import Plan, PlannedMotion
from handeye.program.program import Part, Position, Program, Step

Pair = tuple[int | None, int | None]  # numbers of a step before and after; None if it was added or removed


def aligned(before: Sequence[Step], after: Sequence[Step]) -> list[Pair]:
    """Pair the steps of two programs. Each step occurs in exactly one pair. The pairs are in the order of the steps.

    Identical steps are matched first. The steps between two matches are then paired by their statements, and last by
    the kinds of their operations. A changed step therefore does not count as one removed step and one added step.
    """
    keys = (
        lambda step: f"{one_line(step.text)} {does(step)}",
        lambda step: one_line(step.text),
        lambda step: type(step.operation).__name__,
    )
    return list(_matched(before, after, range(len(before)), range(len(after)), keys))


def _matched(
    before: Sequence[Step], after: Sequence[Step], old: range, new: range, keys: tuple[Any, ...]
) -> Iterator[Pair]:
    """Match the steps of two ranges for which the first of `keys` gives the same value. Then match the steps that
    remain between these matches by the other keys.
    """
    if not keys or not old or not new:
        yield from ((number, None) for number in old)
        yield from ((None, number) for number in new)
        return
    one = [keys[0](before[number]) for number in old]
    other = [keys[0](after[number]) for number in new]
    for tag, a, b, c, d in SequenceMatcher(None, one, other, autojunk=False).get_opcodes():
        if tag == "equal":
            yield from zip(old[a:b], new[c:d], strict=True)
        else:
            yield from _matched(before, after, old[a:b], new[c:d], keys[1:])


def leads_alike(pairs: Sequence[Pair], old: int | None, new: int | None) -> bool:
    """Return True if an edge leads to the same step in both programs. The edge leads to step `old` in the first
    program and to step `new` in the second. Steps that only one program has are skipped. If the edge leads to the end
    of a program, the number is None.
    """
    at = _pair_of(pairs, 0, old)
    if at < len(pairs) and pairs[at][1] is not None:
        return pairs[at][1] == new
    return _survivor(pairs, at) == _survivor(pairs, _pair_of(pairs, 1, new))


def _pair_of(pairs: Sequence[Pair], side: int, number: int | None) -> int:
    """Return the index of the pair that contains step `number` of one program: of the first if `side` is 0, of the
    second if it is 1. For the end of the program, return the number of pairs.
    """
    return next((at for at, pair in enumerate(pairs) if pair[side] == number is not None), len(pairs))


def _survivor(pairs: Sequence[Pair], at: int) -> int | None:
    """Find the first pair with a step in both programs, beginning at the index `at`. Returns the index of this pair,
    or None if there is no such pair.
    """
    return next((place for place in range(at, len(pairs)) if None not in pairs[place]), None)


def does(step: Step) -> dict[str, Any]:
    """Return the operation of a step as data, without its branch target."""
    operation = step.operation.leading_to(None) if step.operation.branches else step.operation
    found: dict[str, Any] = msgspec.to_builtins(operation)
    return found


_TOLERANCE_M: Final = 1e-9  # m; smaller shifts are rounding errors
_LEAST_TURN: Final = 1e-6  # rad; the precision of an arc cosine near 1


class PlaceChange(Record, frozen=True, kw_only=True):
    """A position or part that was added, removed, moved or changed. `shift` (m) and `turn` (rad) say how the position
    or part moved. Both are given in the axes of the table, or of the part to which the position belongs.
    """

    kind: Literal["added", "removed", "moved", "changed"]
    what: Literal["position", "part"]
    name: str
    shift: tuple[float, float, float] = (0.0, 0.0, 0.0)
    turn: float = 0.0


def place_changes(before: Program, after: Program) -> list[PlaceChange]:
    """List the changes of positions and parts between two programs."""
    found = [
        _placed("part", n, before.parts.get(n), after.parts.get(n)) for n in {**before.parts, **after.parts}
    ]
    names = {**before.positions, **after.positions}
    found += [_placed("position", n, before.positions.get(n), after.positions.get(n)) for n in names]
    return [change for change in found if change is not None]


def _placed(
    what: Literal["position", "part"], name: str, one: Position | Part | None, other: Position | Part | None
) -> PlaceChange | None:
    if one is None or other is None:
        if one is other:
            return None
        return PlaceChange(kind="added" if one is None else "removed", what=what, name=name)
    if _alike(one, other):
        return None
    X_one, X_other = _pose(one), _pose(other)
    shift = X_other[:3, 3] - X_one[:3, 3]
    x, y, z = (float(value) for value in np.where(np.abs(shift) > _TOLERANCE_M, shift, 0.0))
    R = X_one[:3, :3].T @ X_other[:3, :3]
    turn = float(np.arccos(np.clip((np.trace(R) - 1) / 2, -1, 1)))
    moved = (x, y, z) != (0, 0, 0) or turn > _LEAST_TURN
    if one.at == other.at or _part(one) != _part(other) or not moved:
        return PlaceChange(kind="changed", what=what, name=name)
    return PlaceChange(
        kind="moved", what=what, name=name, shift=(x, y, z), turn=turn if turn > _LEAST_TURN else 0.0
    )


def _part(place: Position | Part) -> str | None:
    """Return the name of the part to which a position belongs, or None if it belongs to no part."""
    return place.of if isinstance(place, Position) else None


def _pose(place: Position | Part) -> Pose:
    return planar(*place.at) if isinstance(place, Part) else hand(*place.at)


_ALIKE = 1e-9  # m, rad or s; smaller differences between motions are rounding errors


class MotionChange(Record, frozen=True, kw_only=True):
    """How a planned motion changed: its duration (s), and the joint positions at its end."""

    before: float | None  # planned duration, s; None if there was no motion
    after: float | None
    joint: int | None = None
    """Number (from 1) of the joint whose end position changed most. So that hinges and slides can be compared, the
    measure of a change is the time that the joint needs for this change at its greatest speed. None if the end
    positions agree or the arms differ.
    """
    name: str = ""
    kind: Literal["revolute", "prismatic"] | None = None
    moved: float = 0.0  # change of that joint's end position, rad or m


class StepChange(Record, frozen=True, kw_only=True):
    """A step that was added, removed or changed, or a step of which only the motion changed (`replanned`)."""

    kind: Literal["added", "removed", "changed", "replanned"]
    before: int | None
    after: int | None
    stage: str
    file: str = ""  # required file that contains the step; empty: the script itself
    line: int
    text: str
    changes: tuple[tuple[str, str, str], ...] = ()  # what, before, after
    motion: MotionChange | None = None


class Difference(Record, frozen=True, kw_only=True):
    """All differences between two plans; empty if the plans do the same work."""

    heads: tuple[tuple[str, str, str], ...]  # settings such as arm and speed: what, before, after
    stages_removed: tuple[str, ...]
    stages_added: tuple[str, ...]
    places: tuple[PlaceChange, ...]
    steps: tuple[StepChange, ...]
    seconds: tuple[float, float]  # total planned time of the motions, before and after; each step counts once

    @property
    def same(self) -> bool:
        """True if the two plans do the same work. Comments do not count."""
        return not (self.heads or self.stages_removed or self.stages_added or self.places or self.steps)


def difference(before: Plan, after: Plan) -> Difference:
    """Compare two plans."""
    pairs = aligned(before.program.steps, after.program.steps)
    steps = (_step(before, after, pair, pairs) for pair in pairs)
    old, new = before.program.stages, after.program.stages
    compared = (
        ("arm", before.arm, after.arm),
        ("arm_digest", before.arm_digest, after.arm_digest),
        ("speed", f"{before.speed}", f"{after.speed}"),
    )
    heads = [head for head in compared if head[1] != head[2]]
    common = [[n for n in names if n in others] for names, others in ((old, new), (new, old))]
    if common[0] != common[1]:
        heads.append(("order of stages", ", ".join(common[0]), ", ".join(common[1])))
    return Difference(
        heads=tuple(heads),
        stages_removed=tuple(name for name in old if name not in new),
        stages_added=tuple(name for name in new if name not in old),
        places=tuple(place_changes(before.program, after.program)),
        steps=tuple(change for change in steps if change is not None),
        seconds=(_seconds(before), _seconds(after)),
    )


def _seconds(plan: Plan) -> float:
    return round(sum(sum(motion.times) for motion in plan.motions.values()), 6)


def _step(before: Plan, after: Plan, pair: Pair, pairs: list[Pair]) -> StepChange | None:
    old, new = pair
    if old is None or new is None:
        plan, number = (after, new) if old is None else (before, old)
        assert number is not None
        kind: Literal["added", "removed"] = "added" if old is None else "removed"
        return _change(kind, plan, number, pair)
    one, other = before.program.steps[old], after.program.steps[new]
    changes = list(step_changes(one, other))
    ways = [("then", one.next, other.next)]
    was, now = one.operation.branch, other.operation.branch
    if was is not None and now is not None and (was.error is None) == (now.error is None):
        when = f"while {now.counter} is positive" if now.error is None else f"if error {now.error}"
        ways.append((when, was.target, now.target))
    for what, there, here in ways:
        follows = (there, here) == (old + 1, new + 1)
        if not follows and not leads_alike(pairs, there, here):
            changes.append((what, _place(there), _place(here)))
    stages = before.program.stages[one.stage], after.program.stages[other.stage]
    if stages[0] != stages[1] and {*stages} <= {*before.program.stages} & {*after.program.stages}:
        changes.append(("stage", *stages))
    arm = robot(after.arm) if before.arm == after.arm else None
    if arm is not None and not {*before.joint_counts, *after.joint_counts} <= {len(arm.joints)}:
        arm = None  # an arm of that name, but with other joints
    motion = _motion(before.motions.get(old), after.motions.get(new), arm)
    if not changes and motion is None:
        return None
    return _change("changed" if changes else "replanned", after, new, pair, tuple(changes), motion)


def _change(
    kind: Literal["added", "removed", "changed", "replanned"], plan: Plan, number: int, pair: Pair,
    changes: tuple[tuple[str, str, str], ...] = (), motion: MotionChange | None = None,
) -> StepChange:  # fmt: skip
    step = plan.program.steps[number]
    return StepChange(
        kind=kind, before=pair[0], after=pair[1], stage=plan.program.stages[step.stage], file=step.file,
        line=step.line, text=one_line(step.text), changes=changes, motion=motion,
    )  # fmt: skip


def step_changes(one: Step, other: Step) -> Iterator[tuple[str, str, str]]:
    """Yield the differences between two paired steps. Each difference is given by three texts: what differs, the value
    before and the value after. Branch targets are not compared.
    """
    texts = [one_line(step.text) for step in (one, other)]
    guards = ["; ".join(conditions(step.operation)) or "none" for step in (one, other)]
    if texts[0] != texts[1]:
        yield "statement", texts[0], texts[1]
    if guards[0] != guards[1]:
        yield "guard", guards[0], guards[1]
    if texts[0] == texts[1] and guards[0] == guards[1]:
        was, now = does(one), does(other)
        yield from (
            (key, f"{was.get(key)}", f"{now[key]}") for key in now if not alike(was.get(key), now[key])
        )


def _alike(one: Record, other: Record) -> bool:
    """Return True if two records are equal apart from the last digits of their numbers."""
    return alike(msgspec.to_builtins(one), msgspec.to_builtins(other))


def _place(target: int | None) -> str:
    return "the end" if target is None else f"step {target}"


def _motion(
    one: PlannedMotion | None, other: PlannedMotion | None, arm: ArmModel | None
) -> MotionChange | None:
    before, after = (None if m is None else round(sum(m.times), 6) for m in (one, other))
    if one is None or other is None or arm is None:
        same = one is other or (one is not None and other is not None and _alike(one, other))
        return None if same else MotionChange(before=before, after=after)
    if len(one.knots) == len(other.knots) and np.allclose(one.knots, other.knots, rtol=0, atol=_ALIKE):
        alike = np.allclose(one.times, other.times, rtol=0, atol=_ALIKE)
        return None if alike else MotionChange(before=before, after=after)
    moved = np.array(other.knots[-1]) - np.array(one.knots[-1])
    if (np.abs(moved) < _ALIKE).all():
        return MotionChange(before=before, after=after)
    index = int(np.argmax(np.abs(moved) / constants(arm).speed))
    joint, by = arm.joints[index], float(moved[index])
    return MotionChange(
        before=before, after=after, joint=index + 1, name=joint.name, kind=joint.kind, moved=by
    )
