"""Entries of systems: descriptions that can be read before the systems themselves are loaded.

A system is a folder of `handeye/systems`, or another package that names its entry in the entry-point group
`handeye.systems`. An entry is plain data: names, sentences, and the locations of the system's objects, written
`module:NAME`.
"""

import sys
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from typing import Any, Final, Literal

import msgspec
from msgspec import field

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadFile, HandeyeError, NoSuchName, Refused
from handeye.core.record import Record

GROUP: Final = "handeye.systems"  # the entry-point group in which packages from elsewhere name their entries
OWN: Final = (
    "handeye.systems.stanford:ENTRY",
    "handeye.systems.trig:ENTRY",
    "handeye.systems.sigma:ENTRY",
    "handeye.systems.ml:ENTRY",
    "handeye.systems.relay:ENTRY",
)  # entries that need no installed metadata
PLANNED: Final = "program"  # the system that executes plans of motions; the default

Capability = Literal[
    "plans",
    "undo",
    "compare",
    "faults",
    "levels",
    "senses",
    "video",
    "chaos",
    "format",
    "console",
    "python",
    "leg",
]
VERBS: Final[Mapping[Capability, str]] = {
    "plans": "run a plan of motions",
    "undo": "undo what it did",
    "compare": "compare two of its runs",
    "faults": "simulate faults",
    "levels": "change the errors of its world",
    "senses": "do without a sense",
    "video": "make a video of its run",
    "chaos": "run chaos tests",
    "format": "format its scripts",
    "console": "accept typed lines",
    "python": "continue its runs from Python",
    "leg": "run a leg of a relay",
}  # capabilities of a system, as words after `cannot`


class Entry(Record, frozen=True, kw_only=True):
    """The description of a system: its names, help, capabilities, and the locations of its objects."""

    name: str  # checkpoints and traces name it
    title: str  # its name in sentences
    help: str  # a one-line description
    system: str  # `module:NAME` of its `handeye.runs.system.System`
    can: tuple[Capability, ...] = ()
    reasons: dict[Capability, str] = field(default_factory=dict)  # why the system cannot do it
    commands: str = ""  # a line each: `NAME = MODULE:FUNCTION: SENTENCE`, as in `handeye/cli/commands.py`
    tasks: dict[str, str] = field(default_factory=dict)  # `module:NAME` of each of its tasks
    machines: dict[str, str] = field(default_factory=dict)  # `module:NAME` of an `ArmMachine`, by name
    sweeps: dict[str, str] = field(default_factory=dict)  # `module:NAME` of a `Sweep`, by kind
    faults: str = ""
    """`module:NAME` of a function that takes a task's name and a world. The function returns the kind of the sweep,
    and the work that `handeye faults` does for each fault. `faults` is empty if `handeye faults` cannot test programs
    of the system.
    """
    programs: str = ""
    """`module:NAME` of a function that returns the plan with which a program does a task. The function takes the name
    of the task, the name and text of the program, and a variant of the task (empty for the usual one). This field is
    empty if the system has no tasks that a program can do, or if the plans of the system consist of motions.
    """
    orders: str = ""
    """`module:NAME` of a function that takes the name and text of a program. It returns the problems that the program
    has in at least one order of its concurrent tasks, the worst first. Each problem is a pair of a truth value and a
    sentence; the value is True if the program does not notice the problem. `orders` is empty if the system cannot try
    every order.
    """
    events: str = ""  # `module:NAME` of a tuple: the kinds of events that only this system has
    languages: dict[str, str] = field(default_factory=dict)  # `OwnLanguage` by file ending
    leg: str = (
        ""  # `module:NAME` of the `handeye.runs.legs.LegSystem` of a system that can run a leg of a relay
    )
    environments: dict[str, str] = field(default_factory=dict)
    """The Gymnasium environments of the system. The key is the id of an environment, and the value is the
    `module:NAME` of its `handeye.env.jobs.Job`.
    """
    exercises: tuple[str, ...] = ()  # `module:NAME` of each `Exercise` for students
    files: tuple[str, ...] = ()  # files that its finished runs add to their folders


