"""Edges: discontinuities of intensity along a ray through the picture."""

from typing import Final, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import Array

SPAN: Final = 3
"""Points averaged on either side of a discontinuity; means of 2 are too noisy at one level of noise."""

BRIGHTER: Final = 1
DARKER: Final = -1
Polarity = Literal[1, -1]


class Edge(NamedTuple):
    """An edge: intensities before and after it on the beam, and its distance from the start, points."""

    u: float
    v: float
    before: float
    after: float
    length: float


class Edges(NamedTuple):
    """Edges of several beams, a row each."""

    met: NDArray[np.bool_]
    """Whether the beam met an edge; the other fields are meaningless if not."""
    uv: Array
    """Position of the edge, shape (n, 2)."""
    before: Array
    after: Array
    length: Array

    def edge(self, n: int) -> Edge | None:
        """The edge of beam `n`, if it met one."""
        if not self.met[n]:
            return None
        (u, v), before, after = self.uv[n].tolist(), float(self.before[n]), float(self.after[n])
        return Edge(u=u, v=v, before=before, after=after, length=float(self.length[n]))
