"""Formats a reply as lines of text, or as one line of JSON for programs."""

from collections.abc import Callable, Sequence
from typing import Any, Final

import msgspec
from msgspec import UNSET

from handeye.core.plain_text import counted, one_line
from handeye.core.source import line_name
from handeye.debugger.listing import excerpt_lines
from handeye.debugger.reply import CommandResult, Reply, StepSummary
from handeye.debugger.view_records import (
    PartPose,
    PartShown,
    PositionView,
    RunViews,
    TaskView,
)
from handeye.results.pauses import pause_sentence, stop_name

MAX_STEPS_SHOWN: Final = 24  # after a long command, on a terminal; the trace has all steps
STATEMENT_COLUMNS: Final = 30
_ORDER: Final = sorted(Reply.__struct_fields__, key=lambda name: name in CommandResult.__struct_fields__)


def as_json(reply: Reply) -> str:
    """Return the reply as a JSON object on one line."""
    fields = {name: getattr(reply, name) for name in _ORDER}
    told = {name: msgspec.to_builtins(value) for name, value in fields.items() if value is not UNSET}
    if reply.pause is not None:
        told["pause"] |= {"sentence": pause_sentence(reply.pause)}
    if reply.breaks is not UNSET:
        told["breaks"] = [
            {**shown, "at": stop_name(each.stop)}
            for shown, each in zip(told["breaks"], reply.breaks, strict=True)
        ]
    return msgspec.json.encode(told).decode()


def as_text(reply: Reply, most: int | None = None) -> str:
    """Return the reply as text without a final newline. If more than N steps were executed, only the last N are shown,
    where N is `most`.
    """
    if reply.error is not None:
        return reply.error
    lines = [*summary_lines(reply.did, most), _standing(reply)]
    if reply.source is not UNSET:
        lines += excerpt_lines(reply.source, "■" if reply.step is None else "→")
    if reply.show is not UNSET:
        lines += shown_lines(reply.show)
    if reply.breaks is not UNSET:
        lines += [f"{each.number:3}  {stop_name(each.stop)}" for each in reply.breaks] or [
            "no breakpoints are set"
        ]
    if reply.said is not UNSET:
        lines.append(reply.said)
    return "\n".join(lines)


def _standing(reply: Reply) -> str:
    stage = "after the last stage" if reply.stage is None else f"stage {reply.stage_number}, {reply.stage}"
    step = "" if reply.step is None else f", step {reply.step}"
    done = f"{counted(reply.position, 'step')} done"
    return f"── {stage}{step}; {done}, {reply.time:.2f} s"


def summary_lines(did: Sequence[StepSummary], most: int | None = None) -> list[str]:
    """Return the executed steps as lines of text. If there are more than N steps, only the last N are shown, where N
    is `most`.
    """
    left_out = 0 if most is None else max(0, len(did) - most)
    head = [f"      … {counted(left_out, 'line')} before these" if left_out else ""][: left_out and 1]
    return head + [told_row(step) for step in did[left_out:]]


def told_row(step: StepSummary) -> str:
    """Return an executed step, or an event between two steps, as a line of text."""
    if step.line is None:
        return f"      — {step.text}"
    return f"{line_name(step.line, step.file):>5} {step.text:{STATEMENT_COLUMNS}} {step.outcome}".rstrip()


# -- what is shown --------------------------------------------------------------------------------------


def shown_lines(shown: RunViews) -> list[str]:
    """Return the reply to a `show` command as lines of text."""
    lines: list[str] = []
    for field, tell in _LINES.items():
        value, title = getattr(shown, field), field.partition("_")[0]
        if value is UNSET:
            continue
        told = [_NOTHING.get(field, "none")] if value is None or value == {} else tell(value)
        lines += [f"{title if i == 0 else '':10}{line}" for i, line in enumerate(told)]
    return lines


def _vector(values: Sequence[float], places: int) -> str:
    return "(" + ", ".join(f"{x:z.{places}f}" for x in values) + ")"


def _named(table: dict[str, tuple[float, ...]]) -> list[str]:
    width = max(map(len, table))
    return [f"{name:{width}}  {_vector(value, 3)} in" for name, value in table.items()]


def _parts(parts: dict[str, PartShown]) -> list[str]:
    width = max(map(len, parts))
    lines = []
    for name, part in parts.items():
        lines.append(f"{name:{width}}  planned  {_pose(part.planned)}")
        for how, pose in (("measured", part.measured), ("is off", part.difference)):
            if pose is not None:
                lines.append(f"{'':{width}}  {how:8} {_pose(pose)}")
    return lines


def _pose(pose: PartPose) -> str:
    return f"{_vector(pose.at_in, 3)} in, {pose.yaw_deg:z.2f} deg"


def _tasks(tasks: tuple[TaskView, ...]) -> list[str]:
    width = max(len(each.task) for each in tasks)
    return [
        f"{each.task:{width}}  {line_name(each.line, each.file):>5}  {each.text}"
        + (f", waiting for {each.waits_for}" if each.waits_for else "")
        for each in tasks
    ]


def _positions(positions: dict[str, PositionView]) -> list[str]:
    width = max(map(len, positions))
    lines = []
    for name, taught in positions.items():
        where = "" if taught.of is None else f" of {taught.of}"
        moved = ", redefined" if taught.moved else ""
        angles = _vector(taught.at[3:], 1)
        lines.append(f"{name:{width}}  {_vector(taught.at[:3], 3)} in, {angles} deg{where}{moved}")
    return lines


_NOTHING: Final = {"force_oz": "there is no force estimate here, because no guard ended the last step"}
_JOINTS_PER_LINE: Final = 3
_LINES: Final[dict[str, Callable[[Any], Sequence[str]]]] = {
    "time_s": lambda seconds: [f"{seconds:.2f} s"],
    "joints": lambda joints: [
        ", ".join(
            f"{joint.name} {joint.value:z.2f} {joint.unit}" for joint in joints[i : i + _JOINTS_PER_LINE]
        )
        for i in range(0, len(joints), _JOINTS_PER_LINE)
    ],
    "hand": lambda hand: [f"at {_vector(hand.at_in, 3)} in, O A T {_vector(hand.angles_deg, 2)} deg"],
    "force_oz": lambda force: [f"the hand presses with {_vector(force, 1)} oz"],
    "gap_in": lambda gap: [f"{gap:z.3f} in"],
    "switches": lambda switches: [", ".join("closed" if switch else "open" for switch in switches)],
    "error": lambda error: [f"{error.number}: {one_line(error.sentence)}"],
    "saved_in": _named,
    "restored_in": _named,
    "search": lambda search: [
        f"place {search.place} of {search.places}, {_vector(search.offset_in, 2)} in from the first"
    ],
    "parts": _parts,
    "picture": lambda shown: [shown.name if shown.file is None else f"{shown.name}, in {shown.file}"],
    "positions": _positions,
    "tasks": _tasks,
    "state": lambda state: [f"{name} {value}" for name, value in state.items()],
}  # for each field, its lines of text; the title is its name without the unit
