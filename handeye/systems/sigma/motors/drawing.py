"""Plots a move: its speed, the force that it requires, and the force that the motor can give."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from handeye.core.markup import Markup, element, joined
from handeye.core.plain_text import counted
from handeye.systems.sigma.motors.study import AxisStudy, series, verdict

_HEIGHT: Final = 8  # lines of a plot as text
_NAME: Final = 10  # columns before the plot
_WIDTH, _TALL, _LEFT, _TOP, _GAP = 720, 170, 70, 56, 46  # px
_STYLE: Final = (
    "text{font:11px ui-monospace,'DejaVu Sans Mono',Menlo,Consolas,monospace;fill:#222}"
    ".t{font:600 14px system-ui,'DejaVu Sans',Helvetica,Arial,sans-serif}.a{fill:#777;font-size:10px}"
    ".c{text-anchor:middle}.e{text-anchor:end}.g{stroke:#eceef1}.z{stroke:#aab}"
    ".v{fill:none;stroke:#3b75af;stroke-width:2}.f{fill:none;stroke:#b98113;stroke-width:2}"
    ".p{fill:none;stroke:#c8382e;stroke-width:1.5;stroke-dasharray:5 3}"
)


def as_text(found: AxisStudy, width: int = 100) -> list[str]:
    """Return the speed over time as lines of text. Each line stands for an eighth of the greatest speed."""
    times, speeds, _, _ = series(found)
    columns = max(20, width - _NAME - 1)
    edges = np.linspace(0, times[-1], columns + 1)
    means = np.interp((edges[1:] + edges[:-1]) / 2, times, speeds)
    top = float(speeds.max())
    out = []
    for level in range(_HEIGHT, 0, -1):
        label = f"{top * level / _HEIGHT:.0f}" if level in (_HEIGHT, _HEIGHT // 2) else ""
        row = "".join("#" if speed >= top * (level - 0.5) / _HEIGHT else " " for speed in means)
        out.append(f"{label:>{_NAME}} {row}".rstrip())
    return [f"{'steps/s':>{_NAME}}", *out, f"{'0':>{_NAME}} {'-' * columns}", _axis(times, columns)]


def _axis(times: NDArray[np.float64], columns: int) -> str:
    end = f"{times[-1]:.0f} ms"
    return f"{'':>{_NAME}} 0{end:>{columns - 1}}"


def as_svg(found: AxisStudy) -> str:
    """Draw, as SVG, the speed, the required force and the pull-out force over time."""
    times, speeds, forces, pulls = series(found)
    title = f"{found.mass:g} kg, curve {found.curve}, {counted(found.steps, 'step')}: {verdict(found)[-1]}"
    pieces = [element("text", title, x=12, y=22, class_="t")]
    pieces += _panel("steps/s", times, [(speeds, "v")], _TOP)
    second = _TOP + _TALL + _GAP
    pieces += _panel(
        "force, N (dashed: pull-out)", times, [(forces, "f"), (pulls, "p"), (-pulls, "p")], second
    )
    height, width = second + _TALL + 34, _LEFT + _WIDTH + 24
    paper = element("rect", width=width, height=height, fill="#fff")
    svg = element(
        "svg", element("style", Markup(_STYLE)), paper, joined(pieces, "\n"),
        xmlns="http://www.w3.org/2000/svg", viewBox=f"0 0 {width} {height}", width=width, height=height,
    )  # fmt: skip
    return f"{svg}\n"


def _panel(
    name: str, times: NDArray[np.float64], curves: list[tuple[NDArray[np.float64], str]], top: int
) -> list[Markup]:
    least = min(0.0, *(float(curve.min()) for curve, _ in curves))
    most = max(1e-9, *(float(curve.max()) for curve, _ in curves))

    def x(time: float) -> float:
        return round(_LEFT + _WIDTH * time / float(times[-1]), 1)

    def y(value: float) -> float:
        return round(top + _TALL * (most - value) / (most - least), 1)

    out = [element("text", name, x=_LEFT, y=top - 8)]
    for value in _round_values(least, most):
        out.append(element("line", x1=_LEFT, x2=_LEFT + _WIDTH, y1=y(value), y2=y(value), class_="g"))
        out.append(element("text", f"{value:g}", x=_LEFT - 6, y=y(value) + 4, class_="a e"))
    for time in _round_values(0.0, float(times[-1])):
        out.append(element("text", f"{time:g}", x=x(time), y=top + _TALL + 14, class_="a c"))
    out.append(element("line", x1=_LEFT, x2=_LEFT + _WIDTH, y1=y(0.0), y2=y(0.0), class_="z"))
    for curve, kind in curves:
        points = " ".join(f"{x(t):g},{y(v):g}" for t, v in zip(times.tolist(), curve.tolist(), strict=True))
        out.append(element("path", d=f"M{points}", class_=kind))
    out.append(element("text", "ms", x=_LEFT + _WIDTH + 6, y=top + _TALL + 14, class_="a"))
    return out


def _round_values(least: float, most: float) -> list[float]:
    """Return about six round numbers for an axis of the diagram."""
    span = most - least
    step = next(d * 10.0**p for p in range(-6, 9) for d in (1, 2, 5) if d * 10.0**p * 6 >= span)
    first = int(np.ceil(least / step))
    return [n * step for n in range(first, int(np.floor(most / step)) + 1)]
