"""The television camera: a pan/tilt mount, a two-lens turret, a vidicon and its digitiser."""

from abc import ABC, abstractmethod
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from handeye.core.record import Record

COLUMNS: Final = 333
ROWS: Final = 256
RASTER: Final = (0.0128, 0.0096)
"""Width and height of the raster on a one-inch vidicon, m. Inferred; the points are not square."""

WIDE: Final = 0.025  # focal length of a lens of the turret, m, as CLOSE_UP
CLOSE_UP: Final = 0.050
LENSES: Final = (WIDE, CLOSE_UP)
FIRST_LENS: Final = CLOSE_UP
"""The lens that is in place when the cell is switched on: as the last look of a run leaves it."""

DIGITISE: Final = 0.5  # s for a picture: the layout study, 6

Picture = NDArray[np.uint8]  # a digitised television picture: ROWS by COLUMNS of intensities 0..15


class Renderer(Record, frozen=True, kw_only=True):
    """Method by which pictures are made; two methods, or two platforms, need not give the same picture."""

    method: Literal["opengl", "rays", "none", "replaced"]  # `replaced`: by code of the calling program
    platform: str = ""
    """Library that draws for OpenGL: `EGL`, `OSMesa`, ...; name of the code that replaces it."""


class TvCamera(ABC):
    """The television camera on its pan/tilt mount with a two-lens turret.

    `lens`, `aim` and `focus` start a slow mechanical action; they return the time it takes. The mechanism makes one
    movement after another, while the arm may move; the executor takes no picture before it is ready.
    """

    @abstractmethod
    def lens(self, focal_length: float) -> float:
        """Turn to a lens by its focal length (m, of LENSES); seconds it takes; raises InvalidInput if there is none."""

    @abstractmethod
    def aim(self, pan: float, tilt: float) -> float:
        """Slew to potentiometer readings (rad); seconds it takes; raises InvalidInput if one is not finite."""

    @abstractmethod
    def focus(self, distance: float) -> float:
        """Set the focus for a distance (m); seconds it takes; raises InvalidInput if no lens can be focused so near."""

    @abstractmethod
    def pots(self) -> tuple[float, float]:
        """Pan and tilt as the potentiometers read them now (rad).

        The mount is driven until they read what `aim` was given, so that they do. What they read wrongly is in where
        it then stands.
        """

    @abstractmethod
    def digitise(self, *, hold_target: bool = False) -> Picture:
        """The picture of this moment, to which the tube and its digitiser have been at work for DIGITISE.

        Args:
            hold_target: keep the vidicon target voltage (gain) of the previous picture, as a difference of
                two pictures needs, instead of adjusting it to this one.
        """

    @property
    @abstractmethod
    def renderer(self) -> Renderer:
        """The renderer of its pictures."""
