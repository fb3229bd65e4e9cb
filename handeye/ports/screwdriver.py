"""A powered screwdriver, which a hand may hold."""

from abc import ABC, abstractmethod


class ScrewdriverPort(ABC):
    """The motor of a screwdriver.

    The watchdog of the arm that carries it cuts it, too: it stands still until the program has set the brakes of the
    arm and then a speed anew.
    """

    @abstractmethod
    def torque(self) -> float:
        """Torque of the motor by its current, N m, positive when it drives a screw in; the same until time passes."""

    @abstractmethod
    def drive(self, speed: float) -> None:
        """Set the speed of the spindle, rad/s, positive drives a right-hand screw in; 0 is off.

        Raises InvalidInput if it is not a finite number.
        """

    @abstractmethod
    def attract(self, on: bool) -> None:
        """Switch the magnet of the bit, which is on at first."""
