"""Defines the television camera: a pan/tilt mount, a turret with two lenses, a vidicon, and a digitiser."""

from abc import ABC, abstractmethod
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from handeye.core.record import Record

COLUMNS: Final = 333
ROWS: Final = 256
RASTER: Final = (0.0128, 0.0096)
"""Width and height (m) of the raster on a one-inch vidicon. We inferred these values. Picture points are not square."""

WIDE: Final = 0.025  # focal length of a lens of the turret, m, like CLOSE_UP
CLOSE_UP: Final = 0.050
LENSES: Final = (WIDE, CLOSE_UP)
FIRST_LENS: Final = CLOSE_UP
"""The lens in place when the cell is switched on. It is also the lens of the last picture of a run."""

DIGITISE: Final = 0.5  # s to digitise a picture: layout study, section 6

Picture = NDArray[np.uint8]  # a digitised television picture: ROWS by COLUMNS of intensities 0..15


class Renderer(Record, frozen=True, kw_only=True):
    """The method by which pictures are rendered. Pictures may differ between methods, and between platforms."""

    method: Literal["opengl", "rays", "none", "replaced"]  # `replaced`: by code of the calling program
    platform: str = ""
    """Library that provides OpenGL, such as `EGL` or `OSMesa`. If the method is `replaced`, the name of the code that
    replaces the renderer.
    """


class TvCamera(ABC):
    """The television camera on its pan/tilt mount, with two lenses in a turret.

    `lens`, `aim` and `focus` start a slow mechanical movement and return its duration. The mechanism makes one
    movement after another; the arm may move at the same time. The executor takes no picture until all movements have
    ended.
    """

    @abstractmethod
    def lens(self, focal_length: float) -> float:
        """Turn the turret to a lens. `focal_length` (m) is one of LENSES. Returns the
        duration (s). Raises InvalidInput if no lens has this focal length.
        """

    @abstractmethod
    def aim(self, pan: float, tilt: float) -> float:
        """Turn the mount until the potentiometers read the angles `pan` and `tilt` (rad). Returns the duration (s).
        Raises InvalidInput if an angle is not finite.
        """

    @abstractmethod
    def focus(self, distance: float) -> float:
        """Focus on a distance (m). Returns the duration (s). Raises InvalidInput if the distance is too short for
        every lens.
        """

    @abstractmethod
    def pots(self) -> tuple[float, float]:
        """Return the pan and tilt angles that the potentiometers read now (rad).

        The mount turns until the potentiometers read the angles given to `aim`, so the readings are always
        these angles. An error of a potentiometer changes the true direction of the mount, not the reading.
        """

    @abstractmethod
    def digitise(self, *, hold_target: bool = False) -> Picture:
        """Take a picture of the present state. The tube and the digitiser need DIGITISE seconds for a picture; the
        caller must first let this time pass.

        Args:
            hold_target: keep the vidicon's target voltage (gain) as it was for the previous picture, and do not adjust
                it. Keep the target voltage if this picture and the previous one will be subtracted from each other.
        """

    @property
    @abstractmethod
    def renderer(self) -> Renderer:
        """The renderer that produces the pictures."""
