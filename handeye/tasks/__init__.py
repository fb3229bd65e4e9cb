"""Finds the tasks of all systems by name. No other module lists them.

Some tasks belong to handeye. Other tasks come from one of three sources: the entry-point group `handeye.tasks` of an
installed package, `--task MODULE:NAME`, or a Python program that calls `register`. A task's module is imported when
the task is first used.
"""

import os
import sys
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from typing import Final, Literal

import numpy as np

from handeye.arm import robots
from handeye.core.diagnostics import quoted, suggestion
from handeye.core.entries import entries, entry_points, loaded, refusal
from handeye.core.errors import BadArgument, InvalidInput, NoSuchName, Refused
from handeye.core.plain_text import counted
from handeye.tasks.interface import AnyTask, Task

DEFAULT: Final = "water_pump"  # the task used if none is named
GROUP: Final = "handeye.tasks"  # entry points of this group name tasks of other packages
ELSEWHERE: Final = "HANDEYE_TASKS"
"""Environment variable with further tasks as MODULE:NAME, separated by spaces. If `--task` gives MODULE:NAME, handeye
adds it to this variable, so that child processes know the task.
"""
_BUILT_IN: Final = {
    "water_pump": "handeye.tasks.water_pump.task:WATER_PUMP",
    "insertion": "handeye.tasks.insertion.task:INSERTION",
}
_HINT: Final = (
    " (for your own task, give `--task MODULE:NAME`, install an entry point of the group `handeye.tasks`, or call "
    "`handeye.tasks.register` in Python)"
)
Kind = Literal["ours", "registered", "others"]
"""The origin of a task: handeye, this process (`register` or `--task`), or entry points of other packages."""
_REGISTERED: Final[dict[str, AnyTask]] = {}
_WORDS: Final[dict[str, str]] = {}  # the words of `--task`, by the names of the tasks that they registered


def register(task: AnyTask) -> None:
    """Register a task under its name, and its arm under the arm's name.

    Raises InvalidInput if the object is not a task, if it has no name, or if its parked configuration is outside the
    arm's limits. Also raises InvalidInput if the name of the task or of its arm is already in use.
    """
    if not isinstance(task, AnyTask):
        raise BadArgument(f"a task must be an instance of a class derived from handeye.Task, not {task!r}")
    name = getattr(task, "name", None)
    if not isinstance(name, str) or not name.strip():
        raise BadArgument(f"the name of a task must be a non-empty text, not {name!r}")
    if name in _ours() or _REGISTERED.get(name, task) is not task:
        raise BadArgument(f"there is already a task called {quoted(name)}")
    if isinstance(task, Task):
        joints = len(task.arm.joints)
        if np.shape(task.park) != (joints,):
            raise BadArgument(
                f"the task {quoted(name)} parks its arm at a position of shape {np.shape(task.park)}; "
                f"the {task.arm.name} arm has {counted(joints, 'joint')}"
            )
        robots.register(task.arm)
    _REGISTERED[name] = task


def named(words: str) -> AnyTask:
    """Return the task that `--task` names: either a known task, or MODULE:NAME. The module is searched for on
    the Python path and in the current folder.
    """
    if ":" not in words:
        return any_task(words)
    found = _loaded(words)
    register(found)
    _WORDS[found.name] = words
    if words not in (known := os.environ.get(ELSEWHERE, "").split()):
        os.environ[ELSEWHERE] = " ".join([*known, words])
    return found


def option(name: str) -> tuple[str, ...]:
    """Return the command-line option with which a command finds the task of a plan or run, for example `--task
    my_task:TASK`. Returns an empty tuple if the task is found by its name alone.
    """
    return ("--task", _WORDS[name]) if name in _WORDS else ()


