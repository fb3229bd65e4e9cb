"""The table of the functions that execute the commands of ML. The key of a function is the code of its command."""

from collections.abc import Callable
from typing import Final

from handeye.systems.ml.background.control import CONTROL
from handeye.systems.ml.background.edit import EDIT
from handeye.systems.ml.background.host import HOST
from handeye.systems.ml.background.jumps import JUMPS
from handeye.systems.ml.background.motion import MOTION
from handeye.systems.ml.background.numbers import NUMBERS

BEHAVIOUR: Final[dict[str, Callable[..., None]]] = CONTROL | JUMPS | MOTION | NUMBERS | EDIT | HOST
