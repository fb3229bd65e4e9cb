"""Defines the numbered errors of ML, M01 to M16."""

from typing import Final

from handeye.core.errors import InvalidInput

MEANINGS: Final[dict[str, str]] = {
    "M01": "a command does not exist",
    "M02": "a sequence number is not between 1 and 5000",
    "M03": "a command has too few or too many parameters",
    "M04": "a number does not fit into 16 bits, or the limits of a sensor are in the wrong order",
    "M05": "the number of a variable is not between 1 and 256",
    "M06": "a reference has more than six `&`",
    "M07": "a statement does not exist",
    "M08": "a point does not exist, or was never filled",
    "M09": "a motor is not installed",
    "M10": "a goal is outside the travel of its motor",
    "M11": "a table, or a line or word of a table, does not exist",
    "M12": "an arm is not installed",
    "M13": "a loop ends, or a subroutine returns, without having begun",
    "M14": "an emergency has stopped the arm",
    "M15": "the pump is off although it must be on, or on although it must be off",
    "M16": "there is no host",
}


class MlError(InvalidInput):
    """Raised when a statement cannot be executed. `code` is one of `MEANINGS`."""

    def __init__(self, code: str, message: str) -> None:
        assert code in MEANINGS, code
        super().__init__(f"{code}: {message}")
        self.code = code