def any_task(name: str) -> AnyTask:
    """Return the task called `name`, of any system. Raises InvalidInput if there is no such task."""
    if not isinstance(name, str):
        raise BadArgument(f"give a task by its name, not by {name!r}")
    found = known_any(name)
    if found is None:
        names = {*_ours(), *_REGISTERED, *_entry_points()}
        near = suggestion(name, names) or f"the tasks are {', '.join(map(quoted, sorted(names)))}"
        raise NoSuchName(f"there is no task {quoted(name)}; {near}{_HINT}")
    return found


def task(name: str = DEFAULT) -> Task:
    """Return the task called `name`. Raises InvalidInput if there is no such task, or if the task runs no planned
    programs.
    """
    return planned(any_task(name))


def planned(task: AnyTask) -> Task:
    """Return `task` unchanged if it runs planned programs. Raises InvalidInput if the task runs no planned programs."""
    if not isinstance(task, Task):
        system = next((entry.name for entry in entries().values() if task.name in entry.tasks), None)
        if system is not None:
            raise refusal(system, "plans", f"the task {quoted(task.name)}")
        raise Refused(f"the task {quoted(task.name)} does not use planned programs")
    return task


def known_any(name: str) -> AnyTask | None:
    """Return the task called `name`. Returns None if this process does not know the task, for example because the task
    was registered only in another process. Raises InvalidInput if the task's module cannot be imported.
    """
    if name not in _REGISTERED and (place := _BUILT_IN.get(name) or _ours().get(name)) is not None:
        return _loaded(place)
    if name not in _REGISTERED and name in _entry_points():
        found = _loaded(_entry_points()[name])
        if found.name != name:
            raise BadArgument(
                f"the entry point {quoted(name)} contains a task with a different name, {quoted(found.name)}"
            )
        register(found)
    for words in () if name in _REGISTERED else os.environ.get(ELSEWHERE, "").split():
        try:
            register(_loaded(words))
        except InvalidInput as error:
            raise BadArgument(f"the environment variable {ELSEWHERE}: {error}") from None
    return _REGISTERED.get(name)


def known(name: str) -> Task | None:
    """Return the task called `name` if that task runs planned programs. Returns None if the task runs no planned
    programs, or if this process knows no such task.
    """
    found = known_any(name)
    return found if isinstance(found, Task) else None


def of_plans(kind: Kind) -> Iterator[Task]:
    """Yield the tasks of one kind (`ours`, `registered` or `others`) that run planned programs. Each task is imported
    when the iteration reaches it; a task that cannot be imported is left out.
    """
    for name in _NAMES[kind]():
        try:
            found = known(name)
        except InvalidInput:  # the error is reported when the task is requested by its name
            continue
        if found is not None:
            yield found


def _ours() -> dict[str, str]:
    """Return the addresses from which the tasks of handeye and of its systems are imported. The keys are the names of
    the tasks, and the values have the form MODULE:NAME.
    """
    return _BUILT_IN | {name: place for entry in entries().values() for name, place in entry.tasks.items()}


@cache
def _entry_points() -> dict[str, str]:
    return entry_points(GROUP)


def _loaded(words: str) -> AnyTask:
    """Import the task MODULE:NAME. Raises InvalidInput if there is no such task, or if the import fails."""
    module, _, name = words.partition(":")
    if not all(part.isidentifier() for part in (*module.split("."), name)):
        raise BadArgument(f"name a task as MODULE:NAME, such as my_task:TASK, not {quoted(words)}")
    if module.partition(".")[0] != "handeye" and os.getcwd() not in sys.path:
        sys.path.append(
            os.getcwd()
        )  # last on the path, so that no file in the folder hides an installed module
    found = loaded(words, "the task ")
    if not isinstance(found, AnyTask):
        raise BadArgument(
            f"{quoted(words)} is not a task; a task is an instance of a class derived from handeye.Task"
        )
    return found


_NAMES: Final[dict[Kind, Callable[[], Iterable[str]]]] = {
    "ours": lambda: _BUILT_IN,
    "registered": lambda: [*_REGISTERED],
    "others": lambda: _entry_points(),
}
