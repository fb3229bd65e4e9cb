"""Writes the difference between two plans as text."""

from typing import Final

from handeye.core.source import line_name
from handeye.core.units import INCH
from handeye.inspection.difference import Difference, MotionChange, PlaceChange, StepChange
from handeye.inspection.wording import degrees, figure, inches

_SIGNS: Final = {"added": "+", "removed": "-", "changed": "~", "replanned": " "}


def difference_text(found: Difference) -> list[str]:
    """Write the difference between two plans as lines of text."""
    if found.same:
        return ["no difference: both plans do the same work"]
    out = [f"~ {what}: {was} -> {now}" for what, was, now in found.heads]
    out += [f"- stage {name}" for name in found.stages_removed]
    out += [f"+ stage {name}" for name in found.stages_added]
    out += [_place(change) for change in found.places]
    stage = None
    for change in found.steps:
        if change.stage != stage:
            stage = change.stage
            out += ["", stage]
        out += _step(change)
    before, after = found.seconds
    return [*out, "", f"planned motion: {before:.2f} s -> {after:.2f} s"]


def _place(change: PlaceChange) -> str:
    said = ""
    if change.kind == "moved":
        vector = " ".join(figure(value / INCH) for value in change.shift)
        parts = [f"moved by [{vector}] in"] if any(change.shift) else []
        said = " and ".join([*parts, *([f"turned by {degrees(change.turn)}"] if change.turn else [])])
        return f"~ {change.what} {change.name}: {said}"
    if change.kind == "changed":
        said = ": now relative to another part" if change.what == "position" else ": looks different"
    return f"{_SIGNS[change.kind]} {change.what} {change.name}{said}"


def _step(change: StepChange) -> list[str]:
    number = change.before if change.after is None else change.after
    out = [f"{_SIGNS[change.kind]} {number:5}  line {line_name(change.line, change.file):<4}  {change.text}"]
    indent = " " * 20
    out += [f"{indent}{what}: {was} -> {now}" for what, was, now in change.changes]
    if change.motion is not None:
        out.append(f"{indent}motion: {_motion(change.motion)}")
    return out


def _motion(change: MotionChange) -> str:
    before, after = ("none" if s is None else f"{s:.2f} s" for s in (change.before, change.after))
    time = before if before == after else f"{before} -> {after}"
    if change.joint is None:
        return time
    by = inches(change.moved) if change.kind == "prismatic" else degrees(change.moved)
    return (
        f"{time}, the end position of joint {change.joint} ({change.name}) changes by "
        f"{by if change.moved < 0 else '+' + by}"
    )
