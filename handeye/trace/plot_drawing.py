"""Draws plots of traces with matplotlib; the same trace gives the same file, to the byte."""

from io import BytesIO
from typing import Any, Final

from handeye.core.extras import MissingExtra
from handeye.core.files import Kind
from handeye.trace.plot import Panel, Plot

KINDS: Final = {
    ".png": Kind("PNG picture", rb"\x89PNG", ending=".png"),
    ".svg": Kind("SVG drawing", rb"<\?xml|<svg ", ending=".svg"),
    ".pdf": Kind("PDF drawing", rb"%PDF", ending=".pdf"),
}
"""Kinds of files that a plot can be written to, by the ends of their names."""
_UNDATED: Final[dict[str, dict[str, Any]]] = {
    ".png": {"Software": None},
    ".svg": {"Date": None},
    ".pdf": {"CreationDate": None},
}
"""What a file would tell of the moment it was made, and of who made it, left out."""
_STYLE: Final[dict[Any, Any]] = {
    "svg.hashsalt": "handeye",
    "font.size": 8.0,
    "axes.grid": True,
    "grid.alpha": 0.3,
}
_WIDE, _HIGH, _EVENTS_HIGH = 11.0, 2.2, 1.1  # in
_POINTS: Final = 120
"""Of an inch of a PNG."""
_APART: Final = 0.025
"""Of the width: how far apart names of stages are at least."""
_OVER: Final = "data", "axes fraction"
_BANDS: Final = ("#f2f2f2", "#ffffff")
"""Behind every other stage."""


def drawn(plot: Plot, ending: str) -> bytes:
    """A plot as a file of a kind.

    Args:
        ending: one of KINDS.

    Raises:
        MissingExtra: matplotlib is not installed.
    """
    try:
        import matplotlib
        from matplotlib.figure import Figure
    except ImportError:
        raise MissingExtra("trace plot", "matplotlib", "plot") from None
    heights = [*(_HIGH for _ in plot.panels), _EVENTS_HIGH]
    with matplotlib.rc_context(_STYLE):
        figure = Figure(figsize=(_WIDE, sum(heights)), layout="constrained")
        axes = figure.subplots(len(heights), 1, sharex=True, squeeze=False, height_ratios=heights)[:, 0]
        figure.suptitle(plot.title)
        for axis, panel in zip(axes, plot.panels, strict=False):
            _draw_panel(axis, panel)
        _draw_marks(axes[-1], plot)
        for axis in axes:
            _draw_stages(axis, plot)
        _name_stages(axes[0], plot)
        file = BytesIO()
        figure.savefig(file, format=ending[1:], dpi=_POINTS, metadata=_UNDATED[ending])
    return file.getvalue()


def _draw_panel(axis: Any, panel: Panel) -> None:
    for curve in panel.curves:
        axis.plot(curve.times, curve.values, linewidth=0.8, label=curve.name)
    axis.set_ylabel(f"{panel.name}, {panel.unit}")
    axis.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)


def _draw_marks(axis: Any, plot: Plot) -> None:
    """A row for each kind of events."""
    for row, mark in enumerate(plot.marks):
        axis.plot(mark.times, [row] * len(mark.times), "|", markersize=7)
    axis.set_yticks(range(len(plot.marks)), [mark.name for mark in plot.marks])
    axis.set_ylim(max(len(plot.marks), 1) - 0.5, -0.5)
    axis.set_xlabel("s since the run began")
    axis.set_xlim(plot.begin, plot.end)


def _draw_stages(axis: Any, plot: Plot) -> None:
    for number, stage in enumerate(plot.stages):
        axis.axvspan(stage.begin, stage.end, color=_BANDS[number % 2], zorder=-1)


def _name_stages(axis: Any, plot: Plot) -> None:
    """Write each stage over where it begins, or a little to the right where there is no room."""
    least, free = (plot.end - plot.begin) * _APART, plot.begin
    for stage in plot.stages:
        if plot.begin <= stage.begin < plot.end:
            at = max(stage.begin, free)
            free = at + least
            axis.annotate(stage.name, (at, 1.02), xycoords=_OVER, rotation=30, ha="left", va="bottom")
