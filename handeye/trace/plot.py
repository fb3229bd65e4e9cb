"""Plots traces: joints, forces and events over time, in the units of the task. Equal traces give equal files."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from io import BytesIO
from typing import Any, Final

from handeye.core.errors import MissingExtra, Refused
from handeye.core.files import Kind
from handeye.core.pose import Array
from handeye.core.units import DEGREE
from handeye.program import events as happened
from handeye.program.events import AnyEvent, SystemEvent
from handeye.program.stage_names import stage_index
from handeye.tasks import known_any
from handeye.trace.sentences import measures_of
from handeye.trace.stages import Span, Stage
from handeye.trace.trace import Trace


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Curve:
    """Values of a quantity against time."""

    name: str
    times: Array  # s since the run began, shape (n,)
    values: Array  # in the unit of the panel, shape (n,); NaN: there is none


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Panel:
    """Curves that share an axis."""

    name: str
    unit: str
    curves: tuple[Curve, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Mark:
    """Times of the events of one kind."""

    name: str
    times: tuple[float, ...]  # s since the run began


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Plot:
    """The data of a plot of a run, or of one stage."""

    title: str
    begin: float  # s since the run began
    end: float
    stages: tuple[Stage, ...]  # times since the run began
    panels: tuple[Panel, ...]
    marks: tuple[Mark, ...]


_MARKED: Final[Mapping[str, type[AnyEvent]]] = {
    "stop": happened.GuardTripped,
    "error": happened.ErrorRaised,
    "search": happened.SearchAdvanced,
    "saved": happened.Saved,
    "picture": happened.PictureTaken,
    "operator": happened.OperatorCalled,
}  # the events that are marked, by their names in the plot


def plot(trace: Trace, stage: str | None = None) -> Plot:
    """Make the plot of a trace, or of one stage. `stage` is the stage's number among the executed stages, the stage's
    name, or a part of that name.
    """
    begin, end = trace.covers if stage is None else _covers(trace, stage)
    rows = Span(begin, end).rows(trace.times)
    if rows.start == rows.stop:
        raise Refused(f"{trace.name} contains no motion to plot in this part")
    return Plot(
        title=f"{trace.head.program}, {trace.head.world}",
        begin=begin,
        end=end,
        stages=trace.stages,
        panels=(*_joints(trace, rows), _forces(trace, rows), *_channels(trace, begin, end)),
        marks=tuple(_marks(trace, begin, end)),
    )


def _covers(trace: Trace, stage: str) -> tuple[float, float]:
    """Return the start of a stage's first execution and the end of its last execution (s)."""
    names = tuple(dict.fromkeys(each.name for each in trace.stages))
    name = names[stage_index(stage, names)]
    found = [each for each in trace.stages if each.name == name]
    return found[0].begin, found[-1].end


def _joints(trace: Trace, rows: slice) -> Iterator[Panel]:
    """Yield one panel for the revolute joints, and one for the prismatic joints and the fingers. If the arm is
    unknown, the units are SI units.
    """
    task, measures = known_any(trace.head.task), measures_of(trace.head.task)
    kinds = {} if task is None else task.joint_kinds
    times = trace.times[rows]
    motion, length = trace.motion, measures.length
    turning, sliding, others = [], [Curve(name="gap", times=times, values=trace.gaps[rows] / length.size)], []
    for number, name in enumerate(motion.names):
        values = motion.joints[rows, number]
        match kinds.get(name):
            case "revolute":
                turning.append(Curve(name=name, times=times, values=values / DEGREE))
            case "prismatic":
                sliding.append(Curve(name=name, times=times, values=values / length.size))
            case _:
                others.append(Curve(name=name, times=times, values=values))
    for name, unit, curves in (
        ("revolute joints", "deg", turning),
        ("prismatic joints, fingers", length.name, sliding),
        ("joints", "SI", others),
    ):
        if curves:
            yield Panel(name=name, unit=unit, curves=tuple(curves))


def _forces(trace: Trace, rows: slice) -> Panel:
    forces, unit = trace.forces(), measures_of(trace.head.task).force
    times = forces.times[rows]
    curves = (
        Curve(name=axis, times=times, values=forces.force[rows, number] / unit.size)
        for number, axis in enumerate("xyz")
    )
    return Panel(name="hand force", unit=unit.name, curves=tuple(curves))


