"""Finds the command that repeats a run."""

import shlex
from collections.abc import Sequence
from typing import Final

from handeye.core.resources import plans
from handeye.core.units import UNITS, Unit
from handeye.core.variation import Quantity, WorldSpec
from handeye.planfile.store import plan_digest, read_plan
from handeye.report.recorded import RecordedRun
from handeye.tasks import DEFAULT, known, option

_CAMERAS: Final = {"opengl": "gl", "rays": "ray"}
_TYPED: Final = 20  # with more settings of the world, the command reads them from the run's folder


def command(run: RecordedRun) -> str | None:
    """Return the command that repeats a run. Returns None if the run uses code or a task of the caller, because a
    command line can contain neither code nor a task.
    """
    head = run.trace.head
    if known(head.task) is None or head.own_parts:
        return None
    judged = ["--judge"] if run.result is not None and run.result.assembled is not None else []
    if len(head.world.overrides.set) > _TYPED and not head.lacking:
        return shlex.join(["handeye", "run", "plan.json", *option(head.task), "--world-of", ".", *judged])
    words = ["assemble"] if is_shipped(head.plan) else ["run", "plan.json", *option(head.task), *judged]
    kind = _CAMERAS.get(run.trace.head.camera.method)
    return shlex.join(
        [
            "handeye",
            *words,
            *world_words(head.world, head.task),
            *sense_words(head.lacking),
            *([] if kind is None else ["--camera", kind]),
        ]
    )


def is_shipped(digest: str) -> bool:
    """Return True if a plan is the one that `assemble` makes by default."""
    task = known(DEFAULT)
    assert task is not None
    assert task.script is not None
    made = (plans() / task.script).with_suffix(".plan.json")
    return made.is_file() and plan_digest(read_plan(made)) == digest


def sense_words(senses: Sequence[str]) -> list[str]:
    """Return the command-line options that switch off the given senses."""
    return [word for sense in senses for word in ("--without", sense)]


def world_words(world: WorldSpec, of: str) -> list[str]:
    """Return the command-line options that select a world of a known task."""
    task = known(of)
    assert task is not None
    quantities, faults = task.variation().quantities, task.faults(world)
    words = ["--seed", str(world.seed)]
    words += [] if world.level == "nominal" else ["--level", world.level]
    words += [word for name in world.overrides.without for word in ("--without", name)]
    for name, value in world.overrides.set.items():
        words += ["--set", f"{name}={written(quantities.get(name), value)}"]
    for name, factor in world.overrides.scale.items():
        words += ["--scale", f"{name}={factor!r}"]
    return [*words, *(word for fault in world.faults for word in ("--fault", faults.written(fault)))]


def written(quantity: Quantity | None, value: float) -> str:
    """Return a value (SI) as users type it. The value is in the unit of its quantity or, if that unit would lose
    precision, in the SI unit.
    """
    if quantity is None:
        return repr(value)
    for unit in (quantity.measure, _si(quantity.measure)):
        number = f"{value / unit.size:.9g}"
        if float(number) * unit.size == value:
            return f"{number}{unit.name.replace(' ', '')}"
    return f"{value!r}{_si(quantity.measure).name.replace(' ', '')}"


def _si(unit: Unit) -> Unit:
    """Return the SI unit that has the dimension of `unit`."""
    return next(each for each in UNITS.values() if each.dimension == unit.dimension and each.size == 1.0)
