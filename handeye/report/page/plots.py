"""Draws plots as SVG."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.core.markup import Content, Markup, element
from handeye.core.polyline import Rows, needed_rows
from handeye.core.pose import Array

WIDE, HIGH = 240.0, 90.0  # Width and height of a small figure, in its own units
TOLERANCE: Final = 0.4  # Greatest distance of a drawn line from its points, in units of the figure


@dataclass(frozen=True, slots=True)
class Scale:
    """A linear scale from values to positions on a drawing."""

    low: float
    high: float
    begin: float
    end: float

    def __call__(self, value: float) -> float:
        share = (value - self.low) / ((self.high - self.low) or 1.0)
        return self.begin + share * (self.end - self.begin)


def drawing(
    *children: Content, wide: float = WIDE, high: float = HIGH, label: str, role: str = "img"
) -> Markup:
    """Make a drawing with a label for screen readers. If `role` is `group`, screen readers can also reach the elements
    inside the drawing.
    """
    return element("svg", *children, viewBox=f"0 0 {wide:g} {high:g}", role=role, aria_label=label)


def curve(xs: Array, ys: Array, **attributes: str) -> Markup:
    """Draw a line through points. Points that make no visible difference are left out."""
    kept = kept_points(np.column_stack([xs, ys]), TOLERANCE)
    way = "M" + "L".join(f"{x:.1f},{y:.1f}" for x, y in kept.tolist())
    return element("path", d=way, **attributes)


def rule(x1: float, y1: float, x2: float, y2: float, **attributes: str) -> Markup:
    """Draw a straight line."""
    return element("line", x1=_at(x1), y1=_at(y1), x2=_at(x2), y2=_at(y2), **attributes)


def dot(x: float, y: float, radius: float, *, class_: str | None = None) -> Markup:
    """Draw a filled circle."""
    return element("circle", cx=_at(x), cy=_at(y), r=f"{radius:g}", class_=class_)


def words(x: float, y: float, content: str, *, anchor: str = "start", class_: str | None = None) -> Markup:
    """Write a short text in a drawing."""
    return element("text", content, x=_at(x), y=_at(y), text_anchor=anchor, class_=class_)


def bar(x: float, y: float, wide: float, high: float, *, class_: str) -> Markup:
    """Draw a bar, which is always wide enough to be visible."""
    return element("rect", x=_at(x), y=_at(y), width=_at(max(wide, 0.5)), height=_at(high), class_=class_)


def kept_points(points: Array, tolerance: float) -> Array:
    """Return those points, shape (n, 2), that are needed to draw a line within a tolerance."""

    def off(first: Rows, row: Rows, last: Rows) -> Array:
        begins = points[first]
        along, off = points[last] - begins, points[row] - begins
        lengths = np.hypot(*along.T)
        across = np.abs(along[:, 0] * off[:, 1] - along[:, 1] * off[:, 0])
        return (
            np.where(lengths > 0, across / np.where(lengths > 0, lengths, 1.0), np.hypot(*off.T)) / tolerance
        )

    return points[needed_rows(off, sorted({0, len(points) - 1}))]


def _at(value: float) -> str:
    return f"{value:.1f}"