def _channels(trace: Trace, begin: float, end: float) -> Iterator[Panel]:
    for unit in dict.fromkeys(channel.unit for channel in trace.channels):
        curves = []
        for channel in trace.channels:
            rows = Span(begin, end).rows(channel.times)
            if channel.unit == unit:
                times = channel.times[rows]
                curves.append(Curve(name=channel.name, times=times, values=channel.values[rows]))
        yield Panel(name="channels" if unit else "switches, counts", unit=unit, curves=tuple(curves))


def _marks(trace: Trace, begin: float, end: float) -> Iterator[Mark]:
    """Yield a mark for each kind of event. The mark holds the times of all events of this kind. Subclasses of
    `SystemEvent` are named by their class.
    """
    own = {type(event).__name__: type(event) for event in trace.events if isinstance(event, SystemEvent)}
    for name, kind in {**_MARKED, **own}.items():
        times = (event.time for event in trace.events if isinstance(event, kind))
        inside = tuple(time for time in times if begin <= time <= end)
        if inside:
            yield Mark(name=name, times=inside)


KINDS: Final = {
    ".png": Kind("PNG picture", rb"\x89PNG", ending=".png"),
    ".svg": Kind("SVG drawing", rb"<\?xml|<svg ", ending=".svg"),
    ".pdf": Kind("PDF drawing", rb"%PDF", ending=".pdf"),
}  # kinds of files that a plot can be written to, by file extension
_UNDATED: Final[dict[str, dict[str, Any]]] = {
    ".png": {"Software": None},
    ".svg": {"Date": None},
    ".pdf": {"CreationDate": None},
}  # metadata that are left out, because they would give the file's date or maker
_STYLE: Final[dict[Any, Any]] = {
    "svg.hashsalt": "handeye",
    "font.size": 8.0,
    "axes.grid": True,
    "grid.alpha": 0.3,
}
_WIDTH_IN, _PANEL_IN, _EVENTS_IN = 11.0, 2.2, 1.1
_DPI: Final = 120
_LEAST_GAP: Final = 0.025  # between names of stages, as a share of the width
_OVER: Final = "data", "axes fraction"
_BANDS: Final = ("#f2f2f2", "#ffffff")


def drawn(plot: Plot, ending: str) -> bytes:
    """Draw a plot as a file. `ending` is one of KINDS. Raises MissingExtra if matplotlib is not installed."""
    try:
        import matplotlib
        from matplotlib.figure import Figure
    except ImportError:
        raise MissingExtra("trace plot", "matplotlib", "plot") from None
    heights = [*(_PANEL_IN for _ in plot.panels), _EVENTS_IN]
    with matplotlib.rc_context(_STYLE):
        figure = Figure(figsize=(_WIDTH_IN, sum(heights)), layout="constrained")
        axes = figure.subplots(len(heights), 1, sharex=True, squeeze=False, height_ratios=heights)[:, 0]
        figure.suptitle(plot.title)
        for axis, panel in zip(axes, plot.panels, strict=False):
            for curve in panel.curves:
                axis.plot(curve.times, curve.values, linewidth=0.8, label=curve.name)
            axis.set_ylabel(f"{panel.name}, {panel.unit}")
            axis.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
        _draw_marks(axes[-1], plot)
        for axis in axes:
            for number, stage in enumerate(plot.stages):
                axis.axvspan(stage.begin, stage.end, color=_BANDS[number % 2], zorder=-1)
        _name_stages(axes[0], plot)
        file = BytesIO()
        figure.savefig(file, format=ending[1:], dpi=_DPI, metadata=_UNDATED[ending])
    return file.getvalue()


def _draw_marks(axis: Any, plot: Plot) -> None:
    for row, mark in enumerate(plot.marks):
        axis.plot(mark.times, [row] * len(mark.times), "|", markersize=7)
    axis.set_yticks(range(len(plot.marks)), [mark.name for mark in plot.marks])
    axis.set_ylim(max(len(plot.marks), 1) - 0.5, -0.5)
    axis.set_xlabel("s since the run began")
    axis.set_xlim(plot.begin, plot.end)


def _name_stages(axis: Any, plot: Plot) -> None:
    """Write the name of each stage above its beginning, or further to the right if there is no space."""
    least, free = (plot.end - plot.begin) * _LEAST_GAP, plot.begin
    for stage in plot.stages:
        if plot.begin <= stage.begin < plot.end:
            at = max(stage.begin, free)
            free = at + least
            axis.annotate(stage.name, (at, 1.02), xycoords=_OVER, rotation=30, ha="left", va="bottom")
