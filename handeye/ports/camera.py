"""The television camera: a pan/tilt mount, a two-lens turret, a vidicon and its digitiser."""

from abc import ABC, abstractmethod
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from handeye.core.record import Record

COLUMNS: Final = 333
ROWS: Final = 256
RASTER: Final = (0.0128, 0.0096)
"""Width and height of the raster on a one-inch vidicon, m. Inferred; picture points are not square."""

WIDE: Final = 0.025  # focal length of a lens of the turret, m, as CLOSE_UP
CLOSE_UP: Final = 0.050
LENSES: Final = (WIDE, CLOSE_UP)
FIRST_LENS: Final = CLOSE_UP
"""The lens in place when the cell is switched on, as after the last look of a run."""

DIGITISE: Final = 0.5  # s for a picture: the layout study, 6

Picture = NDArray[np.uint8]  # a digitised television picture: ROWS by COLUMNS of intensities 0..15


class Renderer(Record, frozen=True, kw_only=True):
    """The method by which pictures are rendered; two methods, or two platforms, may give different pictures."""

    method: Literal["opengl", "rays", "none", "replaced"]  # `replaced`: by code of the calling program
    platform: str = ""
    """Library that provides OpenGL: `EGL`, `OSMesa`, ...; or the name of the code that replaces the renderer."""


class TvCamera(ABC):
    """The television camera on its pan/tilt mount with a two-lens turret.

    `lens`, `aim` and `focus` start a slow mechanical movement and return its duration. The mechanism makes one
    movement after another, while the arm may move; the executor takes no picture before all movements have ended.
    """

    @abstractmethod
    def lens(self, focal_length: float) -> float:
        """Turn the turret to a lens, given by its focal length (m, of LENSES); returns the duration, s. Raises
        InvalidInput if there is no such lens.
        """

    @abstractmethod
    def aim(self, pan: float, tilt: float) -> float:
        """Turn the mount until the potentiometers read these angles (rad); returns the duration, s. Raises
        InvalidInput if an angle is not finite.
        """

    @abstractmethod
    def focus(self, distance: float) -> float:
        """Focus on a distance (m); returns the duration, s. Raises InvalidInput if no lens focuses so near."""

    @abstractmethod
    def pots(self) -> tuple[float, float]:
        """Pan and tilt as the potentiometers read now (rad).

        The mount is driven until the potentiometers read the angles given to `aim`, so these are always the
        readings. An error of a potentiometer changes where the mount then points.
        """

    @abstractmethod
    def digitise(self, *, hold_target: bool = False) -> Picture:
        """Take a picture of the present state; tube and digitiser have been working on it for DIGITISE seconds.

        Args:
            hold_target: keep the vidicon's target voltage (gain) of the previous picture instead of adjusting it,
                as is necessary for the difference of two pictures.
        """

    @property
    @abstractmethod
    def renderer(self) -> Renderer:
        """The renderer that makes the pictures."""
