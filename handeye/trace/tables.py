"""Converts a trace to tables for data analysis, and exports the tables to a folder."""

import csv
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO, StringIO
from pathlib import Path
from typing import Final, Literal, get_args

import numpy as np

from handeye.core.errors import MissingExtra, NoSuchName
from handeye.core.folders import FolderKind, check_folder, write_folder
from handeye.core.plain_text import printable
from handeye.core.pose import Array
from handeye.program.events import AnyEvent, StageStarted, StepStarted
from handeye.tasks import known_any
from handeye.tasks.interface import AnyTask
from handeye.trace.records import event_data
from handeye.trace.sentences import measures_of, sentence
from handeye.trace.stages import CLOCKS
from handeye.trace.table import Column, Table
from handeye.trace.trace import Trace

NO_STEP: Final = -1  # stands for the numbers of step and line if no step was in progress


def table(trace: Trace, name: str) -> Table:
    """Return the table called `name` of a run. Raises NoSuchName if there is no such table."""
    if name not in _TABLES:
        raise NoSuchName(f"there is no table {name!r}; the tables are {', '.join(_TABLES)}")
    return _TABLES[name](trace)


def tables(trace: Trace) -> tuple[Table, ...]:
    """Return the tables of a run: joints, forces, events and, if its machines have channels, the channels."""
    return tuple(make(trace) for name, make in _TABLES.items() if name != "channels" or trace.channels)


def _joints(trace: Trace) -> Table:
    task = known_any(trace.head.task)
    motion, kinds = trace.motion, {} if task is None else task.joint_kinds
    columns = [
        Column(
            name=f"{name.replace(' ', '_')}_{what}",
            about=f"{what} of the joint {name}",
            unit=_UNITS[kinds[name]][what] if name in kinds else "",
            values=values[:, number],
        )
        for number, name in enumerate(motion.names)
        for what, values in (("position", motion.joints), ("rate", motion.rates), ("torque", motion.efforts))
    ]
    gap = Column(
        name="gap", about="opening of the fingers, as the gap sensor reads it", unit="m", values=motion.gaps
    )
    about = "What the sensors measured at the end of each servo period, and the commands of that period."
    if trace.thinned:
        about += " The trace is thinned, and holds only some of the servo periods."
    return Table(name="joints", about=about, columns=(*_under_way(trace, motion.times), *columns, gap))


_UNITS: Final = {
    "revolute": {"position": "rad", "rate": "rad/s", "torque": "N m"},
    "prismatic": {"position": "m", "rate": "m/s", "torque": "N"},
}


def _forces(trace: Trace) -> Table:
    forces = trace.forces()
    rows = forces.estimated | (forces.guard != "")
    vectors = (
        ("force", "force of the hand on its surroundings", "N", forces.force),
        (
            "moment",
            "moment that the hand exerts on its surroundings, about the tool centre point",
            "N m",
            forces.moment,
        ),
        ("axis", "unit vector along or about which the guard measures", "", forces.axis),
    )
    columns = [
        Column(name=f"{name}_{axis}", about=f"{about}, {axis}", unit=unit, values=values[rows, number])
        for name, about, unit, values in vectors
        for number, axis in enumerate("xyz")
    ]
    guard = tuple(map(str, forces.guard[rows]))
    columns += [
        Column(
            name="guard",
            about="kind of the active guard; if several guards are active, kind of the first",
            values=guard,
        ),
        Column(
            name="value",
            about="value that the guard measures: a force (N), a moment or torque (N m), or the state of the finger "
            "switches",
            values=forces.value[rows],
        ),
        Column(name="limit", about="limit of the guard", values=forces.limit[rows]),
    ]
    task = known_any(trace.head.task)
    axes = AnyTask.force_axes if task is None else task.force_axes
    about = f"What the hand felt in each servo period in which a force was estimated or a guard was active; {axes}."
    return Table(name="forces", about=about, columns=(*_under_way(trace, forces.times[rows]), *columns))


def _channels(trace: Trace) -> Table:
    times = np.unique(np.concatenate([np.empty(0), *(channel.times for channel in trace.channels)]))
    columns = []
    for channel in trace.channels:
        values = np.full(len(times), np.nan)
        values[np.searchsorted(times, channel.times)] = channel.values
        about = f"channel {channel.name}"
        columns.append(Column(name=channel.name, about=about, unit=channel.unit, values=values))
    about = "What the machines measured on their own channels at the end of each servo period."
    return Table(name="channels", about=about, columns=(*_under_way(trace, times), *columns))


def _events(trace: Trace) -> Table:
    events, measures = trace.events, measures_of(trace.head.task)
    times = np.array([event.time for event in events])
    columns = (
        _since(trace, times),
        *_places(_happening(events)),
        Column(name="event", about="kind of event", values=tuple(type(event).__name__ for event in events)),
        Column(
            name="said", about="the event in a sentence", values=tuple(sentence(e, measures) for e in events)
        ),
        Column(
            name="data",
            about="the whole event, as JSON",
            values=tuple(event_data(e).decode() for e in events),
        ),
    )
    return Table(name="events", about="Every event that happened and was not undone.", columns=columns)


_TABLES: Final[Mapping[str, Callable[[Trace], Table]]] = {
    "joints": _joints,
    "forces": _forces,
    "events": _events,
    "channels": _channels,
}


