"""Outputs: tools, lamps and valves that a program switches or sets."""

from abc import ABC, abstractmethod


class Outputs(ABC):
    """Outputs of a machine, each with a name."""

    @property
    @abstractmethod
    def names(self) -> tuple[str, ...]:
        """Their names, in order."""

    @abstractmethod
    def set(self, name: str, value: float) -> None:
        """Set an output: a switch to 0 or 1, anything else in SI units.

        Raises InvalidInput if there is no such output, or the value is not a finite number.
        """
