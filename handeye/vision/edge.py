"""What beams look for: a discontinuity of intensity along a ray through the picture."""

from typing import Final, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import Array

SPAN: Final = 3
"""Points averaged on either side of a discontinuity: means of 2 are too noisy at one level of noise."""

BRIGHTER: Final = 1
DARKER: Final = -1
Polarity = Literal[1, -1]


class Edge(NamedTuple):
    """A discontinuity met by a beam."""

    u: float
    v: float
    before: float
    """Intensity on the side the beam came from."""
    after: float
    length: float
    """Points from the start of the beam."""


class Edges(NamedTuple):
    """What several beams have met; each array has a row for each beam."""

    met: NDArray[np.bool_]
    """Whether it met anything. What the others say of a beam that did not is of no meaning."""
    uv: Array
    """Where, shape (n, 2)."""
    before: Array
    after: Array
    length: Array

    def edge(self, n: int) -> Edge | None:
        """What beam number `n` met."""
        if not self.met[n]:
            return None
        (u, v), before, after = self.uv[n].tolist(), float(self.before[n]), float(self.after[n])
        return Edge(u=u, v=v, before=before, after=after, length=float(self.length[n]))