_registered: Final[dict[str, Entry]] = {}


def register(entry: Entry) -> None:
    """Make a system known in this process. The system replaces a registered system of the same name."""
    _registered[entry.name] = entry


def entries() -> Mapping[str, Entry]:
    """Return the entries included with handeye, the entries of installed packages, and the entries of registered
    systems. The keys are the names of the systems.
    """
    return {entry.name: entry for entry in (*_installed(), *_registered.values())}


def _installed() -> list[Entry]:
    if not _found:
        _found.extend(loaded(place) for place in OWN)
        for name, place in entry_points(GROUP).items():
            try:
                _found.append(_sound(loaded(place)))
            except (HandeyeError, msgspec.ValidationError) as error:
                _broken[name] = str(error)
    return _found


def _sound(entry: object) -> Entry:
    """Check that the fields of an entry have the right types and that its names are not taken by another entry.
    Raises BadFile or msgspec.ValidationError.
    """
    if not isinstance(entry, Entry):
        raise BadFile(f"the entry point names {entry!r}, but this value is not an Entry")
    msgspec.convert(msgspec.to_builtins(entry), Entry)
    if entry.name in (other.name for other in _found):
        raise BadFile(f"there is already a system called {quoted(entry.name)}")
    return entry


_found: Final[list[Entry]] = []
_broken: Final[dict[str, str]] = {}  # reasons, by entry point


def entry_named(name: str) -> Entry:
    """Return the entry of the system `name`. Raises NoSuchName if no system has this name."""
    known = entries()
    if name in _broken:
        raise BadFile(f"the system {quoted(name)} cannot be loaded: {_broken[name]}")
    if name not in known:
        raise NoSuchName(f"there is no system {quoted(name)} here; the systems are {', '.join(known)}")
    return known[name]


def loaded(place: str, what: str = "") -> Any:
    """Import the object at `module:NAME`. Raises BadFile if the object cannot be imported. The error message begins
    with the text `what` and the location.
    """
    module, _, name = place.partition(":")
    try:
        return getattr(import_module(module), name)
    except HandeyeError:
        raise
    except (Exception, SystemExit) as error:
        said = " ".join(f"{type(error).__name__}: {error}".split()).removesuffix(":")
        raise BadFile(f"{what}{quoted(place)} cannot be imported: {said}") from error


def entry_of_file(name: str) -> tuple[Entry | None, str]:
    """From the ending of a file's name, find the system in whose language the file is written. Returns two
    values: the entry, and the longest ending that matches. If no ending matches, the values are None and "".
    """
    known = {ending: entry for entry in entries().values() for ending in entry.languages}
    ending = max(filter(name.lower().endswith, known), key=len, default="")
    return known.get(ending), ending


def refusal(name: str, capability: Capability, whose: str = "") -> Refused:
    """Make the exception for a system that lacks a capability. `whose` names the run or file that needs the
    capability; it is empty if neither is concerned.
    """
    entry = entry_named(name)
    why = entry.reasons.get(capability, "")
    before, behind = f"{whose}: " if whose else "", f": {why}" if why else ""
    return Refused(f"{before}{entry.title} cannot {VERBS[capability]}{behind}")


def require(name: str, capability: Capability, whose: str = "") -> None:
    """Raise Refused, with the system's name and the reason, if the system lacks a capability."""
    if capability not in entry_named(name).can:
        raise refusal(name, capability, whose)


FILE = "entry_points.txt"


def entry_points(group: str) -> dict[str, str]:
    """Return the entry points of a group. The keys are their names, and the values are locations `module:NAME`.
    `importlib.metadata` is imported only if some package has entry points.
    """
    heading = f"[{group}]"
    if not any(heading in file.read_text("utf-8", "replace") for path in sys.path for file in _files(path)):
        return {}
    from importlib import metadata  # an eighth of the time that a short command takes

    return {point.name: point.value for point in metadata.entry_points(group=group)}


def _files(path: str) -> list[Path]:
    try:
        return [*Path(path).glob(f"*-info/{FILE}")]
    except OSError:
        return []
