"""The interface between an environment and a machine: the machine takes commands for periods of equal length, and its
sensors are read at the end of each period.

Every kind of machine implements this interface. The environment knows nothing else of a machine.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any, ClassVar

from handeye.core.entries import loaded
from handeye.core.errors import HandeyeError, NoSuchName, Refused
from handeye.env.jobs import Job
from handeye.env.policies import Facts
from handeye.env.spaces import ActionKind, Component, Observation, ObservationSpace
from handeye.runs.runner import Runner

Values = Mapping[str, float]  # components of an action, in their units


class MachineStopped(HandeyeError):
    """Raised if a machine has stopped for good, so that no command can reach it."""


class Controls(ABC):
    """The machine of one episode. Its time passes only in `act` and `stop`."""

    @abstractmethod
    def act(self, values: Values) -> None:
        """Make the machine execute the commands `values` for one period. Raises PhysicsFailed if the
        simulation breaks down, or MachineStopped if the machine has stopped for good.
        """

    @abstractmethod
    def stop(self) -> None:
        """Bring the machine to rest, after the policy has reported that the work is done. Raises the same exceptions as
        `act`.
        """

    @abstractmethod
    def seen(self) -> Observation:
        """Return the readings at the end of the last period."""

    @property
    def known(self) -> Mapping[str, Any]:
        """What the machine measured or was taught before the episode. `reset` returns this in `info`."""
        return {}

    def facts(self, common: Mapping[str, Any]) -> Facts:
        """Return the facts that a policy is allowed to know. `common` are the fields of `Facts` that do not depend on
        the kind of machine.
        """
        return Facts(**common)


class ControlledMachine(ABC):
    """The machine of a job, before an episode begins: how it is commanded and read."""

    period: float  # s: length of a step of the environment
    actions: ClassVar[tuple[ActionKind, ...]] = ("hand",)  # the kinds of action that it takes

    def __init__(self, job: Job) -> None:
        self.job = job

    @property
    def sees(self) -> bool:
        """True if a policy can take pictures with a television camera."""
        return False

    @abstractmethod
    def components(self, action: ActionKind, *, pictures: bool) -> tuple[Component, ...]:
        """Return the components of an action, in order; the last one is `done`."""

    @abstractmethod
    def observations(self, *, pictures: bool) -> ObservationSpace:
        """Return the space of the observations."""

    @abstractmethod
    def begin(self, runner: Runner, action: ActionKind, *, pictures: bool) -> Controls:
        """Return the controls of an episode that begins in the present state of a run."""

    def check(self, action: ActionKind, *, pictures: bool) -> None:
        """Raise InvalidInput if the machine does not take actions of the kind `action`, or if pictures are wanted and
        the machine has no camera.
        """
        if action not in self.actions:
            raise NoSuchName(
                f"{self.job.id} has no action {action!r}; its only action is {' or '.join(self.actions)}"
            )
        if pictures and not self.sees:
            raise Refused(f"{self.job.id} has no television camera")


def machine_of(job: Job) -> ControlledMachine:
    """Return the machine of a job. Raises InvalidInput if the machine's module cannot be imported."""
    found: ControlledMachine = loaded(job.machine)(job)
    return found
