"""The posture in which the arm stands beside the pump's table before anything is done."""

from typing import Final

import numpy as np

from handeye.core.units import DEGREE, INCH

PARK: Final = np.array([-19.7, 104.0, 17.5, 0.0, 76.0, 70.3]) * [
    DEGREE, DEGREE, INCH, DEGREE, DEGREE, DEGREE
]  # fmt: skip
"""Hand at (20, 28, 8) in, pointing down. Layout study, section 2."""
