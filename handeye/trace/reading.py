"""Reads traces and their plans from disk. A trace that is incomplete, invalid or written by another program is
refused with a one-sentence message.
"""

import re
from collections import Counter
from pathlib import Path
from typing import Final, TypeVar

import msgspec
from mcap.writer import MCAP0_MAGIC

from handeye.core.brief import Several
from handeye.core.entries import entry_named, require
from handeye.core.errors import BadFile
from handeye.core.files import Kind, read_whole
from handeye.planfile.plan import Plan
from handeye.planfile.store import decode, is_plan_of
from handeye.program.event_reading import EventReader
from handeye.program.events import RunStarted
from handeye.trace.channels import EVENTS, FORMAT, THINNED, VERSION
from handeye.trace.records import DamagedTrace, check, front, is_ended, is_mcap, read_messages
from handeye.trace.trace import Trace

__all__ = ["Trace", "read_trace"]

AnyTrace = TypeVar("AnyTrace", bound=Trace)
TRACE: Final = Kind("trace", re.escape(MCAP0_MAGIC), ending=".mcap")


def read_trace(path: Path, *, lenient: bool = False) -> Trace:
    """Read a trace from a file. Raises BadFile if the trace is invalid or does not fit its plan. An incomplete trace
    also raises BadFile, unless `lenient` is True.
    """
    return read_trace_as(Trace, path, lenient=lenient)


def read_trace_as(kind: type[AnyTrace], path: Path, *, lenient: bool = False) -> AnyTrace:
    """Like `read_trace`, but returns an object of a subclass of `Trace`."""
    data = read_whole(path)
    try:
        plan, version, thinned = _identify(path, data)
        if not lenient:
            check(data)
        messages = Several(read_messages(data, lenient=lenient))
        events, reader = [], EventReader()
        for message in messages:
            if message.topic == EVENTS:
                events.append(reader.read(message.data))
    except DamagedTrace as error:
        raise BadFile(f"{path} {error}") from None
    except msgspec.DecodeError as error:
        raise BadFile(f"{path}: event {len(events) + 1} cannot be read: {error}") from None
    if not events or not isinstance(events[0], RunStarted):
        raise BadFile(f"{path} does not begin with the start of a run")
    if not is_plan_of(events[0], plan):
        raise BadFile(f"the plan in {path} is not the plan of this run")
    return kind(
        name=str(path),
        version=version,
        thinned=thinned,
        head=events[0],
        plan=plan,
        events=Several(events),
        counts=dict(Counter(message.topic for message in messages)),
        messages=messages,
    )


def is_cut_short(path: Path) -> bool:
    """Return True if a file is a trace that was not written to its end."""
    data = read_whole(path)
    return is_mcap(data) and not is_ended(data)


def _identify(path: Path, data: bytes) -> tuple[bytes, int, bool]:
    """Check that a file is a handeye trace. Returns the plan in the file, the version of the trace format, and
    whether the trace is thinned.
    """
    if not is_mcap(data):
        raise BadFile(f"{path} is not a trace: it is not an MCAP file")
    start = front(data)
    if start.metadata.get("format") != FORMAT:
        raise BadFile(f"{path} is not a trace of handeye: its metadata do not say “{FORMAT}”")
    version = start.metadata.get("version", "")
    if not re.fullmatch(r"[1-9][0-9]{0,8}", version):
        raise BadFile(f"{path} does not state its version of the trace format")
    if int(version) != VERSION:
        raise BadFile(
            f"{path} has trace format version {version}; this version of handeye reads version {VERSION}"
        )
    if start.plan is None:
        raise DamagedTrace("has no plan in it")
    return start.plan, int(version), THINNED in start.metadata


def plan_of(trace: Trace) -> Plan:
    """Return the plan of a recorded run. Raises InvalidInput if the plan is invalid, or if the run's system
    executes no plans of motions.
    """
    require(trace.head.system, "plans", trace.name)
    return decode(trace.plan, f"the plan in {trace.name}")


def stage_names(trace: Trace) -> tuple[str, ...]:
    """Return the names of all stages of the program. If the system has no plans of motions, return only the names of
    the stages that began.
    """
    if "plans" in entry_named(trace.head.system).can:
        return plan_of(trace).program.stages
    return tuple(dict.fromkeys(stage.name for stage in trace.stages))