# -- when, and in which step -------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _RunPosition:
    stage: str
    step: StepStarted | None


def _happening(events: Iterable[AnyEvent]) -> Iterator[_RunPosition]:
    stage, step = "", None
    for event in events:
        if isinstance(event, StageStarted):
            stage = event.stage
        elif isinstance(event, StepStarted):
            step = event
        yield _RunPosition(stage, step)


def _under_way(trace: Trace, times: Array) -> tuple[Column, ...]:
    """Return columns with the end of each servo period, and with the step that was in progress at that time.
    `times` has shape (n,)."""
    happening = tuple(_happening(trace.events))
    begun = np.array([event.time for event in trace.events]) + CLOCKS
    rows = np.searchsorted(begun, times, side="right") - 1
    return _since(trace, times), *_places(happening[row] for row in rows.tolist())


def _since(trace: Trace, times: Array) -> Column:
    return Column(name="time", about="time since the program began", unit="s", values=times)


def _places(happening: Iterable[_RunPosition]) -> tuple[Column, ...]:
    each = tuple(happening)
    steps = np.array([NO_STEP if at.step is None else at.step.step for at in each], dtype=np.int64)
    lines = np.array([NO_STEP if at.step is None else at.step.line for at in each], dtype=np.int64)
    files = tuple("" if at.step is None else at.step.file for at in each)
    return (
        Column(name="stage", about="the current stage", values=tuple(at.stage for at in each)),
        Column(name="step", about=f"number of the current step; {NO_STEP} if there is none", values=steps),
        Column(
            name="file",
            about="file that the script requires and that contains the step; empty if the script itself contains "
            "the step",
            values=files,
        ),
        Column(name="line", about=f"line of the step in its file; {NO_STEP} if there is none", values=lines),
    )


Format = Literal["csv", "parquet"]
README: Final = "README.md"
_SI: Final = "Figures are in SI units"
_BEGINS: Final = "# Tables of a run of handeye\n"
EXPORT: Final = FolderKind(
    name="tables of handeye",
    known_by=README,
    begins=_BEGINS.encode(),
    holds=(README, *(f"*.{ending}" for ending in get_args(Format))),
)


def export_tables(
    path: Path, trace: Callable[[], Trace], kind: Format, *, overwrite: bool
) -> tuple[Table, ...]:
    """Write the tables of a trace to a folder, and return them. `trace` is a function that reads the trace. This
    function is called only after the folder has been checked.
    """
    check_folder(path, EXPORT, overwrite=overwrite)
    made = tables(trace())
    write_tables(path, made, kind)
    return made


def check_tables(path: Path, kind: Format) -> None:
    """Check that tables can be written to a folder in the format `kind`. Raises CannotWrite if the folder does not
    allow it, and MissingExtra if a package is not installed.
    """
    check_folder(path, EXPORT, overwrite=True)
    _WRITERS[kind](Table(name="", about="", columns=()))


def write_tables(path: Path, made: Sequence[Table], kind: Format, units: str = _SI) -> None:
    """Write tables to a folder, together with a README that describes the columns. Tables that are already in the
    folder are replaced. `units` is the README's sentence about units.
    """
    check_folder(path, EXPORT, overwrite=True)
    written = _WRITERS[kind]
    files = {f"{table.name}.{kind}": written(table) for table in made}
    lines = [_BEGINS, f"{units}; an empty cell has no value.", *_told(made, kind), ""]
    write_folder(path, {README: "\n".join(lines).encode(), **files})


def csv_bytes(table: Table) -> bytes:
    """Encode a table as CSV: the names of the columns, then one line per row. Numbers have full precision. None
    and NaN become empty cells.
    """
    text = StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow([column.name for column in table.columns])
    rows.writerows(zip(*map(_cells, table.columns), strict=True))
    return text.getvalue().encode()


def _cells(column: Column) -> Iterable[object]:
    values = column.values
    if isinstance(values, np.ndarray):
        return ("" if value != value else value for value in values.tolist())  # NaN differs from itself
    return values


def parquet_bytes(table: Table) -> bytes:
    """Encode a table as Parquet. Units and descriptions are metadata of the fields."""
    try:
        import pyarrow as pa
        from pyarrow import parquet
    except ImportError:
        raise MissingExtra("parquet", "pyarrow", "export") from None
    arrays = [pa.array(column.values, from_pandas=True) for column in table.columns]  # NaN becomes null
    fields = [
        pa.field(column.name, array.type, metadata={"unit": column.unit, "about": column.about})
        for column, array in zip(table.columns, arrays, strict=True)
    ]
    made = pa.Table.from_arrays(arrays, schema=pa.schema(fields, metadata={"about": table.about}))
    file = BytesIO()
    parquet.write_table(made, file)
    return file.getvalue()


_WRITERS: Final[Mapping[Format, Callable[[Table], bytes]]] = {"csv": csv_bytes, "parquet": parquet_bytes}


def _told(made: Iterable[Table], kind: Format) -> Iterator[str]:
    for table in made:
        yield from (
            "",
            f"## {table.name}.{kind}",
            "",
            table.about,
            "",
            "| column | unit | |",
            "|---|---|---|",
        )
        for column in table.columns:
            yield f"| `{printable(column.name)}` | {column.unit} | {printable(column.about)} |"
