"""The plan: a program joined with the motions of one arm. Versioned, in SI units, self-contained, diffable.

This is the second waist of the system. A plan on disk is JSON with one step, position or motion a line, so
that a text diff shows what a change in the script did to the arm.
"""

import json
from pathlib import Path
from typing import Any, Final

import msgspec

from handeye.errors import InvalidInput
from handeye.files import write_whole
from handeye.plan.program import Move, Program, Record

VERSION: Final = 1
"""Version of the format on disk."""

Joints = tuple[float, float, float, float, float, float]


class Motion(Record, frozen=True, kw_only=True):
    """A planned motion: joint positions it passes (rad, joint 3 in m) and the seconds between them."""

    knots: tuple[Joints, ...]
    """Start, lift-off, set-down and goal of a Move; start and goal of a straight motion or an arc."""
    times: tuple[float, ...]
    """Duration of each segment between knots, s."""


class Plan(Record, frozen=True, kw_only=True):
    """A program and the motions that one arm makes of it."""

    format: str = "handeye plan"
    version: int = VERSION
    arm: str
    """Name of the arm model."""
    arm_digest: str
    """Digest of the arm model's figures: a plan is not run on an arm it was not made for."""
    speed: float
    """Speed of free motions as a share of the arm's limits."""
    program: Program
    motions: dict[int, Motion]
    """Planned motion of each step that moves the arm, by step number."""


def encode(plan: Plan) -> str:
    """The plan as canonical text."""
    data = msgspec.to_builtins(plan, str_keys=True)
    program = data.pop("program")
    motions = data.pop("motions")
    lines = ["{"]
    lines += [f' "{key}": {_line(value)},' for key, value in data.items()]
    lines.append(' "program": {')
    for key, value in program.items():
        comma = "" if key == "parts" else ","
        if isinstance(value, dict):
            body = [f'   "{name}": {_line(item)}' for name, item in value.items()]
            lines += [f'  "{key}": {{', *_separated(body), f"  }}{comma}"]
        elif key == "steps":
            lines += [f'  "{key}": [', *_separated([f"   {_line(item)}" for item in value]), f"  ]{comma}"]
        else:
            lines.append(f'  "{key}": {_line(value)}{comma}')
    lines += [" },", ' "motions": {']
    lines += [
        *_separated([f'  "{number}": {_line(motion)}' for number, motion in motions.items()]),
        " }",
        "}",
    ]
    return "\n".join(lines) + "\n"


def _line(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)


def _separated(lines: list[str]) -> list[str]:
    return [f"{line}," for line in lines[:-1]] + lines[-1:]


def decode(text: str | bytes, name: str) -> Plan:
    """The plan in a text.

    Raises:
        InvalidInput: not a plan, cut short, of a newer version, or not sound.
    """
    try:
        head = msgspec.json.decode(text)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise InvalidInput(f"{name} is not a plan, or is cut short: {error}") from None
    if not isinstance(head, dict) or head.get("format") != "handeye plan":
        raise InvalidInput(f'{name} is not a plan: it does not say "format": "handeye plan"')
    version = head.get("version")
    if not isinstance(version, int) or version < 1:
        raise InvalidInput(f"{name} does not say which version of the plan format it has")
    if version > VERSION:
        raise InvalidInput(
            f"{name} has plan format version {version}; this handeye reads up to version {VERSION}"
        )
    try:
        plan = msgspec.json.decode(text, type=Plan)
    except msgspec.DecodeError as error:
        raise InvalidInput(f"{name} is not a sound plan: {error}") from None
    _check(plan, name)
    return plan


def _check(plan: Plan, name: str) -> None:
    """What the types cannot say: every reference leads somewhere."""
    program = plan.program
    count = len(program.steps)
    for number, step in enumerate(program.steps):
        where = f"{name}: step {number} (line {step.line})"
        targets = [step.next, getattr(step.operation, "raised", None)]
        for target in targets:
            if target is not None and not 0 <= target < count:
                raise InvalidInput(f"{where} leads to step {target}; the plan has steps 0 to {count - 1}")
        if not 0 <= step.stage < len(program.stages):
            raise InvalidInput(
                f"{where} belongs to stage {step.stage}; the plan has {len(program.stages)} stages"
            )
        goal = getattr(step.operation, "goal", None) or getattr(step.operation, "centre", None)
        if goal is not None and goal not in program.positions:
            raise InvalidInput(f"{where} uses position {goal}, which the plan does not have")
        part = getattr(step.operation, "part", None)
        if part is not None and part not in program.parts:
            raise InvalidInput(f"{where} uses part {part}, which the plan does not have")
        if isinstance(step.operation, Move) and number not in plan.motions:
            raise InvalidInput(f"{where} has no planned motion")
    for key, position in program.positions.items():
        if position.of is not None and position.of not in program.parts:
            raise InvalidInput(
                f"{name}: position {key} is relative to part {position.of}, which the plan does not have"
            )


def read_plan(path: Path) -> Plan:
    """The plan in a file.

    Raises:
        InvalidInput: as `decode`, or the file cannot be read.
    """
    try:
        text = path.read_bytes()
    except OSError as error:
        raise InvalidInput(f"{path} cannot be read: {error.strerror}") from None
    return decode(text, str(path))


def write_plan(path: Path, plan: Plan) -> None:
    """Write a plan, whole or not at all."""
    write_whole(path, encode(plan).encode())
