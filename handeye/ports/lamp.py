"""A lamp that can be switched: the small one on the hand, by which a camera is calibrated."""

from abc import ABC, abstractmethod


class LampPort(ABC):
    """A lamp."""

    @abstractmethod
    def switch(self, lit: bool) -> None:
        """Switch it on or off."""
