"""Coarser surfaces, for bodies that are small in the picture."""

from typing import Final

import numpy as np

from handeye.report.player.surfaces import Surface, creased

CELLS: Final = 14
"""Along the longest side of a body: what lies in one cell becomes one point."""


def coarsened(surface: Surface, cell: float) -> Surface:
    """A surface whose points within a cell (m) of a grid are one, and what is left of its triangles."""
    places = np.floor((surface.points - surface.points.min(axis=0)) / cell + 0.5)
    _, number = np.unique(places, axis=0, return_inverse=True)
    number = number.reshape(-1)
    count = np.bincount(number)
    points = np.column_stack([np.bincount(number, column) / count for column in surface.points.T])
    triangles = number[surface.triangles]
    a, b, c = triangles.T
    return creased(points, triangles[(a != b) & (b != c) & (c != a)])
