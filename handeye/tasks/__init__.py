"""Tasks by name. Each is a folder with its scene, its errors, its referee and what else knows it."""

from importlib import import_module
from typing import Any, Final

import numpy as np

from handeye.arm import robots
from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import BadArgument, NoSuchName, Refused
from handeye.tasks.interface import AnyTask, Task

DEFAULT: Final = "water_pump"
"""The task that is meant where none is named."""
_BUILT_IN: Final = {
    "water_pump": ("handeye.tasks.water_pump.task", "WATER_PUMP"),
    "insertion": ("handeye.tasks.insertion.task", "INSERTION"),
}
"""Where the tasks that come with handeye are found; they are imported when they are asked for."""
_TAUGHT: Final = {
    "palletise": ("handeye.systems.trig.jobs.task", "PALLET"),
    "bucket": ("handeye.systems.trig.jobs.task", "BUCKET_TASK"),
}
"""Those that no planned program does, likewise."""
_ELSEWHERE: Final = " (a task of your own is known to the Python program that calls `handeye.tasks.register`)"
_REGISTERED: Final[dict[str, Task]] = {}


def register(task: Task) -> None:
    """Make a task known by its name, and its arm by its own.

    Raises:
        InvalidInput: it is no task, has no name, its arm cannot stand where it is parked, or another task, or another
            arm, has the name.
    """
    if not isinstance(task, Task):
        raise BadArgument(f"a task is an object of a class that is derived from handeye.Task, not {task!r}")
    name = getattr(task, "name", None)
    if not isinstance(name, str) or not name.strip():
        raise BadArgument(f"a task needs a name, which is a text; {name!r} is none")
    joints = len(task.arm.joints)
    if np.shape(task.park) != (joints,):
        raise BadArgument(
            f"the task {quoted(name)} parks its arm at a position of shape {np.shape(task.park)}; "
            f"the {task.arm.name} arm has {joints} joints"
        )
    if task.name in {*_BUILT_IN, *_TAUGHT} or _REGISTERED.get(task.name, task) is not task:
        raise BadArgument(f"there is a task called {quoted(task.name)} already")
    robots.register(task.arm)
    _REGISTERED[task.name] = task


def any_task(name: str) -> AnyTask:
    """The task of a name, whatever kind of system does it.

    Raises:
        InvalidInput: there is none such.
    """
    return _imported(_TAUGHT[name]) if name in _TAUGHT else task(name)


def task(name: str = DEFAULT) -> Task:
    """The task of a name that planned programs do.

    Raises:
        InvalidInput: there is none such.
    """
    if not isinstance(name, str):
        raise BadArgument(f"a task is given by its name, not {name!r}")
    if name in _TAUGHT:
        raise Refused(f"the task {quoted(name)} is done by a taught program, not by a planned one")
    found = known(name)
    if found is None:
        names = {*_BUILT_IN, *_REGISTERED}
        near = suggestion(name, names) or f"there are {', '.join(map(quoted, sorted(names)))}"
        raise NoSuchName(f"no task is called {quoted(name)}; {near}{_ELSEWHERE}")
    return found


def known(name: str) -> Task | None:
    """The task of a name; None: this process does not know it, as it may be another program's own."""
    if name not in _BUILT_IN:
        return _REGISTERED.get(name)
    found: Task = _imported(_BUILT_IN[name])
    return found


def known_any(name: str) -> AnyTask | None:
    """The task of a name, whatever kind of system does it; None: as for `known`."""
    return any_task(name) if name in _TAUGHT else known(name)


def _imported(place: tuple[str, str]) -> Any:
    module, value = place
    return getattr(import_module(module), value)
