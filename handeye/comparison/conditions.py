"""Conditions that two runs depended on."""

from collections.abc import Iterator
from typing import Final

from handeye.core.faults import Fault
from handeye.core.record import Record
from handeye.program.events import RunStarted
from handeye.report.facts.again import written
from handeye.tasks import known
from handeye.tasks.interface import Task
from handeye.trace.sentences import renderer_name

_NONE: Final = "none"
_DRAWN: Final = "as drawn"


class Condition(Record, frozen=True, kw_only=True):
    """A condition in which two runs differ."""

    what: str
    """`task`, `plan`, `arm`, `camera`, `seed` and other words of the world, the names of quantities that were set,
    `version of ...`, `own ...`."""
    a: str
    b: str


def conditions(a: RunStarted, b: RunStarted) -> tuple[Condition, ...]:
    """The conditions in which two runs differ."""
    both = [dict(_conditions(begun)) for begun in (a, b)]
    drawn = {name: _DRAWN for begun in (a, b) for name in begun.world.overrides.set}
    names = dict.fromkeys(name for side in both for name in side)
    told = ((name, *(side.get(name, drawn.get(name, _NONE)) for side in both)) for name in names)
    return tuple(Condition(what=name, a=one, b=other) for name, one, other in told if one != other)


def _conditions(begun: RunStarted) -> Iterator[tuple[str, str]]:
    yield "task", begun.task
    yield "program", begun.program
    yield "plan", begun.plan
    yield "arm", f"{begun.arm} {begun.arm_digest}"
    yield from _world(begun)
    yield "camera", renderer_name(begun.camera)
    yield "senses that are lacking", ", ".join(begun.lacking) or _NONE
    yield from ((f"own {part}", name) for part, name in begun.own_parts.items())
    yield from ((f"version of {name}", version) for name, version in begun.versions.items())


def _world(begun: RunStarted) -> Iterator[tuple[str, str]]:
    world, task = begun.world, known(begun.task)
    quantities = {} if task is None else task.variation(world.seed).quantities
    yield "drawing of the world", f"{world.drawing}"
    yield "seed", f"{world.seed}"
    yield "level", world.level
    yield "switched off", ", ".join(world.overrides.without) or _NONE
    yield from ((name, written(quantities.get(name), value)) for name, value in world.overrides.set.items())
    yield from ((f"fault {fault.name}", _fault(task, world.seed, fault)) for fault in world.faults)


def _fault(task: Task | None, seed: int, fault: Fault) -> str:
    """A fault as on the command line, where its task is known."""
    catalogue = None if task is None else task.faults(seed)
    return str(fault) if catalogue is None or fault.name not in catalogue.kinds else catalogue.written(fault)
