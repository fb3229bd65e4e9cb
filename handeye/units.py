"""Period units and their SI values: the only file that knows how long an inch is.

Inside the program every quantity is SI: metres, radians, newtons, newton metres, seconds.
"""

import math
from typing import Final

INCH: Final = 0.0254  # m, exact by definition
MILLIMETRE: Final = 0.001  # m
DEGREE: Final = math.pi / 180  # rad
OUNCE_FORCE: Final = 0.27801385095378125  # N, avoirdupois ounce times standard gravity
OUNCE_INCH: Final = OUNCE_FORCE * INCH  # N m
RPM: Final = 2 * math.pi / 60  # rad/s
JIFFY: Final = 1 / 60  # s, the servo period of the 1973 arm program
