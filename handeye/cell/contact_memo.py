"""Stores results that are computed from the contacts of a scene, because the same contacts often come back."""

from collections.abc import Callable
from typing import Final, Generic, TypeVar

import mujoco
import numpy as np
from numpy.typing import NDArray

T = TypeVar("T")
_KEPT: Final = 1000  # sets of contacts that are remembered


class ContactMemo(Generic[T]):
    """Stores the results of a function whose argument is a set of contacts. The function is called once for each set
    of contacts.
    """

    def __init__(self, data: mujoco.MjData, judge: Callable[[NDArray[np.int32]], T]) -> None:
        """`judge` is given the numbers of the geoms that touch, shape (n, 2). Apart from these numbers, the result of
        `judge` must not depend on anything that changes.
        """
        self._contact, self._judge = data.contact, judge
        self._known: dict[bytes, T] = {}

    def now(self) -> T:
        """Return the result for the contacts that the simulator found most recently."""
        geoms = self._contact.geom
        key = geoms.tobytes()
        if key not in self._known:
            if len(self._known) >= _KEPT:
                self._known.clear()
            self._known[key] = self._judge(geoms)
        return self._known[key]
