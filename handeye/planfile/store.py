"""Plans on disk: JSON with one step, position or motion in each line, so that a text diff shows how a change in the
script changes the plan. A plan is checked when it is read.
"""

from pathlib import Path
from typing import Any, Final

import msgspec

from handeye.core import closeness
from handeye.core.entries import entry_of_file, refusal
from handeye.core.errors import BadFile
from handeye.core.files import Kind, read_whole, write_over
from handeye.planfile.plan import PLANNER, VERSION, Plan
from handeye.planfile.soundness import faults
from handeye.program.events import RunStarted

PLAN: Final = Kind("plan", rb'\{\s*"format": "handeye plan"')


def encode(plan: Plan) -> str:
    """Write a plan as canonical text."""
    data = msgspec.to_builtins(plan, str_keys=True)
    program = data.pop("program")
    motions = data.pop("motions")
    lines = ["{"]
    lines += [f' "{key}": {_line(value)},' for key, value in data.items()]
    lines.append(' "program": {')
    for number, (key, value) in enumerate(program.items(), 1):
        comma = "" if number == len(program) else ","
        if isinstance(value, dict):
            body = [f'   "{name}": {_line(item)}' for name, item in value.items()]
            lines += [f'  "{key}": {{', *_separated(body), f"  }}{comma}"]
        elif key == "steps":
            body = [f"   {_line(item)}" for item in value]
            lines += [f'  "{key}": [', *_separated(body), f"  ]{comma}"]
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
    import json  # needed to write a plan, but not to check a script

    return json.dumps(value, ensure_ascii=False)


def _separated(lines: list[str]) -> list[str]:
    return [f"{line}," for line in lines[:-1]] + lines[-1:]


def decode(text: str | bytes, name: str) -> Plan:
    """Read a plan from a text. Raises BadFile if the text is truncated, invalid, or of another format version."""
    try:
        head = msgspec.json.decode(text)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise BadFile(f"{name} is not a plan, or was cut short: {error}") from None
    if not isinstance(head, dict) or head.get("format") != "handeye plan":
        raise BadFile(f'{name} is not a plan: it lacks "format": "handeye plan"')
    version = head.get("version")
    if not isinstance(version, int):
        raise BadFile(f"{name} does not state its version of the plan format")
    if version != VERSION:
        raise BadFile(
            f"{name} has plan format version {version}; this version of handeye reads version {VERSION}: make the "
            f"plan again from its script, with `handeye plan`"
        )
    try:
        plan = msgspec.json.decode(text, type=Plan)
    except msgspec.DecodeError as error:
        raise BadFile(f"{name} is not a valid plan: {error}") from None
    for fault in faults(plan):
        raise BadFile(f"{name}: {fault}")
    return plan


def read_plan(path: Path) -> Plan:
    """Read a plan from a file. Raises BadFile if the file cannot be read, or if `decode` raises BadFile."""
    entry, _ = entry_of_file(path.name)
    if entry is not None:
        raise refusal(entry.name, "plans", str(path))
    data = read_whole(path)
    if not data.lstrip().startswith((b"{", b"[")):
        raise BadFile(f"{path} is not a plan; if it is a script, `handeye plan {path}` makes a plan from it")
    return decode(data, str(path))


def write_plan(path: Path, plan: Plan) -> None:
    """Write a plan completely or not at all. An existing file is replaced only if it is a plan. Raises
    InvalidInput if the file cannot be written.
    """
    write_over(path, encode(plan).encode(), PLAN)


def plan_digest(plan: Plan) -> str:
    """Compute sixteen hexadecimal digits that identify a plan by its inputs: texts, taught positions, arm, task and
    planner.

    The digits are the same on every processor. To compare the computed numbers as well, use `alike`.
    """
    program = plan.program
    here = program.written("position")  # positions that a `HERE` defines or moves: not only taught
    taught = {name: place for name, place in program.positions.items() if name not in here}
    texts = (program.name, program.language, program.source, program.required)
    cell = (taught, program.parts, program.fixtures, program.held)
    made = (PLANNER, plan.version, plan.task, plan.arm, plan.arm_digest, plan.speed)
    steps = _without_fractions(msgspec.to_builtins(program.steps))
    return written_digest(
        msgspec.json.encode((made, texts, cell, program.stages, steps), order="deterministic")
    )


def _without_fractions(value: Any) -> Any:
    """Remove all floating-point numbers from a value made of dictionaries and lists. The planner may have computed
    such numbers, so they can differ in their last digits.
    """
    if isinstance(value, dict):
        return {key: _without_fractions(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_without_fractions(each) for each in value]
    return None if isinstance(value, float) else value


def alike(one: Plan, other: Plan) -> bool:
    """Return True if two plans are equal apart from the last digits of computed numbers."""
    return one is other or closeness.alike(
        *(msgspec.to_builtins(plan, str_keys=True) for plan in (one, other))
    )


def written_digest(data: bytes) -> str:
    """Compute the digest of the bytes of a plan file. The digest covers all digits of the numbers in the file."""
    import hashlib

    return hashlib.sha256(data).hexdigest()[:16]


def is_plan_of(begun: RunStarted, data: bytes) -> bool:
    """Return True if a run executed the plan in `data`. If the run recorded the digest of its plan file, `data` must
    have exactly the bytes of that file.
    """
    digest = written_digest(data)
    if begun.content:
        return digest == begun.content
    return digest == begun.plan or begun.plan == _digest_of_plan(data)


def _digest_of_plan(data: bytes) -> str | None:
    """Return the `plan_digest` of the plan in `data`, or None if `data` is not a plan of motions."""
    try:
        return plan_digest(decode(data, "it"))
    except BadFile:
        return None
